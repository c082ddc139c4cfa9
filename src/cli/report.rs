//! `grainform report`

use super::args::ReportArgs;
use super::console::Console;
use super::{idle, inputs, outputs, solid, threads};
use crate::bench;
use crate::digits::plural;
use crate::fit::{
    Context as FitContext, FitOptions, Fitted, Kind, Seams, fit_scan, whole_or_largest,
};
use crate::measure::{Scheme, Survey};
use crate::model::Grain;
use crate::page::{
    BenchPart, GrainPart, LotPart, MeasureRow, Page, SearchPart, Subject, write_page,
};
use crate::report::{
    FitReport, Measure, MeasureReport, ReportedScan, SearchReport, Unit, Withheld, by_reason,
    escaped, sentences, short,
};
use crate::scan::Scan;
use anyhow::{Context, Result, bail};
use std::path::{Path, PathBuf};

pub(super) fn run(args: ReportArgs, console: Console) -> Result<()> {
    threads::start(0, console)?;
    let grains = args.paths.iter().filter(|path| !path.is_dir());
    if args.png.is_some() && (args.paths.len() > 1 || grains.clone().next().is_none()) {
        bail!("--png draws one grain: name one scan or model");
    }
    if let (None, Some(option)) = (grains.clone().next(), of_grains(&args)) {
        bail!(
            "{option} is for scans and models, and results are told as batch has found them: name a scan, or leave it out"
        );
    }
    let files = [
        (Some(args.output.as_path()), &["html", "htm"][..]),
        (args.png.as_deref(), &["png"][..]),
    ];
    if args.truth.is_some() && !args.paths.iter().any(|path| path.is_dir()) {
        bail!(
            "--truth tells what is known of the scans in a folder of results: name such a folder"
        );
    }
    let named = grains.clone().map(PathBuf::as_path);
    let console = console.beside(outputs::check(named, &files, false)?);
    let progress = console.progress();
    progress.stage("Reading");
    let grains = grains.map(|path| Input::read(path, &args));
    let grains = grains.collect::<Result<Vec<_>>>()?;
    if let (true, Some(option)) = (grains.iter().all(|grain| grain.is_model), of_scans(&args)) {
        bail!("{option} is for scans, and no scan is named: leave it out");
    }
    let lots = args.paths.iter().filter(|path| path.is_dir());
    let lots = lots.map(|path| LotPart::read(path, args.truth.as_deref()));
    let lots = lots.collect::<Result<Vec<_>, _>>()?;
    let part = |grain: Input| {
        progress.stage(format_args!("Reporting {}", escaped(&grain.name)));
        grain.part(&args)
    };
    let grains = grains.into_iter().map(part).collect::<Result<_>>()?;
    let page = Page {
        version: env!("CARGO_PKG_VERSION"),
        command: command(),
        grains,
        lots,
    };
    progress.stage("Writing");
    outputs::write(&args.output, |file| Ok(write_page(&page, file)?))?;
    drop(progress);
    for path in [Some(&args.output), args.png.as_ref()]
        .into_iter()
        .flatten()
    {
        console.wrote(&outputs::name(path))?;
    }
    for lot in &page.lots {
        console.warn(lot.warnings());
    }
    Ok(())
}

/// An option of scans and models that is asked for.
fn of_grains(args: &ReportArgs) -> Option<&'static str> {
    let options = [
        (args.unit.is_some(), "--unit"),
        (args.extrapolate, "--extrapolate"),
        (args.input.label.is_some(), "--label"),
        (args.input.format.is_some(), "--format"),
    ];
    of_scans(args).or(idle::asked(&options))
}

/// An option of scans alone that is asked for.
fn of_scans(args: &ReportArgs) -> Option<&'static str> {
    idle::asked(&[
        (args.search, "--search"),
        (args.bench, "--bench"),
        (args.largest, "--largest"),
    ])
}

/// What was typed.
fn command() -> String {
    let words = std::env::args_os().skip(1);
    let words = words.map(|word| word.to_string_lossy().into_owned());
    std::iter::once("grainform".to_owned())
        .chain(words)
        .collect::<Vec<_>>()
        .join(" ")
}

