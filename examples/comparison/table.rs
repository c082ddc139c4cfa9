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

| scan | RMS | whole, L <= 20 | uniform, L <= 3 | uniform, L <= 6 | adaptive, L <= 3 | adaptive, free | plain dense |
|---|---|---|---|---|---|---|---|";

/// Head of the table of verdicts.
pub(crate) const VERDICTS: &str = "\
Ratios at equal held-out RMS, and whether the goal holds. Where the rival is not within the level, its
largest fit stands in for it, marked <: the true ratio is lower.

| scan | RMS | free / min(whole, uniform) <= 1.1 | adaptive / uniform, L <= 3: <= 0.5 | touched / whole <= 0.2 | seconds / whole <= 0.1 | seconds / plain dense <= 0.1 |
|---|---|---|---|---|---|---|";

/// The cheapest fits within a level.
pub(crate) fn costs(curves: &Curves, level: f64) -> String {
    let cells = [
        cheapest(&curves.whole, level),
        cheapest(curves.low(), level),
        cheapest(&curves.uniform, level),
        cheapest(&curves.adaptive, level),
        cheapest(&curves.free, level),
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

/// How the fits within a level compare.
pub(crate) fn verdicts(curves: &Curves, level: f64) -> String {
    let whole = cheapest(&curves.whole, level);
    let low = cheapest(curves.low(), level);
    let adaptive = cheapest(&curves.adaptive, level);
    let free = cheapest(&curves.free, level);
    let fewest = cheapest(curves.whole.iter().chain(&curves.uniform), level);
    let coefficients = |row: &BenchRow| row.coefficients as f64;
    let seconds = |row: &BenchRow| row.seconds;
    let largest = curves.whole.last();
    let largest_low = curves.low().max_by_key(|row| row.coefficients);
    let rival = Rival::new(fewest, largest);
    let cells = [
        rival.compare(free, coefficients, 1.1),
        Rival::new(low, largest_low).compare(adaptive, coefficients, 0.5),
        match (adaptive, Rival::new(whole, largest)) {
            (Some(row), rival) => rival.judge(row.touched, coefficients, 0.2),
            (None, _) => "-".into(),
        },
        Rival::new(whole, largest).compare(adaptive, seconds, 0.1),
        adaptive.map_or("-".into(), |row| {
            let ratio = row.seconds / curves.dense_seconds(level);
            verdict(ratio, whole.is_none(), 0.1)
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
        row.map_or("-".into(), |row| self.judge(cost(row), cost, most))
    }

    fn judge(&self, own: f64, cost: fn(&BenchRow) -> f64, most: f64) -> String {
        self.row.map_or("-".into(), |rival| {
            verdict(own / cost(rival), self.falls_short, most)
        })
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
