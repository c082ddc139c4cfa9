//! What a fit is given beside its data: threads, a way to stop it, and somebody to tell; and what it
//! refuses.

use grainform::fit::{Context, FitError, FitWarning, PreparedScan, Stage};
use grainform::scan::Scan;
use grainform::shapes::{Body, Sampling, SynthOptions, synthesize};
use grainform::sphere::Symmetry;
use grainform::{FitOptions, Fitted, Seams, StarSurface, Surface, Tolerance, fit, model};
use nalgebra::{Point3, Vector3};
use std::sync::Mutex;
use std::sync::atomic::{AtomicBool, Ordering};

fn maize() -> Scan {
    let options = SynthOptions::clean(Body::Maize)
        .with_points(3000)
        .with_sampling(Sampling::Fibonacci)
        .with_noise(0.002);
    Scan::from_points(synthesize(&options).expect("valid options").points)
}

/// Of every family, and the mirror planes to prepare for.
fn families() -> [FitOptions; 4] {
    let default = FitOptions::default();
    [
        default.clone(),
        default.clone().with_segments(1),
        default.clone().with_seams(Seams::None),
        default.with_symmetry("y".parse().expect("an axis")),
    ]
}

fn fitted(scan: &Scan, options: &FitOptions, context: &Context<'_>) -> Result<Fitted, FitError> {
    PreparedScan::new(scan, options.symmetry)?.fit(options, context)
}

#[test]
fn a_fit_that_is_cancelled_ends_with_an_error_at_the_next_stage() {
    let scan = maize();
    for options in families() {
        let cancel = AtomicBool::new(true);
        let context = Context {
            cancel: Some(&cancel),
            ..Context::default()
        };
        let ended = fitted(&scan, &options, &context);
        assert_eq!(ended.map(|_| ()), Err(FitError::Cancelled));

        // While it runs: after the stage it has begun.
        cancel.store(false, Ordering::Relaxed);
        let begun = Mutex::new(0);
        let stop = |_: Stage| {
            *begun.lock().expect("no panic") += 1;
            cancel.store(true, Ordering::Relaxed);
        };
        let context = Context {
            progress: Some(&stop),
            ..context
        };
        let ended = fitted(&scan, &options, &context);
        assert_eq!(*begun.lock().expect("no panic"), 1);
        // The estimate looks at the flag between its rounds, whatever comes after it.
        let is_estimated = options.symmetry == Symmetry::NONE && options.seams == Seams::Blended;
        let has_more_stages = is_estimated || options.segments.is_none();
        assert_eq!(
            ended.is_err(),
            has_more_stages && options.symmetry == Symmetry::NONE
        );
    }
}

#[test]
fn progress_is_told_every_stage_in_order() {
    let scan = maize();
    let stages = |options: &FitOptions| {
        let stages = Mutex::new(Vec::new());
        let tell = |stage: Stage| stages.lock().expect("no panic").push(stage);
        let context = Context {
            progress: Some(&tell),
            ..Context::default()
        };
        fitted(&scan, options, &context).expect("a grain");
        stages.into_inner().expect("no panic")
    };
    let [cells, whole, segments, mirrored] = families().map(|options| stages(&options));
    let searching = |done: usize, all: Option<usize>| Stage::Searching { done, all };
    assert_eq!(cells, [Stage::Estimating, searching(0, None)]);
    assert_eq!(whole, [Stage::Estimating]);
    let levels: Vec<Stage> = (0..10).map(|done| searching(done, Some(10))).collect();
    assert_eq!(segments, levels);
    assert_eq!(mirrored, [searching(0, None)]);
}

#[test]
fn threads_of_ones_own_give_the_same_bits() {
    let scan = maize();
    let pools = [1, 3].map(|threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads);
        pool.build().expect("a pool")
    });
    for options in families() {
        let plain = fitted(&scan, &options, &Context::default()).expect("a grain");
        for pool in &pools {
            let context = Context {
                threads: Some(pool),
                ..Context::default()
            };
            let own = fitted(&scan, &options, &context).expect("a grain");
            assert_eq!(own.search, plain.search);
            assert_eq!(own.residuals, plain.residuals);
            assert_eq!(
                own.grain.star().unwrap().coefficients(),
                plain.grain.star().unwrap().coefficients()
            );
        }
    }
}

