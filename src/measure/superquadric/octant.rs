//! The area of an octant of a superquadric.
//!
//! The octant is cut where it may bend sharply: at |x/a| = |y/b|, and where the rim of its waist meets its cap, (|x/a|^n2 +
//! |y/b|^n2)^(1/n2) = |z/c|. With t the slope in the first of two halves, s that from the waist, or from the cap,
//!
//! ```text
//! e = (1, t) / (1 + t^n2)^(1/n2),   h = (1 + s^n1)^(-1/n1)
//! cap:   X = (s h A e, c h),   waist: X = (h A e, c s h),   0 <= s, t <= 1
//! ```
//!
//! with A = diag(a, b), and a and b exchanged in the second half. All that is sharp lies on the sides of these squares, where
//! the double exponential rule (Takahasi, Mori 1974) takes it well.

use crate::model::Octant;
use std::f64::consts::PI;

/// Beyond it, in its own variable, the rule has no weights.
const REACH: f64 = 3.25;

/// The double exponential rule on 0 to 1: places and weights.
pub(super) struct DoubleExponential(Vec<(f64, f64)>);

impl DoubleExponential {
    /// So many steps in one of its own variable: twice as many give about twice the digits.
    pub(super) fn new(steps: u32) -> Self {
        let step = 1.0 / f64::from(steps);
        let most = (REACH / step) as i32;
        let node = |i: i32| {
            let at = f64::from(i) * step;
            let x = 1.0 / (1.0 + (-PI * at.sinh()).exp());
            let from_end = 1.0 / (1.0 + (PI * at.sinh()).exp());
            (x, step * PI * at.cosh() * x * from_end)
        };
        Self((-most..=most).map(node).collect())
    }
}

/// u = (1 + x^n)^(-1/n) and its slope, x u and its slope.
fn rounded(x: f64, n: f64) -> [f64; 4] {
    let power = x.powf(n);
    let u = (1.0 + power).powf(-1.0 / n);
    let along = u / (1.0 + power);
    [u, -along * power / x, x * u, along]
}

/// The area of an octant.
pub(super) fn octant_area(octant: &Octant, rule: &DoubleExponential) -> f64 {
    let [a, b, c] = octant.axes;
    let cross_sections = rule.0.iter().flat_map(|&(t, weight)| {
        let [u, du, v, dv] = rounded(t, octant.n2);
        [(a, b), (b, a)].map(|(a, b)| {
            let length = (a * du).hypot(b * dv);
            let turn = a * b * (du * v - u * dv).abs();
            (weight, length, turn)
        })
    });
    let profile: Vec<(f64, [f64; 4])> = rule
        .0
        .iter()
        .map(|&(s, weight)| (weight, rounded(s, octant.n1)))
        .collect();
    let over_profile = |(across, length, turn): (f64, f64, f64)| {
        let element = |&(weight, [h, dh, sh, dsh]): &(f64, [f64; 4])| {
            let cap = sh * (length * c * dh).hypot(turn * dsh);
            let waist = h * (length * c * dsh).hypot(turn * dh);
            weight * (cap + waist)
        };
        across * profile.iter().map(element).sum::<f64>()
    };
    cross_sections.map(over_profile).sum()
}
