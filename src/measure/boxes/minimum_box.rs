//! The box of least volume round a body, over all orientations.
//!
//! With one of its axes along d, the least box has the volume V(d) = (height along d) x (area of the
//! least rectangle round the projection along d), and the rectangle is found exactly by calipers. What
//! is left is to find the least V over the directions of half a sphere. V has many local minima and
//! its minima lie in creases (O'Rourke 1985: two adjacent faces of the least box each hold an edge of
//! the hull; his exact search takes O(n³)). So, as Chang, Gorissen and Melchior 2011 do it:
//!
//! 1. V is found in the directions of a grid; of small hulls also along the normals of facets and across
//!    pairs of edges, which finds the box of a cuboid or a tetrahedron.
//! 2. The least of these are refined by simplex searches (Nelder and Mead 1965) and by turning the box
//!    about each of its own axes.
//!
//! All of it is done in the body's own frame, so that the result does not depend on how it is turned: its principal axes, each
//! towards the end that reaches farther.
//!
//! Both are done on a few hundred points of the hull, at first those extreme in the directions of a
//! grid, and to a thousandth of a simplex. The box found is then tried on the whole hull, and points that are extreme near
//! its axes are added, until it hardly grows: then it is refined to the last.
//!
//! Error: the box holds all points, so its volume is never too small. Of cuboids and tetrahedra it is
//! exact to 1e-9. On random hulls of 12 to 60 corners none of 20 000 directions gives a box smaller by
//! more than 1e-6 of its volume. Of a smooth grain turned in any way it is the same to 1e-4, of one that
//! is nearly round, with many boxes of nearly the same volume, to 1e-3; round a polyhedral ball and a smaller one
//! beside it, a box is known that is smaller by 1.5e-3 (tests/trimesh/compare.py).

use super::extents::{bounds, box_along};
use super::oriented_box::OrientedBox;
use crate::Mesh;
use crate::measure::{MeshIntegralError, mesh_properties};
use crate::sphere::cube_grid;
pub(in crate::measure) use beside::boxes_beside;
use extreme_points::{Candidate, ExtremePoints, HullPoints};
use nalgebra::{Matrix3, Vector3};

mod beside;
mod extreme_points;
#[cfg(test)]
mod tests;

/// Cells per cube edge of the grid of directions whose extreme points stand for the hull at first.
const EXTREMES: usize = 6;

/// Cells per cube edge of the grid of directions that are tried: 9 degrees.
const GRID: usize = 10;

/// The same of hulls of few facets: 3 degrees.
const SMALL_GRID: usize = 30;

/// Directions that are refined, the least angle between them in radians, and the size in radians of the simplex at which
/// the refinement ends: of smooth bodies, and of hulls of few facets, whose volume has more minima and is found faster.
const STARTS: (usize, f64, f64) = (4, 0.2, 1e-6);
const SMALL_STARTS: (usize, f64, f64) = (48, 0.06, 1e-10);

/// Largest numbers of triangles whose normals, and of edges whose pairs, are tried as well.
const SMALL_TRIANGLES: usize = 600;
const SMALL_EDGES: usize = 60;

/// Rounds on the whole hull, and the share of the volume by which the box may grow on it to be refined to the last.
const ROUNDS: usize = 8;
const SETTLED: f64 = 1e-4;

/// Size of the simplex at which the refinement ends before that, relative to the first.
const COARSE: f64 = 1e-3;

/// Searches along each axis of the best box of all.
const LAST_RESTARTS: i32 = 2;

/// Size of the first simplex in a round after the first, in radians.
const NEARBY: f64 = 0.02;

/// The box of least volume round a convex hull; see the module for the error. A mesh that is not
/// convex has the same box, and takes longer.
///
/// # Errors
///
/// [`MeshIntegralError`] if the mesh is broken or has no volume.
pub fn minimum_box(hull: &Mesh) -> Result<OrientedBox, MeshIntegralError> {
    Ok(least_boxes(hull)?.least)
}

/// The box of least volume, and others.
#[derive(Debug, Clone)]
pub(in crate::measure) struct LeastBoxes {
    pub(in crate::measure) least: OrientedBox,
    /// Boxes near other local minima of the volume, some of which may be hardly larger.
    pub(in crate::measure) others: Vec<OrientedBox>,
}

