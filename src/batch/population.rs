//! What the grains of a batch are like together.

use super::columns::{Column, FIRST, MAIN};
use super::gaps::Gaps;
use super::journal::Row;
use super::outliers::{Outlier, outliers};
use super::statistics::{correlation, moments};
use crate::digits::plural;
use crate::spread::quantile;
use serde::Serialize;
use std::collections::BTreeSet;

/// Quantiles that are told.
const QUANTILES: [f64; 7] = [0.0, 0.05, 0.25, 0.5, 0.75, 0.95, 1.0];

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
    /// What is odd about their units, what is not known of all of them, how many have warnings of their own, and which are the same
    /// file twice: whole sentences.
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

    /// Computes what is told, when all grains are there; `copies` are of the same bytes as one before, which is named after each.
    pub(super) fn finish(&mut self, copies: &[[String; 2]]) {
        for (statistics, values) in self.measures.iter_mut().zip(&self.values) {
            let known: Vec<f64> = values.iter().flatten().copied().collect();
            statistics.take(known);
        }
        let gaps = self.gaps.sentence("");
        let doubts = [self.doubt(), gaps, self.own_warnings(), copied(copies)];
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
            .flat_map(|at| {
                let measure = &self.measures[at].measure;
                outliers(measure, &self.paths, &self.values[at], &self.errors[at])
            })
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

/// Which scans are the same file twice.
fn copied(copies: &[[String; 2]]) -> Option<String> {
    let [copy, own] = copies.first()?;
    let have = match copies.len() {
        1 => "1 scan has".into(),
        copies => format!("{copies} scans have"),
    };
    Some(format!(
        "{have} the same bytes as another, such as {copy} as {own}: each is counted as a grain of its own."
    ))
}

#[cfg(test)]
mod tests;
