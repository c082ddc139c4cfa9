//! Gauss-Legendre rings of equispaced azimuths: integrals and expansions over the whole sphere.
//!
//! With R rings, cos(theta) at the nodes of the Gauss-Legendre rule and 2R azimuths on each, sums over
//! the nodes are integrals of all polynomials of degree <= 2R - 1. Polar parts and their derivatives
//! come from a table made once, about (L+1)^2 R numbers; no ring is at a pole, so that
//!
//! ```text
//! sin(theta) dP_lm/dtheta = l cos(theta) P_lm - sqrt((2l + 1)(l^2 - m^2) / (2l - 1)) P_(l-1)m
//! ```
//!
//! can be divided. The azimuth is left to fast Fourier transforms. Error of values and gradients:
//! rounding, about 1e-13 of the norm of the coefficients.

use super::azimuth_fft::AzimuthFft;
use super::{GaussLegendre, HarmonicBasis, harmonic_index};
use nalgebra::Vector3;
use realfft::num_complex::Complex;
use std::f64::consts::PI;

/// Gauss-Legendre rings with equispaced azimuths, for expansions in harmonics up to a degree.
pub(crate) struct RingGrid {
    degree: usize,
    rings: Vec<Ring>,
    fft: AzimuthFft,
}

struct Ring {
    cos: f64,
    sin: f64,
    /// Weight of each of its nodes.
    weight: f64,
    /// Per order m = 0, ..., L and within it degree l = m, ..., L: the harmonic at phi = 0 and its
    /// derivative with respect to theta.
    polar: Vec<[f64; 2]>,
}

/// The series of the azimuth, or values, on one ring: of the function and of its derivatives to the
/// south and to the east.
struct Parts<T> {
    value: Vec<T>,
    south: Vec<T>,
    east: Vec<T>,
}

impl<T: Clone> Parts<T> {
    fn new(zero: T, len: usize) -> Self {
        Self {
            value: vec![zero.clone(); len],
            south: vec![zero.clone(); len],
            east: vec![zero; len],
        }
    }
}

impl RingGrid {
    /// `rings` rings, but at least `degree` + 1, with twice as many azimuths each: exact for
    /// polynomials of degree 2 `rings` - 1; for expansions of degree <= `degree`.
    pub(crate) fn new(degree: usize, rings: usize) -> Self {
        let rings = rings.max(degree + 1);
        let rule = GaussLegendre::new(rings);
        let basis = HarmonicBasis::new(degree);
        let mut values = vec![0.0; (degree + 1) * (degree + 1)];
        let per_node = PI / rings as f64;
        Self {
            degree,
            rings: rule
                .on(-1.0, 1.0)
                .map(|(cos, weight)| {
                    let sin = ((1.0 - cos) * (1.0 + cos)).sqrt();
                    basis.evaluate(&Vector3::new(sin, 0.0, cos), &mut values);
                    Ring {
                        cos,
                        sin,
                        weight: weight * per_node,
                        polar: polar_parts(degree, cos, sin, &values),
                    }
                })
                .collect(),
            fft: AzimuthFft::new(2 * rings),
        }
    }

    /// Unit vectors and their weights in solid angle, ring by ring.
    pub(crate) fn nodes(&self) -> Vec<(Vector3<f64>, f64)> {
        let on_ring = |ring: &Ring, frame: Frame| (frame.outward(ring), ring.weight);
        self.rings
            .iter()
            .flat_map(|ring| self.frames().map(move |frame| on_ring(ring, frame)))
            .collect()
    }

    /// Values and surface gradients (tangent vectors, per radian) of an expansion at all nodes.
    ///
    /// # Panics
    /// If there are fewer than (degree + 1)² coefficients.
    pub(crate) fn synthesis(&self, coefficients: &[f64]) -> Vec<(f64, Vector3<f64>)> {
        let points = self.fft.points();
        let mut terms = Parts::new(Complex::ZERO, self.degree + 1);
        let mut values = Parts::new(0.0, points);
        let mut workspace = self.fft.workspace();
        let frames: Vec<_> = self.frames().collect();
        let mut out = Vec::with_capacity(self.rings.len() * points);
        for ring in &self.rings {
            ring.sum(coefficients, &mut terms);
            for (terms, values) in [
                (&terms.value, &mut values.value),
                (&terms.south, &mut values.south),
                (&terms.east, &mut values.east),
            ] {
                self.fft.synthesis(terms, values, &mut workspace);
            }
            out.extend(frames.iter().enumerate().map(|(t, frame)| {
                let gradient = frame.south(ring) * values.south[t] + frame.east() * values.east[t];
                (values.value[t], gradient)
            }));
        }
        out
    }

