//! What two lots differ by, or share, beside their grains.

use super::columns::is_figure;
use super::gaps::{key, list};
use super::lot::Lot;
use crate::digits::plural;
use std::collections::BTreeSet;

/// What figures depend on, of how grains are fitted.
const FITTED_BY: [&str; 4] = ["tolerance", "segments", "largest", "version"];

/// What is odd about a comparison of two lots: whole sentences.
pub(crate) fn doubts(first: &Lot, second: &Lot) -> Vec<String> {
    let found = [
        fitted_otherwise(first, second),
        shared(first, second),
        copied(first, "first"),
        copied(second, "other"),
        failed(first, "first"),
        failed(second, "other"),
        first.gaps.sentence(" of the first lot"),
        second.gaps.sentence(" of the other lot"),
        unread(first, second, "first"),
        unread(second, first, "other"),
        of_one(first, second, "first"),
        of_one(second, first, "other"),
    ];
    found.into_iter().flatten().collect()
}

/// Which settings are not the same, where both lots tell theirs.
fn fitted_otherwise(first: &Lot, second: &Lot) -> Option<String> {
    let list = |values: &BTreeSet<String>| Vec::from_iter(values.clone()).join(" or ");
    let told = FITTED_BY.iter().filter_map(|name| {
        let (own, other) = (first.settings.get(*name)?, second.settings.get(*name)?);
        let is_same = own == other && own.len() == 1;
        (!is_same).then(|| format!("{name} {}, in the other lot {}", list(own), list(other)))
    });
    let told: Vec<String> = told.collect();
    (!told.is_empty()).then(|| {
        format!(
            "The grains were not all fitted alike, and figures differ by that too ({}): run batch with the same settings.",
            told.join("; ")
        )
    })
}

/// How many grains are in both lots.
fn shared(first: &Lot, second: &Lot) -> Option<String> {
    let in_both = |(scan, own): (_, &usize)| Some(*own.min(second.scans.get(scan)?));
    let count = first.scans.iter().filter_map(in_both).sum();
    (count > 0).then(|| {
        format!(
            "The lots share {}, by the bytes of their scans: the intervals do not hold, for they take the lots as \
             independent.",
            plural(count, "grain")
        )
    })
}

/// How many grains of a lot are counted again.
fn copied(lot: &Lot, which: &str) -> Option<String> {
    let copies = lot.scans.values().sum::<usize>() - lot.scans.len();
    (copies > 0).then(|| {
        format!(
            "{} of the {which} lot {} of scans that others are of, by their bytes: the intervals do not hold, for they \
             take the grains as independent.",
            plural(copies, "grain"),
            if copies == 1 { "is" } else { "are" }
        )
    })
}

/// How many scans of a lot have no result.
fn failed(lot: &Lot, which: &str) -> Option<String> {
    (lot.failed > 0).then(|| {
        format!(
            "{} of the {which} lot failed, and {} not among its grains.",
            plural(lot.failed, "row"),
            if lot.failed == 1 { "is" } else { "are" }
        )
    })
}

/// How many cells of a lot are passed over, in columns that hold numbers by their names, or in either lot.
fn unread(lot: &Lot, other: &Lot, which: &str) -> Option<String> {
    let are_numbers = |(name, _): &(&String, &usize)| {
        let has = |lot: &Lot| lot.names.contains(name);
        has(lot) || has(other) || is_figure(name)
    };
    let of_column = |(name, count): (&String, &usize)| format!("{count} of {name}");
    let cells = lot.unread.iter().filter(are_numbers).map(of_column);
    let cells: Vec<_> = cells.collect();
    (!cells.is_empty()).then(|| {
        format!(
            "Cells of the {which} lot that hold no number are left out: {}.",
            cells.join(", ")
        )
    })
}

