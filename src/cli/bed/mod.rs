//! `grainform bed`

mod cast;
mod elsewhere;
mod lammps;
mod place;
mod sizes;
mod watch;

use super::args::BedArgs;
use super::console::Console;
use super::{inputs, outputs, signals, threads};
use crate::bed::{
    Bed, BedError, BedSettings, Container, FILES, Folder, PICTURE, Rest, fabric, picture,
};
use crate::mesh::Mesh;
use crate::report::{BedInputsReport, BedReport, BedRunRecord, Unit, short};
use anyhow::{Result, anyhow, bail};
use cast::Cast;
use elsewhere::Elsewhere;
use lammps::Lammps;
use place::Place;
use std::path::Path;
use watch::Watch;

pub(super) fn run(args: BedArgs, console: Console) -> Result<()> {
    outputs::check_folder(&args.output)?;
    threads::start(args.threads, console)?;
    let Some(last_seed) = args.seed.checked_add(args.seeds - 1) else {
        bail!(
            "there are no {} seeds from {} on: the last is {}",
            args.seeds,
            args.seed,
            u64::MAX
        );
    };
    let Cast {
        unit,
        names,
        kinds,
        shares,
        mut warnings,
    } = Cast::new(&args)?;
    let metres = unit.metres();
    let mesh = match &args.walls {
        Some(path) => Some(walls(path, &args, unit)?),
        None => None,
    };
    let engine = match args.engine {
        Some(_) => Some(Lammps::found(args.ranks)?),
        None => None,
    };
    let (mut runs, mut checked, mut last) = (Vec::new(), Vec::new(), None);
    for seed in args.seed..=last_seed {
        let path = match args.seeds {
            1 => args.output.clone(),
            _ => args.output.join(format!("seed_{seed}")),
        };
        let settings = settings(&args, seed, metres);
        let failed = |error| in_unit(error, unit);
        let (bed, run) = match engine {
            Some(engine) => {
                let bed = Bed::loose(settings, kinds.clone(), &shares, None).map_err(failed)?;
                let elsewhere = Elsewhere {
                    engine,
                    path: &path,
                    unit: metres,
                };
                if args.dry_run {
                    checked.push(elsewhere.check(&bed)?);
                    continue;
                }
                elsewhere.settle(bed, console)?
            }
            None => {
                let bed = Bed::new(settings, kinds.clone(), &shares, mesh.as_ref());
                let done = settle(bed.map_err(failed)?, &path, metres, console)?;
                warnings.extend(outputs::beside(&path, FILES.iter()));
                done
            }
        };
        outputs::write_image(&path.join(PICTURE), &picture(&bed))?;
        runs.push(run);
        last = Some(bed);
    }
    let Some(bed) = last else {
        let report = BedInputsReport::new("LAMMPS", checked, warnings);
        return console.tell(&report, args.json, [], &report.warnings);
    };
    let mut report = BedReport::new(names, unit, &bed, runs);
    report.warnings.append(&mut warnings);
    let written = args.output.display().to_string();
    console.tell(&report, args.json, [written], &report.warnings)
}

/// Lets a bed settle here, from the state in its folder on if there is one.
fn settle(bed: Bed, path: &Path, unit: f64, console: Console) -> Result<(Bed, BedRunRecord)> {
    let folder = Folder { path, unit };
    let mut bed = folder.open(bed)?;
    if bed.steps() > 0 {
        let seconds = short(bed.seconds());
        console.note(
            "note",
            &format!("the bed in {} goes on after {seconds} s", path.display()),
        );
    }
    let place = Place::make(path)?;
    signals::keeps_work(console);
    let mut watch = Watch::new(console, bed.settings().rest);
    // The loop runs in a thread of the pool, so that its parts need not be handed there one by one.
    let rest = rayon::scope(|_| {
        folder.settle(&mut bed, |bed| watch.tell(bed.seconds(), bed.liveliness()))
    });
    match rest {
        Ok(rest) => {
            let (is_at_rest, fabric) = (rest == Rest::AtRest, fabric(&bed));
            let run = BedRunRecord::new(&bed, is_at_rest, bed.seconds(), bed.steps(), fabric);
            Ok((bed, run))
        }
        Err(error) => {
            place.leave();
            Err(error.into())
        }
    }
}

/// An error with its lengths in the unit of the command.
fn in_unit(error: BedError, unit: Unit) -> anyhow::Error {
    match error {
        BedError::Narrow { widest } => anyhow!(
            "the container is too narrow: a grain is up to {} {unit} wide",
            short(widest / unit.metres())
        ),
        other => other.into(),
    }
}

/// The faces of a mesh, in metres.
fn walls(path: &Path, args: &BedArgs, unit: Unit) -> Result<Mesh> {
    let bytes = inputs::read(path, &args.input.limit)?;
    let scan = crate::scan::parse_file(path, &bytes, None)?;
    inputs::check_unit(path, scan.unit(), Some(unit))?;
    if scan.triangles().is_empty() {
        return Err(anyhow!(
            "{} has no faces: walls need them",
            inputs::name(path)
        ));
    }
    Ok(Mesh {
        vertices: scan
            .points()
            .iter()
            .map(|point| point * unit.metres())
            .collect(),
        triangles: scan.triangles().to_vec(),
    })
}

fn settings(args: &BedArgs, seed: u64, metres: f64) -> BedSettings {
    let container = match (args.sides, args.cylinder) {
        (Some(sides), _) => Container::Box(sides.map(|side| side * metres)),
        (None, diameter) => Container::Cylinder(0.5 * metres * diameter.unwrap_or(0.0)),
    };
    BedSettings {
        grains: args.count,
        container,
        density: args.density,
        youngs_modulus_pa: 1e6 * args.youngs_modulus_mpa,
        poissons_ratio: args.poissons_ratio,
        friction: args.friction,
        rolling_friction: args.rolling_friction,
        damping: args.damping,
        rest: args.rest,
        most_seconds: args.seconds,
        seed,
        ..BedSettings::default()
    }
}
