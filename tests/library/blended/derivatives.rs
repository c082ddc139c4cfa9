//! Derivatives from the formulas of the model against differences of the radius.

use super::grains::{RADIUS, all, anywhere, critical, plain, segmented, tangents, towards, turned};
use grainform::model::{Blended, Family};
use grainform::sphere::{Cover, CubeCell};
use grainform::{StarGrain, StarSurface};
use nalgebra::Vector3;

/// A sphere as all cells see it.
fn sphere() -> StarGrain {
    let cells = CubeCell::uniform(2);
    let mut own = vec![0.0; 16];
    own[0] = RADIUS;
    let coefficients = vec![own; cells.len()];
    let cover = Cover::new(cells).expect("a cover");
    let surface = Blended::new(cover, coefficients).expect("sound");
    StarGrain::new(turned(), Family::Blended(surface)).expect("a frame")
}

/// Checks the derivatives in a direction of the scan, by differences over a small angle, of which
/// those of second order may be off by `bound` radii.
pub(crate) fn check(grain: &StarGrain, n: &Vector3<f64>, bound: f64) {
    let found = grain.derivatives(n);
    let (radius, gradient) = grain.radius_and_gradient(n);
    assert!((found.radius - radius).abs() < 1e-14 * RADIUS);
    assert!((found.gradient - gradient).norm() < 1e-11 * RADIUS);
    assert!(found.gradient.dot(n).abs() < 1e-12 * RADIUS);
    let hessian = found.hessian;
    assert!((hessian - hessian.transpose()).norm() < 1e-10 * RADIUS);
    assert!((hessian * n).norm() < 1e-10 * RADIUS);
    for tangent in tangents(n) {
        let step = 1e-6;
        let [after, before] = [step, -step].map(|angle| towards(n, &tangent, angle));
        let slope = (grain.radius(&after) - grain.radius(&before)) / (2.0 * step);
        assert!(
            (slope - gradient.dot(&tangent)).abs() < 1e-7 * RADIUS,
            "{n}: {slope}"
        );
        let [after, before] = [after, before].map(|n| grain.radius_and_gradient(&n).1);
        let change = (after - before) / (2.0 * step);
        let change = change - n * change.dot(n);
        let off = (change - hessian * tangent).norm();
        assert!(off < bound * RADIUS, "{n}: {off}");
    }
}

#[test]
fn derivatives_of_blended_grains_are_those_of_the_radius() {
    for frame in [plain(), turned()] {
        for grain in all(frame) {
            for n in critical(&grain) {
                // Third derivatives may jump here.
                check(&grain, &(frame.axes * n), 2e-3);
            }
            for n in anywhere(200) {
                check(&grain, &n, 2e-3);
            }
        }
    }
}

#[test]
fn derivatives_of_independent_segments_are_those_of_the_radius() {
    for frame in [plain(), turned()] {
        for per_angle in [1, 2, 5] {
            let grain = segmented(per_angle, frame);
            let surface = grain.family().segmented().expect("segments");
            let partition = surface.partition();
            for segment in 0..partition.segments() {
                for i in 0..9 {
                    let (s, t) = (0.2 + 0.3 * (i / 3) as f64, 0.2 + 0.3 * (i % 3) as f64);
                    let local = partition.rectangle(segment).direction(s, t);
                    check(&grain, &(frame.axes * local), 1e-6);
                }
            }
        }
        // The pole of a whole sphere lies within its only segment.
        let whole = segmented(1, frame);
        for side in [1.0, -1.0] {
            check(&whole, &(frame.axes.column(2) * side), 1e-6);
        }
    }
}

#[test]
fn a_sphere_has_no_derivatives() {
    let grain = sphere();
    for n in critical(&grain).into_iter().chain(anywhere(500)) {
        let found = grain.derivatives(&n);
        assert!((found.radius - RADIUS).abs() < 1e-14 * RADIUS);
        assert!(found.gradient.norm() < 1e-13 * RADIUS, "{n}");
        assert!(found.hessian.norm() < 1e-11 * RADIUS, "{n}");
        assert!((grain.normal(&n) - n).norm() < 1e-13);
    }
}

#[test]
fn many_radii_are_the_radii_one_by_one() {
    let mut grains = all(turned());
    grains.push(segmented(3, turned()));
    for grain in grains {
        let mut directions = anywhere(3001);
        directions.extend(critical(&grain).iter().map(|n| turned().axes * n));
        let radii = grain.radii(&directions);
        assert_eq!(radii.len(), directions.len());
        for (n, radius) in directions.iter().zip(radii) {
            assert!((radius - grain.radius(n)).abs() <= 1e-15 * RADIUS, "{n}");
        }
        assert!(grain.radii(&[]).is_empty());
        assert_eq!(grain.radii(&directions[..1]).len(), 1);
    }
}
