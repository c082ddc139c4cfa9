//! The fits of segments against the same least squares in extended precision.

mod clouds;
mod extended;
mod judge;
mod solvers;

use crate::fit::{Fitted, fit};
use crate::scan::Scan;
use crate::shapes::Sampling;
use clouds::{chickpea, even_in_angles};
use extended::{Sample, largest_radius};
use judge::{PROMISE, judge, options, samples_by_segment, segmented};
use nalgebra::{Point3, Vector3};
use solvers::{Basis, Solver, condition, design};

fn fitted(points: Vec<Point3<f64>>, k: usize, degree: usize) -> (Fitted, Vec<Vec<Sample>>) {
    let scan = Scan::from_points(points);
    let fitted = fit(&scan, &options(k, degree)).expect("a grain");
    let segments = samples_by_segment(&fitted, scan.points());
    (fitted, segments)
}

fn assert_promise(points: Vec<Point3<f64>>, k: usize, degree: usize) {
    let (fitted, segments) = fitted(points, k, degree);
    let verdict = judge(fitted.grain.star().expect("a radius"), degree, &segments);
    assert!(
        verdict.error <= PROMISE && !verdict.lowered,
        "k = {k}, L = {degree}: {verdict:?}"
    );
}

#[test]
fn fits_meet_extended_precision_at_every_degree_and_partition() {
    for (k, degree) in [(1, 3), (1, 6), (2, 6), (4, 3), (8, 1), (10, 2)] {
        assert_promise(chickpea(6146, Sampling::Cube), k, degree);
    }
    assert_promise(chickpea(1538, Sampling::Cube), 1, 12);
    for (k, degree) in [(8, 3), (16, 3), (32, 1), (64, 0)] {
        assert_promise(even_in_angles(k, degree), k, degree);
    }
}

#[test]
fn fits_meet_extended_precision_at_every_size_place_and_slenderness() {
    let points = chickpea(6146, Sampling::Fibonacci);
    let changed =
        |change: &dyn Fn(&Point3<f64>) -> Point3<f64>| points.iter().map(change).collect();
    for scale in [1e-9, 1e9] {
        assert_promise(changed(&|p| p * scale), 4, 3);
    }
    assert_promise(changed(&|p| p + Vector3::new(5e7, -2e7, 3e7)), 4, 3);
    let sphere = Sampling::Fibonacci
        .directions(6146, 0)
        .expect("enough points");
    // Of few segments the radius falls below zero, and is refused.
    let needle = sphere.iter().map(|n| Point3::new(n.x, n.y, 6.0 * n.z));
    assert_promise(needle.collect(), 6, 3);
    let mut twice = points.clone();
    twice.extend(&points);
    assert_promise(twice, 4, 3);
}

#[test]
fn segments_of_dense_clouds_are_widened_to_all_samples_of_their_caps() {
    assert_promise(even_in_angles(32, 3), 32, 3);
}

/// The ways to fit a segment that docs/accuracy.md compares.
const WAYS: [(Basis, Solver); 4] = [
    (Basis::Harmonics, Solver::NormalEquations),
    (Basis::Harmonics, Solver::Reflections),
    (Basis::Cap, Solver::NormalEquations),
    (Basis::Cap, Solver::Reflections),
];

/// The worst of k x k segments of degree 3: the conditions of harmonics and cap basis, and the
/// errors of the four ways relative to the segment's largest radius.
fn table_row(k: usize) -> ([f64; 2], [f64; 4]) {
    let degree = 3;
    let (fitted, segments) = fitted(even_in_angles(k, degree), k, degree);
    let partition = segmented(fitted.grain.star().expect("a radius")).partition();
    let (mut conditions, mut errors) = ([0.0_f64; 2], [0.0_f64; 4]);
    for (segment, samples) in segments.iter().enumerate() {
        let cap = partition.cap(segment);
        let exact = extended::fitted_radii(degree, &cap, samples);
        let designs =
            [Basis::Harmonics, Basis::Cap].map(|basis| design(basis, degree, &cap, samples));
        for (worst, design) in conditions.iter_mut().zip(&designs) {
            *worst = worst.max(condition(design));
        }
        for (worst, (basis, solver)) in errors.iter_mut().zip(WAYS) {
            let design = &designs[usize::from(basis == Basis::Cap)];
            let error =
                solvers::fitted_radii(solver, design, samples).map_or(f64::INFINITY, |fitted| {
                    let distances = fitted.iter().zip(&exact).map(|(a, b)| (a - b).abs());
                    distances.fold(0.0, f64::max) / largest_radius(samples)
                });
            *worst = worst.max(error);
        }
    }
    (conditions, errors)
}

/// docs/accuracy.md has these figures, and those of more segments.
#[test]
fn the_plain_harmonics_break_where_the_cap_basis_holds() {
    for (k, conditions, errors) in [
        (1, [2e0, 4e0], [4e-15, 6e-16, 2e-15, 1e-15]),
        (4, [1e6, 2e2], [5e-8, 2e-13, 6e-14, 2e-15]),
        (8, [8e8, 3e2], [f64::INFINITY, 3e-10, 1e-13, 3e-15]),
        (16, [2e11, 9e2], [f64::INFINITY, 7e-8, 4e-13, 3e-15]),
    ] {
        let (found_conditions, found_errors) = table_row(k);
        for (found, told) in found_conditions.iter().zip(conditions) {
            assert!(
                (found / told).ln().abs() < 2.0_f64.ln(),
                "k = {k}: {found_conditions:?}"
            );
        }
        for (&found, told) in found_errors.iter().zip(errors) {
            let alike = found == told || (found / told).ln().abs() < 10.0_f64.ln();
            assert!(alike, "k = {k}: {found_errors:?}");
        }
    }
}
