//! Traces in the faces of a scan that the grain does not have: steps that voxels leave, and spikes.

use crate::mesh::Mesh;
use crate::scan::each_edge;
use crate::spread::upper_median;
use nalgebra::Vector3;
use std::f64::consts::FRAC_PI_2;

/// Bends of more than 40 degrees are sharp.
const SHARP: f64 = 0.766;

/// Faces that voxels leave.
struct Steps {
    /// Nearly all of their area faces one of so many sides.
    sides: usize,
    /// The share of the length of all edges that is sharp at least, ...
    sharp: f64,
    /// ... and the share of these that bends inwards: of boxes and cut stones none does.
    inwards: f64,
}

/// Sides of the voxels themselves, and what marching cubes leave of voxels that are within a body or not: vertices in the middle
/// between two voxels.
const STEPS: [Steps; 2] = [
    Steps {
        sides: 6,
        sharp: 0.05,
        inwards: 0.38,
    },
    Steps {
        sides: 50,
        sharp: 0.1,
        inwards: 0.15,
    },
];

/// Such a share of the area faces a side at least, but for an angle with this cosine.
const SHARE_OF_SIDES: f64 = 0.95;
const SAME: f64 = 0.999;

/// Of steps the first sides take more than this share of the area, of grains with texture a thousandth.
const FIRST: usize = 6;
const SHARE_OF_FIRST: f64 = 0.05;

/// Fewer points than this are no steps and have no spikes: they are a body of large facets.
const LEAST_POINTS: usize = 100;

/// All edges of a spike are so many times as long as others at least, the angles there add up to less than this (of a flat place
/// to four times as much), and the mesh bends sharply at its foot; cones that were made as such are fans of more triangles.
const LONG: f64 = 3.0;
const PEAKED: f64 = FRAC_PI_2;
const FAN: usize = 12;

/// Whether the faces of a closed mesh are steps between voxels, or nearly: a twelfth to a half of their area is then that of steps.
pub(crate) fn are_steps(mesh: &Mesh) -> bool {
    if mesh.vertices.len() < LEAST_POINTS {
        return false;
    }
    let Some(sides) = sides(mesh) else {
        return false;
    };
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
    STEPS.iter().any(|steps| {
        sides <= steps.sides && sharp > steps.sharp * all && inwards > steps.inwards * sharp
    })
}

/// How many sides nearly all of the area faces. `None` if they are more than those of steps.
fn sides(mesh: &Mesh) -> Option<usize> {
    let triangles = 0..mesh.triangles.len();
    let mut left: Vec<Vector3<f64>> = triangles.map(|at| doubled_area(mesh, at)).collect();
    let area = |normals: &[Vector3<f64>]| normals.iter().map(Vector3::norm).sum::<f64>();
    let all = area(&left);
    let most = STEPS.iter().map(|steps| steps.sides).max()?;
    for taken in 1..=most {
        let largest = |one: &&Vector3<f64>, other: &&Vector3<f64>| {
            one.norm_squared().total_cmp(&other.norm_squared())
        };
        let side = *left.iter().max_by(largest)?;
        left.retain(|normal| normal.dot(&side) <= SAME * normal.norm() * side.norm());
        let share = 1.0 - area(&left) / all;
        if share > SHARE_OF_SIDES {
            return Some(taken);
        }
        if taken == FIRST && share < SHARE_OF_FIRST {
            return None;
        }
    }
    None
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
    let long = LONG * upper_median(&mut lengths).unwrap_or(0.0);
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
    use crate::mesh::{Grid, contour};
    use nalgebra::{Point3, Rotation3};

    /// The sides of the voxels of a ball.
    fn steps(radius: i32) -> Mesh {
        cubes(radius, |p| is_within(p, radius))
    }

    fn is_within(p: [i32; 3], radius: i32) -> bool {
        p.iter().map(|x| x * x).sum::<i32>() <= radius * radius
    }

    /// What marching cubes make of them, moved.
    fn between(radius: i32, moved: impl Fn(Vector3<f64>) -> Vector3<f64>) -> Mesh {
        let side = 2 * radius as usize + 1;
        let mut grid = Grid::new([side; 3]);
        let line = || 0..side;
        let places = line().flat_map(|x| line().flat_map(move |y| line().map(move |z| [x, y, z])));
        for voxel in places.filter(|place| is_within(place.map(|x| x as i32 - radius), radius)) {
            grid.fill(voxel);
        }
        let mut mesh = contour(&grid, |_, _| 0.5);
        for vertex in &mut mesh.vertices {
            *vertex = moved(vertex.coords).into();
        }
        mesh
    }

    /// Voxels that are longer than wide, along no axis of the file.
    fn turned(place: Vector3<f64>) -> Vector3<f64> {
        Rotation3::from_euler_angles(0.4, 0.7, 1.3) * Vector3::new(place.x, place.y, 1.7 * place.z)
    }

    #[test]
    fn sides_of_voxels_are_steps_and_facets_are_not() {
        assert!(are_steps(&steps(8)));
        assert!(are_steps(&between(8, |steps| steps)) && are_steps(&between(5, turned)));
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
