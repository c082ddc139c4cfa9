//! The surface of a superquadric as patches: its octants, seen through the three faces of a box round each.

use crate::model::{Octant, Superquadric};
use nalgebra::Vector3;

/// A rectangle on a face of the box that spans the semi-axes of an octant.
#[derive(Debug, Clone, Copy)]
pub(super) struct Patch {
    octant: Octant,
    /// The axis that the face is normal to.
    face: usize,
    /// From and to along the other two axes, as shares of the semi-axes.
    sides: [[f64; 2]; 2],
}

/// A point of a surface and the area that it stands for, along the outward normal.
#[derive(Debug, Clone, Copy)]
pub(super) struct Node {
    pub(super) point: Vector3<f64>,
    pub(super) area: Vector3<f64>,
}

impl Patch {
    /// The 24 patches of a body.
    pub(super) fn all(body: &Superquadric) -> Vec<Self> {
        let faces = |octant: Octant| {
            (0..3).map(move |face| Self {
                octant,
                face,
                sides: [[0.0, 1.0]; 2],
            })
        };
        body.octants().flat_map(faces).collect()
    }

    /// Its four quarters.
    pub(super) fn quarters(&self) -> [Self; 4] {
        let halves = self.sides.map(|[from, to]| {
            let middle = 0.5 * (from + to);
            [[from, middle], [middle, to]]
        });
        let quarter = |i: usize, j: usize| Self {
            sides: [halves[0][i], halves[1][j]],
            ..*self
        };
        [quarter(0, 0), quarter(0, 1), quarter(1, 0), quarter(1, 1)]
    }

    /// From and to along its two sides, as shares of the semi-axes.
    pub(super) fn sides(&self) -> [[f64; 2]; 2] {
        self.sides
    }

    /// The point at a place of the patch, and the area there per area of the face: the place x is carried to x / g.
    pub(super) fn node(&self, body: &Superquadric, [u, v]: [f64; 2]) -> Node {
        let [normal, du, dv] = [0, 1, 2].map(|i| {
            let i = (self.face + i) % 3;
            Vector3::ith(i, self.octant.axes[i] * self.octant.signs[i])
        });
        let x = normal + du * u + dv * v;
        let (gauge, slope) = body.gauge_and_slope(&x);
        let along = |t: &Vector3<f64>| (t - x * (slope.dot(t) / gauge)) / gauge;
        let area = along(&du).cross(&along(&dv));
        let point = x / gauge;
        Node {
            point,
            area: area * area.dot(&point).signum(),
        }
    }

    /// The point at a place of the patch.
    pub(super) fn point(&self, body: &Superquadric, [u, v]: [f64; 2]) -> Vector3<f64> {
        let mut x = Vector3::zeros();
        for (i, share) in [1.0, u, v].into_iter().enumerate() {
            let i = (self.face + i) % 3;
            x[i] = share * self.octant.axes[i] * self.octant.signs[i];
        }
        x / body.gauge(&x)
    }
}
