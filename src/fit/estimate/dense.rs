//! The matrix of a small problem, factored.
//!
//! The matrix C^-1 = Y'WY / s^2 + V^-1 is scaled to a unit diagonal first, S C^-1 S. What is left is mostly so well
//! conditioned that single precision does, in half the time: variances and traces are then good to a thousandth, and the
//! mean is refined by its residual. Where a pivot says that it does not, the factor is one of double precision.
//!
//! Matrices lie in memory that comes zeroed from the system, of which the half above the diagonal is never touched.

use crate::sphere::LowerTriangle;
use faer::dyn_stack::{MemBuffer, MemStack};
use faer::linalg::cholesky::llt::factor::{
    LltParams, LltRegularization, cholesky_in_place, cholesky_in_place_scratch,
};
use faer::linalg::triangular_inverse::invert_lower_triangular;
use faer::linalg::triangular_solve::{
    solve_lower_triangular_in_place, solve_upper_triangular_in_place,
};
use faer::traits::RealField;
use faer::traits::math_utils::from_f64;
use faer::{MatMut, MatRef, Par, Spec};

/// Squares of pivots are the shares of coefficients that the others do not tell. Below this one the rounding of single
/// precision shows.
const LEAST_PIVOT: f64 = 0.01;

/// The Cholesky factor L of S C^-1 S.
#[derive(Debug)]
pub(crate) struct Factor {
    /// The coefficient of each row and column.
    order: Vec<usize>,
    /// S, its diagonal, in this order: the standard deviation of each coefficient if all others were known.
    scale: Vec<f64>,
    /// The logarithm of the product of V^1/2 / S.
    log_scale: f64,
    lower: Lower,
}

#[derive(Debug)]
enum Lower {
    Single(Triangle<f32>),
    Double(Triangle<f64>),
}

impl Factor {
    /// From Y'WY, the variances and s^2. `None` where single precision is not enough.
    pub(super) fn single(gram: &LowerTriangle<f32>, variances: &[f64], noise: f64) -> Option<Self> {
        Self::new(gram, variances, noise, Lower::Single)
            .filter(|factor| factor.least_pivot() > LEAST_PIVOT)
    }

    /// The same. `None` if the matrix is not positive.
    pub(super) fn double(gram: &LowerTriangle<f64>, variances: &[f64], noise: f64) -> Option<Self> {
        Self::new(gram, variances, noise, Lower::Double)
    }

    fn new<T: Number>(
        gram: &LowerTriangle<T>,
        variances: &[f64],
        noise: f64,
        lower: impl FnOnce(Triangle<T>) -> Lower,
    ) -> Option<Self> {
        let diagonal = gram.entries.iter().step_by(gram.order.len() + 1);
        let told = diagonal.map(|&g| g.into() / noise);
        let pairs = told.zip(gram.order.iter().map(|&at| variances[at]));
        let (scale, logarithms): (Vec<f64>, Vec<f64>) = pairs
            .map(|(told, v)| (1.0 / (told + 1.0 / v).sqrt(), 0.5 * (told * v).ln_1p()))
            .unzip();
        Some(Self {
            lower: lower(Triangle::new(&gram.entries, &scale, noise)?),
            order: gram.order.clone(),
            log_scale: logarithms.iter().sum(),
            scale,
        })
    }

    /// Whether solutions are good to rounding.
    pub(super) fn is_double(&self) -> bool {
        matches!(self.lower, Lower::Double(_))
    }

    /// C b, in place, for each column b.
    pub(super) fn solve(&self, columns: &mut [f64]) {
        match &self.lower {
            Lower::Single(lower) => self.solve_by(lower, columns),
            Lower::Double(lower) => self.solve_by(lower, columns),
        }
    }

    fn solve_by<T: Number>(&self, lower: &Triangle<T>, columns: &mut [f64]) {
        let (mut scaled, sizes) = self.scaled::<T>(columns);
        lower.solve_lower(&mut scaled);
        lower.solve_upper(&mut scaled);
        let count = self.order.len();
        let scaled = scaled.chunks_exact(count).zip(sizes);
        for (column, (scaled, size)) in columns.chunks_exact_mut(count).zip(scaled) {
            let rows = self.order.iter().zip(&self.scale);
            for ((&at, scale), &x) in rows.zip(scaled) {
                column[at] = x.into() * scale * size;
            }
        }
    }

