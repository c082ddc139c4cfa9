//! A common bean.

use super::{Bump, Bumpy, Ellipsoid};
use nalgebra::Vector3;

/// A common bean, some 14 x 8 x 6.5 mm: a kidney with its hilum towards -y.
///
/// r(n) = E(n) (1 + sum A exp(kappa (n . d - 1))) with E the ellipsoid of semi-axes 6.75, 4.1 and
/// 3.25 mm and five bumps: the bay of the kidney, the hilum's scar in it, the two ends bent towards
/// it, one a little stouter than the other, and the back. The scar is the narrowest feature, a
/// Gaussian of 0.13 rad.
///
/// Mirror-symmetric in z. Star-shaped: the dents take away at most 0.25 of the radius.
pub fn bean() -> Bumpy<Ellipsoid> {
    Bumpy {
        base: Ellipsoid {
            semi_axes: Vector3::new(6.75, 4.1, 3.25),
        },
        bumps: vec![
            Bump::round(-0.20, 5.0, [0.0, -1.0, 0.0]),
            Bump::round(-0.05, 60.0, [0.0, -1.0, 0.0]),
            Bump::round(0.07, 6.0, [1.0, -0.6, 0.0]),
            Bump::round(0.09, 6.0, [-1.0, -0.5, 0.0]),
            Bump::round(0.05, 3.0, [0.0, 1.0, 0.0]),
        ],
    }
}
