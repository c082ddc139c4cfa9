//! A grid of directions without poles: the six faces of a cube, cut in n x n cells each.

use nalgebra::Vector3;

/// Directions and triangles of a cube whose edges are cut in `n` >= 1 equal angles: 6 n^2 + 2 unit
/// vectors and 12 n^2 triangles, closed and counter-clockwise from outside.
pub fn cube_grid(n: usize) -> (Vec<Vector3<f64>>, Vec<[u32; 3]>) {
    let n = n.max(1);
    let place: Vec<f64> = (0..=n)
        .map(|i| {
            let angle = std::f64::consts::FRAC_PI_4 * (2.0 * i as f64 / n as f64 - 1.0);
            angle.tan()
        })
        .collect();
    let mut directions = Vec::with_capacity(6 * n * n + 2);
    let mut triangles = Vec::with_capacity(12 * n * n);
    let mut known = std::collections::HashMap::new();
    let mut index_of = |lattice: [usize; 3]| {
        *known.entry(lattice).or_insert_with(|| {
            directions.push(Vector3::from(lattice.map(|i| place[i])).normalize());
            (directions.len() - 1) as u32
        })
    };
    for axis in 0..3 {
        for side in [0, n] {
            let mut corner = |u: usize, v: usize| {
                let mut lattice = [side; 3];
                lattice[(axis + 1) % 3] = u;
                lattice[(axis + 2) % 3] = v;
                index_of(lattice)
            };
            for (u, v) in (0..n).flat_map(|u| (0..n).map(move |v| (u, v))) {
                let (a, b) = (corner(u, v), corner(u + 1, v));
                let (c, d) = (corner(u + 1, v + 1), corner(u, v + 1));
                if side == n {
                    triangles.extend([[a, b, c], [a, c, d]]);
                } else {
                    triangles.extend([[a, c, b], [a, d, c]]);
                }
            }
        }
    }
    (directions, triangles)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::Mesh;
    use nalgebra::Point3;

    #[test]
    fn the_grid_is_closed_and_faces_outwards_at_every_size() {
        for n in [1, 2, 3, 16] {
            let (directions, triangles) = cube_grid(n);
            assert_eq!(directions.len(), 6 * n * n + 2);
            assert_eq!(triangles.len(), 12 * n * n);
            for corners in &triangles {
                let [a, b, c] = corners.map(|i| directions[i as usize]);
                assert!((b - a).cross(&(c - a)).dot(&a) > 0.0);
            }
            let vertices = directions.into_iter().map(Point3::from).collect();
            Mesh {
                vertices,
                triangles,
            }
            .check_closed()
            .expect("closed");
        }
    }
}
