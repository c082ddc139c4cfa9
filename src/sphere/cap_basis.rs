//! A basis of the spherical harmonics of degree <= L that stays well conditioned on a small cap.
//!
//! Restricted to a small patch the harmonics themselves are nearly dependent: the condition number
//! of their design matrix grows like k^(2L) with the number k of segments per angle (2e8 at k = 8,
//! L = 3). The same space of functions has a basis that does not degenerate. With the centre c of
//! the patch as pole, tangents e1 and e2, and
//!
//! ```text
//! u + iv = (n.e1 + i n.e2) / sqrt(2 W),   w = (1 - n.c) / W,   W = the largest 1 - n.c in the patch
//! ```
//!
//! the functions
//!
//! ```text
//! s Re, s Im (u + iv)^m  P_j^(0,m)(2w - 1),   m = 0..L,  j = 0..L-m,   s^2 = (2j + m + 1) (2 if m > 0)
//! ```
//!
//! (P: Jacobi polynomials) span exactly the (L+1)^2 harmonics of degree <= L on the patch, with
//! column-scaled condition numbers of 10 to 300 for every k up to 16 (5000 in the thin wedges at the
//! poles at k = 64). They are ordered by their
//! degree m + j, so that the first (d+1)^2 span the harmonics of degree <= d. No trigonometric
//! function is called, and 1 - n.c is taken as |n - c|^2 / 2, which does not cancel.

use super::cap::{Cap, Places};
use crate::vectorize::vectorize;
use nalgebra::Vector3;

/// Number of coefficients of an expansion of degree `degree`: (L+1)^2, or the largest number where that is larger.
pub const fn coefficient_count(degree: usize) -> usize {
    degree.saturating_add(1).saturating_pow(2)
}

/// Places evaluated together, so that the compiler uses the widest registers there are.
const LANES: usize = 8;

/// One step of a three-term recurrence: next = (a x + b) current - c previous.
#[derive(Debug, Clone, Copy)]
struct Step {
    a: f64,
    b: f64,
    c: f64,
}

/// The recurrences of the cap basis up to some degree; the cap itself is an argument.
#[derive(Debug, Clone)]
pub(crate) struct CapBasis {
    degree: usize,
    /// Per order m: the value of the scaled P_0, and the steps to P_1 .. P_(L-m).
    orders: Vec<(f64, Vec<Step>)>,
}

impl CapBasis {
    /// The basis of all harmonics of degree <= `degree`.
    pub(crate) fn new(degree: usize) -> Self {
        let orders = (0..=degree)
            .map(|m| {
                let scale =
                    |j: usize| ((2 * j + m + 1) as f64 * if m == 0 { 1.0 } else { 2.0 }).sqrt();
                let steps = (0..degree - m).map(|j| jacobi_step(m, j, scale)).collect();
                (scale(0), steps)
            })
            .collect();
        Self { degree, orders }
    }

    /// The largest degree this basis can evaluate.
    pub(crate) fn degree(&self) -> usize {
        self.degree
    }

    /// Writes the basis at `places` into the columns of `out`: function j at place i goes to
    /// `out[j * stride + i]`.
    ///
    /// # Panics
    /// If `stride` is below the number of places or `out` below (L+1)^2 columns.
    pub(crate) fn evaluate(&self, places: &Places, out: &mut [f64], stride: usize) {
        let columns = coefficient_count(self.degree);
        assert!(places.len() <= stride && out.len() + stride >= columns * stride + places.len());
        vectorize(
            #[inline(always)]
            || self.evaluate_columns(places, out, stride),
        );
    }

