//! The fit against the exact truth of closed-form grains.

use grainform::fit::FitWarning;
use grainform::measure::grain_properties;
use grainform::scan::Scan;
use grainform::shapes::{Body, Sampling, SynthOptions, SyntheticScan, synthesize};
use grainform::sphere::cube_grid;
use grainform::{FitOptions, Fitted, Seams, StarSurface, Surface, Tolerance, fit};

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

/// Errors that a fit may have: of the area and the volume, relative, the root mean square of
/// the radius as a share of the mean radius, and the largest of the radius as a share of it.
struct Bounds {
    area: f64,
    volume: f64,
    rms: f64,
    largest: f64,
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
            let largest = largest_miss(&fitted, body);
            let what = format!(
                "{body} {sampling} {noise}: area {area}, volume {volume}, RMS {rms}, {largest}"
            );
            println!("{what}");
            assert!(area.abs() <= bounds.area, "{what}");
            assert!(volume.abs() <= bounds.volume, "{what}");
            assert!(rms <= bounds.rms, "{what}");
            assert!(largest <= bounds.largest, "{what}");
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
    // Measured: 3.1e-5, 3.0e-6, 4.5e-4 of the 5e-4 asked for, and 4.3e-3 at the beak of the chickpea.
    let bounds = Bounds {
        area: 5e-5,
        volume: 5e-6,
        rms: 5e-4,
        largest: 6e-3,
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
        largest: 1.0,
    };
    let few = Bounds {
        area: 1e-3,
        volume: 1.2e-3,
        rms: 2.5e-3,
        largest: 1.0,
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
            largest: 1.0,
        };
        check(&independent(), &GRAINS, noise, &bounds);
    }
}

/// The most by which a fit misses the true radius anywhere, as a share of it.
fn largest_miss(fitted: &Fitted, body: Body) -> f64 {
    let (directions, _) = cube_grid(24);
    let surface = body.surface();
    let miss = |direction| {
        let point = fitted.grain.point(direction).coords;
        (point.norm() / surface.radius(&point.normalize()) - 1.0).abs()
    };
    directions.iter().map(miss).fold(0.0, f64::max)
}

#[test]
fn no_candidate_that_passes_misses_the_true_radius_by_more_than_a_tenth_anywhere() {
    for body in GRAINS {
        for sampling in [Sampling::Random, Sampling::Rings] {
            let (scan, _) = made(body, sampling, 0.0);
            let exhaustive = independent().with_exhaustive(true);
            let search = fit(&scan, &exhaustive).expect("a grain").search;
            for candidate in search.candidates.iter().filter(|c| c.rejected.is_none()) {
                let options = independent()
                    .with_degree(candidate.degree)
                    .with_segments(candidate.segments);
                let fitted = fit(&scan, &options).expect("a grain");
                let miss = match fitted.search.choice().rejected {
                    Some(_) => 0.0,
                    None => largest_miss(&fitted, body),
                };
                assert!(miss < 0.1, "{body} {sampling} {options:?}: {miss}");
            }
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
        for noise in [0.0, 0.02] {
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
            matches!(fitted.warnings[..], [FitWarning::Gap { .. }]),
            "{:?}",
            fitted.warnings
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
    let left_out: usize = fitted.warnings.iter().map(left_out).sum();
    assert_eq!(left_out, moved, "{:?}", fitted.warnings);
    let found = grain_properties(&fitted.grain).properties;
    assert!((found.volume / synthetic.truth.properties.volume - 1.0).abs() < 0.001);
}
