//! What the grains of a batch are like together.

use super::columns::{Column, FIRST};
use super::gaps::Gaps;
use super::journal::Row;
use super::own_error::own_error;
use crate::digits::plural;
use crate::spread::PER_MEDIAN;
use serde::Serialize;
use std::collections::BTreeSet;

/// The measures by which grains are compared, as far as they are there, and whether they have a unit.
const MAIN: [(&str, bool); 11] = [
    ("area", true),
    ("volume", true),
    ("dimensions.length", true),
    ("dimensions.width", true),
    ("dimensions.thickness", true),
    ("form.elongation", false),
    ("form.flatness", false),
    ("sphericity.wadell", false),
    ("roundness", false),
    ("convexity.volume", false),
    ("heldout_rms", true),
];

/// Quantiles that are told.
const QUANTILES: [f64; 7] = [0.0, 0.05, 0.25, 0.5, 0.75, 0.95, 1.0];

/// Robust z-score beyond which a grain is worth a look (Iglewicz and Hoaglin 1993), and so many of its own errors.
const OUTLYING: f64 = 3.5;

/// Standard deviation over mean absolute deviation of a normal distribution.
const PER_MEAN: f64 = 1.253_314_137_315_500_3;

/// Grains of the smallest population that has outliers.
const LEAST_GRAINS: usize = 8;

/// What the grains of a batch are like together.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[non_exhaustive]
pub(crate) struct Population {
    /// Number of grains with a result.
    pub grains: usize,
    /// The main measures.
    pub measures: Vec<Statistics>,
    /// Correlation (Pearson) of each of the main measures with each, in their order, over the grains of which both are
    /// known; `null` where there are fewer than three or one does not vary.
    pub correlations: Vec<Vec<Option<f64>>>,
    /// Grains that are worth a look.
    pub outliers: Vec<Outlier>,
    /// What is odd about their units, what is not known of all of them, and how many have warnings of their own: whole
    /// sentences.
    pub warnings: Vec<String>,
    /// The units of length that are told of the grains, and how many tell none.
    #[serde(skip)]
    units: BTreeSet<String>,
    #[serde(skip)]
    unitless: usize,
    /// How many have warnings of their own.
    #[serde(skip)]
    warned: usize,
    #[serde(skip)]
    gaps: Gaps,
    #[serde(skip)]
    paths: Vec<String>,
    /// Of every main measure, the values of all grains, ...
    #[serde(skip)]
    values: Vec<Vec<Option<f64>>>,
    /// ... and their standard errors.
    #[serde(skip)]
    errors: Vec<Vec<Option<f64>>>,
    /// Positions of the main measures and of their standard errors among the figures of a row; none of what stands before
    /// them, or is not there.
    #[serde(skip)]
    positions: Vec<[Option<usize>; 2]>,
}

/// One measure over all grains.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[non_exhaustive]
pub(crate) struct Statistics {
    /// Name of the column.
    pub measure: String,
    /// Grains of which it is known.
    pub count: usize,
    /// Mean.
    pub mean: f64,
    /// Standard deviation; `null` of one grain.
    pub deviation: Option<f64>,
    /// Smallest, 5 %, 25 %, 50 %, 75 %, 95 %, largest, between neighbours by linear interpolation.
    pub quantiles: [f64; QUANTILES.len()],
}

/// A grain that is unlike most others.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[non_exhaustive]
pub(crate) struct Outlier {
    /// The scan.
    pub path: String,
    /// The measure by which it is.
    pub measure: String,
    /// Its value.
    pub value: f64,
    /// Difference from the median over 1.4826 times the median absolute deviation.
    pub z: f64,
    /// The same as a sentence.
    pub reason: String,
}

impl Population {
    /// No grains yet, with these columns.
    pub(super) fn new(columns: &[Column]) -> Self {
        let at = |name: &str| columns.iter().position(|column| column.name == name);
        let main = MAIN.map(|(name, _)| (name, at(name), at(&format!("{name}_se"))));
        let main: Vec<_> = main.into_iter().filter(|(_, at, _)| at.is_some()).collect();
        let among_figures = |at: Option<usize>| at?.checked_sub(FIRST.len());
        Self {
            grains: 0,
            measures: main
                .iter()
                .map(|(name, ..)| Statistics {
                    measure: (*name).into(),
                    count: 0,
                    mean: 0.0,
                    deviation: None,
                    quantiles: [0.0; QUANTILES.len()],
                })
                .collect(),
            correlations: Vec::new(),
            outliers: Vec::new(),
            warnings: Vec::new(),
            units: BTreeSet::new(),
            unitless: 0,
            warned: 0,
            gaps: Gaps::new(columns.iter().map(|column| column.name.as_str())),
            paths: Vec::new(),
            values: vec![Vec::new(); main.len()],
            errors: vec![Vec::new(); main.len()],
            positions: main
                .iter()
                .map(|(_, at, error)| [*at, *error].map(among_figures))
                .collect(),
        }
    }

