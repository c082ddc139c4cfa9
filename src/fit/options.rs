//! What a user may ask of a fit.

use super::error::FitError;
use crate::sphere::{MAX_FACE_PARTS, Symmetry, coefficient_count};

/// Settings of a fit; the default asks for nothing and searches.
///
/// ```
/// use grainform::{FitOptions, Tolerance};
///
/// let options = FitOptions::default()
///     .with_tolerance(Tolerance::OfMeanRadius(0.005))
///     .with_max_degree(3);
/// assert!(options.check().is_ok());
/// assert!(options.with_segments(7).check().is_err());
/// ```
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct FitOptions {
    /// What surface is fitted.
    pub kind: Kind,
    /// How expansions are joined.
    pub seams: Seams,
    /// Mirror planes through the centre, normal to the scan's own axes. With any, one expansion is
    /// fitted to the part of the sphere that they leave, and mirrored; there are no segments then.
    pub symmetry: Symmetry,
    /// Degree of every segment's expansion; `None` searches up to `max_degree`.
    pub degree: Option<usize>,
    /// Number of segments. Blended: 1 for the estimate itself, an expansion of the whole sphere, or 6 n^2 cells;
    /// `None` refines adaptively. Independent: k^2; `None` searches all squares up to `max_segments`.
    pub segments: Option<usize>,
    /// Largest degree searched; `None` for 4 in blended cells and 3 elsewhere. Positions are searched up to degree 7 over
    /// the whole sphere and 3 in cells, and not beyond this in either.
    pub max_degree: Option<usize>,
    /// Largest number of segments searched, and not below `segments`; `None` for [`Seams::most_segments`].
    pub max_segments: Option<usize>,
    /// Error that is good enough.
    pub tolerance: Tolerance,
    /// Fit every candidate, also those that cannot win any more. The choice is the same.
    pub exhaustive: bool,
}

impl Default for FitOptions {
    fn default() -> Self {
        Self {
            kind: Kind::Auto,
            seams: Seams::Blended,
            symmetry: Symmetry::NONE,
            degree: None,
            segments: None,
            max_degree: None,
            max_segments: None,
            tolerance: Tolerance::Auto,
            exhaustive: false,
        }
    }
}

/// The kinds of surfaces.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum Kind {
    /// A radius; where it hides area, ends above its limit or is steep, the better of it and of positions, and where no
    /// radius follows the points, or they lie between voxels, positions.
    Auto,
    /// A radius in every direction from a centre.
    Star,
    /// The position of points over the sphere: any one closed surface without handles.
    Position,
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
    /// 0.03 % of the mean radius. In every case a third of the estimate's own standard deviation is good enough, or a
    /// quarter to a half where what it leaves of the points is no noise.
    Auto,
    /// In the scan's unit.
    Length(f64),
    /// As a fraction of the mean radius.
    OfMeanRadius(f64),
}

/// How far points may be from the surface that was asked for, as a share of the mean radius (RMS), and how wide a tolerance may be.
pub(in crate::fit) const FARTHEST: f64 = 0.25;

impl Tolerance {
    /// Refuses a tolerance that is wide beside this mean radius.
    pub(in crate::fit) fn check(&self, mean_radius: f64) -> Result<(), FitError> {
        let tolerance = self.length(mean_radius);
        match tolerance > FARTHEST * mean_radius {
            true => Err(FitError::WideTolerance {
                tolerance,
                mean_radius,
            }),
            false => Ok(()),
        }
    }

    /// The tolerance in the unit of the mean radius.
    pub fn length(&self, mean_radius: f64) -> f64 {
        match *self {
            Self::Auto => AUTO_TOLERANCE * mean_radius,
            Self::Length(length) => length,
            Self::OfMeanRadius(fraction) => fraction * mean_radius,
        }
    }

    /// The same as a share of the mean radius, where it is one.
    pub(crate) fn share(&self) -> Option<f64> {
        match *self {
            Self::Auto => Some(AUTO_TOLERANCE),
            Self::Length(_) => None,
            Self::OfMeanRadius(fraction) => Some(fraction),
        }
    }
}

/// The fewest cells: one on each face of the cube.
pub(super) const FEWEST_CELLS: usize = 6;

/// The tolerance of [`Tolerance::Auto`] as a share of the mean radius.
const AUTO_TOLERANCE: f64 = 0.0003;

/// Largest degree that can be asked for: beyond it one segment holds more coefficients than most
/// scans have points to give.
pub const MAX_DEGREE: usize = 20;

/// Largest degree of an expansion of the whole sphere that can be asked for.
pub const MAX_WHOLE_DEGREE: usize = 80;

/// Largest degree of blended cells where nothing else is asked for.
const MOST_DEGREE_OF_CELLS: usize = 4;

/// Largest degree of expansions that are fitted to the points themselves where nothing else is asked for.
const MOST_DEGREE_SEARCHED: usize = 3;

/// Largest number of parts per angle that can be asked for.
pub const MAX_PARTS: usize = 64;

/// Largest number of blended cells that can be asked for: 6 x 64^2.
pub const MAX_CELLS: usize = 6 * (MAX_FACE_PARTS as usize) * (MAX_FACE_PARTS as usize);

/// Largest number of coefficients of blended cells that can be asked for: a minute of work.
pub const MAX_COEFFICIENTS: usize = 20_000;

/// Each sets one field; a number can be given as it is.
impl FitOptions {
    /// The same with another [`kind`](Self::kind) of surface.
    pub fn with_kind(self, kind: Kind) -> Self {
        Self { kind, ..self }
    }

