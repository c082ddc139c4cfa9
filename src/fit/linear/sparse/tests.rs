//! Block matrices against the same matrices taken densely.

use super::*;
use faer::Side;
use faer::linalg::solvers::Solve;

/// A small generator of numbers in [-1, 1).
fn numbers(seed: u64) -> impl FnMut() -> f64 {
    let mut state = seed;
    move || {
        state = state
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        (state >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
    }
}

/// What ties block rows together: sums of squares of samples that touch these rows.
struct Problem {
    sizes: Vec<usize>,
    groups: Vec<Vec<u16>>,
}

impl Problem {
    /// Rows in a ring, of which neighbours are tied, as cells round a pole are.
    fn ring(sizes: &[usize]) -> Self {
        let count = sizes.len() as u16;
        let group = |i: u16| {
            let mut pair = vec![i, (i + 1) % count];
            pair.sort_unstable();
            pair.dedup();
            pair
        };
        Self {
            sizes: sizes.into(),
            groups: (0..count).map(group).collect(),
        }
    }

    /// Groups of one to five rows drawn at random.
    fn random(rows: usize, groups: usize, seed: u64) -> Self {
        let mut next = numbers(seed);
        let mut below = |most: usize| ((0.5 + 0.5 * next()) * most as f64) as usize;
        let sizes = (0..rows).map(|_| [1, 4, 9, 16][below(4)]).collect();
        let group = |_| {
            let mut cells: Vec<u16> = (0..=below(5)).map(|_| below(rows) as u16).collect();
            cells.sort_unstable();
            cells.dedup();
            cells
        };
        Self {
            sizes,
            groups: (0..groups).map(group).collect(),
        }
    }

    fn starts(&self) -> Vec<usize> {
        let mut starts = vec![0];
        for size in &self.sizes {
            starts.push(starts[starts.len() - 1] + size);
        }
        starts
    }

    /// The same positive definite matrix by blocks and densely.
    fn matrices(&self, seed: u64) -> (BlockMatrix, Mat<f64>) {
        let mut next = numbers(seed);
        let starts = self.starts();
        let whole = starts[self.sizes.len()];
        let mut blocks = BlockMatrix::new(self.sizes.clone());
        let mut dense = Mat::<f64>::zeros(whole, whole);
        for group in &self.groups {
            let columns: usize = group.iter().map(|&i| self.sizes[usize::from(i)]).sum();
            let design = Mat::from_fn(2 * columns, columns, |_, _| next());
            let square = design.transpose() * &design;
            let mut row = 0;
            for &i in group {
                let (height, to) = (self.sizes[usize::from(i)], starts[usize::from(i)]);
                let mut column = 0;
                for &j in group {
                    let (width, from) = (self.sizes[usize::from(j)], starts[usize::from(j)]);
                    let part = square.submatrix(row, column, height, width);
                    let mut target = dense.as_mut().submatrix_mut(to, from, height, width);
                    target += part;
                    if j <= i {
                        *blocks.block(i, j) += part;
                    }
                    column += width;
                }
                row += height;
            }
        }
        for (i, &size) in self.sizes.iter().enumerate() {
            for k in 0..size {
                blocks.block(i as u16, i as u16)[(k, k)] += 0.1;
                dense[(starts[i] + k, starts[i] + k)] += 0.1;
            }
        }
        (blocks, dense)
    }

    /// A right-hand side, by blocks and densely.
    fn right(&self, columns: usize) -> (Vec<Mat<f64>>, Mat<f64>) {
        let mut next = numbers(77);
        let starts = self.starts();
        let dense = Mat::from_fn(starts[self.sizes.len()], columns, |_, _| next());
        (self.split(&dense), dense)
    }

    fn split(&self, dense: &Mat<f64>) -> Vec<Mat<f64>> {
        let starts = self.starts();
        let part = |(i, &size): (usize, &usize)| dense.subrows(starts[i], size).to_owned();
        self.sizes.iter().enumerate().map(part).collect()
    }

    fn joined(&self, parts: &[Mat<f64>]) -> Mat<f64> {
        let starts = self.starts();
        let mut dense = Mat::zeros(starts[self.sizes.len()], parts[0].ncols());
        for (part, &start) in parts.iter().zip(&starts) {
            dense
                .as_mut()
                .subrows_mut(start, part.nrows())
                .copy_from(part);
        }
        dense
    }
}

fn problems() -> Vec<Problem> {
    let mut problems = vec![
        Problem::ring(&[5]),
        Problem::ring(&[3, 2]),
        Problem::ring(&[1, 4, 9, 16, 9, 4, 1]),
        Problem {
            sizes: vec![4; 6],
            groups: Vec::new(),
        },
        Problem {
            sizes: vec![2, 3, 4],
            groups: vec![vec![0, 1, 2]],
        },
    ];
    for (rows, groups) in [(6, 6), (12, 10), (30, 45), (40, 25)] {
        for seed in 0..4 {
            problems.push(Problem::random(rows, groups, seed));
        }
    }
    problems
}

fn largest(matrix: &Mat<f64>) -> f64 {
    matrix.norm_max()
}

#[test]
fn the_solution_is_that_of_the_dense_matrix() {
    for (seed, problem) in (0..).zip(problems()) {
        let (blocks, dense) = problem.matrices(seed);
        let factor = blocks.factor().expect("positive definite");
        for columns in [1, 3] {
            let (mut right, dense_right) = problem.right(columns);
            let expected = dense
                .llt(Side::Lower)
                .expect("positive definite")
                .solve(&dense_right);
            factor.solve(&mut right);
            let difference = problem.joined(&right) - &expected;
            assert!(largest(&difference) < 1e-11 * largest(&expected));
        }
    }
}

#[test]
fn the_backward_solution_has_the_inverse_as_its_covariance() {
    for (seed, problem) in (0..).zip(problems()) {
        let (blocks, dense) = problem.matrices(seed);
        let factor = blocks.factor().expect("positive definite");
        let whole = dense.nrows();
        // With X = L^-T: X X^T is the inverse, whatever the order of elimination.
        let mut columns = problem.split(&Mat::identity(whole, whole));
        factor.backward(&mut columns);
        let x = problem.joined(&columns);
        let product = &x * x.transpose() * &dense;
        let difference = product - Mat::<f64>::identity(whole, whole);
        assert!(largest(&difference) < 1e-9, "{}", largest(&difference));
    }
}

#[test]
fn a_matrix_that_is_not_positive_definite_has_no_factor() {
    let problem = Problem::ring(&[3, 4, 2, 3]);
    let (mut blocks, _) = problem.matrices(1);
    blocks.block(2, 2)[(1, 1)] = -1.0;
    assert!(blocks.factor().is_none());
    let mut empty = BlockMatrix::new(vec![2, 2]);
    empty.block(0, 0)[(0, 0)] = 1.0;
    empty.block(0, 0)[(1, 1)] = 1.0;
    assert!(empty.factor().is_none());
    let (mut broken, _) = problem.matrices(1);
    broken.block(1, 0)[(0, 0)] = f64::NAN;
    assert!(broken.factor().is_none());
}

#[test]
fn rows_of_very_different_scale_are_solved_alike() {
    let problem = Problem::ring(&[4, 4, 9, 4]);
    let (mut blocks, mut dense) = problem.matrices(5);
    let starts = problem.starts();
    let scale = |i: usize| 10.0_f64.powi(4 * i as i32);
    for (&(i, j), block) in &mut blocks.blocks {
        let factor = scale(i.into()) * scale(j.into());
        *block *= faer::Scale(factor);
    }
    let row_of = |k: usize| (0..4).find(|&i| k < starts[i + 1]).expect("a row");
    for i in 0..dense.nrows() {
        for j in 0..dense.ncols() {
            dense[(i, j)] *= scale(row_of(i)) * scale(row_of(j));
        }
    }
    let (_, solution) = problem.right(1);
    let mut right = problem.split(&(&dense * &solution));
    blocks
        .factor()
        .expect("positive definite")
        .solve(&mut right);
    let found = problem.joined(&right);
    for i in 0..found.nrows() {
        let scaled = (found[(i, 0)] - solution[(i, 0)]) * scale(row_of(i));
        assert!(scaled.abs() < 1e-9 * scale(3), "{i}: {scaled}");
    }
}
