//! The fit of a segment in extended precision: what double precision is measured against.
//!
//! Two doubles per number, 31 digits. Directions and radii are taken from the points as they stand
//! in the scan, the functions are plain powers and not the library's recurrences, and the least
//! squares are solved by Gram and Schmidt's orthogonalization. With so many digits the simplest way
//! is exact enough: a condition of 1e10 leaves 20 of them.

use crate::model::Frame;
use crate::sphere::{Cap, coefficient_count};
use nalgebra::{Point3, Vector3};
use qd::Quad;

/// A point of a scan as a fit sees it, in the frame of a grain.
#[derive(Clone)]
pub(super) struct Sample {
    /// Unit vector to the point.
    pub(super) direction: Vector3<f64>,
    exact: [Quad; 3],
    radius: Quad,
}

impl Sample {
    pub(super) fn new(point: &Point3<f64>, frame: &Frame) -> Self {
        let offset: [Quad; 3] =
            std::array::from_fn(|i| Quad::from(point[i]).sub_accurate(frame.centre[i].into()));
        let local = frame
            .axes
            .column_iter()
            .map(|axis| dot(axis.into(), &offset));
        let local: Vec<Quad> = local.collect();
        let radius = inner(&local, &local).sqrt();
        Self {
            direction: frame.to_local(point).normalize(),
            exact: std::array::from_fn(|i| local[i] / radius),
            radius,
        }
    }

    /// Distance from the centre of the frame.
    pub(super) fn radius(&self) -> f64 {
        self.radius.0
    }
}

/// The largest radius of the samples.
pub(super) fn largest_radius(samples: &[Sample]) -> f64 {
    samples.iter().map(Sample::radius).fold(0.0, f64::max)
}

/// The radii, at the samples, of the expansion of the given degree that meets them best.
///
/// The columns (u + iv)^m x^j, m + j <= L, span the harmonics of degree <= L on any cap. They are
/// made orthogonal one by one, the radius last: what is left of it is the residual.
pub(super) fn fitted_radii(degree: usize, cap: &Cap, samples: &[Sample]) -> Vec<f64> {
    let mut columns = powers(degree, cap, samples);
    let mut residual: Vec<Quad> = samples.iter().map(|sample| sample.radius).collect();
    for j in 0..columns.len() {
        let (known, rest) = columns.split_at_mut(j + 1);
        let direction = &known[j];
        let length = inner(direction, direction);
        for column in rest.iter_mut().chain([&mut residual]) {
            let part = inner(direction, column) / length;
            for (x, d) in column.iter_mut().zip(direction) {
                *x -= part * d;
            }
        }
    }
    let fitted = |(sample, left): (&Sample, &Quad)| (sample.radius - *left).0;
    samples.iter().zip(&residual).map(fitted).collect()
}

/// The functions at the samples, column by column.
fn powers(degree: usize, cap: &Cap, samples: &[Sample]) -> Vec<Vec<Quad>> {
    let mut columns = vec![Vec::with_capacity(samples.len()); coefficient_count(degree)];
    let width = Quad::from(2.0 * cap.height).sqrt();
    for sample in samples {
        let [u, v] = cap
            .tangents
            .map(|axis| dot(axis.into(), &sample.exact) / width);
        // From 1 at the centre of the cap to -1 at its rim.
        let depth = (Quad::ONE - dot(cap.centre.into(), &sample.exact)) / Quad::from(cap.height);
        let x = Quad::ONE - depth - depth;
        let (mut re, mut im) = (Quad::ONE, Quad::ZERO);
        let mut next = columns.iter_mut();
        for m in 0..=degree {
            let mut height = Quad::ONE;
            for _ in m..=degree {
                for part in [re, im].into_iter().take(if m == 0 { 1 } else { 2 }) {
                    next.next().expect("(L + 1)^2 columns").push(part * height);
                }
                height *= x;
            }
            (re, im) = (re * u - im * v, re * v + im * u);
        }
    }
    columns
}

fn dot(axis: [f64; 3], vector: &[Quad; 3]) -> Quad {
    inner(&axis.map(Quad::from), vector)
}

fn inner(a: &[Quad], b: &[Quad]) -> Quad {
    a.iter()
        .zip(b)
        .fold(Quad::ZERO, |sum, (x, y)| sum.add_accurate(*x * *y))
}