    /// The same with other [`seams`](Self::seams).
    pub fn with_seams(self, seams: Seams) -> Self {
        Self { seams, ..self }
    }

    /// The same with another [`symmetry`](Self::symmetry).
    pub fn with_symmetry(self, symmetry: Symmetry) -> Self {
        Self { symmetry, ..self }
    }

    /// The same with this [`degree`](Self::degree).
    pub fn with_degree(self, degree: impl Into<Option<usize>>) -> Self {
        let degree = degree.into();
        Self { degree, ..self }
    }

    /// The same with this number of [`segments`](Self::segments).
    pub fn with_segments(self, segments: impl Into<Option<usize>>) -> Self {
        let segments = segments.into();
        Self { segments, ..self }
    }

    /// The same with this [`max_degree`](Self::max_degree).
    pub fn with_max_degree(self, max_degree: impl Into<Option<usize>>) -> Self {
        let max_degree = max_degree.into();
        Self { max_degree, ..self }
    }

    /// The same with this [`max_segments`](Self::max_segments).
    pub fn with_max_segments(self, max_segments: impl Into<Option<usize>>) -> Self {
        let max_segments = max_segments.into();
        Self {
            max_segments,
            ..self
        }
    }

    /// The same with another [`tolerance`](Self::tolerance).
    pub fn with_tolerance(self, tolerance: Tolerance) -> Self {
        Self { tolerance, ..self }
    }

    /// The same, fitting [every candidate](Self::exhaustive) or not.
    pub fn with_exhaustive(self, exhaustive: bool) -> Self {
        Self { exhaustive, ..self }
    }
}

impl FitOptions {
    /// Checks that every setting is in range and that they go together.
    ///
    /// # Errors
    /// [`FitError`] names the setting.
    pub fn check(&self) -> Result<(), FitError> {
        let most = match (self.seams, self.segments) {
            (Seams::Blended, Some(1)) => MAX_WHOLE_DEGREE,
            _ => MAX_DEGREE,
        };
        within(
            "the degree",
            self.degree.unwrap_or(self.top_degree()),
            0,
            most,
        )?;
        if let Tolerance::Length(value) | Tolerance::OfMeanRadius(value) = self.tolerance
            && !(value > 0.0 && value.is_finite())
        {
            return Err(FitError::Tolerance { value });
        }
        let segments = self.segments.or(self.max_segments);
        if self.symmetry != Symmetry::NONE && (self.seams != Seams::Blended || segments.is_some()) {
            return Err(FitError::SymmetryOfSegments);
        }
        if let (Some(segments), Some(most)) = (self.segments, self.max_segments) {
            within(
                "the number of segments beside a largest one (--max-segments)",
                segments,
                1,
                most,
            )?;
        }
        if self.kind == Kind::Position && self.is_degree_zero() {
            return Err(FitError::PointOfDegreeZero);
        }
        if self.kind == Kind::Position
            && (self.symmetry != Symmetry::NONE || self.seams != Seams::Blended)
        {
            return Err(FitError::OnlyOfRadii);
        }
        match self.seams {
            Seams::Blended => self.check_cells(),
            Seams::None => self.parts().map(drop),
        }
    }

    /// The largest degree of a segment.
    pub(crate) fn top_degree(&self) -> usize {
        let searched = match self.seams {
            Seams::Blended if self.symmetry == Symmetry::NONE => MOST_DEGREE_OF_CELLS,
            _ => MOST_DEGREE_SEARCHED,
        };
        self.degree.or(self.max_degree).unwrap_or(searched)
    }

    /// Whether positions would be points.
    pub(super) fn is_degree_zero(&self) -> bool {
        self.top_degree() == 0
    }

    /// The degrees of the candidates that are fitted to the points themselves.
    pub(crate) fn degrees(&self) -> Vec<usize> {
        match self.degree {
            Some(degree) => vec![degree],
            None => (0..=self.top_degree()).collect(),
        }
    }

    /// The largest number of segments searched.
    pub(crate) fn most_segments(&self) -> usize {
        self.max_segments.unwrap_or(self.seams.most_segments())
    }

    /// Whether nothing was asked for that bounds the search of a radius, which may then be far from points that it sees.
    pub(super) fn is_unbounded(&self) -> bool {
        let usual = Self::default();
        self.max_degree == usual.max_degree
            && self.max_segments == usual.max_segments
            && self.degree.is_none()
            && self.segments.is_none()
    }

    /// Whether fewer segments are allowed than there are cells at least, so that the whole sphere is one.
    pub(super) fn is_without_cells(&self) -> bool {
        self.segments.is_none() && self.most_segments() < FEWEST_CELLS
    }

    /// Parts per angle of the candidates of independent segments.
    pub(crate) fn parts(&self) -> Result<Vec<usize>, FitError> {
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

    /// Blended segments are 1, or 6 n^2 cells.
    fn check_cells(&self) -> Result<(), FitError> {
        let most = self.segments.unwrap_or(self.most_segments());
        within("the number of segments", most, 1, MAX_CELLS)?;
        let Some(segments) = self.segments.filter(|&segments| segments > 1) else {
            return Ok(());
        };
        within(
            "the number of coefficients",
            segments * coefficient_count(self.top_degree()),
            1,
            MAX_COEFFICIENTS,
        )?;
        let parts = (segments / 6).isqrt();
        if parts > 0 && 6 * parts * parts == segments {
            return Ok(());
        }
        let parts = parts.max(1);
        Err(FitError::SegmentsNotOfCube {
            segments,
            below: 6 * parts * parts,
            above: 6 * (parts + 1) * (parts + 1),
        })
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
