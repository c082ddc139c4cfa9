//! Expansions of the whole sphere against other ways to the same radius.

use super::derivatives::check;
use super::grains::{
    RADIUS, anywhere, critical, numbers, plain, segmented, tangents, towards, turned, whole,
};
use super::integrals;
use grainform::measure::{Scheme, Survey, grain_properties, integrate, mesh_properties};
use grainform::model::{Family, InvalidGrain, Region, Stretch, Whole};
use grainform::report::{Measure, MeasureReport, Measured};
use grainform::sphere::harmonics;
use grainform::{StarGrain, StarSurface, Surface};
use nalgebra::Vector3;
use std::f64::consts::PI;

fn places() -> Vec<Vector3<f64>> {
    let mut places = critical(&whole(0, plain()));
    places.extend(anywhere(200));
    places.push(Vector3::new(1e-9, -2e-9, -1.0).normalize());
    places
}

#[test]
fn the_radius_is_the_sum_of_the_harmonics() {
    for degree in [0, 1, 12, Whole::MAX_DEGREE] {
        let grain = whole(degree, turned());
        let directions: Vec<_> = places().iter().map(|n| turned().axes * n).collect();
        let radii = grain.radii(&directions);
        for (n, radius) in directions.iter().zip(radii) {
            let values = harmonics(degree, &turned().axes.tr_mul(n));
            let terms = values.iter().zip(&grain.coefficients()[0]);
            let sum: f64 = terms.map(|(y, a)| y * a).sum();
            assert!((radius - sum).abs() < 1e-12 * RADIUS, "{degree} {n}");
            assert!((grain.radius(n) - sum).abs() < 1e-12 * RADIUS);
        }
        assert!(grain.radii(&[]).is_empty());
    }
}

#[test]
fn derivatives_are_those_of_the_radius() {
    for frame in [plain(), turned()] {
        let grain = whole(12, frame);
        for n in places() {
            check(&grain, &(frame.axes * n), 1e-6);
        }
    }
}

/// The slope at 0 of a trigonometric polynomial of degree n, from its values f(t) (M. Riesz 1914): with
/// t_j = (2j - 1) pi / 2n, sum over j = 1..2n of (-1)^(j+1) f(t_j) / (4n sin²(t_j / 2)).
fn slope(degree: usize, f: impl Fn(f64) -> f64) -> f64 {
    let term = |j: usize| {
        let t = (2 * j - 1) as f64 * PI / (2 * degree) as f64;
        let sign = if j.is_multiple_of(2) { -1.0 } else { 1.0 };
        sign * f(t) / ((4 * degree) as f64 * (0.5 * t).sin().powi(2))
    };
    (1..=2 * degree).map(term).sum()
}

/// Along a great circle an expansion of degree L is a trigonometric polynomial.
#[test]
fn derivatives_at_the_highest_degree_are_those_along_great_circles() {
    let degree = Whole::MAX_DEGREE;
    let grain = whole(degree, plain());
    for n in places().into_iter().step_by(20) {
        let found = grain.derivatives(&n);
        for tangent in tangents(&n) {
            let first = slope(degree, |t| grain.radius(&towards(&n, &tangent, t)));
            let off = first - found.gradient.dot(&tangent);
            assert!(off.abs() < 1e-11 * RADIUS, "{n} {off}");
            let second = slope(degree, |t| {
                let along = tangent * t.cos() - n * t.sin();
                let (_, gradient) = grain.radius_and_gradient(&towards(&n, &tangent, t));
                gradient.dot(&along)
            });
            let off = second - tangent.dot(&(found.hessian * tangent));
            assert!(off.abs() < 1e-9 * RADIUS, "{n} {off}");
        }
    }
}

/// One segment is the whole sphere, in another basis.
#[test]
fn one_segment_and_its_harmonics_are_the_same_grain() {
    let segment = segmented(1, turned());
    let [published] = &segment.published()[..] else {
        panic!("one expansion");
    };
    let surface = Whole::new(published.coefficients.clone()).expect("sound");
    let grain = StarGrain::new(turned(), Family::Whole(surface)).expect("a frame");
    for n in anywhere(300) {
        let (found, want) = (grain.derivatives(&n), segment.derivatives(&n));
        assert!((found.radius - want.radius).abs() < 1e-12 * RADIUS);
        assert!((found.gradient - want.gradient).norm() < 1e-12 * RADIUS);
        assert!((found.hessian - want.hessian).norm() < 1e-11 * RADIUS);
    }
    let [found, want] = [&grain, &segment].map(|grain| grain_properties(grain).properties);
    assert!((found.volume / want.volume - 1.0).abs() < 1e-13);
    assert!((found.inertia - want.inertia).norm() < 1e-12 * want.inertia.norm());
    assert!((found.centroid - want.centroid).norm() < 1e-13 * RADIUS);
    assert!((found.area / want.area - 1.0).abs() < 1e-9);
    assert_eq!(grain.coefficient_count(), segment.coefficient_count());
    assert_eq!(grain.coefficients_touched(), segment.coefficients_touched());
    assert_eq!((grain.segments(), grain.seam_jump()), (1, 0.0));
}

