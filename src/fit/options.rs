//! What a user may ask of a fit.

/// Settings of a fit; the default asks for nothing and searches.
#[derive(Debug, Clone, PartialEq)]
pub struct FitOptions {
    /// Degree of every segment's expansion; `None` searches 0..=`max_degree`.
    pub degree: Option<usize>,
    /// Number of segments n_s = k^2; `None` searches all squares up to `max_segments`.
    pub segments: Option<usize>,
    /// Largest degree searched.
    pub max_degree: usize,
    /// Largest number of segments searched.
    pub max_segments: usize,
    /// Held-out RMS that is good enough.
    pub tolerance: Tolerance,
    /// Fit every candidate, also those that cannot win any more. The choice is the same.
    pub exhaustive: bool,
}

impl Default for FitOptions {
    fn default() -> Self {
        Self {
            degree: None,
            segments: None,
            max_degree: 3,
            max_segments: 100,
            tolerance: Tolerance::OfMeanRadius(0.003),
            exhaustive: false,
        }
    }
}

/// A radial RMS error.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Tolerance {
    /// In the scan's unit.
    Length(f64),
    /// As a fraction of the mean radius.
    OfMeanRadius(f64),
}

impl Tolerance {
    /// The tolerance in the unit of the mean radius.
    pub fn length(&self, mean_radius: f64) -> f64 {
        match *self {
            Self::Length(length) => length,
            Self::OfMeanRadius(fraction) => fraction * mean_radius,
        }
    }
}

/// Largest degree that can be asked for: beyond it one segment holds more coefficients than most
/// scans have points to give.
pub const MAX_DEGREE: usize = 20;

/// Largest number of parts per angle that can be asked for.
pub const MAX_PARTS: usize = 64;

/// Why a fit cannot be made.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum FitError {
    /// The number of segments is not a square: each angle is cut in the same number of parts.
    #[error(
        "{segments} segments cannot be made: both angles are cut in k equal parts, so ask for a \
         square, {below} or {above}"
    )]
    SegmentsNotSquare {
        /// The number asked for.
        segments: usize,
        /// The nearest square below.
        below: usize,
        /// The nearest square above.
        above: usize,
    },
    /// A setting is outside of its range.
    #[error("{setting} is {value}; it must be from {least} to {most}")]
    OutOfRange {
        /// Name of the setting.
        setting: &'static str,
        /// The value asked for.
        value: usize,
        /// The smallest allowed.
        least: usize,
        /// The largest allowed.
        most: usize,
    },
    /// The tolerance is not a positive number.
    #[error("the tolerance is {value}; it must be a positive length")]
    Tolerance {
        /// The value asked for.
        value: f64,
    },
    /// The scan has too few distinct points, or they enclose no volume.
    #[error(
        "the scan's {points} points do not enclose a volume; a closed surface needs at least 4 \
         points that do not lie in one plane"
    )]
    NoVolume {
        /// Number of points.
        points: usize,
    },
    /// The numbers of the scan are too large or too small to compute with.
    #[error(
        "the scan is {size:e} of its units across; moments of inertia of such a size cannot be \
         written as numbers: scale the scan to another unit"
    )]
    Scale {
        /// Cube root of the volume.
        size: f64,
    },
    /// A coordinate is not finite.
    #[error("point {index} is not finite; remove it from the scan")]
    NotFinite {
        /// Index of the point.
        index: usize,
    },
    /// No centre sees (nearly) the whole surface.
    #[error(
        "the surface is not star-shaped: seen from the best centre, {:.1} % of its area faces away, \
         so the radius is not a function of the direction; rings, hooks and several bodies cannot \
         be fitted, a whole grain can",
        100.0 * share
    )]
    NotStarShaped {
        /// Share of the area that faces away from the best centre.
        share: f64,
    },
    /// Too many points do not belong to the surface that the others draw.
    #[error(
        "{:.0} % of the points stand apart from their neighbours by more than a tenth of the \
         radius; a scan of one grain has below 1 % of such outliers: remove the background, or cut \
         out one grain",
        100.0 * share
    )]
    Strays {
        /// Share of such points.
        share: f64,
    },
    /// Points seen in nearly the same direction lie at very different distances.
    #[error(
        "the points are not one surface round a centre: in neighbouring directions their distance \
         from it differs by {:.0} % (median), where a scanned grain shows below 5 %; it may be \
         a ring, several bodies, or a scene with its background: cut out one grain",
        100.0 * scatter
    )]
    Scattered {
        /// Standard deviation of the radius against the neighbours' median.
        scatter: f64,
    },
}

impl FitOptions {
    /// The degrees and the parts per angle of the candidates.
    pub(crate) fn candidates(&self) -> Result<(Vec<usize>, Vec<usize>), FitError> {
        let within = |setting, value, most| {
            if value > most {
                return Err(FitError::OutOfRange {
                    setting,
                    value,
                    least: 0,
                    most,
                });
            }
            Ok(())
        };
        within(
            "the degree",
            self.degree.unwrap_or(self.max_degree),
            MAX_DEGREE,
        )?;
        let most = self.segments.unwrap_or(self.max_segments);
        if most == 0 || most > MAX_PARTS * MAX_PARTS {
            return Err(FitError::OutOfRange {
                setting: "the number of segments",
                value: most,
                least: 1,
                most: MAX_PARTS * MAX_PARTS,
            });
        }
        if let Tolerance::Length(value) | Tolerance::OfMeanRadius(value) = self.tolerance
            && !(value > 0.0 && value.is_finite())
        {
            return Err(FitError::Tolerance { value });
        }
        let degrees = self
            .degree
            .map_or_else(|| (0..=self.max_degree).collect(), |degree| vec![degree]);
        let root = most.isqrt();
        let parts = match self.segments {
            None => (1..=root).collect(),
            Some(segments) if root * root == segments => vec![root],
            Some(segments) => {
                return Err(FitError::SegmentsNotSquare {
                    segments,
                    below: root * root,
                    above: (root + 1) * (root + 1),
                });
            }
        };
        Ok((degrees, parts))
    }
}
