//! Householder triangularisation of a tall matrix with few columns.
//!
//! Textbook (Golub and Van Loan, *Matrix Computations*, algorithm 5.2.1), with the reflections
//! applied to four columns at a time so that each pass over a reflector is used four times. Only R
//! is kept. Why not a library's QR: at 60 to 200 rows by 17 columns, of which a search makes 500,
//! the blocked algorithm of `faer` needs eight times the instructions of these loops, in packing
//! and recursion, and half of a search's time. For wide matrices it is the faster one and is used;
//! in the tests it is the reference.
//!
//! The order of summation follows the width of the processor's registers, so the last digits of R
//! may differ between kinds of processors; between runs, threads and orders of the points they do
//! not.

use faer::MatMut;
use pulp::{Arch, Simd, WithSimd};

/// Columns beyond which blocking pays.
pub(super) const WIDE: usize = 64;

/// The widest register in use holds this many numbers. Columns are worked on in whole blocks of as
/// many rows: parts of registers are slow to load and store.
const LANES: usize = 8;

/// Rows that a matrix of `rows` rows takes up.
pub(super) const fn padded(rows: usize) -> usize {
    rows.next_multiple_of(LANES)
}

/// Replaces the column-major matrix of `rows` x `columns` (column j starts at `j * stride`, with
/// room for [`padded`] rows) by its triangle R in the first min(rows, columns) rows, zeros below the
/// diagonal there. The rows further down are left undefined. `reflector` is working memory.
pub(super) fn triangularise(
    matrix: &mut [f64],
    rows: usize,
    columns: usize,
    stride: usize,
    reflector: &mut Vec<f64>,
) {
    if columns > WIDE {
        return by_library(matrix, rows, columns, stride);
    }
    reflector.clear();
    reflector.resize(padded(rows), 0.0);
    for column in matrix.chunks_mut(stride).take(columns) {
        column[rows..padded(rows)].fill(0.0);
    }
    Arch::new().dispatch(Triangularise {
        matrix,
        rows,
        columns,
        stride,
        reflector,
    });
}

/// The same by the blocked algorithm of `faer`.
fn by_library(matrix: &mut [f64], rows: usize, columns: usize, stride: usize) {
    let mut matrix = MatMut::from_column_major_slice_with_stride_mut(matrix, rows, columns, stride);
    let factored = matrix.as_ref().to_owned().qr();
    let triangle = factored.R();
    for column in 0..columns {
        for row in 0..rows.min(columns) {
            matrix[(row, column)] = if row <= column {
                triangle[(row, column)]
            } else {
                0.0
            };
        }
    }
}

struct Triangularise<'a> {
    matrix: &'a mut [f64],
    rows: usize,
    columns: usize,
    stride: usize,
    reflector: &'a mut [f64],
}

impl WithSimd for Triangularise<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        let Self {
            matrix,
            rows,
            columns,
            stride,
            reflector,
        } = self;
        let end = padded(rows);
        for j in 0..columns.min(rows) {
            // The block of rows that j lies in: the reflector is zero above j.
            let start = j / LANES * LANES;
            let (left, right) = matrix.split_at_mut((j + 1) * stride);
            let x = &mut left[j * stride + j..j * stride + end];
            let v = &mut reflector[start..end];
            v[..j - start].fill(0.0);
            v[j - start..].copy_from_slice(x);

            let [squared] = products(simd, v, [v]);
            let norm = squared.sqrt();
            if norm == 0.0 {
                continue;
            }
            let diagonal = if x[0] > 0.0 { -norm } else { norm };
            let scale = 1.0 / (norm * (norm + x[0].abs()));
            v[j - start] -= diagonal;
            x.fill(0.0);
            x[0] = diagonal;

            let mut rest = right
                .chunks_mut(stride)
                .take(columns - j - 1)
                .map(|column| &mut column[start..end]);
            while let Some(a) = rest.next() {
                match (rest.next(), rest.next(), rest.next()) {
                    (Some(b), Some(c), Some(d)) => reflect(simd, v, scale, [a, b, c, d]),
                    (b, c, _) => {
                        for column in [Some(a), b, c].into_iter().flatten() {
                            reflect(simd, v, scale, [column]);
                        }
                    }
                }
            }
        }
    }
}

