//! What LAMMPS leaves of a bed, read row by row.

use crate::bed::{Bed, Body, GrainContact};
use crate::engines::Deck;
use nalgebra::{Point3, Quaternion, UnitQuaternion};
use std::fs::File;
use std::io::{self, BufRead, BufReader, Read};
use std::path::{Path, PathBuf};

/// Longest line that is read of a dump.
const LONGEST_LINE: u64 = 1000;

/// A bed that LAMMPS has let settle.
#[derive(Debug, Clone, PartialEq)]
pub struct Settled {
    /// The grains where they lie, without what they move.
    pub bodies: Vec<Body>,
    /// Where spheres of different grains touch, with the force that LAMMPS tells.
    pub contacts: Vec<GrainContact>,
    /// Steps that were run.
    pub steps: u64,
}

/// Why a folder tells of no settled bed.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum SettledError {
    /// A file cannot be read.
    #[error("cannot read {}: {source}", path.display())]
    Read {
        /// The file.
        path: PathBuf,
        /// What failed.
        source: io::Error,
    },
    /// A file that is not the dump of this bed.
    #[error("{} is not the dump of this bed: line {line}", path.display())]
    Other {
        /// The file.
        path: PathBuf,
        /// The first line that is odd, from one on.
        line: usize,
    },
}

impl Settled {
    /// Reads the folder in which LAMMPS has run the deck of a bed.
    ///
    /// # Errors
    /// [`SettledError`].
    pub fn read(folder: &Path, bed: &Bed, deck: &Deck) -> Result<Self, SettledError> {
        let count = bed.bodies().len();
        let mut starts = vec![None; count];
        read(&folder.join("start.dump"), |[mol, _, _, _, w, x, y, z]| {
            *starts.get_mut(index(mol)?)? = Some(turn([w, x, y, z])?);
            Some(())
        })?;
        let mut bodies = bed.bodies().to_vec();
        let mut left = count;
        let steps = read(&folder.join("grains.dump"), |[mol, x, y, z, a, i, j, k]| {
            let index = index(mol)?;
            let body = bodies.get_mut(index)?;
            // What LAMMPS has turned its axes by, from where they were.
            let way = turn([a, i, j, k])? * starts[index].take()?.inverse();
            *body = Body {
                position: Point3::new(x, y, z),
                velocity: Default::default(),
                orientation: way * body.orientation,
                momentum: Default::default(),
                ..*body
            };
            left -= 1;
            Some(())
        })?;
        if left > 0 {
            let path = folder.join("grains.dump");
            return Err(SettledError::Other { path, line: 1 });
        }
        let first = deck.first_spheres();
        let radius = |sphere: usize| {
            let grain = first
                .partition_point(|first| *first <= sphere)
                .checked_sub(1)?;
            let kind = &deck.kinds[deck.grains.get(grain)?.kind];
            Some((grain as u32, kind.spheres[sphere - first[grain]].radius))
        };
        let mut contacts = Vec::new();
        read(
            &folder.join("contacts.dump"),
            |[one, other, distance, force]| {
                let [one, other] = [radius(index(one)?)?, radius(index(other)?)?];
                contacts.push(GrainContact {
                    grains: [one.0.min(other.0), one.0.max(other.0)],
                    overlap: one.1 + other.1 - distance,
                    force,
                });
                Some(())
            },
        )?;
        Ok(Self {
            bodies,
            contacts,
            steps,
        })
    }
}

/// What LAMMPS counts from one, from zero on.
fn index(number: f64) -> Option<usize> {
    (number >= 1.0).then(|| number as usize - 1)
}

fn turn([w, x, y, z]: [f64; 4]) -> Option<UnitQuaternion<f64>> {
    UnitQuaternion::try_new(Quaternion::new(w, x, y, z), 0.5)
}

/// Hands on the rows of a dump, and tells its step. A row that is not taken is odd.
fn read<const N: usize>(
    path: &Path,
    mut take: impl FnMut([f64; N]) -> Option<()>,
) -> Result<u64, SettledError> {
    let failed = |source| SettledError::Read {
        path: path.into(),
        source,
    };
    let mut reader = BufReader::new(File::open(path).map_err(failed)?);
    let (mut text, mut line) = (String::new(), 0);
    let (mut steps, mut in_rows) = (None, false);
    loop {
        text.clear();
        let length = reader.by_ref().take(LONGEST_LINE).read_line(&mut text);
        let is_end = length.map_err(failed)? == 0;
        line += 1;
        let is_read = match (is_end, in_rows) {
            (true, _) => None,
            (_, true) => numbers(&text).and_then(&mut take),
            (_, false) => {
                if line == 2 {
                    steps = text.trim().parse().ok();
                }
                in_rows = text.starts_with("ITEM: ENTRIES");
                Some(())
            }
        };
        match (is_read, steps) {
            (Some(()), _) => {}
            (None, Some(steps)) if is_end && in_rows => return Ok(steps),
            (None, _) => {
                let path = path.into();
                return Err(SettledError::Other { path, line });
            }
        }
    }
}

fn numbers<const N: usize>(text: &str) -> Option<[f64; N]> {
    let mut words = text.split_whitespace();
    let mut numbers = [0.0; N];
    for number in &mut numbers {
        *number = words.next()?.parse().ok()?;
    }
    let is_whole = words.next().is_none() && numbers.iter().all(|x: &f64| x.is_finite());
    is_whole.then_some(numbers)
}
