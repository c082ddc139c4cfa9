//! Clouds that were thinned to means over the cells of a grid, as voxel filters do: such points lie within a round surface.
//!
//! The mean over a patch as wide as a cell of side h lies h² H / 12 within a surface of mean curvature H. So the volume is too
//! small by h²/12 times the integral of H, which of a convex body of area A is no less than sqrt(4 pi A).
//!
//! Means lie in the middle parts of their cells rather than at random, so that along each of the three axes the sum of
//! exp(2 pi i x / h) over the points is several times as long as by chance, whatever the origin of the grid. Of vertices that lie
//! on the edges of cells (marching cubes), or in their middles, it is longer still.
//!
//! On a side that lies across an axis it is the side that tells where points are along that axis, not the grid; in such a sum flat
//! bodies would show their sides only. So a point counts by the fourth power of the sine of the angle between the axis and its
//! normal.

use crate::fit::points::neighbours::Neighbours;
use crate::fit::warning::FitWarning;
use crate::measure::mesh_properties;
use crate::mesh::{Bounds, Mesh};
use crate::scan::indices_drawn;
use nalgebra::{Point3, Vector3};
use realfft::num_complex::Complex;
use std::f64::consts::{PI, TAU};

/// Fewer points are too few to tell.
const LEAST_POINTS: usize = 200;

/// Points that are looked at.
const MOST_POINTS: usize = 1000;

/// Means per area of the side of a cell, about: so many cells does a plane cut, over all its directions.
const MEANS_PER_SIDE: f64 = 1.5;

/// Sides that are tried, in that of so many cells, and steps of its reciprocal in that of the body's size; and how much finer, and
/// how many, these are beside the best.
const SIDES: [f64; 2] = [0.75, 1.25];
const STEP: f64 = 0.25;
const FINER: f64 = 5.0;
const BESIDE: usize = 25;

/// Least length of the mean of exp(2 pi i x / h) along each axis, over that which it has by chance; and its largest length, beyond
/// which places lie on the grid itself.
const BEYOND_CHANCE: f64 = 2.0;
const LARGEST: f64 = 0.7;

/// Least share of the points that have a cell for themselves; of places at random some two in three have.
const LEAST_ALONE: f64 = 0.85;

/// Least share of the values of a coordinate that are met once: lattices on round bodies, which are as even, have them in rows. Such
/// values are the same, in a body of size one.
const LEAST_DISTINCT: f64 = 0.6;
const SAME: f64 = 1e-12;

/// Least distance to the nearest point that nine in ten have, over the median, beyond which points are a lattice of directions, noisy
/// as they may be: of 99 in 100 clouds of means it is .84 at most, since cells that the surface hardly enters lie close to others, of
/// lattices of cubes on bodies that are nearly round .84 at least.
const LATTICE: f64 = 0.84;

/// Share of the body's size below which cells are too small to matter.
const SMALL: f64 = 0.01;

/// The integral of H is taken to be so many times the least that it can be: creases and tips have more.
const MORE: f64 = 1.5;

/// A point, and how much it tells of the grid along each axis.
struct Place {
    point: Point3<f64>,
    weights: [f64; 3],
}

/// What to know of points, by the polyhedron of about unit size through them, if they are such means; `unit` is its unit of length.
pub(super) fn averaged(mesh: &Mesh, unit: f64) -> Option<FitWarning> {
    let (points, body) = (&mesh.vertices, mesh_properties(mesh).ok()?);
    let [low, high] = Bounds::new(points.iter().copied(), 0.0).corners();
    let size = (high - low).amax();
    let about = (body.area / points.len() as f64 * MEANS_PER_SIDE).sqrt();
    if points.len() < LEAST_POINTS || !(SMALL * size..size).contains(&about) {
        return None;
    }
    let places = places(mesh);
    let [least, most] = [SIDES[1], SIDES[0]].map(|side| 1.0 / (side * about));
    let step = STEP / size;
    let (near, means) = strongest(&places, [least, most], step)?;
    let is_beyond_chance = (0..3).all(|axis| {
        let length = means[axis].norm();
        length * in_number(&places, axis).sqrt() > BEYOND_CHANCE && length < LARGEST
    });
    if !is_beyond_chance || (0..3).any(|axis| distinct(points, axis) < LEAST_DISTINCT) {
        return None;
    }
    if evenness(points, &places) > LATTICE {
        return None;
    }
    // Round bodies have their longest waves beside those of the grid.
    let fine = step / FINER;
    let least = near - BESIDE as f64 * fine;
    let beside = 2 * BESIDE + 1;
    let means = [0, 1, 2].map(|axis| waves(&places, axis, [least, fine], beside));
    let alone = (0..beside).map(|at| {
        let per_length = least + at as f64 * fine;
        let middles = [0, 1, 2].map(|axis| means[axis][at].arg() / TAU);
        (alone(points, middles, per_length), per_length)
    });
    let (most_alone, per_length) = alone.max_by(|(one, _), (other, _)| one.total_cmp(other))?;
    let integral = MORE * (4.0 * PI * body.area).sqrt();
    (most_alone > LEAST_ALONE).then(|| FitWarning::Averaged {
        cell: unit / per_length,
        share: integral / (36.0 * body.volume * per_length * per_length),
    })
}

