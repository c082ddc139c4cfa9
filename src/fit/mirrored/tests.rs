use super::*;
use crate::measure::integrate;
use crate::model::StarSurface;
use crate::shapes::{Ellipsoid, Sampling};
use crate::sphere::harmonics;
use faer::linalg::solvers::SolveLstsq;
use std::f64::consts::FRAC_PI_2;

fn oblate() -> Ellipsoid {
    Ellipsoid {
        semi_axes: Vector3::new(2.0, 2.0, 1.0),
    }
}

/// Samples of a surface that is not symmetric, with weights between 0.5 and 1.5.
fn lopsided(points: usize) -> Vec<DirectedSample> {
    let directions = Sampling::Fibonacci.directions(points, 0).expect("points");
    let sample = |n: Vector3<f64>| DirectedSample {
        direction: 2.5 * n,
        radius: 3.0 + 0.4 * n.x + 0.3 * n.y * n.z + 0.2 * (4.0 * n.z).sin(),
        weight: 1.0 + 0.5 * (7.0 * n.y).sin(),
    };
    directions.into_iter().map(sample).collect()
}

#[test]
fn agrees_with_dense_least_squares_in_the_harmonics() {
    let samples = lopsided(700);
    for name in ["none", "x", "yz", "xyz"] {
        let symmetry: Symmetry = name.parse().expect("mirrors");
        let degree = 3;
        let rows: Vec<(Vec<f64>, f64)> = samples
            .iter()
            .map(|sample| {
                let n = symmetry.fold(&sample.direction.normalize());
                (harmonics(degree, &n), sample.weight.sqrt())
            })
            .collect();
        let count = coefficient_count(degree);
        let design = Mat::from_fn(rows.len(), count, |i, j| rows[i].0[j] * rows[i].1);
        let radii = Mat::from_fn(rows.len(), 1, |i, _| samples[i].radius * rows[i].1);
        let expected = design.qr().solve_lstsq(radii);
        let fitted = fit_mirrored(&samples, symmetry, degree).expect("a fit");
        for (sample, (y, _)) in samples.iter().zip(&rows) {
            let want: f64 = y
                .iter()
                .enumerate()
                .map(|(j, y)| y * expected[(j, 0)])
                .sum();
            let have = fitted.radius(&sample.direction.normalize());
            assert!((have - want).abs() < 1e-12, "{name}: {have} {want}");
        }
    }
}

/// The directions of the source's grid q = 1 in one octant, weighted so that the points of the full
/// body count once.
fn octant_grid(n: usize) -> Vec<DirectedSample> {
    let surface = oblate();
    let mut samples = Vec::new();
    for i in 0..=n {
        for j in 0..=(if i == 0 { 0 } else { 16 }) {
            let (st, ct) = (FRAC_PI_2 * i as f64 / n as f64).sin_cos();
            let (sp, cp) = (FRAC_PI_2 * j as f64 / 16.0).sin_cos();
            let direction = Vector3::new(st * cp, st * sp, ct);
            let planes = match (i, j) {
                (0, _) => 2,
                _ => usize::from(i == n) + usize::from(j == 0 || j == 16),
            };
            let weight = 0.5_f64.powi(planes as i32);
            samples.push(DirectedSample::on(&surface, direction, weight));
        }
    }
    samples
}

#[test]
fn degree_one_on_an_octant_gives_the_published_oblate_ellipsoid() {
    // Area and volume by the source's grid of triangles, which reads them low by some 1e-4.
    let published = [
        (4, 33.945, 16.075),
        (8, 34.890, 16.535),
        (16, 35.231, 16.684),
        (32, 35.324, 16.725),
    ];
    for (n, area, volume) in published {
        let fitted = fit_mirrored(&octant_grid(n), Symmetry::OCTANT, 1).expect("a fit");
        assert_eq!(fitted.coefficients().len(), 4);
        let found = integrate(&fitted, 1e-9).properties;
        assert!((0.0..4e-4).contains(&(found.area / area - 1.0)));
        assert!((0.0..4e-4).contains(&(found.volume / volume - 1.0)));
    }
}

#[test]
fn a_weight_counts_like_so_many_samples() {
    let samples = lopsided(300);
    let thrice: Vec<DirectedSample> = samples
        .iter()
        .flat_map(|s| std::iter::repeat_n(DirectedSample { weight: 0.7, ..*s }, 3))
        .collect();
    let heavy: Vec<DirectedSample> = samples
        .iter()
        .map(|s| DirectedSample { weight: 2.1, ..*s })
        .chain([DirectedSample {
            radius: 1e3,
            weight: 0.0,
            ..samples[0]
        }])
        .collect();
    let [a, b] = [thrice, heavy].map(|s| fit_mirrored(&s, Symmetry::OCTANT, 4).expect("a fit"));
    for (a, b) in a.coefficients().iter().zip(b.coefficients()) {
        assert!((a - b).abs() < 1e-12);
    }
}

