//! Where a surface reaches to: how far along an axis, and how far from a centre.
//!
//! The vertices of a mesh on it lie up to 1e-3 short of that where it is rough, and one that lies highest need not lie on the highest
//! peak. So climbs start from all that reach nearly as far, a peak each.

use super::oriented_box::{OrientedBox, oriented};
use crate::Mesh;
use crate::measure::balls::enclosing_ball::{Ball, EnclosingBallError, enclosing_ball};
use crate::measure::support::support_near;
use crate::model::Surface;
use crate::sphere::compass;
use nalgebra::{Matrix3, Point3, Vector3};

/// Cells per edge of the cube of directions of a mesh on which hull, spheres and outlines are found:
/// 24 578 vertices. They lie on the surface, and what is between them is cut off by at most 1e-4 of
/// the radius of curvature.
pub(in crate::measure) const RESOLUTION: usize = 64;

/// Vertices may lie on the highest peak that reach so nearly as far as the one that reaches farthest, ...
const NEARLY: f64 = 3e-3;

/// ... and on one peak if their directions differ by less than this, in radians: two cells of the mesh.
const ONE_PEAK: f64 = 0.05;

/// Peaks that are climbed at most.
const MOST_PEAKS: usize = 16;

/// The first and the last step of a climb away from a centre, in radians.
const STEPS: [f64; 2] = [0.0125, 1e-8];

/// Rounds in which peaks outside a ball are added to what it holds, and by what share of its radius they are outside.
const ROUNDS: usize = 16;
const OUTSIDE: f64 = 1e-9;

/// A surface with places all over it.
pub(in crate::measure) struct Reach<'a> {
    surface: &'a dyn Surface,
    /// Vertices on it, seen from its centre, and their directions.
    places: Vec<Vector3<f64>>,
    directions: Vec<Vector3<f64>>,
}

impl<'a> Reach<'a> {
    /// Of a surface and its mesh of the resolution [`RESOLUTION`].
    pub(in crate::measure) fn new(surface: &'a dyn Surface, mesh: &Mesh) -> Self {
        let centre = surface.frame().centre;
        Self {
            surface,
            places: mesh.vertices.iter().map(|vertex| vertex - centre).collect(),
            directions: surface.grid(RESOLUTION).0,
        }
    }

    /// Extents along three unit axes, the columns: between the planes across an axis that the surface touches. Error: rounding where
    /// it is smooth, 1e-12 on edges.
    pub(in crate::measure) fn extents(&self, axes: &Matrix3<f64>) -> Vector3<f64> {
        let [low, high] = self.bounds(axes);
        high - low
    }

    /// The smallest box with these axes that holds the surface, likewise.
    pub(in crate::measure) fn hold(&self, axes: &Matrix3<f64>) -> OrientedBox {
        oriented(self.bounds(axes), axes)
    }

    fn bounds(&self, axes: &Matrix3<f64>) -> [Vector3<f64>; 2] {
        let centre = self.surface.frame().centre.coords;
        let axis = |i: usize| axes.column(i).into_owned();
        let reach = |towards: Vector3<f64>| centre.dot(&towards) + self.height(&towards);
        [
            Vector3::from_fn(|i, _| -reach(-axis(i))),
            Vector3::from_fn(|i, _| reach(axis(i))),
        ]
    }

    /// How far it reaches from its centre in a direction, a unit vector.
    fn height(&self, towards: &Vector3<f64>) -> f64 {
        let heights: Vec<f64> = self.places.iter().map(|place| place.dot(towards)).collect();
        let climbed = self.farthest(&heights).into_iter().map(|at| {
            let touched = support_near(self.surface, towards, &self.directions[at]);
            touched.point.dot(towards).max(heights[at])
        });
        climbed.fold(f64::NEG_INFINITY, f64::max)
    }

