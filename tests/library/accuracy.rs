//! The fit against the exact truth of closed-form grains.

use grainform::fit::FitWarning;
use grainform::measure::grain_properties;
use grainform::scan::Scan;
use grainform::shapes::{Body, Sampling, SynthOptions, SyntheticScan, synthesize};
use grainform::sphere::cube_grid;
use grainform::{FitOptions, Fitted, Seams, StarSurface, Surface, Tolerance, fit};
use nalgebra::{Point3, Vector3};

const GRAINS: [Body; 3] = [Body::Bean, Body::Chickpea, Body::Maize];

fn made(body: Body, sampling: Sampling, noise: f64) -> (Scan, SyntheticScan) {
    let synthetic = synthesize(
        &SynthOptions::clean(body)
            .with_sampling(sampling)
            .with_noise(noise),
    )
    .expect("valid options");
    let scan = Scan::from_points(synthetic.points.clone());
    (scan, synthetic)
}

/// Independent segments, searched to the tolerance that suits them.
fn independent() -> FitOptions {
    FitOptions::default()
        .with_seams(Seams::None)
        .with_tolerance(Tolerance::OfMeanRadius(0.003))
}

/// Points that a warning says were left out.
fn left_out(warning: &FitWarning) -> usize {
    match *warning {
        FitWarning::Strays { strays, .. } => strays,
        FitWarning::Outliers { outliers } => outliers,
        _ => 0,
    }
}

/// Errors that a fit may have: of the area and the volume, relative, and the root mean square of
/// the radius as a share of the mean radius.
struct Bounds {
    area: f64,
    volume: f64,
    rms: f64,
}

fn check(options: &FitOptions, bodies: &[Body], noise: f64, bounds: &Bounds) {
    for &body in bodies {
        for sampling in Sampling::ALL {
            let (scan, synthetic) = made(body, sampling, noise);
            let fitted = fit(&scan, options).expect("a grain");
            let found = grain_properties(&fitted.grain).properties;
            let exact = synthetic.truth.properties;
            let area = found.area / exact.area - 1.0;
            let volume = found.volume / exact.volume - 1.0;
            let rms = distance(&fitted, body) / synthetic.truth.mean_radius;
            let what =
                format!("{body} {sampling} {noise}: area {area}, volume {volume}, RMS {rms}");
            println!("{what}");
            assert!(area.abs() <= bounds.area, "{what}");
            assert!(volume.abs() <= bounds.volume, "{what}");
            assert!(rms <= bounds.rms, "{what}");
            assert!(fitted.search.choice().rejected.is_none(), "{what}");
        }
    }
}

/// Root mean square of the radial distance between the fit and the closed form.
fn distance(fitted: &Fitted, body: Body) -> f64 {
    let surface = body.surface();
    let (directions, _) = cube_grid(30);
    let squares = directions.iter().map(|n| {
        let point = n * surface.radius(n) - fitted.grain.frame().centre.coords;
        (point.norm() - fitted.grain.star().unwrap().radius(&point.normalize())).powi(2)
    });
    (squares.sum::<f64>() / directions.len() as f64).sqrt()
}

#[test]
fn clean_scans_are_met_within_the_tolerance_however_their_points_are_spread() {
    // Measured: 3.1e-5, 3.0e-6, and 4.5e-4 of the 5e-4 asked for.
    let bounds = Bounds {
        area: 5e-5,
        volume: 5e-6,
        rms: 5e-4,
    };
    check(&FitOptions::default(), &GRAINS, 0.0, &bounds);
}

#[test]
fn noisy_grains_are_met_within_a_fraction_of_the_noise() {
    // Measured: 2.7e-4, 1.6e-4 and 1.25e-3; of the bean, with a quarter of the points, 6.5e-4, 8.0e-4
    // and 2.1e-3.
    let many = Bounds {
        area: 4e-4,
        volume: 2.4e-4,
        rms: 1.5e-3,
    };
    let few = Bounds {
        area: 1e-3,
        volume: 1.2e-3,
        rms: 2.5e-3,
    };
    let options = FitOptions::default();
    check(&options, &[Body::Chickpea, Body::Maize], 0.005, &many);
    check(&options, &[Body::Bean], 0.005, &few);
}

