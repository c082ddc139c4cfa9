//! What can be scanned from one centre: the bodies by name, and superquadrics.

use super::{AxesError, Body, Solid};
use crate::measure::{Integrals, integrate, superquadric_properties};
use crate::model::Superquadric;
use nalgebra::Vector3;
use std::fmt;

/// Points of a scan of a superquadric where no number is given.
const SUPERQUADRIC_POINTS: usize = 6146;

/// Relative tolerance of a superquadric's mean radius, whose edges are sharp where exponents are large.
const MEAN_RADIUS_TOLERANCE: f64 = 1e-6;

/// A body that is star-shaped about its origin, and whose truth is known.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub enum Subject {
    /// A body by its name.
    Body(Body),
    /// A superquadric.
    Superquadric(Superquadric),
}

impl From<Body> for Subject {
    fn from(body: Body) -> Self {
        Self::Body(body)
    }
}

impl From<Superquadric> for Subject {
    fn from(body: Superquadric) -> Self {
        Self::Superquadric(body)
    }
}

impl Subject {
    /// The name, in lower case.
    pub fn name(&self) -> &'static str {
        match self {
            Self::Body(body) => body.name(),
            Self::Superquadric(body) if body.is_single() => "superquadric",
            Self::Superquadric(_) => "poly",
        }
    }

    /// Number of points of a scan where none is given.
    pub fn native_points(&self) -> usize {
        match self {
            Self::Body(body) => body.native_points(),
            Self::Superquadric(_) => SUPERQUADRIC_POINTS,
        }
    }

    /// Semi-axes along x, y and z, those on the negative side too where they differ; none of a grain. `asked` are those
    /// asked for of a shape.
    pub fn semi_axes(&self, asked: Option<Vector3<f64>>) -> Option<Vec<f64>> {
        match self {
            Self::Body(body) => {
                let axes = asked.or(body.native_axes())?;
                Some(axes.iter().copied().collect())
            }
            Self::Superquadric(body) => {
                let axes = body.semi_axes();
                Some(match axes.iter().all(|[one, other]| one == other) {
                    true => axes.map(|[axis, _]| axis).to_vec(),
                    false => axes.into_iter().flatten().collect(),
                })
            }
        }
    }

    /// The surface, with these semi-axes where they are asked for.
    ///
    /// # Errors
    /// When the body cannot have these semi-axes.
    pub(super) fn surface(&self, axes: Option<Vector3<f64>>) -> Result<Box<dyn Solid>, AxesError> {
        match (self, axes) {
            (Self::Body(body), Some(axes)) => body.with_axes(axes),
            (Self::Body(body), None) => Ok(body.surface()),
            (Self::Superquadric(body), None) => Ok(Box::new(*body)),
            (Self::Superquadric(_), Some(_)) => Err(AxesError::Superquadric),
        }
    }
}

impl fmt::Display for Subject {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

impl Solid for Superquadric {
    /// Volume, centroid and inertia in closed form, area and mean radius by quadrature.
    fn integrals(&self) -> Integrals {
        let found = superquadric_properties(self);
        let radii = integrate(self, MEAN_RADIUS_TOLERANCE);
        Integrals {
            properties: found.properties,
            relative_error: found.area_error.max(f64::EPSILON),
            ..radii
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shapes::{SynthOptions, synthesize};
    use approx::assert_relative_eq;
    use std::f64::consts::PI;

    #[test]
    fn points_of_a_superquadric_lie_on_it_and_its_volume_is_the_closed_form() {
        let body = Superquadric::single([2.0, 2.0, 1.0], 4.0, 2.0).unwrap();
        let scan = synthesize(&SynthOptions::clean(body)).unwrap();
        for p in &scan.points {
            let gauge = (p.x.hypot(p.y) / 2.0).powi(4) + p.z.powi(4);
            assert_relative_eq!(gauge, 1.0, max_relative = 1e-12);
        }
        // 2 pi a² times the integral of (1 - z⁴)^(1/2) from 0 to 1.
        let volume = scan.truth.properties.volume;
        assert_relative_eq!(
            volume,
            8.0 * PI * 0.874_019_184_764_04,
            max_relative = 1e-12
        );
    }
}