    /// The smallest ball that holds the surface, from the points of its hull. Error: 1e-6 where few peaks reach as far; of a body
    /// that is nearly a ball some 1e-5.
    pub(in crate::measure) fn enclosing_ball(
        &self,
        hull: &[Point3<f64>],
    ) -> Result<Ball, EnclosingBallError> {
        let centre = self.surface.frame().centre;
        let mut held = hull.to_vec();
        let mut ball = enclosing_ball(&held)?;
        for _ in 0..ROUNDS {
            let middle = ball.centre - centre;
            let away = |place: &Vector3<f64>| (place - middle).norm();
            let distances: Vec<f64> = self.places.iter().map(away).collect();
            let outside = self.farthest(&distances).into_iter().filter_map(|at| {
                let distance = |n: &Vector3<f64>| away(&self.surface.place(n));
                let [first, least] = STEPS;
                let (n, farthest) = compass(self.directions[at], first, least, distance);
                let is_outside = farthest > (1.0 + OUTSIDE) * ball.radius;
                is_outside.then(|| centre + self.surface.place(&n))
            });
            let before = held.len();
            held.extend(outside);
            if held.len() == before {
                break;
            }
            ball = enclosing_ball(&held)?;
        }
        Ok(ball)
    }

    /// The places that may lie on the highest peak, by how far each reaches: the highest of each peak, the highest peaks first.
    fn farthest(&self, reaches: &[f64]) -> Vec<usize> {
        let highest = reaches.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        let least = highest - NEARLY * highest.abs();
        let mut near: Vec<usize> = (0..reaches.len())
            .filter(|&at| reaches[at] >= least)
            .collect();
        near.sort_by(|&one, &other| reaches[other].total_cmp(&reaches[one]));
        let mut peaks: Vec<usize> = Vec::new();
        for at in near {
            let is_apart =
                |&known: &usize| (self.directions[at] - self.directions[known]).norm() > ONE_PEAK;
            if peaks.len() < MOST_PEAKS && peaks.iter().all(is_apart) {
                peaks.push(at);
            }
        }
        peaks
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::measure::extents_of_points;
    use crate::model::Radial;
    use crate::shapes::{Bump, Bumpy, Ellipsoid, Sampling};
    use nalgebra::Rotation3;

    /// Narrow bumps of nearly one height all over a body.
    fn bumpy() -> Bumpy<Ellipsoid> {
        let places = Sampling::Fibonacci.directions(150, 0).unwrap();
        let heights = (0..).map(|i| 0.05 + 0.002 * (f64::from(i) * 0.618 % 1.0));
        let bump = |(n, height): (Vector3<f64>, f64)| Bump::round(height, 400.0, n.into());
        Bumpy {
            base: Ellipsoid {
                semi_axes: Vector3::new(1.1, 1.0, 0.95),
            },
            bumps: places.into_iter().zip(heights).map(bump).collect(),
        }
    }

    #[test]
    fn boxes_and_balls_hold_the_highest_of_many_peaks() {
        let bumpy = &bumpy();
        let bumpy = Radial(bumpy);
        let mesh = bumpy.mesh(RESOLUTION);
        let reach = Reach::new(&bumpy, &mesh);
        let finer = bumpy.mesh(200).vertices;
        let mut cut_off = 0.0_f64;
        for turn in Sampling::Fibonacci.directions(12, 0).unwrap() {
            let axes = Rotation3::face_towards(&turn, &Vector3::x()).into_inner();
            let held = reach.extents(&axes);
            let [of_finer, of_mesh] =
                [&finer, &mesh.vertices].map(|points| extents_of_points(points, &axes));
            assert!((held - of_finer).min() > -1e-9, "{held} {of_finer}");
            cut_off = cut_off.max((held - of_mesh).max());
        }
        assert!(cut_off > 1e-3, "{cut_off}");
        let ball = reach.enclosing_ball(&mesh.vertices).unwrap();
        let farthest = finer.iter().map(|vertex| (vertex - ball.centre).norm());
        let share = farthest.fold(0.0, f64::max) / ball.radius;
        assert!((0.9999..1.0 + 1e-8).contains(&share), "{share}");
        assert!(ball.radius > enclosing_ball(&mesh.vertices).unwrap().radius * 1.0001);
    }
}
