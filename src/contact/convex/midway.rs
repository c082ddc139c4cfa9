//! The midway point of Wang, Marmysh and Ji (2020), by Newton's iteration as it stands there.
//!
//! Of F_1 and F_2, the inside-outside functions g^n1 - 1, the point solves grad F_1 + lambda² grad F_2 = 0 and
//! F_1 = F_2 (Houlsby 2009; Podlozhnyuk 2017). It is the default's point where both n1 are equal.

use super::pair::{ConvexPair, Found};
use crate::sphere::Jet;
use nalgebra::{Matrix4, Vector3, Vector4};

/// Steps after which it is given up.
const MAX_STEPS: usize = 100;

/// The last step, as a share of the distance of the centres.
const LAST_STEP: f64 = 1e-9;

/// Steps beyond this many distances of the centres run away.
const RUNAWAY: f64 = 1e6;

/// g^n - 1 from the gauge g.
fn inside_outside(gauge: &Jet, n: f64) -> Jet {
    let power = gauge.powf(n);
    Jet {
        value: power.value - 1.0,
        ..power
    }
}

/// F of both bodies.
fn both(pair: &ConvexPair<'_>, x: &Vector3<f64>) -> [Jet; 2] {
    let [first, second] = pair.jets(x);
    let seen = pair.seen_from_second(x);
    let n = |z: f64, n1: [f64; 2]| n1[usize::from(z < 0.0)];
    [
        inside_outside(&first, n(x.z, pair.first.n1())),
        inside_outside(&second, n(seen.z, pair.second.n1())),
    ]
}

/// From the middle of the centres, unless a better start is known.
pub(super) fn solve(pair: &ConvexPair<'_>, start: Option<Vector3<f64>>) -> Found {
    let distance = pair.offset.norm();
    let mut x = start.unwrap_or(pair.offset * 0.5);
    let [mut one, mut other] = both(pair, &x);
    let mut lambda = (one.gradient.norm() / other.gradient.norm()).sqrt();
    let mut found = Found::start(pair, x);
    for step in 1..=MAX_STEPS {
        found.iterations = step;
        let square = lambda * lambda;
        let difference = one.gradient - other.gradient;
        let mut matrix = Matrix4::zeros();
        matrix
            .fixed_view_mut::<3, 3>(0, 0)
            .copy_from(&(one.hessian + other.hessian * square));
        matrix
            .fixed_view_mut::<3, 1>(0, 3)
            .copy_from(&(other.gradient * (2.0 * lambda)));
        matrix
            .fixed_view_mut::<1, 3>(3, 0)
            .copy_from(&difference.transpose());
        let rest = one.gradient + other.gradient * square;
        let side = -Vector4::new(rest.x, rest.y, rest.z, one.value - other.value);
        let Some(solved) = matrix.lu().solve(&side) else {
            break;
        };
        let moved = solved.xyz();
        let length = moved.norm();
        if length.is_nan() || length >= RUNAWAY * distance {
            break;
        }
        x += moved;
        lambda += solved.w;
        [one, other] = both(pair, &x);
        found.point = x;
        if moved.norm() < LAST_STEP * distance {
            (found.upper, found.is_settled) = (pair.larger_gauge(&x), true);
            if let Some(normal) = one.gradient.try_normalize(0.0) {
                (found.normal, found.lower) = (normal, pair.lower_bound(&normal));
            }
            break;
        }
    }
    found
}
