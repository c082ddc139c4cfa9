//! Segments against independent routes to the same numbers.

use super::*;
use crate::fit::segments::reduce::reduce_cells;
use crate::fit::segments::row::rows;
use crate::model::Frame;
use crate::shapes::{Body, Sampling, SynthOptions, synthesize};
use crate::sphere::{CapBasis, harmonics};
use nalgebra::{Matrix3, Point3, Vector3};

const PARTS: usize = 3;

fn samples(points: usize, grid: &CellGrid) -> Samples {
    let options = SynthOptions {
        points,
        sampling: Sampling::Fibonacci,
        noise: 0.01,
        ..SynthOptions::clean(Body::Maize)
    };
    let frame = Frame {
        centre: Point3::origin(),
        axes: Matrix3::identity(),
    };
    let made = synthesize(&options).expect("valid options");
    Samples::new(&made.points, &frame, grid)
}

fn level<'a>(
    grid: &'a CellGrid,
    basis: &'a CapBasis,
    samples: &'a Samples,
    reduced: &'a [Option<ReducedCell>],
) -> Level<'a> {
    let partition = AngularPartition::new(PARTS);
    Level {
        partition,
        basis,
        grid,
        samples,
        probes: samples,
        reduced,
    }
}

/// Least squares in the plain harmonics by SVD, an independent route to the same function.
fn by_harmonics(samples: &[Sample], degree: usize) -> impl Fn(&Sample) -> f64 {
    let row = move |s: &Sample| harmonics(degree, &Vector3::new(s[0], s[1], s[2]));
    let values: Vec<Vec<f64>> = samples.iter().map(row).collect();
    let design = nalgebra::DMatrix::from_fn(samples.len(), values[0].len(), |i, j| values[i][j]);
    let radii = nalgebra::DVector::from_fn(samples.len(), |i, _| samples[i][3]);
    let solution = design.svd(true, true).solve(&radii, 1e-13).expect("solved");
    move |s: &Sample| row(s).iter().zip(&solution).map(|(y, a)| y * a).sum()
}

#[test]
fn a_segment_is_the_least_squares_fit_in_the_harmonics_at_every_degree() {
    let grid = CellGrid::new([PARTS]);
    let basis = CapBasis::new(3);
    let samples = samples(2000, &grid);
    let level = level(&grid, &basis, &samples, &[]);
    let segment = 4;
    let fit = level.fit(
        segment,
        &rows(level.partition, level.basis),
        &mut Workspace::new(3),
    );
    let own: Vec<Sample> = level
        .runs(segment)
        .flat_map(|run| samples.run(run).to_vec())
        .collect();
    let cap = level.partition.cap(segment);
    for (degree, fit) in fit.degrees.iter().enumerate() {
        let reference = by_harmonics(&own, degree);
        for s in &own {
            let n = Vector3::new(s[0], s[1], s[2]);
            let value = basis.value(&cap, &fit.coefficients, &n);
            assert!((value - reference(s)).abs() < 1e-9, "degree {degree}");
        }
    }
}

#[test]
fn the_held_out_error_is_that_of_fits_without_the_sample() {
    let grid = CellGrid::new([PARTS]);
    let basis = CapBasis::new(2);
    let samples = samples(900, &grid);
    let level = level(&grid, &basis, &samples, &[]);
    let segment = 4;
    let fit = level.fit(
        segment,
        &rows(level.partition, level.basis),
        &mut Workspace::new(2),
    );
    let own: Vec<Sample> = level
        .runs(segment)
        .flat_map(|run| samples.run(run).to_vec())
        .collect();
    for (degree, fit) in fit.degrees.iter().enumerate() {
        let (mut squared, mut worst) = (0.0, 0.0_f64);
        for i in 0..own.len() {
            let mut others = own.clone();
            let left_out = others.remove(i);
            let error = left_out[3] - by_harmonics(&others, degree)(&left_out);
            squared += error * error;
            worst = worst.max(error.abs() / left_out[3]);
        }
        assert!((fit.held_out.squared / squared - 1.0).abs() < 1e-8);
        assert!((fit.held_out.worst / worst - 1.0).abs() < 1e-8);
        assert_eq!(fit.held_out.count, own.len());
    }
}

#[test]
fn reduced_cells_give_the_fit_of_their_samples() {
    let grid = CellGrid::new([2, PARTS]);
    let basis = CapBasis::new(3);
    let samples = samples(20_000, &grid);
    let reduced = reduce_cells(&samples, &grid, &basis);
    assert!(reduced.iter().all(Option::is_some));
    let direct = level(&grid, &basis, &samples, &[]);
    let by_cells = level(&grid, &basis, &samples, &reduced);
    for segment in 0..PARTS * PARTS {
        let a = direct.fit(
            segment,
            &rows(direct.partition, direct.basis),
            &mut Workspace::new(3),
        );
        let b = by_cells.fit(
            segment,
            &rows(by_cells.partition, by_cells.basis),
            &mut Workspace::new(3),
        );
        assert_eq!(a.degrees.len(), b.degrees.len());
        for (a, b) in a.degrees.iter().zip(&b.degrees) {
            for (x, y) in a.coefficients.iter().zip(&b.coefficients) {
                assert!((x - y).abs() < 1e-9 * a.coefficients[0].abs(), "{x} {y}");
            }
            assert!((a.held_out.squared / b.held_out.squared - 1.0).abs() < 1e-9);
        }
    }
}
