//! Ratios that cannot leave their range: what does is an error of the body or of the measuring, not a figure.

use thiserror::Error;

/// By how much a ratio may leave its range for its own error; it is then set to the bound.
///
/// Figures that are taken of meshes are good to 1e-4; a sphere's ratios are at their bound.
const ERROR: f64 = 2e-4;

/// A ratio outside of the range that its definition allows.
#[derive(Debug, Clone, Copy, PartialEq, Error)]
#[error("its {name} would be {value:.4}, outside of what is possible ({least} to {largest})")]
pub struct OutOfBounds {
    /// Which.
    pub name: &'static str,
    /// The value found.
    pub value: f64,
    /// The least value possible.
    pub least: f64,
    /// The largest value possible.
    pub largest: f64,
}

/// A number from `least` to `largest`, both included; what is outside by its own error is set to the bound.
///
/// # Errors
///
/// [`OutOfBounds`] for others, NaN among them.
pub(super) fn between(
    name: &'static str,
    value: f64,
    [least, largest]: [f64; 2],
) -> Result<f64, OutOfBounds> {
    let slack = ERROR * least.abs().max(largest.abs().min(1.0));
    if value >= least - slack && value <= largest + slack && value.is_finite() {
        return Ok(value.clamp(least, largest));
    }
    Err(OutOfBounds {
        name,
        value,
        least,
        largest,
    })
}

/// A ratio above 0 to 1.
///
/// # Errors
///
/// As [`between`]; 0 too is outside.
pub(in crate::measure) fn ratio(name: &'static str, value: f64) -> Result<f64, OutOfBounds> {
    if value > 0.0 {
        return between(name, value, [0.0, 1.0]);
    }
    Err(OutOfBounds {
        name,
        value,
        least: 0.0,
        largest: 1.0,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ratios_keep_to_their_range() {
        assert_eq!(ratio("r", 0.3), Ok(0.3));
        assert_eq!(ratio("r", 1.0 + 1e-5), Ok(1.0));
        for value in [0.0, -1e-9, -3.0, 1.1, 4.98, f64::NAN, f64::INFINITY] {
            assert!(ratio("r", value).is_err(), "{value}");
        }
        assert_eq!(between("r", 1.0 - 1e-5, [1.0, f64::INFINITY]), Ok(1.0));
        assert!(between("r", 0.9, [1.0, f64::INFINITY]).is_err());
        assert!(between("r", f64::INFINITY, [1.0, f64::INFINITY]).is_err());
    }
}
