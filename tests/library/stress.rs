//! Clouds that no scanner should make: a fit ends in a sound grain or in a plain refusal.

use grainform::fit::{FitError, Fitted, Seams};
use grainform::measure::grain_properties;
use grainform::scan::Scan;
use grainform::shapes::{Body, Sampling, SynthOptions, synthesize};
use grainform::sphere::cube_grid;
use grainform::{FitOptions, StarSurface, Surface, Tolerance, fit};
use nalgebra::{Point3, Vector3};
use proptest::prelude::*;

fn try_fit(points: Vec<Point3<f64>>, options: &FitOptions) -> Result<Fitted, FitError> {
    let scan = Scan::from_points(points);
    fit(&scan, options)
}

/// Everything that is told of a grain is finite, and its surface is where the points are.
fn assert_sound(fitted: &Fitted) {
    let search = &fitted.search;
    assert!(search.limit.is_finite() && search.noise.is_none_or(f64::is_finite));
    assert!(fitted.residuals.rms.is_finite() && fitted.residuals.max.is_finite());
    assert!(fitted.reference.area > 0.0 && fitted.reference.volume > 0.0);
    for candidate in &search.candidates {
        for figure in [
            candidate.area_error,
            candidate.volume_error,
            candidate.heldout_rms,
            candidate.estimate_rms,
        ] {
            assert!(figure.is_none_or(f64::is_finite), "{candidate:?}");
        }
    }
    let properties = grain_properties(&fitted.grain).properties;
    assert!(properties.area.is_finite() && properties.volume.is_finite());
    assert!(properties.inertia.iter().all(|x| x.is_finite()));
    for n in cube_grid(6).0 {
        let (radius, gradient) = fitted.grain.star().unwrap().radius_and_gradient(&n);
        assert!(radius.is_finite() && gradient.iter().all(|x| x.is_finite()));
        assert!(
            radius.abs() < 100.0 * fitted.mean_radius,
            "{radius} {}",
            fitted.mean_radius
        );
    }
    fitted.grain.mesh(5).check_closed().expect("closed");
}

fn cloud(body: Body, points: usize, sampling: Sampling) -> Vec<Point3<f64>> {
    let options = SynthOptions::clean(body)
        .with_points(points)
        .with_sampling(sampling);
    synthesize(&options).expect("valid options").points
}

#[test]
fn every_partition_and_degree_gives_a_sound_grain() {
    let points = cloud(Body::Bean, 1538, Sampling::Cube);
    for parts in [1, 2, 3, 5, 8, 13, 21, 34, 64] {
        for degree in [0, 1, 3, 6, 12] {
            let options = FitOptions::default()
                .with_seams(Seams::None)
                .with_degree(degree)
                .with_segments(parts * parts);
            assert_sound(&try_fit(points.clone(), &options).expect("a grain"));
        }
    }
}

#[test]
fn every_blended_cover_and_degree_gives_a_sound_grain() {
    for (body, points, sampling) in [
        (Body::Sphere, 40, Sampling::Fibonacci),
        (Body::Chickpea, 100, Sampling::Random),
        (Body::Maize, 3200, Sampling::Rings),
    ] {
        let points = cloud(body, points, sampling);
        for (segments, degree) in [
            (1, 0),
            (1, 80),
            (6, 0),
            (6, 12),
            (24, 3),
            (54, 1),
            (96, 6),
            (384, 3),
            (1536, 1),
        ] {
            let options = FitOptions::default()
                .with_degree(degree)
                .with_segments(segments);
            match try_fit(points.clone(), &options) {
                Err(FitError::DegreeOfEstimate { asked: 80, reached }) => assert!(reached < 80),
                fitted => assert_sound(&fitted.expect("a grain")),
            }
        }
    }
}

#[test]
fn adaptive_covers_keep_to_the_bounds_asked_for() {
    let points = cloud(Body::Maize, 6146, Sampling::Fibonacci);
    for (max_segments, max_degree) in [(6, 0), (6, 6), (9, 3), (30, 1), (100, 2), (600, 8)] {
        let options = FitOptions::default()
            .with_max_segments(max_segments)
            .with_max_degree(max_degree)
            .with_tolerance(Tolerance::OfMeanRadius(1e-4));
        let fitted = try_fit(points.clone(), &options).expect("a grain");
        assert_sound(&fitted);
        assert!(fitted.grain.star().unwrap().segments() <= max_segments);
        assert!(fitted.grain.degree() <= max_degree);
    }
}

