//! Closed surfaces as bodies and the hollows in them.

use super::{FacesDefect, Fill, ScannedBody};
use crate::measure::crossings::clear_crossings;
use crate::measure::{SelfCrossing, self_crossing};
use crate::mesh::{Bounds, BoundsTree, Enclosing, Mesh, part, parts};
use nalgebra::Point3;
use std::cell::OnceCell;

/// Places in a part by which it is told whether they are inside of another.
const PROBES: usize = 24;

/// How far below the surface of a part they lie, as a share of its size: off the surface of another that it touches.
const BELOW: f64 = 1e-6;

/// How much of a part another one holds.
#[derive(PartialEq)]
enum Held {
    Nothing,
    Some,
    All,
}

/// One closed surface among several.
struct Part {
    mesh: Mesh,
    bounds: Bounds,
    volume: f64,
}

impl Part {
    fn new(mesh: &Mesh, triangles: &[usize]) -> Self {
        let corners = || triangles.iter().map(|&i| mesh.triangles[i]);
        let place = |corner: u32| mesh.vertices[corner as usize].coords;
        let first = triangles
            .first()
            .map(|&i| place(mesh.triangles[i][0]))
            .unwrap_or_default();
        let volumes = corners().map(|corners| {
            let [a, b, c] = corners.map(place);
            (a - first).dot(&(b - first).cross(&(c - first))) / 6.0
        });
        Self {
            mesh: part(mesh, triangles),
            bounds: Bounds::new(corners().flatten().map(|corner| place(corner).into()), 0.0),
            volume: volumes.sum(),
        }
    }

    /// The place inside, just below the middle of a triangle; `None` of one without a normal.
    fn place(&self, triangle: usize) -> Option<Point3<f64>> {
        let below = BELOW * self.bounds.size() * self.volume.signum();
        let corners = self.mesh.triangles[triangle];
        let [a, b, c] = corners.map(|corner| self.mesh.vertices[corner as usize]);
        let out = (b - a).cross(&(c - a)).try_normalize(0.0)?;
        Some(a + ((b - a) + (c - a)) / 3.0 - out * below)
    }
}

/// A part that is asked what it holds, and what others hold of it.
struct Holder<'a> {
    part: &'a Part,
    surface: Enclosing<'a>,
    /// Triangles with a normal.
    places: usize,
}

impl<'a> Holder<'a> {
    fn new(part: &'a Part) -> Self {
        let triangles = 0..part.mesh.triangles.len();
        Self {
            surface: Enclosing::new(&part.mesh),
            places: triangles.filter_map(|at| part.place(at)).count(),
            part,
        }
    }

    /// How much of this part another one holds, by the winding number about some of its places: those that lie in the
    /// other's box, where a small overlap is.
    fn held_by(&self, other: &Self) -> Held {
        let Self { part, surface, .. } = self;
        let bounds = &other.part.bounds;
        let near = surface.triangles_near(bounds).into_iter();
        let near: Vec<Point3<f64>> = near
            .filter_map(|triangle| part.place(triangle))
            .filter(|place| bounds.holds(place))
            .collect();
        let is_whole = near.len() == self.places;
        let step = near.len().div_ceil(PROBES).max(1);
        let probes = || near.iter().step_by(step);
        let is_inside = |place: &&Point3<f64>| other.surface.winding_number(place) != 0;
        match probes().filter(is_inside).count() {
            0 => Held::Nothing,
            inside if is_whole && inside == probes().count() => Held::All,
            _ => Held::Some,
        }
    }
}

/// For every part, the others whose boxes meet its own.
fn neighbours(parts: &[Part]) -> Vec<Vec<usize>> {
    let tree = BoundsTree::new(parts.iter().map(|part| part.bounds).collect());
    let of_part = |(own, part): (usize, &Part)| {
        let met = tree.meeting(&part.bounds).map(|other| other as usize);
        met.filter(|&other| other != own).collect()
    };
    parts.iter().enumerate().map(of_part).collect()
}

/// Whether triangles of different parts go through one another. Only those are looked at that other parts may reach.
fn are_crossing(
    mesh: &Mesh,
    lists: &[Vec<usize>],
    parts: &[Part],
    neighbours: &[Vec<usize>],
) -> bool {
    let mut near = Mesh {
        vertices: mesh.vertices.clone(),
        triangles: Vec::new(),
    };
    let mut owners = Vec::new();
    for (owner, (list, others)) in lists.iter().zip(neighbours).enumerate() {
        for &triangle in list {
            let corners = mesh.triangles[triangle];
            let places = corners.map(|corner| mesh.vertices[corner as usize]);
            let bounds = Bounds::new(places, 0.0);
            let meets = |&other: &usize| parts[other].bounds.meets(&bounds);
            if others.iter().any(meets) {
                near.triangles.push(corners);
                owners.push(owner);
            }
        }
    }
    clear_crossings(&near)
        .into_iter()
        .any(|[one, two]| owners[one] != owners[two])
}

/// Of parts that go through themselves, the one whose figures are farthest off.
fn worst_crossing(parts: &[Part]) -> Option<SelfCrossing> {
    let found = parts.iter().filter_map(|part| self_crossing(&part.mesh));
    let off = |crossing: &SelfCrossing| crossing.area + crossing.volume;
    found.max_by(|one, other| off(one).total_cmp(&off(other)))
}

/// The bodies of a closed mesh: outer surfaces are wound outwards, whichever way they came; inner ones must
/// be wound inwards, for a body within a body is none.
pub(super) fn arrange(mut mesh: Mesh, fill: Option<Fill>) -> ScannedBody {
    let lists = parts(&mesh);
    let parts: Vec<Part> = lists.iter().map(|list| Part::new(&mesh, list)).collect();
    let mut cavities = 0;
    let neighbours = neighbours(&parts);
    let mut is_overlapping = are_crossing(&mesh, &lists, &parts, &neighbours);
    let holders: Vec<OnceCell<Holder<'_>>> = parts.iter().map(|_| OnceCell::new()).collect();
    let holder = |at: usize| holders[at].get_or_init(|| Holder::new(&parts[at]));
    for (index, part) in parts.iter().enumerate() {
        let mut depth = 0;
        for &other in &neighbours[index] {
            let held = holder(index).held_by(holder(other));
            is_overlapping |= held == Held::Some;
            depth += usize::from(held == Held::All);
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
    let overlap = is_overlapping.then_some(FacesDefect::Overlapping { parts: parts.len() });
    let crossing = worst_crossing(&parts);
    let hiding = crossing.filter(SelfCrossing::hides_volume);
    ScannedBody {
        mesh,
        bodies: parts.len() - cavities,
        cavities,
        fill,
        crossing,
        defect: overlap.or(hiding.map(FacesDefect::Crossing)),
    }
}
