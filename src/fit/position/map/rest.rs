//! How much a triangle is distorted on the sphere.
//!
//! With J the linear map from the triangle to its image, both surfaces scaled to 4 pi, |J|² its squared Frobenius norm
//! and d = det J > 0, the energy per area is
//!
//! ```text
//! |J|² / (2d) ((d + 1/d) / 2)²
//! ```
//!
//! 1 where J is a rotation, infinite where the image turns over. The first factor alone is conformal, and shrinks
//! the tips of a surface to nothing; the second leans to equal area.

use nalgebra::Vector3;

/// Least height of a triangle, in its longest edges.
const LEAST_HEIGHT: f64 = 0.02;

/// A triangle as it is at rest: what its image is compared with.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Rest {
    /// |J|² is the sum of these times the squared lengths of the images of the edges 0-1, 1-2, 2-0.
    pub(super) weights: [f64; 3],
    pub(super) area: f64,
}

impl Rest {
    /// The triangle with the given corners; heights are at least 2 % of the longest edge, whose square is at least
    /// `least_square`.
    pub(super) fn new([a, b, c]: [Vector3<f64>; 3], least_square: f64) -> Self {
        let (e, f) = (b - a, c - a);
        let (mut ee, mut ff, ef) = (e.norm_squared(), f.norm_squared(), e.dot(&f));
        let longest = ee.max(ff).max((f - e).norm_squared()).max(least_square);
        let least = (LEAST_HEIGHT * longest).powi(2);
        let mut determinant = ee * ff - ef * ef;
        if determinant < least {
            // The least addition to both squares that widens the triangle so far.
            let sum = ee + ff;
            let wider = 0.5 * ((sum * sum + 4.0 * (least - determinant)).sqrt() - sum);
            (ee, ff) = (ee + wider, ff + wider);
            determinant = ee * ff - ef * ef;
        }
        Self {
            weights: [
                (ff - ef) / determinant,
                ef / determinant,
                (ee - ef) / determinant,
            ],
            area: 0.5 * determinant.sqrt(),
        }
    }
}

/// ((d + 1/d) / 2)² / (2d) and its first two derivatives.
#[inline]
pub(super) fn density(d: f64) -> [f64; 3] {
    let r = 1.0 / d;
    let (r2, r3) = (r * r, r * r * r);
    [
        0.125 * (d + 2.0 * r + r3),
        0.125 * (1.0 - 2.0 * r2 - 3.0 * r2 * r2),
        0.125 * (4.0 * r3 + 12.0 * r2 * r3),
    ]
}
