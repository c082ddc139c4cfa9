//! The fitted grain: a star-shaped surface and where it lies in the scan.

use super::{
    Blended, CurvatureErrors, Derivatives, Frame, Mirrored, Segmented, StarSurface, Stretch, Whole,
};
use crate::scan::plural;
use nalgebra::{Matrix3, Point3, Vector3};
use rayon::prelude::*;

/// A star-shaped surface whose radius is made of expansions in spherical harmonics.
///
/// Directions and positions are those of the scan. The radius is measured from [`Frame::centre`]. The
/// expansions are those of the grain stretched along its own axes, see [`Grain::stretched`].
#[derive(Debug, Clone)]
pub struct Grain {
    frame: Frame,
    stretch: Stretch,
    surface: Surface,
    curvature_errors: Option<CurvatureErrors>,
}

/// How expansions make a surface.
#[derive(Debug, Clone)]
pub enum Surface {
    /// Overlapping expansions, blended: continuous with two derivatives.
    Blended(Blended),
    /// Independent expansions, one per segment: the radius may jump where they meet
    /// ([`Grain::seam_jump`] says by how much).
    Segmented(Segmented),
    /// One expansion and its mirror images: continuous, with edges on the mirror planes.
    Mirrored(Mirrored),
    /// One expansion of the whole sphere: smooth.
    Whole(Whole),
}

impl Surface {
    /// The blended surface, if it is one.
    pub fn blended(&self) -> Option<&Blended> {
        match self {
            Self::Blended(surface) => Some(surface),
            _ => None,
        }
    }

    /// The surface of independent segments, if it is one.
    pub fn segmented(&self) -> Option<&Segmented> {
        match self {
            Self::Segmented(surface) => Some(surface),
            _ => None,
        }
    }

    /// The expansion with mirror images, if it is one.
    pub fn mirrored(&self) -> Option<&Mirrored> {
        match self {
            Self::Mirrored(surface) => Some(surface),
            _ => None,
        }
    }

    /// The expansion of the whole sphere, if it is one.
    pub fn whole(&self) -> Option<&Whole> {
        match self {
            Self::Whole(surface) => Some(surface),
            _ => None,
        }
    }

    /// Radius in a direction of the stretched space.
    fn radius(&self, n: &Vector3<f64>) -> f64 {
        match self {
            Self::Blended(surface) => surface.radius(n),
            Self::Segmented(surface) => surface.radius(n),
            Self::Mirrored(surface) => surface.radius(n),
            Self::Whole(surface) => surface.radius(n),
        }
    }

    /// Radius and surface gradient, likewise.
    fn radius_and_gradient(&self, n: &Vector3<f64>) -> (f64, Vector3<f64>) {
        match self {
            Self::Blended(surface) => surface.radius_and_gradient(n),
            Self::Segmented(surface) => surface.radius_and_gradient(n),
            Self::Mirrored(surface) => surface.radius_and_gradient(n),
            Self::Whole(surface) => surface.radius_and_gradient(n),
        }
    }

    /// Radius and its derivatives on the sphere, likewise.
    fn derivatives(&self, n: &Vector3<f64>) -> Derivatives {
        let jet = match self {
            Self::Blended(surface) => surface.jet(n),
            Self::Segmented(surface) => surface.jet(n),
            Self::Mirrored(surface) => surface.jet(n),
            Self::Whole(surface) => surface.jet(n),
        };
        Derivatives::on_sphere(n, &jet)
    }

    /// Radii in many directions, likewise.
    fn radii(&self, directions: &[Vector3<f64>]) -> Vec<f64> {
        match self {
            Self::Blended(surface) => surface
                .radii_and_gradients(directions)
                .into_iter()
                .map(|(radius, _)| radius)
                .collect(),
            Self::Whole(surface) => surface.radii(directions),
            Self::Segmented(_) | Self::Mirrored(_) => {
                let tasks = directions.par_iter().with_min_len(1024);
                tasks.map(|n| self.radius(n)).collect()
            }
        }
    }
}