    /// The sums over all nodes i of `of_values`\[i\] Y_j(n_i) + `of_gradients`\[i\] . grad Y_j(n_i):
    /// the exact transpose. Parts of `of_gradients` along n do not count.
    ///
    /// # Panics
    /// If there are fewer values or gradients than nodes.
    pub(crate) fn adjoint(&self, of_values: &[f64], of_gradients: &[Vector3<f64>]) -> Vec<f64> {
        let points = self.fft.points();
        let mut terms = Parts::new(Complex::ZERO, self.degree + 1);
        let mut values = Parts::new(0.0, points);
        let mut workspace = self.fft.workspace();
        let frames: Vec<_> = self.frames().collect();
        let mut out = vec![0.0; (self.degree + 1) * (self.degree + 1)];
        for (i, ring) in self.rings.iter().enumerate() {
            let nodes = i * points..(i + 1) * points;
            values.value.copy_from_slice(&of_values[nodes.clone()]);
            for (t, (frame, gradient)) in frames.iter().zip(&of_gradients[nodes]).enumerate() {
                values.south[t] = frame.south(ring).dot(gradient);
                values.east[t] = frame.east().dot(gradient);
            }
            for (values, terms) in [
                (&mut values.value, &mut terms.value),
                (&mut values.south, &mut terms.south),
                (&mut values.east, &mut terms.east),
            ] {
                self.fft.adjoint(values, terms, &mut workspace);
            }
            ring.add_transposed(&terms, &mut out);
        }
        out
    }

    fn frames(&self) -> impl Iterator<Item = Frame> + '_ {
        (0..self.fft.points()).map(|t| {
            let (sin, cos) = self.fft.azimuth(t).sin_cos();
            Frame { cos, sin }
        })
    }
}

impl Ring {
    /// The terms of an expansion's azimuth series.
    fn sum(&self, coefficients: &[f64], terms: &mut Parts<Complex<f64>>) {
        let degree = terms.value.len() - 1;
        let mut polar = self.polar.iter();
        for m in 0..=degree {
            let (mut value, mut south) = (Complex::ZERO, Complex::ZERO);
            for (l, [part, slope]) in (m..=degree).zip(polar.by_ref()) {
                let middle = l * (l + 1);
                let term = Complex::new(coefficients[middle + m], coefficients[middle - m]);
                value += part * term;
                south += slope * term;
            }
            let order = m as f64 / self.sin;
            terms.value[m] = value;
            terms.south[m] = south;
            terms.east[m] = order * Complex::new(value.im, -value.re);
        }
    }

    /// The transpose of [`Self::sum`].
    fn add_transposed(&self, terms: &Parts<Complex<f64>>, coefficients: &mut [f64]) {
        let degree = terms.value.len() - 1;
        let mut polar = self.polar.iter();
        for m in 0..=degree {
            let order = m as f64 / self.sin;
            let east = terms.east[m];
            let value = terms.value[m] + order * Complex::new(-east.im, east.re);
            for (l, [part, slope]) in (m..=degree).zip(polar.by_ref()) {
                let term = part * value + slope * terms.south[m];
                coefficients[harmonic_index(l, m as isize)] += term.re;
                if m > 0 {
                    coefficients[harmonic_index(l, -(m as isize))] += term.im;
                }
            }
        }
    }
}

/// An azimuth.
struct Frame {
    cos: f64,
    sin: f64,
}

impl Frame {
    fn outward(&self, ring: &Ring) -> Vector3<f64> {
        Vector3::new(ring.sin * self.cos, ring.sin * self.sin, ring.cos)
    }

    fn south(&self, ring: &Ring) -> Vector3<f64> {
        Vector3::new(ring.cos * self.cos, ring.cos * self.sin, -ring.sin)
    }

    fn east(&self) -> Vector3<f64> {
        Vector3::new(-self.sin, self.cos, 0.0)
    }
}

/// Polar parts and their derivatives, by order, from the harmonics at phi = 0.
fn polar_parts(degree: usize, cos: f64, sin: f64, values: &[f64]) -> Vec<[f64; 2]> {
    let at = |l: usize, m: usize| values[harmonic_index(l, m as isize)];
    let slope = |l: usize, m: usize| {
        let (degree, order) = (l as f64, m as f64);
        let below = match l > m {
            true => at(l - 1, m) * (degree * degree - order * order).sqrt(),
            false => 0.0,
        };
        let ratio = ((2.0 * degree + 1.0) / (2.0 * degree - 1.0).abs()).sqrt();
        (degree * cos * at(l, m) - ratio * below) / sin
    };
    (0..=degree)
        .flat_map(|m| (m..=degree).map(move |l| (l, m)))
        .map(|(l, m)| [at(l, m), slope(l, m)])
        .collect()
}

#[cfg(test)]
mod tests;
