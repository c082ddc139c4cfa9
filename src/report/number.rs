//! Numbers for people.

use crate::digits::significant;

/// Six significant digits; powers of ten where plain digits would be many.
pub fn short(value: f64) -> String {
    significant(value, 6)
}

/// Share of a figure that its digits hold.
const SHOWN: f64 = 1e-6;

/// A figure and its standard error, both to the error's second digit: `256.313 ± 0.012`.
pub(super) fn with_error(value: f64, error: Option<f64>) -> String {
    let Some(error) = error.filter(|error| *error > 0.0 && error.is_finite()) else {
        return short(value);
    };
    let decimals = (1 - error.log10().floor() as i32).clamp(0, 12) as usize;
    if !(1e-4..1e7).contains(&value.abs()) || decimals > 9 {
        return format!("{} ± {error:.1e}", short(value));
    }
    format!("{value:.decimals$} ± {error:.decimals$}")
}

/// A figure in its unit with its standard error or else, where that counts, how well it is integrated, as a share.
pub(super) fn integrated(value: f64, error: Option<f64>, share: Option<f64>, unit: &str) -> String {
    let by_quadrature = value * share.unwrap_or(0.0);
    match error {
        Some(error) => with_error(value, Some(error.hypot(by_quadrature))) + unit,
        None if by_quadrature > SHOWN * value => {
            let share = significant(100.0 * by_quadrature / value, 2);
            format!("{}{unit}, integrated to {share} %", short(value))
        }
        None => short(value) + unit,
    }
}

/// The components of a vector; those that are nothing but rounding beside the others as zero.
pub(super) fn triple(components: [f64; 3]) -> String {
    let [row] = triples([components]);
    row
}

/// Share of a length of their own to which places are told that have no errors.
pub(super) const PLACED_TO: f64 = 1e-3;

/// The components of a place, to the second digit of a length that counts, for a scan may lie far from its origin.
pub(super) fn place(components: [f64; 3], length: f64) -> String {
    let last = length.log10().floor() - 1.0;
    let digits = |x: f64| {
        let needed = x.abs().log10().floor() - last + 1.0;
        (needed as i32).clamp(6, 15)
    };
    let shown = |x: f64| {
        let is_shown = x.abs() >= 10_f64.powf(last);
        significant(if is_shown { x } else { 0.0 }, digits(x))
    };
    components.map(shown).join("  ")
}

/// The rows of a tensor; what is nothing but rounding beside its largest component as zero, so that one that is symmetric stays so.
pub(super) fn triples<const N: usize>(rows: [[f64; 3]; N]) -> [String; N] {
    let components = rows.as_flattened().iter();
    let largest = components.fold(0.0, |most: f64, x| most.max(x.abs()));
    let is_rounding = |x: f64| x.abs() < 1e-12 * largest;
    rows.map(|row| {
        row.map(|x| short(if is_rounding(x) { 0.0 } else { x }))
            .join("  ")
    })
}

/// Without the last digits of a product: 0.3 and not 0.30000000000000004.
pub(crate) fn round(value: f64) -> f64 {
    (value * 1e9).round() / 1e9
}

/// A signed share as a percentage: `-0.123 %`.
pub fn percent(share: f64) -> String {
    // What is rounded to zero has no sign of its own.
    format!("{:+.3} %", (1e5 * share).round() / 1e3 + 0.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn places_are_told_as_far_as_a_length_counts_however_far_they_lie_from_the_origin() {
        assert_eq!(
            place([1_000_002.405_343_2, -3e-9, 0.25], 2.2e-5),
            "1000002.405343  0  0.250000"
        );
        assert_eq!(place([1.5, 2e-7, -30.0], 0.1), "1.50000  0  -30.0000");
    }

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
        let rows = triples([[2.0, -3e-12, 0.5], [-3e-12, 4.0, 0.0], [0.5, 0.0, 5.0]]);
        let told = [
            "2.00000  0  0.500000",
            "0  4.00000  0",
            "0.500000  0  5.00000",
        ];
        assert_eq!(rows, told);
        assert_eq!(with_error(256.312_77, Some(0.012_3)), "256.313 ± 0.012");
        assert_eq!(with_error(25_243.51, Some(31.4)), "25244 ± 31");
        assert_eq!(with_error(8.45e-5, Some(3.2e-8)), "8.45000e-5 ± 3.2e-8");
        assert_eq!(with_error(2.0, None), "2.00000");
        assert_eq!(percent(-0.001_234), "-0.123 %");
    }
}
