//! Holes between the points of a scan that are wide in space, as far apart as points are round them: what chance leaves between few
//! points on the flat sides of a thin plate is not.

use super::empty_caps::random_gap;
use crate::fit::points::neighbours::Neighbours;
use crate::fit::points::rounder::rounder;
use crate::mesh::{Mesh, solid_angle};
use crate::sphere::triangulate_directions;
use crate::spread::upper_median;
use nalgebra::{Matrix3, Point3, Vector3};
use std::f64::consts::PI;

/// Points near a hole whose distances tell how far apart points are there, ...
const NEAR: usize = 24;

/// ... each by the neighbour within whose distance random points have a square of their own spacing.
const NEIGHBOUR: usize = 3;

/// Least half-angle of the holes that count together, in radians: over narrower ones the surface is known well.
const NARROW: f64 = PI / 12.0;

/// Whether any cap of directions without points, whose half-angle is large, is wide in space.
pub(super) fn is_any_wide(
    mesh: &Mesh,
    directions: &[Vector3<f64>],
    is_large: impl Fn(f64) -> bool,
) -> bool {
    let wide = Holes::new(mesh).wide(directions, is_large);
    wide.is_none_or(|triangles| !triangles.is_empty())
}

/// Half-angle of a cap as large as all holes together, seen on the body of a mesh stretched to a ball: on the long side of a grain
/// they are wider than they seem from its middle. No cap of its directions is wider than `largest`.
pub(super) fn all_together(mesh: &Mesh, centre: &Point3<f64>, largest: f64) -> f64 {
    let (stretch, ratio) = rounder(moments(mesh, centre)).unwrap_or((Matrix3::identity(), 1.0));
    let least = NARROW.max(random_gap(mesh.vertices.len()));
    if (largest.sin() * ratio).atan2(largest.cos()) <= least {
        return 0.0;
    }
    let seen = |vertex: &Point3<f64>| {
        let direction = (stretch * (vertex - centre)).try_normalize(0.0);
        direction.unwrap_or_default()
    };
    let directions: Vec<Vector3<f64>> = mesh.vertices.iter().map(seen).collect();
    match Holes::new(mesh).wide(&directions, |half_angle| half_angle > least) {
        Some(triangles) => {
            let angles = triangles
                .iter()
                .map(|corners| solid_angle(corners.map(|corner| directions[corner as usize])));
            let share = angles.sum::<f64>() / (4.0 * PI);
            (1.0 - 2.0 * share).max(-1.0).acos()
        }
        None => PI,
    }
}

/// The points of a scan, and how far apart they are.
struct Holes {
    places: Vec<Vector3<f64>>,
    neighbours: Neighbours,
    /// Radius of the disc that chance leaves empty, in the spacing of the points there.
    by_chance: f64,
}

impl Holes {
    fn new(mesh: &Mesh) -> Self {
        let places: Vec<Vector3<f64>> = mesh.vertices.iter().map(|v| v.coords).collect();
        Self {
            neighbours: Neighbours::new(&places),
            by_chance: random_hole(places.len()),
            places,
        }
    }

    /// The triangles of directions without points in them whose caps have such half-angles, and that are wide in space too. `None`
    /// if all directions lie on one side.
    fn wide(
        &self,
        directions: &[Vector3<f64>],
        is_wide: impl Fn(f64) -> bool,
    ) -> Option<Vec<[u32; 3]>> {
        let mut triangles = triangulate_directions(directions).ok()?;
        triangles
            .retain(|corners| is_wide(cap(directions, corners)) && self.is_beyond_chance(corners));
        Some(triangles)
    }

    /// Whether a triangle without points in it is wider than those that chance leaves where points are as far apart as near it or,
    /// at the rim of a dense patch, as at one of its corners.
    fn is_beyond_chance(&self, corners: &[u32; 3]) -> bool {
        let [a, b, c] = corners.map(|corner| self.places[corner as usize]);
        let longest = (b - a).norm().max((c - b).norm()).max((a - c).norm());
        let is_wide = |spacing: f64| longest / 2.0 > self.by_chance * spacing;
        [a, b, c]
            .iter()
            .all(|corner| is_wide(self.distance(corner)))
            && is_wide(self.spacing(&((a + b + c) / 3.0)))
    }

