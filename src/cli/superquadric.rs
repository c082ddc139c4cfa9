//! `grainform fit --surface superquadric` and the like.

use super::args::FitArgs;
use super::console::Console;
use super::values::SuperquadricArg;
use super::{inputs, outputs, solid};
use crate::fit::{
    Context as FitContext, FitOptions, FitWarning, PreparedScan, fit_multi_superquadric,
    fit_superquadric, whole_or_largest,
};
use crate::model::Grain;
use crate::report::{FittedScan, SuperquadricReport, sentences};
use crate::scan::Scan;
use crate::unit::asked_or_told;
use anyhow::{Context, Result, bail};

/// Fits superquadrics and tells of them.
pub(super) fn run(
    args: &FitArgs,
    form: SuperquadricArg,
    options: &FitOptions,
    console: Console,
) -> Result<()> {
    if args.harmonics.is_some() || *options != FitOptions::default() {
        bail!(
            "superquadrics have neither segments, degrees, mirrors nor harmonics: leave these options away, or \
             --surface"
        );
    }
    if args.fitting.stats {
        bail!(
            "--stats counts the candidates of a search, and superquadrics have none: leave it out"
        );
    }
    let progress = console.progress();
    let (grain, scan, mut report) = fitted(args, form)?;
    let unit = inputs::unit_of(scan.unit(), args.fitting.unit);
    let grain = grain.with_unit(asked_or_told(args.fitting.unit, scan.unit()));
    if args.png.is_some() {
        solid::is_seen_whole(
            &grain,
            "the fit",
            "there is no picture of it; write a --mesh instead",
        )?;
    }
    if args.writes() {
        progress.stage("Writing");
    }
    report.warnings.extend(outputs::write_grain(args, &grain)?);
    if let Some(path) = &args.png {
        let title = format!("{}: {} points", args.fitting.name(), scan.points().len());
        outputs::write_picture(path, &grain, Some(&scan), title, unit)?;
    }
    drop(progress);
    let files = [&args.output, &args.mesh, &args.png];
    let written = files.into_iter().flatten().map(|path| outputs::name(path));
    console.tell(&report, args.fitting.json, written, &report.warnings)
}

/// Reads and fits the scan.
fn fitted(args: &FitArgs, form: SuperquadricArg) -> Result<(Grain, Scan, SuperquadricReport)> {
    let scan = inputs::scan(&args.fitting.scan, &args.fitting.input, args.fitting.unit)?;
    let (scan, others_left_out) = whole_or_largest(scan, args.fitting.largest);
    let fitted = fitted_to(args, form, &scan, others_left_out);
    let (grain, report) = inputs::explained(fitted, &scan)?;
    Ok((grain, scan, report))
}

fn fitted_to(
    args: &FitArgs,
    form: SuperquadricArg,
    scan: &Scan,
    others_left_out: Vec<FitWarning>,
) -> Result<(Grain, SuperquadricReport)> {
    let name = args.fitting.name();
    let unit = inputs::unit_of(scan.unit(), args.fitting.unit);
    let failed = || format!("cannot fit {name}");
    let prepared = PreparedScan::new(scan, FitOptions::default().symmetry);
    let (points, of_fit) = match (&prepared, form) {
        // A union needs no centre that sees all points: none is left out because none does.
        (Err(_), SuperquadricArg::Multi(_)) => (scan.points(), Vec::new()),
        (Ok(prepared), SuperquadricArg::Multi(_)) if is_for_a_centre(prepared) => {
            (scan.points(), Vec::new())
        }
        _ => {
            let prepared = prepared.as_ref().map_err(Clone::clone);
            let prepared = prepared.with_context(failed)?;
            (prepared.points(), prepared.warnings.clone())
        }
    };
    // Few numbers bridge what lies between sparse points.
    let unseen = match &prepared {
        Ok(prepared) if !prepared.may_be_known => prepared.unseen,
        _ => None,
    };
    let of_fit: Vec<FitWarning> = of_fit.into_iter().chain(others_left_out).collect();
    let fitted = FittedScan {
        input: name.clone(),
        unit,
        points: points.len(),
        reference: prepared.as_ref().ok().map(|prepared| prepared.reference),
        unseen: unseen.filter(|_| !args.extrapolate),
        warnings: sentences(&scan.warnings, &of_fit, unit),
    };
    let context = FitContext::default();
    let lattice = scan.voxel_lattice();
    let (grain, report) = match form {
        SuperquadricArg::Single(form) => {
            let found = fit_superquadric(points, lattice, form, &context).with_context(failed)?;
            let report = SuperquadricReport::of_single(fitted, &found);
            (found.grain()?, report)
        }
        SuperquadricArg::Multi(most) => {
            let found =
                fit_multi_superquadric(points, lattice, most, &context).with_context(failed)?;
            let report = SuperquadricReport::of_multi(fitted, &found);
            (found.grain()?, report)
        }
    };
    let grain = grain.with_unseen(unseen);
    Ok((grain.with_contradicted(report.contradicted), report))
}

/// Whether a scan was made ready for a radius, at the cost of points or of surface that its centre does not see.
fn is_for_a_centre(prepared: &PreparedScan<'_>) -> bool {
    let lost = |warning: &FitWarning| {
        matches!(
            warning,
            FitWarning::NotStarShaped { .. } | FitWarning::Strays { .. }
        )
    };
    prepared.warnings.iter().any(lost)
}
