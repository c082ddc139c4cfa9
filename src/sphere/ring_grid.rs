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
use super::{GaussLegendre, HarmonicBasis, coefficient_count, harmonic_index};
use crate::vectorize::{self, vectorize};
use nalgebra::Vector3;
use realfft::num_complex::Complex;
use std::f64::consts::PI;
use std::ops::Range;

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
    /// The harmonics at phi = 0 by [order](by_order), ...
    polar: Vec<f64>,
    /// ... and their derivatives with respect to theta.
    slopes: Vec<f64>,
}

/// Degrees and orders of a list by order m = 0, ..., L, and within it by degree l = m, ..., L.
fn by_order(degree: usize) -> impl Iterator<Item = (usize, usize)> {
    (0..=degree).flat_map(move |m| (m..=degree).map(move |l| (l, m)))
}

/// The ranges of the orders in such a list.
fn orders(degree: usize) -> impl Iterator<Item = Range<usize>> {
    (0..=degree).scan(0, move |start, m| {
        let own = *start..*start + degree + 1 - m;
        *start = own.end;
        Some(own)
    })
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
        let below: Vec<f64> = by_order(degree)
            .map(|(l, m)| of_degree_below(l, m))
            .collect();
        let per_node = PI / rings as f64;
        Self {
            degree,
            rings: rule
                .on(-1.0, 1.0)
                .map(|(cos, weight)| {
                    let sin = ((1.0 - cos) * (1.0 + cos)).sqrt();
                    basis.evaluate(&Vector3::new(sin, 0.0, cos), &mut values);
                    let at = |(l, m): (usize, usize)| values[harmonic_index(l, m as isize)];
                    let polar: Vec<f64> = by_order(degree).map(at).collect();
                    Ring {
                        cos,
                        sin,
                        weight: weight * per_node,
                        slopes: slopes(degree, cos, sin, &polar, &below),
                        polar,
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
        let ordered = Ordered::new(self.degree, coefficients);
        let mut terms = Parts::new(Complex::ZERO, self.degree + 1);
        let mut values = Parts::new(0.0, points);
        let mut workspace = self.fft.workspace();
        let frames: Vec<_> = self.frames().collect();
        let mut out = Vec::with_capacity(self.rings.len() * points);
        for ring in &self.rings {
            ring.sum(&ordered, &mut terms);
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

    /// The sums over all nodes i of `of_values`\[i\] Y_j(n_i) + `of_gradients`\[i\] . grad Y_j(n_i), or of the first part
    /// alone: the exact transpose. Parts of `of_gradients` along n do not count.
    ///
    /// # Panics
    /// If there are fewer values or gradients than nodes.
    pub(crate) fn adjoint(
        &self,
        of_values: &[f64],
        of_gradients: Option<&[Vector3<f64>]>,
    ) -> Vec<f64> {
        let points = self.fft.points();
        let mut terms = Parts::new(Complex::ZERO, self.degree + 1);
        let mut values = Parts::new(0.0, points);
        let mut workspace = self.fft.workspace();
        let frames: Vec<_> = self.frames().collect();
        let mut sums = Ordered::zeros(self.degree);
        for (i, ring) in self.rings.iter().enumerate() {
            let nodes = i * points..(i + 1) * points;
            values.value.copy_from_slice(&of_values[nodes.clone()]);
            self.fft
                .adjoint(&mut values.value, &mut terms.value, &mut workspace);
            if let Some(gradients) = of_gradients {
                for (t, (frame, gradient)) in frames.iter().zip(&gradients[nodes]).enumerate() {
                    values.south[t] = frame.south(ring).dot(gradient);
                    values.east[t] = frame.east().dot(gradient);
                }
                for (values, terms) in [
                    (&mut values.south, &mut terms.south),
                    (&mut values.east, &mut terms.east),
                ] {
                    self.fft.adjoint(values, terms, &mut workspace);
                }
                ring.add_slopes(&mut terms, &mut sums);
            }
            ring.add(&terms.value, &ring.polar, &mut sums);
        }
        sums.coefficients(self.degree)
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
    fn sum(&self, coefficients: &Ordered, terms: &mut Parts<Complex<f64>>) {
        let degree = terms.value.len() - 1;
        for (m, own) in orders(degree).enumerate() {
            let [cosine, sine] =
                [&coefficients.cosine, &coefficients.sine].map(|of| &of[own.clone()]);
            let sums = |polar: &[f64]| {
                let polar = &polar[own.clone()];
                Complex::new(dot(polar, cosine), dot(polar, sine))
            };
            let value = sums(&self.polar);
            let order = m as f64 / self.sin;
            terms.value[m] = value;
            terms.south[m] = sums(&self.slopes);
            terms.east[m] = order * Complex::new(value.im, -value.re);
        }
    }

    /// Adds what terms give to the coefficients, by the polar parts or their slopes.
    fn add(&self, terms: &[Complex<f64>], polar: &[f64], sums: &mut Ordered) {
        for (term, own) in terms.iter().zip(orders(terms.len() - 1)) {
            let polar = &polar[own.clone()];
            add(&mut sums.cosine[own.clone()], term.re, polar);
            add(&mut sums.sine[own], term.im, polar);
        }
    }

    /// Adds what derivatives to the south give, and to the terms of the values what those to the east do: with
    /// [`Self::add`] of these, the transpose of [`Self::sum`].
    fn add_slopes(&self, terms: &mut Parts<Complex<f64>>, sums: &mut Ordered) {
        self.add(&terms.south, &self.slopes, sums);
        for (m, (value, east)) in terms.value.iter_mut().zip(&terms.east).enumerate() {
            let order = m as f64 / self.sin;
            *value += order * Complex::new(-east.im, east.re);
        }
    }
}

/// Coefficients [by order](by_order): those of the cosine and those of the sine, which are zero at order 0.
struct Ordered {
    cosine: Vec<f64>,
    sine: Vec<f64>,
}

impl Ordered {
    fn zeros(degree: usize) -> Self {
        let zeros = vec![0.0; by_order(degree).count()];
        Self {
            cosine: zeros.clone(),
            sine: zeros,
        }
    }

    fn new(degree: usize, coefficients: &[f64]) -> Self {
        let of = |(l, m), sign| coefficients[harmonic_index(l, sign * m as isize)];
        Self {
            cosine: by_order(degree).map(|at| of(at, 1)).collect(),
            sine: by_order(degree)
                .map(|at| if at.1 > 0 { of(at, -1) } else { 0.0 })
                .collect(),
        }
    }

    fn coefficients(&self, degree: usize) -> Vec<f64> {
        let mut coefficients = vec![0.0; coefficient_count(degree)];
        let parts = self.cosine.iter().zip(&self.sine);
        for ((l, m), (cosine, sine)) in by_order(degree).zip(parts) {
            coefficients[harmonic_index(l, m as isize)] = *cosine;
            if m > 0 {
                coefficients[harmonic_index(l, -(m as isize))] = *sine;
            }
        }
        coefficients
    }
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    vectorize(
        #[inline(always)]
        || vectorize::dot(a, b),
    )
}

fn add(sums: &mut [f64], factor: f64, parts: &[f64]) {
    vectorize(
        #[inline(always)]
        || {
            for (sum, part) in sums.iter_mut().zip(parts) {
                *sum += factor * part;
            }
        },
    );
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

/// The factor of the harmonic of degree l - 1 in the derivative of that of degree l.
fn of_degree_below(l: usize, m: usize) -> f64 {
    let (l, m) = (l as f64, m as f64);
    ((2.0 * l + 1.0) * (l * l - m * m) / (2.0 * l - 1.0).abs()).sqrt()
}

/// The derivatives of polar parts with respect to theta, from the factors of those of one degree less.
fn slopes(degree: usize, cos: f64, sin: f64, polar: &[f64], below: &[f64]) -> Vec<f64> {
    let mut slopes = Vec::with_capacity(polar.len());
    let mut before = 0.0;
    for ((l, _), (part, factor)) in by_order(degree).zip(polar.iter().zip(below)) {
        slopes.push((l as f64 * cos * part - factor * before) / sin);
        before = *part;
    }
    slopes
}

#[cfg(test)]
mod tests;
