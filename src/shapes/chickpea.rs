//! A chickpea.

use super::{Bump, Bumpy, Ellipsoid};
use nalgebra::Vector3;

/// A chickpea, some 9 x 8 x 8 mm: nearly a ball, with a beak towards +x and a groove below.
///
/// r(n) = E(n) (1 + sum A exp(kappa (n . d - 1) - (n . p)²)) with E the ellipsoid of semi-axes 4.1,
/// 4.0 and 4.0 mm and three bumps: the beak, a Gaussian of 0.13 rad tilted a little to +z, the
/// groove under it, which runs in the plane y = 0, and a slight swelling at the back.
///
/// Mirror-symmetric in y. Star-shaped: the groove takes away at most 0.07 of the radius.
pub fn chickpea() -> Bumpy<Ellipsoid> {
    Bumpy {
        base: Ellipsoid {
            semi_axes: Vector3::new(4.1, 4.0, 4.0),
        },
        bumps: vec![
            Bump::round(0.15, 60.0, [1.0, 0.0, 0.1]),
            Bump::round(-0.07, 4.0, [0.35, 0.0, -1.0]).pinched([0.0, 4.5, 0.0]),
            Bump::round(0.04, 4.0, [-1.0, 0.0, 0.3]),
        ],
    }
}