/// A scan, which is fitted, or a model.
struct Input<'a> {
    path: &'a Path,
    name: String,
    bytes: Vec<u8>,
    is_model: bool,
}

impl<'a> Input<'a> {
    fn read(path: &'a Path, args: &ReportArgs) -> Result<Self> {
        let bytes = inputs::read(path, &args.input.limit)?;
        Ok(Self {
            path,
            name: inputs::name(path),
            is_model: inputs::is_model(path, &bytes, &args.input)?,
            bytes,
        })
    }

    fn part(self, args: &ReportArgs) -> Result<GrainPart> {
        match self.is_model {
            true => self.of_model(args),
            false => self.of_scan(args),
        }
    }

    fn hash(&self) -> (&'static str, String) {
        ("BLAKE3 of the input", blake3::hash(&self.bytes).to_string())
    }

    fn of_model(self, args: &ReportArgs) -> Result<GrainPart> {
        let hash = self.hash();
        let Self {
            path, name, bytes, ..
        } = self;
        let grain = inputs::parse_model(path, &bytes, args.unit)?;
        let unit = inputs::unit_of(grain.unit(), args.unit);
        solid::is_seen_whole(
            &grain,
            &name,
            "no page shows it; measure it, or write its mesh",
        )?;
        let survey = Survey::of_grain(&grain, Scheme::Exact);
        let withheld = Withheld::of(&grain, args.extrapolate);
        let (told, missing) = measured(&survey, &withheld, unit);
        let guess = grain.unseen().filter(|_| args.extrapolate);
        let guess = guess.map(|unseen| format!("Of {name}, {unseen}."));
        let foreign = inputs::foreign_unit(&grain, &name);
        let warnings = guess.into_iter().chain(missing).chain(foreign).collect();
        let measures = MeasureRow::of(&told.measures, told.standard_errors.as_ref(), unit);
        draw(args, &name, &grain, None, unit)?;
        let mut facts = vec![("model", plural(grain.coefficient_count(), "coefficient"))];
        facts.extend(no_errors(told.no_standard_errors));
        facts.push(hash);
        Ok(GrainPart::new(Subject {
            name,
            grain: &grain,
            scan: None,
            unit,
            facts,
            measures,
            warnings,
            search: None,
            bench: None,
        }))
    }

    fn of_scan(self, args: &ReportArgs) -> Result<GrainPart> {
        let hash = self.hash();
        let Self {
            path, name, bytes, ..
        } = self;
        let scan = inputs::parse_scan(path, &bytes, &args.input, args.unit)?;
        let unit = inputs::unit_of(scan.unit(), args.unit);
        let (scan, left_out) = whole_or_largest(scan, args.largest);
        let options = FitOptions::default();
        let failed = || format!("cannot fit {name}");
        let fitted = fit_scan(&scan, &options, &FitContext::default()).with_context(failed);
        let mut fitted = inputs::explained(fitted, &scan)?;
        fitted.warnings.extend(left_out);
        fitted.grain = fitted.grain_with_errors();
        let search = match args.search {
            true => Some(search(&scan, &name).with_context(failed)?),
            false => None,
        };
        let bench = match args.bench {
            true => Some(costs(&scan, &name).with_context(failed)?),
            false => None,
        };
        let survey = fitted.survey();
        let reported = ReportedScan {
            input: name.clone(),
            unit,
            ..ReportedScan::default()
        };
        let withheld = Withheld::of(&fitted.grain, args.extrapolate);
        let told = FitReport::with_survey(reported, &fitted, &survey, &options, &withheld);
        let mut warnings = sentences(scan.warnings(), &fitted.warnings, unit);
        let (measured, missing) = measured(&survey, &withheld, unit);
        warnings.extend(missing);
        let errors = measured.standard_errors.as_ref();
        let measures = MeasureRow::of(&measured.measures, errors, unit);
        draw(args, &name, &fitted.grain, Some(&scan), unit)?;
        let mut facts = facts(&told, &fitted);
        facts.push(hash);
        Ok(GrainPart::new(Subject {
            name,
            grain: &fitted.grain,
            scan: Some(&scan),
            unit,
            facts,
            measures,
            warnings,
            search,
            bench,
        }))
    }
}