    /// Adds a grain.
    pub(super) fn add(&mut self, row: &Row) {
        self.grains += 1;
        self.paths.push(row.path.clone());
        self.units.extend(row.unit.clone());
        self.unitless += usize::from(row.unit.is_none());
        self.warned += usize::from(!row.warnings.is_empty());
        let figure = |at: usize| row.figures.get(at).copied().flatten();
        let is_known = |at: usize| at.checked_sub(FIRST.len()).and_then(figure).is_some();
        let not_measured = row.not_measured.iter().map(String::as_str);
        self.gaps.hear(is_known, not_measured);
        let columns = self.values.iter_mut().zip(&mut self.errors);
        for ((values, errors), [at, error]) in columns.zip(&self.positions) {
            values.push(at.map_or(row.heldout_rms, figure));
            errors.push(error.and_then(figure));
        }
    }

    /// Computes what is told, when all grains are there.
    pub(super) fn finish(&mut self) {
        for (statistics, values) in self.measures.iter_mut().zip(&self.values) {
            let known: Vec<f64> = values.iter().flatten().copied().collect();
            statistics.take(known);
        }
        let doubts = [self.doubt(), self.gaps.sentence(""), self.own_warnings()];
        self.warnings.extend(doubts.into_iter().flatten());
        self.keep_told();
        let pair = |one: &Vec<Option<f64>>| -> Vec<Option<f64>> {
            self.values
                .iter()
                .map(|other| correlation(one, other))
                .collect()
        };
        self.correlations = self.values.iter().map(pair).collect();
        self.outliers = (0..self.measures.len())
            .flat_map(|at| self.outlying(at))
            .collect();
    }

    /// Whether a measure that is known is not told, for its values are in several units.
    fn is_mixed(&self, measure: &Statistics) -> bool {
        self.units.len() > 1
            && measure.count > 0
            && MAIN.contains(&(measure.measure.as_str(), true))
    }

    /// What is odd about the units of the grains.
    fn doubt(&self) -> Option<String> {
        let units = Vec::from_iter(self.units.iter().map(String::as_str));
        let mixed = self.measures.iter().filter(|one| self.is_mixed(one));
        let mixed: Vec<&str> = mixed.map(|one| one.measure.as_str()).collect();
        match units[..] {
            [unit] if self.unitless > 0 => Some(format!(
                "No unit is told of {} of {} grains: lengths are taken to be in {unit} there too.",
                self.unitless, self.grains
            )),
            [_, _, ..] if !mixed.is_empty() => Some(format!(
                "Lengths are in {}, and these measures of all grains together are not told: {}. Run batch on the scans of \
                 one unit.",
                units.join(" and "),
                mixed.join(", ")
            )),
            _ => None,
        }
    }

    /// How many grains have warnings of their own.
    fn own_warnings(&self) -> Option<String> {
        (self.warned > 0).then(|| {
            format!(
                "{} of {} {}, in the column warnings of results.csv.",
                self.warned,
                plural(self.grains, "grain"),
                match self.warned {
                    1 => "has warnings of its own",
                    _ => "have warnings of their own",
                }
            )
        })
    }

    /// Leaves out measures that are known of no grain, or in several units.
    fn keep_told(&mut self) {
        let is_told = |measure: &Statistics| measure.count > 0 && !self.is_mixed(measure);
        let is_told: Vec<bool> = self.measures.iter().map(is_told).collect();
        let mut told = is_told.iter();
        self.measures.retain(|_| *told.next().unwrap_or(&false));
        for columns in [&mut self.values, &mut self.errors] {
            let mut told = is_told.iter();
            columns.retain(|_| *told.next().unwrap_or(&false));
        }
    }

