//! The fitted grain: a star-shaped surface and where it lies in the scan.

use super::{Blended, Derivatives, Frame, Mirrored, Segmented, StarSurface};
use nalgebra::{Matrix3, Point3, Vector3};
use rayon::prelude::*;

/// A star-shaped surface whose radius is made of expansions in spherical harmonics of low degree.
///
/// Directions and positions are those of the scan. The radius is measured from [`Frame::centre`].
#[derive(Debug, Clone)]
pub struct Grain {
    frame: Frame,
    surface: Surface,
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
    #[error("segment {segment} has {found} coefficients; (L + 1)^2 are expected for degree L")]
    CoefficientCount {
        /// Index of the segment.
        segment: usize,
        /// Coefficients given.
        found: usize,
    },
    /// A number is not finite.
    #[error("{what} is not finite")]
    NotFinite {
        /// What the number is.
        what: String,
    },
    /// The axes are not orthonormal and right-handed.
    #[error("the axes are not orthonormal and right-handed")]
    Axes,
}

/// How far axes may be from orthonormal: the rounding of a file with fewer digits than f64 has.
const AXES_TOLERANCE: f64 = 1e-9;

impl Grain {
    /// A grain from its parts.
    ///
    /// # Errors
    /// [`InvalidGrain`] if the frame is not orthonormal or not finite.
    pub fn new(frame: Frame, surface: Surface) -> Result<Self, InvalidGrain> {
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
        Ok(Self { frame, surface })
    }

    /// Centre and axes in the scan.
    pub fn frame(&self) -> &Frame {
        &self.frame
    }

    /// The surface, in the grain's own frame.
    pub fn surface(&self) -> &Surface {
        &self.surface
    }

    /// Cap-basis coefficients per segment: (L+1)^2 numbers in the scan's unit.
    pub fn coefficients(&self) -> &[Vec<f64>] {
        match &self.surface {
            Surface::Blended(surface) => surface.coefficients(),
            Surface::Segmented(surface) => surface.coefficients(),
            Surface::Mirrored(surface) => std::slice::from_ref(&surface.coefficients),
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
        match &self.surface {
            Surface::Blended(surface) => surface
                .radii_and_gradients(directions)
                .into_iter()
                .map(|(radius, _)| radius)
                .collect(),
            Surface::Segmented(_) | Surface::Mirrored(_) => {
                let tasks = directions.par_iter().with_min_len(1024);
                tasks.map(|n| self.local_radius(n)).collect()
            }
        }
    }

    /// Radius in a direction of the grain's own frame.
    fn local_radius(&self, n: &Vector3<f64>) -> f64 {
        match &self.surface {
            Surface::Blended(surface) => surface.radius(n),
            Surface::Segmented(surface) => surface.radius(n),
            Surface::Mirrored(surface) => surface.radius(n),
        }
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
    Ok(root - 1)
}

impl StarSurface for Grain {
    fn radius(&self, n: &Vector3<f64>) -> f64 {
        self.local_radius(&self.frame.axes.tr_mul(n))
    }

    fn radius_and_gradient(&self, n: &Vector3<f64>) -> (f64, Vector3<f64>) {
        let local = self.frame.axes.tr_mul(n);
        let (radius, gradient) = match &self.surface {
            Surface::Blended(surface) => surface.radius_and_gradient(&local),
            Surface::Segmented(surface) => surface.radius_and_gradient(&local),
            Surface::Mirrored(surface) => surface.radius_and_gradient(&local),
        };
        (radius, self.frame.axes * gradient)
    }
    fn derivatives(&self, n: &Vector3<f64>) -> Derivatives {
        let local = self.frame.axes.tr_mul(n);
        let jet = match &self.surface {
            Surface::Blended(surface) => surface.jet(&local),
            Surface::Segmented(surface) => surface.jet(&local),
            Surface::Mirrored(surface) => surface.jet(&local),
        };
        Derivatives::on_sphere(&local, &jet).turned(&self.frame.axes)
    }
}