/// column -= scale (v.column) v for a few columns at once.
#[inline(always)]
fn reflect<S: Simd, const N: usize>(simd: S, v: &[f64], scale: f64, columns: [&mut [f64]; N]) {
    let mut views: [&[f64]; N] = [&[]; N];
    for (view, column) in views.iter_mut().zip(&columns) {
        *view = column;
    }
    let products = products(simd, v, views);
    let (v, _) = S::as_simd_f64s(v);
    for (column, product) in columns.into_iter().zip(products) {
        let factor = simd.splat_f64s(-scale * product);
        let (column, _) = S::as_mut_simd_f64s(column);
        for (x, v) in column.iter_mut().zip(v) {
            *x = simd.mul_add_e_f64s(factor, *v, *x);
        }
    }
}

/// The dot products of v with a few columns of the same length. (Loops, not `map`: a closure that
/// is not inlined would call every instruction as a function.)
#[inline(always)]
fn products<S: Simd, const N: usize>(simd: S, v: &[f64], columns: [&[f64]; N]) -> [f64; N] {
    let (v, _) = S::as_simd_f64s(v);
    let mut sums = [simd.splat_f64s(0.0); N];
    let mut blocks: [&[S::f64s]; N] = [&[]; N];
    for (blocks, column) in blocks.iter_mut().zip(columns) {
        *blocks = &S::as_simd_f64s(column).0[..v.len()];
    }
    for (i, v) in v.iter().enumerate() {
        for (sum, blocks) in sums.iter_mut().zip(&blocks) {
            *sum = simd.mul_add_e_f64s(*v, blocks[i], *sum);
        }
    }
    let mut products = [0.0; N];
    for (product, sum) in products.iter_mut().zip(sums) {
        *product = simd.reduce_sum_f64s(sum);
    }
    products
}

#[cfg(test)]
mod tests {
    use super::*;
    use faer::Mat;

    #[test]
    fn the_triangle_is_that_of_a_library_up_to_the_signs_of_its_rows() {
        for (rows, columns) in [
            (5, 9),
            (17, 17),
            (61, 17),
            (190, 6),
            (8, 1),
            (150, 82),
            (40, 82),
        ] {
            let stride = padded(rows) + 3;
            let entry =
                |i: usize, j: usize| (((i + 3) * (j + 5) * (i + 2 * j)) as f64 * 0.37).sin();
            let mut matrix = vec![f64::NAN; stride * columns];
            for (j, column) in matrix.chunks_mut(stride).enumerate() {
                for (i, x) in column[..rows].iter_mut().enumerate() {
                    *x = entry(i, j);
                }
            }
            triangularise(&mut matrix, rows, columns, stride, &mut Vec::new());
            let library = Mat::from_fn(rows, columns, entry).qr();
            for i in 0..rows.min(columns) {
                let sign = (matrix[i * stride + i] * library.R()[(i, i)]).signum();
                for j in 0..columns {
                    let want = if j < i {
                        0.0
                    } else {
                        sign * library.R()[(i, j)]
                    };
                    assert!((matrix[j * stride + i] - want).abs() < 1e-13);
                }
            }
        }
    }

    #[test]
    fn a_zero_column_gives_a_zero_diagonal_and_no_nan() {
        let stride = padded(20);
        let mut matrix = vec![0.0; 3 * stride];
        matrix[..20].fill(1.0);
        matrix[2 * stride..].fill(2.0);
        triangularise(&mut matrix, 20, 3, stride, &mut Vec::new());
        assert_eq!(matrix[stride + 1], 0.0);
        assert!(matrix.iter().all(|x| x.is_finite()));
    }
}
