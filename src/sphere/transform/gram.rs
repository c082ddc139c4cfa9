//! The matrix Y'WY of the harmonics in weighted directions, at a price that does not depend on their number.
//!
//! A product of two expansions of degree L is a polynomial h of degree 2L. Let w(n) be the expansion to
//! degree 2L of the weights as points on the sphere, with the coefficients
//!
//! ```text
//! w_j = sum_i w_i Y_j(n_i),    so that    sum_i w_i h(n_i) = integral of w h
//! ```
//!
//! for every such h. The integrand has degree 4L, and its integral is a sum over a grid of 2L + 1
//! Gauss-Legendre rings: there the matrix is Y'DY with a diagonal D, which has entries of either sign.
//! Error: that of the coefficients w_j.
//!
//! Along a ring the product of the azimuthal parts of orders m and m' has the orders m + m' and |m - m'| only, so
//! that an entry of the matrix is a sum over rings: with these L^4 / 2 (2L + 1) products instead of L^4 N / 2 the matrix
//! of 1500 points and degree 36 is formed six times as fast.

use super::azimuth::AzimuthTerms;
use super::gauss_grid::GaussGrid;
use super::polar::PolarTable;
use crate::sphere::{coefficient_count, harmonic_index};
use faer::linalg::matmul::matmul;
use faer::traits::ComplexField;
use faer::traits::math_utils::from_f64;
use faer::{Accum, MatMut, MatRef, Par};
use std::sync::Arc;

/// The matrix as an operator.
pub(crate) struct HarmonicGram {
    degree: usize,
    grid: Arc<GaussGrid>,
    diagonal: Vec<f64>,
}

/// What a product with the matrix is made in.
pub(crate) struct Workspace {
    values: Vec<f64>,
    terms: AzimuthTerms,
}

impl HarmonicGram {
    /// The matrix of the harmonics up to `degree`, from the coefficients w_j of degree <= 2 `degree`.
    ///
    /// # Panics
    /// If there are fewer than (2 `degree` + 1)² of them.
    pub(crate) fn new(degree: usize, moments: &[f64]) -> Self {
        let wide = GaussGrid::wide(degree);
        let mut diagonal = vec![0.0; wide.len()];
        wide.synthesis(moments, &mut wide.terms(), &mut diagonal);
        for (entry, weight) in diagonal.iter_mut().zip(wide.weights()) {
            *entry *= weight;
        }
        Self {
            degree,
            grid: GaussGrid::of_degree(degree, 4 * degree),
            diagonal,
        }
    }

    /// Room for [`Self::apply`].
    pub(crate) fn workspace(&self) -> Workspace {
        Workspace {
            values: vec![0.0; self.grid.len()],
            terms: self.grid.terms(),
        }
    }

    /// out = Y'WY x.
    ///
    /// # Panics
    /// If there are fewer than (degree + 1)² numbers, or the workspace is that of another degree.
    pub(crate) fn apply(&self, x: &[f64], workspace: &mut Workspace, out: &mut [f64]) {
        let Workspace { values, terms } = workspace;
        self.grid.synthesis(x, terms, values);
        for (value, weight) in values.iter_mut().zip(&self.diagonal) {
            *value *= weight;
        }
        self.grid.adjoint(values, terms, out);
    }

    /// Y'WY itself, in single or double precision.
    pub(crate) fn lower_triangle<T: ComplexField + Copy>(&self) -> LowerTriangle<T> {
        let groups = groups(self.degree);
        let count = coefficient_count(self.degree);
        let mut entries = vec![from_f64::<T>(0.0); count * count];
        let mut matrix = MatMut::from_column_major_slice_mut(&mut entries, count, count);
        let folded = GaussGrid::wide(self.degree).folded_terms(&self.diagonal);
        let polar = self.grid.polar();
        let rows = polar.column_length();
        let (mut left, mut right) = (Vec::new(), Vec::new());
        let mut before = 0;
        for (at, group) in groups.iter().enumerate() {
            right.clear();
            for other in &groups[at..] {
                let terms = &folded[(group.parity + other.parity) % 2];
                let weights = azimuthal(terms, group, other);
                for column in other.columns(polar) {
                    let products = column.iter().zip(&weights);
                    right.extend(products.map(|(p, w)| from_f64::<T>(p * w)));
                }
            }
            left.clear();
            for column in group.columns(polar) {
                left.extend(column.iter().map(|&p| from_f64::<T>(p)));
            }
            let own = left.len() / rows;
            let below = count - before;
            matmul(
                matrix.as_mut().submatrix_mut(before, before, below, own),
                Accum::Replace,
                MatRef::from_column_major_slice(&right, rows, below).transpose(),
                MatRef::from_column_major_slice(&left, rows, own),
                from_f64(1.0),
                Par::Seq,
            );
            before += own;
        }
        LowerTriangle {
            order: groups.iter().flat_map(Group::indices).collect(),
            entries,
        }
    }
}

