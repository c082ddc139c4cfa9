//! Mass properties of one superquadric.

use super::moments::moments;
use super::patch::Patch;
use crate::measure::MassProperties;
use crate::model::Superquadric;
use crate::sphere::GaussLegendre;
use nalgebra::Point3;

/// Gauss nodes along a side of a patch: of the rule for the area, and of the one that it is checked with.
const ORDERS: [usize; 2] = [32, 24];

/// Mass properties and how well they are known.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SolidProperties {
    /// Area, volume, centroid and inertia, in the unit and frame of the body.
    pub properties: MassProperties,
    /// Estimated error of the area, as a share of it.
    pub area_error: f64,
    /// Estimated error of volume, and of the moments relative to the volume and the size; zero where they are closed
    /// forms.
    pub volume_error: f64,
}

/// Mass properties of a superquadric. Volume, centroid and inertia are closed forms in gamma functions; the area is
/// that of a Gauss rule, its error the difference to one of fewer nodes.
pub fn superquadric_properties(body: &Superquadric) -> SolidProperties {
    let patches = Patch::all(body);
    let [area, check] = ORDERS.map(|order| {
        let rule = GaussLegendre::new(order);
        let nodes = patches.iter().flat_map(|patch| patch.nodes(body, &rule));
        nodes.map(|node| node.area.norm()).sum::<f64>()
    });
    let mut moments = moments(body);
    moments.area = area;
    SolidProperties {
        properties: moments.about_centroid(&Point3::origin()),
        area_error: (area - check).abs() / area,
        volume_error: 0.0,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::measure::{Moments, PrincipalInertia};
    use crate::model::StarSurface;
    use approx::assert_relative_eq;
    use nalgebra::{Matrix3, Vector3};
    use std::f64::consts::PI;

    /// Volume and moments by quadrature over the rays of octants, whose edges no rule crosses.
    fn by_rays(body: &Superquadric) -> Moments {
        let rule = GaussLegendre::new(60);
        let mut sum = Moments::default();
        for patch in Patch::all(body) {
            for node in patch.nodes(body, &rule) {
                sum.add_element(&node.point, &node.area);
            }
        }
        sum
    }

    fn poly() -> Superquadric {
        Superquadric::poly12(
            [[1.0, 1.5], [2.0, 1.0], [0.7, 0.9]],
            [2.5, 4.0],
            [[2.0, 3.0], [5.0, 3.5]],
        )
        .unwrap()
    }

    #[test]
    fn closed_forms_agree_with_quadrature() {
        let round = Superquadric::single([3.0, 2.0, 1.0], 4.0, 8.0).unwrap();
        for body in [round, poly()] {
            let (found, expected) = (superquadric_properties(&body), by_rays(&body));
            let expected = expected.about_centroid(&Point3::origin());
            let found = found.properties;
            assert_relative_eq!(found.volume, expected.volume, max_relative = 1e-9);
            assert_relative_eq!(found.area, expected.area, max_relative = 1e-9);
            assert_relative_eq!(found.centroid, expected.centroid, epsilon = 1e-9);
            assert_relative_eq!(found.inertia, expected.inertia, epsilon = 1e-8);
        }
    }

    #[test]
    fn an_ellipsoid_and_a_near_box_have_their_figures() {
        let oblate = Superquadric::single([2.0, 2.0, 1.0], 2.0, 2.0).unwrap();
        let found = superquadric_properties(&oblate);
        let e = 0.75_f64.sqrt();
        let area = 8.0 * PI * (1.0 + 0.25 / e * e.atanh());
        assert_relative_eq!(found.properties.area, area, max_relative = 1e-12);
        let volume = 16.0 / 3.0 * PI;
        assert_relative_eq!(found.properties.volume, volume, max_relative = 1e-13);
        let inertia = Matrix3::from_diagonal(&Vector3::new(5.0, 5.0, 8.0)) * (volume / 5.0);
        assert_relative_eq!(found.properties.inertia, inertia, max_relative = 1e-12);
        let cube = Superquadric::single([1.0; 3], 100.0, 100.0).unwrap();
        let found = superquadric_properties(&cube).properties;
        assert!((found.volume - 8.0).abs() < 0.01 && (found.area - 24.0).abs() < 0.3);
    }

    #[test]
    fn the_stated_error_of_the_area_holds() {
        let sharp = Superquadric::single([1.0, 2.0, 1.5], 1.3, 1.3).unwrap();
        let (found, finer) = (superquadric_properties(&sharp), by_rays(&sharp));
        let error = (found.properties.area / finer.area - 1.0).abs();
        assert!(error < found.area_error && found.area_error < 1e-4);
    }

    #[test]
    fn octants_that_differ_tilt_the_principal_axes() {
        let body = Superquadric::poly8([[1.0, 0.4], [0.9, 0.4], [0.8, 0.4]], 2.0, 2.0).unwrap();
        let PrincipalInertia { axes, .. } = superquadric_properties(&body)
            .properties
            .principal()
            .unwrap();
        for axis in 0..3 {
            let tilt = axes.column(axis).amax().acos().to_degrees();
            assert!((5.0..25.0).contains(&tilt), "{tilt}");
        }
        assert!(body.radius(&Vector3::x()) == 1.0);
    }
}
