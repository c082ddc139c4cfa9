//! The points of a surface that lie nearest to given ones.

use super::Curvature;
use super::shortened::shortened;
use crate::model::Surface;
use kiddo::{ImmutableKdTree, SquaredEuclidean};
use nalgebra::{Matrix2, Point3, Vector2, Vector3};
use rayon::prelude::*;
use std::num::NonZero;

/// Cells along a cube's edge of the directions whose places the search starts from: 24 578.
const STARTS: usize = 64;

/// Places near a point that are tried as starts: two sheets of a thin wall are told apart by their feet.
const TRIED: NonZero<usize> = NonZero::new(3).unwrap();

/// Most steps of Newton's iteration, which takes some four.
const MAX_STEPS: usize = 50;

/// Share of the distance gained, below which the iteration ends.
const LEAST_GAIN: f64 = 1e-15;

/// The point of a surface that lies nearest to a given one.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Foot {
    /// The direction n of the nearest point.
    pub direction: Vector3<f64>,
    /// Distance of the given point from the surface: positive outside.
    pub distance: f64,
}

/// The nearest points of a surface to points of the scan's frame, in their order.
///
/// The nearest of a grid of places are refined by Newton's iteration on the distance. Error: rounding where the
/// surface is smooth; a hollow narrower than the grid, of a hundredth of the size, may be passed over.
pub fn feet(surface: &(impl Surface + ?Sized), points: &[Point3<f64>]) -> Vec<Foot> {
    let centre = surface.frame().centre;
    let (directions, _) = surface.grid(STARTS);
    let places = surface.places(&directions).into_iter();
    let places: Vec<[f64; 3]> = places.map(Into::into).collect();
    let tree = ImmutableKdTree::<f64, 3>::new_from_slice(&places).ok();
    let starts = |towards: &Vector3<f64>| -> Vec<usize> {
        let query: [f64; 3] = (*towards).into();
        let near = tree.iter().flat_map(|tree| {
            tree.query(&query)
                .nearest_n::<SquaredEuclidean<f64>>(TRIED)
                .execute()
        });
        near.map(|hit| hit.item as usize).collect()
    };
    let foot = |point: &Point3<f64>| {
        let towards = point - centre;
        let from = |start: usize| descend(surface, &towards, directions[start]);
        let feet = starts(&towards).into_iter().map(from);
        feet.min_by(|one, other| one.distance.abs().total_cmp(&other.distance.abs()))
            .unwrap_or_else(|| from(0))
    };
    points.par_iter().map(foot).collect()
}

/// Descends the distance from a start.
fn descend(surface: &(impl Surface + ?Sized), point: &Vector3<f64>, mut n: Vector3<f64>) -> Foot {
    let away = |n: &Vector3<f64>| (point - surface.place(n)).norm_squared();
    let mut least = away(&n);
    for _ in 0..MAX_STEPS {
        let step = step(surface, point, &n);
        let gains = |next: &Vector3<f64>| {
            Some(away(next)).filter(|away| *away < least * (1.0 - LEAST_GAIN))
        };
        match shortened(&n, &step, gains) {
            Some((next, away)) => (n, least) = (next, away),
            None => break,
        }
    }
    let jet = surface.jet(&n);
    let outside = (point - jet.place).dot(&Curvature::new(&n, &jet).normal);
    Foot {
        direction: n,
        distance: least.sqrt().copysign(outside),
    }
}

/// Newton's step on half the squared distance e'e / 2, e = X - p: its slope is e.X_t, its bend X_s.X_t + e.X_st;
/// without the second term, and always downhill, where the distance is no bowl.
fn step(surface: &(impl Surface + ?Sized), point: &Vector3<f64>, n: &Vector3<f64>) -> Vector3<f64> {
    let jet = surface.jet(n);
    let error = jet.place - point;
    let Curvature {
        steps, tangents, ..
    } = Curvature::new(n, &jet);
    let [x, y, z] = &jet.bends;
    let bend = x * error.x + y * error.y + z * error.z;
    let slope = Vector2::from_fn(|i, _| error.dot(&tangents[i]));
    let first = Matrix2::from_fn(|i, j| tangents[i].dot(&tangents[j]));
    let bowl = first + Matrix2::from_fn(|i, j| steps[i].dot(&(bend * steps[j])));
    let solved = bowl.cholesky().or_else(|| first.cholesky());
    let turn = solved.map_or(Vector2::zeros(), |bowl| bowl.solve(&slope));
    -(steps[0] * turn.x + steps[1] * turn.y)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::Radial;
    use crate::shapes::{Ellipsoid, Sampling};

    #[test]
    fn points_off_an_ellipsoid_along_its_normals_have_their_feet_and_distances() {
        let semi_axes = Vector3::new(3.0, 2.0, 1.0);
        let ellipsoid = Ellipsoid { semi_axes };
        let surface = Radial(&ellipsoid);
        // Within the least radius of curvature, 1/3, the nearest point is the one gone from.
        let normals = Sampling::Fibonacci.directions(200, 0).unwrap();
        for off in [-0.2, 0.0, 0.7] {
            let place = |normal: &Vector3<f64>| {
                let scaled = semi_axes.component_mul(normal);
                Point3::from(semi_axes.component_mul(&scaled) / scaled.norm() + normal * off)
            };
            let points: Vec<_> = normals.iter().map(place).collect();
            for (foot, (normal, point)) in feet(&surface, &points)
                .iter()
                .zip(normals.iter().zip(&points))
            {
                assert!((foot.distance - off).abs() < 1e-12, "{}", foot.distance);
                let gone = point.coords - normal * off;
                assert!((surface.place(&foot.direction) - gone).norm() < 1e-7);
            }
        }
    }
}