/// All measures of a grain, and those that cannot be had or are withheld, as sentences.
fn measured(
    survey: &Survey,
    withheld: &Withheld,
    unit: Option<Unit>,
) -> (MeasureReport, Vec<String>) {
    let report = MeasureReport::of_model(String::new(), survey, &Measure::ALL, withheld);
    let report = report.in_unit(unit);
    let missing = by_reason(&report.not_measured).into_iter();
    let sentences = missing.map(|(names, reason)| format!("Not measured: {names}; {reason}."));
    let sentences = sentences.collect();
    (report, sentences)
}

/// Fits all independent segments, as the source does.
fn search(scan: &Scan, name: &str) -> Result<SearchPart> {
    let options = FitOptions {
        seams: Seams::None,
        kind: Kind::Star,
        exhaustive: true,
        ..FitOptions::default()
    };
    let fitted = fit_scan(scan, &options, &FitContext::default())?;
    let reported = ReportedScan {
        input: name.into(),
        ..ReportedScan::default()
    };
    Ok((&SearchReport::new(reported, &fitted, &options)).into())
}

/// Fits all families of models on one thread.
fn costs(scan: &Scan, name: &str) -> Result<BenchPart> {
    let subject = bench::Subject::unknown(name.into(), scan.clone());
    let pool = rayon::ThreadPoolBuilder::new().num_threads(1).build();
    let run = || bench::run(&subject, &|_, _, _| ());
    let scan = pool.context("cannot start a thread")?.install(run)?;
    Ok((&scan).into())
}

fn draw(
    args: &ReportArgs,
    name: &str,
    grain: &Grain,
    scan: Option<&Scan>,
    unit: Option<Unit>,
) -> Result<()> {
    let Some(path) = &args.png else {
        return Ok(());
    };
    outputs::write_picture(path, grain, scan, name.to_owned(), unit)
}

/// What the fit rests on and how good it is.
fn facts(report: &FitReport, fitted: &Fitted) -> Vec<(&'static str, String)> {
    let unit = report.unit.map_or(String::new(), |unit| format!(" {unit}"));
    let radius = match report.surface {
        "star" => "mean radius",
        _ => "radius of the ball of equal volume",
    };
    let length = |length: f64| {
        let share = 100.0 * length / report.mean_radius;
        let share = match share.abs() {
            0.0 | 0.001.. => format!("{share:.3}"),
            _ => format!("{share:.1e}"),
        };
        format!("{}{unit} ({share} % of the {radius})", short(length))
    };
    let mut facts = vec![("scan", plural(report.points, "point"))];
    let rule = report.surface_rule.as_ref();
    facts.extend(rule.map(|rule| ("surface", format!("{}, {rule}", report.surface))));
    facts.extend([
        (
            "model",
            format!(
                "degree {}, {}, {}",
                report.degree,
                plural(report.segments, "segment"),
                plural(report.coefficients, "coefficient")
            ),
        ),
        ("chosen for", report.rule.clone()),
        (
            "residuals",
            format!(
                "RMS {}, largest {}{unit}",
                length(report.rms),
                short(report.max)
            ),
        ),
    ]);
    facts.extend(report.heldout_rms.map(|rms| ("held-out RMS", length(rms))));
    let bound = report.noise_bound();
    let noise = report
        .noise
        .map(|noise| format!("{bound}{}", length(noise)));
    facts.extend(noise.map(|noise| ("noise", noise)));
    facts.push((radius, format!("{}{unit}", short(fitted.mean_radius))));
    facts.extend(no_errors(report.no_standard_errors.clone()));
    facts
}

/// Why there are no standard errors, if so.
fn no_errors(reason: Option<String>) -> Option<(&'static str, String)> {
    reason.map(|reason| ("no standard errors", reason))
}
