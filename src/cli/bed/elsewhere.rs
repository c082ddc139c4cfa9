//! A bed that another engine lets settle.

use super::lammps::Lammps;
use super::watch::Watch;
use crate::bed::{Bed, Fabric, Folder, VTK, write_vtk};
use crate::cli::console::Console;
use crate::cli::outputs;
use crate::engines::{Deck, Engine, Settled};
use crate::report::{BedInputsRecord, BedRunRecord};
use anyhow::{Result, bail};
use std::path::Path;

/// Where an engine runs.
pub(super) struct Elsewhere<'a> {
    pub(super) engine: Lammps,
    pub(super) path: &'a Path,
    /// Metres of the unit of lengths in `bed.vtk`.
    pub(super) unit: f64,
}

impl Elsewhere<'_> {
    /// Writes the files, lets the engine run them, and reads where the grains have come to lie.
    pub(super) fn settle(&self, bed: Bed, console: Console) -> Result<(Bed, BedRunRecord)> {
        let deck = self.written(&bed)?;
        let mut watch = Watch::new(console, deck.rest);
        let step = deck.time_step();
        self.engine.run(self.path, |line| {
            let liveliness = line.energy / deck.rest_energy() * deck.rest;
            watch.tell(line.steps as f64 * step, liveliness);
        })?;
        let Settled {
            bodies,
            contacts,
            steps,
        } = Settled::read(self.path, &bed, &deck)?;
        let bed = bed.moved(bodies)?;
        outputs::write(&self.path.join(VTK), |file| {
            write_vtk(&bed, self.unit, file)
        })?;
        let fabric = Fabric::of(&bed, &contacts);
        let is_at_rest = steps < deck.most_steps();
        let run = BedRunRecord::new(&bed, is_at_rest, steps as f64 * step, steps, fabric);
        Ok((bed, run))
    }

    /// Writes the files, lets the engine read them, and tells what it has found.
    pub(super) fn check(&self, bed: &Bed) -> Result<BedInputsRecord> {
        let deck = self.written(bed)?;
        let expected = [deck.grains.len(), deck.spheres()];
        let found = self.engine.read(self.path)?;
        if found != expected {
            bail!("LAMMPS has read {found:?} grains and spheres of {expected:?}");
        }
        let [grains, spheres] = found;
        Ok(BedInputsRecord {
            seed: bed.settings().seed,
            folder: self.path.display().to_string(),
            grains,
            spheres,
            most_steps: deck.most_steps(),
            step_s: deck.time_step(),
        })
    }

    fn written(&self, bed: &Bed) -> Result<Deck> {
        let deck = Deck::of_bed(bed)?;
        let folder = Folder {
            path: self.path,
            unit: self.unit,
        };
        folder.make_way()?;
        outputs::write_inputs(self.path, &Engine::Lammps.files(&deck))?;
        Ok(deck)
    }
}
