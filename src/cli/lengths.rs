//! Lengths as arguments.

/// A length that a body can have.
pub(super) fn length(text: &str) -> Result<f64, &'static str> {
    above_zero(text).ok_or("expected a finite length above zero such as 2.5")
}

/// Two of them, separated by a comma.
pub(super) fn lengths(text: &str) -> Result<[f64; 2], &'static str> {
    let told = text.split_once(',');
    let found = told.and_then(|(one, other)| Some([above_zero(one)?, above_zero(other)?]));
    found.ok_or("expected two finite lengths above zero such as 60,40")
}

fn above_zero(text: &str) -> Option<f64> {
    let value: f64 = text.trim().parse().ok()?;
    (value > 0.0 && value.is_finite()).then_some(value)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lengths_are_finite_and_above_zero() {
        assert_eq!(length("2.5"), Ok(2.5));
        assert_eq!(lengths("60, 40"), Ok([60.0, 40.0]));
        for text in ["0", "-1", "inf", "nan", "1,2", ""] {
            assert!(length(text).is_err(), "{text}");
        }
        for text in ["1", "1,0", "inf,2", "1,2,3"] {
            assert!(lengths(text).is_err(), "{text}");
        }
    }
}