    fn outlying(&self, at: usize) -> Vec<Outlier> {
        let (values, errors) = (&self.values[at], &self.errors[at]);
        let known: Vec<f64> = values.iter().flatten().copied().collect();
        let middle = median(known.iter().copied());
        let deviation = deviation(known.iter().map(|value| (value - middle).abs()));
        if known.len() < LEAST_GRAINS || deviation <= 0.0 {
            return Vec::new();
        }
        let measure = &self.measures[at].measure;
        let outlier = |at: usize| {
            let value = values[at]?;
            let off = value - middle;
            let z = off / deviation;
            let is_beyond_error = off.abs() > OUTLYING * own_error(measure, value, errors[at]);
            (z.abs() > OUTLYING && is_beyond_error).then(|| Outlier {
                path: self.paths[at].clone(),
                measure: measure.clone(),
                value,
                z,
                reason: format!(
                    "its {measure} is {} deviations {} the median",
                    (z.abs() * 10.0).round() / 10.0,
                    if z > 0.0 { "above" } else { "below" }
                ),
            })
        };
        (0..values.len()).filter_map(outlier).collect()
    }
}

/// Standard deviation of values whose distances from their median are given, told by the median of these; where more than half
/// are alike, by the mean (Iglewicz and Hoaglin 1993).
fn deviation(off: impl ExactSizeIterator<Item = f64> + Clone) -> f64 {
    let middle = median(off.clone());
    match middle > 0.0 {
        true => PER_MEDIAN * middle,
        false => PER_MEAN * off.clone().sum::<f64>() / off.len() as f64,
    }
}

impl Statistics {
    fn take(&mut self, mut known: Vec<f64>) {
        known.sort_unstable_by(f64::total_cmp);
        self.count = known.len();
        let (mean, deviation) = moments(&known);
        self.mean = mean;
        self.deviation = deviation;
        self.quantiles = QUANTILES.map(|share| quantile(&known, share));
    }
}

/// Mean and standard deviation (with n - 1).
pub(super) fn moments(values: &[f64]) -> (f64, Option<f64>) {
    let count = values.len() as f64;
    // The mean of equal values is rounded, and they would be told to vary.
    let is_constant = values.windows(2).all(|pair| pair[0] == pair[1]);
    let mean = match values.first() {
        Some(&value) if is_constant => value,
        _ => values.iter().sum::<f64>() / count.max(1.0),
    };
    // Squares of moments of inertia in metres, and of some other figures, are beyond the range of numbers.
    let largest = values
        .iter()
        .fold(0.0_f64, |most, value| most.max((value - mean).abs()));
    let unit = if largest > 0.0 { largest } else { 1.0 };
    let squares: f64 = values
        .iter()
        .map(|value| ((value - mean) / unit).powi(2))
        .sum();
    (
        mean,
        (count > 1.0).then(|| unit * (squares / (count - 1.0)).sqrt()),
    )
}

/// Of an even number of values the mean of the two in the middle.
fn median(values: impl Iterator<Item = f64>) -> f64 {
    let mut values: Vec<f64> = values.collect();
    values.sort_unstable_by(f64::total_cmp);
    quantile(&values, 0.5)
}

fn quantile(sorted: &[f64], share: f64) -> f64 {
    let at = share * sorted.len().saturating_sub(1) as f64;
    let (low, high) = (at.floor() as usize, at.ceil() as usize);
    match (sorted.get(low), sorted.get(high)) {
        (Some(one), Some(other)) => one + (other - one) * at.fract(),
        _ => 0.0,
    }
}

fn correlation(one: &[Option<f64>], other: &[Option<f64>]) -> Option<f64> {
    let pairs = one
        .iter()
        .zip(other)
        .filter_map(|(one, other)| Some(((*one)?, (*other)?)));
    let (one, other): (Vec<f64>, Vec<f64>) = pairs.unzip();
    if one.len() < 3 {
        return None;
    }
    let [(mean, deviation), (other_mean, other_deviation)] = [moments(&one), moments(&other)];
    let (deviation, other_deviation) = (deviation?, other_deviation?);
    let products: f64 = one
        .iter()
        .zip(&other)
        .map(|(one, other)| (one - mean) / deviation * ((other - other_mean) / other_deviation))
        .sum();
    let found = products / (one.len() - 1) as f64;
    found.is_finite().then_some(found.clamp(-1.0, 1.0))
}

#[cfg(test)]
mod tests;
