//! Traces in the faces of a scan that the grain does not have: steps that voxels leave, and spikes.

use crate::mesh::Mesh;
use crate::scan::each_edge;
use crate::spread::median;
use nalgebra::Vector3;
use std::f64::consts::FRAC_PI_2;

/// Bends of more than 40 degrees are sharp.
const SHARP: f64 = 0.766;

/// Of steps such a share of the length of all edges is sharp at least, and of these such a share bends inwards: of boxes none does.
const SHARE_OF_SHARP: f64 = 0.05;
const SHARE_INWARDS: f64 = 0.38;

/// Such a share of the area of steps faces one of six sides at least, but for an angle with this cosine.
const SIDES: usize = 6;
const SHARE_OF_SIDES: f64 = 0.95;
const SAME: f64 = 0.999;

/// Fewer points than this are no steps and have no spikes: they are a body of large facets.
const LEAST_POINTS: usize = 100;

/// All edges of a spike are so many times as long as others at least, the angles there add up to less than this (of a flat place
/// to four times as much), and the mesh bends sharply at its foot; cones that were made as such are fans of more triangles.
const LONG: f64 = 3.0;
const PEAKED: f64 = FRAC_PI_2;
const FAN: usize = 12;

/// Whether the faces of a closed mesh are the sides of voxels, or nearly: a fifth to a half of their area is then that of steps.
pub(crate) fn are_steps(mesh: &Mesh) -> bool {
    if mesh.vertices.len() < LEAST_POINTS || !is_of_six_sides(mesh) {
        return false;
    }
    let (mut all, mut outwards, mut inwards) = (0.0, 0.0, 0.0);
    let corner = |at: u32| mesh.vertices[at as usize];
    each_edge(mesh.vertices.len(), &mesh.triangles, |edge| {
        let Some(pair) = edge.pair() else { return };
        let [from, to] = edge.ends.map(corner);
        let length = (to - from).norm();
        all += length;
        if cosine(mesh, pair).is_some_and(|cosine| cosine < SHARP) {
            let beyond = corner(tip(mesh, pair[1], edge.ends)) - from;
            let is_inwards = doubled_area(mesh, pair[0]).dot(&beyond) > 0.0;
            *(if is_inwards {
                &mut inwards
            } else {
                &mut outwards
            }) += length;
        }
    });
    let sharp = outwards + inwards;
    sharp > SHARE_OF_SHARP * all && inwards > SHARE_INWARDS * sharp
}

/// Whether nearly all of the area faces six sides.
fn is_of_six_sides(mesh: &Mesh) -> bool {
    let triangles = 0..mesh.triangles.len();
    let mut left: Vec<Vector3<f64>> = triangles.map(|at| doubled_area(mesh, at)).collect();
    let area = |normals: &[Vector3<f64>]| normals.iter().map(Vector3::norm).sum::<f64>();
    let all = area(&left);
    for _ in 0..SIDES {
        let largest = |one: &&Vector3<f64>, other: &&Vector3<f64>| {
            one.norm_squared().total_cmp(&other.norm_squared())
        };
        let Some(&side) = left.iter().max_by(largest) else {
            break;
        };
        left.retain(|normal| normal.dot(&side) <= SAME * normal.norm() * side.norm());
    }
    area(&left) < (1.0 - SHARE_OF_SIDES) * all
}

