//! `grainform bed`

use super::args::BedArgs;
use super::console::{Console, put_json, say};
use super::progress::Progress;
use super::{inputs, outputs, threads};
use crate::bed::{Bed, BedSettings, Container, Folder, GrainKind, Rest, picture};
use crate::mesh::Mesh;
use crate::report::{BedReport, BedRunRecord, short};
use anyhow::{Context, Result, anyhow};
use indicatif::HumanDuration;
use std::io::{IsTerminal, stderr};
use std::path::Path;
use std::time::{Duration, Instant};

/// How often a line is told where there is no terminal.
const EVERY: Duration = Duration::from_secs(10);

/// Share of the most liveliness below which grains have fallen, and the time that is left can be told.
const FALLEN: f64 = 0.03;

/// How often the time that is left is thought over.
const FORETOLD: Duration = Duration::from_secs(2);

pub(super) fn run(args: BedArgs, console: Console) -> Result<()> {
    threads::start(args.threads, console)?;
    let metres = args.unit.metres();
    let mut kinds = Vec::new();
    for grain in &args.grains {
        kinds.push(kind(&grain.path, &args)?);
    }
    let shares: Vec<f64> = args.grains.iter().map(|grain| grain.share).collect();
    let mesh = match &args.walls {
        Some(path) => Some(walls(path, &args, metres)?),
        None => None,
    };
    let (mut runs, mut last) = (Vec::new(), None);
    for seed in args.seed..args.seed.saturating_add(args.seeds) {
        let path = match args.seeds {
            1 => args.output.clone(),
            _ => args.output.join(format!("seed_{seed}")),
        };
        let folder = Folder {
            path: &path,
            unit: metres,
        };
        let settings = settings(&args, seed, metres);
        let bed = Bed::new(settings, kinds.clone(), &shares, mesh.as_ref())?;
        outputs::make_folder(&path)?;
        let mut bed = folder.open(bed)?;
        if bed.steps() > 0 {
            let seconds = short(bed.seconds());
            console.note(
                "note",
                &format!("the bed in {} goes on after {seconds} s", path.display()),
            );
        }
        let mut watch = Watch::new(console);
        // The loop runs in a thread of the pool, so that its parts need not be handed there one by one.
        let rest = rayon::scope(|_| folder.settle(&mut bed, |bed| watch.tell(bed)))?;
        drop(watch);
        outputs::write_image(&path.join("bed.png"), &picture(&bed))?;
        runs.push(BedRunRecord::new(&bed, rest == Rest::AtRest));
        last = Some(bed);
    }
    let bed = last.ok_or_else(|| anyhow!("there is no seed to begin with"))?;
    let names = args.grains.iter().map(|grain| inputs::name(&grain.path));
    let report = BedReport::new(names.collect(), args.unit, &bed, runs);
    if args.json {
        return put_json(&report);
    }
    console.print(&report)?;
    console.wrote(&args.output.display().to_string())?;
    console.warn(&report.warnings);
    Ok(())
}

/// A model as a kind of grain.
fn kind(path: &Path, args: &BedArgs) -> Result<GrainKind> {
    let model = inputs::parse_model(path, &inputs::read(path, &args.limit)?)?;
    let name = inputs::name(path);
    let convex = model.superquadric().ok_or_else(|| {
        anyhow!(
            "{name} is not made of convex parts: fit --surface poly12 or multi to its scan first"
        )
    })?;
    let metres = args.unit.metres();
    let own = GrainKind::new(convex.body(), metres, args.density);
    let own = own.with_context(|| format!("{name} is no grain"))?;
    match args.diameter {
        Some(diameter) => {
            let factor = 0.5 * diameter * metres / own.radius();
            let scaled = GrainKind::new(convex.body(), metres * factor, args.density);
            scaled.with_context(|| format!("{name} cannot be {diameter} {} wide", args.unit))
        }
        None => Ok(own),
    }
}

/// The faces of a mesh, in metres.
fn walls(path: &Path, args: &BedArgs, metres: f64) -> Result<Mesh> {
    let bytes = inputs::read(path, &args.limit)?;
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

/// Tells how far a bed is: in a line that moves on a terminal, elsewhere in one now and then.
struct Watch {
    bar: Option<Progress>,
    is_quiet: bool,
    told: Instant,
    /// When, and how lively the bed was then.
    before: (Instant, f64),
    /// How lively it was at most.
    liveliest: f64,
    left: Option<Duration>,
}

impl Watch {
    fn new(console: Console) -> Self {
        let now = Instant::now();
        Self {
            bar: (stderr().is_terminal() && !console.is_verbose()).then(|| console.progress()),
            is_quiet: console.is_quiet(),
            told: now,
            before: (now, f64::NAN),
            liveliest: 0.0,
            left: None,
        }
    }

    fn tell(&mut self, bed: &Bed) {
        let (since, before) = self.before;
        if since.elapsed() > FORETOLD {
            let now = bed.liveliness();
            self.liveliest = self.liveliest.max(now);
            // Liveliness falls by about the same share in each second, once all grains have fallen.
            let rate = (before / now).ln() / since.elapsed().as_secs_f64();
            let left = (now / bed.settings().rest).ln() / rate;
            self.left = Duration::try_from_secs_f64(left)
                .ok()
                .filter(|_| rate > 0.0 && now < FALLEN * self.liveliest);
            self.before = (Instant::now(), now);
        }
        let is_due = self.told.elapsed() > EVERY && !self.is_quiet;
        if self.bar.is_none() && !is_due {
            return;
        }
        let left = match self.left {
            Some(left) => format!("about {} left", HumanDuration(left)),
            None => "still falling".into(),
        };
        let text = format!("{:.3} s simulated, {left}", bed.seconds());
        match &self.bar {
            Some(bar) => bar.stage(text),
            None => say(text),
        }
        self.told = Instant::now();
    }
}
