//! A part of the vertices of a mesh.

use nalgebra::Point3;

/// Keeps the vertices of which `is_kept` says so, and numbers the corners of triangles anew, which name no others.
pub(crate) fn keep_vertices(
    vertices: &mut Vec<Point3<f64>>,
    triangles: &mut [[u32; 3]],
    is_kept: &[bool],
) {
    let mut numbers = Vec::with_capacity(is_kept.len());
    let mut kept = 0;
    for is_kept in is_kept {
        numbers.push(kept);
        kept += u32::from(*is_kept);
    }
    for corner in triangles.as_flattened_mut() {
        *corner = numbers[*corner as usize];
    }
    let mut flags = is_kept.iter();
    vertices.retain(|_| flags.next() == Some(&true));
}
