//! The fit against the exact truth of closed-form grains.

use grainform::measure::grain_properties;
use grainform::scan::Scan;
use grainform::shapes::{Body, Sampling, SynthOptions, SyntheticScan, synthesize};
use grainform::sphere::cube_grid;
use grainform::{FitOptions, fit};

const GRAINS: [Body; 3] = [Body::Bean, Body::Chickpea, Body::Maize];

fn made(body: Body, sampling: Sampling, noise: f64) -> (Scan, SyntheticScan) {
    let synthetic = synthesize(&SynthOptions {
        sampling,
        noise,
        ..SynthOptions::clean(body)
    })
    .expect("valid options");
    let scan = Scan {
        points: synthetic.points.clone(),
        ..Scan::default()
    };
    (scan, synthetic)
}

fn check(noise: f64, area_bound: f64, volume_bound: f64) {
    for body in GRAINS {
        for sampling in Sampling::ALL {
            let (scan, synthetic) = made(body, sampling, noise);
            let fitted = fit(&scan, &FitOptions::default()).expect("a grain");
            let found = grain_properties(&fitted.grain).properties;
            let exact = synthetic.truth.properties;
            let area = found.area / exact.area - 1.0;
            let volume = found.volume / exact.volume - 1.0;
            assert!(area.abs() <= area_bound, "{body} {sampling}: area {area}");
            assert!(
                volume.abs() <= volume_bound,
                "{body} {sampling}: volume {volume}"
            );
            assert!(fitted.search.choice().rejected.is_none());
        }
    }
}

#[test]
fn clean_grains_are_met_within_half_a_percent_of_area_and_a_tenth_of_volume() {
    check(0.0, 0.005, 0.001);
}

#[test]
fn noisy_grains_are_met_within_one_percent_of_area_and_three_tenths_of_volume() {
    check(0.005, 0.01, 0.003);
}

#[test]
fn no_candidate_that_passes_misses_the_true_radius_by_more_than_a_tenth_anywhere() {
    let (directions, _) = cube_grid(24);
    for body in GRAINS {
        for sampling in Sampling::ALL {
            let (scan, _) = made(body, sampling, 0.0);
            let exhaustive = FitOptions {
                exhaustive: true,
                ..FitOptions::default()
            };
            let surface = body.surface();
            let search = fit(&scan, &exhaustive).expect("a grain").search;
            for candidate in search.candidates.iter().filter(|c| c.rejected.is_none()) {
                let options = FitOptions {
                    degree: Some(candidate.degree),
                    segments: Some(candidate.segments),
                    ..FitOptions::default()
                };
                let grain = fit(&scan, &options).expect("a grain").grain;
                for direction in &directions {
                    let point = grain.point(direction).coords;
                    let truth = surface.radius(&point.normalize());
                    let miss = (point.norm() / truth - 1.0).abs();
                    assert!(miss < 0.1, "{body} {sampling} {candidate:?}: {miss}");
                }
            }
        }
    }
}

#[test]
fn skipping_candidates_does_not_change_the_choice() {
    for body in GRAINS {
        for noise in [0.0, 0.005, 0.02] {
            let (scan, _) = made(body, Sampling::Cube, noise);
            let quick = fit(&scan, &FitOptions::default()).expect("a grain");
            let options = FitOptions {
                exhaustive: true,
                ..FitOptions::default()
            };
            let all = fit(&scan, &options).expect("a grain");
            assert_eq!(quick.search.chosen, all.search.chosen, "{body} {noise}");
            assert_eq!(all.search.work.candidates, 40);
            assert_eq!(
                quick.search.work.candidates + quick.search.work.candidates_skipped,
                40
            );
        }
    }
}

#[test]
fn a_sphere_needs_one_coefficient_and_is_exact() {
    let (scan, synthetic) = made(Body::Sphere, Sampling::Fibonacci, 0.0);
    let fitted = fit(&scan, &FitOptions::default()).expect("a grain");
    assert_eq!(fitted.grain.coefficient_count(), 1);
    let found = grain_properties(&fitted.grain).properties;
    assert!((found.volume / synthetic.truth.properties.volume - 1.0).abs() < 1e-5);
    assert!(fitted.residuals.max < 1e-4);
}

#[test]
fn a_missing_cap_is_told_of_and_bridged() {
    for body in GRAINS {
        let synthetic = synthesize(&SynthOptions {
            missing_cap: 25.0,
            ..SynthOptions::clean(body)
        })
        .expect("valid options");
        let scan = Scan {
            points: synthetic.points,
            ..Scan::default()
        };
        let fitted = fit(&scan, &FitOptions::default()).expect("a grain");
        assert!(
            fitted.warnings.iter().any(|w| w.contains("is a guess")),
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
    let synthetic = synthesize(&SynthOptions {
        sampling: Sampling::Fibonacci,
        outliers: 0.01,
        ..SynthOptions::clean(Body::Maize)
    })
    .expect("valid options");
    let moved = synthetic
        .points
        .iter()
        .zip(&clean.points)
        .filter(|(a, b)| a != b)
        .count();
    let scan = Scan {
        points: synthetic.points,
        ..Scan::default()
    };
    let fitted = fit(&scan, &FitOptions::default()).expect("a grain");
    assert!(
        fitted.warnings[0].starts_with(&moved.to_string()),
        "{moved} {:?}",
        fitted.warnings
    );
    let found = grain_properties(&fitted.grain).properties;
    assert!((found.volume / synthetic.truth.properties.volume - 1.0).abs() < 0.001);
}
