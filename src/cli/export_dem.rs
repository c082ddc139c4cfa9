//! `grainform export-dem`

use super::args::{DeckArgs, ExportDemArgs};
use super::console::Console;
use super::solid::Solid;
use super::values::EngineArg;
use super::{idle, inputs, outputs, solid, threads};
use crate::clump::clump;
use crate::engines::{AnmExpansion, Deck, Engine, GrainMaterial, InputFile, Kind, anm_files};
use crate::measure::{SPECTRUM_DEGREE, Scheme, Survey};
use crate::model::{Grain, Superquadric};
use crate::report::{ClumpReport, Unit, short};
use anyhow::{Context, Result, bail};
use std::path::PathBuf;

/// A body, what its input is called, and its name in the folder.
struct Subject {
    solid: Solid,
    input: String,
    name: String,
}

/// Grains in the engine where no number is given, and the seed of their orientations.
const GRAINS: usize = 200;
const SEED: u64 = 1;

pub(super) fn run(args: ExportDemArgs, console: Console) -> Result<()> {
    if let Some((option, reason)) = args.deck.idle(args.engine) {
        bail!("{option} is for engines in which {reason}: leave it out");
    }
    outputs::check_folder(&args.output)?;
    threads::start(0, console)?;
    let progress = console.progress();
    progress.stage("Reading");
    let subjects = read(&args)?;
    let solids = subjects.iter().map(|subject| subject.solid.unit.as_deref());
    let unit = inputs::needed_unit(
        args.paths.iter().map(PathBuf::as_path).zip(solids),
        args.unit,
    )?;
    progress.stage("Finding spheres");
    let column;
    let (files, told) = match args.engine {
        EngineArg::Anm => shapes(unit, &subjects)?,
        EngineArg::Deck(engine) => {
            let (deck, mut told) = deck(&args.deck, unit, &subjects)?;
            column = deck;
            told.extend(engine.remarks(&column));
            (engine.files(&column), told)
        }
    };
    progress.stage("Writing");
    outputs::write_inputs(&args.output, &files)?;
    drop(progress);
    for line in told {
        console.print(line)?;
    }
    for subject in &subjects {
        console.warn(&subject.solid.warnings);
    }
    let folder = args.output.display();
    console.warn(&Vec::from_iter(outputs::beside(
        &args.output,
        files.iter().map(|file| &file.path),
    )));
    console.wrote(&format!("{folder}: {} files", files.len()))
}

fn read(args: &ExportDemArgs) -> Result<Vec<Subject>> {
    let mut subjects: Vec<Subject> = Vec::new();
    for path in &args.paths {
        let stem = path.file_stem().map(|stem| stem.to_string_lossy());
        let stem = stem.filter(|stem| stem != "-").unwrap_or("grain".into());
        let twins = subjects.iter().filter(|subject| {
            let (head, number) = subject.name.rsplit_once('_').unwrap_or((&subject.name, ""));
            subject.name == stem || (head == stem && number.parse::<usize>().is_ok())
        });
        let name = match twins.count() {
            0 => stem.into_owned(),
            twins => format!("{stem}_{}", twins + 1),
        };
        subjects.push(Subject {
            solid: solid::read(path, &args.input, args.unit)?,
            input: inputs::name(path),
            name,
        });
    }
    Ok(subjects)
}

/// The deck, and what is lost by each clump.
fn deck(args: &DeckArgs, unit: Unit, subjects: &[Subject]) -> Result<(Deck, Vec<String>)> {
    let metres = unit.metres();
    let material = args.material();
    let density = material.density;
    let (mut kinds, mut told) = (Vec::new(), Vec::new());
    for Subject { solid, input, name } in subjects {
        let found = clump(&solid.mesh, &solid.properties, args.spheres.target())
            .with_context(|| format!("cannot make a clump of {input}"))?;
        let kind = Kind::new(name, &found, metres, density)
            .with_context(|| format!("cannot write {input} for an engine"))?
            .with_doubts(&solid.warnings);
        kinds.push(match solid.grain.as_ref().and_then(single) {
            Some(shape) => kind.with_superquadric(&shape, metres),
            None => kind,
        });
        let report = ClumpReport::new(input.clone(), &found, Some(unit), Vec::new())
            .with_volume_error(solid.volume_error);
        told.push(format!("grain         {name}\n{report}"));
    }
    let grains = args.grains.unwrap_or(GRAINS);
    let seed = args.seed.unwrap_or(SEED);
    Ok((Deck::column(kinds, grains, material, seed)?, told))
}