#[test]
fn a_handful_of_points_is_enough_or_refused() {
    for points in [4, 5, 6, 7, 8, 9, 12, 20, 40] {
        for sampling in [Sampling::Fibonacci, Sampling::Random] {
            let points = cloud(Body::Sphere, points, sampling);
            match try_fit(points, &FitOptions::default()) {
                Ok(fitted) => assert_sound(&fitted),
                Err(error) => assert!(!error.to_string().is_empty()),
            }
        }
    }
}

#[test]
fn clustered_ringlike_and_one_sided_clouds_do_not_blow_up() {
    let whole = cloud(Body::Chickpea, 3200, Sampling::Fibonacci);
    let keep = |wanted: &dyn Fn(&Point3<f64>) -> bool| -> Vec<_> {
        whole.iter().copied().filter(|p| wanted(p)).collect()
    };
    let clouds = [
        ("upper half", keep(&|p| p.z > 0.0)),
        (
            "one octant missing",
            keep(&|p| !(p.x > 0.0 && p.y > 0.0 && p.z > 0.0)),
        ),
        ("band round the equator", keep(&|p| p.z.abs() < 1.0)),
        ("two caps", keep(&|p| p.z.abs() > 2.5)),
        ("rings", keep(&|p| (p.z * 3.0).rem_euclid(1.0) < 0.1)),
        ("dense on one side", {
            let mut points = keep(&|p| p.x > 0.0);
            points.extend(whole.iter().step_by(40));
            points
        }),
        ("a tight cluster", {
            let mut points: Vec<_> = whole.iter().step_by(6).copied().collect();
            points.extend((0..1500).map(|i| whole[0] + Vector3::repeat(1e-9 * i as f64)));
            points
        }),
    ];
    for (name, points) in clouds {
        match try_fit(points, &FitOptions::default()) {
            Ok(fitted) => assert_sound(&fitted),
            Err(error) => panic!("{name}: {error}"),
        }
    }
}

#[test]
fn flat_and_straight_clouds_are_refused() {
    let whole = cloud(Body::Maize, 2000, Sampling::Random);
    let flat = whole.iter().map(|p| Point3::new(p.x, p.y, 0.0)).collect();
    let straight = whole.iter().map(|p| Point3::new(p.x, 0.0, 0.0)).collect();
    let one = vec![Point3::new(1.0, 2.0, 3.0); 500];
    for points in [flat, straight, one, Vec::new()] {
        assert!(try_fit(points, &FitOptions::default()).is_err());
    }
    let mut broken = whole;
    broken[7].y = f64::NAN;
    assert_eq!(
        try_fit(broken, &FitOptions::default()).map(|_| ()),
        Err(FitError::NotFinite { index: 7 })
    );
}

#[test]
fn a_thin_disc_is_sound() {
    let disc = cloud(Body::Sphere, 3000, Sampling::Fibonacci)
        .into_iter()
        .map(|p| Point3::new(19.637068106241824 * p.x, 51.318728450810646 * p.y, p.z))
        .collect();
    assert_sound(&try_fit(disc, &FitOptions::default()).expect("a grain"));
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(12))]

    #[test]
    fn slender_and_flat_bodies_are_sound(a in 1.0..100.0_f64, b in 1.0..100.0_f64) {
        let points = cloud(Body::Sphere, 3000, Sampling::Fibonacci)
            .into_iter()
            .map(|p| Point3::new(a * p.x, b * p.y, p.z))
            .collect();
        if let Ok(fitted) = try_fit(points, &FitOptions::default()) {
            assert_sound(&fitted);
        }
    }

    #[test]
    fn random_clouds_end_in_a_grain_or_a_refusal(
        points in prop::collection::vec(prop::array::uniform3(-1.0..1.0_f64), 0..120),
    ) {
        let points = points.into_iter().map(Point3::from).collect();
        if let Ok(fitted) = try_fit(points, &FitOptions::default()) {
            assert_sound(&fitted);
        }
    }
}