    fn spacing(&self, place: &Vector3<f64>) -> f64 {
        let near = self.neighbours.nearest(place, NEAR).into_iter();
        let mut distances: Vec<f64> = near
            .map(|other| self.distance(&self.places[other]))
            .collect();
        upper_median(&mut distances).unwrap_or(0.0)
    }

    /// How far a point is from its neighbours.
    fn distance(&self, place: &Vector3<f64>) -> f64 {
        let nearest = self.neighbours.nearest(place, NEIGHBOUR + 1);
        let last = nearest.last();
        last.map_or(0.0, |&other| (self.places[other] - place).norm())
    }
}

/// Radius of a disc of which random points on a surface leave one empty with a few percent, in their spacing: one in whose
/// area ln n + 5 of them are expected.
fn random_hole(points: usize) -> f64 {
    ((points.max(1) as f64).ln() + 5.0).sqrt() / PI.sqrt()
}

/// Half-angle of the cap through three unit vectors.
fn cap(directions: &[Vector3<f64>], corners: &[u32; 3]) -> f64 {
    let [a, b, c] = corners.map(|corner| directions[corner as usize]);
    let middle = (b - a).cross(&(c - a));
    middle.cross(&a).norm().atan2(middle.dot(&a))
}

/// Second moments of the faces of a mesh about a centre.
fn moments(mesh: &Mesh, centre: &Point3<f64>) -> Matrix3<f64> {
    let of_face = |corners: &[u32; 3]| {
        let [a, b, c] = corners.map(|i| mesh.vertices[i as usize] - centre);
        let middle = (a + b + c) / 3.0;
        middle * middle.transpose() * (b - a).cross(&(c - a)).norm()
    };
    mesh.triangles.iter().map(of_face).sum()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fit::prepare::scanned_surface;
    use crate::model::Unseen;
    use crate::scan::Scan;
    use crate::shapes::Sampling;

    /// A spheroid of this length whose points leave a band open, of a half-width in degrees as seen on the ball that it is stretched
    /// to, round its waist or (`is_cap`) a cap at its side.
    fn seen(length: f64, degrees: f64, is_cap: bool) -> Option<Unseen> {
        let mut directions = Sampling::Random.directions(3000, 1).unwrap();
        let width = degrees.to_radians();
        directions.retain(|n| match is_cap {
            true => n.x < width.cos(),
            false => n.z.abs() > width.sin(),
        });
        let place = |n: &Vector3<f64>| Point3::new(n.x, n.y, length * n.z);
        let points = directions.iter().map(place).collect();
        scanned_surface(&Scan::from_points(points)).unwrap().unseen
    }

    fn half_angle(unseen: Option<Unseen>) -> f64 {
        match unseen {
            Some(Unseen::Hole { half_angle }) => half_angle.to_degrees(),
            other => panic!("{other:?}"),
        }
    }

    #[test]
    fn a_band_is_as_large_as_a_cap_of_the_same_share_of_the_ball() {
        // sin 22 degrees of the sphere, and no cap is wider than 22 degrees.
        for length in [1.0, 0.5] {
            let found = half_angle(seen(length, 22.0, false));
            let expected = (1.0 - 2.0 * 22.0_f64.to_radians().sin())
                .acos()
                .to_degrees();
            assert!((found - expected).abs() < 12.0, "{found} {expected}");
        }
        assert_eq!(seen(1.0, 10.0, false), None);
    }

    #[test]
    fn a_hole_in_the_side_of_a_long_grain_is_as_large_as_on_the_ball() {
        let found = half_angle(seen(4.0, 38.0, true));
        assert!((found - 38.0).abs() < 5.0, "{found}");
        assert_eq!(seen(4.0, 25.0, true), None);
        assert_eq!(seen(4.0, 0.0, true), None);
    }
}
