//! `grainform compare`

use super::args::CompareArgs;
use super::console::Console;
use super::outliers::print_outliers;
use super::streams::put_json;
use crate::batch::{Comparison, Outlier, compare, doubts, outliers_of, read_results};
use crate::report::short;
use anyhow::{Result, bail};
use comfy_table::{CellAlignment, Table, presets::NOTHING};
use serde::Serialize;
use std::collections::BTreeSet;

/// What is told of two lots.
#[derive(Serialize)]
struct Compared {
    measures: Vec<Comparison>,
    /// Of the first lot and of the second.
    outliers: [Vec<Outlier>; 2],
    warnings: Vec<String>,
}

pub(super) fn run(args: CompareArgs, console: Console) -> Result<()> {
    let lots = [read_results(&args.first)?, read_results(&args.second)?];
    let units: BTreeSet<&str> = lots
        .iter()
        .flat_map(|lot| &lot.units)
        .map(String::as_str)
        .collect();
    if units.len() > 1 {
        let units = Vec::from_iter(units).join(" and ");
        bail!(
            "lots in {units} are not to be compared, for nothing is converted: compare scans in one unit, or run batch \
             again where --unit was wrong"
        );
    }
    let [first, second] = &lots;
    let unitless = [(first, &args.first), (second, &args.second)]
        .into_iter()
        .filter(|(lot, _)| lot.units.is_empty());
    let taken = units.first().map(|unit| {
        unitless.map(move |(_, path)| {
            let path = path.display();
            format!("{path} tells no unit: its lengths are taken to be in {unit}, as those of the other lot.")
        })
    });
    let in_part = [
        first.taken_unit(args.first.display()),
        second.taken_unit(args.second.display()),
    ];
    let taken = taken.into_iter().flatten();
    let taken = taken.chain(in_part.into_iter().flatten());
    let warnings = taken.chain(doubts(first, second));
    let compared = Compared {
        warnings: warnings.collect(),
        measures: compare(first, second),
        outliers: [first, second].map(outliers_of),
    };
    if compared.measures.is_empty() {
        bail!(
            "there is nothing to compare: {} and {} share no measure that two grains of each have",
            args.first.display(),
            args.second.display()
        );
    }
    if args.json {
        return put_json(&compared);
    }
    let mut table = Table::new();
    table.load_style(NOTHING).set_header([
        "measure",
        "grains",
        "mean",
        "other mean",
        "difference",
        "95 % interval",
        "effect d",
        "95 % interval",
    ]);
    let interval = |interval: Option<[f64; 2]>, text: fn(f64) -> String| match interval {
        Some([low, high]) => format!("{} to {}", text(low), text(high)),
        None => "-".into(),
    };
    let hundredths = |value: f64| format!("{value:.2}");
    for comparison in &compared.measures {
        let [count, other_count] = comparison.counts;
        let [mean, other_mean] = comparison.means.map(short);
        let effect = match comparison.is_below_own_error() {
            true => "below error".into(),
            false => comparison.effect.map_or("-".into(), hundredths),
        };
        table.add_row([
            comparison.measure.clone(),
            format!("{count}, {other_count}"),
            mean,
            other_mean,
            short(comparison.difference),
            interval(comparison.difference_interval, short),
            effect,
            interval(comparison.effect_interval, hundredths),
        ]);
    }
    for column in table.column_iter_mut().skip(1) {
        column.set_cell_alignment(CellAlignment::Right);
    }
    let below = match compared.measures.iter().any(Comparison::is_below_own_error) {
        true => " Below error: the difference is smaller than what it is computed to.",
        false => "",
    };
    console.print(format_args!(
        "{}\n\nDifferences are of the other lot less the first; effect sizes are differences over the root of the mean of \
         both variances. Intervals take the lots as normal, and are told where both vary; of 100 such intervals about 5 miss \
         by chance alone.{below}",
        table.trim_fmt()
    ))?;
    for (outliers, which) in compared.outliers.iter().zip(["first", "other"]) {
        let of_lot = format!(" in the {which} lot");
        print_outliers(outliers, &of_lot, "with --json", console)?;
    }
    console.warn(&compared.warnings);
    Ok(())
}
