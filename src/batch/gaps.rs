//! Which measures are known of fewer grains than were fitted, and why.
//!
//! What is withheld is withheld of grains that are unlike the others, as those that are large and half seen: a mean over the
//! rest is not that of the lot.

use super::columns::figures;
use crate::digits::plural;
use crate::report::Measure;
use std::collections::{BTreeMap, HashSet};
use std::mem::take;

/// The most groups of measures that a sentence tells, and ...
const MOST_GROUPS: usize = 3;

/// ... the most names of one.
const MOST_NAMES: usize = 8;

/// What is missing in the rows of a lot.
#[derive(Debug, Clone, Default, PartialEq)]
pub(crate) struct Gaps {
    grains: usize,
    columns: usize,
    groups: Vec<Group>,
}

/// The position of a column in the table, and its name.
type Column = (usize, String);

/// Columns that are unknown of the same grains for the same reasons.
#[derive(Debug, Clone, Default, PartialEq)]
struct Group {
    columns: Vec<Column>,
    /// How many grains they are unknown of.
    unknown: usize,
    /// Why: how often, and an example. Those that differ by their numbers alone are one.
    reasons: BTreeMap<String, (usize, String)>,
}

impl Gaps {
    /// Of a table with columns of these names, no row of which was heard yet.
    pub(crate) fn new<'a>(names: impl Iterator<Item = &'a str>) -> Self {
        let figures = figures(&Measure::ALL).into_iter();
        let figures: HashSet<String> = figures.map(|figure| figure.name).collect();
        let columns = names.map(str::to_owned).enumerate();
        let columns: Vec<_> = columns.filter(|(_, name)| figures.contains(name)).collect();
        Self {
            grains: 0,
            columns: columns.len(),
            groups: vec![Group {
                columns,
                ..Group::default()
            }],
        }
    }

    /// Whether it would tell that a column is unknown.
    pub(crate) fn covers(&self, column: &str) -> bool {
        let mut columns = self.groups.iter().flat_map(|group| &group.columns);
        columns.any(|(_, name)| name == column)
    }

    /// Hears the row of a grain: whether it tells the column at a position, and its `not_measured`.
    pub(crate) fn hear<'a>(
        &mut self,
        is_known: impl Fn(usize) -> bool,
        not_measured: impl Iterator<Item = &'a str>,
    ) {
        self.grains += 1;
        let withheld: Vec<_> = not_measured
            .filter_map(|text| text.split_once(": "))
            .collect();
        for group in take(&mut self.groups) {
            match group.columns.iter().all(|(at, _)| is_known(*at)) {
                true => self.groups.push(group),
                false => self.groups.extend(group.parted(&is_known, &withheld)),
            }
        }
    }

    /// What is unknown of how many grains, as a sentence; `whose` names the lot, if need be.
    pub(crate) fn sentence(&self, whose: &str) -> Option<String> {
        let mut groups: Vec<&Group> = self
            .groups
            .iter()
            .filter(|group| group.unknown > 0)
            .collect();
        groups.sort_by_key(|group| std::cmp::Reverse(group.unknown));
        let told = groups
            .iter()
            .take(MOST_GROUPS)
            .map(|group| self.told(group));
        let mut told: Vec<String> = told.collect();
        let others = groups.iter().skip(MOST_GROUPS);
        let others: usize = others.map(|group| group.columns.len()).sum();
        told.extend((others > 0).then(|| format!("fewer lack others ({others} columns)")));
        (!told.is_empty()).then(|| {
            format!(
                "Of {}{whose} {}{}.",
                plural(self.grains, "grain"),
                told.join("; "),
                match groups.iter().all(|group| group.unknown == self.grains) {
                    true => "",
                    false => ": means are of the rest, which may be unlike these",
                }
            )
        })
    }

    /// Of how many grains a column is unknown, and why: most of a sentence; `None` where it is known of all.
    pub(crate) fn lacking(&self, column: &str) -> Option<String> {
        let unknown = |group: &&Group| {
            group.unknown > 0 && group.columns.iter().any(|(_, name)| name == column)
        };
        let group = self.groups.iter().find(unknown)?;
        let grains = plural(self.grains, "grain");
        let lack = self.lack(group);
        Some(format!("of {grains} {lack} {column}{}", group.why()))
    }

    fn lack(&self, group: &Group) -> String {
        match group.unknown {
            1 => "1 lacks".into(),
            all if all == self.grains => "all lack".into(),
            some => format!("{some} lack"),
        }
    }

    fn told(&self, group: &Group) -> String {
        let lack = self.lack(group);
        let names = self.names(group);
        let are_all = group.columns.len() == self.columns && names.len() > MOST_NAMES;
        let names = match are_all {
            true => "all measures".into(),
            false => list(&names),
        };
        format!("{lack} {names}{}", group.why())
    }

    /// What the columns of a group are called: those of a measure by its name, where they are all there.
    fn names(&self, group: &Group) -> Vec<String> {
        let count = |columns: &[Column], measure: &str| {
            let own = columns.iter().filter(|(_, name)| key(name) == measure);
            own.count()
        };
        let mut names: Vec<String> = Vec::new();
        for (_, column) in &group.columns {
            let measure = key(column);
            let all = self.groups.iter().map(|any| count(&any.columns, measure));
            let name = match count(&group.columns, measure) == all.sum::<usize>() {
                true => measure,
                false => column,
            };
            if names.last().is_none_or(|last| last != name) {
                names.push(name.into());
            }
        }
        names
    }
}

