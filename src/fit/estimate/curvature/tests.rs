use super::*;
use crate::fit::context::Context;
use crate::fit::{FitOptions, Fitted, PreparedScan};
use crate::measure::{Scheme, Survey};
use crate::model::Radial;
use crate::scan::Scan;
use crate::shapes::{Body, Sampling, SynthOptions, synthesize};
use crate::sphere::Symmetry;
use nalgebra::Point3;
use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, StandardNormal};

fn fitted(body: Body, noise: f64, points: usize, seed: u64) -> Fitted {
    let options = SynthOptions {
        sampling: Sampling::Fibonacci,
        points,
        noise,
        seed,
        ..SynthOptions::clean(body)
    };
    let scan = Scan {
        points: synthesize(&options).unwrap().points,
        ..Scan::default()
    };
    let prepared = PreparedScan::new(&scan, Symmetry::NONE).unwrap();
    prepared
        .fit(&FitOptions::default(), &Context::default())
        .unwrap()
}

/// Share of directions in which both principal curvatures are within two errors, and the root mean square of the
/// larger deviation in errors.
fn coverage(body: Body, fitted: &Fitted) -> (f64, f64) {
    let truth = body.surface();
    let grain = fitted.grain_with_errors();
    let directions = Sampling::Random.directions(2000, 5).unwrap();
    let deviations: Vec<f64> = directions
        .iter()
        .map(|n| {
            let fit = Curvature::new(n, &grain.jet(n));
            // The origin of the closed form is not the grain's: the place, then its direction there.
            let place = grain.point(n).coords.normalize();
            let exact = Curvature::new(&place, &Radial(truth.as_ref()).jet(&place));
            let off = |i: usize| (fit.principal[i] - exact.principal[i]).abs();
            off(0).max(off(1)) / grain.local_error(n).unwrap().curvature
        })
        .collect();
    let count = deviations.len() as f64;
    let within = deviations.iter().filter(|z| **z < 2.0).count() as f64;
    let squares: f64 = deviations.iter().map(|z| z.min(10.0).powi(2)).sum();
    (within / count, (squares / count).sqrt())
}

/// Points with normal noise in all directions.
fn moved(points: Vec<Point3<f64>>, noise: f64, seed: u64) -> Vec<Point3<f64>> {
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    let mut normal = || -> f64 { StandardNormal.sample(&mut random) };
    let off = |p: Point3<f64>| p + Vector3::from_fn(|_, _| noise * normal());
    points.into_iter().map(off).collect()
}

#[test]
fn errors_of_curvature_cover_and_are_not_too_wide() {
    for body in [Body::Bean, Body::Chickpea, Body::Maize] {
        for (points, noise) in [(1538, 0.0), (1538, 0.005), (6146, 0.0), (6146, 0.005)] {
            let fitted = fitted(body, noise, points, 3);
            let (share, rms) = coverage(body, &fitted);
            assert!(share > 0.94, "{body} {points} {noise}: {share}");
            assert!((0.35..1.3).contains(&rms), "{body} {points} {noise}: {rms}");
        }
    }
}

#[test]
fn what_cells_leave_out_is_in_the_errors_of_places_everywhere() {
    for body in [Body::Bean, Body::Maize] {
        let fitted = fitted(body, 0.0, 6146, 3);
        let truth = body.surface();
        let grain = fitted.grain_with_errors();
        let directions = Sampling::Random.directions(2000, 5).unwrap();
        let deviation = |n: &Vector3<f64>| {
            let place = grain.point(n).coords;
            let exact = place.normalize() * truth.radius(&place.normalize());
            let normal = Curvature::new(n, &grain.jet(n)).normal;
            let off = normal.dot(&(place - exact));
            off.abs() / grain.local_error(n).unwrap().place
        };
        let deviations: Vec<f64> = directions.iter().map(deviation).collect();
        let most = deviations.iter().copied().fold(0.0, f64::max);
        let squares: f64 = deviations.iter().map(|z| z * z).sum();
        let rms = (squares / deviations.len() as f64).sqrt();
        assert!(most < 3.0, "{body}: {most}");
        assert!((0.5..1.0).contains(&rms), "{body}: {rms}");
    }
}

#[test]
fn errors_of_places_and_of_curvature_cover_on_the_tips_of_a_needle() {
    let axes = Vector3::new(1.0, 1.0, 10.0);
    for (noise, seed) in [(0.0, 1), (0.01, 1), (0.01, 2)] {
        let places = Sampling::Fibonacci.directions(6000, 0).unwrap();
        let places = places.iter().map(|n| n.component_mul(&axes).into());
        let scan = Scan::from_points(moved(places.collect(), noise, seed));
        let grain = crate::fit(&scan, &FitOptions::default())
            .unwrap()
            .grain_with_errors();
        let frame = grain.frame();
        for tip in [Vector3::z(), -Vector3::z()] {
            let n = tip * 10.0 - frame.centre.coords;
            let error = grain.local_error(&n).unwrap();
            let off = (grain.point(&n).z.abs() - 10.0).abs();
            assert!(off < 2.5 * error.place, "{noise}: {off} {error:?}");
            assert!(error.place < 0.3, "{noise}: {error:?}");
            let found = Curvature::new(&n.normalize(), &grain.jet(&n)).principal;
            let off = (found[0] - 10.0).abs().max((found[1] - 10.0).abs());
            assert!(off < 2.5 * error.curvature, "{noise}: {off} {error:?}");
            assert!(error.curvature < 5.0, "{noise}: {error:?}");
        }
    }
}

/// A drop that is pointed at its top, where it is bent by 1.4/(0.9 w)² across x: its place over the sphere.
fn drop(n: &Vector3<f64>) -> Vector3<f64> {
    let width = 0.55 * (1.0 - 0.55 * n.z) * (1.0 + 0.25 * n.z * n.z);
    Vector3::new(n.x * width, 0.9 * n.y * width, 1.4 * n.z)
}

#[test]
fn the_sharpness_that_noise_takes_from_a_tip_is_in_its_error() {
    let width = 0.55 * 0.45 * 1.25;
    let exact = 1.4 / (0.9 * width * 0.9 * width);
    let directions = Sampling::Fibonacci.directions(1538, 0).unwrap();
    let deviations = [1, 2, 3].map(|seed| {
        let points = directions.iter().map(|n| drop(n).into()).collect();
        let scan = Scan::from_points(moved(points, 0.002, seed));
        let fitted = crate::fit(&scan, &FitOptions::default()).unwrap();
        let grain = fitted.grain_with_errors();
        let survey = Survey::of_grain(&grain, Scheme::Exact);
        let told = survey.curvature().unwrap().larger().largest;
        let error = survey.curvature_errors().unwrap().unwrap().larger.largest;
        assert!(error < 0.25 * told, "{told} {error}");
        (told - exact) / error
    });
    let mean = deviations.iter().sum::<f64>() / 3.0;
    assert!(mean.abs() < 1.6, "{deviations:?}");
}
