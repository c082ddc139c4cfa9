use crate::model::Derivatives;
use crate::sphere::{HarmonicBasis, Jet, harmonics};
use nalgebra::{Matrix3, Vector3};

const DEGREES: [usize; 6] = [0, 1, 2, 5, 17, 64];

fn numbers(count: usize) -> Vec<f64> {
    (0..count)
        .map(|i| (0.4 + 1.7 * i as f64 * i as f64).sin())
        .collect()
}

fn directions() -> Vec<Vector3<f64>> {
    vec![
        Vector3::new(0.0, 0.0, 1.0),
        Vector3::new(0.0, 0.0, -1.0),
        Vector3::new(1e-9, -2e-9, 1.0).normalize(),
        Vector3::new(1.0, 0.0, 0.0),
        Vector3::new(0.0, -1.0, 0.0),
        Vector3::new(0.48, 0.6, 0.64),
        Vector3::new(-0.1, 0.05, -0.9).normalize(),
    ]
}

#[test]
fn values_are_the_direct_sum() {
    for degree in DEGREES {
        let basis = HarmonicBasis::new(degree + 3);
        let coefficients = numbers((degree + 1) * (degree + 1));
        for n in directions() {
            let y = harmonics(degree, &n);
            let want: f64 = y.iter().zip(&coefficients).map(|(y, c)| y * c).sum();
            let jet = basis.jet(&coefficients, &n);
            let (value, gradient) = basis.value_and_gradient(&coefficients, &n);
            let tolerance = 1e-13 * (1.0 + (degree * degree) as f64);
            assert!((basis.value(&coefficients, &n) - want).abs() < tolerance);
            assert!((value - want).abs() < tolerance);
            assert!((jet.value - want).abs() < tolerance);
            let on_sphere = Derivatives::on_sphere(&n, &jet);
            let slope = (gradient - on_sphere.gradient).norm();
            assert!(slope < tolerance * (1.0 + degree as f64));
            assert!(gradient.dot(&n).abs() < tolerance * (1.0 + degree as f64));
        }
    }
}

/// Central differences of the polynomials in space: the error grows with the cube of the degree.
#[test]
fn derivatives_are_those_of_differences() {
    for degree in DEGREES {
        let basis = HarmonicBasis::new(degree);
        let coefficients = numbers((degree + 1) * (degree + 1));
        let step = 1e-4 / (1.0 + degree as f64);
        for n in directions() {
            let jet = basis.jet(&coefficients, &n);
            let near = |axis: usize| {
                [step, -step].map(|step| {
                    let mut moved = n;
                    moved[axis] += step;
                    basis.jet(&coefficients, &moved)
                })
            };
            let both = [near(0), near(1), near(2)];
            let gradient = both.map(|[a, b]| (a.value - b.value) / (2.0 * step));
            let columns = both.map(|[a, b]: [Jet; 2]| (a.gradient - b.gradient) / (2.0 * step));
            let scale = 1.0 + jet.gradient.norm();
            assert!((jet.gradient - Vector3::from(gradient)).norm() < 1e-5 * scale);
            let hessian = Matrix3::from_columns(&columns);
            let scale = 1.0 + jet.hessian.norm();
            assert!(
                (jet.hessian - hessian).norm() < 1e-5 * scale,
                "{degree} {n}: {} {hessian}",
                jet.hessian
            );
        }
    }
}

#[test]
fn the_laplacian_of_degree_l_is_minus_l_times_l_plus_1() {
    let degree = 64;
    let basis = HarmonicBasis::new(degree);
    for l in [0, 1, 2, 3, 10, 36, 64] {
        let mut coefficients = numbers((degree + 1) * (degree + 1));
        for (j, coefficient) in coefficients.iter_mut().enumerate() {
            if j.isqrt() != l {
                *coefficient = 0.0;
            }
        }
        for n in directions() {
            let on_sphere = Derivatives::on_sphere(&n, &basis.jet(&coefficients, &n));
            let want = -((l * (l + 1)) as f64) * on_sphere.radius;
            let scale = 1.0 + (l * l * l) as f64;
            let laplacian = on_sphere.hessian.trace();
            assert!(
                (laplacian - want).abs() < 1e-11 * scale,
                "{l} {n}: {laplacian} {want}"
            );
        }
    }
}

#[test]
fn no_coefficients_give_zero() {
    let n = Vector3::new(0.48, 0.6, 0.64);
    let basis = HarmonicBasis::new(2);
    assert_eq!(basis.value(&[], &n), 0.0);
    assert_eq!(basis.jet(&[], &n), Jet::default());
}
