//! Numbers on the command line: counts, shares, bytes, and several at once.

use nalgebra::Vector3;
use std::num::{IntErrorKind, ParseIntError};
use std::str::FromStr;

/// Three components of a vector, separated by commas.
pub(super) fn vector(text: &str) -> Result<Vector3<f64>, String> {
    let numbers: Result<Vec<f64>, _> = text.split(',').map(|part| part.trim().parse()).collect();
    match numbers.as_deref() {
        Ok(&[x, y, z]) if [x, y, z].iter().all(|x| x.is_finite()) => Ok(Vector3::new(x, y, z)),
        _ => Err("expected three finite numbers such as 10,0,-2.5".into()),
    }
}

/// Two numbers, separated by a comma.
pub(super) fn pair(text: &str) -> Result<[f64; 2], String> {
    let numbers: Result<Vec<f64>, _> = text.split(',').map(|part| part.trim().parse()).collect();
    match numbers.as_deref() {
        Ok(&[x, y]) => Ok([x, y]),
        _ => Err("expected two numbers such as 60,40".into()),
    }
}

/// The label of a grain in a volume.
pub(super) fn label(text: &str) -> Result<i64, &'static str> {
    text.parse().map_err(|_| "expected a whole number")
}

/// Cells along an edge of the cube of directions.
pub(super) fn resolution(text: &str) -> Result<u16, &'static str> {
    let found = text.parse().ok().filter(|cells| *cells > 0);
    found.ok_or("expected a whole number from 1 to 2886")
}

/// An angle in degrees.
pub(super) fn angle(text: &str) -> Result<f64, &'static str> {
    let found = text.parse().ok().filter(|angle: &f64| angle.is_finite());
    found.ok_or("expected a number of degrees")
}

/// The exponents n1 and n2, separated by a comma.
pub(super) fn exponents(text: &str) -> Result<[f64; 2], &'static str> {
    let found = numbers(text).and_then(|numbers| numbers.try_into().ok());
    found.ok_or("expected two numbers N1,N2 such as 4,2")
}

/// Numbers, separated by commas.
pub(super) fn numbers(text: &str) -> Option<Vec<f64>> {
    let numbers = text.split(',').map(|number| number.trim().parse().ok());
    numbers.collect()
}

/// A whole number that counts something, or a seed.
pub(super) fn count<T: FromStr<Err = ParseIntError>>(text: &str) -> Result<T, &'static str> {
    text.parse()
        .map_err(|error: ParseIntError| match error.kind() {
            IntErrorKind::PosOverflow => "it is too large",
            _ => "expected a whole number of zero or more",
        })
}

/// A share, as a percentage or not.
pub(super) fn share(text: &str) -> Result<f64, &'static str> {
    let (number, scale) = match text.strip_suffix('%') {
        Some(percentage) => (percentage.trim_end(), 100.0),
        None => (text, 1.0),
    };
    let number: f64 = number
        .parse()
        .map_err(|_| "expected a share such as 0.5% or 0.005")?;
    Ok(number / scale)
}

/// A number of bytes: digits, and k, M or G, in either case, for thousands, millions and billions.
pub(super) fn bytes(text: &str) -> Result<u64, &'static str> {
    let suffixes = [('k', 1_000), ('m', 1_000_000), ('g', 1_000_000_000)];
    let either_case = |suffix: char| [suffix, suffix.to_ascii_uppercase()];
    let suffixed = suffixes
        .iter()
        .find_map(|(suffix, scale)| Some((text.strip_suffix(either_case(*suffix))?, *scale)));
    let (digits, scale) = suffixed.unwrap_or((text, 1));
    let count: Option<u64> = digits.parse().ok();
    count
        .and_then(|count| count.checked_mul(scale))
        .filter(|count| *count > 0)
        .ok_or("expected a number of bytes above zero such as 500M or 4G")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn shares_are_percentages_or_not() {
        assert_eq!(share("0.5%"), Ok(0.005));
        assert_eq!(share("0.5 %"), Ok(0.005));
        assert_eq!(share("0.005"), Ok(0.005));
        assert!(share("%").is_err());
    }

    #[test]
    fn counts_are_whole_and_not_negative() {
        assert_eq!(count("0"), Ok(0_usize));
        for text in ["", "-1", "1.5", "x"] {
            assert!(count::<usize>(text).unwrap_err().contains("zero or more"));
        }
        let most = count::<u64>("18446744073709551616");
        assert_eq!(most, Err("it is too large"));
    }

    #[test]
    fn bytes_have_decimal_suffixes() {
        assert_eq!(bytes("1G"), Ok(crate::scan::MAX_BYTES));
        assert_eq!(bytes("12k"), Ok(12_000));
        for (lower, upper) in [("3k", "3K"), ("3m", "3M"), ("3g", "3G")] {
            assert_eq!(bytes(lower), bytes(upper));
        }
        assert_eq!(bytes("7"), Ok(7));
        for text in ["", "0", "-1", "1T", "99999999999G", "1.5G"] {
            assert!(bytes(text).is_err(), "{text}");
        }
    }
}