impl Group {
    /// Why they lack their columns, in brackets: the commonest reason.
    fn why(&self) -> String {
        let mut reasons: Vec<_> = self.reasons.values().collect();
        reasons.sort_by_key(|(count, _)| std::cmp::Reverse(*count));
        match reasons.as_slice() {
            [] => String::new(),
            [(_, only)] => format!(" ({only})"),
            [(first, example), (second, _), ..] if first > second => {
                format!(" (most often: {example})")
            }
            [(_, example), ..] => format!(" (such as: {example})"),
        }
    }

    /// The same after a grain of which not all columns are known: those that are known, and the others by the reason why.
    fn parted(
        self,
        is_known: impl Fn(usize) -> bool,
        withheld: &[(&str, &str)],
    ) -> impl Iterator<Item = Self> {
        let mut parts: BTreeMap<(bool, Option<&str>), Vec<Column>> = BTreeMap::new();
        for (at, name) in self.columns {
            let is_known = is_known(at);
            let why = withheld
                .iter()
                .find(|(names, _)| !is_known && is_of(&name, names));
            let part = (is_known, why.map(|(_, reason)| *reason));
            parts.entry(part).or_default().push((at, name));
        }
        let (unknown, reasons) = (self.unknown, self.reasons);
        parts.into_iter().map(move |((is_known, why), columns)| {
            let mut reasons = reasons.clone();
            if let Some(reason) = why.map(without_advice) {
                let example = || (0, reason.to_owned());
                reasons.entry(kind(reason)).or_insert_with(example).0 += 1;
            }
            Self {
                columns,
                unknown: unknown + usize::from(!is_known),
                reasons,
            }
        })
    }
}

/// The measure that a column is a figure of.
pub(super) fn key(column: &str) -> &str {
    column
        .split_once('.')
        .map_or(column, |(measure, _)| measure)
}

/// Whether a column is a figure of one of some measures, such as `area, spheres.inscribed`.
fn is_of(column: &str, measures: &str) -> bool {
    measures.split(", ").any(|measure| {
        let rest = column.strip_prefix(measure);
        rest.is_some_and(|rest| rest.is_empty() || rest.starts_with(['.', '_']))
    })
}

/// What is to be done follows a reason after a semicolon.
fn without_advice(reason: &str) -> &str {
    reason.split_once(';').map_or(reason, |(why, _)| why)
}

/// A reason without its numbers.
fn kind(reason: &str) -> String {
    let is_of_number = |letter: &char| letter.is_ascii_digit() || "+-.".contains(*letter);
    reason
        .chars()
        .filter(|letter| !is_of_number(letter))
        .collect()
}

