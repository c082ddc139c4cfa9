//! Points on large faces: of a coarse mesh, and where a hole or a cut was closed by a few faces, the vertices alone do not say
//! where the surface is.

use crate::disjoint_sets::DisjointSets;
use crate::fit::warning::FitWarning;
use crate::mesh::{Mesh, edges, undirected};
use crate::model::Frame;
use crate::sphere::cube_grid;
use crate::spread::upper_median;
use nalgebra::{Point3, Vector3};
use std::collections::{HashMap, HashSet};
use std::f64::consts::PI;

/// A face is large when two of its corners are seen at more than this angle, in radians: so far apart are the
/// farthest neighbours among a thousand even points. ...
const LARGE: f64 = 0.25;

/// ... So are the faces that close a cut or a hole: in a space in which the ellipsoid of equal second moments is a ball, one of
/// them has an edge that is seen at more than this angle, twice that between the directions, and that is so many times as long
/// as those about its ends are, ...
const RESOLVED: f64 = 0.09;
const LONGER: f64 = 4.0;

/// ... they hang together by edges that are so many times as long, ...
const LONG: f64 = 2.0;

/// ... and the edges round them are shorter than this share of the longest across them. The first row of coarse faces beside
/// fine ones has long edges on its other side.
const OF_RIM: f64 = 0.5;

/// Share of the area of such faces from which they are told.
const LEAST_TOLD: f64 = 1e-3;

/// Cells per edge of the cube of directions in which faces are met: 6146 directions.
const CELLS: usize = 32;

/// How far beyond its edges a face is met, relative to the radius: an edge between two faces belongs to one at least.
const RIM: f64 = 1e-12;

/// A face about the centre, and the cap of directions that holds it.
struct Face {
    corners: [Vector3<f64>; 3],
    is_large: bool,
    middle: Vector3<f64>,
    /// The cap's angle, in radians.
    angle: f64,
}

impl Face {
    /// `None` of a face with the centre in its plane, which is not seen.
    fn new(corners: [Vector3<f64>; 3], is_large: bool) -> Option<Self> {
        let seen = corners.map(|corner| corner.normalize());
        let middle = seen.iter().sum::<Vector3<f64>>().try_normalize(0.0)?;
        let cosine = seen.iter().map(|corner| corner.dot(&middle));
        Some(Self {
            corners,
            is_large,
            middle,
            angle: cosine.fold(1.0, f64::min).acos() + RIM,
        })
    }

    /// The radius in a direction, if the face is met there.
    fn radius(&self, n: &Vector3<f64>) -> Option<f64> {
        let [a, b, c] = &self.corners;
        let normal = (b - a).cross(&(c - a));
        let facing = normal.dot(n);
        let radius = normal.dot(a) / facing;
        let is_inside = |from: &Vector3<f64>, to: &Vector3<f64>| {
            n.dot(&from.cross(to)) * facing.signum() >= -RIM * from.norm() * to.norm()
        };
        let is_met = is_inside(a, b) && is_inside(b, c) && is_inside(c, a);
        (is_met && radius > 0.0 && radius.is_finite()).then_some(radius)
    }

    /// The heights (z) between which the cap lies.
    fn heights(&self) -> [f64; 2] {
        let theta = self.middle.z.clamp(-1.0, 1.0).acos();
        let from = (theta + self.angle).min(PI).cos();
        let to = (theta - self.angle).max(0.0).cos();
        [from - RIM, to + RIM]
    }
}

/// The triangles that close each cut or hole, by the directions in which their corners are seen in the stretched space.
fn closing(triangles: &[[u32; 3]], seen: &[Vector3<f64>]) -> Vec<Vec<u32>> {
    let length = |[from, to]: [u32; 2]| (seen[from as usize] - seen[to as usize]).norm();
    if !triangles
        .iter()
        .flat_map(edges)
        .any(|ends| length(ends) > RESOLVED)
    {
        return Vec::new();
    }
    let usual = usual(triangles, seen.len(), length);
    // How many times as long as those about its ends an edge is.
    let times = |ends: [u32; 2]| {
        let [from, to] = ends.map(|end| usual[end as usize]);
        length(ends) / from.min(to)
    };
    let mut part_of: HashMap<[u32; 2], u32> = HashMap::new();
    let mut sets = DisjointSets::new(triangles.len());
    for (at, corners) in (0..).zip(triangles) {
        for ends in edges(corners)
            .into_iter()
            .filter(|ends| times(*ends) > LONG)
        {
            let beside = *part_of.entry(undirected(ends)).or_insert(at);
            sets.join(beside, at);
        }
    }
    let is_closing = |part: &Vec<u32>| {
        let [mut across, mut rim, mut most] = [0.0_f64; 3];
        for ends in part.iter().flat_map(|&at| edges(&triangles[at as usize])) {
            let (length, times) = (length(ends), times(ends));
            match times > LONG {
                true => across = across.max(length),
                false => rim = rim.max(length),
            }
            most = most.max(times);
        }
        across > RESOLVED && most > LONGER && rim <= OF_RIM * across
    };
    let mut parts = sets.members();
    parts.retain(|part| part.len() > 1 && is_closing(part));
    parts
}

