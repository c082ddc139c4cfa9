//! Roundness of a surface: how sharp its corners are beside the largest sphere inside.
//!
//! A corner is where the larger principal curvature k is above 1 / R. Nodes all over the surface are in a corner or not, as they
//! come. Whatever is made of k between them leads astray, for of rough stones it goes up and down from node to node (what goes
//! linearly was up to 20 % too round), and of some superquadrics it has no bound on three planes.
//!
//! Where a rim is narrow and the same all along, its border may run beside a row of nodes: so these lie in a grid that is turned
//! against the surface's axes. Measured on ellipsoids: of 1 : 1 : 0.1 it is off by 6e-3, of 1 : 1 : 0.2 by 4e-3, of round ones by
//! 1e-3; on superquadrics of 4 : 4 : 1 with exponents of 1.2 to 8 by up to 1.5e-2.

use crate::measure::integrals::nodes::{CurvedNode, curved};
use crate::model::{Node, Surface};
use crate::sphere::CubeCell;
use nalgebra::Rotation3;

/// Cells along an edge of the cube of nodes.
const PARTS: u16 = 48;

/// Angles by which it is turned, in radians: about no axis by some part of a right angle.
const TURN: [f64; 3] = [0.3, 0.5, 0.7];

/// Curvatures at nodes all over a surface.
#[derive(Debug, Clone)]
pub(in crate::measure) struct Corners {
    nodes: Vec<CurvedNode>,
}

impl Corners {
    pub(in crate::measure) fn new(surface: &(impl Surface + ?Sized)) -> Self {
        Self::at(surface, PARTS)
    }

    fn at(surface: &(impl Surface + ?Sized), parts: u16) -> Self {
        let [roll, pitch, yaw] = TURN;
        let turn = Rotation3::from_euler_angles(roll, pitch, yaw);
        let node = |cell: &CubeCell| (turn * cell.middle(), cell.solid_angle());
        let nodes: Vec<Node> = CubeCell::uniform(parts).iter().map(node).collect();
        Self {
            nodes: curved(surface, &nodes),
        }
    }

    /// The mean, by area, of 1 / (k R) where k > 1 / R; 1 without such corners.
    pub(in crate::measure) fn roundness(&self, radius: f64) -> f64 {
        let (mut corners, mut radii) = (0.0, 0.0);
        for node in &self.nodes {
            let sharpness = node.principal[0] * radius;
            if sharpness > 1.0 {
                corners += node.area;
                radii += node.area / sharpness;
            }
        }
        match corners > 0.0 {
            true => radii / corners,
            false => 1.0,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::{
        Family, Frame, Radial, StarGrain, Stretch, Superquadric, SuperquadricGrain, Whole,
    };
    use crate::shapes::Sphere;
    use crate::sphere::coefficient_count;
    use approx::assert_relative_eq;
    use rand::SeedableRng;
    use rand_chacha::ChaCha8Rng;
    use rand_distr::{Distribution, StandardNormal};

    /// That of an oblate spheroid a = a > c with R = c, by its larger curvature along the meridian: over t, tan of the parametric latitude,
    /// w = a² sin² + c² cos² gives k = a c / w^(3/2) and an area element a w^(1/2) cos.
    fn oblate(a: f64, c: f64) -> f64 {
        let steps = 200_000;
        let (mut corners, mut radii) = (0.0, 0.0);
        for i in 0..steps {
            // z = c sin(latitude); the area is even in it.
            let sin = (i as f64 + 0.5) / steps as f64;
            let w = a * a * sin * sin + c * c * (1.0 - sin * sin);
            let meridian = a * c / w.powf(1.5);
            let parallel = c / (a * w.sqrt());
            let sharpness = c * meridian.max(parallel);
            if sharpness > 1.0 {
                corners += w.sqrt();
                radii += w.sqrt() / sharpness;
            }
        }
        radii / corners
    }

    #[test]
    fn flat_bodies_have_the_roundness_of_their_rims() {
        for (thickness, error) in [(0.1, 1e-2), (0.2, 3e-3), (0.5, 1e-3)] {
            // A superquadric's directions are stretched as those of fits are.
            let shape = Superquadric::single([1.0, 1.0, thickness], 2.0, 2.0).unwrap();
            let body = SuperquadricGrain::single(Frame::SCAN, shape).unwrap();
            let found = Corners::new(&body).roundness(thickness);
            let off = (found / oblate(1.0, thickness) - 1.0).abs();
            assert!(off < error, "{thickness}: {off}");
        }
    }

    /// By nodes that are far denser.
    fn dense(surface: &impl Surface, radius: f64) -> f64 {
        Corners::at(surface, 256).roundness(radius)
    }

    /// A ball with waves of a few degrees, as a rough stone has them.
    #[test]
    fn rough_bodies_have_the_roundness_that_dense_nodes_tell() {
        let mut random = ChaCha8Rng::seed_from_u64(3);
        let degree = 30;
        let coefficients = (0..coefficient_count(degree)).map(|at| {
            let normal: f64 = StandardNormal.sample(&mut random);
            let l = (at as f64).sqrt().floor();
            if at == 0 {
                35.0
            } else {
                normal / (1.0 + l).powf(1.5)
            }
        });
        let whole = Family::Whole(Whole::new(coefficients.collect()).unwrap());
        let stone = StarGrain::stretched(Frame::SCAN, Stretch::NONE, whole).unwrap();
        let found = Corners::new(&stone);
        let off = found.roundness(8.0) / dense(&stone, 8.0) - 1.0;
        assert!(off.abs() < 5e-3, "{off}");
    }

    /// On the planes of its octants the curvature has no bound.
    #[test]
    fn superquadrics_below_ellipsoids_have_no_narrow_rims_on_three_planes() {
        let shape = Superquadric::single([3.0, 2.6, 2.4], 1.93, 1.94).unwrap();
        let body = SuperquadricGrain::single(Frame::SCAN, shape).unwrap();
        let found = Corners::new(&body).roundness(2.4);
        let off = found / dense(&body, 2.4) - 1.0;
        assert!(off.abs() < 5e-3, "{off}");
    }

    #[test]
    fn a_sphere_has_no_corner_inside_of_it() {
        let sphere = Corners::new(&Radial(&Sphere { radius: 2.0 }));
        assert_eq!(sphere.roundness(1.99), 1.0);
        assert_relative_eq!(sphere.roundness(2.5), 0.8, max_relative = 1e-12);
    }
}