/// `a, b and c`; of many the first ones.
pub(super) fn list(names: &[String]) -> String {
    match names {
        [most @ .., last] if !most.is_empty() && names.len() <= MOST_NAMES => {
            format!("{} and {last}", most.join(", "))
        }
        [one] => one.clone(),
        _ => {
            let (told, others) = names.split_at(MOST_NAMES.min(names.len()));
            format!("{} and {} more", told.join(", "), others.len())
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const NAMES: [&str; 6] = [
        "path",
        "area",
        "volume",
        "volume_se",
        "form.elongation",
        "form.flatness",
    ];

    fn gaps(names: &[&str], grains: &[(&[&str], &[&str])]) -> Option<String> {
        let mut gaps = Gaps::new(names.iter().copied());
        for (lacking, not_measured) in grains {
            let is_known = |at: usize| !lacking.contains(&names[at]);
            gaps.hear(is_known, not_measured.iter().copied());
        }
        gaps.sentence(" of a")
    }

    /// Of grains that each lack some columns, for these reasons.
    fn told(grains: &[(&[&str], &[&str])]) -> Option<String> {
        gaps(&NAMES, grains)
    }

    #[test]
    fn measures_that_are_unknown_of_the_same_grains_are_told_together() {
        let both = ["volume", "form.elongation", "form.flatness"];
        let hole = |angle| format!("volume, form: a hole of {angle} degrees; take --extrapolate");
        let [small, large] = [hole(40), hole(35)];
        let found = told(&[
            (&both, &[&small]),
            (&[], &[]),
            (&both, &[&large]),
            (&["path", "volume_se"], &[]),
        ]);
        assert_eq!(
            found.unwrap(),
            "Of 4 grains of a 2 lack volume and form (a hole of 40 degrees): means are of the rest, which may be unlike these."
        );
        assert_eq!(told(&[(&[], &[]), (&["path"], &[])]), None);
    }

    #[test]
    fn of_how_many_a_column_is_unknown_is_told() {
        let mut gaps = Gaps::new(NAMES.into_iter());
        for lacking in ["volume", "area", "volume"] {
            gaps.hear(|at| NAMES[at] != lacking, ["volume: a hole"].into_iter());
        }
        let told = gaps.lacking("volume").unwrap();
        assert_eq!(told, "of 3 grains 2 lack volume (a hole)");
        assert_eq!(gaps.lacking("form.flatness"), None);
    }

    #[test]
    fn other_grains_are_told_apart_the_many_first_with_the_reason_of_most() {
        let found = told(&[
            (&["form.flatness"], &[]),
            (&["area"], &["area: rough; fit it"]),
            (&["area", "form.flatness"], &["area: steps", "form: flat"]),
            (&["area"], &["area: rough"]),
        ]);
        let expected = "3 lack area (most often: rough); 2 lack form.flatness (flat)";
        let found = found.unwrap();
        assert!(found.contains(expected), "{found}");
        let one: [(&[&str], &[&str]); 2] =
            [(&["area"], &["area: steps"]), (&["area"], &["area: rough"])];
        let found = told(&one).unwrap();
        assert!(found.contains("all lack area (such as: rough)"), "{found}");
        let all: (&[&str], &[&str]) = (&NAMES, &["area, volume, form: why"]);
        let found = told(&[all, all]).unwrap();
        let expected = "Of 2 grains of a all lack area, volume and form (why).";
        assert_eq!(found, expected);
        let found = told(&[all]).unwrap();
        assert!(found.starts_with("Of 1 grain of a 1 lacks "), "{found}");
        let found = told(&[all, (&[], &[])]).unwrap();
        assert!(found.contains("a 1 lacks area, volume and form"), "{found}");
    }

    #[test]
    fn many_names_are_counted_and_all_are_all() {
        let columns = figures(&Measure::ALL);
        let names: Vec<&str> = columns.iter().map(|column| column.name.as_str()).collect();
        let found = gaps(&names, &[(&names, &[]), (&[], &[])]).unwrap();
        assert!(found.contains("1 lacks all measures: means"), "{found}");
        // But for one part, each has its own name.
        let but_one: Vec<&str> = names.iter().copied().skip(1).collect();
        let found = gaps(&names, &[(&but_one, &[]), (&[], &[])]).unwrap();
        assert!(
            found.contains("1 lacks volume, ") && found.contains(" more: means"),
            "{found}"
        );
        let names: Vec<String> = (0..10).map(|name| name.to_string()).collect();
        assert_eq!(list(&names[..2]), "0 and 1");
        assert_eq!(list(&names), "0, 1, 2, 3, 4, 5, 6, 7 and 2 more");
    }
}
