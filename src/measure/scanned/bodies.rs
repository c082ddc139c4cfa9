//! Closed surfaces as bodies and the hollows in them.

use super::{FacesDefect, Fill, ScannedBody};
use crate::measure::winding::winding_number;
use crate::mesh::{Mesh, part, parts};
use nalgebra::{Point3, Vector3};

/// Vertices of a part by which it is told whether it is inside of another.
const PROBES: usize = 24;

/// One closed surface among several.
struct Part {
    mesh: Mesh,
    low: Vector3<f64>,
    high: Vector3<f64>,
    volume: f64,
}

impl Part {
    fn new(mesh: &Mesh, triangles: &[usize]) -> Self {
        let corners = || triangles.iter().map(|&i| mesh.triangles[i]);
        let place = |corner: u32| mesh.vertices[corner as usize].coords;
        let first = triangles
            .first()
            .map_or_else(Vector3::zeros, |&i| place(mesh.triangles[i][0]));
        let (mut low, mut high, mut volume) = (first, first, 0.0);
        for corners in corners() {
            let [a, b, c] = corners.map(place);
            for corner in [a, b, c] {
                (low, high) = (low.inf(&corner), high.sup(&corner));
            }
            volume += (a - first).dot(&(b - first).cross(&(c - first))) / 6.0;
        }
        Self {
            mesh: part(mesh, triangles),
            low,
            high,
            volume,
        }
    }

    /// How many of some of the vertices, and of how many, another part holds.
    fn probes_inside(&self, other: &Self) -> (usize, usize) {
        let step = self.mesh.triangles.len().div_ceil(PROBES);
        let probes = self.mesh.triangles.iter().step_by(step);
        let probes = probes.map(|corners| self.mesh.vertices[corners[0] as usize]);
        let is_inside = |probe: &Point3<f64>| {
            let is_near = other.low <= probe.coords && probe.coords <= other.high;
            is_near && winding_number(&other.mesh, probe).abs() > 0.5
        };
        let (inside, all): (usize, usize) = probes.fold((0, 0), |(inside, all), probe| {
            (inside + usize::from(is_inside(&probe)), all + 1)
        });
        (inside, all)
    }
}

/// The bodies of a closed mesh: outer surfaces are wound outwards, whichever way they came; inner ones must
/// be wound inwards, for a body within a body is none.
pub(super) fn arrange(mut mesh: Mesh, fill: Option<Fill>) -> ScannedBody {
    let lists = parts(&mesh);
    let parts: Vec<Part> = lists.iter().map(|list| Part::new(&mesh, list)).collect();
    let mut cavities = 0;
    let mut is_overlapping = false;
    for (index, part) in parts.iter().enumerate() {
        let mut depth = 0;
        for other in (0..parts.len()).filter(|&other| other != index) {
            let (inside, all) = part.probes_inside(&parts[other]);
            is_overlapping |= inside > 0 && inside < all;
            depth += usize::from(inside == all);
        }
        let is_inner = depth % 2 == 1;
        cavities += usize::from(is_inner);
        is_overlapping |= is_inner && part.volume > 0.0;
        if !is_inner && part.volume < 0.0 {
            for &triangle in &lists[index] {
                mesh.triangles[triangle].reverse();
            }
        }
    }
    ScannedBody {
        mesh,
        bodies: parts.len() - cavities,
        cavities,
        fill,
        defect: is_overlapping.then_some(FacesDefect::Overlapping { parts: parts.len() }),
    }
}
