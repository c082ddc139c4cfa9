//! Continuity across all borders: of cells, of margins, of faces, at corners and poles.

use super::grains::{RADIUS, all, critical, plain, tangents, towards};
use grainform::{StarGrain, StarSurface};
use nalgebra::Vector3;

/// Calls `check` with a grain, a direction and a tangent of every critical place.
fn at_critical_places(mut check: impl FnMut(&StarGrain, Vector3<f64>, Vector3<f64>)) {
    for grain in all(plain()) {
        for n in critical(&grain) {
            for tangent in tangents(&n) {
                check(&grain, n, tangent);
            }
        }
    }
}

#[test]
fn the_radius_has_no_step_anywhere() {
    at_critical_places(|grain, n, tangent| {
        let (radius, gradient) = grain.radius_and_gradient(&n);
        let at = |angle: f64| grain.radius(&towards(&n, &tangent, angle));
        for step in [1e-12, 1e-9, 1e-6] {
            let slope = gradient.dot(&tangent);
            let jump = at(step) - at(-step) - 2.0 * step * slope;
            // Beside rounding, the third derivative: some thousand radii in the narrowest margins.
            let bound = RADIUS * (1e-14 + 1e4 * step.powi(3));
            assert!(jump.abs() < bound, "{n} {step}: {jump}");
            let off = at(step) - radius - step * slope;
            assert!(
                off.abs() < RADIUS * (1e-14 + 1e3 * step.powi(2)),
                "{n} {step}: {off}"
            );
            assert!((at(step) - radius).abs() < 1e-9 * RADIUS + 10.0 * step * RADIUS);
        }
    });
}

#[test]
fn normals_from_both_sides_of_every_border_agree() {
    at_critical_places(|grain, n, tangent| {
        let normal = |angle: f64| grain.normal(&towards(&n, &tangent, angle));
        let between = (normal(1e-9) - normal(-1e-9)).norm();
        assert!(between < 1e-6, "{n}: {between}");
    });
}

#[test]
fn second_derivatives_from_both_sides_of_every_border_agree() {
    at_critical_places(|grain, n, tangent| {
        let hessian = |angle: f64| grain.derivatives(&towards(&n, &tangent, angle)).hessian;
        // Third derivatives reach some ten thousand radii in the narrowest margins.
        let between = (hessian(1e-10) - hessian(-1e-10)).norm();
        assert!(between < 1e-5 * RADIUS, "{n}: {between}");
    });
}

#[test]
fn a_blended_grain_has_no_seam_jump() {
    for grain in all(plain()) {
        assert_eq!(grain.seam_jump(), 0.0);
    }
}
