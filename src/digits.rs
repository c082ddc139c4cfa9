//! Numbers as text for people, never in more digits than can be read.

/// Sizes that are written without a power of ten.
const PLAIN: std::ops::Range<f64> = 1e-4..1e7;

/// So many significant digits; powers of ten where plain digits would be many.
pub(crate) fn significant(value: f64, digits: i32) -> String {
    let size = value.abs();
    if value == 0.0 {
        return "0".into();
    }
    if !value.is_finite() {
        return value.to_string();
    }
    if !PLAIN.contains(&size) {
        return format!("{value:.*e}", (digits - 1).max(0) as usize);
    }
    let decimals = (digits - 1 - size.log10().floor() as i32).clamp(0, 9) as usize;
    format!("{value:.decimals$}")
}

/// A number that somebody gave, in all of its own digits: with a power of ten where plain digits would be many.
pub(crate) fn given(value: f64) -> String {
    match value == 0.0 || !value.is_finite() || PLAIN.contains(&value.abs()) {
        true => value.to_string(),
        false => format!("{value:e}"),
    }
}

/// `1 row`, `2 rows`.
pub(crate) fn plural(count: usize, noun: &str) -> String {
    let s = if count == 1 { "" } else { "s" };
    format!("{count} {noun}{s}")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_number_is_longer_than_can_be_read() {
        assert_eq!(significant(0.378_12, 3), "0.378");
        assert_eq!(significant(1e-9, 3), "1.00e-9");
        let cases = [
            (0.0, "0"),
            (2500.0, "2500"),
            (-0.3, "-0.3"),
            (1e300, "1e300"),
            (-2.5e-7, "-2.5e-7"),
            (f64::INFINITY, "inf"),
            (f64::NAN, "NaN"),
        ];
        for (value, text) in cases {
            assert_eq!(given(value), text);
        }
    }
}
