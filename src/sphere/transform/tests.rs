use super::*;
use crate::sphere::HarmonicBasis;
use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, StandardNormal};

fn normals(count: usize, seed: u64) -> Vec<f64> {
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    (0..count)
        .map(|_| StandardNormal.sample(&mut random))
        .collect()
}

fn scattered(count: usize, seed: u64) -> Vec<Vector3<f64>> {
    normals(3 * count, seed)
        .chunks_exact(3)
        .map(|v| Vector3::new(v[0], v[1], v[2]).normalize())
        .collect()
}

/// Poles, next to the poles, along phi = 0 on both sides, the other axes, then scattered ones.
fn awkward(count: usize) -> Vec<Vector3<f64>> {
    let mut directions = Vec::new();
    for sign in [1.0, -1.0] {
        directions.push(Vector3::new(0.0, 0.0, sign));
        for tiny in [1e-300, 1e-12, 1e-5, 1e-2] {
            directions.push(Vector3::new(-tiny, 0.0, sign).normalize());
            directions.push(Vector3::new(tiny, -tiny, sign).normalize());
        }
        directions.push(Vector3::new(sign, 0.0, 0.0));
        directions.push(Vector3::new(0.0, sign, 0.0));
        directions.push(Vector3::new(0.6, -0.0, 0.8 * sign));
        directions.push(Vector3::new(0.6, -1e-300, 0.8 * sign));
        directions.push(Vector3::new(0.6, 1e-17 * sign, 0.8));
    }
    directions.extend(scattered(count, 1));
    directions
}

