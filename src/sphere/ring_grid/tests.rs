use super::*;

fn numbers(count: usize, seed: f64) -> Vec<f64> {
    (0..count)
        .map(|i| (seed + 1.7 * i as f64 * i as f64 + 0.3 * i as f64).sin())
        .collect()
}

#[test]
fn harmonics_are_orthonormal_by_quadrature() {
    for (degree, rings) in [(0, 0), (1, 2), (7, 8), (12, 20)] {
        let grid = RingGrid::new(degree, rings);
        let nodes = grid.nodes();
        assert_eq!(nodes.len(), 2 * rings.max(1) * rings.max(1));
        let basis = HarmonicBasis::new(degree);
        let count = (degree + 1) * (degree + 1);
        let mut products = vec![0.0; count * count];
        let mut y = vec![0.0; count];
        for (n, weight) in nodes {
            assert!((n.norm() - 1.0).abs() < 1e-15);
            basis.evaluate(&n, &mut y);
            for i in 0..count {
                for j in 0..count {
                    products[i * count + j] += weight * y[i] * y[j];
                }
            }
        }
        for i in 0..count {
            for j in 0..count {
                let want = if i == j { 1.0 } else { 0.0 };
                assert!((products[i * count + j] - want).abs() < 1e-13, "{i} {j}");
            }
        }
    }
}

#[test]
fn values_and_gradients_are_those_of_the_basis() {
    for (degree, rings) in [(0, 1), (1, 2), (5, 6), (17, 18), (36, 48)] {
        let grid = RingGrid::new(degree, rings);
        let basis = HarmonicBasis::new(degree);
        let coefficients = numbers((degree + 1) * (degree + 1), 1.0);
        let sums = grid.synthesis(&coefficients);
        assert_eq!(sums.len(), grid.nodes().len());
        for ((n, _), (value, gradient)) in grid.nodes().iter().zip(sums) {
            let (want, slope) = basis.value_and_gradient(&coefficients, n);
            assert!((value - want).abs() < 1e-12 * (1.0 + degree as f64));
            assert!(
                (gradient - slope).norm() < 1e-12 * (1.0 + (degree * degree) as f64),
                "{degree}: {gradient} {slope}"
            );
        }
    }
}

#[test]
fn adjoint_is_the_transpose() {
    for (degree, rings) in [(0, 1), (1, 2), (5, 9), (36, 48)] {
        let grid = RingGrid::new(degree, rings);
        let x = numbers((degree + 1) * (degree + 1), 2.0);
        let forward = grid.synthesis(&x);
        let of_values = numbers(forward.len(), 3.0);
        let of_gradients: Vec<_> = numbers(3 * forward.len(), 4.0)
            .chunks_exact(3)
            .map(|v| Vector3::new(v[0], v[1], v[2]))
            .collect();
        for of_gradients in [Some(&of_gradients[..]), None] {
            let back = grid.adjoint(&of_values, of_gradients);
            let values = forward.iter().zip(&of_values).map(|((v, _), a)| v * a);
            let gradients = forward.iter().zip(of_gradients.unwrap_or_default());
            let products = values.chain(gradients.map(|((_, g), b)| g.dot(b)));
            let (mut left, mut scale) = (0.0, 0.0);
            for product in products {
                left += product;
                scale += product.abs();
            }
            let right: f64 = x.iter().zip(&back).map(|(x, y)| x * y).sum();
            assert!((left - right).abs() < 1e-13 * scale, "{left} {right}");
        }
    }
}
