//! The surface that points without faces lie on, where no centre sees all of it: its topology, and a place on it for
//! every point.
//!
//! All voxels near a point are a crust, thinner across the surface where the neighbours of the point lie in a plane. What
//! the crust keeps apart from the outside is inside; across the crust a field goes from -1 outside to 1 inside, and mostly
//! changes near the points, for it is led well far from them. The surface is where it is zero (Hornung and Kobbelt 2006,
//! with a harmonic field for their cut). No normals are needed.

mod field;
mod voxels;

use super::error::FitError;
use super::neighbours::Neighbours;
use crate::mesh::{Grid, Mesh, contour, part, parts};
use crate::scan::drawn;
use crate::spread::{covariance, median, principal};
use field::harmonic;
use nalgebra::{Point3, Vector3};
use voxels::Voxels;

/// Points that the crust is made of; of more, so many are drawn by a hash of their coordinates.
const MOST_POINTS: usize = 20_000;

/// The spacing is the median distance of a point's neighbour of this rank.
const RANK: usize = 6;

/// Sides of voxels, and the usual reach of the crust from a point, in spacings.
const VOXEL: f64 = 0.7;
const REACH: f64 = 1.6;

/// Neighbours of a point that tell whether it lies in a plane: if their least extent is below this share of the middle
/// one.
const AROUND: usize = 12;
const FLAT: f64 = 0.35;

/// How many times less the crust reaches along the normal of such a plane: so that it leaves room in thin walls.
const SQUEEZE: f64 = 3.0;

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
    let drawn = drawn(points, MOST_POINTS);
    let spacing = spacing(&drawn);
    let squeezes = squeezes(&drawn);
    let mut failed = FitError::NoInside;
    for wider in WIDER {
        let reach = REACH * wider * spacing;
        let Some(voxels) = Voxels::new(&drawn, &squeezes, VOXEL * spacing, reach, LEAST_INSIDE)
        else {
            continue;
        };
        let mesh = surface(&voxels, spacing);
        let edges = 3 * mesh.triangles.len() as i64 / 2;
        let euler = mesh.vertices.len() as i64 - edges + mesh.triangles.len() as i64;
        let handles = usize::try_from(1 - euler / 2).unwrap_or(0);
        let share = off(&drawn, &mesh.vertices, REACH * spacing);
        let share = share.max(off(&mesh.vertices, &drawn, REACH * spacing));
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

/// Share of some points that have none of the others within reach.
fn off(all: &[Point3<f64>], others: &[Point3<f64>], reach: f64) -> f64 {
    let others: Vec<Vector3<f64>> = others.iter().map(|point| point.coords).collect();
    let near = Neighbours::new(&others);
    let is_off = |point: &&Point3<f64>| {
        let nearest = near.nearest(&point.coords, 1);
        nearest
            .first()
            .is_none_or(|at| (point.coords - others[*at]).norm() > reach)
    };
    all.iter().filter(is_off).count() as f64 / all.len().max(1) as f64
}

/// What distances grow by along the normals of planes: a point at x from another one, whose vector is s, is as far away as
/// (|x|² + (s.x)²)^½. Zero where the neighbours lie in no plane.
fn squeezes(points: &[Point3<f64>]) -> Vec<Vector3<f64>> {
    let places: Vec<Vector3<f64>> = points.iter().map(|point| point.coords).collect();
    let near = Neighbours::new(&places);
    let squeeze = |place: &Vector3<f64>| {
        let own = near.nearest(place, AROUND);
        let (_, spread) = covariance(own.iter().map(|&at| places[at]));
        let plane =
            principal(&spread).filter(|(variances, _)| variances[0] < FLAT * FLAT * variances[1]);
        plane.map_or_else(Vector3::zeros, |(_, axes)| {
            axes.column(0) * (SQUEEZE * SQUEEZE - 1.0).sqrt()
        })
    };
    places.iter().map(squeeze).collect()
}

/// The median distance of neighbours of a rank.
fn spacing(points: &[Point3<f64>]) -> f64 {
    let places: Vec<Vector3<f64>> = points.iter().map(|point| point.coords).collect();
    let near = Neighbours::new(&places);
    let distance = |place: &Vector3<f64>| {
        let last = near.nearest(place, RANK + 1).last().copied();
        last.map_or(0.0, |at| (places[at] - place).norm())
    };
    let mut distances: Vec<f64> = places.iter().map(distance).collect();
    median(&mut distances).unwrap_or(0.0)
}

#[cfg(test)]
mod tests;
