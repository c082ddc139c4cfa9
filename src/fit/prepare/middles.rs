//! The middles of a mesh's large faces, where a surface through the corners alone may ripple.

use crate::mesh::{Mesh, edges};
use crate::spread::upper_median;
use nalgebra::{Matrix3, Point3, Vector3};
use std::f64::consts::PI;

/// Edges that are seen at less than this angle (radians), half the shortest wave of any estimate, have no ripples between their ends.
const FINEST: f64 = PI / 80.0;

/// Nor are there many between those of even faces: large ones are so many times as wide as the median of all.
const LARGE: f64 = 2.0;

/// The middle of a face.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Middle {
    /// In the scan's frame.
    pub(crate) place: Point3<f64>,
    /// Of the face, in the grain's own frame, of unit length.
    pub(crate) normal: Vector3<f64>,
    /// Share of the mesh's area that it has.
    pub(crate) share: f64,
    /// The angle at which its longest edge is seen, in radians, where the ellipsoid of equal second moments is a ball.
    pub(crate) width: f64,
    /// How far off it a smooth surface lies that goes through the corners, normal to the mean normals there: half of what the
    /// planes at the corners are off, in the mean.
    pub(crate) bulge: f64,
}

/// Those of large faces between whose corners an estimate could ripple, in the grain's axes; `seen` are the
/// [directions](super::facets::seen) of the vertices.
pub(super) fn middles(mesh: &Mesh, seen: &[Vector3<f64>], axes: &Matrix3<f64>) -> Vec<Middle> {
    let width = |corners: &[u32; 3]| {
        let length = |[from, to]: [u32; 2]| (seen[from as usize] - seen[to as usize]).norm();
        edges(corners).map(length).into_iter().fold(0.0, f64::max)
    };
    let widths: Vec<f64> = mesh.triangles.iter().map(width).collect();
    if widths.iter().all(|width| *width <= FINEST) {
        return Vec::new();
    }
    let usual = upper_median(&mut widths.clone()).unwrap_or(0.0);
    let least = FINEST.max(LARGE * usual);
    if widths.iter().all(|width| *width <= least) {
        return Vec::new();
    }
    let normals = mesh.normals();
    let corners = |face: &[u32; 3]| face.map(|at| mesh.vertices[at as usize].coords);
    let crossed = |[a, b, c]: [Vector3<f64>; 3]| (b - a).cross(&(c - a));
    let faces = mesh.triangles.iter();
    let area: f64 = faces.map(|face| crossed(corners(face)).norm()).sum();
    let middle = |(face, width): (&[u32; 3], f64)| {
        let places = corners(face);
        let place = places.iter().sum::<Vector3<f64>>() / 3.0;
        let crossed = crossed(places);
        let off = face.iter().zip(&places);
        let off = off.map(|(&at, corner)| normals[at as usize].dot(&(corner - place)).abs());
        Some(Middle {
            place: place.into(),
            normal: axes.tr_mul(&crossed.try_normalize(0.0)?),
            share: crossed.norm() / area,
            width,
            bulge: off.sum::<f64>() / 6.0,
        })
    };
    let faces = mesh.triangles.iter().zip(widths);
    let large = faces.filter(|(_, width)| *width > least);
    large.filter_map(middle).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;

    #[test]
    fn a_ball_bulges_as_far_over_the_middles_as_they_lie_within_it() {
        let ball = |resolution: usize| Mesh::radial(resolution, |_| 2.0);
        let of = |mesh: &Mesh| {
            let seen = mesh.vertices.iter().map(|vertex| vertex.coords.normalize());
            middles(mesh, &seen.collect::<Vec<_>>(), &Matrix3::identity())
        };
        let (fine, coarse) = (ball(64), ball(16));
        assert!(of(&fine).is_empty() && of(&coarse).is_empty());
        // North of a gap coarse, and fine elsewhere.
        let faces = |mesh: &Mesh, is_kept: &dyn Fn(f64) -> bool, first: u32| -> Vec<[u32; 3]> {
            let is_kept = |face: &&[u32; 3]| {
                let mut heights = face.iter().map(|&at| mesh.vertices[at as usize].z);
                heights.all(is_kept)
            };
            let kept = mesh.triangles.iter().filter(is_kept);
            kept.map(|face| face.map(|at| first + at)).collect()
        };
        let first = fine.vertices.len() as u32;
        let north = faces(&coarse, &|z| z > 1.0, first);
        let south = faces(&fine, &|z| z < 0.8, 0);
        let middles = of(&Mesh {
            vertices: [fine.vertices, coarse.vertices].concat(),
            triangles: [south, north.clone()].concat(),
        });
        assert_eq!(middles.len(), north.len());
        for middle in middles.iter().filter(|middle| middle.place.z > 1.3) {
            let depth = 2.0 - middle.place.coords.norm();
            assert_relative_eq!(middle.bulge, depth, max_relative = 0.2);
            assert_relative_eq!(middle.normal.norm(), 1.0, max_relative = 1e-12);
        }
        let share: f64 = middles.iter().map(|middle| middle.share).sum();
        assert!((0.2..0.35).contains(&share), "{share}");
    }
}