    /// Column by column: every function follows from two of lower degree and the same order by the
    /// recurrence of the Jacobi polynomials, and the first of an order from the first of the order
    /// below by a product with u + iv. Every loop runs along a column.
    #[inline(always)]
    fn evaluate_columns(&self, places: &Places, out: &mut [f64], stride: usize) {
        let rows = places.len();
        let (u, v, x) = (&places.u[..rows], &places.v[..rows], &places.x[..rows]);
        let mut scale_below = 1.0;
        for (m, (scale, steps)) in self.orders.iter().enumerate() {
            let first = column(m, m) * stride;
            if m == 0 {
                out[first..first + rows].fill(*scale);
            } else {
                let (below, rest) = out.split_at_mut(first);
                let re_below = &below[column(m - 1, m - 1) * stride..][..rows];
                let (re, im) = rest.split_at_mut(stride);
                let (re, im) = (&mut re[..rows], &mut im[..rows]);
                let ratio = scale / scale_below;
                if m == 1 {
                    for i in 0..rows {
                        re[i] = ratio * re_below[i] * u[i];
                        im[i] = ratio * re_below[i] * v[i];
                    }
                } else {
                    let im_below = &below[(column(m - 1, m - 1) + 1) * stride..][..rows];
                    for i in 0..rows {
                        re[i] = ratio * (re_below[i] * u[i] - im_below[i] * v[i]);
                        im[i] = ratio * (re_below[i] * v[i] + im_below[i] * u[i]);
                    }
                }
            }
            scale_below = *scale;
            for part in 0..if m == 0 { 1 } else { 2 } {
                for (j, step) in steps.iter().enumerate() {
                    let at = |j: usize| (column(m + j, m) + part) * stride;
                    let (known, rest) = out.split_at_mut(at(j + 1));
                    let next = &mut rest[..rows];
                    let current = &known[at(j)..][..rows];
                    if j == 0 {
                        for i in 0..rows {
                            next[i] = (step.a * x[i] + step.b) * current[i];
                        }
                    } else {
                        let previous = &known[at(j - 1)..][..rows];
                        for i in 0..rows {
                            next[i] = (step.a * x[i] + step.b) * current[i] - step.c * previous[i];
                        }
                    }
                }
            }
        }
    }

    /// The value of the expansion with the given coefficients in the direction of the unit vector
    /// `n`. The number of coefficients sets the degree, at most that of the basis.
    pub(crate) fn value(&self, cap: &Cap, coefficients: &[f64], n: &Vector3<f64>) -> f64 {
        let [u, v, x] = cap.coordinates((*n).into());
        let [value] = self.expand(coefficients, [u], [v], [x]);
        value
    }

    /// K expansions, whose coefficients stand side by side, in Chebyshev polynomials of x: the real and the imaginary
    /// parts of the c_mj of [`CapExpansion`](super::CapExpansion), in its order. Of a degree that the basis has.
    pub(super) fn chebyshev<const K: usize>(
        &self,
        coefficients: &[[f64; K]],
    ) -> Vec<[[f64; K]; 2]> {
        let degree = coefficients.len().isqrt().saturating_sub(1);
        let mut terms = Vec::with_capacity((degree + 1) * (degree + 2) / 2);
        for m in (0..=degree).rev() {
            let (first, steps) = &self.orders[m];
            let from = terms.len();
            terms.resize(from + degree - m + 1, [[0.0; K]; 2]);
            let (mut below, mut current) = (vec![0.0; degree - m + 1], vec![0.0; degree - m + 1]);
            current[0] = *first;
            for j in 0..=degree - m {
                let at = column(m + j, m);
                for (term, p) in terms[from..].iter_mut().rev().zip(&current) {
                    for k in 0..K {
                        term[0][k] += coefficients[at][k] * p;
                        term[1][k] -= if m > 0 {
                            coefficients[at + 1][k] * p
                        } else {
                            0.0
                        };
                    }
                }
                if let Some(step) = steps.get(j) {
                    for (i, below) in below.iter_mut().enumerate() {
                        // x T_0 = T_1, and x T_i = (T_(i+1) + T_(i-1)) / 2.
                        let share = |i: usize, per: f64| current.get(i).map_or(0.0, |p| p * per);
                        let from_above = share(i + 1, 0.5);
                        let from_below = match i {
                            0 => 0.0,
                            1 => share(0, 1.0),
                            _ => share(i - 1, 0.5),
                        };
                        *below = step.a * (from_below + from_above) + step.b * current[i]
                            - step.c * *below;
                    }
                    std::mem::swap(&mut below, &mut current);
                }
            }
        }
        terms
    }

    /// Values of an expansion at many places.
    pub(crate) fn values(&self, coefficients: &[f64], places: &Places, out: &mut [f64]) {
        vectorize(
            #[inline(always)]
            || {
                for (block, out) in out[..places.len()].chunks_mut(LANES).enumerate() {
                    let [u, v, x] = places.block(block);
                    let values = self.expand::<LANES>(coefficients, u, v, x);
                    for (out, value) in out.iter_mut().zip(values) {
                        *out = value;
                    }
                }
            },
        );
    }

