//! A grid of directions without poles: the six faces of a cube, cut in n x n cells each.

use nalgebra::Vector3;

/// The finest grid of directions: 100 million of them.
pub const FINEST_GRID: usize = 4096;

/// Directions and triangles of a cube whose edges are cut in `n` equal angles: 6 n^2 + 2 unit vectors and 12 n^2
/// triangles, closed and counter-clockwise from outside. Below 1 and above [`FINEST_GRID`] the nearest number is taken.
pub fn cube_grid(n: usize) -> (Vec<Vector3<f64>>, Vec<[u32; 3]>) {
    let lattice = Lattice::new(n);
    let n = lattice.n;
    let place: Vec<f64> = (0..=n)
        .map(|i| {
            let angle = std::f64::consts::FRAC_PI_4 * (2.0 * i as f64 / n as f64 - 1.0);
            angle.tan()
        })
        .collect();
    let directions = lattice
        .points()
        .map(|point| Vector3::from(point.map(|i| place[i])).normalize())
        .collect();
    let mut triangles = Vec::with_capacity(12 * n * n);
    for axis in 0..3 {
        for side in [0, n] {
            let row = |u: usize| {
                let corner = move |v: usize| {
                    let mut point = [side; 3];
                    point[(axis + 1) % 3] = u;
                    point[(axis + 2) % 3] = v;
                    lattice.index(point) as u32
                };
                (0..=n).map(corner)
            };
            let mut before: Vec<u32> = row(0).collect();
            for u in 1..=n {
                let next: Vec<u32> = row(u).collect();
                for (along, beyond) in before.windows(2).zip(next.windows(2)) {
                    let (a, d, b, c) = (along[0], along[1], beyond[0], beyond[1]);
                    if side == n {
                        triangles.extend([[a, b, c], [a, c, d]]);
                    } else {
                        triangles.extend([[a, c, b], [a, d, c]]);
                    }
                }
                before = next;
            }
        }
    }
    (directions, triangles)
}

/// The points with coordinates 0..=n on the surface of a cube, numbered: the floor row by row, the
/// rings between, the ceiling row by row.
#[derive(Clone, Copy)]
struct Lattice {
    n: usize,
}

impl Lattice {
    fn new(n: usize) -> Self {
        Self {
            n: n.clamp(1, FINEST_GRID),
        }
    }

    /// All points in the order of their numbers.
    fn points(self) -> impl Iterator<Item = [usize; 3]> {
        let n = self.n;
        let layer = move |z: usize| (0..=n).flat_map(move |y| (0..=n).map(move |x| [x, y, z]));
        let ring = move |z: usize| {
            (0..4 * n).map(move |i| match (i / n, i % n) {
                (0, along) => [along, 0, z],
                (1, along) => [n, along, z],
                (2, along) => [n - along, n, z],
                (_, along) => [0, n - along, z],
            })
        };
        layer(0).chain((1..n).flat_map(ring)).chain(layer(n))
    }

    /// The number of a point.
    fn index(self, [x, y, z]: [usize; 3]) -> usize {
        let n = self.n;
        let floor = (n + 1) * (n + 1);
        let in_layer = y * (n + 1) + x;
        if z == 0 {
            return in_layer;
        }
        let below = floor + (z - 1) * 4 * n;
        if z == n {
            return below + in_layer;
        }
        let along = match (x, y) {
            (x, 0) if x < n => x,
            (x, y) if x == n && y < n => n + y,
            (x, y) if y == n && x > 0 => 2 * n + (n - x),
            (_, y) => 3 * n + (n - y),
        };
        below + along
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::Mesh;
    use nalgebra::Point3;

    #[test]
    fn points_are_numbered_in_their_order() {
        for n in [1, 2, 5] {
            let lattice = Lattice::new(n);
            for (number, point) in lattice.points().enumerate() {
                assert_eq!(lattice.index(point), number);
            }
        }
    }

    #[test]
    fn a_grid_is_never_too_fine_and_never_nothing() {
        let cells = [0, 7, FINEST_GRID + 1, usize::MAX].map(|n| Lattice::new(n).n);
        assert_eq!(cells, [1, 7, FINEST_GRID, FINEST_GRID]);
    }

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
