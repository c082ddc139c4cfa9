//! The cap basis against differences, the harmonics, and its own other routes.

use super::*;
use crate::sphere::{AngularPartition, CapExpansion, harmonics};

fn direction(theta: f64, phi: f64) -> Vector3<f64> {
    Cap::new(theta, phi, 1.0).centre
}

#[test]
fn block_evaluation_agrees_with_the_expansion_of_unit_coefficients() {
    let basis = CapBasis::new(5);
    let cap = Cap::new(1.1, 0.4, 0.2);
    let directions: Vec<[f64; 4]> = (0..19)
        .map(|i| direction(1.0 + 0.02 * i as f64, 0.3 + 0.013 * i as f64))
        .map(|n| [n.x, n.y, n.z, 0.0])
        .collect();
    let mut out = vec![0.0; 36 * directions.len()];
    let mut places = Places::default();
    cap.locate(&directions, &mut places);
    basis.evaluate(&places, &mut out, directions.len());
    for j in 0..36 {
        let mut unit = vec![0.0; 36];
        unit[j] = 1.0;
        for (i, n) in directions.iter().enumerate() {
            let value = basis.value(&cap, &unit, &Vector3::new(n[0], n[1], n[2]));
            assert!((value - out[j * directions.len() + i]).abs() < 1e-13);
        }
    }
}

#[test]
fn gradients_of_all_functions_are_those_of_each() {
    let basis = CapBasis::new(5);
    let cap = Cap::new(1.3, 0.2, 0.7);
    let directions: Vec<[f64; 4]> = (0..11)
        .map(|i| direction(0.8 + 0.1 * i as f64, 0.05 * i as f64))
        .map(|n| [n.x, n.y, n.z, 0.0])
        .collect();
    let mut places = Places::default();
    cap.locate(&directions, &mut places);
    let gradients = basis.evaluate_gradients(&cap, &places);
    let frame = [cap.tangents[0], cap.tangents[1], cap.centre];
    for j in 0..36 {
        let mut unit = vec![0.0; 36];
        unit[j] = 1.0;
        for (i, n) in directions.iter().enumerate() {
            let n = Vector3::new(n[0], n[1], n[2]);
            let (_, gradient) =
                CapExpansion::new(&basis, &cap, unit.as_chunks().0).value_and_gradient(&n);
            for (axis, table) in frame.iter().zip(&gradients) {
                assert!((axis.dot(&gradient) - table[j * 11 + i]).abs() < 1e-12);
            }
        }
    }
}

#[test]
fn gradient_agrees_with_central_differences_everywhere_on_the_sphere() {
    let basis = CapBasis::new(4);
    let cap = Cap::new(0.7, 2.0, 2.0);
    let coefficients: Vec<f64> = (0..25).map(|i| (i as f64 * 1.7).sin()).collect();
    let expansion = CapExpansion::new(&basis, &cap, coefficients.as_chunks().0);
    for theta in [0.0, 0.3, 1.2, 2.9, std::f64::consts::PI] {
        let n = direction(theta, 0.9);
        let (_, gradient) = expansion.value_and_gradient(&n);
        assert!(gradient.dot(&n).abs() < 1e-12);
        for tangent in [
            n.cross(&Vector3::new(0.3, 0.8, 0.1)),
            n.cross(&Vector3::new(0.9, -0.2, 0.4)),
        ] {
            let tangent = tangent.normalize();
            let h = 1e-5;
            let at = |s: f64| basis.value(&cap, &coefficients, &(n * s.cos() + tangent * s.sin()));
            let difference = (at(h) - at(-h)) / (2.0 * h);
            assert!((gradient.dot(&tangent) - difference).abs() < 1e-8);
        }
    }
}

/// Condition number of a design matrix whose columns are scaled to unit length.
fn condition(mut design: nalgebra::DMatrix<f64>) -> f64 {
    for mut column in design.column_iter_mut() {
        column.normalize_mut();
    }
    let values = design.singular_values();
    values.max() / values.min()
}

#[test]
fn the_basis_stays_well_conditioned_where_the_harmonics_do_not() {
    let degree = 3;
    let basis = CapBasis::new(degree);
    for k in [1, 2, 4, 8, 10, 16, 64] {
        let partition = AngularPartition::new(k);
        // A wedge at the pole and a segment at the equator.
        for segment in [0, k / 2 * k] {
            let rectangle = partition.rectangle(segment);
            let directions: Vec<[f64; 4]> = (0..400)
                .map(|i| rectangle.direction((i / 20) as f64 / 19.0, (i % 20) as f64 / 19.0))
                .map(|n| [n.x, n.y, n.z, 0.0])
                .collect();
            let mut places = Places::default();
            rectangle.cap().locate(&directions, &mut places);
            let mut values = vec![0.0; 16 * 400];
            basis.evaluate(&places, &mut values, 400);
            let ours = condition(nalgebra::DMatrix::from_vec(400, 16, values));
            let bound = if k <= 16 { 500.0 } else { 1e4 };
            assert!(ours < bound, "k = {k}: {ours}");
            if k >= 10 {
                let rows: Vec<f64> = directions
                    .iter()
                    .flat_map(|n| harmonics(degree, &Vector3::new(n[0], n[1], n[2])))
                    .collect();
                let plain = condition(nalgebra::DMatrix::from_row_slice(400, 16, &rows));
                assert!(plain > 1e6, "k = {k}: {plain}");
            }
        }
    }
}

#[test]
fn the_basis_spans_the_harmonics() {
    let degree = 3;
    let rectangle = AngularPartition::new(5).rectangle(7);
    let cap = rectangle.cap();
    let basis = CapBasis::new(degree);
    let directions: Vec<Vector3<f64>> = (0..64)
        .map(|i| rectangle.direction((i / 8) as f64 / 7.0, (i % 8) as f64 / 7.0))
        .collect();
    let unit = |j: usize| (0..16).map(|i| f64::from(i == j)).collect::<Vec<f64>>();
    let design =
        nalgebra::DMatrix::from_fn(64, 16, |i, j| basis.value(&cap, &unit(j), &directions[i]));
    let target = nalgebra::DMatrix::from_fn(64, 16, |i, j| harmonics(degree, &directions[i])[j]);
    let solution = design
        .clone()
        .svd(true, true)
        .solve(&target, 1e-14)
        .expect("solved");
    assert!((design * solution - target).amax() < 1e-13);
}

#[test]
fn any_degree_has_a_number_of_coefficients() {
    let counts = [0, 3, usize::MAX / 2, usize::MAX].map(coefficient_count);
    assert_eq!(counts, [1, 16, usize::MAX, usize::MAX]);
}
