//! `grainform bed`

mod cast;
mod elsewhere;
mod lammps;
mod watch;

use super::args::BedArgs;
use super::console::Console;
use super::{inputs, outputs, threads};
use crate::bed::{Bed, BedSettings, Container, Folder, Rest, picture};
use crate::mesh::Mesh;
use crate::report::{BedReport, BedRunRecord, short};
use anyhow::{Result, anyhow};
use cast::Cast;
use elsewhere::Elsewhere;
use lammps::Lammps;
use std::path::Path;
use watch::Watch;

pub(super) fn run(args: BedArgs, console: Console) -> Result<()> {
    threads::start(args.threads, console)?;
    let metres = args.unit.metres();
    let Cast {
        names,
        kinds,
        shares,
        mut warnings,
    } = Cast::new(&args)?;
    let mesh = match &args.walls {
        Some(path) => Some(walls(path, &args, metres)?),
        None => None,
    };
    let elsewhere = match args.engine {
        Some(_) => Some(Lammps::found(args.ranks)?),
        None => None,
    };
    let (mut runs, mut last) = (Vec::new(), None);
    for seed in args.seed..args.seed.saturating_add(args.seeds) {
        let path = match args.seeds {
            1 => args.output.clone(),
            _ => args.output.join(format!("seed_{seed}")),
        };
        let settings = settings(&args, seed, metres);
        outputs::make_folder(&path)?;
        let (bed, run) = match elsewhere {
            Some(engine) => {
                let bed = Bed::loose(settings, kinds.clone(), &shares, None)?;
                let elsewhere = Elsewhere {
                    engine,
                    path: &path,
                    unit: metres,
                };
                if args.dry_run {
                    elsewhere.check(&bed, console)?;
                    continue;
                }
                elsewhere.settle(bed, console)?
            }
            None => {
                let bed = Bed::new(settings, kinds.clone(), &shares, mesh.as_ref())?;
                settle(bed, &path, metres, console)?
            }
        };
        outputs::write_image(&path.join("bed.png"), &picture(&bed))?;
        runs.push(run);
        last = Some(bed);
    }
    let Some(bed) = last else {
        console.warn(&warnings);
        return Ok(());
    };
    let mut report = BedReport::new(names, args.unit, &bed, runs);
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
    let mut watch = Watch::new(console, bed.settings().rest);
    // The loop runs in a thread of the pool, so that its parts need not be handed there one by one.
    let rest = rayon::scope(|_| {
        folder.settle(&mut bed, |bed| watch.tell(bed.seconds(), bed.liveliness()))
    })?;
    let run = BedRunRecord::new(&bed, rest == Rest::AtRest);
    Ok((bed, run))
}

/// The faces of a mesh, in metres.
fn walls(path: &Path, args: &BedArgs, metres: f64) -> Result<Mesh> {
    let bytes = inputs::read(path, &args.input.limit)?;
    let scan = crate::scan::parse_file(path, &bytes, None)?;
    if scan.triangles().is_empty() {
        return Err(anyhow!(
            "{} has no faces: walls need them",
            inputs::name(path)
        ));
    }
    Ok(Mesh {
        vertices: scan.points().iter().map(|point| point * metres).collect(),
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
