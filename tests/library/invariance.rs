//! What a fit must not depend on.

use grainform::measure::grain_properties;
use grainform::scan::Scan;
use grainform::shapes::{Body, Sampling, SynthOptions, synthesize};
use grainform::{FitOptions, Fitted, Seams, Surface, Tolerance, fit};
use nalgebra::{Point3, Rotation3, Vector3};
use proptest::prelude::*;
use std::sync::OnceLock;

fn points() -> &'static [Point3<f64>] {
    static POINTS: OnceLock<Vec<Point3<f64>>> = OnceLock::new();
    POINTS.get_or_init(|| {
        let options = SynthOptions::clean(Body::Maize)
            .with_points(3000)
            .with_sampling(Sampling::Random)
            .with_noise(0.002);
        synthesize(&options).expect("valid options").points
    })
}

/// Blended by default, and the independent segments.
const BOTH: [Seams; 2] = [Seams::Blended, Seams::None];

fn fitted(seams: Seams, points: Vec<Point3<f64>>) -> Fitted {
    let options = match seams {
        Seams::Blended => FitOptions::default(),
        Seams::None => FitOptions::default()
            .with_seams(seams)
            .with_tolerance(Tolerance::OfMeanRadius(0.003)),
    };
    let scan = Scan::from_points(points);
    fit(&scan, &options).expect("a grain")
}

fn original(seams: Seams) -> &'static Fitted {
    static FITTED: [OnceLock<Fitted>; 2] = [OnceLock::new(), OnceLock::new()];
    FITTED[seams as usize].get_or_init(|| fitted(seams, points().to_vec()))
}

/// Compares everything that has no direction and no position.
fn assert_same(a: &Fitted, b: &Fitted, scale: f64) {
    assert_eq!(a.search.chosen, b.search.chosen);
    assert_eq!(a.points, b.points);
    // Errors of an exact fit are rounding: they need not agree.
    let nothing = 1e-12 * a.mean_radius;
    let close = |a: f64, b: f64| assert!((a - b).abs() < 1e-9 * b.abs() + nothing, "{a} {b}");
    let (pa, pb) = (
        grain_properties(&a.grain).properties,
        grain_properties(&b.grain).properties,
    );
    close(pa.area, pb.area * scale * scale);
    close(pa.volume, pb.volume * scale.powi(3));
    close(pa.inertia.trace(), pb.inertia.trace() * scale.powi(5));
    close(a.residuals.rms, b.residuals.rms * scale);
    close(a.residuals.max, b.residuals.max * scale);
    close(
        a.grain.star().unwrap().seam_jump(),
        b.grain.star().unwrap().seam_jump() * scale,
    );
    for (a, b) in a.search.candidates.iter().zip(&b.search.candidates) {
        if let (Some(a), Some(b)) = (a.heldout_rms, b.heldout_rms) {
            close(a, b * scale);
        }
    }
    assert_eq!(
        a.grain.star().unwrap().segments(),
        b.grain.star().unwrap().segments()
    );
    for (a, b) in a
        .grain
        .star()
        .unwrap()
        .coefficients()
        .iter()
        .zip(b.grain.star().unwrap().coefficients())
    {
        assert_eq!(a.len(), b.len());
        let largest = a[0].abs();
        for (a, b) in a.iter().zip(b) {
            assert!((a - b * scale).abs() < 1e-9 * largest, "{a} {b}");
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(4))]

    #[test]
    fn a_fit_does_not_depend_on_where_the_scan_lies(
        x in -1e4..1e4_f64, y in -1e4..1e4_f64, z in -1e4..1e4_f64,
    ) {
        // Ten thousand millimetres off, the coordinates themselves keep 1e-12 of a millimetre.
        let offset = Vector3::new(x, y, z);
        for seams in BOTH {
            let moved = fitted(seams, points().iter().map(|p| p + offset).collect());
            let original = original(seams);
            assert_same(&moved, original, 1.0);
            let n = Vector3::new(0.6, 0.0, 0.8);
            prop_assert!((moved.grain.point(&n) - original.grain.point(&n) - offset).norm() < 1e-8);
        }
    }

    #[test]
    fn a_fit_does_not_depend_on_how_the_scan_is_turned(
        a in -3.0..3.0_f64, b in -3.0..3.0_f64, c in -3.0..3.0_f64,
    ) {
        let turn = Rotation3::new(Vector3::new(a, b, c));
        for seams in BOTH {
            let turned = fitted(seams, points().iter().map(|p| turn * p).collect());
            let original = original(seams);
            assert_same(&turned, original, 1.0);
            let n = Vector3::new(0.6, 0.0, 0.8);
            let (have, want) = (turned.grain.point(&(turn * n)), turn * original.grain.point(&n));
            prop_assert!((have - want).norm() < 1e-8);
        }
    }

    #[test]
    fn a_fit_does_not_depend_on_the_order_of_the_points(seed in any::<u64>()) {
        let mut shuffled = points().to_vec();
        let mut state = seed | 1;
        for i in (1..shuffled.len()).rev() {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
            shuffled.swap(i, (state >> 33) as usize % (i + 1));
        }
        for seams in BOTH {
            assert_same(&fitted(seams, shuffled.clone()), original(seams), 1.0);
        }
    }

    #[test]
    fn a_fit_scales_with_the_unit(exponent in -9.0..9.0_f64) {
        let scale = 10.0_f64.powf(exponent);
        for seams in BOTH {
            let scaled = fitted(seams, points().iter().map(|p| p * scale).collect());
            assert_same(&scaled, original(seams), scale);
        }
    }
}

