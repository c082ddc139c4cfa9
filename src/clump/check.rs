//! Whether a mesh is the surface of a grain.

use super::error::ClumpError;
use super::search::UNIT_VOLUME;
use crate::Mesh;
use crate::measure::mesh_properties;
use crate::scan::each_edge;

/// How far the volume inside a mesh may be off the grain's, as a share of it: coarse meshes of a ball lack as much.
const MOST_OFF: f64 = 0.25;

/// The least volume inside, as a share of area^1.5: that of a plate two thousand times as wide as thick, in which the spheres
/// that are looked for are lost in rounding.
const LEAST_INSIDE: f64 = 1e-4;

/// Refuses a mesh at unit size that encloses nothing, is wound inwards, or is not that of the grain. Every triangle must name
/// vertices that exist.
pub(super) fn check(mesh: &Mesh) -> Result<(), ClumpError> {
    if !is_closed(mesh) {
        return Err(ClumpError::NoInside);
    }
    let found = mesh_properties(mesh).map_err(|_| ClumpError::NoInside)?;
    let excess = found.volume / UNIT_VOLUME - 1.0;
    match found.volume > LEAST_INSIDE * found.area.powf(1.5) {
        true if excess.abs() <= MOST_OFF => Ok(()),
        true => Err(ClumpError::Volume { excess }),
        false => Err(ClumpError::NoInside),
    }
}

/// Whether each edge is walked as often one way as the other.
fn is_closed(mesh: &Mesh) -> bool {
    let mut is_closed = true;
    each_edge(mesh.vertices.len(), &mesh.triangles, |edge| {
        let is_point = edge.ends[0] == edge.ends[1];
        is_closed &= is_point || edge.forward == edge.backward;
    });
    is_closed
}