#[test]
fn independent_segments_meet_clean_and_noisy_grains() {
    for (noise, area, volume) in [(0.0, 0.005, 0.001), (0.005, 0.01, 0.003)] {
        let bounds = Bounds {
            area,
            volume,
            rms: 0.01,
        };
        check(&independent(), &GRAINS, noise, &bounds);
    }
}

/// Fits with some options; nowhere may the surface miss the true radius by more than a share `most` of it.
fn assert_near_everywhere(
    body: Body,
    sampling: Sampling,
    scan: &Scan,
    options: &FitOptions,
    most: f64,
) {
    let (directions, _) = cube_grid(24);
    let surface = body.surface();
    let fitted = fit(scan, options).expect("a grain");
    if fitted.search.choice().rejected.is_some() {
        return;
    }
    for direction in &directions {
        let point = fitted.grain.point(direction).coords;
        let truth = surface.radius(&point.normalize());
        let miss = (point.norm() / truth - 1.0).abs();
        assert!(miss < most, "{body} {sampling} {options:?}: {miss}");
    }
}

#[test]
fn no_candidate_that_passes_misses_the_true_radius_by_more_than_a_tenth_anywhere() {
    for body in GRAINS {
        for sampling in Sampling::ALL {
            let (scan, _) = made(body, sampling, 0.0);
            let exhaustive = independent().with_exhaustive(true);
            let search = fit(&scan, &exhaustive).expect("a grain").search;
            for candidate in search.candidates.iter().filter(|c| c.rejected.is_none()) {
                let options = independent()
                    .with_degree(candidate.degree)
                    .with_segments(candidate.segments);
                assert_near_everywhere(body, sampling, &scan, &options, 0.1);
            }
        }
    }
}

#[test]
fn default_fits_are_near_everywhere() {
    for body in GRAINS {
        for sampling in Sampling::ALL {
            let (scan, _) = made(body, sampling, 0.0);
            // Measured: .43 % at most, at the beak of the chickpea.
            assert_near_everywhere(body, sampling, &scan, &FitOptions::default(), 0.006);
        }
    }
}

#[test]
fn blended_covers_miss_the_true_radius_by_what_they_tell() {
    for body in GRAINS {
        let (scan, synthetic) = made(body, Sampling::Random, 0.0);
        for (segments, degree) in [(1, 0), (6, 3), (24, 1), (54, 2)] {
            let options = FitOptions::default()
                .with_degree(degree)
                .with_segments(segments);
            let fitted = fit(&scan, &options).expect("a grain");
            let told = fitted.search.choice().heldout_rms.expect("an estimate");
            let missed = distance(&fitted, body);
            let what = format!("{body} {segments} x {degree}: {missed} not {told}");
            // Measured: .92 to 1.00 of what is told.
            let rounding = 2e-5 * synthetic.truth.mean_radius;
            assert!((missed - told).abs() < 0.1 * told + rounding, "{what}");
        }
    }
}

#[test]
fn skipping_candidates_does_not_change_the_choice() {
    for body in GRAINS {
        for noise in [0.0, 0.005, 0.02] {
            let (scan, _) = made(body, Sampling::Cube, noise);
            for options in [FitOptions::default(), independent()] {
                let quick = fit(&scan, &options).expect("a grain");
                let exhaustive = options.with_exhaustive(true);
                let all = fit(&scan, &exhaustive).expect("a grain");
                assert_eq!(quick.search.chosen, all.search.chosen, "{body} {noise}");
                assert_eq!(
                    quick.grain.star().unwrap().coefficients(),
                    all.grain.star().unwrap().coefficients()
                );
                if exhaustive.seams == Seams::None {
                    let work = &quick.search.work;
                    assert_eq!(all.search.work.candidates, 40);
                    assert_eq!(work.candidates + work.candidates_skipped, 40);
                }
            }
        }
    }
}

