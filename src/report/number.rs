//! Numbers for people.

/// Six significant digits; powers of ten where plain digits would be many.
pub fn short(value: f64) -> String {
    let size = value.abs();
    if value == 0.0 {
        return "0".into();
    }
    if !value.is_finite() {
        return value.to_string();
    }
    if !(1e-4..1e7).contains(&size) {
        return format!("{value:.5e}");
    }
    let decimals = (5 - size.log10().floor() as i32).clamp(0, 9) as usize;
    format!("{value:.decimals$}")
}

/// The components of a vector; those that are nothing but rounding beside the others as zero.
pub(super) fn triple(components: [f64; 3]) -> String {
    let largest = components
        .into_iter()
        .fold(0.0, |most: f64, x| most.max(x.abs()));
    let is_rounding = |x: f64| x.abs() < 1e-12 * largest;
    components
        .map(|x| short(if is_rounding(x) { 0.0 } else { x }))
        .join("  ")
}

/// A signed share as a percentage: `-0.123 %`.
pub fn percent(share: f64) -> String {
    format!("{:+.3} %", 100.0 * share)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn six_digits_are_kept_at_any_size() {
        let cases = [
            (-0.0, "0"),
            (243.871_234, "243.871"),
            (-1.5, "-1.50000"),
            (0.001_234_567, "0.00123457"),
            (1e-9, "1.00000e-9"),
            (6_543_210.4, "6543210"),
            (2e12, "2.00000e12"),
        ];
        for (value, text) in cases {
            assert_eq!(short(value), text);
        }
        assert_eq!(triple([3.0, 1e-16, -0.25]), "3.00000  0  -0.250000");
        assert_eq!(percent(-0.001_234), "-0.123 %");
    }
}
