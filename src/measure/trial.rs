//! Bodies to test with.

use crate::Mesh;
use nalgebra::Point3;
use std::collections::HashMap;

/// The sides of unit cubes that no other cube covers: of those whose middles, up to so far from the origin along the axes, are inside.
pub(super) fn cubes(most: i32, is_inside: impl Fn([i32; 3]) -> bool) -> Mesh {
    let line = || -most..=most;
    let places = line().flat_map(|x| line().flat_map(move |y| line().map(move |z| [x, y, z])));
    let mut mesh = Mesh::default();
    let mut known = HashMap::new();
    for place in places.filter(|place| is_inside(*place)) {
        for (axis, side) in (0..3).flat_map(|axis| [(axis, -1), (axis, 1)]) {
            let mut beside = place;
            beside[axis] += side;
            if is_inside(beside) {
                continue;
            }
            let [a, b, c, d] = [(-1, -1), (1, -1), (1, 1), (-1, 1)].map(|(u, v)| {
                let mut corner = place.map(|x| 2 * x);
                corner[axis] += side;
                corner[(axis + 1) % 3] += u * side;
                corner[(axis + 2) % 3] += v;
                *known.entry(corner).or_insert_with(|| {
                    mesh.vertices
                        .push(Point3::from(corner.map(|x| 0.5 * f64::from(x))));
                    mesh.vertices.len() as u32 - 1
                })
            });
            mesh.triangles.extend([[a, b, c], [a, c, d]]);
        }
    }
    mesh
}
