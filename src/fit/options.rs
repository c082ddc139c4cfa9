//! What a user may ask of a fit.

use crate::sphere::{MAX_FACE_PARTS, Symmetry, coefficient_count};

/// Settings of a fit; the default asks for nothing and searches.
#[derive(Debug, Clone, PartialEq)]
pub struct FitOptions {
    /// How expansions are joined.
    pub seams: Seams,
    /// Mirror planes through the centre, normal to the scan's own axes. With any, one expansion is
    /// fitted to the part of the sphere that they leave, and mirrored; there are no segments then.
    pub symmetry: Symmetry,
    /// Degree of every segment's expansion; `None` searches up to `max_degree`.
    pub degree: Option<usize>,
    /// Number of segments. Blended: 1, or 6 n^2 cells; `None` refines adaptively. Independent: k^2;
    /// `None` searches all squares up to `max_segments`.
    pub segments: Option<usize>,
    /// Largest degree searched.
    pub max_degree: usize,
    /// Largest number of segments searched; `None` for [`Seams::most_segments`].
    pub max_segments: Option<usize>,
    /// Error that is good enough.
    pub tolerance: Tolerance,
    /// Fit every candidate, also those that cannot win any more. The choice is the same.
    pub exhaustive: bool,
}

impl Default for FitOptions {
    fn default() -> Self {
        Self {
            seams: Seams::Blended,
            symmetry: Symmetry::NONE,
            degree: None,
            segments: None,
            max_degree: 3,
            max_segments: None,
            tolerance: Tolerance::Auto,
            exhaustive: false,
        }
    }
}

/// How the expansions of neighbouring segments are joined.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Seams {
    /// Overlapping cells on the faces of a cube, blended by smooth weights and fitted together: the
    /// surface is continuous, and so are its normals and curvatures.
    Blended,
    /// k x k segments of the angle domain, each fitted alone (dissertation, 4.1 and 4.2): the
    /// surface has steps where they meet.
    None,
}

impl Seams {
    /// The largest number of segments searched where nothing else is asked for.
    pub const fn most_segments(self) -> usize {
        match self {
            Self::Blended => 600,
            Self::None => 100,
        }
    }
}

/// A radial RMS error.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Tolerance {
    /// 0.1 % of the mean radius. In every case the scan's own noise is allowed on top.
    Auto,
    /// In the scan's unit.
    Length(f64),
    /// As a fraction of the mean radius.
    OfMeanRadius(f64),
}

impl Tolerance {
    /// The tolerance in the unit of the mean radius.
    pub fn length(&self, mean_radius: f64) -> f64 {
        match *self {
            Self::Auto => AUTO_TOLERANCE * mean_radius,
            Self::Length(length) => length,
            Self::OfMeanRadius(fraction) => fraction * mean_radius,
        }
    }
}

/// The tolerance of [`Tolerance::Auto`] as a share of the mean radius.
const AUTO_TOLERANCE: f64 = 0.001;

/// Largest degree that can be asked for: beyond it one segment holds more coefficients than most
/// scans have points to give.
pub const MAX_DEGREE: usize = 20;

/// Largest number of parts per angle that can be asked for.
pub const MAX_PARTS: usize = 64;

/// Largest number of blended cells that can be asked for: 6 x 64^2.
pub const MAX_CELLS: usize = 6 * (MAX_FACE_PARTS as usize) * (MAX_FACE_PARTS as usize);

/// Largest number of coefficients of blended cells that can be asked for: a minute of work.
pub const MAX_COEFFICIENTS: usize = 20_000;

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
    /// No uniform cover of the cube's faces has this number of cells.
    #[error(
        "{segments} segments cannot be blended: ask for 1, or for 6 n^2 cells on the faces of a cube \
         such as {below} or {above}, or for independent segments"
    )]
    SegmentsNotOfCube {
        /// The number asked for.
        segments: usize,
        /// The nearest possible number below.
        below: usize,
        /// The nearest possible number above.
        above: usize,
    },
    /// Segments are asked for, and mirrors too.
    #[error(
        "a fit with mirror planes is one expansion: neither independent segments nor a number of \
         segments can be asked for with it"
    )]
    SymmetryOfSegments,
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
    /// The degrees and the numbers of parts (per angle, or per edge of the cube) of the candidates;
    /// no parts where the cover is to be found adaptively.
    pub(crate) fn candidates(&self) -> Result<(Vec<usize>, Vec<usize>), FitError> {
        within(
            "the degree",
            self.degree.unwrap_or(self.max_degree),
            0,
            MAX_DEGREE,
        )?;
        if let Tolerance::Length(value) | Tolerance::OfMeanRadius(value) = self.tolerance
            && !(value > 0.0 && value.is_finite())
        {
            return Err(FitError::Tolerance { value });
        }
        let degrees = self
            .degree
            .map_or_else(|| (0..=self.max_degree).collect(), |degree| vec![degree]);
        let segments = self.segments.or(self.max_segments);
        if self.symmetry != Symmetry::NONE && (self.seams != Seams::Blended || segments.is_some()) {
            return Err(FitError::SymmetryOfSegments);
        }
        let parts = match self.seams {
            Seams::Blended => self.parts_of_faces()?,
            Seams::None => self.parts_of_angles()?,
        };
        Ok((degrees, parts))
    }

    /// The largest number of segments searched.
    pub(crate) fn most_segments(&self) -> usize {
        self.max_segments.unwrap_or(self.seams.most_segments())
    }

    fn parts_of_angles(&self) -> Result<Vec<usize>, FitError> {
        let most = self.segments.unwrap_or(self.most_segments());
        within("the number of segments", most, 1, MAX_PARTS * MAX_PARTS)?;
        let root = most.isqrt();
        match self.segments {
            None => Ok((1..=root).collect()),
            Some(segments) if root * root == segments => Ok(vec![root]),
            Some(segments) => Err(FitError::SegmentsNotSquare {
                segments,
                below: root * root,
                above: (root + 1) * (root + 1),
            }),
        }
    }

    /// Parts per edge of the cube's faces, 0 for the whole sphere.
    fn parts_of_faces(&self) -> Result<Vec<usize>, FitError> {
        let most = self.segments.unwrap_or(self.most_segments());
        within("the number of segments", most, 1, MAX_CELLS)?;
        let parts = (most / 6).isqrt();
        match self.segments {
            None => Ok(Vec::new()),
            Some(1) => Ok(vec![0]),
            Some(segments)
                if segments * coefficient_count(self.degree.unwrap_or(self.max_degree))
                    > MAX_COEFFICIENTS =>
            {
                Err(FitError::OutOfRange {
                    setting: "the number of coefficients",
                    value: segments * coefficient_count(self.degree.unwrap_or(self.max_degree)),
                    least: 1,
                    most: MAX_COEFFICIENTS,
                })
            }
            Some(segments) if parts > 0 && 6 * parts * parts == segments => Ok(vec![parts]),
            Some(segments) => Err(FitError::SegmentsNotOfCube {
                segments,
                below: (6 * parts * parts).max(1),
                above: 6 * (parts + 1) * (parts + 1),
            }),
        }
    }
}

fn within(setting: &'static str, value: usize, least: usize, most: usize) -> Result<(), FitError> {
    if (least..=most).contains(&value) {
        return Ok(());
    }
    Err(FitError::OutOfRange {
        setting,
        value,
        least,
        most,
    })
}
