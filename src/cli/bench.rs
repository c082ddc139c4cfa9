//! `grainform bench`

use super::args::BenchArgs;
use super::console::Console;
use super::streams::put_json;
use super::{inputs, outputs};
use crate::bench::{
    self, BenchReport, BenchRow, BenchScan, Cost, Family, Subject, find_rivals, plot, synthetic,
    write_csv,
};
use crate::export::write_atomically;
use crate::fit::PreparedScan;
use crate::report::{described_reference, escaped, percent, round};
use crate::sphere::Symmetry;
use anyhow::{Context, Result, bail};
use comfy_table::{CellAlignment, Table, presets::NOTHING};
use std::path::{Path, PathBuf};

pub(super) fn run(args: BenchArgs, console: Console) -> Result<()> {
    outputs::check_folder(&args.output)?;
    rayon::ThreadPoolBuilder::new()
        .num_threads(1)
        .build_global()
        .context("cannot start a thread")?;
    if args.rivals {
        find_rivals()?;
    }
    let mut subjects = match args.scans.as_slice() {
        [] => synthetic()?,
        paths => read(paths, &args)?,
    };
    if args.rivals {
        subjects = subjects
            .into_iter()
            .map(Subject::with_hidden_points)
            .collect();
    }
    let stems = stems(&subjects)?;
    outputs::make_folder(&args.output)?;

    let progress = console.progress();
    let scans = subjects.iter().zip(&stems).map(|(subject, stem)| {
        bench::run(subject, &|setting, done, all| {
            progress.step(done, all, format_args!("{}: {setting}", escaped(stem)));
        })
        .with_context(|| format!("cannot fit {}", subject.name))
    });
    let report = BenchReport {
        unit: args.unit,
        scans: scans.collect::<Result<_>>()?,
    };
    let written = write_files(&args.output, &report, &stems)?;
    drop(progress);

    if args.json {
        return put_json(&report);
    }
    for scan in &report.scans {
        console.print(heading(scan))?;
        console.print(format_args!("{}\n", table(scan).trim_fmt()))?;
        if let Some(sentence) = beside_rivals(scan) {
            console.print(format_args!("{sentence}\n"))?;
        }
    }
    for path in written {
        console.wrote(&path.display().to_string())?;
    }
    Ok(())
}

/// The scans of these files, each of which can be fitted: better said now than after minutes.
fn read(paths: &[PathBuf], args: &BenchArgs) -> Result<Vec<Subject>> {
    let subject = |path: &PathBuf| {
        let scan = inputs::scan(path, &args.input, args.unit)?;
        let name = inputs::name(path);
        let failed = || format!("cannot fit {name}");
        let prepared = PreparedScan::new(&scan, Symmetry::NONE).with_context(failed);
        inputs::explained(prepared.map(drop), &scan)?;
        Ok(Subject::unknown(name, scan))
    };
    paths.iter().map(subject).collect()
}

/// What the names of a scan's plots begin with: the name of its file without folder and extension.
fn stems(subjects: &[Subject]) -> Result<Vec<String>> {
    let mut stems: Vec<String> = Vec::with_capacity(subjects.len());
    for subject in subjects {
        let name = Path::new(&subject.name).file_stem().unwrap_or_default();
        let is_noisy = subject
            .truth
            .as_ref()
            .is_some_and(|truth| truth.noise > 0.0);
        let noisy = if is_noisy { "-noisy" } else { "" };
        let stem = format!("{}{noisy}", name.to_string_lossy());
        if stems.contains(&stem) {
            bail!(
                "two scans are named {stem}, and so would be their plots; give one of them another \
                 name"
            );
        }
        stems.push(stem);
    }
    Ok(stems)
}

/// Writes the table and the plots; gives their names.
fn write_files(folder: &Path, report: &BenchReport, stems: &[String]) -> Result<Vec<PathBuf>> {
    let csv = folder.join("bench.csv");
    write_atomically(&csv, |mut file| Ok(write_csv(report, &mut file)?))?;
    let mut written = vec![csv];
    for (scan, stem) in report.scans.iter().zip(stems) {
        for cost in Cost::ALL {
            let path = folder.join(format!("{stem}-{}.svg", cost.name()));
            let svg = plot(scan, cost)?;
            write_atomically(&path, |file| Ok(file.write_all(svg.as_bytes())?))?;
            written.push(path);
        }
    }
    Ok(written)
}

