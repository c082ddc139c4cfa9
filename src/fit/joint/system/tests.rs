//! The joint fit against the same regularised least squares in extended precision, and its held-out
//! errors against fits without the sample.

use super::*;
use crate::fit::joint::normal::Prior;
use crate::fit::joint::prior::Parent;
use crate::shapes::{Body, Sampling, SynthOptions, synthesize};
use crate::sphere::{Cap, CubeCell};
use nalgebra::Vector3;
use qd::Quad;

fn samples(body: Body, points: usize) -> Vec<Sample> {
    let options = SynthOptions {
        points,
        sampling: Sampling::Fibonacci,
        noise: 0.005,
        ..SynthOptions::clean(body)
    };
    let made = synthesize(&options).expect("valid options").points;
    made.iter()
        .map(|p| {
            let radius = p.coords.norm();
            let n = p.coords / radius;
            [n.x, n.y, n.z, radius]
        })
        .collect()
}

fn bases(degree: usize) -> Vec<CapBasis> {
    (0..=degree).map(CapBasis::new).collect()
}

/// P_j^(0,m)(x) by its sum of powers.
fn jacobi(j: usize, m: usize, x: Quad) -> Quad {
    let binomial =
        |n: usize, k: usize| (0..k).fold(1.0, |b, i| b * (n - i) as f64 / (i + 1) as f64);
    let half = Quad::from(0.5);
    let (below, above) = ((x - Quad::ONE) * half, (x + Quad::ONE) * half);
    let power = |base: Quad, n: usize| (0..n).fold(Quad::ONE, |p, _| p * base);
    (0..=j).fold(Quad::ZERO, |sum, s| {
        let factor = (binomial(j, s) * binomial(j + m, s)).round();
        sum + Quad::from(factor) * power(below, s) * power(above, j - s)
    })
}

/// The functions of a cap's basis at a sample, from their definition.
fn functions(degree: usize, cap: &Cap, sample: &Sample) -> Vec<Quad> {
    let dot = |axis: &Vector3<f64>| {
        (0..3).fold(Quad::ZERO, |sum, i| {
            sum + Quad::from(axis[i]) * Quad::from(sample[i])
        })
    };
    let height = Quad::from(cap.height);
    let width = (height + height).sqrt();
    let [u, v] = cap.tangents.map(|axis| dot(&axis) / width);
    let apart = (0..3).fold(Quad::ZERO, |sum, i| {
        let d = Quad::from(sample[i]) - Quad::from(cap.centre[i]);
        sum + d * d
    });
    let x = apart / height - Quad::ONE;
    let mut values = vec![Quad::ZERO; coefficient_count(degree)];
    let (mut re, mut im) = (Quad::ONE, Quad::ZERO);
    for m in 0..=degree {
        for j in 0..=degree - m {
            let twice = if m == 0 { 1 } else { 2 };
            let scale = Quad::from(((2 * j + m + 1) * twice) as f64).sqrt();
            let value = scale * jacobi(j, m, x);
            let first = (m + j).pow(2) + (2 * m).saturating_sub(1);
            values[first] = value * re;
            if m > 0 {
                values[first + 1] = value * im;
            }
        }
        (re, im) = (re * u - im * v, re * v + im * u);
    }
    values
}

/// The fitted radii at the samples, by the normal equations in extended precision: a condition of
/// 1e12 leaves them 19 digits.
fn extended(system: &System<'_>, prior: &Prior) -> Vec<f64> {
    let sizes = system.sizes();
    let starts: Vec<usize> = sizes
        .iter()
        .scan(0, |at, size| {
            *at += size;
            Some(*at - size)
        })
        .collect();
    let count = sizes.iter().sum();
    let mut matrix = vec![vec![Quad::ZERO; count]; count];
    let mut right = vec![Quad::ZERO; count];
    let mut rows = Vec::new();
    let mut shares = Vec::new();
    for (sample, &weight) in system.samples.iter().zip(&system.weights) {
        let n = Vector3::new(sample[0], sample[1], sample[2]);
        system.cover.shares(&n, &mut shares);
        let mut row: Vec<(usize, Quad)> = Vec::new();
        for &(cell, share) in &shares {
            let cell = usize::from(cell);
            let values = functions(system.degrees[cell], system.cover.cap(cell), sample);
            let places = (starts[cell]..).zip(values);
            row.extend(places.map(|(at, value)| (at, value * Quad::from(share))));
        }
        for &(i, a) in &row {
            right[i] += a * Quad::from(weight) * Quad::from(sample[3]);
            for &(j, b) in &row {
                matrix[i][j] += a * b * Quad::from(weight);
            }
        }
        rows.push(row);
    }
    for (cell, &start) in starts.iter().enumerate() {
        for j in 0..sizes[cell] {
            let weight = Quad::from(prior.weight(cell, j));
            matrix[start + j][start + j] += weight;
            right[start + j] += weight * Quad::from(prior.mean[cell][j]);
        }
    }
    let solution = solve_dense(matrix, right);
    let value = |row: &Vec<(usize, Quad)>| {
        let terms = row.iter().map(|&(i, a)| a * solution[i]);
        terms.fold(Quad::ZERO, |sum, term| sum + term).0
    };
    rows.iter().map(value).collect()
}

