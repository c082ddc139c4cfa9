//! The fits of segments against the same least squares in extended precision: the short form of
//! `cargo run --release --example stability`.

mod clouds;
mod extended;
mod judge;
mod solvers;

use clouds::{chickpea, even_in_angles};
use extended::largest_radius;
use grainform::fit;
use grainform::scan::Scan;
use grainform::shapes::Sampling;
use judge::{PROMISE, judge, options, samples_by_segment, segmented};
use nalgebra::{Point3, Vector3};
use solvers::{Basis, Solver, design};

fn assert_promise(points: Vec<Point3<f64>>, k: usize, degree: usize) {
    let scan = Scan::from_points(points);
    let fitted = fit(&scan, &options(k, degree)).expect("a grain");
    let segments = samples_by_segment(&fitted, scan.points());
    let verdict = judge(fitted.grain.star().expect("a radius"), degree, &segments);
    assert!(
        verdict.error <= PROMISE && verdict.lowered == 0,
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

/// The largest distance from extended precision in any segment, relative to its largest radius;
/// infinite if a factorization breaks down.
fn error_of(basis: Basis, solver: Solver, k: usize, degree: usize) -> f64 {
    let scan = Scan::from_points(even_in_angles(k, degree));
    let fitted = fit(&scan, &options(k, degree)).expect("a grain");
    let segments = samples_by_segment(&fitted, scan.points());
    let errors = segments.iter().enumerate().map(|(segment, samples)| {
        let cap = segmented(fitted.grain.star().expect("a radius"))
            .partition()
            .cap(segment);
        let exact = extended::fitted_radii(degree, &cap, samples);
        let design = design(basis, degree, &cap, samples);
        solvers::fitted_radii(solver, &design, samples).map_or(f64::INFINITY, |fitted| {
            let distances = fitted.iter().zip(&exact).map(|(a, b)| (a - b).abs());
            distances.fold(0.0, f64::max) / largest_radius(samples)
        })
    });
    errors.fold(0.0, f64::max)
}

#[test]
fn normal_equations_of_the_plain_harmonics_break_where_the_cap_basis_holds() {
    let (k, degree) = (8, 3);
    let plain = |solver| error_of(Basis::Harmonics, solver, k, degree);
    let cap = |solver| error_of(Basis::Cap, solver, k, degree);
    assert!(plain(Solver::NormalEquations) > 1e-6);
    assert!(plain(Solver::Reflections) > PROMISE);
    assert!(cap(Solver::NormalEquations) <= PROMISE);
    assert!(cap(Solver::Reflections) <= PROMISE);
}