/// Some vertices, and what they tell.
fn places(mesh: &Mesh) -> Vec<Place> {
    let normals = mesh.normals();
    let place = |at: usize| Place {
        point: mesh.vertices[at],
        weights: [0, 1, 2].map(|axis| (1.0 - normals[at][axis].powi(2)).powi(2)),
    };
    let some = indices_drawn(&mesh.vertices, MOST_POINTS);
    some.into_iter().map(place).collect()
}

/// How many places of weight one would have a mean along an axis that is as long by chance.
fn in_number(places: &[Place], axis: usize) -> f64 {
    let weights = || places.iter().map(|place| place.weights[axis]);
    weights().sum::<f64>().powi(2) / weights().map(|weight| weight * weight).sum::<f64>()
}

/// Of evenly spaced numbers of waves per length, that of which the three means together are longest beyond chance, and these means.
fn strongest(
    places: &[Place],
    [least, most]: [f64; 2],
    step: f64,
) -> Option<(f64, [Complex<f64>; 3])> {
    let steps = ((most - least) / step) as usize;
    let [x, y, z] = [0, 1, 2].map(|axis| waves(places, axis, [least, step], steps));
    let numbers = [0, 1, 2].map(|axis| in_number(places, axis));
    let together = |means: &[Complex<f64>; 3]| -> f64 {
        let lengths = means.iter().zip(numbers);
        lengths.map(|(mean, number)| mean.norm_sqr() * number).sum()
    };
    let (at, means) = (0..steps)
        .map(|at| (at, [x[at], y[at], z[at]]))
        .max_by(|(_, one), (_, other)| together(one).total_cmp(&together(other)))?;
    Some((least + at as f64 * step, means))
}

/// Share of the points that have a cell of a grid for themselves, by the middles of cells in waves.
fn alone(points: &[Point3<f64>], middles: [f64; 3], per_length: f64) -> f64 {
    let cell = |point: &Point3<f64>| {
        [0, 1, 2].map(|axis: usize| (point[axis] * per_length - middles[axis]).round() as i64)
    };
    let mut cells: Vec<[i64; 3]> = points.iter().map(cell).collect();
    cells.sort_unstable();
    let alone = cells
        .chunk_by(|one, other| one == other)
        .filter(|cell| cell.len() == 1);
    alone.count() as f64 / points.len() as f64
}

/// The tenth part of the distances from some points to the nearest of all, over their median.
fn evenness(points: &[Point3<f64>], some: &[Place]) -> f64 {
    let all: Vec<Vector3<f64>> = points.iter().map(|point| point.coords).collect();
    let neighbours = Neighbours::new(&all);
    let nearest = |place: &Place| {
        let from = place.point.coords;
        let found = neighbours.nearest(&from, 2);
        let other = found.into_iter().map(|at| (all[at] - from).norm());
        other.fold(0.0, f64::max)
    };
    let mut distances: Vec<f64> = some.iter().map(nearest).collect();
    distances.sort_unstable_by(f64::total_cmp);
    distances[distances.len() / 10] / distances[distances.len() / 2]
}

/// Share of the values of a coordinate that are not those of other points too.
fn distinct(points: &[Point3<f64>], axis: usize) -> f64 {
    let mut values: Vec<f64> = points.iter().map(|point| point[axis]).collect();
    values.sort_unstable_by(f64::total_cmp);
    values.dedup_by(|one, other| (*one - *other).abs() < SAME);
    values.len() as f64 / points.len() as f64
}

