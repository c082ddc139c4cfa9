//! The polar parts of the harmonics on the rings of an oversampled grid.
//!
//! Rings stand at theta_i = 2 pi i / n, i = 0, ..., n / 2, both poles among them. The polar part of
//! the harmonic of degree l and order m is a sum of cos(k theta), or of sin(k theta) where m is odd,
//! k <= l. For an interpolation to give this sum every term is divided by what the kernel lets
//! through of the frequencies k and m. The terms come from values at L + 1 midpoints (a discrete
//! cosine or sine transform), not from a recurrence in the terms themselves, which is unstable near
//! the poles. As only the quotient's values at the rings are ever needed, the table holds these.
//! Entries: error below 1e-13.

use super::kernel::KernelTransform;
use super::polar::PolarTable;
use crate::sphere::HarmonicBasis;
use faer::linalg::matmul::matmul;
use faer::{Accum, Mat, MatMut, MatRef, Par};
use std::f64::consts::PI;

/// The table for a kernel of a width, and a grid of n = `around` points along a meridian and back, and
/// `azimuths` points along a parallel.
pub(super) fn oversampled(
    degree: usize,
    width: usize,
    around: usize,
    azimuths: usize,
) -> PolarTable {
    let rings = around / 2 + 1;
    let rows = PolarTable::rows(rings);
    let transform = KernelTransform::new(width);
    let northern = (degree + 1).div_ceil(2);
    let cosines: Vec<f64> = (0..northern).map(|i| midpoint(degree, i).cos()).collect();
    let at_midpoints = HarmonicBasis::new(degree).polar_parts(&cosines, northern);
    let filters = [0, 1].map(|m| [0, 1].map(|l| filter(degree, around, &transform, [m, l])));
    let mut columns = vec![0.0; (degree + 1) * (degree + 2) / 2 * rows];
    let (mut from, mut to) = (&at_midpoints[..], &mut columns[..]);
    for m in 0..=degree {
        let degrees = degree + 1 - m;
        let (own, others) = from.split_at(degrees * northern);
        let (out, later) = to.split_at_mut(degrees * rows);
        let per_order = 1.0 / transform.at(m, azimuths);
        for (offset, filter) in (0..2.min(degrees)).map(|at| (at, &filters[m % 2][(m + at) % 2])) {
            let count = (degrees - offset).div_ceil(2);
            let (own, out) = (&own[offset * northern..], &mut out[offset * rows..]);
            matmul(
                MatMut::from_column_major_slice_with_stride_mut(
                    out,
                    filter.nrows(),
                    count,
                    2 * rows,
                ),
                Accum::Replace,
                filter.as_ref(),
                MatRef::from_column_major_slice_with_stride(own, northern, count, 2 * northern),
                per_order,
                Par::Seq,
            );
        }
        (from, to) = (others, later);
    }
    PolarTable::new(degree, rings, columns)
}

/// The polar angle of a midpoint, from the pole on.
fn midpoint(degree: usize, at: usize) -> f64 {
    PI * (at as f64 + 0.5) / (degree + 1) as f64
}

/// From a polar part at the midpoints of the northern hemisphere to its quotient at the northern
/// rings, for a parity of the order and one of the degree: the discrete transform to cosines or
/// sines, the division and the sum of the series, in one matrix.
fn filter(
    degree: usize,
    around: usize,
    transform: &KernelTransform,
    [order_parity, degree_parity]: [usize; 2],
) -> Mat<f64> {
    let midpoints = degree + 1;
    let wave = |angle: f64| match order_parity {
        0 => angle.cos(),
        _ => angle.sin(),
    };
    let frequencies: Vec<usize> = (degree_parity..midpoints).step_by(2).collect();
    let rings = (around / 2 + 1).div_ceil(2);
    let factor = |&k: &usize| {
        let times = if k == 0 { 2.0 } else { 4.0 };
        times / midpoints as f64 / transform.at(k, around)
    };
    let factors: Vec<f64> = frequencies.iter().map(factor).collect();
    let at_rings = Mat::from_fn(rings, frequencies.len(), |i, at| {
        factors[at] * wave(2.0 * PI * (frequencies[at] * i) as f64 / around as f64)
    });
    let at_midpoints = Mat::from_fn(frequencies.len(), midpoints.div_ceil(2), |at, i| {
        let share = if 2 * i + 1 == midpoints { 0.5 } else { 1.0 };
        share * wave(frequencies[at] as f64 * midpoint(degree, i))
    });
    let mut filter = Mat::zeros(rings, midpoints.div_ceil(2));
    matmul(
        &mut filter,
        Accum::Replace,
        &at_rings,
        &at_midpoints,
        1.0,
        Par::Seq,
    );
    filter
}
