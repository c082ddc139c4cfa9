//! A lot of grains, as the rows of results tell it.

use super::columns::FIRST;
use super::gaps::Gaps;
use super::queue::without_label;
use crate::digits::plural;
use std::collections::{BTreeMap, BTreeSet, HashMap};
use std::fmt::Display;

/// The figures of a lot of grains: names of columns of numbers, and what is known in each.
#[derive(Debug, Clone, Default, PartialEq)]
#[non_exhaustive]
pub(crate) struct Lot {
    /// Names of the columns, in their order.
    pub names: Vec<String>,
    /// The grains: the paths of their scans.
    pub grains: Vec<String>,
    /// What is known of each grain, a list for each column.
    pub values: Vec<Vec<Option<f64>>>,
    /// The standard errors of these, as far as they are known.
    pub errors: Vec<Vec<Option<f64>>>,
    /// What is known of fewer grains than were fitted.
    pub gaps: Gaps,
    /// How many rows are of scans without a result.
    pub failed: usize,
    /// The units of length that are told of them; none where none is.
    pub units: BTreeSet<String>,
    /// How many of the grains tell none.
    pub unitless: usize,
    /// How its grains were fitted: the values of each setting, and the versions that fitted them.
    pub settings: BTreeMap<String, BTreeSet<String>>,
    /// How many grains are of each of its scans: by its hash, and the label of a grain in an image.
    pub scans: BTreeMap<(String, Option<i64>), usize>,
    /// Of a column, how many cells hold something that is no finite number.
    pub unread: BTreeMap<String, usize>,
}

impl Lot {
    pub(super) fn of_columns<'a>(names: impl Iterator<Item = &'a str>) -> Self {
        let names: Vec<String> = names.map(str::to_owned).collect();
        let values = vec![Vec::new(); names.len()];
        Self {
            gaps: Gaps::new(names.iter().map(String::as_str)),
            names,
            values,
            ..Self::default()
        }
    }

    /// Takes a row: its texts by the names of their columns, and its cells as numbers. One that is infinite is no number.
    pub(super) fn add(&mut self, texts: &HashMap<&str, &str>, cells: &[Option<f64>]) {
        if !self.hear(texts) {
            self.failed += 1;
            return;
        }
        let not_measured = texts.get("not_measured").copied().unwrap_or_default();
        let is_known = |at: usize| cells[at].is_some();
        self.gaps.hear(is_known, not_measured.split(" | "));
        self.grains
            .push(texts.get("path").copied().unwrap_or_default().into());
        for (column, value) in cells.iter().enumerate() {
            let known = value.filter(|value| value.is_finite());
            if value.is_some() && known.is_none() {
                *self.unread.entry(self.names[column].clone()).or_default() += 1;
            }
            self.values[column].push(known);
        }
    }

    /// Hears the texts of a row, by the names of their columns. Whether it is that of a grain.
    fn hear(&mut self, row: &HashMap<&str, &str>) -> bool {
        let cell = |name: &str| row.get(name).copied().filter(|cell| !cell.is_empty());
        if cell("status") == Some("failed") {
            return false;
        }
        match cell("unit") {
            Some(unit) => drop(self.units.insert(unit.into())),
            None => self.unitless += 1,
        }
        let settings = cell("settings").unwrap_or_default().split(' ');
        let settings = settings.filter_map(|setting| setting.split_once('='));
        let version = cell("version").map(|version| ("version", version));
        for (name, value) in settings.chain(version) {
            let values = self.settings.entry(name.into()).or_default();
            values.insert(value.into());
        }
        if let Some(hash) = cell("hash") {
            let (_, label) = without_label(cell("path").unwrap_or_default());
            *self.scans.entry((hash.into(), label)).or_default() += 1;
        }
        true
    }

    /// What is taken for granted of grains that tell no unit, where the others of the lot tell one.
    pub(crate) fn taken_unit(&self, shown: impl Display) -> Option<String> {
        let unit = self.units.first().filter(|_| self.unitless > 0)?;
        let grains = plural(self.unitless, "grain");
        Some(format!(
            "{shown} tells no unit of {grains}: lengths are taken to be in {unit} there too."
        ))
    }

    /// What is known of a column, of the grains of which it is.
    pub(crate) fn known(&self, column: usize) -> Vec<f64> {
        self.values[column].iter().flatten().copied().collect()
    }

    /// Leaves out what is no figure of a grain, and puts standard errors beside their figures.
    pub(super) fn figures(mut self) -> Self {
        let is_figure = |name: &str| {
            let described = FIRST.iter().any(|(first, _)| *first == name);
            !described && !name.ends_with("_se")
        };
        let mut columns: BTreeMap<String, Vec<Option<f64>>> =
            std::iter::zip(self.names.clone(), self.values).collect();
        self.names.retain(|name| {
            is_figure(name)
                && columns
                    .get(name)
                    .is_some_and(|values| values.iter().any(Option::is_some))
        });
        self.errors = self
            .names
            .iter()
            .map(|name| columns.remove(&format!("{name}_se")).unwrap_or_default())
            .collect();
        self.values = self
            .names
            .iter()
            .map(|name| columns.remove(name).unwrap_or_default())
            .collect();
        self
    }
}