/// Solves a symmetric positive definite system by the factorization of Cholesky.
fn solve_dense(mut matrix: Vec<Vec<Quad>>, mut right: Vec<Quad>) -> Vec<Quad> {
    let count = right.len();
    for i in 0..count {
        for j in 0..=i {
            let sum = (0..j).fold(matrix[i][j], |sum, k| sum - matrix[i][k] * matrix[j][k]);
            matrix[i][j] = if i == j {
                sum.sqrt()
            } else {
                sum / matrix[j][j]
            };
        }
        let sum = (0..i).fold(right[i], |sum, k| sum - matrix[i][k] * right[k]);
        right[i] = sum / matrix[i][i];
    }
    for i in (0..count).rev() {
        let sum = (i + 1..count).fold(right[i], |sum, k| sum - matrix[k][i] * right[k]);
        right[i] = sum / matrix[i][i];
    }
    right
}

/// The largest distance of the fitted radii from those in extended precision, in mean radii.
fn error(system: &System<'_>, prior: &Prior) -> f64 {
    let (coefficients, _) = system.solve_refined(system.normal(), prior);
    let residuals = system.residuals(&coefficients);
    let mean = system.samples.iter().map(|s| s[3]).sum::<f64>() / system.samples.len() as f64;
    let pairs = system.samples.iter().zip(&residuals);
    pairs
        .zip(extended(system, prior))
        .map(|((sample, residual), exact)| (sample[3] - residual - exact).abs() / mean)
        .fold(0.0, f64::max)
}

/// Covers and degrees of some five hundred samples.
fn settings() -> Vec<(Vec<CubeCell>, usize)> {
    let mut settings: Vec<(Vec<CubeCell>, usize)> = [0, 1, 3, 6]
        .map(|degree| (CubeCell::uniform(1), degree))
        .into();
    settings.extend([0, 1, 3].map(|degree| (CubeCell::uniform(2), degree)));
    let mut ragged = CubeCell::uniform(1)[1..].to_vec();
    ragged.extend(CubeCell::uniform(1)[0].quarters());
    settings.push((ragged, 3));
    settings
}

#[test]
fn joint_fits_meet_extended_precision() {
    let samples = samples(Body::Chickpea, 500);
    for (cells, degree) in settings() {
        let cover = Cover::new(cells).expect("a cover");
        let bases = bases(degree);
        let degrees = vec![degree; cover.cells().len()];
        let system = System::new(cover, &bases, degrees.clone(), &samples);
        let mut prior = Parent::new(&bases, &samples).prior(&system, &bases);
        let (coefficients, _) = system.normal().solve(&prior);
        for learnt in [false, true] {
            if learnt {
                prior.learn(&coefficients, 1e-5);
            }
            let error = error(&system, &prior);
            println!("{} cells, degree {degree}: {error:.1e}", degrees.len());
            assert!(
                error < 1e-12,
                "{} cells, degree {degree}: {error}",
                degrees.len()
            );
        }
    }
}

#[test]
fn joint_fits_meet_extended_precision_with_the_weakest_prior() {
    let samples = samples(Body::Maize, 500);
    for (cells, degree) in settings() {
        let cover = Cover::new(cells).expect("a cover");
        let bases = bases(degree);
        let degrees = vec![degree; cover.cells().len()];
        let system = System::new(cover, &bases, degrees.clone(), &samples);
        let mut prior = Parent::new(&bases, &samples).prior(&system, &bases);
        prior.weights.fill(1e-7);
        prior.factors.fill(1.0);
        let error = error(&system, &prior);
        println!("{} cells, degree {degree}: {error:.1e}", degrees.len());
        assert!(
            error < 1e-12,
            "{} cells, degree {degree}: {error}",
            degrees.len()
        );
    }
}

#[test]
fn held_out_errors_are_those_of_fits_in_which_the_sample_does_not_count() {
    let samples = samples(Body::Bean, 300);
    let cover = Cover::new(CubeCell::uniform(1)).expect("a cover");
    let bases = bases(2);
    let degrees = vec![2; 6];
    let mut system = System::new(cover, &bases, degrees.clone(), &samples);
    let prior = Parent::new(&bases, &samples).prior(&system, &bases);
    let (coefficients, factor) = system.solve_refined(system.normal(), &prior);
    let held_out: Vec<f64> = system
        .errors(&coefficients, &factor.inverse())
        .held_out()
        .collect();
    for sample in (0..samples.len()).step_by(17) {
        let weight = std::mem::replace(&mut system.weights[sample], 0.0);
        let (others, _) = system.solve_refined(system.normal(), &prior);
        system.weights[sample] = weight;
        let expected = system.residuals(&others)[sample];
        assert!((held_out[sample] - expected).abs() < 1e-10 * samples[sample][3]);
    }
}
