//! Parts of the faces of a cube, for quadrature.

use super::{CubeCell, GaussLegendre};
use nalgebra::Vector3;

/// A part of a face between four angles, for quadrature.
#[derive(Debug, Clone, Copy)]
pub(crate) struct FaceRectangle {
    /// Any cell of the face.
    pub(super) cell: CubeCell,
    /// Lower and upper angle along b, in radians.
    pub(super) b: [f64; 2],
    /// Lower and upper angle along c.
    pub(super) c: [f64; 2],
}

impl FaceRectangle {
    /// The nodes of a product of Gauss rules: unit vectors, and their weights in solid angle.
    pub(crate) fn nodes(&self, rule: &GaussLegendre) -> Vec<(Vector3<f64>, f64)> {
        let tangents = |[low, high]: [f64; 2]| -> Vec<(f64, f64)> {
            rule.on(low, high)
                .map(|(angle, weight)| (angle.tan(), weight))
                .collect()
        };
        let (along_b, along_c) = (tangents(self.b), tangents(self.c));
        let mut nodes = Vec::with_capacity(along_b.len() * along_c.len());
        for &(tb, weight_b) in &along_b {
            for &(tc, weight_c) in &along_c {
                // dΩ = dt_b dt_c / (1 + t_b² + t_c²)^(3/2),  dt = (1 + t²) d(atan t)
                let squared = 1.0 + tb * tb + tc * tc;
                let length = squared.sqrt();
                let solid_angle = (1.0 + tb * tb) * (1.0 + tc * tc) / (squared * length);
                let direction = self.cell.on_face([tb, tc]) / length;
                nodes.push((direction, weight_b * weight_c * solid_angle));
            }
        }
        nodes
    }

    /// Solid angle of the rectangle.
    pub(crate) fn solid_angle(&self) -> f64 {
        let corner = |b: f64, c: f64| {
            let (tb, tc) = (b.tan(), c.tan());
            (tb * tc / (1.0 + tb * tb + tc * tc).sqrt()).atan()
        };
        corner(self.b[1], self.c[1]) - corner(self.b[0], self.c[1]) - corner(self.b[1], self.c[0])
            + corner(self.b[0], self.c[0])
    }

    /// The four rectangles that the middle angles cut it in.
    pub(crate) fn quarters(&self) -> [Self; 4] {
        let halves = |[low, high]: [f64; 2]| {
            let middle = 0.5 * (low + high);
            [[low, middle], [middle, high]]
        };
        let (b, c) = (halves(self.b), halves(self.c));
        [(0, 0), (0, 1), (1, 0), (1, 1)].map(|(i, j)| Self {
            cell: self.cell,
            b: b[i],
            c: c[j],
        })
    }
}
