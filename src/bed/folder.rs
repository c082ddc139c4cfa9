//! A bed settles, and a folder keeps what it needs to go on after it was stopped at any moment.

use super::former;
use super::names::{FRAMES, STATE, VTK};
use super::rest::Rest;
use super::settings::{BedError, BedSettings};
use super::settle::{Bed, State};
use super::write::{write_dump, write_vtk};
use crate::digits::given;
use crate::export::{SaveError, WriteError, sweep, write_atomically};
use serde::{Deserialize, Serialize};
use std::fs;
use std::io::{self, ErrorKind};
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

/// How often the state is saved.
const SAVED: Duration = Duration::from_secs(10);

/// Simulated seconds between two frames.
const FRAME: f64 = 0.05;

/// A folder of a bed: `state.json`, which is how it is now and all that it needs to go on; `frames`, a LAMMPS dump for
/// each twentieth of a second; and at the end `bed.vtk`.
///
/// Files appear whole or not at all. A bed that was stopped goes on from the last state, and ends with the same bytes;
/// one that begins removes the files of a former one first.
#[derive(Debug, Clone, Copy)]
pub struct Folder<'a> {
    /// Where it is; [`settle`](Self::settle) makes it if it is not there.
    pub path: &'a Path,
    /// Metres of the unit of lengths in frames and `bed.vtk`, above zero; the state is in SI units.
    pub unit: f64,
}

/// Why a bed has not settled.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum FolderError {
    /// The bed itself.
    #[error(transparent)]
    Bed(#[from] BedError),
    /// A file could not be written.
    #[error(transparent)]
    Save(#[from] SaveError),
    /// The unit of lengths is not above zero, or not finite.
    #[error("the unit of lengths must be a finite number of metres above zero, not {}", given(*unit))]
    Unit {
        /// The unit given, in metres.
        unit: f64,
    },
    /// The folder or a file in it could not be made, read or removed.
    #[error("cannot use {}", path.display())]
    Use {
        /// The folder or file.
        path: PathBuf,
        /// What failed.
        source: io::Error,
    },
    /// The state is that of another bed.
    #[error("{} is the state of another bed: choose another folder, or remove it", path.display())]
    Other {
        /// The file.
        path: PathBuf,
    },
    /// The state is cut, or one that the bed cannot come into.
    #[error(
        "no bed can go on from {}: it is cut, or its grains lie where they cannot come to, or are faster than they can become; choose \
         another folder, or remove it",
        path.display()
    )]
    Broken {
        /// The file.
        path: PathBuf,
        /// What failed, if it cannot be read.
        source: Option<serde_json::Error>,
    },
}

/// The state of a bed with what it belongs to.
#[derive(Serialize, Deserialize)]
struct Saved<S> {
    /// Version of the library, for steps are the same in one version only.
    version: String,
    /// Tells grains and walls from others.
    digest: String,
    settings: BedSettings,
    state: S,
}