#[test]
fn too_few_directions_are_met_with_the_least_norm() {
    let three = &lopsided(20)[..3];
    let fitted = fit_mirrored(three, Symmetry::OCTANT, 3).expect("a fit");
    let norm = |list: &[f64]| list.iter().map(|x| x * x).sum::<f64>().sqrt();
    for sample in three {
        let found = fitted.radius(&sample.direction.normalize());
        assert!((found - sample.radius).abs() < 1e-12);
    }
    // The same directions again leave the same coefficients undetermined.
    let repeated = fit_mirrored(&three.repeat(20), Symmetry::OCTANT, 3).expect("a fit");
    for (a, b) in fitted.coefficients().iter().zip(repeated.coefficients()) {
        assert!((a - b).abs() < 1e-12);
    }
    // Any other interpolant, such as the degree 1 with its four numbers, is longer.
    let lower = fit_mirrored(three, Symmetry::OCTANT, 1).expect("a fit");
    assert!(norm(fitted.coefficients()) < norm(lower.coefficients()));
}

#[test]
fn a_surface_of_low_degree_is_met_at_every_degree() {
    for name in ["none", "z", "xy", "xyz"] {
        let symmetry: Symmetry = name.parse().expect("mirrors");
        let truth = fit_mirrored(&lopsided(700), symmetry, 3).expect("a fit");
        let exact: Vec<DirectedSample> = lopsided(6000)
            .into_iter()
            .map(|s| DirectedSample {
                radius: truth.radius(&s.direction.normalize()),
                ..s
            })
            .collect();
        for degree in [3, 8, 14, 20] {
            let fitted = fit_mirrored(&exact, symmetry, degree).expect("a fit");
            let worst = exact
                .iter()
                .map(|s| (fitted.radius(&s.direction.normalize()) - s.radius).abs())
                .fold(0.0, f64::max);
            assert!(worst < 1e-11, "{name} {degree} {worst:e}");
        }
    }
}

#[test]
fn radii_of_any_size_are_fitted() {
    for unit in [1e-300, 1e300] {
        let samples: Vec<DirectedSample> = lopsided(100)
            .into_iter()
            .map(|s| DirectedSample {
                radius: s.radius * unit,
                weight: s.weight * unit,
                ..s
            })
            .collect();
        let fitted = fit_mirrored(&samples, Symmetry::OCTANT, 0).expect("a fit");
        let radius = fitted.radius(&Vector3::x()) / unit;
        assert!((2.0..4.0).contains(&radius), "{radius}");
    }
}

#[test]
fn unsound_samples_are_refused() {
    let fit = |change: fn(&mut DirectedSample)| {
        let mut samples = lopsided(20);
        change(&mut samples[7]);
        fit_mirrored(&samples, Symmetry::OCTANT, 1)
    };
    let is_sample = |error| matches!(error, Err(MirroredFitError::Sample { index: 7 }));
    assert!(is_sample(fit(|s| s.radius = f64::NAN)));
    assert!(is_sample(fit(|s| s.radius = f64::INFINITY)));
    assert!(is_sample(fit(|s| s.direction.y = f64::NAN)));
    assert!(is_sample(fit(|s| s.direction = Vector3::zeros())));
    let is_weight = |error| matches!(error, Err(MirroredFitError::Weight { index: 7, .. }));
    assert!(is_weight(fit(|s| s.weight = -1.0)));
    assert!(is_weight(fit(|s| s.weight = f64::NAN)));
    assert!(is_weight(fit(|s| s.weight = f64::INFINITY)));

    let none = fit_mirrored(&[], Symmetry::OCTANT, 1);
    assert!(matches!(none, Err(MirroredFitError::NoSamples)));
    let mut weightless = lopsided(20);
    weightless.iter_mut().for_each(|s| s.weight = 0.0);
    let none = fit_mirrored(&weightless, Symmetry::OCTANT, 1);
    assert!(matches!(none, Err(MirroredFitError::NoSamples)));
    let high = fit_mirrored(&lopsided(20), Symmetry::OCTANT, MAX_DEGREE + 1);
    assert!(matches!(high, Err(MirroredFitError::Degree { degree }) if degree == MAX_DEGREE + 1));
}