fn direct(degree: usize, directions: &[Vector3<f64>]) -> Vec<Vec<f64>> {
    let basis = HarmonicBasis::new(degree);
    directions
        .iter()
        .map(|n| {
            let mut row = vec![0.0; (degree + 1) * (degree + 1)];
            basis.evaluate(n, &mut row);
            row
        })
        .collect()
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

fn norm(a: &[f64]) -> f64 {
    dot(a, a).sqrt()
}

const DEGREES: [usize; 6] = [0, 1, 5, 17, 36, 80];

#[test]
fn synthesis_is_the_direct_sum() {
    let directions = awkward(500);
    for degree in DEGREES {
        let rows = direct(degree, &directions);
        let coefficients = normals(rows[0].len(), 2);
        let mut values = vec![f64::NAN; directions.len()];
        ScatteredHarmonics::new(degree, &directions).synthesis(&coefficients, &mut values);
        let error = rows
            .iter()
            .zip(&values)
            .map(|(row, value)| (dot(row, &coefficients) - value).abs())
            .fold(0.0, f64::max);
        let error = error / norm(&coefficients);
        assert!(error < 1e-8, "L = {degree}: {error:e}");
        // Directions that are asked for once have the same values.
        assert_eq!(
            Interpolant::new(degree, &coefficients).values(&directions),
            values
        );
    }
}

#[test]
fn wider_kernels_are_accurate() {
    let directions = awkward(500);
    for degree in DEGREES {
        let rows = direct(degree, &directions);
        let values = normals(directions.len(), 3);
        let mut coefficients = vec![f64::NAN; rows[0].len()];
        AccurateHarmonics::new(degree, &directions).adjoint(&values, &mut coefficients);
        let error = |(j, have): (usize, &f64)| {
            let want: f64 = rows.iter().zip(&values).map(|(row, v)| row[j] * v).sum();
            (want - have).abs()
        };
        let error = coefficients
            .iter()
            .enumerate()
            .map(error)
            .fold(0.0, f64::max);
        let error = error / norm(&values);
        assert!(error < 1e-13, "L = {degree}: {error:e}");
    }
}

#[test]
fn the_gram_matrix_is_the_direct_sum() {
    let directions = awkward(300);
    let weights: Vec<f64> = normals(directions.len(), 5)
        .iter()
        .map(|w| w.abs())
        .collect();
    let total: f64 = weights.iter().sum();
    for degree in [0, 1, 5, 24, 36] {
        let rows = direct(degree, &directions);
        let x = normals(rows[0].len(), 2);
        let mut found = vec![f64::NAN; x.len()];
        let mut moments = vec![0.0; (2 * degree + 1).pow(2)];
        AccurateHarmonics::new(2 * degree, &directions).adjoint(&weights, &mut moments);
        let gram = HarmonicGram::new(degree, &moments);
        gram.apply(&x, &mut gram.workspace(), &mut found);
        let values = rows.iter().zip(&weights).map(|(row, w)| w * dot(row, &x));
        let values: Vec<f64> = values.collect();
        let error = |(j, have): (usize, &f64)| {
            let want: f64 = rows.iter().zip(&values).map(|(row, v)| row[j] * v).sum();
            (want - have).abs()
        };
        let error = found.iter().enumerate().map(error).fold(0.0, f64::max);
        let error = error / (total * norm(&x));
        assert!(error < 1e-13, "L = {degree}: {error:e}");

        let matrix = gram.lower_triangle::<f64>();
        let single = gram.lower_triangle::<f32>();
        let order = &matrix.order;
        for j in [0, x.len() / 3, x.len() / 2, x.len() - 1] {
            for i in j..x.len() {
                let products = rows.iter().map(|row| row[order[i]] * row[order[j]]);
                let want: f64 = products.zip(&weights).map(|(product, w)| product * w).sum();
                let at = j * x.len() + i;
                let error = (matrix.entries[at] - want).abs() / total;
                let rounded = (f64::from(single.entries[at]) - want).abs() / total;
                assert!(error < 1e-12, "L = {degree}, {i}, {j}: {error:e}");
                assert!(rounded < 1e-6, "L = {degree}, {i}, {j}: {rounded:e}");
            }
        }
    }
}

#[test]
fn adjoint_is_the_direct_sum() {
    let directions = awkward(500);
    for degree in DEGREES {
        let rows = direct(degree, &directions);
        let values = normals(directions.len(), 3);
        let mut coefficients = vec![f64::NAN; rows[0].len()];
        ScatteredHarmonics::new(degree, &directions).adjoint(&values, &mut coefficients);
        let error = coefficients
            .iter()
            .enumerate()
            .map(|(j, have)| {
                let want: f64 = rows.iter().zip(&values).map(|(row, v)| row[j] * v).sum();
                (want - have).abs()
            })
            .fold(0.0, f64::max);
        let error = error / norm(&values);
        assert!(error < 1e-8, "L = {degree}: {error:e}");
    }
}

#[test]
fn adjoint_is_the_transpose() {
    for degree in DEGREES {
        for count in [1, 2, 37, 3000] {
            let operator = ScatteredHarmonics::new(degree, &scattered(count, 4));
            let x = normals((degree + 1) * (degree + 1), 5);
            let y = normals(count, 6);
            let (mut forward, mut back) = (vec![0.0; count], vec![0.0; x.len()]);
            operator.synthesis(&x, &mut forward);
            operator.adjoint(&y, &mut back);
            let difference = (dot(&forward, &y) - dot(&x, &back)).abs();
            let scale = norm(&forward) * norm(&y);
            assert!(
                difference < 1e-13 * scale,
                "L = {degree}, N = {count}: {difference:e} of {scale:e}"
            );
        }
    }
}

#[test]
fn no_directions_give_zero() {
    let operator = ScatteredHarmonics::new(3, &[]);
    operator.synthesis(&[1.0; 16], &mut []);
    let mut coefficients = [f64::NAN; 16];
    operator.adjoint(&[], &mut coefficients);
    assert_eq!(coefficients, [0.0; 16]);
}

/// Many directions are shared among threads: same bits from one and from four, and the direct sum in
/// every chunk.
#[test]
fn threads_do_not_change_a_bit() {
    let degree = 12;
    let directions = scattered(MANY + 7, 7);
    let coefficients = normals((degree + 1) * (degree + 1), 8);
    let values = normals(directions.len(), 9);
    let run = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads);
        pool.build().expect("threads").install(|| {
            let operator = ScatteredHarmonics::new(degree, &directions);
            let (mut forward, mut back) = (values.clone(), coefficients.clone());
            operator.synthesis(&coefficients, &mut forward);
            operator.adjoint(&values, &mut back);
            (forward, back)
        })
    };
    let (forward, back) = run(1);
    assert_eq!(run(4), (forward.clone(), back.clone()));

    let some: Vec<_> = (0..directions.len()).step_by(997).collect();
    let rows = direct(
        degree,
        &some.iter().map(|i| directions[*i]).collect::<Vec<_>>(),
    );
    for (i, row) in some.iter().zip(&rows) {
        let error = dot(row, &coefficients) - forward[*i];
        assert!(error.abs() < 1e-8 * norm(&coefficients), "{i}: {error:e}");
    }
    let (left, right) = (dot(&forward, &values), dot(&coefficients, &back));
    assert!((left - right).abs() < 1e-13 * norm(&forward) * norm(&values));
}
