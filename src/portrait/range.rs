//! Ranges of numbers that colours stand for, and marks that are read easily.

/// Share of the numbers that a range holds.
const HELD: f64 = 0.99;

/// From which number to which colours go.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Range {
    /// The lower end.
    pub(super) low: f64,
    /// The upper end.
    pub(super) high: f64,
}

impl Range {
    /// As far below zero as above, to a round number: of numbers with a sign. Not finite ones do not count.
    pub(super) fn signed(values: &[f64]) -> Self {
        let sizes = sorted(values.iter().map(|value| value.abs()));
        let held = sizes
            .get((HELD * sizes.len() as f64) as usize)
            .or(sizes.last());
        let high = round_up(held.copied().unwrap_or(1.0));
        Self { low: -high, high }
    }

    /// From about the least to about the largest number. Not finite ones do not count.
    pub(super) fn of(values: &[f64]) -> Self {
        let sorted = sorted(values.iter().copied());
        let at = |share: f64| sorted.get((share * (sorted.len() as f64 - 1.0)).round() as usize);
        let ends = at(0.5 - 0.5 * HELD).zip(at(0.5 + 0.5 * HELD));
        let (low, high) = ends.map_or((0.0, 1.0), |(low, high)| (*low, *high));
        let least = match low.abs().max(high.abs()) {
            0.0 => 1.0,
            size => 1e-6 * size,
        };
        Self {
            low,
            high: high.max(low + least),
        }
    }

    /// Where a number lies: 0 at the lower end, 1 at the upper one, no further.
    pub(super) fn share(&self, value: f64) -> f64 {
        match value.is_nan() {
            true => f64::NAN,
            false => ((value - self.low) / (self.high - self.low)).clamp(0.0, 1.0),
        }
    }

    /// Round numbers within the range, five to eleven of them.
    pub(super) fn marks(&self) -> Vec<f64> {
        let step = round_up((self.high - self.low) / 10.0);
        let first = (self.low / step - 1e-6).ceil() as i64;
        let last = (self.high / step + 1e-6).floor() as i64;
        (first..=last).map(|mark| mark as f64 * step).collect()
    }
}

fn sorted(values: impl Iterator<Item = f64>) -> Vec<f64> {
    let mut sorted: Vec<f64> = values.filter(|value| value.is_finite()).collect();
    sorted.sort_unstable_by(f64::total_cmp);
    sorted
}

/// The least of 1, 2 and 5 times a power of ten that is as large.
fn round_up(value: f64) -> f64 {
    let power = power_of_ten(value);
    let factors = [1.0, 2.0, 5.0].into_iter();
    let mut large = factors.filter(|factor| factor * power >= value * (1.0 - 1e-9));
    large.next().unwrap_or(10.0) * power
}

/// The largest of them that is as small.
pub(super) fn round_down(value: f64) -> f64 {
    let power = power_of_ten(value);
    let factors = [5.0, 2.0].into_iter();
    let mut small = factors.filter(|factor| factor * power <= value * (1.0 + 1e-9));
    small.next().unwrap_or(1.0) * power
}

fn power_of_ten(value: f64) -> f64 {
    match value > 0.0 && value.is_finite() {
        true => 10_f64
            .powi(value.log10().floor() as i32)
            .max(f64::MIN_POSITIVE),
        false => 1.0,
    }
}

/// A mark in the fewest digits.
pub(super) fn label(mark: f64) -> String {
    let rounded: f64 = format!("{mark:.3e}").parse().unwrap_or(mark);
    match rounded == 0.0 || (1e-4..1e5).contains(&rounded.abs()) {
        true => rounded.to_string(),
        false => format!("{rounded:e}"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ranges_are_round_and_hold_nearly_all() {
        let mut values: Vec<f64> = (0..1000).map(|i| f64::from(i) * -1e-5).collect();
        values.extend([f64::NAN, 7.0]);
        let range = Range::signed(&values);
        assert_eq!([range.low, range.high], [-0.01, 0.01]);
        let labels: Vec<String> = range.marks().into_iter().map(label).collect();
        assert_eq!(
            labels,
            [
                "-0.01", "-0.008", "-0.006", "-0.004", "-0.002", "0", "0.002", "0.004", "0.006",
                "0.008", "0.01"
            ]
        );
        assert_eq!([range.share(0.0), range.share(7.0)], [0.5, 1.0]);
        assert!(range.share(f64::NAN).is_nan());
    }

    #[test]
    fn nothing_and_one_number_have_a_range() {
        for values in [vec![], vec![0.0; 3], vec![2.5], vec![1e-310]] {
            for range in [Range::signed(&values), Range::of(&values)] {
                assert!(range.low < range.high, "{values:?}");
                assert!(range.marks().len() < 20);
            }
        }
    }

    #[test]
    fn scale_bars_are_round() {
        assert_eq!([3.0, 0.5, 0.049].map(round_down), [2.0, 0.5, 0.02]);
    }
}
