//! The ellipsoid that has a body's volume moments.

use crate::measure::MassProperties;
use nalgebra::{Matrix3, Point3, Vector3};

/// The ellipsoid with a body's centroid, principal axes and ratios of second moments to volume.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct EquivalentEllipsoid {
    /// Centre: the body's centroid.
    pub centre: Point3<f64>,
    /// Semi-axes, descending: sqrt(5 m_i / V), with m_i = ∫ x_i² dV along the principal axes. Of an
    /// ellipsoid, its own.
    pub semi_axes: Vector3<f64>,
    /// Unit axes in the columns, in the order of the semi-axes: a rotation.
    pub axes: Matrix3<f64>,
}

impl EquivalentEllipsoid {
    /// The ellipsoid of equal moments of a body with these properties; `None` where they are not those of a solid.
    pub fn new(properties: &MassProperties) -> Option<Self> {
        let principal = properties.principal()?;
        // ∫ x_i² dV is half the trace less the moment about the axis i.
        let half_trace = 0.5 * principal.moments.sum();
        let squares = principal
            .moments
            .map(|moment| 5.0 * (half_trace - moment) / properties.volume);
        // Written so that NaN fails.
        if !squares.iter().all(|&square| square > 0.0) {
            return None;
        }
        Some(Self {
            centre: properties.centroid,
            semi_axes: squares.map(f64::sqrt),
            axes: principal.axes,
        })
    }

    /// Its radius from its centre in the direction of the unit vector `n`.
    pub fn radius(&self, n: &Vector3<f64>) -> f64 {
        1.0 / self.axes.tr_mul(n).component_div(&self.semi_axes).norm()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shapes::{Body, Ellipsoid, Solid};
    use approx::assert_relative_eq;

    #[test]
    fn an_ellipsoid_is_its_own() {
        let semi_axes = Vector3::new(1.0, 3.0, 2.0);
        let properties = Ellipsoid { semi_axes }.integrals().properties;
        let found = EquivalentEllipsoid::new(&properties).unwrap();
        let sorted = Vector3::new(3.0, 2.0, 1.0);
        assert_relative_eq!(found.semi_axes, sorted, epsilon = 1e-13);
        assert_relative_eq!(found.radius(&Vector3::y()), 3.0, epsilon = 1e-13);
    }

    #[test]
    fn a_cube_has_a_sphere_of_its_moments() {
        // m = V/3 for half edges of 1: semi-axes sqrt(5/3).
        let properties = Body::Cube.surface().integrals().properties;
        let found = EquivalentEllipsoid::new(&properties).unwrap();
        let expected = Vector3::repeat((5.0_f64 / 3.0).sqrt());
        assert_relative_eq!(found.semi_axes, expected, epsilon = 1e-13);
    }

    #[test]
    fn what_is_no_solid_has_none() {
        let mut properties = Body::Cube.surface().integrals().properties;
        properties.volume = -1.0;
        assert!(EquivalentEllipsoid::new(&properties).is_none());
        properties.inertia = Matrix3::from_element(f64::NAN);
        assert!(EquivalentEllipsoid::new(&properties).is_none());
    }
}
