//! How far a surface is from its ellipsoid.

use crate::measure::EquivalentEllipsoid;
use crate::measure::integrals::elements::Element;

/// Angularity index: the mean over all directions from the centroid of |r - r_E| / r_E, with r the
/// radius and r_E that of the ellipsoid of equal moments. Zero of an ellipsoid, without an upper
/// bound; 0.02 to 0.1 of grains.
///
/// After the angularity of Masad, Olcott, White and Tashman 2001, a sum over directions of a plane
/// outline and its ellipse, here as a mean in space. Error: 1e-4 of the index, for the absolute value
/// has a crease.
pub(in crate::measure) fn angularity(elements: &[Element], ellipsoid: &EquivalentEllipsoid) -> f64 {
    let (mut sum, mut sphere) = (0.0, 0.0);
    for element in elements {
        let (direction, distance, solid_angle) = element.seen();
        let expected = ellipsoid.radius(&direction);
        sum += (distance / expected - 1.0).abs() * solid_angle;
        sphere += solid_angle;
    }
    sum / sphere
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::measure::integrals::elements::{Element, surface_elements};
    use crate::measure::integrate;
    use crate::model::{Radial, StarSurface};
    use crate::shapes::{Ellipsoid, Solid, Sphere};
    use crate::sphere::{AngleRectangle, GaussLegendre};
    use approx::assert_relative_eq;
    use nalgebra::Vector3;
    use std::f64::consts::{PI, TAU};

    fn elements(surface: &impl StarSurface) -> Vec<Element> {
        let sphere = AngleRectangle {
            theta: [0.0, PI],
            phi: [0.0, TAU],
        };
        let rule = GaussLegendre::new(100);
        let nodes = sphere.nodes(&rule, &rule);
        surface_elements(&Radial(surface), &nodes, &Vector3::zeros())
    }

    #[test]
    fn an_ellipsoid_has_none() {
        let ellipsoid = Ellipsoid {
            semi_axes: Vector3::new(3.0, 2.0, 1.0),
        };
        let own = EquivalentEllipsoid::new(&ellipsoid.integrals().properties).unwrap();
        assert!(angularity(&elements(&ellipsoid), &own) < 1e-12);
    }

    #[test]
    fn it_is_the_mean_distance_from_the_ellipsoid() {
        // A sphere 10 % larger than the one it is compared with.
        let small = integrate(&Sphere { radius: 1.0 }, 1e-12).properties;
        let own = EquivalentEllipsoid::new(&small).unwrap();
        let found = angularity(&elements(&Sphere { radius: 1.1 }), &own);
        assert_relative_eq!(found, 0.1, max_relative = 1e-10);
    }
}
