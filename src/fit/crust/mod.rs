//! The surface that points without faces lie on, where no centre sees all of it: its topology, and a place on it for
//! every point.
//!
//! All voxels near a point are a crust, thinner across the surface where the neighbours of the point lie in a plane. What
//! the crust keeps apart from the outside is inside; across the crust a field goes from -1 outside to 1 inside, and mostly
//! changes near the points, for it is led well far from them. The surface is where it is zero (Hornung and Kobbelt 2006,
//! with a harmonic field for their cut). No normals are needed. Where points are much sparser in one part than in another, a
//! crust that is as wide everywhere leaks there or fills thin walls here: it is then as wide as the points around are apart.

mod alone;
mod cloud;
mod field;
mod voxels;

use super::error::FitError;
use super::points::neighbours::Neighbours;
use crate::mesh::{Grid, Mesh, contour, part, parts};
use crate::scan::drawn;
pub(super) use alone::without_alone;
use cloud::Cloud;
use field::harmonic;
use nalgebra::{Point3, Vector3};
use voxels::Voxels;

/// Points that the crust is made of; of more, so many are drawn by a hash of their coordinates.
const MOST_POINTS: usize = 20_000;

/// Sides of voxels, and the usual reach of the crust from a point, in spacings.
const VOXEL: f64 = 0.7;
const REACH: f64 = 1.6;

/// Factors by which the reach is tried, until the surface is closed, has no handle and lies on the points. A narrow crust
/// leaks between points laid at random, a wide one fills thin walls.
const WIDER: [f64; 6] = [0.7, 0.8, 0.9, 1.0, 1.25, 1.6];

/// Share of the box of the points that the inside fills at least.
const LEAST_INSIDE: f64 = 0.02;

/// Share of the points that may lie off the surface, and of the surface off the points, by more than the reach.
const LARGEST_OFF: f64 = 0.01;

/// Finds the surface of a cloud of points: closed, of one piece, and without handles.
///
/// # Errors
/// [`FitError::NoInside`], [`FitError::Ring`] or [`FitError::OffCrust`] where the points enclose nothing, enclose a ring, or
/// do not lie on the surface found.
pub(super) fn surface_of_points(points: &[Point3<f64>]) -> Result<Mesh, FitError> {
    let cloud = Cloud::new(drawn(points, MOST_POINTS));
    surface_of(&cloud).or_else(|error| match cloud.by_density() {
        Some(cloud) => surface_of(&cloud),
        None => Err(error),
    })
}

/// The surface of a cloud, through a crust that is as wide as it has to be.
fn surface_of(cloud: &Cloud) -> Result<Mesh, FitError> {
    let mut failed = FitError::NoInside;
    for wider in WIDER {
        let reach = REACH * wider * cloud.spacing;
        let Some(voxels) = Voxels::new(cloud, VOXEL * cloud.spacing, reach, LEAST_INSIDE) else {
            continue;
        };
        let mesh = surface(&voxels, cloud.spacing);
        let edges = 3 * mesh.triangles.len() as i64 / 2;
        let euler = mesh.vertices.len() as i64 - edges + mesh.triangles.len() as i64;
        let handles = usize::try_from(1 - euler / 2).unwrap_or(0);
        let share = off(cloud, &mesh.vertices);
        failed = match (handles, share > LARGEST_OFF) {
            (0, false) => return Ok(mesh),
            (0, true) => FitError::OffCrust { share },
            _ => FitError::Ring { handles },
        };
    }
    Err(failed)
}

/// The zero of the field, its largest part.
fn surface(voxels: &Voxels, spacing: f64) -> Mesh {
    let field = harmonic(voxels, spacing);
    let [width, height, _] = voxels.size;
    let index = |[x, y, z]: [usize; 3]| x + width * (y + height * z);
    let mut grid = Grid::new(voxels.size);
    for (at, value) in field.iter().enumerate() {
        if *value > 0.0 {
            grid.fill([at % width, at / width % height, at / (width * height)]);
        }
    }
    let share = |lower: [usize; 3], axis: usize| {
        // The outermost voxels are outside, so that the margin is never asked for.
        let lower = lower.map(|i| i - 1);
        let mut upper = lower;
        upper[axis] += 1;
        let [low, high] = [lower, upper].map(|at| field[index(at)]);
        (low / (low - high)).clamp(0.05, 0.95)
    };
    let mesh = contour(&grid, share);
    let largest = parts(&mesh).into_iter().max_by_key(Vec::len);
    let mut mesh = part(&mesh, &largest.unwrap_or_default());
    for vertex in &mut mesh.vertices {
        *vertex = voxels.origin + vertex.coords * voxels.side;
    }
    mesh
}

/// Share of the points that have no vertex within reach, or of the vertices that have no point: the larger one.
fn off(cloud: &Cloud, vertices: &[Point3<f64>]) -> f64 {
    let reach = |of: usize| REACH * cloud.spacing * cloud.scales[of];
    let points = nearest(&cloud.points, vertices)
        .enumerate()
        .map(|(own, vertex)| vertex.is_none_or(|(_, distance)| distance > reach(own)));
    let vertices = nearest(vertices, &cloud.points)
        .map(|point| point.is_none_or(|(at, distance)| distance > reach(at)));
    share(points).max(share(vertices))
}

/// The nearest of some others to each point, and its distance.
fn nearest(
    all: &[Point3<f64>],
    others: &[Point3<f64>],
) -> impl ExactSizeIterator<Item = Option<(usize, f64)>> {
    let others: Vec<Vector3<f64>> = others.iter().map(|point| point.coords).collect();
    let near = Neighbours::new(&others);
    all.iter().map(move |point| {
        let at = *near.nearest(&point.coords, 1).first()?;
        Some((at, (point.coords - others[at]).norm()))
    })
}

/// Share of those that are.
fn share(all: impl ExactSizeIterator<Item = bool>) -> f64 {
    let count = all.len().max(1);
    all.filter(|is| *is).count() as f64 / count as f64
}

#[cfg(test)]
mod tests;
