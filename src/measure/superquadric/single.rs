//! Mass properties of one superquadric.

use super::moments::moments;
use super::octant::{DoubleExponential, octant_area};
use crate::measure::MassProperties;
use crate::model::Superquadric;
use nalgebra::Point3;

/// Steps of the rule for the area, and of the one that it is checked with, which has half of its nodes.
const STEPS: [u32; 2] = [16, 8];

/// Least error of the area, for rounding, as a share of it.
const ROUNDING: f64 = 1e-14;

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
/// that of a rule, its error the difference to half of its nodes, which have half of its digits.
pub fn superquadric_properties(body: &Superquadric) -> SolidProperties {
    let [area, check] = STEPS.map(|steps| {
        let rule = DoubleExponential::new(steps);
        let areas = body.octants().map(|octant| octant_area(&octant, &rule));
        areas.sum::<f64>()
    });
    let mut moments = moments(body);
    moments.area = area;
    SolidProperties {
        properties: moments.about_centroid(&Point3::origin()),
        area_error: ((area - check).abs() / area).max(ROUNDING),
        volume_error: 0.0,
    }
}

#[cfg(test)]
mod tests {
    use super::super::patch::Patch;
    use super::*;
    use crate::measure::{Moments, PrincipalInertia};
    use crate::model::StarSurface;
    use crate::sphere::GaussLegendre;
    use approx::assert_relative_eq;
    use nalgebra::{Matrix3, Vector3};
    use std::f64::consts::PI;

    /// Volume and moments by quadrature over the rays of octants, whose edges no rule crosses.
    fn by_rays(body: &Superquadric) -> Moments {
        let rule = GaussLegendre::new(60);
        let mut sum = Moments::default();
        for patch in Patch::all(body) {
            for (u, along) in rule.on(0.0, 1.0) {
                for (v, across) in rule.on(0.0, 1.0) {
                    let node = patch.node(body, [u, v]);
                    sum.add_element(&node.point, &(node.area * along * across));
                }
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

    /// About its long axis the moment is one part in a hundred thousand million of the others.
    #[test]
    fn a_needle_has_its_least_moment() {
        let needle = Superquadric::single([1e5, 1.0, 1.0], 2.0, 2.0).unwrap();
        let found = superquadric_properties(&needle).properties;
        let least = 0.4 * found.volume;
        assert_relative_eq!(found.inertia[(0, 0)], least, max_relative = 1e-13);
    }

    /// Areas of a Gauss rule were up to .2 % off here, and up to 140 times what was told.
    #[test]
    fn areas_of_sharp_and_of_long_bodies_are_right_within_their_stated_errors() {
        for (axes, [n1, n2], area) in [
            (
                [3.092827, 4.219606, 1.413008],
                [2.8603, 42.40174],
                144.701063517786,
            ),
            (
                [0.686139, 0.778796, 0.912442],
                [1.1, 5.52151],
                6.72955450707375,
            ),
            (
                [0.952965, 1.688777, 2.406891],
                [100.0, 1.1],
                44.2326840883198,
            ),
            ([1.0, 1.0, 100.0], [1.1, 100.0], 870.255816172349),
        ] {
            let body = Superquadric::single(axes, n1, n2).unwrap();
            let found = superquadric_properties(&body);
            let off = (found.properties.area / area - 1.0).abs();
            assert!(
                off < found.area_error.max(1e-12),
                "{axes:?}: {off} {}",
                found.area_error
            );
            assert!(found.area_error < 1e-6, "{axes:?}: {}", found.area_error);
        }
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