/// Why parts do not make a grain.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum InvalidGrain {
    /// The number of expansions is not that of the segments.
    #[error("{found} expansions for {expected} segments")]
    SegmentCount {
        /// Expansions given.
        found: usize,
        /// Segments of the partition.
        expected: usize,
    },
    /// The number of coefficients is not a square: (L+1)^2 for degree L.
    #[error("segment {segment} has {}; (L + 1)^2 are expected for degree L", plural(*found, "coefficient"))]
    CoefficientCount {
        /// Index of the segment.
        segment: usize,
        /// Coefficients given.
        found: usize,
    },
    /// An expansion is of too high a degree.
    #[error("degree {found}; at most {} is allowed", Whole::MAX_DEGREE)]
    Degree {
        /// The degree of the coefficients given.
        found: usize,
    },
    /// Factors that are no stretch.
    #[error(
        "a stretch by {factors:?}: its factors must be above zero and within 1e6 of each other"
    )]
    Stretch {
        /// The factors given.
        factors: [f64; 3],
    },
    /// A number is not finite.
    #[error("{what} is not finite")]
    NotFinite {
        /// What the number is.
        what: String,
    },
    /// The radius is not above zero in some direction: the coefficients were changed, or the fit failed there.
    #[error("the radius is {radius:.3e} in the direction {direction:.3?}: it must be above zero")]
    NotPositive {
        /// The radius.
        radius: f64,
        /// The direction, in the scan's frame.
        direction: [f64; 3],
    },
    /// The radius could not be shown to be above zero everywhere.
    #[error(
        "the radius cannot be shown to be above zero everywhere; the least one met is {found:.3e}"
    )]
    Unproved {
        /// The least radius met.
        found: f64,
    },
    /// Radii beyond 1e100, or below its inverse.
    #[error("radii are beyond 1e100 or below 1e-100: change the unit")]
    OutOfRange,
    /// The axes are not orthonormal and right-handed.
    #[error("the axes are not orthonormal and right-handed")]
    Axes,
}

/// How far axes may be from orthonormal: the rounding of a file with fewer digits than f64 has.
const AXES_TOLERANCE: f64 = 1e-9;

impl Grain {
    /// A grain from its parts, not stretched.
    ///
    /// # Errors
    /// [`InvalidGrain`] if the frame is not orthonormal or not finite.
    pub fn new(frame: Frame, surface: Surface) -> Result<Self, InvalidGrain> {
        Self::stretched(frame, Stretch::NONE, surface)
    }

    /// A grain whose `surface` is that of the grain stretched along the axes of the frame: with
    /// T = diag of the factors and r' the radius of the surface, r(n) = r'(T n / |T n|) / |T n| for a
    /// unit vector n of the frame.
    ///
    /// # Errors
    /// [`InvalidGrain`] if the frame is not orthonormal or not finite.
    pub fn stretched(
        frame: Frame,
        stretch: Stretch,
        surface: Surface,
    ) -> Result<Self, InvalidGrain> {
        if !frame.centre.iter().all(|x| x.is_finite()) {
            return Err(InvalidGrain::NotFinite {
                what: "the centre".into(),
            });
        }
        let deviation = frame.axes.tr_mul(&frame.axes) - Matrix3::identity();
        // Written so that NaN fails.
        if !(deviation.amax() < AXES_TOLERANCE && frame.axes.determinant() > 0.0) {
            return Err(InvalidGrain::Axes);
        }
        Ok(Self {
            frame,
            stretch,
            surface,
            curvature_errors: None,
        })
    }

    /// The grain about the origin, so many times as large.
    pub(crate) fn about_origin(&self, factor: f64) -> Self {
        Self {
            frame: Frame {
                centre: Point3::origin(),
                ..self.frame
            },
            stretch: self.stretch,
            surface: match &self.surface {
                Surface::Blended(surface) => Surface::Blended(surface.times(factor)),
                Surface::Segmented(surface) => Surface::Segmented(surface.times(factor)),
                Surface::Mirrored(surface) => Surface::Mirrored(surface.times(factor)),
                Surface::Whole(surface) => Surface::Whole(surface.times(factor)),
            },
            curvature_errors: self.curvature_errors.as_ref().map(|e| e.over(factor)),
        }
    }

    /// The grain, with what is known of the errors of its curvature.
    #[must_use]
    pub fn with_curvature_errors(self, errors: CurvatureErrors) -> Self {
        Self {
            curvature_errors: Some(errors),
            ..self
        }
    }

    /// Errors of its curvature, where they are known.
    pub fn curvature_errors(&self) -> Option<&CurvatureErrors> {
        self.curvature_errors.as_ref()
    }

    /// Standard error of the curvature in a direction of the scan's frame, in one over the scan's unit, where it is known.
    pub fn curvature_error(&self, n: &Vector3<f64>) -> Option<f64> {
        let errors = self.curvature_errors.as_ref()?;
        Some(errors.at(&self.frame.axes.tr_mul(n)))
    }

    /// Centre and axes in the scan.
    pub fn frame(&self) -> &Frame {
        &self.frame
    }

    /// The stretch along the axes of the frame after which the grain is the [surface](Self::surface).
    pub fn stretch(&self) -> &Stretch {
        &self.stretch
    }

    /// The surface, in the grain's own frame, of the [stretched](Self::stretch) grain.
    pub fn surface(&self) -> &Surface {
        &self.surface
    }