/// Whether triangles that hang together have one rim, by Euler's number: the walls of a cylinder have two.
fn is_disc(part: &[u32], triangles: &[[u32; 3]]) -> bool {
    let faces = || part.iter().map(|&at| &triangles[at as usize]);
    let corners: HashSet<u32> = faces().flatten().copied().collect();
    let sides: HashSet<[u32; 2]> = faces().flat_map(edges).map(undirected).collect();
    corners.len() + part.len() == sides.len() + 1
}

/// The median length of the edges at each vertex.
fn usual(triangles: &[[u32; 3]], vertices: usize, length: impl Fn([u32; 2]) -> f64) -> Vec<f64> {
    let mut about: Vec<Vec<f64>> = vec![Vec::new(); vertices];
    for ends in triangles.iter().flat_map(edges) {
        let length = length(ends);
        for end in ends {
            about[end as usize].push(length);
        }
    }
    let about = about.iter_mut();
    about
        .map(|lengths| upper_median(lengths).unwrap_or(0.0))
        .collect()
}

/// Points on the large faces of a mesh.
#[derive(Default)]
pub(super) struct OnFaces {
    /// In the mesh's own frame, in even directions; they depend on no order of faces or corners.
    pub(super) points: Vec<Point3<f64>>,
    /// Whether faces are large whatever those about them are.
    pub(super) are_coarse: bool,
    /// What is to be told of faces that close a cut or a hole.
    pub(super) closing: Option<FitWarning>,
}

/// The directions in which the vertices of a mesh are seen in the stretched space.
pub(in crate::fit) fn seen(
    mesh: &Mesh,
    frame: &Frame,
    semi_axes: &Vector3<f64>,
) -> Vec<Vector3<f64>> {
    let vertices = mesh.vertices.iter();
    let stretched = vertices.map(|vertex| frame.to_local(vertex).component_div(semi_axes));
    stretched.map(|place| place.normalize()).collect()
}

/// Finds them; `seen` are the [directions](seen) of the vertices.
pub(super) fn on_large_faces(
    mesh: &Mesh,
    seen: &[Vector3<f64>],
    frame: &Frame,
    semi_axes: &Vector3<f64>,
) -> OnFaces {
    let parts = closing(&mesh.triangles, seen);
    let closing = told(mesh, &parts);
    let mut are_large = vec![false; mesh.triangles.len()];
    for &at in parts.iter().flatten() {
        are_large[at as usize] = true;
    }
    let local = |vertex: &Point3<f64>| frame.to_local(vertex);
    let plain = mesh.vertices.iter().map(|vertex| local(vertex).normalize());
    let plain: Vec<Vector3<f64>> = plain.collect();
    let is_coarse =
        |[from, to]: [u32; 2]| plain[from as usize].dot(&plain[to as usize]) < LARGE.cos();
    let mut are_coarse = false;
    for (is_large, corners) in are_large.iter_mut().zip(&mesh.triangles) {
        if edges(corners).into_iter().any(is_coarse) {
            *is_large = true;
            are_coarse = true;
        }
    }
    if !are_large.contains(&true) {
        return OnFaces::default();
    }
    let faces = mesh.triangles.iter().zip(are_large);
    let faces = faces.filter_map(|(corners, is_large)| {
        let place = |at: u32| local(&mesh.vertices[at as usize]).component_div(semi_axes);
        Face::new(corners.map(place), is_large)
    });
    let faces: Vec<Face> = faces.collect();
    let (mut directions, _) = cube_grid(CELLS);
    directions.sort_by(|a, b| a.z.total_cmp(&b.z));
    // The farthest face in each direction, for what is within is not seen.
    let mut farthest = vec![(0.0, false); directions.len()];
    for face in &faces {
        let [from, to] = face.heights();
        let first = directions.partition_point(|n| n.z < from);
        for (n, found) in directions.iter().zip(&mut farthest).skip(first) {
            if n.z > to {
                break;
            }
            if let Some(radius) = face.radius(n)
                && radius > found.0
            {
                *found = (radius, face.is_large);
            }
        }
    }
    let met = directions.iter().zip(farthest);
    let points = met
        .filter(|(_, (_, is_large))| *is_large)
        .map(|(n, (radius, _))| frame.centre + frame.axes * n.component_mul(semi_axes) * radius);
    OnFaces {
        points: points.collect(),
        are_coarse,
        closing,
    }
}

/// What is to be told of a mesh whose faces close a cut or a hole; `seen` are the [directions](seen) of its vertices.
pub(in crate::fit) fn closed_by_faces(mesh: &Mesh, seen: &[Vector3<f64>]) -> Option<FitWarning> {
    told(mesh, &closing(&mesh.triangles, seen))
}

fn told(mesh: &Mesh, parts: &[Vec<u32>]) -> Option<FitWarning> {
    let area = |corners: &[u32; 3]| {
        let [a, b, c] = corners.map(|corner| mesh.vertices[corner as usize]);
        (b - a).cross(&(c - a)).norm()
    };
    let discs = parts.iter().filter(|part| is_disc(part, &mesh.triangles));
    let closing = discs
        .flatten()
        .map(|&at| area(&mesh.triangles[at as usize]));
    let share = closing.sum::<f64>() / mesh.triangles.iter().map(area).sum::<f64>();
    (share > LEAST_TOLD).then_some(FitWarning::Closing { share })
}

#[cfg(test)]
mod tests;
