//! The tables, in Markdown.

use crate::curves::{Curves, cheapest};
use grainform::bench::BenchRow;

/// The levels of held-out RMS, as shares of the mean radius.
pub(crate) const LEVELS: [f64; 7] = [0.02, 0.01, 0.005, 0.002, 0.001, 0.0005, 0.0002];

/// Head of the table of costs.
pub(crate) const COSTS: &str = "\
Fewest coefficients within a level of held-out RMS (% of the mean radius), coefficients touched per
evaluation, and milliseconds of the fit; - where no fit is within the level. Fits that miss a point by
more than the search accepts do not count, but for scans marked *, of which no fit does better.

| scan | RMS | least squares, L <= 20 | k x k, L <= 3 | k x k, L <= 6 | estimate | cells | plain dense |
|---|---|---|---|---|---|---|---|";

/// Head of the table of verdicts.
pub(crate) const VERDICTS: &str = "\
Cells against their rivals at equal held-out RMS, and whether the goal holds. Where the rival is not
within the level, its largest fit stands in for it, marked <: the true ratio is lower.

| scan | RMS | coefficients / k x k, L <= 3: <= 0.5 | touched / estimate <= 0.5 | seconds / plain dense <= 1 |
|---|---|---|---|---|";

/// The cheapest fits within a level.
pub(crate) fn costs(curves: &Curves, level: f64) -> String {
    let cells = [
        cheapest(&curves.whole, level),
        cheapest(curves.low(), level),
        cheapest(&curves.uniform, level),
        cheapest(&curves.estimate, level),
        cheapest(&curves.adaptive, level),
    ]
    .map(|row| row.map_or("-".into(), cost));
    let dense = 1e3 * curves.dense_seconds(level);
    format!(
        "| {} | {} | {} | {dense:.0} ms |",
        curves.scan,
        100.0 * level,
        cells.join(" | "),
    )
}

fn cost(row: &BenchRow) -> String {
    format!(
        "{}, {:.0}, {:.1} ms",
        row.coefficients,
        row.touched,
        1e3 * row.seconds
    )
}

/// How the cells within a level compare.
pub(crate) fn verdicts(curves: &Curves, level: f64) -> String {
    let adaptive = cheapest(&curves.adaptive, level);
    let low = Rival::new(
        cheapest(curves.low(), level),
        curves.low().max_by_key(|row| row.coefficients),
    );
    let estimate = Rival::new(cheapest(&curves.estimate, level), curves.estimate.last());
    let cells = [
        low.compare(adaptive, |row| row.coefficients as f64, 0.5),
        estimate.compare(adaptive, |row| row.touched, 0.5),
        adaptive.map_or("-".into(), |row| {
            let ratio = row.seconds / curves.dense_seconds(level);
            let is_bound = cheapest(&curves.whole, level).is_none();
            verdict(ratio, is_bound, 1.0)
        }),
    ];
    let (scan, level) = (&curves.scan, 100.0 * level);
    format!("| {scan} | {level} | {} |", cells.join(" | "))
}

/// What a fit is compared with.
struct Rival<'a> {
    row: Option<&'a BenchRow>,
    falls_short: bool,
}

impl<'a> Rival<'a> {
    /// The fit within the level, or else the largest one.
    fn new(within: Option<&'a BenchRow>, largest: Option<&'a BenchRow>) -> Self {
        Self {
            row: within.or(largest),
            falls_short: within.is_none(),
        }
    }

    fn compare(&self, row: Option<&BenchRow>, cost: fn(&BenchRow) -> f64, most: f64) -> String {
        match (row, self.row) {
            (Some(row), Some(rival)) => verdict(cost(row) / cost(rival), self.falls_short, most),
            _ => "-".into(),
        }
    }
}

fn verdict(ratio: f64, is_bound: bool, most: f64) -> String {
    let sign = if is_bound { "< " } else { "" };
    let word = match (ratio <= most, is_bound) {
        (true, _) => "holds",
        (false, true) => "open",
        (false, false) => "fails",
    };
    format!("{sign}{ratio:.2} {word}")
}