impl Folder<'_> {
    /// The bed that the folder has a state of, if that is of the same grains, walls and settings, whose longest time
    /// may be another; a new one as it is.
    ///
    /// # Errors
    /// [`FolderError`].
    pub fn open(&self, bed: Bed) -> Result<Bed, FolderError> {
        let path = self.path.join(STATE);
        let bytes = match fs::read(&path) {
            Err(error) if error.kind() == ErrorKind::NotFound => return Ok(bed),
            Err(source) => return Err(FolderError::Use { path, source }),
            Ok(bytes) => bytes,
        };
        let found: Saved<State> = match serde_json::from_slice(&bytes) {
            Ok(found) => found,
            Err(error) => {
                let source = Some(error);
                return Err(FolderError::Broken { path, source });
            }
        };
        let settings = BedSettings {
            most_seconds: bed.settings.most_seconds,
            ..found.settings
        };
        let is_own = found.version == env!("CARGO_PKG_VERSION")
            && found.digest == digest(&bed)
            && settings == bed.settings;
        if !is_own {
            return Err(FolderError::Other { path });
        }
        let source = None;
        bed.resumed(found.state)
            .ok_or(FolderError::Broken { path, source })
    }

    /// Makes way for a bed that another engine lets settle: removes the files of a former one.
    ///
    /// # Errors
    /// [`FolderError`], where there is a state, which that engine could not go on from.
    pub fn make_way(&self) -> Result<(), FolderError> {
        let path = self.path.join(STATE);
        match path.exists() {
            true => Err(FolderError::Other { path }),
            false => self.clear(),
        }
    }

    fn clear(&self) -> Result<(), FolderError> {
        former::clear(self.path).map_err(failed(self.path))
    }

    /// Goes on until the bed is at rest or its time is up. `told` hears of each look at it. What was written of a bed
    /// that runs away is removed.
    ///
    /// # Errors
    /// [`FolderError`].
    pub fn settle(&self, bed: &mut Bed, mut told: impl FnMut(&Bed)) -> Result<Rest, FolderError> {
        // Written so that NaN fails.
        if !(self.unit > 0.0 && self.unit.is_finite()) {
            return Err(FolderError::Unit { unit: self.unit });
        }
        if bed.steps() == 0 {
            self.clear()?;
        }
        let frames = self.path.join(FRAMES);
        fs::create_dir_all(&frames).map_err(failed(&frames))?;
        // Files that a killed process was about to write.
        sweep(self.path);
        sweep(&frames);
        let frame = |bed: &Bed| (bed.seconds() / FRAME).floor() as u64;
        let write_frame = |bed: &Bed| {
            let path = frames.join(format!("bed.{:05}.dump", frame(bed)));
            write_atomically(&path, |writer| write_dump(bed, self.unit, writer))
        };
        if bed.steps() == 0 {
            write_frame(bed)?;
        }
        let mut saved = Instant::now();
        let rest = loop {
            if let Some(rest) = bed.rest() {
                break rest;
            }
            let before = frame(bed);
            if let Err(error) = bed.go_on() {
                self.clear()?;
                return Err(error.into());
            }
            if frame(bed) > before {
                write_frame(bed)?;
            }
            if saved.elapsed() > SAVED {
                self.keep(bed)?;
                saved = Instant::now();
            }
            told(bed);
        };
        self.keep(bed)?;
        let path = self.path.join(VTK);
        write_atomically(&path, |writer| write_vtk(bed, self.unit, writer))?;
        Ok(rest)
    }

    /// Saves the state.
    pub(super) fn keep(&self, bed: &Bed) -> Result<(), SaveError> {
        let saved = Saved {
            version: env!("CARGO_PKG_VERSION").into(),
            digest: digest(bed),
            settings: bed.settings.clone(),
            state: &bed.state,
        };
        write_atomically(&self.path.join(STATE), |writer| {
            serde_json::to_writer(&mut *writer, &saved)
                .map_err(|error| WriteError::Io(error.into()))
        })
    }
}

fn failed(path: &Path) -> impl FnOnce(io::Error) -> FolderError {
    let path = path.to_path_buf();
    move |source| FolderError::Use { path, source }
}

/// Tells grains and walls from others: the FNV-1a hash of their numbers, each written in full.
fn digest(bed: &Bed) -> String {
    let kinds = bed.bodies().iter().map(|body| body.kind);
    let order: Vec<usize> = kinds.collect();
    let text = format!("{:?} {:?} {order:?}", bed.kinds, bed.walls);
    let hash = text.bytes().fold(0xcbf2_9ce4_8422_2325_u64, |hash, byte| {
        (hash ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3)
    });
    format!("{hash:016x}")
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::bed::tests::few;

    #[test]
    fn a_folder_is_made_by_a_bed_that_settles_and_has_a_unit() {
        let (settings, kinds) = few(BedSettings {
            most_seconds: 1e-3,
            ..BedSettings::default()
        });
        let above = tempfile::tempdir().unwrap();
        let path = &above.path().join("a/b");
        let settled = |unit: f64| {
            let mut bed = Bed::new(settings.clone(), kinds.clone(), &[1.0, 1.0], None).unwrap();
            Folder { path, unit }.settle(&mut bed, |_| {})
        };
        for unit in [0.0, -1e-3, f64::INFINITY, f64::NAN] {
            let found = settled(unit);
            assert!(
                matches!(found, Err(FolderError::Unit { .. })),
                "{unit}: {found:?}"
            );
            assert!(!path.exists());
        }
        settled(1e-3).unwrap();
        assert!(path.join("bed.vtk").exists());
    }
}
