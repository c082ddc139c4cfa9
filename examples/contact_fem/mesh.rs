//! Bricks that fill an octant of a body, finest where it is pressed.

use grainform::StarSurface;
use nalgebra::Vector3;
use std::f64::consts::SQRT_2;

/// An octant of a body that is symmetric in the three coordinate planes, as bricks with eight nodes.
pub(crate) struct Mesh {
    /// Where the nodes are.
    pub(crate) nodes: Vec<Vector3<f64>>,
    /// Nodes of each brick, numbered from 0, in the order of C3D8.
    pub(crate) bricks: Vec<[usize; 8]>,
    /// Nodes held in the direction of x, of y and of z: those on the plane of symmetry across it.
    pub(crate) held: [Vec<usize>; 3],
    /// Nodes of the surface on the side that is pressed.
    pub(crate) face: Vec<usize>,
    /// Axis along which the body is pressed: 0 to 2.
    pub(crate) axis: usize,
}

/// Corners of a brick, in the order of C3D8.
const CORNERS: [[usize; 3]; 8] = [
    [0, 0, 0],
    [1, 0, 0],
    [1, 1, 0],
    [0, 1, 0],
    [0, 0, 1],
    [1, 0, 1],
    [1, 1, 1],
    [0, 1, 1],
];

impl Mesh {
    /// The octant as a cube of `count`³ bricks, bent to a ball and stretched to the surface.
    ///
    /// The body is pressed where `axis` meets its surface. From there the bricks grow like sinh, along
    /// the edges of the cube, so that half of each edge's bricks lie within the lengths `patch`: into the
    /// depth, and along the axes that follow in the order x, y, z, x, y.
    pub(crate) fn new(
        surface: &impl StarSurface,
        axis: usize,
        patch: [f64; 3],
        count: usize,
    ) -> Self {
        let axes = [axis, (axis + 1) % 3, (axis + 2) % 3];
        let top = surface.radius(&Vector3::ith(axis, 1.0));
        let [depth, along, across] = patch.map(|length| length / top);
        // Where a side of the cube touches the ball, lengths shrink by the root of 2.
        let growth = [depth, SQRT_2 * along, SQRT_2 * across].map(growth);
        let side = count + 1;
        let index = |[i, j, k]: [usize; 3]| (i * side + j) * side + k;
        let grid = |count: usize| {
            (0..count.pow(3)).map(move |n| [n / (count * count), n / count % count, n % count])
        };
        let nodes = grid(side).map(|[i, j, k]| {
            let part = |n: usize, edge: usize| {
                let part = n as f64 / count as f64;
                (growth[edge] * part).sinh() / growth[edge].sinh()
            };
            let ball = ball([1.0 - part(count - i, 0), part(j, 1), part(k, 2)]);
            let mut node = Vector3::zeros();
            for (axis, coordinate) in axes.into_iter().zip(ball) {
                node[axis] = coordinate;
            }
            match node.try_normalize(0.0) {
                Some(direction) => node * surface.radius(&direction),
                None => node,
            }
        });
        let mut held = [const { Vec::new() }; 3];
        for cell in grid(side) {
            for (axis, n) in axes.into_iter().zip(cell) {
                if n == 0 {
                    held[axis].push(index(cell));
                }
            }
        }
        Self {
            nodes: nodes.collect(),
            bricks: grid(count)
                .map(|[i, j, k]| CORNERS.map(|[p, q, r]| index([i + p, j + q, k + r])))
                .collect(),
            held,
            face: (0..side * side).map(|n| index([count, 0, 0]) + n).collect(),
            axis,
        }
    }

    /// The nodes that a plane across the axis would cut off, had the body no stiffness, and how far each
    /// is beyond the plane: `indentation` at the farthest.
    pub(crate) fn cut_off(&self, indentation: f64) -> Vec<(usize, f64)> {
        let height = |&node: &usize| self.nodes[node][self.axis];
        let top = self.face.iter().map(height).fold(0.0, f64::max);
        let beyond = |node| (node, height(&node) - (top - indentation));
        let cut = self.face.iter().copied().map(beyond);
        cut.filter(|(_, depth)| *depth > 0.0).collect()
    }
}

/// The g > 0 for which sinh(g/2) / sinh(g), which is 1 / (2 cosh(g/2)), is `part` < 1/2.
fn growth(part: f64) -> f64 {
    2.0 * (0.5 / part).acosh()
}

/// Bends the unit cube to the octant of the unit ball.
fn ball([x, y, z]: [f64; 3]) -> [f64; 3] {
    let bent = |a: f64, b: f64, c: f64| {
        let (b, c) = (b * b, c * c);
        a * (1.0 - b / 2.0 - c / 2.0 + b * c / 3.0).sqrt()
    };
    [bent(x, y, z), bent(y, z, x), bent(z, x, y)]
}
