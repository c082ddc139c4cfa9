//! Directions of any length.

use nalgebra::Vector3;

/// The unit vector along `n`, of any length but zero. Of zero, and of what is not finite, no number.
#[inline]
pub(crate) fn unit(n: &Vector3<f64>) -> Vector3<f64> {
    let squared = n.norm_squared();
    match squared.is_normal() {
        true => n / squared.sqrt(),
        // The square is beyond the range of numbers.
        false => (n / n.amax()).normalize(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;

    #[test]
    fn any_length_but_zero_will_do() {
        let expected = Vector3::new(0.6, 0.0, -0.8);
        for length in [1e-307, 1e-200, 1e-154, 1.0, 3.0, 1e154, 1e200, 1.7e308] {
            let n = Vector3::new(0.6 * length, 0.0, -0.8 * length);
            assert_relative_eq!(unit(&n), expected, epsilon = 1e-15);
        }
        for none in [0.0, f64::NAN, f64::INFINITY] {
            let found = unit(&Vector3::new(0.0, none, 0.0));
            assert!(found.iter().any(|x| x.is_nan()), "{none}");
        }
    }
}