/// The same, with what else was found on the way.
///
/// # Errors
///
/// As [`minimum_box`].
pub(in crate::measure) fn least_boxes(hull: &Mesh) -> Result<LeastBoxes, MeshIntegralError> {
    let mut unit = of_unit_size(hull);
    let frame = own_frame(&unit)?;
    for vertex in &mut unit.vertices {
        *vertex = frame.tr_mul(&vertex.coords).into();
    }
    let grid = |n| cube_grid(n).0.into_iter().filter(is_in_half);
    let points = HullPoints::new(&unit.vertices);
    let mut few = ExtremePoints::new(&points, grid(EXTREMES));
    let is_small = unit.triangles.len() <= SMALL_TRIANGLES;
    let mut tried: Vec<Candidate> = grid(if is_small { SMALL_GRID } else { GRID })
        .chain((0..3).map(|axis| Vector3::ith(axis, 1.0)))
        .chain(natural_directions(&unit))
        .filter_map(|direction| few.least_box(&direction))
        .collect();
    tried.sort_by(|a, b| a.volume.total_cmp(&b.volume));
    let (most, apart, last) = match is_small {
        true => SMALL_STARTS,
        false => STARTS,
    };
    let mut starts: Vec<Candidate> = Vec::with_capacity(most);
    for candidate in tried {
        let is_apart = |other: &Candidate| {
            let cosine = candidate.axes.column(2).dot(&other.axes.column(2));
            cosine.abs() < apart.cos()
        };
        if starts.len() < most && starts.iter().all(is_apart) {
            starts.push(candidate);
        }
    }
    let principal = points.box_along(&Matrix3::identity());
    let mut least = (principal.volume(), Matrix3::identity());
    let mut others = Vec::with_capacity(starts.len());
    for start in starts {
        let mut best = few.refine(start, apart / 2.0, 2, apart * COARSE);
        others.push(best.axes);
        let mut is_refined = false;
        for _ in 0..ROUNDS {
            // With more points it can only become larger; of small hulls, smaller when it is refined.
            let slack = if is_small && !is_refined {
                SETTLED
            } else {
                0.0
            };
            if best.volume >= least.0 * (1.0 + slack) {
                break;
            }
            let volume = points.box_along(&best.axes).volume();
            if volume < least.0 {
                least = (volume, best.axes);
            }
            let is_settled = volume <= best.volume * (1.0 + SETTLED);
            if is_settled && is_refined {
                break;
            }
            few.add(&points, near_axes(&best.axes).into_iter());
            let Some(grown) = few.least_box(&best.axes.column(2).into_owned()) else {
                break;
            };
            is_refined = is_settled;
            best = match is_refined {
                true => few.refine(grown, NEARBY, 2, last),
                false => few.refine(grown, NEARBY, 1, NEARBY * COARSE),
            };
        }
    }
    // A search ends early where it collapses in a crease, which is another one along each axis.
    for axis in 0..3 {
        let Some(start) = few.least_box(&least.1.column(axis).into_owned()) else {
            break;
        };
        let best = few.refine(start, NEARBY, LAST_RESTARTS, last);
        let volume = points.box_along(&best.axes).volume();
        if volume < least.0 {
            least = (volume, best.axes);
        }
    }
    let along = |axes: Matrix3<f64>| box_along(&hull.vertices, &(frame * axes));
    Ok(LeastBoxes {
        least: along(least.1),
        others: others.into_iter().map(along).collect(),
    })
}

/// The principal axes of a mesh, a rotation, of which the first two point to where it reaches farther from its centroid.
fn own_frame(mesh: &Mesh) -> Result<Matrix3<f64>, MeshIntegralError> {
    let properties = mesh_properties(mesh)?;
    let Some(principal) = properties.principal() else {
        return Ok(Matrix3::identity());
    };
    let centroid = properties.centroid.coords;
    let [low, high] = bounds(&mesh.vertices, &principal.axes);
    let middle = (low + high) / 2.0 - principal.axes.tr_mul(&centroid);
    let [first, second] = [0, 1].map(|i| {
        let axis = principal.axes.column(i).into_owned();
        axis * middle[i].signum()
    });
    Ok(Matrix3::from_columns(&[
        first,
        second,
        first.cross(&second),
    ]))
}

/// The mesh moved to the origin and scaled to a size of one.
fn of_unit_size(mesh: &Mesh) -> Mesh {
    let [low, high] = bounds(&mesh.vertices, &Matrix3::identity());
    let (centre, size) = ((low + high) / 2.0, (high - low).amax());
    Mesh {
        vertices: mesh
            .vertices
            .iter()
            .map(|vertex| (vertex - centre) / size)
            .collect(),
        triangles: mesh.triangles.clone(),
    }
}

/// Whether a direction is the one to take of itself and its opposite.
fn is_in_half(direction: &Vector3<f64>) -> bool {
    let sign = direction.iter().find(|c| c.abs() > f64::EPSILON);
    sign.is_some_and(|c| *c > 0.0)
}

/// The axes, and directions about them where their faces will touch when the box is turned a little.
fn near_axes(axes: &Matrix3<f64>) -> Vec<Vector3<f64>> {
    let axis = |i: usize| axes.column(i % 3).into_owned();
    let tilts = [(0.0, 0.0), (1.0, 0.0), (-1.0, 0.0), (0.0, 1.0), (0.0, -1.0)];
    let tilted = |i| {
        tilts.map(|(u, v)| (axis(i) + (axis(i + 1) * u + axis(i + 2) * v) * NEARBY).normalize())
    };
    (0..3).flat_map(tilted).collect()
}

/// Normals of facets, and normals to pairs of edges, of a mesh that has few of them.
fn natural_directions(mesh: &Mesh) -> Vec<Vector3<f64>> {
    let mut directions = Vec::new();
    if mesh.triangles.len() > SMALL_TRIANGLES {
        return directions;
    }
    let mut edges: Vec<Vector3<f64>> = Vec::new();
    for corners in &mesh.triangles {
        let [a, b, c] = corners.map(|corner| mesh.vertices[corner as usize]);
        directions.push((b - a).cross(&(c - a)));
        for (from, to) in [(0, 1), (1, 2), (2, 0)] {
            if corners[from] < corners[to] {
                let ends = [corners[from], corners[to]].map(|i| mesh.vertices[i as usize]);
                edges.push(ends[1] - ends[0]);
            }
        }
    }
    if edges.len() <= SMALL_EDGES {
        let pairs = (0..edges.len()).flat_map(|i| (0..i).map(move |j| (i, j)));
        directions.extend(pairs.map(|(i, j)| edges[i].cross(&edges[j])));
    }
    let lengths = directions
        .into_iter()
        .map(|n| n.try_normalize(f64::EPSILON));
    lengths.flatten().collect()
}