#[test]
fn points_given_twice_count_once() {
    let twice: Vec<_> = points().iter().chain(points()).copied().collect();
    for seams in BOTH {
        assert_same(&fitted(seams, twice.clone()), original(seams), 1.0);
    }
}

#[test]
fn the_number_of_threads_does_not_change_a_bit() {
    let on = |threads: usize, seams: Seams| {
        let pool = rayon::ThreadPoolBuilder::new()
            .num_threads(threads)
            .build()
            .expect("a pool");
        pool.install(|| fitted(seams, points().to_vec()))
    };
    for seams in BOTH {
        let (one, four) = (on(1, seams), on(4, seams));
        assert_eq!(one.search, four.search);
        assert_eq!(one.residuals, four.residuals);
        assert_eq!(
            one.grain.star().unwrap().coefficients(),
            four.grain.star().unwrap().coefficients()
        );
    }
}

#[test]
fn a_symmetric_body_is_fitted_alike_wherever_it_lies() {
    // Points on the symmetry planes lie on the borders of segments, up to rounding.
    for (body, seams) in [Body::Bean, Body::Sphere]
        .into_iter()
        .flat_map(|body| BOTH.map(|seams| (body, seams)))
    {
        let made = synthesize(&SynthOptions::clean(body))
            .expect("valid options")
            .points;
        let still = fitted(seams, made.clone());
        let moved = fitted(
            seams,
            made.iter()
                .map(|p| p + Vector3::new(3.3, -7.7, 1.1))
                .collect(),
        );
        assert_same(&moved, &still, 1.0);
    }
}

#[test]
fn a_dense_cloud_is_fitted_alike_in_any_order() {
    let options = SynthOptions::clean(Body::Bean)
        .with_points(60_000)
        .with_noise(0.002);
    let made = synthesize(&options).expect("valid options").points;
    for seams in BOTH {
        let forward = fitted(seams, made.clone());
        let backward = fitted(seams, made.iter().rev().copied().collect());
        assert_same(&backward, &forward, 1.0);
    }
}

#[test]
fn sizes_whose_volumes_cannot_be_written_are_refused() {
    for scale in [1e-104, 1e103] {
        let scan = Scan::from_points(points().iter().map(|p| p * scale).collect());
        let error = fit(&scan, &FitOptions::default()).expect_err("out of scale");
        assert!(error.to_string().contains("scale the scan"), "{error}");
    }
}
