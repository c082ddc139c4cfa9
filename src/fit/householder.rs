//! Householder triangularisation of a tall matrix with few columns.
//!
//! Textbook (Golub and Van Loan, *Matrix Computations*, algorithm 5.2.1), with the reflections
//! applied to four columns at a time so that each pass over a reflector is used four times. Only R
//! is kept. Why not a library's QR: at 60 to 200 rows by 17 columns, of which a search makes 500,
//! the blocked algorithm of `faer` needs eight times the instructions of these loops, in packing
//! and recursion, and half of a search's time. `faer` is the reference in the tests.

use crate::vectorize::vectorize;

/// Partial sums of a dot product; their fixed number makes the result independent of the processor.
const LANES: usize = 8;

/// Columns that share a pass over the reflector.
const GROUP: usize = 4;

/// Replaces the column-major matrix of `rows` x `columns` (column j starts at `j * stride`) by its
/// triangle R in the first min(rows, columns) rows, zeros below the diagonal there. The rows further
/// down are left undefined.
pub(super) fn triangularise(matrix: &mut [f64], rows: usize, columns: usize, stride: usize) {
    vectorize(
        #[inline(always)]
        || {
            for j in 0..columns.min(rows) {
                let (left, right) = matrix.split_at_mut((j + 1) * stride);
                let v = &mut left[j * stride + j..j * stride + rows];
                let Some((diagonal, scale)) = reflector(v) else {
                    continue;
                };
                let right = &mut right[..(columns - j - 1) * stride];
                for group in right.chunks_mut(GROUP * stride) {
                    reflect(v, scale, group, stride, j);
                }
                v.fill(0.0);
                v[0] = diagonal;
            }
        },
    );
}

/// Turns x into the reflector v that maps it to (diagonal, 0, ..., 0), and returns the diagonal and
/// 2 / v.v; `None` where x is zero already.
#[inline(always)]
fn reflector(x: &mut [f64]) -> Option<(f64, f64)> {
    let norm = dot(x, x).sqrt();
    if norm == 0.0 {
        return None;
    }
    let diagonal = if x[0] > 0.0 { -norm } else { norm };
    let scale = 1.0 / (norm * (norm + x[0].abs()));
    x[0] -= diagonal;
    Some((diagonal, scale))
}

/// Applies the reflection to up to [`GROUP`] columns, from row `top` on.
#[inline(always)]
fn reflect(v: &[f64], scale: f64, group: &mut [f64], stride: usize, top: usize) {
    if group.len() == GROUP * stride {
        let (a, rest) = group.split_at_mut(stride);
        let (b, rest) = rest.split_at_mut(stride);
        let (c, d) = rest.split_at_mut(stride);
        let rows = top..top + v.len();
        let columns = [
            &mut a[rows.clone()],
            &mut b[rows.clone()],
            &mut c[rows.clone()],
            &mut d[rows],
        ];
        reflect_together(v, scale, columns);
    } else {
        for column in group.chunks_mut(stride) {
            reflect_together(v, scale, [&mut column[top..top + v.len()]]);
        }
    }
}

/// column -= scale (v.column) v for a few columns at once.
#[inline(always)]
fn reflect_together<const N: usize>(v: &[f64], scale: f64, mut columns: [&mut [f64]; N]) {
    let whole = v.len() / LANES * LANES;
    let mut sums = [[0.0; LANES]; N];
    for at in (0..whole).step_by(LANES) {
        let v: &[f64; LANES] = v[at..at + LANES].try_into().expect("LANES long");
        for (sums, column) in sums.iter_mut().zip(&columns) {
            let column: &[f64; LANES] = column[at..at + LANES].try_into().expect("LANES long");
            for lane in 0..LANES {
                sums[lane] += v[lane] * column[lane];
            }
        }
    }
    let mut factors = [0.0; N];
    for ((factor, sums), column) in factors.iter_mut().zip(&sums).zip(&columns) {
        let tail = v[whole..].iter().zip(&column[whole..]);
        *factor = scale * (total(sums) + tail.map(|(v, x)| v * x).sum::<f64>());
    }
    for at in (0..whole).step_by(LANES) {
        let v: &[f64; LANES] = v[at..at + LANES].try_into().expect("LANES long");
        for (factor, column) in factors.iter().zip(&mut columns) {
            let column: &mut [f64; LANES] = (&mut column[at..at + LANES])
                .try_into()
                .expect("LANES long");
            for lane in 0..LANES {
                column[lane] -= factor * v[lane];
            }
        }
    }
    for (factor, column) in factors.iter().zip(&mut columns) {
        for (x, v) in column[whole..].iter_mut().zip(&v[whole..]) {
            *x -= factor * v;
        }
    }
}

#[inline(always)]
fn dot(a: &[f64], b: &[f64]) -> f64 {
    let whole = a.len() / LANES * LANES;
    let mut sums = [0.0; LANES];
    for (a, b) in a.chunks_exact(LANES).zip(b.chunks_exact(LANES)) {
        for lane in 0..LANES {
            sums[lane] += a[lane] * b[lane];
        }
    }
    let tail = a[whole..].iter().zip(&b[whole..]);
    total(&sums) + tail.map(|(a, b)| a * b).sum::<f64>()
}

#[inline(always)]
fn total(sums: &[f64; LANES]) -> f64 {
    let [a, b, c, d, e, f, g, h] = sums;
    ((a + b) + (c + d)) + ((e + f) + (g + h))
}

#[cfg(test)]
mod tests {
    use super::*;
    use faer::Mat;

    #[test]
    fn the_triangle_is_that_of_a_library_up_to_the_signs_of_its_rows() {
        for (rows, columns) in [(5, 9), (17, 17), (61, 17), (190, 6), (8, 1)] {
            let stride = rows + 3;
            let entry =
                |i: usize, j: usize| (((i + 3) * (j + 5) * (i + 2 * j)) as f64 * 0.37).sin();
            let mut matrix = vec![f64::NAN; stride * columns];
            for (j, column) in matrix.chunks_mut(stride).enumerate() {
                for (i, x) in column[..rows].iter_mut().enumerate() {
                    *x = entry(i, j);
                }
            }
            triangularise(&mut matrix, rows, columns, stride);
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
        let mut matrix = vec![0.0; 3 * 20];
        matrix[..20].fill(1.0);
        matrix[40..].fill(2.0);
        triangularise(&mut matrix, 20, 3, 20);
        assert_eq!(matrix[21], 0.0);
        assert!(matrix.iter().all(|x| x.is_finite()));
    }
}
