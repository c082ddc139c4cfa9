//! Roundness of a surface: how sharp its corners are beside the largest sphere inside.
//!
//! A corner is where the larger principal curvature k is above 1 / R. Where a rim is narrow the border of the corners decides, and nodes
//! of a quadrature place it no better than they are apart: of an ellipsoid 1 : 1 : 0.2 they were off by 4 %. So k is taken as
//! linear, in a form that has a bound, over the triangles of a grid, and these are cut along the border.

use super::Curvature;
use crate::model::Surface;
use nalgebra::Vector3;
use rayon::prelude::*;

/// Cells along an edge of the cube of directions.
const RESOLUTION: usize = 48;

/// Directions at which the surface is evaluated together.
const CHUNK: usize = 1024;

/// The larger principal curvature over a grid of the surface.
#[derive(Debug, Clone)]
pub(super) struct Corners {
    /// At each vertex its place and the curvature.
    vertices: Vec<(Vector3<f64>, f64)>,
    triangles: Vec<[u32; 3]>,
}

impl Corners {
    pub(super) fn new(surface: &(impl Surface + ?Sized)) -> Self {
        let (directions, triangles) = surface.grid(RESOLUTION);
        let of_chunk = |chunk: &[Vector3<f64>]| {
            let jets = surface.jets(chunk);
            let vertices = chunk.iter().zip(jets).map(|(n, jet)| {
                let curvature = Curvature::new(n, &jet);
                (jet.place, curvature.principal[0])
            });
            vertices.collect::<Vec<_>>()
        };
        Self {
            vertices: directions
                .par_chunks(CHUNK)
                .flat_map_iter(of_chunk)
                .collect(),
            triangles,
        }
    }

    /// The mean, by area, of 1 / (k R) where k > 1 / R; 1 without such corners.
    pub(super) fn roundness(&self, radius: f64) -> f64 {
        let (mut corners, mut radii) = (0.0, 0.0);
        for triangle in &self.triangles {
            let vertices = triangle.map(|at| self.vertices[at as usize]);
            let [a, b, c] = vertices.map(|(place, _)| place);
            let area = 0.5 * (b - a).cross(&(c - a)).norm();
            let [share, radius] =
                corner(vertices.map(|(_, curvature)| bounded(curvature * radius)));
            corners += area * share;
            radii += area * radius;
        }
        match corners > 0.0 {
            true => radii / corners,
            false => 1.0,
        }
    }
}

/// (x - 1) / (x + 1) of a sharpness x = k R: 0 on the border of a corner, 1 on an edge, and -1 of what is flat or hollow.
fn bounded(sharpness: f64) -> f64 {
    match sharpness {
        x if x.is_infinite() && x > 0.0 => 1.0,
        x if x > 0.0 => (x - 1.0) / (x + 1.0),
        _ => -1.0,
    }
}

/// 1 / x of the bounded form.
fn inverse(bounded: f64) -> f64 {
    (1.0 - bounded) / (1.0 + bounded)
}

/// The share of a triangle where a function that is linear over it is above zero, and the integral of its [`inverse`] there, of an area
/// of one.
fn corner(mut values: [f64; 3]) -> [f64; 2] {
    values.sort_unstable_by(f64::total_cmp);
    let [least, middle, most] = values;
    let mean = |[a, b, c]: [f64; 3]| {
        let sides = [a + b, b + c, c + a].map(|sum| inverse(0.5 * sum));
        sides.iter().sum::<f64>() / 3.0
    };
    if least >= 0.0 {
        return [1.0, mean(values)];
    }
    if most <= 0.0 {
        return [0.0, 0.0];
    }
    if middle <= 0.0 {
        // A tip, beyond the border.
        let share = most / (most - least) * (most / (most - middle));
        return [share, share * mean([0.0, 0.0, most])];
    }
    // What a tip at the other side leaves: a quadrilateral, of two triangles.
    let [along, across] = [most, middle].map(|end| end / (end - least));
    let first = along;
    let second = across * (1.0 - along);
    [
        first + second,
        first * mean([middle, most, 0.0]) + second * mean([middle, 0.0, 0.0]),
    ]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::{Frame, Radial, Superquadric, SuperquadricGrain};
    use crate::shapes::Sphere;
    use approx::assert_relative_eq;

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

    #[test]
    fn a_sphere_has_no_corner_inside_of_it() {
        let sphere = Corners::new(&Radial(&Sphere { radius: 2.0 }));
        assert_eq!(sphere.roundness(1.99), 1.0);
        assert_relative_eq!(sphere.roundness(2.5), 0.8, max_relative = 1e-12);
    }

    /// Triangles cut along the border, against many small ones.
    #[test]
    fn a_triangle_is_cut_along_the_border() {
        let steps = 2000;
        for values in [
            [0.2, 0.3, 0.4],
            [-0.2, 0.1, 0.3],
            [-0.3, -0.1, 0.2],
            [-0.3, -0.2, -0.1],
        ] {
            let (mut share, mut radii) = (0.0, 0.0);
            for i in 0..steps {
                for j in 0..steps - i {
                    let [s, t] = [i, j].map(|k| (f64::from(k) + 1.0 / 3.0) / f64::from(steps));
                    let value =
                        values[0] + s * (values[1] - values[0]) + t * (values[2] - values[0]);
                    if value > 0.0 {
                        share += 1.0;
                        radii += inverse(value);
                    }
                }
            }
            let all = f64::from(steps * (steps + 1) / 2);
            let [own_share, own_radii] = corner(values);
            assert_relative_eq!(own_share, share / all, epsilon = 2e-3);
            assert_relative_eq!(own_radii, radii / all, epsilon = 2e-2);
        }
    }

    #[test]
    fn edges_are_sharp_and_hollows_are_no_corners() {
        assert_eq!(
            [f64::INFINITY, 1.0, 0.0, -3.0].map(bounded),
            [1.0, 0.0, -1.0, -1.0]
        );
        assert_eq!(inverse(bounded(4.0)), 0.25);
    }
}