/// The means of exp(2 pi i f x) over places, for evenly spaced f.
fn waves(
    places: &[Place],
    axis: usize,
    [first, step]: [f64; 2],
    steps: usize,
) -> Vec<Complex<f64>> {
    let total: f64 = places.iter().map(|place| place.weights[axis]).sum();
    let turning = places.iter().map(|place| {
        let angle = TAU * place.point[axis];
        let wave = Complex::from_polar(place.weights[axis] / total, first * angle);
        [wave, Complex::from_polar(1.0, step * angle)]
    });
    let mut turning: Vec<[Complex<f64>; 2]> = turning.collect();
    let mean = |_| {
        let mut sum = Complex::ZERO;
        for [wave, by] in &mut turning {
            sum += *wave;
            *wave *= *by;
        }
        sum
    };
    (0..steps).map(mean).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shapes::Sampling;
    use crate::sphere::triangulate_directions;
    use nalgebra::Rotation3;
    use rand::SeedableRng;
    use rand_chacha::ChaCha8Rng;
    use rand_distr::{Distribution, StandardNormal};
    use std::collections::HashMap;

    /// A point of an ellipsoid.
    fn place(n: &Vector3<f64>) -> Point3<f64> {
        Point3::new(1.3 * n.x, 0.9 * n.y, 0.7 * n.z)
    }

    fn told(points: Vec<Point3<f64>>) -> Option<[f64; 2]> {
        let directions: Vec<_> = points.iter().map(|p| p.coords.normalize()).collect();
        let triangles = triangulate_directions(&directions).unwrap();
        let mesh = Mesh {
            vertices: points,
            triangles,
        };
        match averaged(&mesh, 1.0) {
            Some(FitWarning::Averaged { cell, share }) => Some([cell, share]),
            None => None,
            other => panic!("{other:?}"),
        }
    }

    /// Means of an ellipsoid over the cells of a grid whose origin is anywhere.
    fn means(side: f64) -> Vec<Point3<f64>> {
        means_of(side, place)
    }

    fn means_of(side: f64, place: impl Fn(&Vector3<f64>) -> Point3<f64>) -> Vec<Point3<f64>> {
        let directions = Sampling::Random.directions(40_000, 1).unwrap();
        let mut cells: HashMap<[i64; 3], Vec<Vector3<f64>>> = HashMap::new();
        for point in directions.iter().map(place) {
            let cell = (point / side).map(|x| (x + 0.37).floor() as i64);
            cells.entry(cell.into()).or_default().push(point.coords);
        }
        let means = cells.into_values();
        means
            .map(|cell| (cell.iter().sum::<Vector3<f64>>() / cell.len() as f64).into())
            .collect()
    }

    #[test]
    fn means_over_cells_are_told_with_their_side_and_with_what_the_volume_lacks() {
        for side in [0.1, 0.17] {
            let points = means(side);
            let volume: f64 = 4.0 / 3.0 * PI * 1.3 * 0.9 * 0.7;
            let [cell, share] = told(points).unwrap();
            assert!((cell / side - 1.0).abs() < 0.03, "{cell}");
            // h² / 12 times the integral of the mean curvature, here 1.03 times the least, by three times the volume.
            let area = 11.59_f64;
            let lack = side * side / 12.0 * 1.03 * (4.0 * PI * area).sqrt() / (3.0 * volume);
            assert!((1.1..1.9).contains(&(share / lack)), "{share} {lack}");
        }
    }

    #[test]
    fn means_of_flat_bodies_are_told_along_the_grid_and_across_it() {
        let turn = Rotation3::from_euler_angles(0.4, 0.7, 1.3);
        for [a, b, c] in [[2.0, 1.0, 0.7], [1.2, 1.2, 0.5], [1.0, 1.0, 0.4]] {
            let along = move |n: &Vector3<f64>| Point3::new(a * n.x, b * n.y, c * n.z);
            for side in [0.1, 0.2] {
                for points in [means_of(side, along), means_of(side, |n| turn * along(n))] {
                    let [cell, _] = told(points).unwrap();
                    assert!((cell / side - 1.0).abs() < 0.03, "{a} {c} {cell}");
                }
            }
        }
    }

    #[test]
    fn points_at_random_or_on_a_lattice_are_no_means() {
        let turn = Rotation3::from_euler_angles(0.4, 0.7, 1.3);
        for sampling in [
            Sampling::Random,
            Sampling::Fibonacci,
            Sampling::Cube,
            Sampling::Rings,
        ] {
            for points in [400, 900, 1500] {
                let directions = sampling.directions(points, 3).unwrap();
                let turned = directions.iter().map(|n| (turn * n).into());
                assert_eq!(told(turned.collect()), None, "{sampling:?} {points}");
                let ball = directions.iter().map(|n| (*n).into()).collect();
                assert_eq!(told(ball), None, "{sampling:?} {points}");
                let body = directions.iter().map(place).collect();
                assert_eq!(told(body), None, "{sampling:?} {points}");
            }
        }
        // Noise parts the values that lattices have in rows.
        let mut random = ChaCha8Rng::seed_from_u64(1);
        for points in [400, 900, 1500] {
            let directions = Sampling::Cube.directions(points, 3).unwrap();
            let noisy = directions.iter().map(|n| {
                let error: f64 = StandardNormal.sample(&mut random);
                (n * (1.0 + 0.01 * error)).into()
            });
            assert_eq!(told(noisy.collect()), None, "{points}");
        }
        // The middles of the cells themselves.
        let middles = means(0.1).into_iter();
        let middles = middles.map(|p| (p / 0.1).map(|x| 0.1 * (x + 0.37).floor()));
        assert_eq!(told(middles.collect()), None);
    }
}
