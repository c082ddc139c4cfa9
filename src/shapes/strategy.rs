//! Sampling strategies for shapes with three mirror planes: directions in one octant, and what each
//! counts on the full body (Radvilaite 2016, Chapter 3).

use super::Solid;
use super::profile::Profile;
use crate::sphere::GaussLegendre;
use nalgebra::Vector3;
use std::f64::consts::FRAC_PI_2;

/// How the nodes of an angle lie between 0 and pi/2.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Spacing {
    /// Equal steps of the angle.
    Equiangular,
    /// Equal steps along the body's section: that at azimuth 0 for the polar angle, that in z = 0 for
    /// the azimuth.
    Equidistant,
    /// Equal steps of z along the section, for bodies whose section falls all the way from the pole.
    EqualHeights,
    /// Equal steps along the section between its singular angles, which are nodes; the two steps next
    /// to a singular angle are half as long. A body without singular angles is refined at pi/2, where
    /// its mirrored model has an edge. The source does not say how it refines.
    Adaptive,
    /// The Gauss-Legendre nodes of the interval: none at its ends.
    Gauss,
}

/// A sampling strategy: a spacing of either angle.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub struct Strategy {
    /// Of the polar angle.
    pub polar: Spacing,
    /// Of the azimuth.
    pub azimuth: Spacing,
}

impl Strategy {
    /// The strategy that the source numbers q, 1 to 8. 1 to 4 differ in the polar angle; 5 to 8 combine
    /// both angles for the parallelepiped, where 5 is 2 and 6 is 3.
    pub const fn numbered(q: usize) -> Option<Self> {
        use Spacing::{Adaptive, Equiangular, Equidistant, Gauss};
        let (polar, azimuth) = match q {
            1 => (Equiangular, Equiangular),
            2 | 5 => (Equidistant, Equiangular),
            3 | 6 => (Adaptive, Equiangular),
            4 => (Gauss, Equiangular),
            7 => (Equidistant, Adaptive),
            8 => (Adaptive, Adaptive),
            _ => return None,
        };
        Some(Self { polar, azimuth })
    }

    /// Directions in the octant of positive x, y, z, each with its number of images on the full body,
    /// itself included: 8 inside, 4 on a mirror plane, 2 on two. The pole comes first; then `polar`
    /// rings, the last at pi/2 unless by Gauss, of `azimuth` + 1 directions each: `polar` (`azimuth` +
    /// 1) + 1 in all.
    ///
    /// The weights add up to the number of points of the full body: but for Gauss nodes,
    /// (2 `polar` - 1) 4 `azimuth` + 2. Less than one step counts as one, and adaptive steps are one at
    /// least from one singular angle to the next.
    pub fn sample(
        self,
        body: &dyn Solid,
        polar: usize,
        azimuth: usize,
    ) -> Vec<(Vector3<f64>, f64)> {
        let (polar, azimuth) = (polar.max(1), azimuth.max(1));
        let rings = match self.polar {
            Spacing::Gauss => gauss(polar),
            spacing => nodes(spacing, &Profile::polar(body), polar).split_off(1),
        };
        let meridians = nodes(self.azimuth, &Profile::azimuthal(body), azimuth);
        let ring = |theta: f64| meridians.iter().map(move |&phi| direction(theta, phi));
        let between = rings.iter().flat_map(|&theta| ring(theta));
        [Vector3::z()]
            .into_iter()
            .chain(between)
            .map(|n| (n, full_body_count(&n)))
            .collect()
    }
}

/// `steps` + 1 angles from 0 to pi/2.
fn nodes(spacing: Spacing, profile: &Profile<'_>, steps: usize) -> Vec<f64> {
    match spacing {
        Spacing::Equiangular => (0..=steps)
            .map(|i| FRAC_PI_2 * i as f64 / steps as f64)
            .collect(),
        Spacing::Equidistant => profile.equidistant(steps),
        Spacing::EqualHeights => profile.equally_high(steps),
        Spacing::Adaptive => profile.refined(steps),
        Spacing::Gauss => gauss(steps + 1),
    }
}

fn gauss(count: usize) -> Vec<f64> {
    let rule = GaussLegendre::new(count);
    rule.on(0.0, FRAC_PI_2).map(|(angle, _)| angle).collect()
}

/// The unit vector of two angles from 0 to pi/2, with the zeros that it has.
fn direction(theta: f64, phi: f64) -> Vector3<f64> {
    let cos = |angle: f64| if angle == FRAC_PI_2 { 0.0 } else { angle.cos() };
    Vector3::new(theta.sin() * cos(phi), theta.sin() * phi.sin(), cos(theta))
}

