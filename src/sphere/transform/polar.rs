//! The polar parts of the harmonics on the rings of an oversampled grid.
//!
//! Rings stand at theta_i = 2 pi i / n, i = 0, ..., n / 2, both poles among them. The polar part of
//! the harmonic of degree l and order m is a sum of cos(k theta), or of sin(k theta) where m is odd,
//! k <= l. For an interpolation to give this sum every term is divided by what the kernel lets
//! through of the frequencies k and m. The terms come from values at L + 1 midpoints (a discrete
//! cosine or sine transform), not from a recurrence in the terms themselves, which is unstable near
//! the poles. As only the quotient's values at the rings are ever needed, the table holds these:
//! (L+1)^2/2 columns of half the rings, the other half being their mirror images, even or odd as
//! l - m is. Entries: error below 1e-13.

use super::kernel::KernelTransform;
use crate::sphere::{HarmonicBasis, harmonic_index};
use crate::vectorize::vectorize;
use nalgebra::Vector3;
use realfft::num_complex::Complex;
use std::f64::consts::PI;

/// Columns are padded by zeros to a multiple of this.
const LANES: usize = 8;

pub(super) struct PolarTable {
    degree: usize,
    rings: usize,
    /// Length of a column, from the north pole to the equator.
    rows: usize,
    /// Columns by order m = 0, ..., L and within it degree l = m, ..., L.
    columns: Vec<f64>,
}

/// Sums of the columns of one order with l - m even (0) and odd (1), for cosines and for sines.
struct Halves {
    cosine: [Vec<f64>; 2],
    sine: [Vec<f64>; 2],
}

impl PolarTable {
    /// The table for a grid of n = `around` points along a meridian and back, and `azimuths` points
    /// along a parallel.
    pub(super) fn new(degree: usize, around: usize, azimuths: usize) -> Self {
        let rings = around / 2 + 1;
        let rows = rings.div_ceil(2).next_multiple_of(LANES);
        let transform = KernelTransform::new();
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
        let mut columns = Vec::new();
        for m in 0..=degree {
            let per_order = 1.0 / transform.at(m, azimuths);
            for l in m..=degree {
                let first = columns.len();
                columns.resize(first + rows, 0.0);
                let filter = &filters[2 * (m % 2) + l % 2];
                let values = at_midpoints
                    .iter()
                    .map(|values| per_order * values[harmonic_index(l, m as isize)]);
                filter.apply(values, &mut columns[first..]);
            }
        }
        Self {
            degree,
            rings,
            rows,
            columns,
        }
    }

    /// Number of rings, poles included.
    pub(super) fn rings(&self) -> usize {
        self.rings
    }

    /// The terms of the azimuth on every ring, ring by ring, orders 0, ..., L: the cosine's as real
    /// part, the sine's as imaginary part.
    pub(super) fn synthesis(&self, coefficients: &[f64], terms: &mut [Complex<f64>]) {
        vectorize(
            #[inline(always)]
            || {
                let mut halves = self.halves();
                self.for_each_order(|m, columns| {
                    let Halves { cosine, sine } = &mut halves;
                    for half in cosine.iter_mut().chain(sine.iter_mut()) {
                        half.fill(0.0);
                    }
                    for (l, column) in (m..).zip(columns.chunks_exact(self.rows)) {
                        let [a, b] = pair(coefficients, l, m);
                        add(&mut cosine[(l - m) % 2], a, column);
                        add(&mut sine[(l - m) % 2], b, column);
                    }
                    for i in 0..self.rings.div_ceil(2) {
                        let even = Complex::new(cosine[0][i], sine[0][i]);
                        let odd = Complex::new(cosine[1][i], sine[1][i]);
                        let mirrored = self.rings - 1 - i;
                        terms[i * (self.degree + 1) + m] = even + odd;
                        if mirrored > i {
                            terms[mirrored * (self.degree + 1) + m] = even - odd;
                        }
                    }
                });
            },
        );
    }

    /// The transpose of [`Self::synthesis`].
    pub(super) fn adjoint(&self, terms: &[Complex<f64>], coefficients: &mut [f64]) {
        vectorize(
            #[inline(always)]
            || {
                let mut halves = self.halves();
                self.for_each_order(|m, columns| {
                    let Halves { cosine, sine } = &mut halves;
                    for i in 0..self.rings.div_ceil(2) {
                        let mirrored = self.rings - 1 - i;
                        let north = terms[i * (self.degree + 1) + m];
                        let south = match mirrored > i {
                            true => terms[mirrored * (self.degree + 1) + m],
                            false => Complex::ZERO,
                        };
                        let (even, odd) = (north + south, north - south);
                        (cosine[0][i], sine[0][i]) = (even.re, even.im);
                        (cosine[1][i], sine[1][i]) = (odd.re, odd.im);
                    }
                    for (l, column) in (m..).zip(columns.chunks_exact(self.rows)) {
                        let order = m as isize;
                        let parity = (l - m) % 2;
                        coefficients[harmonic_index(l, order)] = dot(&cosine[parity], column);
                        if m > 0 {
                            coefficients[harmonic_index(l, -order)] = dot(&sine[parity], column);
                        }
                    }
                });
            },
        );
    }

    fn halves(&self) -> Halves {
        let zeros = || vec![0.0; self.rows];
        Halves {
            cosine: [zeros(), zeros()],
            sine: [zeros(), zeros()],
        }
    }

    /// Calls `with` with every order and its columns.
    #[inline(always)]
    fn for_each_order(&self, mut with: impl FnMut(usize, &[f64])) {
        let mut rest = &self.columns[..];
        for m in 0..=self.degree {
            let (columns, others) = rest.split_at((self.degree + 1 - m) * self.rows);
            with(m, columns);
            rest = others;
        }
    }
}

/// The coefficients of the cosine and the sine of degree l and order m.
#[inline(always)]
fn pair(coefficients: &[f64], l: usize, m: usize) -> [f64; 2] {
    let middle = l * (l + 1);
    let sine = if m > 0 { coefficients[middle - m] } else { 0.0 };
    [coefficients[middle + m], sine]
}

#[inline(always)]
fn add(sum: &mut [f64], factor: f64, column: &[f64]) {
    for (sum, entry) in sum.iter_mut().zip(column) {
        *sum += factor * entry;
    }
}

#[inline(always)]
fn dot(a: &[f64], b: &[f64]) -> f64 {
    let mut lanes = [0.0; LANES];
    for (a, b) in a.chunks_exact(LANES).zip(b.chunks_exact(LANES)) {
        for i in 0..LANES {
            lanes[i] += a[i] * b[i];
        }
    }
    lanes.iter().sum()
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

    fn apply(&self, values: impl Iterator<Item = f64>, out: &mut [f64]) {
        for (value, column) in values.zip(self.columns.chunks_exact(self.rows)) {
            add(out, value, column);
        }
    }
}
