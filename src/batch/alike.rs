//! What two lots differ by, or share, beside their grains.

use super::table::Lot;
use crate::digits::plural;
use std::collections::BTreeSet;

/// What figures depend on, of how grains are fitted.
const FITTED_BY: [&str; 5] = ["tolerance", "segments", "largest", "extrapolate", "version"];

/// What is odd about a comparison of two lots: whole sentences.
pub(crate) fn doubts(first: &Lot, second: &Lot) -> Vec<String> {
    let found = [
        fitted_otherwise(first, second),
        shared(first, second),
        copied(first, "first"),
        copied(second, "other"),
        unread(first, "first"),
        unread(second, "other"),
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
    let count = first.scans.intersection(&second.scans).count();
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
    (lot.copies > 0).then(|| {
        format!(
            "{} of the {which} lot {} of scans that others are of, by their bytes: the intervals do not hold, for they \
             take the grains as independent.",
            plural(lot.copies, "grain"),
            if lot.copies == 1 { "is" } else { "are" }
        )
    })
}

/// How many cells of a lot are passed over.
fn unread(lot: &Lot, which: &str) -> Option<String> {
    let of_column = |(name, count): (&String, &usize)| format!("{count} of {name}");
    let cells: Vec<_> = lot.unread.iter().map(of_column).collect();
    (!cells.is_empty()).then(|| {
        format!(
            "Cells of the {which} lot that hold no number are left out: {}.",
            cells.join(", ")
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
        lot.scans = scans
            .iter()
            .map(|(hash, label)| ((*hash).into(), *label))
            .collect();
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
        let apart = lot(&[], &[("ct", Some(3))]);
        assert!(doubts(&one, &apart).is_empty());
    }

    #[test]
    fn grains_that_a_lot_counts_again_are_told_of_either() {
        let [one, other] = [("a", 1), ("b", 2)].map(|(hash, copies)| Lot {
            copies,
            ..lot(&[], &[(hash, None)])
        });
        let told = doubts(&one, &other);
        let [first, second] = &told[..] else {
            panic!("{told:?}");
        };
        assert!(first.starts_with("1 grain of the first lot is of scans"));
        assert!(second.starts_with("2 grains of the other lot are of scans"));
    }
}