/// The number of images of a direction in the eight octants.
fn full_body_count(n: &Vector3<f64>) -> f64 {
    let off_planes = n.iter().filter(|&&component| component != 0.0).count();
    f64::from(1_u32 << off_planes)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shapes::{Body, Cylinder};
    use approx::{assert_abs_diff_eq, assert_relative_eq};

    const ALL: [Spacing; 5] = [
        Spacing::Equiangular,
        Spacing::Equidistant,
        Spacing::EqualHeights,
        Spacing::Adaptive,
        Spacing::Gauss,
    ];

    /// The distinct polar angles of a sampling.
    fn rings(samples: &[(Vector3<f64>, f64)], azimuth: usize) -> Vec<f64> {
        let rings = samples[1..].chunks(azimuth + 1);
        rings.map(|ring| ring[0].0.z.acos()).collect()
    }

    #[test]
    fn all_directions_are_in_the_octant_and_the_full_body_is_counted_once() {
        for polar in ALL.into_iter().filter(|&spacing| spacing != Spacing::Gauss) {
            let strategy = Strategy {
                polar,
                azimuth: Spacing::Equiangular,
            };
            let samples = strategy.sample(Body::Ellipsoid.surface().as_ref(), 64, 32);
            assert_eq!(samples.len(), 64 * 33 + 1);
            let full: f64 = samples.iter().map(|(_, weight)| weight).sum();
            assert_eq!(full, 16258.0);
            for (n, _) in &samples {
                assert!(n.min() >= 0.0);
                assert_relative_eq!(n.norm(), 1.0, max_relative = 1e-15);
            }
        }
    }

    #[test]
    fn equidistant_rings_part_the_section_of_a_cylinder_by_length() {
        // Its section is 2 long on the end and 1 on the side.
        let strategy = Strategy::numbered(2).unwrap();
        let samples = strategy.sample(Body::Cylinder.surface().as_ref(), 6, 4);
        let expected = [0.5_f64, 1.0, 1.5, 2.0].map(f64::atan).into_iter();
        let expected = expected.chain([2.0_f64.atan2(0.5), FRAC_PI_2]);
        for (angle, expected) in rings(&samples, 4).into_iter().zip(expected) {
            assert_abs_diff_eq!(angle, expected, epsilon = 1e-7);
        }
    }

    #[test]
    fn equal_heights_are_equal() {
        let strategy = Strategy {
            polar: Spacing::EqualHeights,
            azimuth: Spacing::Equiangular,
        };
        let ellipsoid = Body::Ellipsoid.surface();
        let samples = strategy.sample(ellipsoid.as_ref(), 8, 4);
        for (i, ring) in samples[1..].chunks(5).enumerate() {
            let height = ring[0].0.z * ellipsoid.radius(&ring[0].0);
            assert_abs_diff_eq!(height, 1.0 - (i + 1) as f64 / 8.0, epsilon = 1e-6);
        }
    }

    #[test]
    fn adaptive_nodes_hold_the_edges_and_are_denser_there() {
        let cylinder = Cylinder {
            radius: 2.0,
            half_height: 1.0,
        };
        let strategy = Strategy::numbered(3).unwrap();
        let angles = rings(&strategy.sample(&cylinder, 16, 4), 4);
        let rim = 2.0_f64.atan();
        let at = angles.iter().position(|a| (a - rim).abs() < 1e-12).unwrap();
        let radii = |i: usize| angles[i].tan();
        let (inner, next) = (radii(at - 4) - radii(at - 5), radii(at) - radii(at - 1));
        assert_relative_eq!(next, inner / 2.0, max_relative = 1e-5);

        let cuboid = Body::Cuboid.surface();
        let samples = Strategy::numbered(8).unwrap().sample(cuboid.as_ref(), 8, 8);
        let on_edge = |(n, _): &&(Vector3<f64>, f64)| (n.x - n.y).abs() < 1e-12;
        assert_eq!(samples.iter().filter(on_edge).count(), 8 + 1);
    }

    #[test]
    fn no_steps_count_as_one() {
        for spacing in ALL {
            let strategy = Strategy {
                polar: spacing,
                azimuth: spacing,
            };
            for body in Body::ALL {
                let samples = strategy.sample(body.surface().as_ref(), 0, 0);
                assert!(samples.len() >= 3);
                assert!(samples.iter().all(|(n, _)| n.iter().all(|x| x.is_finite())));
            }
        }
        assert_eq!(Strategy::numbered(0), None);
        assert_eq!(Strategy::numbered(9), None);
    }
}