    /// b'C b for each column b.
    pub(super) fn variances(&self, columns: &[f64]) -> Vec<f64> {
        match &self.lower {
            Lower::Single(lower) => self.variances_by(lower, columns),
            Lower::Double(lower) => self.variances_by(lower, columns),
        }
    }

    fn variances_by<T: Number>(&self, lower: &Triangle<T>, columns: &[f64]) -> Vec<f64> {
        let (mut scaled, sizes) = self.scaled::<T>(columns);
        lower.solve_lower(&mut scaled);
        let columns = scaled.chunks_exact(self.order.len()).zip(sizes);
        columns
            .map(|(column, size)| squares(column) * size * size)
            .collect()
    }

    /// S b of each column b in this order, each so large that no entry that counts is lost, and over its size.
    fn scaled<T: Number>(&self, columns: &[f64]) -> (Vec<T>, Vec<f64>) {
        let count = self.order.len();
        let mut scaled = Vec::with_capacity(columns.len());
        let rows = || self.order.iter().zip(&self.scale);
        let sized = columns.chunks_exact(count).map(|column| {
            let entries = || rows().map(|(&at, scale)| column[at] * scale);
            let size = entries().fold(f64::MIN_POSITIVE, |most, x| most.max(x.abs()));
            scaled.extend(entries().map(|x| from_f64::<T>(x / size)));
            size
        });
        let sizes = sized.collect();
        (scaled, sizes)
    }

    /// The diagonal of C.
    pub(super) fn diagonal(&self) -> Vec<f64> {
        let squares = match &self.lower {
            Lower::Single(lower) => lower.inverse_diagonal(),
            Lower::Double(lower) => lower.inverse_diagonal(),
        };
        let mut diagonal = vec![0.0; squares.len()];
        let rows = self.order.iter().zip(&self.scale);
        for ((&at, scale), square) in rows.zip(squares) {
            diagonal[at] = square * scale * scale;
        }
        diagonal
    }

    /// The logarithm of the root of the determinant of V^1/2 C^-1 V^1/2.
    pub(super) fn log_root_determinant(&self) -> f64 {
        self.pivots().iter().map(|pivot| pivot.ln()).sum::<f64>() + self.log_scale
    }

    /// The least square of a pivot.
    fn least_pivot(&self) -> f64 {
        self.pivots().into_iter().fold(1.0, f64::min).powi(2)
    }

    fn pivots(&self) -> Vec<f64> {
        match &self.lower {
            Lower::Single(lower) => lower.pivots(),
            Lower::Double(lower) => lower.pivots(),
        }
    }
}

/// A number of single or double precision.
trait Number: RealField + Copy + Into<f64> {}

impl Number for f32 {}
impl Number for f64 {}

fn squares<T: Number>(column: &[T]) -> f64 {
    let squares = column.iter().map(|&x| -> f64 {
        let x: f64 = x.into();
        x * x
    });
    squares.sum()
}

/// A lower triangular matrix, column by column.
#[derive(Debug)]
struct Triangle<T> {
    /// Rows, and columns.
    count: usize,
    entries: Vec<T>,
}

impl<T: Number> Triangle<T> {
    /// The factor of the scaled matrix. `None` if it is not positive.
    fn new(gram: &[T], scale: &[f64], noise: f64) -> Option<Self> {
        let count = scale.len();
        let mut entries = vec![from_f64::<T>(0.0); count * count];
        let columns = entries
            .chunks_exact_mut(count)
            .zip(gram.chunks_exact(count));
        for (j, (to, from)) in columns.enumerate() {
            let own = scale[j] / noise;
            let below = to[j..].iter_mut().zip(from[j..].iter().zip(&scale[j..]));
            for (to, (&from, other)) in below {
                *to = from_f64(from.into() * other * own);
            }
            to[j] = from_f64(1.0);
        }
        let params = Spec::<LltParams, T>::default();
        let scratch = cholesky_in_place_scratch::<T>(count, Par::Seq, params);
        let mut memory = MemBuffer::new(scratch);
        let stack = MemStack::new(&mut memory);
        let nothing_added = LltRegularization::default();
        let matrix = MatMut::from_column_major_slice_mut(&mut entries, count, count);
        cholesky_in_place(matrix, nothing_added, Par::Seq, stack, params).ok()?;
        Some(Self { count, entries })
    }