/// How many vertices stand far out of those round them, or far in: of a tip, which may be as sharp, the flanks go on below.
pub(crate) fn spikes(mesh: &Mesh) -> usize {
    if mesh.vertices.len() < LEAST_POINTS {
        return 0;
    }
    let mut peaks = vec![Peak::default(); mesh.vertices.len()];
    let mut lengths = Vec::with_capacity(3 * mesh.triangles.len());
    for corners in &mesh.triangles {
        for turn in 0..3 {
            let [own, next, last] = [0, 1, 2].map(|step| corners[(turn + step) % 3]);
            let from = mesh.vertices[own as usize];
            let [ahead, back] = [next, last].map(|other| mesh.vertices[other as usize] - from);
            let peak = &mut peaks[own as usize];
            peak.triangles += 1;
            peak.angle += ahead.angle(&back);
            peak.shortest = peak.shortest.min(ahead.norm());
            lengths.push(ahead.norm());
        }
    }
    let long = LONG * median(&mut lengths).unwrap_or(0.0);
    let is_peaked =
        |peak: &Peak| peak.triangles <= FAN && peak.angle < PEAKED && peak.shortest > long;
    if !peaks.iter().any(is_peaked) {
        return 0;
    }
    each_edge(mesh.vertices.len(), &mesh.triangles, |edge| {
        let Some(pair) = edge.pair() else { return };
        if cosine(mesh, pair).is_some_and(|cosine| cosine < SHARP) {
            for tip in pair.map(|triangle| tip(mesh, triangle, edge.ends)) {
                peaks[tip as usize].ended += 1;
            }
        }
    });
    let is_spike = |peak: &&Peak| is_peaked(peak) && 2 * peak.ended > peak.triangles;
    peaks.iter().filter(is_spike).count()
}

/// What is round a vertex.
#[derive(Clone)]
struct Peak {
    triangles: usize,
    /// Of these, whose far edge is sharp.
    ended: usize,
    /// Sum of their angles.
    angle: f64,
    /// Of its edges.
    shortest: f64,
}

impl Default for Peak {
    fn default() -> Self {
        Self {
            triangles: 0,
            ended: 0,
            angle: 0.0,
            shortest: f64::INFINITY,
        }
    }
}

/// Of the angle by which the mesh bends between two triangles; `None` if one has no area.
fn cosine(mesh: &Mesh, pair: [usize; 2]) -> Option<f64> {
    let [one, other] = pair.map(|triangle| doubled_area(mesh, triangle).try_normalize(0.0));
    Some(one?.dot(&other?))
}

/// Along the normal, twice as long as the area.
fn doubled_area(mesh: &Mesh, triangle: usize) -> Vector3<f64> {
    let [a, b, c] = mesh.triangles[triangle].map(|at| mesh.vertices[at as usize]);
    (b - a).cross(&(c - a))
}

/// The corner of a triangle that is no end of its edge.
fn tip(mesh: &Mesh, triangle: usize, ends: [u32; 2]) -> u32 {
    let mut corners = mesh.triangles[triangle].into_iter();
    corners
        .find(|corner| !ends.contains(corner))
        .unwrap_or(ends[0])
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::measure::trial::cubes;
    use nalgebra::Point3;

    /// The sides of the voxels of a ball.
    fn steps(radius: i32) -> Mesh {
        cubes(radius, |p| {
            p.iter().map(|x| x * x).sum::<i32>() <= radius * radius
        })
    }

    #[test]
    fn sides_of_voxels_are_steps_and_facets_are_not() {
        assert!(are_steps(&steps(8)));
        // A grooved body, one with an edge, and one of a few facets.
        let grooved = Mesh::radial(24, |n| 1.0 - 0.3 * (-(10.0 * n.x).powi(2)).exp());
        for mesh in [grooved, Mesh::radial(8, |n| 1.0 / n.amax()), steps(1)] {
            assert!(!are_steps(&mesh));
        }
    }

    #[test]
    fn vertices_that_were_moved_far_are_spikes_and_tips_are_not() {
        let mut mesh = Mesh::radial(16, |n| 1.0 / (n.xy().norm() + 0.2 * n.z.abs()));
        assert_eq!(spikes(&mesh), 0);
        for (at, away) in [(100, 2.0), (900, 0.3)] {
            mesh.vertices[at] = Point3::from(mesh.vertices[at].coords * away);
        }
        assert_eq!(spikes(&mesh), 2);
    }
}