    /// The surface gradients of all functions at `places` of `cap`, as three matrices of the layout
    /// of [`Self::evaluate`]: the components along the cap's tangents e1 and e2 and its centre.
    pub(crate) fn evaluate_gradients(&self, cap: &Cap, places: &Places) -> [Vec<f64>; 3] {
        let rows = places.len();
        let columns = coefficient_count(self.degree);
        let mut out = [(); 3].map(|()| vec![0.0; columns * rows]);
        let (per_tangent, per_height) = (1.0 / cap.tangent_length(), 2.0 / cap.height);
        vectorize(
            #[inline(always)]
            || {
                for i in 0..rows {
                    let (u, v, x) = (places.u[i], places.v[i], places.x[i]);
                    let n = [
                        u / per_tangent,
                        v / per_tangent,
                        1.0 - (x + 1.0) / per_height,
                    ];
                    let mut store = |column: usize, du: f64, dv: f64, dx: f64| {
                        let in_space = [du * per_tangent, dv * per_tangent, -dx * per_height];
                        let radial = in_space[0] * n[0] + in_space[1] * n[1] + in_space[2] * n[2];
                        for axis in 0..3 {
                            out[axis][column * rows + i] = in_space[axis] - radial * n[axis];
                        }
                    };
                    let (mut re, mut im, mut re_below, mut im_below) = (1.0, 0.0, 0.0, 0.0);
                    for (m, (first, steps)) in self.orders.iter().enumerate() {
                        if m > 0 {
                            (re_below, im_below) = (re, im);
                            (re, im) = (re * u - im * v, re * v + im * u);
                        }
                        let order = m as f64;
                        let (mut p0, mut p, mut d0, mut d) = (0.0, *first, 0.0, 0.0);
                        for j in 0..=steps.len() {
                            let at = column(m + j, m);
                            let power = order * p;
                            store(at, power * re_below, -power * im_below, d * re);
                            if m > 0 {
                                store(at + 1, power * im_below, power * re_below, d * im);
                            }
                            if let Some(s) = steps.get(j) {
                                let factor = s.a * x + s.b;
                                (d0, d) = (d, s.a * p + factor * d - s.c * d0);
                                (p0, p) = (p, factor * p - s.c * p0);
                            }
                        }
                    }
                }
            },
        );
        out
    }

    /// The values of an expansion at N places at once.
    #[inline(always)]
    fn expand<const N: usize>(
        &self,
        coefficients: &[f64],
        u: [f64; N],
        v: [f64; N],
        x: [f64; N],
    ) -> [f64; N] {
        let degree = coefficients.len().isqrt().saturating_sub(1);
        let (mut re, mut im, mut values) = ([1.0; N], [0.0; N], [0.0; N]);
        for (m, (first, steps)) in self.orders.iter().enumerate().take(degree + 1) {
            let (mut below, mut p) = ([0.0; N], [*first; N]);
            let (mut even, mut odd) = ([0.0; N], [0.0; N]);
            for j in 0..=(degree - m).min(steps.len()) {
                let at = column(m + j, m);
                let a = coefficients[at];
                let b = if m > 0 { coefficients[at + 1] } else { 0.0 };
                for i in 0..N {
                    even[i] += a * p[i];
                    odd[i] += b * p[i];
                }
                if let Some(s) = steps.get(j) {
                    for i in 0..N {
                        let next = (s.a * x[i] + s.b) * p[i] - s.c * below[i];
                        (below[i], p[i]) = (p[i], next);
                    }
                }
            }
            for i in 0..N {
                values[i] += re[i] * even[i] + im[i] * odd[i];
                (re[i], im[i]) = (re[i] * u[i] - im[i] * v[i], re[i] * v[i] + im[i] * u[i]);
            }
        }
        values
    }
}

/// First column of the functions of the given degree and order: (Re, Im) of an order stand together.
const fn column(degree: usize, order: usize) -> usize {
    degree * degree + if order == 0 { 0 } else { 2 * order - 1 }
}

/// The step from P_j^(0,m) to P_(j+1)^(0,m), both multiplied by `scale`.
fn jacobi_step(m: usize, j: usize, scale: impl Fn(usize) -> f64) -> Step {
    let (b, n) = (m as f64, (j + 1) as f64);
    if j == 0 {
        let ratio = scale(1) / scale(0);
        return Step {
            a: ratio * (b + 2.0) / 2.0,
            b: ratio * (1.0 - (b + 2.0) / 2.0),
            c: 0.0,
        };
    }
    let s = 2.0 * n + b;
    let lead = 2.0 * n * (n + b) * (s - 2.0);
    Step {
        a: (s - 1.0) * s * (s - 2.0) / lead * scale(j + 1) / scale(j),
        b: -(s - 1.0) * b * b / lead * scale(j + 1) / scale(j),
        c: 2.0 * (n - 1.0) * (n + b - 1.0) * s / lead * scale(j + 1) / scale(j - 1),
    }
}

#[cfg(test)]
mod tests;