    fn matrix(&self) -> MatRef<'_, T> {
        MatRef::from_column_major_slice(&self.entries, self.count, self.count)
    }

    fn pivots(&self) -> Vec<f64> {
        let diagonal = self.entries.iter().step_by(self.count + 1);
        diagonal.map(|&entry| entry.into()).collect()
    }

    /// Solves L x = b, in place, of each column.
    fn solve_lower(&self, columns: &mut [T]) {
        solve_lower_triangular_in_place(self.matrix(), self.columns(columns), Par::Seq);
    }

    /// Solves L'x = b, in place, of each column.
    fn solve_upper(&self, columns: &mut [T]) {
        let upper = self.matrix().transpose();
        solve_upper_triangular_in_place(upper, self.columns(columns), Par::Seq);
    }

    fn columns<'a>(&self, columns: &'a mut [T]) -> MatMut<'a, T> {
        let number = columns.len() / self.count;
        MatMut::from_column_major_slice_mut(columns, self.count, number)
    }

    /// The diagonal of the inverse of L L'.
    fn inverse_diagonal(&self) -> Vec<f64> {
        let mut inverse = vec![from_f64::<T>(0.0); self.count * self.count];
        invert_lower_triangular(self.columns(&mut inverse), self.matrix(), Par::Seq);
        let columns = inverse.chunks_exact(self.count).enumerate();
        columns.map(|(j, column)| squares(&column[j..])).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::super::posterior::Posterior;
    use super::super::spectrum::Spectrum;
    use super::super::trial::{fibonacci, samples};
    use super::super::{cloud::Cloud, posterior::Conditioned};
    use super::*;
    use nalgebra::Vector3;
    use std::sync::Arc;

    /// What the two precisions say of a cloud with noise `noise`: is the rough one taken, means, variances and the logarithm.
    fn compared(count: usize, noise: f64, check: impl Fn(&Conditioned<'_>, &Conditioned<'_>)) {
        let bumps = |n: &Vector3<f64>| 3.0 + 0.2 * (4.0 * n.x + 1.0).sin() * (5.0 * n.y).cos();
        let directions = fibonacci(count);
        let points = samples(&directions, bumps, noise);
        let cloud = Cloud::new(&points, None, Vector3::repeat(1.0), Vector3::repeat(1.0));
        let posterior = Posterior::new(&cloud, 12, true);
        let spectrum = Spectrum::with_amplitude([-4.0, 0.9, 1.2, noise.ln()]);
        let given = posterior.given(&spectrum);
        let gram = posterior.sums.gram(&cloud).lower_triangle();
        let double = Factor::double(&gram, &given.variances, given.noise);
        let exact = posterior.given_factored(&spectrum, double.map(Arc::new));
        check(&given, &exact);
    }

    #[test]
    fn single_precision_serves_where_pivots_are_large() {
        compared(240, 0.01, |given, exact| {
            let factor = given.factor.as_ref().unwrap();
            assert!(!factor.is_double());
            let (mean, steps) = given.mean(None, 0.0);
            let want = exact.mean(None, 0.0).0;
            assert!(steps <= 4, "{steps}");
            for (mean, want) in mean.iter().zip(&want) {
                assert!((mean - want).abs() < 1e-11, "{mean} {want}");
            }
            let (cost, sure) = (given.cost(&mean).unwrap(), exact.cost(&want).unwrap());
            assert!((cost - sure).abs() < 1e-3, "{cost} {sure}");
            let directions = fibonacci(40);
            let known = given.exact_variances(&directions).unwrap();
            let surely = exact.exact_variances(&directions).unwrap();
            for (known, surely) in known.iter().zip(surely) {
                assert!((known / surely - 1.0).abs() < 1e-5, "{known} {surely}");
            }
        });
    }

    #[test]
    fn double_precision_takes_over_where_coefficients_hang_on_each_other() {
        // Fewer points than coefficients, with next to no noise.
        compared(150, 1e-6, |given, _| {
            assert!(given.factor.as_ref().unwrap().is_double());
        });
    }
}