/// A symmetric matrix, its lower triangle.
#[derive(Debug)]
pub(crate) struct LowerTriangle<T> {
    /// The coefficient of each row and column.
    pub(crate) order: Vec<usize>,
    /// Column by column; what is above the diagonal is to be ignored.
    pub(crate) entries: Vec<T>,
}

/// Harmonics of one order, azimuthal part and parity of l - m, by degree.
struct Group {
    m: usize,
    trig: Trig,
    parity: usize,
    degree: usize,
}

/// All of them; a group of order m stands before those of higher orders.
fn groups(degree: usize) -> Vec<Group> {
    let mut groups = Vec::new();
    for m in 0..=degree {
        for &trig in Trig::of_order(m) {
            groups.extend((0..2.min(degree + 1 - m)).map(|parity| Group {
                m,
                trig,
                parity,
                degree,
            }));
        }
    }
    groups
}

impl Group {
    /// Their polar parts on the rings of one hemisphere.
    fn columns<'a>(&self, polar: &'a PolarTable) -> impl Iterator<Item = &'a [f64]> {
        let columns = polar.columns(self.m).chunks_exact(polar.column_length());
        columns.skip(self.parity).step_by(2)
    }

    fn indices(&self) -> impl Iterator<Item = usize> {
        let degrees = (self.m + self.parity..=self.degree).step_by(2);
        degrees.map(|l| self.trig.index(l, self.m))
    }
}

/// The azimuthal part of a harmonic.
#[derive(Debug, Clone, Copy)]
enum Trig {
    Cosine,
    Sine,
}

impl Trig {
    /// The parts of order m: that of order 0 has no sine.
    fn of_order(m: usize) -> &'static [Self] {
        match m {
            0 => &[Self::Cosine],
            _ => &[Self::Cosine, Self::Sine],
        }
    }

    /// The index of the harmonic of degree l and order m with this part.
    fn index(self, l: usize, m: usize) -> usize {
        match self {
            Self::Cosine => harmonic_index(l, m as isize),
            Self::Sine => harmonic_index(l, -(m as isize)),
        }
    }
}

/// The azimuthal sums of a product of two parts with a function on rings, whose terms are given by order; half of the
/// terms of the sum and the difference of the orders:
///
/// ```text
/// 2 cos a cos b = cos(a - b) + cos(a + b)    2 sin a sin b = cos(a - b) - cos(a + b)    2 sin a cos b = sin(a + b) + sin(a - b)
/// ```
fn azimuthal(terms: &[[Vec<f64>; 2]], group: &Group, other: &Group) -> Vec<f64> {
    let (part, [by_difference, by_sum]) = match (group.trig, other.trig) {
        (Trig::Cosine, Trig::Cosine) => (0, [0.5, 0.5]),
        (Trig::Sine, Trig::Sine) => (0, [0.5, -0.5]),
        (Trig::Cosine, Trig::Sine) => (1, [0.5, 0.5]),
        (Trig::Sine, Trig::Cosine) => (1, [-0.5, 0.5]),
    };
    let [differences, sums] =
        [other.m - group.m, other.m + group.m].map(|order| &terms[order][part]);
    let pairs = differences.iter().zip(sums);
    pairs
        .map(|(difference, sum)| by_difference * difference + by_sum * sum)
        .collect()
}
