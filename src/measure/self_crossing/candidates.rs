//! Triangles that may go through others.
//!
//! Seen from a point round which the surface winds once, every direction meets one triangle more that faces away from that
//! point than towards it. Where two triangles cross, nearby directions meet both of them, and so a third one, and one of
//! these faces the point. So only triangles in the directions of those that face it can cross any: of most grains a few.

use crate::mesh::{Bounds, BoundsTree, Mesh, winding_number};
use crate::predicates::orient3d;
use nalgebra::Point3;

/// Share of the triangles that face the middle beyond which all are looked at.
const FEW: f64 = 0.1;

/// The indices of the triangles that may go through others, in order; `None` where none can, nor any patch of the surface be
/// inside out. The mesh must be closed and wound outwards; `middle` is the centroid of what it encloses.
pub(super) fn candidates(mesh: &Mesh, middle: &Point3<f64>) -> Option<Vec<usize>> {
    let all = || Some((0..mesh.triangles.len()).collect());
    let corners = |corners: &[u32; 3]| corners.map(|corner| mesh.vertices[corner as usize]);
    let faces_middle = |triangle: &&[u32; 3]| orient3d(corners(triangle), *middle) <= 0.0;
    let facing: Vec<&[u32; 3]> = mesh.triangles.iter().filter(faces_middle).collect();
    let once = || (winding_number(mesh, middle) - 1.0).abs() < 0.5;
    if facing.len() as f64 > FEW * mesh.triangles.len() as f64 || !once() {
        return all();
    }
    if facing.is_empty() {
        return None;
    }
    let directions: Vec<Point3<f64>> = mesh
        .vertices
        .iter()
        .map(|vertex| (vertex - middle).try_normalize(0.0).unwrap_or_default())
        .map(Point3::from)
        .collect();
    let seen = |triangle: &[u32; 3]| round(triangle.map(|corner| directions[corner as usize]));
    let facing = BoundsTree::new(facing.into_iter().map(seen).collect());
    let meets = |at: &usize| facing.meeting(&seen(&mesh.triangles[*at])).next().is_some();
    Some((0..mesh.triangles.len()).filter(meets).collect())
}

/// A box round all directions in which a triangle is seen. They lie between those of its corners, and so far beyond the box
/// round these as the arcs between them are above the chords. A corner without a direction makes it that of all.
fn round(corners: [Point3<f64>; 3]) -> Bounds {
    let [a, b, c] = corners;
    let chord = [b - a, c - b, a - c].map(|side| side.norm_squared());
    let squared = chord.into_iter().fold(0.0, f64::max);
    // Any p between corners on the sphere has 1 - |p|^2 of at most a third of the largest squared chord.
    let beyond = if squared < 1.0 { squared / 3.0 } else { 2.0 };
    Bounds::new(corners, beyond)
}
