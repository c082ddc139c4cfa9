//! Integrals of monomials over an octant of a superquadric.

use crate::measure::Moments;
use crate::model::{Octant, Superquadric};
use libm::lgamma;
use nalgebra::{Matrix3, Vector3};

/// ∫ |x|^p |y|^q |z|^r dV over the octant; with A = (p+1)/n2, B = (q+1)/n2 and C = (p+q+2)/n1 it is
/// a^(p+1) b^(q+1) c^(r+1) / (n1 n2²) Γ(A) Γ(B) / Γ(A+B+1) Beta((r+1)/n1, C+1).
fn octant_moment(octant: &Octant, powers: [i32; 3]) -> f64 {
    let [p, q, r] = powers;
    let (n1, n2) = (octant.n1, octant.n2);
    let (a, b) = (f64::from(p + 1) / n2, f64::from(q + 1) / n2);
    let (c, d) = (f64::from(p + q + 2) / n1 + 1.0, f64::from(r + 1) / n1);
    let logarithm =
        lgamma(a) + lgamma(b) - lgamma(a + b + 1.0) + lgamma(d) + lgamma(c) - lgamma(c + d);
    let axes = octant.axes.iter().zip(powers);
    let scale: f64 = axes.map(|(axis, power)| axis.powi(power + 1)).product();
    scale * logarithm.exp() / (n1 * n2 * n2)
}

/// Volume, first and second moments about the origin; the area is left at zero.
pub(super) fn moments(body: &Superquadric) -> Moments {
    let mut sum = Moments::default();
    for octant in body.octants() {
        let moment = |powers: [i32; 3]| -> f64 {
            let signs = octant.signs.iter().zip(powers);
            let sign: f64 = signs.map(|(sign, power)| sign.powi(power)).product();
            sign * octant_moment(&octant, powers)
        };
        sum.volume += moment([0; 3]);
        let unit = |i: usize| std::array::from_fn(|j| i32::from(i == j));
        sum.first += Vector3::from_fn(|i, _| moment(unit(i)));
        let pair =
            |i: usize, j: usize| std::array::from_fn(|k| i32::from(i == k) + i32::from(j == k));
        sum.second += Matrix3::from_fn(|i, j| moment(pair(i, j)));
    }
    sum
}
