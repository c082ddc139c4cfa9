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
use super::polar::{PolarTable, add};
use crate::sphere::{HarmonicBasis, harmonic_index};
use crate::vectorize::vectorize;
use nalgebra::Vector3;
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
    let basis = HarmonicBasis::new(degree);
    let theta = |i: usize| PI * (i as f64 + 0.5) / (degree + 1) as f64;
    let mut values = vec![0.0; (degree + 1) * (degree + 1)];
    let at_midpoints: Vec<Vec<f64>> = (0..(degree + 1).div_ceil(2))
        .map(|i| {
            let (sin, cos) = theta(i).sin_cos();
            basis.evaluate(&Vector3::new(sin, 0.0, cos), &mut values);
            values.clone()
        })
        .collect();
    let filters = [(0, 0), (0, 1), (1, 0), (1, 1)]
        .map(|(m, l)| Filter::new(degree, around, rows, &transform, m, l));
    let per_order: Vec<f64> = (0..=degree)
        .map(|m| 1.0 / transform.at(m, azimuths))
        .collect();
    PolarTable::new(degree, rings, |l, m, column| {
        let filter = &filters[2 * (m % 2) + l % 2];
        let values = at_midpoints
            .iter()
            .map(|values| per_order[m] * values[harmonic_index(l, m as isize)]);
        filter.apply(&values.collect::<Vec<_>>(), column);
    })
}

/// From a polar part at the midpoints of the northern hemisphere to its quotient at the northern
/// rings, for one parity of the order and one of the degree: the discrete transform to cosines or
/// sines, the division and the sum of the series, in one matrix.
struct Filter {
    rows: usize,
    /// A column of `rows` for each midpoint.
    columns: Vec<f64>,
}

impl Filter {
    fn new(
        degree: usize,
        around: usize,
        rows: usize,
        transform: &KernelTransform,
        order_parity: usize,
        degree_parity: usize,
    ) -> Self {
        let midpoints = degree + 1;
        let wave = |angle: f64| match order_parity {
            0 => angle.cos(),
            _ => angle.sin(),
        };
        let rings = (around / 2 + 1).div_ceil(2);
        let mut columns = vec![0.0; midpoints.div_ceil(2) * rows];
        for k in (degree_parity..midpoints).step_by(2) {
            let factor =
                if k == 0 { 2.0 } else { 4.0 } / midpoints as f64 / transform.at(k, around);
            let at_rings: Vec<f64> = (0..rings)
                .map(|i| factor * wave(2.0 * PI * (k * i) as f64 / around as f64))
                .collect();
            for (i, column) in columns.chunks_exact_mut(rows).enumerate() {
                let share = if 2 * i + 1 == midpoints { 0.5 } else { 1.0 };
                let angle = PI * k as f64 * (i as f64 + 0.5) / midpoints as f64;
                add(column, share * wave(angle), &at_rings);
            }
        }
        Self { rows, columns }
    }

    fn apply(&self, values: &[f64], out: &mut [f64]) {
        vectorize(
            #[inline(always)]
            || {
                for (&value, column) in values.iter().zip(self.columns.chunks_exact(self.rows)) {
                    add(out, value, column);
                }
            },
        );
    }
}
