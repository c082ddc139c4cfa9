//! Carlson's symmetric elliptic integrals.
//!
//! By duplication (B. C. Carlson, Numerical computation of real or complex elliptic integrals,
//! Numer. Algorithms 10, 1995; also DLMF 19.36): each step keeps the integral and brings its
//! arguments closer, in the end by a factor of four, until a Taylor series of degree five about
//! their mean is exact to rounding.

/// Largest relative distance of an argument from the mean at which the series is used. Its first
/// term left out is of the sixth power of this, below 1e-17.
const NEAR: f64 = 1e-3;

/// R_F(x, y, z) = 1/2 ∫_0^∞ dt / sqrt((t + x) (t + y) (t + z)), of positive
/// arguments (one of x and y may be zero).
pub(crate) fn rf(mut x: f64, mut y: f64, mut z: f64) -> f64 {
    loop {
        let mean = (x + y + z) / 3.0;
        let [p, q, r] = [x, y, z].map(|argument| 1.0 - argument / mean);
        if is_near([p, q, r]) {
            let (e2, e3) = (p * q - r * r, p * q * r);
            let series = 1.0 - e2 / 10.0 + e3 / 14.0 + e2 * e2 / 24.0 - 3.0 * e2 * e3 / 44.0;
            return series / mean.sqrt();
        }
        let lambda = lambda(x, y, z);
        [x, y, z] = [x, y, z].map(|argument| (argument + lambda) / 4.0);
    }
}

/// R_D(x, y, z) = 3/2 ∫_0^∞ dt / (sqrt((t + x) (t + y)) (t + z)^(3/2)), of positive
/// arguments (one of x and y may be zero).
pub(crate) fn rd(mut x: f64, mut y: f64, mut z: f64) -> f64 {
    let (mut sum, mut factor) = (0.0, 1.0);
    loop {
        let mean = (x + y + 3.0 * z) / 5.0;
        let [p, q, r] = [x, y, z].map(|argument| 1.0 - argument / mean);
        if is_near([p, q, r]) {
            let (pq, rr) = (p * q, r * r);
            let e2 = pq - 6.0 * rr;
            let e3 = (3.0 * pq - 8.0 * rr) * r;
            let e4 = 3.0 * (pq - rr) * rr;
            let e5 = pq * rr * r;
            let series = 1.0 - 3.0 * e2 / 14.0 + e3 / 6.0 + 9.0 * e2 * e2 / 88.0
                - 3.0 * e4 / 22.0
                - 9.0 * e2 * e3 / 52.0
                + 3.0 * e5 / 26.0;
            return factor * series / (mean * mean.sqrt()) + 3.0 * sum;
        }
        let lambda = lambda(x, y, z);
        sum += factor / (z.sqrt() * (z + lambda));
        factor /= 4.0;
        [x, y, z] = [x, y, z].map(|argument| (argument + lambda) / 4.0);
    }
}

/// R_G(x, y, z), of positive arguments: the mean of sqrt(x n_x² + y n_y² + z n_z²) over the unit
/// sphere.
///
/// Its form by R_F and R_D (DLMF 19.21.10) is taken with the middle argument in the last place,
/// where no term is negative.
pub(crate) fn rg(x: f64, y: f64, z: f64) -> f64 {
    let mut sorted = [x, y, z];
    sorted.sort_by(f64::total_cmp);
    let [low, middle, high] = sorted;
    let spread = (high - middle) * (middle - low);
    (middle * rf(low, high, middle)
        + spread * rd(low, high, middle) / 3.0
        + (low * high / middle).sqrt())
        / 2.0
}

/// What duplication adds to every argument.
fn lambda(x: f64, y: f64, z: f64) -> f64 {
    let (x, y, z) = (x.sqrt(), y.sqrt(), z.sqrt());
    x * y + y * z + z * x
}

/// Whether the series may be used; also when an argument is not a number, which the result shows.
fn is_near(distances: [f64; 3]) -> bool {
    !distances.iter().any(|distance| distance.abs() > NEAR)
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;

    /// Values of section 3 of the paper.
    #[test]
    fn the_published_values_are_met() {
        let near = |found: f64, published: f64| {
            assert_relative_eq!(found, published, max_relative = 1e-13);
        };
        near(rf(2.0, 3.0, 4.0), 0.584_082_841_677_15);
        near(rd(2.0, 3.0, 4.0), 0.165_105_272_942_61);
        near(rg(2.0, 3.0, 4.0), 1.725_503_028_069_2);
        near(rf(0.0, 1.0, 2.0), 1.311_028_777_146_1);
        near(rd(0.0, 2.0, 1.0), 1.797_210_352_103_4);
        near(rg(0.0, 0.0796, 4.0), 1.028_475_809_028_8);
    }

    #[test]
    fn equal_arguments_give_powers() {
        assert_relative_eq!(rf(4.0, 4.0, 4.0), 0.5, max_relative = 1e-15);
        assert_relative_eq!(rd(4.0, 4.0, 4.0), 0.125, max_relative = 1e-15);
        assert_relative_eq!(rg(4.0, 4.0, 4.0), 2.0, max_relative = 1e-15);
    }

    #[test]
    fn arguments_far_apart_lose_nothing() {
        // R_F(x, y, y) = arccos(sqrt(x/y)) / sqrt(y - x) for x < y.
        let (x, y) = (1e-20_f64, 1e4_f64);
        let exact = (x / y).sqrt().acos() / (y - x).sqrt();
        assert_relative_eq!(rf(x, y, y), exact, max_relative = 1e-14);
        assert_relative_eq!(rf(y, x, y), exact, max_relative = 1e-14);
    }

    #[test]
    fn arguments_out_of_range_end_without_a_number() {
        assert!(rf(0.0, 0.0, 0.0).is_nan());
        assert!(rg(f64::NAN, 1.0, 1.0).is_nan());
    }
}