#[test]
fn integrals_are_those_of_other_rules() {
    for degree in [0, 3, 12] {
        let grain = whole(degree, turned());
        integrals::check(&grain, 1e-6);
        let found = grain_properties(&grain);
        assert!(found.relative_error < 1e-9);
        let other = integrate(&grain, 1e-11);
        let (have, want) = (found.properties, other.properties);
        assert!((found.mean_radius / other.mean_radius - 1.0).abs() < 1e-12);
        assert!((have.area / want.area - 1.0).abs() < 1e-9);
        assert!((have.volume / want.volume - 1.0).abs() < 1e-12);
        assert!((have.inertia - want.inertia).norm() < 1e-11 * want.inertia.norm());
    }
}

#[test]
fn every_measure_can_be_had_and_agrees_with_that_of_the_segment() {
    let segment = segmented(1, turned());
    let surface = Whole::new(segment.published()[0].coefficients.clone()).expect("sound");
    let factors = Stretch::new(Vector3::new(0.8, 1.0, 1.4)).expect("factors");
    let surfaces = [Family::Whole(surface), segment.family().clone()];
    let [found, want] = surfaces.map(|surface| {
        let grain = StarGrain::stretched(turned(), factors, surface).expect("a frame");
        let general = grain.clone().into();
        let survey = Survey::of_grain(&general, Scheme::Exact);
        let only = Measure::ALL;
        let report = MeasureReport::new(String::new(), Measured::Model, &survey, &only, Vec::new());
        assert_eq!(report.not_measured, []);
        let curvature = survey.curvature().expect("a formula");
        assert!(curvature.gauss_bonnet_error().abs() < 1e-8);
        let mesh = mesh_properties(&grain.mesh(128)).expect("closed");
        let properties = survey.properties().expect("a solid");
        assert!((mesh.volume / properties.volume - 1.0).abs() < 2e-4);
        (
            survey.angularity().expect("a solid"),
            survey.spectrum().expect("a star shape"),
            curvature.mean().mean,
            survey.dimensions().expect("a solid"),
        )
    });
    assert!((found.0 / want.0 - 1.0).abs() < 1e-3, "{found:?} {want:?}");
    assert!((found.2 / want.2 - 1.0).abs() < 1e-8);
    assert!((found.3 - want.3).norm() < 1e-9 * RADIUS);
    // The nodes of the segment do not resolve higher degrees so well.
    for (found, want) in found.1.power.iter().zip(&want.1.power).take(15) {
        assert!(
            (found - want).abs() < 1e-6 * RADIUS * RADIUS,
            "{found} {want}"
        );
    }
}

#[test]
fn the_coefficients_are_published_as_they_are() {
    let grain = whole(6, turned());
    let published = grain.published();
    assert_eq!(published.len(), 1);
    assert_eq!(published[0].coefficients, grain.coefficients()[0]);
    assert_eq!(published[0].loss, 0.0);
    assert!(matches!(published[0].region, Region::Rectangle(_)));
}

#[test]
fn coefficients_that_make_no_expansion_are_refused() {
    let mut next = numbers(1);
    let mut list = |count: usize| (0..count).map(|_| next()).collect::<Vec<f64>>();
    let highest = Whole::MAX_DEGREE + 1;
    for (count, is_sound) in [
        (0, false),
        (1, true),
        (5, false),
        (highest * highest, true),
        (highest * highest + 1, false),
    ] {
        assert_eq!(Whole::new(list(count)).is_ok(), is_sound, "{count}");
    }
    let found = Whole::new(list((highest + 1) * (highest + 1)));
    assert!(matches!(found, Err(InvalidGrain::Degree { found }) if found == highest));
    assert!(Whole::new(vec![1.0, 2.0, f64::NAN, 0.0]).is_err());
}
