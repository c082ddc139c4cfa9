//! Logarithmic axes.

use std::ops::Range;

/// Room beyond the outermost values, as a share of the axis.
const MARGIN: f64 = 0.04;

/// The multiples of powers of ten that are marked.
const FINE: &[f64] = &[1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0, 9.0];

/// Those of a short axis, where 1 and 2 are far apart.
const FINEST: &[f64] = &[1.0, 1.5, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0, 9.0];

/// Those that are labelled on an axis of so many decades, so that labels are neither few nor dense.
fn labelled(decades: f64) -> &'static [f64] {
    match decades {
        ..1.0 => FINEST,
        ..3.0 => &[1.0, 2.0, 5.0],
        _ => &[1.0],
    }
}

/// The range of a logarithmic axis and its marks.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct LogAxis {
    pub(super) range: Range<f64>,
    /// Marks with a number.
    pub(super) labelled: Vec<f64>,
    /// Marks without: 1 to 9 times every power of ten.
    pub(super) fine: Vec<f64>,
}

impl LogAxis {
    /// The axis that holds these positive values; from 0.1 to 10 if there are none.
    pub(super) fn new(values: impl Iterator<Item = f64>) -> Self {
        let (low, high) = values
            .filter(|value| value.is_normal() && *value > 0.0)
            .map(f64::log10)
            .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), x| {
                (low.min(x), high.max(x))
            });
        let (low, high) = match low <= high {
            true => (low, high.max(low + 0.5)),
            false => (-1.0, 1.0),
        };
        let margin = MARGIN * (high - low);
        let range = 10_f64.powf(low - margin)..10_f64.powf(high + margin);
        let marks = |factors: &[f64]| {
            let decades = (low - margin).floor() as i32..=(high + margin).ceil() as i32;
            decades
                .flat_map(|decade| factors.iter().map(move |f| f * 10_f64.powi(decade)))
                .filter(|mark| range.contains(mark))
                .collect()
        };
        Self {
            labelled: marks(labelled(high - low)),
            fine: marks(FINE),
            range,
        }
    }
}

/// The number of a mark, of at most two digits: `0.002`, `15`, `1e-6`.
pub(super) fn label(mark: f64) -> String {
    let decimals = (1.0 - (mark * 1.001).log10().floor()).max(0.0) as usize;
    let digits = format!("{mark:.decimals$}").parse().unwrap_or(mark);
    match (1e-4..1e5).contains(&(mark * 1.001)) {
        true => format!("{digits}"),
        false => format!("{digits:e}"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn marks_lie_in_the_range_and_are_read_easily() {
        let axis = LogAxis::new([0.0, 0.03, 72.0, f64::NAN].into_iter());
        assert!(axis.range.contains(&0.03) && axis.range.contains(&72.0));
        let labels = |values: [f64; 2]| -> Vec<String> {
            let axis = LogAxis::new(values.into_iter());
            axis.labelled.into_iter().map(label).collect()
        };
        assert_eq!(labels([4.0, 60.0]), ["5", "10", "20", "50"]);
        assert_eq!(labels([0.65, 2.4]), ["0.7", "0.8", "0.9", "1", "1.5", "2"]);
        assert_eq!(labels([0.03, 72.0]), ["0.1", "1", "10"]);
        assert_eq!(label(1e-7), "1e-7");
        assert_eq!(label(1.5 * 10_f64.powi(-3)), "0.0015");
        assert_eq!(label(3.0 * 10_f64.powi(-6)), "3e-6");
        assert_eq!(label(2e5), "2e5");
        assert_eq!(label(0.001), "0.001");
    }

    #[test]
    fn nothing_and_one_value_still_make_an_axis() {
        for values in [vec![], vec![3.0], vec![0.0, f64::INFINITY]] {
            let axis = LogAxis::new(values.into_iter());
            assert!(axis.range.start < axis.range.end && axis.range.start > 0.0);
            assert!(!axis.labelled.is_empty());
        }
    }
}