fn heading(scan: &BenchScan) -> String {
    let reference = match scan.reference {
        "truth" => "the closed form",
        kind => described_reference(kind),
    };
    let hidden = match scan.hidden {
        0 => String::new(),
        hidden => format!(", {hidden} more are hidden"),
    };
    let skipped = match scan.skipped {
        0 => String::new(),
        1 => "; 1 setting has more coefficients than half of the points".into(),
        count => format!("; {count} settings have more coefficients than half of the points"),
    };
    let refused = match scan.refused {
        0 => String::new(),
        count => format!("; {count} settings give no body near the points"),
    };
    format!(
        "{}{hidden}; errors against {reference}{skipped}{refused}",
        scan.title()
    )
}

/// How the default fit does beside the rival; nothing without rivals.
fn beside_rivals(scan: &BenchScan) -> Option<String> {
    let own = scan.automatic().filter(|_| scan.hidden > 0)?;
    let error = 100.0 * own.error();
    let Some(rival) = scan.rival_as_good_as(own) else {
        return Some(format!(
            "The default fit's hidden RMS is {error:.4} %: no degree of ducc0 that the points bear is as good."
        ));
    };
    let times = |cost: Cost| cost.of(own) / cost.of(rival);
    let bulk = own.nanoseconds_bulk.zip(rival.nanoseconds_bulk)?;
    Some(format!(
        "The default fit's hidden RMS is {error:.4} %, where ducc0 needs degree {}. Seconds: {:.2} times ducc0's; one \
         evaluation: {:.2} times the time, of many {:.2} times.",
        rival.degree?,
        times(Cost::Seconds),
        times(Cost::Nanoseconds),
        bulk.0 / bulk.1,
    ))
}

/// The rows on a Pareto front, by coefficients. Shares are of the mean radius.
fn table(scan: &BenchScan) -> Table {
    let fronts = Cost::ALL.map(|cost| scan.front(cost));
    let mut rows: Vec<usize> = fronts.iter().flatten().copied().collect();
    rows.sort_by_key(|&i| (scan.rows[i].coefficients, i));
    rows.dedup();

    let mut table = Table::new();
    table.load_style(NOTHING).set_header([
        "family",
        "tolerance",
        "segments",
        "degree",
        "coefficients",
        "touched",
        "seconds",
        "ns",
        match scan.hidden {
            0 => "held-out RMS",
            _ => "hidden RMS",
        },
        "area",
        "volume",
        "true RMS",
        "seam jump",
        "least for",
    ]);
    for i in rows {
        let costs = Cost::ALL.into_iter().zip(&fronts);
        let least_for: Vec<_> = costs
            .filter(|(_, front)| front.contains(&i))
            .map(|(cost, _)| cost.name())
            .collect();
        table.add_row(
            cells(&scan.rows[i])
                .into_iter()
                .chain([least_for.join(", ")]),
        );
    }
    for column in table.column_iter_mut().skip(1).take(12) {
        column.set_cell_alignment(CellAlignment::Right);
    }
    table
}

fn cells(row: &BenchRow) -> [String; 13] {
    let share =
        |share: Option<f64>| share.map_or("-".into(), |share| format!("{:.3} %", 100.0 * share));
    [
        row.family.name().into(),
        match (row.tolerance, row.family) {
            (Some(share), _) => format!("{} %", round(100.0 * share)),
            (None, Family::Adaptive) => "auto".into(),
            (None, _) => "-".into(),
        },
        row.segments.to_string(),
        row.degree.map_or("-".into(), |degree| degree.to_string()),
        row.coefficients.to_string(),
        format!("{:.0}", row.touched),
        format!("{:.5}", Cost::Seconds.of(row)),
        format!("{:.0}", row.nanoseconds),
        share(Some(row.error()).filter(|error| error.is_finite())),
        percent(row.area_error),
        percent(row.volume_error),
        share(row.rms_error),
        share(Some(row.seam_jump)),
    ]
}
