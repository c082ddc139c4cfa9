//! temporary
/// Gauss-Legendre rule on [0, 1]: (node, weight).
pub fn gauss_legendre(n: usize) -> Vec<(f64, f64)> {
    (0..n)
        .map(|i| {
            let mut x = -(std::f64::consts::PI * (i as f64 + 0.75) / (n as f64 + 0.5)).cos();
            let mut d = 1.0;
            for _ in 0..8 {
                let (mut p0, mut p1) = (1.0, x);
                for k in 2..=n {
                    let k = k as f64;
                    (p0, p1) = (p1, ((2.0 * k - 1.0) * x * p1 - (k - 1.0) * p0) / k);
                }
                d = n as f64 * (x * p1 - p0) / (x * x - 1.0);
                x -= p1 / d;
            }
            (0.5 + 0.5 * x, 1.0 / ((1.0 - x * x) * d * d))
        })
        .collect()
}
