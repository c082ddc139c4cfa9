//! The mesh of a union that no centre sees whole: of what is inside a lattice, its vertices on the surface.

use super::MultiSuperquadric;
use crate::mesh::{Grid, Mesh, contour};
use nalgebra::{Point3, Vector3};

/// Cells of the lattice along its longest edge, at most.
const MOST_CELLS: f64 = 400.0;

/// How near to a place of the lattice a vertex may lie, as a share of a cell: so that no triangle is a point.
const NEAREST: f64 = 1e-3;

/// A closed mesh about as fine as one of directions with so many cells along each edge of the cube. Its vertices are on
/// the surface; creases between parts are cut by as much as a cell.
pub(super) fn outside(union: &MultiSuperquadric, resolution: usize) -> Mesh {
    let [low, high] = bounds(union);
    let sides = high - low;
    let area = 2.0 * (sides.x * sides.y + sides.y * sides.z + sides.z * sides.x);
    // A cube of directions has a sixth of the box's area on each face.
    let cell = (area / 6.0).sqrt() / resolution.max(1) as f64;
    let cell = cell.max(sides.max() / MOST_CELLS);
    let counts = sides.map(|side| (side / cell).ceil() as usize);
    let place = |at: Vector3<f64>| low + (at + Vector3::repeat(0.5)) * cell;
    let mut grid = Grid::new(counts.into());
    for z in 0..counts.z {
        for y in 0..counts.y {
            let start = place(Vector3::new(0.0, y as f64, z as f64));
            for [from, to] in union.spans(&start, &Vector3::x()) {
                let first = (from / cell).ceil().max(0.0) as usize;
                let inside = (first..counts.x).take_while(|x| *x as f64 * cell <= to);
                inside.for_each(|x| grid.fill([x, y, z]));
            }
        }
    }
    let share = |at: [usize; 3], axis: usize| {
        let at = Vector3::from(at.map(|i| i as f64 - 1.0));
        let along = Vector3::ith(axis, 1.0);
        let ends = union.spans(&place(at), &along).into_iter().flatten();
        let middle = |end: &f64| (end / cell - 0.5).abs();
        let end = ends.min_by(|p, q| middle(p).total_cmp(&middle(q)));
        (end.unwrap_or(0.5 * cell) / cell).clamp(NEAREST, 1.0 - NEAREST)
    };
    let mesh = contour(&grid, share);
    let vertices = mesh.vertices.iter();
    Mesh {
        vertices: vertices
            .map(|vertex| Point3::from(place(vertex.coords)))
            .collect(),
        triangles: mesh.triangles,
    }
}

/// The corners of the box along the union's axes.
fn bounds(union: &MultiSuperquadric) -> [Vector3<f64>; 2] {
    [-1.0, 1.0].map(|side| {
        Vector3::from_fn(|axis, _| {
            let along = Vector3::ith(axis, side);
            let reach = union.parts().iter().map(|part| part.farthest(&along));
            side * reach
                .map(|place| place.dot(&along))
                .fold(f64::MIN, f64::max)
        })
    })
}
