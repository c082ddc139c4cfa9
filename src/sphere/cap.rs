//! Caps of the sphere and the coordinates in them.

use crate::vectorize::vectorize;
use nalgebra::Vector3;

/// A patch of the sphere in which a local expansion lives.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Cap {
    /// Unit vector to the middle of the patch.
    pub centre: Vector3<f64>,
    /// Unit tangents at the centre: e1 x e2 = centre.
    pub tangents: [Vector3<f64>; 2],
    /// The largest 1 - n.c over the patch: 1 - cos of its angular radius, in (0, 2].
    pub height: f64,
}

impl Cap {
    /// The cap round the polar angle `theta` and azimuth `phi`, with the tangents along growing
    /// theta and growing phi.
    pub fn new(theta: f64, phi: f64, height: f64) -> Self {
        let (st, ct) = theta.sin_cos();
        let (sp, cp) = phi.sin_cos();
        Self {
            centre: Vector3::new(st * cp, st * sp, ct),
            tangents: [
                Vector3::new(ct * cp, ct * sp, -st),
                Vector3::new(-sp, cp, 0.0),
            ],
            height,
        }
    }

    /// Length of the tangential part of a direction per unit of u and v.
    #[inline(always)]
    pub(super) fn tangent_length(&self) -> f64 {
        (2.0 * self.height).sqrt()
    }

    /// u, v and x = 2w - 1 of a unit vector.
    #[inline(always)]
    pub(super) fn coordinates(&self, [nx, ny, nz]: [f64; 3]) -> [f64; 3] {
        let (c, [e1, e2]) = (self.centre, self.tangents);
        let (per_tangent, per_height) = (1.0 / self.tangent_length(), 1.0 / self.height);
        let (dx, dy, dz) = (nx - c.x, ny - c.y, nz - c.z);
        [
            (nx * e1.x + ny * e1.y + nz * e1.z) * per_tangent,
            (nx * e2.x + ny * e2.y + nz * e2.z) * per_tangent,
            (dx * dx + dy * dy + dz * dz) * per_height - 1.0,
        ]
    }

    /// Finds the coordinates of many directions (the first three numbers of each entry, a unit
    /// vector) in this cap.
    pub fn locate(&self, directions: &[[f64; 4]], places: &mut Places) {
        let count = directions.len();
        for list in [&mut places.u, &mut places.v, &mut places.x] {
            list.resize(count, 0.0);
        }
        let (u, v, x) = (
            &mut places.u[..count],
            &mut places.v[..count],
            &mut places.x[..count],
        );
        vectorize(
            #[inline(always)]
            || {
                for at in 0..count {
                    let [nx, ny, nz, _] = directions[at];
                    [u[at], v[at], x[at]] = self.coordinates([nx, ny, nz]);
                }
            },
        );
    }
}

/// Directions in the coordinates of a cap, component by component.
#[derive(Debug, Clone, Default)]
pub struct Places {
    pub(super) u: Vec<f64>,
    pub(super) v: Vec<f64>,
    /// 2w - 1.
    pub(super) x: Vec<f64>,
}

impl Places {
    /// The coordinates of the block of N places that starts at place N `block`; zeros beyond the end.
    #[inline(always)]
    pub(super) fn block<const N: usize>(&self, block: usize) -> [[f64; N]; 3] {
        [&self.u, &self.v, &self.x].map(|list| {
            let rest = &list[block * N..];
            match rest.first_chunk::<N>() {
                Some(whole) => *whole,
                None => std::array::from_fn(|i| rest.get(i).copied().unwrap_or(0.0)),
            }
        })
    }

    /// Number of directions.
    pub fn len(&self) -> usize {
        self.x.len()
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.x.is_empty()
    }
}
