//! Axes that voxels may have where these are not the file's.
//!
//! What marching cubes make of voxels that are in a body or not has few sides: those of voxels, and others at fixed angles to them.
//! The centres of voxels are apart by few [differences](super::recurring), likewise.

use nalgebra::{Matrix3, Point3, Vector3};

/// Triangles that are looked at.
const LOOKED_AT: usize = 1000;

/// Sides of marching cubes, one of each two that are opposite; nearly all of the area, this share of it, faces one of them.
const SIDES: usize = 25;
const SHARE: f64 = 0.95;

/// Cosines of angles that are none, and right ones.
const SAME: f64 = 0.9999;
const RIGHT: f64 = 3e-3;

/// What is found along the axes of the file, or else along any three of some directions that are at right angles.
pub(super) fn in_a_frame<T>(
    directions: impl FnOnce() -> Vec<Vector3<f64>>,
    along: impl Fn(&Matrix3<f64>) -> Option<T>,
) -> Option<T> {
    along(&Matrix3::identity()).or_else(|| frames(directions()).find_map(|frame| along(&frame)))
}

/// Any three of some directions that are at right angles; rotations.
pub(super) fn frames(directions: Vec<Vector3<f64>>) -> impl Iterator<Item = Matrix3<f64>> {
    let count = directions.len();
    let triples =
        (0..count).flat_map(move |i| (0..i).flat_map(move |j| (0..j).map(move |k| [i, j, k])));
    triples.filter_map(move |triple| {
        let [a, b, c] = triple.map(|at| directions[at]);
        let are_right = [a.dot(&b), b.dot(&c), c.dot(&a)];
        let b = (b - a * a.dot(&b)).normalize();
        let is_frame = are_right.iter().all(|cosine| cosine.abs() < RIGHT);
        is_frame.then(|| Matrix3::from_columns(&[a, b, a.cross(&b)]))
    })
}

/// The directions that nearly all faces have, up to their sign; none where these are many.
pub(super) fn sides(points: &[Point3<f64>], triangles: &[[u32; 3]]) -> Vec<Vector3<f64>> {
    let doubled_area = |corners: &[u32; 3]| {
        let [a, b, c] = corners.map(|corner| points[corner as usize]);
        (b - a).cross(&(c - a))
    };
    let every = triangles.len().div_ceil(LOOKED_AT).max(1);
    let some = triangles.iter().step_by(every).map(doubled_area);
    let mut left: Vec<Vector3<f64>> = some.collect();
    let area = |normals: &[Vector3<f64>]| normals.iter().map(Vector3::norm).sum::<f64>();
    let all = area(&left);
    let mut sides = Vec::new();
    while let Some(&first) = left.first()
        && sides.len() < SIDES
    {
        let cosine = |normal: &Vector3<f64>| normal.dot(&first) / (normal.norm() * first.norm());
        let (own, others): (Vec<Vector3<f64>>, Vec<_>) = left
            .into_iter()
            .partition(|normal| cosine(normal).abs() > SAME);
        let sum: Vector3<f64> = own
            .iter()
            .map(|normal| normal * cosine(normal).signum())
            .sum();
        sides.extend(sum.try_normalize(0.0));
        left = others;
        if own.is_empty() {
            left.remove(0);
        }
    }
    match area(&left) < (1.0 - SHARE) * all {
        true => sides,
        false => Vec::new(),
    }
}