/// Which measures a lot has and the other lacks altogether; what is unknown of all its grains is told otherwise.
fn of_one(lot: &Lot, other: &Lot, which: &str) -> Option<String> {
    let is_alone = |name: &&String| {
        let is_told = other.gaps.covers(name) || other.unread.contains_key(*name);
        !other.names.contains(name) && !is_told
    };
    let has_figures = |measure: &str| other.names.iter().any(|name| key(name) == measure);
    let name = |column: &String| match key(column) {
        measure if has_figures(measure) => column.clone(),
        measure => measure.into(),
    };
    let mut names: Vec<String> = lot.names.iter().filter(is_alone).map(name).collect();
    names.dedup();
    (!names.is_empty()).then(|| {
        format!(
            "Only the {which} lot has figures of {}: they are not compared.",
            list(&names)
        )
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn lot(settings: &[(&str, &str)], scans: &[(&str, Option<i64>)]) -> Lot {
        let mut lot = Lot::default();
        for (name, value) in settings {
            let values = lot.settings.entry((*name).into()).or_default();
            values.insert((*value).into());
        }
        for (hash, label) in scans {
            *lot.scans.entry(((*hash).into(), *label)).or_default() += 1;
        }
        lot
    }

    #[test]
    fn settings_that_change_figures_are_named_and_no_others() {
        let one = lot(
            &[("segments", "1"), ("only", "area"), ("version", "1")],
            &[],
        );
        let other = lot(
            &[("segments", "6"), ("only", "volume"), ("version", "1")],
            &[],
        );
        let told = doubts(&one, &other);
        assert!(
            told[0].contains("(segments 1, in the other lot 6)"),
            "{told:?}"
        );
        let newer = lot(&[("segments", "1"), ("version", "2")], &[]);
        assert!(doubts(&one, &newer)[0].contains("(version 1, in the other lot 2)"));
        let mixed = lot(&[("segments", "1"), ("segments", "6")], &[]);
        assert!(doubts(&mixed, &mixed)[0].contains("segments 1 or 6, in the other lot 1 or 6"));
        assert!(doubts(&one, &one).is_empty());
        assert!(doubts(&one, &lot(&[], &[])).is_empty());
    }

    #[test]
    fn grains_of_both_lots_are_counted_and_labels_of_an_image_are_grains() {
        let one = lot(&[], &[("a", None), ("ct", Some(1)), ("ct", Some(2))]);
        let other = lot(&[], &[("b", None), ("ct", Some(2)), ("ct", Some(3))]);
        let told = doubts(&one, &other);
        assert!(told[0].starts_with("The lots share 1 grain,"), "{told:?}");
        assert!(doubts(&one, &one)[0].starts_with("The lots share 3 grains,"));
        let copied = lot(&[], &[("a", None), ("a", None), ("b", None)]);
        assert!(doubts(&copied, &copied)[0].starts_with("The lots share 3 grains,"));
        assert!(doubts(&copied, &one)[0].starts_with("The lots share 1 grain,"));
        let apart = lot(&[], &[("ct", Some(3))]);
        assert!(doubts(&one, &apart).is_empty());
    }

    #[test]
    fn rows_that_failed_are_counted_of_either_lot() {
        let [none, one, two] = [0, 1, 2].map(|failed| Lot {
            failed,
            ..Lot::default()
        });
        assert_eq!(doubts(&none, &none), [""; 0]);
        let told = [
            "1 row of the first lot failed, and is not among its grains.",
            "2 rows of the other lot failed, and are not among its grains.",
        ];
        assert_eq!(doubts(&one, &two), told);
    }

    #[test]
    fn cells_without_numbers_are_told_where_numbers_should_be() {
        let lot = |names: &[&str], unread: &[&str]| Lot {
            names: names.iter().map(|name| (*name).into()).collect(),
            unread: unread.iter().map(|name| ((*name).into(), 3)).collect(),
            ..Lot::default()
        };
        // A column of texts, one that the other lot has numbers in, and one that should have them.
        let one = lot(&[], &["variety", "weight", "volume"]);
        let told = doubts(&one, &lot(&["weight"], &[]));
        assert_eq!(
            told,
            ["Cells of the first lot that hold no number are left out: 3 of volume, 3 of weight."]
        );
        assert_eq!(doubts(&lot(&["weight"], &["weight"]), &one).len(), 2);
        assert_eq!(doubts(&lot(&[], &["variety"]), &one).len(), 1);
    }

    #[test]
    fn grains_that_a_lot_counts_again_are_told_of_either() {
        let one = lot(&[], &[("a", None); 2]);
        let other = lot(&[], &[("b", None); 3]);
        let told = doubts(&one, &other);
        let [first, second] = &told[..] else {
            panic!("{told:?}");
        };
        assert!(first.starts_with("1 grain of the first lot is of scans"));
        assert!(second.starts_with("2 grains of the other lot are of scans"));
    }
}