    /// Coefficients per segment: (L+1)^2 numbers in the scan's unit. Of the whole sphere those of the
    /// harmonics, else of the cap basis.
    pub fn coefficients(&self) -> &[Vec<f64>] {
        match &self.surface {
            Surface::Blended(surface) => surface.coefficients(),
            Surface::Segmented(surface) => surface.coefficients(),
            Surface::Mirrored(surface) => std::slice::from_ref(&surface.coefficients),
            Surface::Whole(surface) => std::slice::from_ref(&surface.coefficients),
        }
    }

    /// The number of segments, that is of expansions.
    pub fn segments(&self) -> usize {
        self.coefficients().len()
    }

    /// The largest degree of any segment.
    pub fn degree(&self) -> usize {
        match &self.surface {
            Surface::Blended(surface) => surface.degree(),
            Surface::Segmented(surface) => surface.degree(),
            Surface::Mirrored(surface) => surface.degree(),
            Surface::Whole(surface) => surface.degree(),
        }
    }

    /// The number of coefficients of all segments together.
    pub fn coefficient_count(&self) -> usize {
        self.coefficients().iter().map(Vec::len).sum()
    }

    /// The number of coefficients that one evaluation touches, as a mean over all directions.
    pub fn coefficients_touched(&self) -> f64 {
        match &self.surface {
            Surface::Blended(surface) => surface.coefficients_touched(),
            Surface::Segmented(surface) => {
                let partition = surface.partition();
                let counts = surface.coefficients().iter().enumerate();
                counts
                    .map(|(i, own)| partition.rectangle(i).solid_angle() * own.len() as f64)
                    .sum::<f64>()
                    / (4.0 * std::f64::consts::PI)
            }
            Surface::Mirrored(surface) => surface.coefficients().len() as f64,
            Surface::Whole(surface) => surface.coefficients().len() as f64,
        }
    }

    /// The surface point in the direction of the unit vector `n`, in the scan's frame.
    pub fn point(&self, n: &Vector3<f64>) -> Point3<f64> {
        self.frame.centre + n * self.radius(n)
    }

    /// The outward unit normal in the direction of the unit vector `n`, in the scan's frame.
    pub fn normal(&self, n: &Vector3<f64>) -> Vector3<f64> {
        let (radius, gradient) = self.radius_and_gradient(n);
        (n * radius - gradient).normalize()
    }

    /// The radii in the directions of many unit vectors, in the scan's frame: as
    /// [`StarSurface::radius`], and faster.
    pub fn radii(&self, directions: &[Vector3<f64>]) -> Vec<f64> {
        let axes = self.frame.axes;
        let local: Vec<_> = directions.par_iter().map(|n| axes.tr_mul(n)).collect();
        self.local_radii(&local)
    }

    /// Radii in many directions of the grain's own frame.
    pub(crate) fn local_radii(&self, directions: &[Vector3<f64>]) -> Vec<f64> {
        if self.stretch.is_none() {
            return self.surface.radii(directions);
        }
        let mapped = directions.par_iter().map(|n| self.stretch.direction(n));
        let (mapped, lengths): (Vec<_>, Vec<_>) = mapped.unzip();
        let radii = self.surface.radii(&mapped).into_iter().zip(lengths);
        radii.map(|(radius, length)| radius / length).collect()
    }
}

/// The degree of an expansion of a segment, if it is one.
pub(super) fn check_expansion(segment: usize, coefficients: &[f64]) -> Result<usize, InvalidGrain> {
    let root = coefficients.len().isqrt();
    if root == 0 || root * root != coefficients.len() {
        return Err(InvalidGrain::CoefficientCount {
            segment,
            found: coefficients.len(),
        });
    }
    if !coefficients.iter().all(|x| x.is_finite()) {
        return Err(InvalidGrain::NotFinite {
            what: format!("a coefficient of segment {segment}"),
        });
    }
    if root - 1 > Whole::MAX_DEGREE {
        return Err(InvalidGrain::Degree { found: root - 1 });
    }
    Ok(root - 1)
}

impl StarSurface for Grain {
    fn radius(&self, n: &Vector3<f64>) -> f64 {
        let local = self.frame.axes.tr_mul(n);
        self.stretch.radius(&local, |q| self.surface.radius(q))
    }

    fn radius_and_gradient(&self, n: &Vector3<f64>) -> (f64, Vector3<f64>) {
        let local = self.frame.axes.tr_mul(n);
        let (radius, gradient) = self
            .stretch
            .radius_and_gradient(&local, |q| self.surface.radius_and_gradient(q));
        (radius, self.frame.axes * gradient)
    }

    fn derivatives(&self, n: &Vector3<f64>) -> Derivatives {
        let local = self.frame.axes.tr_mul(n);
        let derivatives = self
            .stretch
            .derivatives(&local, |q| self.surface.derivatives(q));
        derivatives.turned(&self.frame.axes)
    }
}