impl DeckArgs {
    /// An option that is asked for and has no effect in an engine, and what it is for.
    fn idle(&self, engine: EngineArg) -> Option<(&'static str, &'static str)> {
        let seed = (self.seed.is_some(), "--seed");
        let grains = (self.grains.is_some(), "--grains");
        let rest = [
            (self.spheres.spheres.is_some(), "--spheres"),
            (self.spheres.error.is_some(), "--error"),
            (self.density.is_some(), "--density"),
            (self.youngs_modulus_mpa.is_some(), "--youngs-modulus-mpa"),
            (self.poissons_ratio.is_some(), "--poissons-ratio"),
            (self.friction.is_some(), "--friction"),
            (self.restitution.is_some(), "--restitution"),
        ];
        // Spheres and density make the clump; the rest is how it touches others.
        let (_, contact) = rest.split_at(3);
        let (options, reason) = match engine {
            EngineArg::Deck(Engine::Lammps | Engine::Yade) => return None,
            EngineArg::Deck(Engine::Liggghts) => (
                vec![seed],
                "the folder places the grains, and LIGGGHTS places them itself",
            ),
            EngineArg::Deck(Engine::MercuryDpm) => (
                [&[seed, grains][..], contact].concat(),
                "the folder tells where grains lie and how they touch, and of MercuryDPM a driver does",
            ),
            EngineArg::Anm => (
                [&[seed, grains][..], &rest].concat(),
                "clumps of spheres fall, and anm tells shapes only",
            ),
        };
        Some((idle::asked(&options)?, reason))
    }

    fn material(&self) -> GrainMaterial {
        GrainMaterial {
            youngs_modulus: 1e6 * self.youngs_modulus_mpa.unwrap_or(10.0),
            poissons_ratio: self.poissons_ratio.unwrap_or(0.3),
            friction: self.friction.unwrap_or(0.3),
            rolling_friction: 0.0,
            restitution: self.restitution.unwrap_or(0.5),
            density: self.density.unwrap_or(2500.0),
        }
    }
}

/// The one superquadric that a grain is.
fn single(grain: &Grain) -> Option<Superquadric> {
    match grain.superquadric()?.body().parts() {
        [part] => Some(part.shape),
        _ => None,
    }
}

/// Files of harmonics, and what is lost by each.
fn shapes(unit: Unit, subjects: &[Subject]) -> Result<(Vec<InputFile<'static>>, Vec<String>)> {
    let metres = unit.metres();
    let (mut grains, mut told) = (Vec::new(), Vec::new());
    for Subject { solid, input, name } in subjects {
        let failed = || format!("cannot expand {input} about its centre of mass");
        let survey = match &solid.grain {
            Some(grain) => Survey::of_grain(grain, Scheme::Exact),
            None => Survey::of_mesh(&solid.mesh).with_context(failed)?,
        };
        let found = survey.expansion(SPECTRUM_DEGREE).with_context(failed)?;
        told.push(format!(
            "grain         {name}\nharmonics     degree {SPECTRUM_DEGREE}, RMS {} {unit} from the grain",
            short(found.rms)
        ));
        let real: Vec<f64> = found.coefficients.iter().map(|a| a * metres).collect();
        grains.push((name.clone(), AnmExpansion::from_real(&real)));
    }
    let doubts = subjects.iter().flat_map(|subject| {
        let name = &subject.name;
        let doubts = subject.solid.warnings.iter();
        doubts.map(move |doubt| format!("{name}: {doubt}"))
    });
    Ok((anm_files(&grains, &doubts.collect::<Vec<_>>())?, told))
}
