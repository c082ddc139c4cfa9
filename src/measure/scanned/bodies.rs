//! Closed surfaces as bodies and the hollows in them.

use super::{FacesDefect, Fill, ScannedBody};
use crate::measure::crossings;
use crate::measure::winding::winding_number;
use crate::mesh::{Mesh, part, parts};
use nalgebra::{Point3, Vector3};

/// Triangles of a part by whose middles it is told whether it is inside of another.
const PROBES: usize = 24;

/// How far from a whole number the winding number about a place off a closed surface may be, by rounding.
const WHOLE: f64 = 1e-3;

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

    fn meets(&self, low: &Vector3<f64>, high: &Vector3<f64>) -> bool {
        self.low <= *high && *low <= self.high
    }

    /// How many of some of the triangles, and of how many, another part holds; those that lie in its surface do not count.
    fn probes_inside(&self, other: &Self) -> (usize, usize) {
        let step = self.mesh.triangles.len().div_ceil(PROBES);
        let probes = self.mesh.triangles.iter().step_by(step);
        let probes = probes.map(|corners| {
            let [a, b, c] = corners.map(|corner| self.mesh.vertices[corner as usize]);
            a + ((b - a) + (c - a)) / 3.0
        });
        let turns = |probe: Point3<f64>| match other.meets(&probe.coords, &probe.coords) {
            true => winding_number(&other.mesh, &probe),
            false => 0.0,
        };
        let off = probes
            .map(turns)
            .filter(|turns| (turns - turns.round()).abs() < WHOLE);
        off.fold((0, 0), |(inside, all), turns| {
            (inside + usize::from(turns.abs() > 0.5), all + 1)
        })
    }
}

/// Whether triangles of different parts go through one another. Only those are looked at that other parts may reach.
fn are_crossing(mesh: &Mesh, lists: &[Vec<usize>], parts: &[Part]) -> bool {
    let mut near = Mesh {
        vertices: mesh.vertices.clone(),
        triangles: Vec::new(),
    };
    let mut owners = Vec::new();
    for (owner, (list, part)) in lists.iter().zip(parts).enumerate() {
        let is_other = |&(index, other): &(usize, &Part)| {
            index != owner && part.meets(&other.low, &other.high)
        };
        let others: Vec<&Part> = parts
            .iter()
            .enumerate()
            .filter(is_other)
            .map(|(_, other)| other)
            .collect();
        for &triangle in list {
            let corners = mesh.triangles[triangle];
            let [a, b, c] = corners.map(|corner| mesh.vertices[corner as usize].coords);
            let (low, high) = (a.inf(&b).inf(&c), a.sup(&b).sup(&c));
            if others.iter().any(|other| other.meets(&low, &high)) {
                near.triangles.push(corners);
                owners.push(owner);
            }
        }
    }
    crossings(&near)
        .into_iter()
        .any(|[one, two]| owners[one] != owners[two])
}

/// The bodies of a closed mesh: outer surfaces are wound outwards, whichever way they came; inner ones must
/// be wound inwards, for a body within a body is none.
pub(super) fn arrange(mut mesh: Mesh, fill: Option<Fill>) -> ScannedBody {
    let lists = parts(&mesh);
    let parts: Vec<Part> = lists.iter().map(|list| Part::new(&mesh, list)).collect();
    let mut cavities = 0;
    let mut is_overlapping = are_crossing(&mesh, &lists, &parts);
    for (index, part) in parts.iter().enumerate() {
        let mut depth = 0;
        for other in (0..parts.len()).filter(|&other| other != index) {
            let (inside, all) = part.probes_inside(&parts[other]);
            is_overlapping |= inside > 0 && inside < all;
            depth += usize::from(inside > 0 && inside == all);
        }
        let is_inner = depth % 2 == 1;
        cavities += usize::from(is_inner && part.volume < 0.0);
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
