//! Clouds that leave a fit something to miss: rough by half a percent, as scans are.
//!
//! An error of the least squares shows in proportion to the residual, so a smooth cloud would hide
//! what a bad condition costs.

use crate::model::StarSurface;
use crate::shapes::{Body, Ellipsoid, Sampling, SynthOptions, synthesize};
use crate::sphere::coefficient_count;
use nalgebra::{Point3, Vector3};

/// Standard deviation of the roughness, as a share of the radius.
const ROUGHNESS: f64 = 0.005;

/// Enough points to draw an ellipsoid by.
const LEAST_POINTS: usize = 1000;

/// A chickpea of about so many points.
pub(super) fn chickpea(points: usize, sampling: Sampling) -> Vec<Point3<f64>> {
    let options = SynthOptions::clean(Body::Chickpea)
        .with_points(points)
        .with_sampling(sampling)
        .with_noise(ROUGHNESS);
    synthesize(&options).expect("valid options").points
}

/// About four samples per coefficient in every one of k x k segments, the poles' too: rings of even
/// polar angles on an ellipsoid whose axes are those of the scan.
pub(super) fn even_in_angles(k: usize, degree: usize) -> Vec<Point3<f64>> {
    let points = 4 * coefficient_count(degree) * k * k;
    let ellipsoid = Ellipsoid {
        semi_axes: Vector3::new(3.0, 4.0, 6.0),
    };
    let directions = Sampling::Rings
        .directions(points.max(LEAST_POINTS), 0)
        .expect("enough points");
    let golden = 0.5 * (5.0_f64.sqrt() - 1.0);
    let rough = |(i, n): (usize, &Vector3<f64>)| {
        let uniform = (i as f64 * golden).fract() - 0.5;
        let radius = ellipsoid.radius(n) * (1.0 + ROUGHNESS * 12.0_f64.sqrt() * uniform);
        Point3::from(n * radius)
    };
    directions.iter().enumerate().map(rough).collect()
}