#[test]
fn a_scan_prepared_for_other_mirrors_is_refused() {
    let scan = maize();
    let [default, _, segments, mirrored] = families();
    let prepared = PreparedScan::new(&scan, mirrored.symmetry).expect("a grain");
    for options in [default, segments] {
        let refused = prepared.fit(&options, &Context::default());
        assert_eq!(refused.map(|_| ()), Err(FitError::OtherSymmetry));
    }
    prepared
        .fit(&mirrored, &Context::default())
        .expect("prepared for these");
}

#[test]
fn degrees_out_of_range_are_refused_and_bounds_are_kept() {
    let scan = maize();
    let bound = |segments: Option<usize>, degree: Option<usize>, max_degree: Option<usize>| {
        let options = FitOptions::default()
            .with_segments(segments)
            .with_degree(degree)
            .with_max_degree(max_degree)
            .with_tolerance(Tolerance::OfMeanRadius(1e-3));
        fit(&scan, &options)
    };
    for (segments, degree, largest) in [(None, 21, 20), (Some(24), 21, 20), (Some(1), 81, 80)] {
        let refused = FitError::OutOfRange {
            setting: "the degree",
            value: degree,
            least: 0,
            most: largest,
        };
        let found = bound(segments, Some(degree), None).map(|_| ());
        assert_eq!(found, Err(refused.clone()));
        assert_eq!(
            bound(segments, None, Some(degree)).map(|_| ()),
            Err(refused)
        );
    }
    for segments in [None, Some(24), Some(1)] {
        for most in [1, 3, 6] {
            let fitted = bound(segments, None, Some(most)).expect("a grain");
            assert!(fitted.grain.degree() <= most, "{segments:?} {most}");
        }
        let fitted = bound(segments, Some(5), None).expect("a grain");
        assert_eq!(fitted.grain.degree(), 5);
    }
}

#[test]
fn warnings_are_data_and_sentences() {
    let scan = maize();
    let most = scan.points().len();
    let half = Scan::from_points(
        scan.points()
            .iter()
            .filter(|p| p.z > -0.5)
            .copied()
            .collect(),
    );
    let found = fit(&half, &FitOptions::default()).expect("half a grain");
    let gap = |warning: &FitWarning| match *warning {
        FitWarning::Gap {
            half_angle,
            direction,
        } => Some((half_angle, direction)),
        _ => None,
    };
    let (half_angle, direction) = found.warnings().iter().find_map(gap).expect("a gap");
    assert!(
        (0.8..1.6).contains(&half_angle) && direction.z < -0.9,
        "{direction}"
    );
    let sentence = found.warnings()[0].to_string();
    assert!(sentence.starts_with("No point lies within "), "{sentence}");

    // One that stands alone, and one too few.
    let mut spiked = scan.points().to_vec();
    spiked[most / 3].coords *= 1.08;
    let spiked = Scan::from_points(spiked);
    let found = fit(&spiked, &FitOptions::default()).expect("a grain");
    assert_eq!(found.warnings(), [FitWarning::Outliers { outliers: 1 }]);
    assert_eq!(found.points, most - 1);
    let sentence = found.warnings()[0].to_string();
    assert!(sentence.starts_with("1 point lies far off"), "{sentence}");

    let options = FitOptions::default()
        .with_max_segments(6)
        .with_max_degree(1);
    let found = fit(&scan, &options).expect("a grain");
    let [FitWarning::LimitNotMet { rms, limit }] = found.warnings()[..] else {
        panic!("{:?}", found.warnings());
    };
    assert!(rms > limit && limit == found.search.limit);
    let sentence = found.warnings()[0].to_string();
    assert!(sentence.contains("more than the limit of") && sentence.contains("--max-segments"));
}

#[test]
fn a_default_fit_reloads_to_the_same_bits() {
    let scan = maize();
    let [cells, whole, ..] = families();
    for options in [cells, whole] {
        let grain = fit(&scan, &options).expect("a grain").grain;
        let again = model::grain_from_json(&model::grain_to_json(&grain)).expect("a model");
        let [again, grain] = [again, grain].map(|grain| grain.star().cloned().expect("a radius"));
        assert_eq!(again.coefficients(), grain.coefficients());
        for n in [
            Vector3::x(),
            Vector3::new(0.6, 0.0, -0.8),
            Vector3::repeat(-1.0).normalize(),
        ] {
            let point: [Point3<f64>; 2] = [again.point(&n), grain.point(&n)];
            assert_eq!(point[0], point[1]);
            assert_eq!(again.radius_and_gradient(&n), grain.radius_and_gradient(&n));
        }
    }
}