#[test]
fn a_sphere_needs_one_coefficient_and_is_exact() {
    let (scan, synthetic) = made(Body::Sphere, Sampling::Fibonacci, 0.0);
    for options in [FitOptions::default(), independent()] {
        let fitted = fit(&scan, &options).expect("a grain");
        assert_eq!(fitted.grain.coefficient_count(), 1);
        let found = grain_properties(&fitted.grain).properties;
        assert!((found.volume / synthetic.truth.properties.volume - 1.0).abs() < 1e-5);
        assert!(fitted.residuals.max < 1e-4);
    }
}

#[test]
fn a_missing_cap_is_told_of_and_bridged() {
    for body in GRAINS {
        let synthetic =
            synthesize(&SynthOptions::clean(body).with_missing_cap(25.0)).expect("valid options");
        let scan = Scan::from_points(synthetic.points);
        let fitted = fit(&scan, &FitOptions::default()).expect("a grain");
        assert!(
            matches!(fitted.warnings()[..], [FitWarning::Gap { .. }]),
            "{:?}",
            fitted.warnings()
        );
        let found = grain_properties(&fitted.grain).properties;
        let volume = found.volume / synthetic.truth.properties.volume - 1.0;
        assert!(volume.abs() < 0.02, "{body}: {volume}");
    }
}

#[test]
fn gross_outliers_are_left_out_and_counted() {
    let (_, clean) = made(Body::Maize, Sampling::Fibonacci, 0.0);
    let synthetic = synthesize(
        &SynthOptions::clean(Body::Maize)
            .with_sampling(Sampling::Fibonacci)
            .with_outliers(0.01),
    )
    .expect("valid options");
    let moved = synthetic
        .points
        .iter()
        .zip(&clean.points)
        .filter(|(a, b)| a != b)
        .count();
    let scan = Scan::from_points(synthetic.points);
    let fitted = fit(&scan, &FitOptions::default()).expect("a grain");
    let left_out: usize = fitted.warnings().iter().map(left_out).sum();
    assert_eq!(left_out, moved, "{:?}", fitted.warnings());
    assert_eq!(
        fitted.estimate.map(|estimate| estimate.outliers),
        Some(moved)
    );
    let found = grain_properties(&fitted.grain).properties;
    assert!((found.volume / synthetic.truth.properties.volume - 1.0).abs() < 0.001);
}

/// Bumps make an ellipsoid longest along another axis than that of its least moment of inertia.
#[test]
fn errors_of_length_and_width_go_by_size_and_not_by_moments() {
    let semi_axes = Vector3::new(1.0, 1.06, 1.1);
    let radius = |n: &Vector3<f64>| {
        let bump = 0.07 * (20.0 * (n.y * n.y - 1.0)).exp();
        1.0 / n.component_div(&semi_axes).norm() + bump
    };
    let directions = Sampling::Fibonacci.directions(3000, 0).expect("enough");
    let points = directions.iter().map(|n| Point3::from(n * radius(n)));
    let fitted = fit(&Scan::from_points(points.collect()), &FitOptions::default()).expect("a fit");
    let survey = fitted.survey();
    let dimensions = survey.dimensions().expect("sizes");
    let truth = Vector3::new(2.26, 2.2, 2.0);
    assert!((dimensions - truth).amax() < 2e-3, "{dimensions}");
    let longest = fitted.grain.frame().axes.column(1).y.abs();
    assert!(
        longest > 0.99,
        "the length lies along the second axis: {longest}"
    );
    let errors = fitted.standard_errors(&survey).expect("errors");
    assert!(errors.dimensions.amax() < 5e-3, "{}", errors.dimensions);
}
