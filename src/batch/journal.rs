//! The journal of a batch: a line for each grain, written when it is done and never changed.
//!
//! A line is a checksum and a row as JSON. It is written at once and whole, so that killing the process cuts the last
//! line at most; a line whose checksum is wrong is none, and what follows the last whole line is cut off when the
//! journal is opened again. Lines are forced to the disk at least once per second, so that a power cut costs the grains
//! of one second.

use serde::{Deserialize, Serialize};
use std::collections::HashMap;
use std::fs::File;
use std::io::{self, BufRead, BufReader, Read, Seek, SeekFrom, Write};
use std::path::Path;
use std::time::{Duration, Instant};

/// How often lines are forced to the disk.
const FORCED: Duration = Duration::from_secs(1);

/// Letters of a checksum.
const CHECKSUM: usize = 16;

/// What is known of a grain, or why nothing is.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
#[non_exhaustive]
pub(crate) struct Row {
    /// The scan, as it was named.
    pub path: String,
    /// Hash (BLAKE3) of its bytes; none where they could not be read.
    pub hash: Option<String>,
    /// Version of this library.
    pub version: String,
    /// What was asked for.
    pub settings: String,
    /// Why there is no result.
    pub reason: Option<String>,
    /// Unit of lengths, where it was told.
    pub unit: Option<String>,
    /// Distinct points that the fit rests on.
    pub points: Option<u64>,
    /// Degree of the segments' expansions.
    pub degree: Option<u64>,
    /// Number of segments.
    pub segments: Option<u64>,
    /// Coefficients that the model holds.
    pub coefficients: Option<u64>,
    /// Mean radius over all directions.
    pub mean_radius: Option<f64>,
    /// Standard deviation of the points' noise.
    pub noise: Option<f64>,
    /// Whether there is at most as much.
    #[serde(default)]
    pub noise_is_bound: Option<bool>,
    /// Root mean square of the radial residuals.
    pub rms: Option<f64>,
    /// The same of points that were left out of the fit.
    pub heldout_rms: Option<f64>,
    /// Area beside that of the reference surface.
    pub area_error: Option<f64>,
    /// Volume beside that of the reference surface.
    pub volume_error: Option<f64>,
    /// Why there are no standard errors.
    pub no_standard_errors: Option<String>,
    /// Measures that cannot be told, and why.
    pub not_measured: Vec<String>,
    /// What is odd: whole sentences.
    pub warnings: Vec<String>,
    /// The figures and their standard errors, in the order of the columns.
    pub figures: Vec<Option<f64>>,
    /// Hashes of the model and of the mesh that were saved.
    #[serde(default)]
    pub model_hash: Option<String>,
    #[serde(default)]
    pub mesh_hash: Option<String>,
    /// Seconds that the grain took.
    pub seconds: f64,
}

/// Where a line stands.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Place {
    offset: u64,
    length: u64,
}

/// What a row is the result of.
pub(super) type Key = [u8; 32];

/// The key of a scan of these bytes, with these settings.
pub(super) fn key(path: &str, hash: &str, settings: &str, version: &str) -> Key {
    let mut hasher = blake3::Hasher::new();
    for part in [path, hash, settings, version] {
        hasher.update(&(part.len() as u64).to_le_bytes());
        hasher.update(part.as_bytes());
    }
    *hasher.finalize().as_bytes()
}

pub(super) struct Journal {
    file: File,
    end: u64,
    known: HashMap<Key, Place>,
    forced: Instant,
}

impl Journal {
    /// Opens a journal, or begins one.
    pub(super) fn open(path: &Path) -> io::Result<Self> {
        let mut file = File::options()
            .read(true)
            .append(true)
            .create(true)
            .open(path)?;
        let mut known = HashMap::new();
        let end = read_rows(&mut file, |key, place, _| {
            known.insert(key, place);
        })?;
        file.set_len(end)?;
        Ok(Self {
            file,
            end,
            known,
            forced: Instant::now(),
        })
    }

    /// Where the row of a key stands.
    pub(super) fn find(&self, key: &Key) -> Option<Place> {
        self.known.get(key).copied()
    }

    /// Adds a row.
    pub(super) fn add(&mut self, row: &Row) -> io::Result<Place> {
        let json = serde_json::to_string(row)?;
        let line = format!("{} {json}\n", checksum(json.as_bytes()));
        self.file.write_all(line.as_bytes())?;
        let place = Place {
            offset: self.end,
            length: line.len() as u64,
        };
        self.end += place.length;
        if self.forced.elapsed() > FORCED {
            self.force()?;
        }
        Ok(place)
    }

    /// Forces all rows to the disk.
    pub(super) fn force(&mut self) -> io::Result<()> {
        self.forced = Instant::now();
        self.file.sync_data()
    }

    /// Reads a row.
    pub(super) fn read(&self, place: Place) -> io::Result<Row> {
        let mut file = &self.file;
        file.seek(SeekFrom::Start(place.offset))?;
        let mut line = Vec::new();
        file.take(place.length).read_to_end(&mut line)?;
        parse(&line).ok_or_else(|| io::Error::other("the journal was changed by somebody else"))
    }
}

/// Whether a file begins as a journal does, as far as it goes: one may be cut off anywhere.
pub(super) fn begins_as_journal(path: &Path) -> io::Result<bool> {
    let mut start = Vec::new();
    let mut file = File::open(path)?.take(CHECKSUM as u64 + 2);
    file.read_to_end(&mut start)?;
    let (sum, rest) = start.split_at(start.len().min(CHECKSUM));
    Ok(sum.iter().all(u8::is_ascii_hexdigit) && b" {".starts_with(rest))
}

/// The hash of the model that was saved with each row of a journal that is only read; none of what it was saved without.
pub(super) fn saved_models(path: &Path) -> io::Result<HashMap<Key, Option<String>>> {
    let mut models = HashMap::new();
    read_rows(&mut File::open(path)?, |key, _, row| {
        models.insert(key, row.model_hash);
    })?;
    Ok(models)
}

/// Hears every row whose scan could be read, in the order in which they were written; gives where the last whole line
/// ends.
fn read_rows(file: &mut File, mut hear: impl FnMut(Key, Place, Row)) -> io::Result<u64> {
    let mut end = 0;
    let mut lines = BufReader::new(file);
    let mut line = Vec::new();
    loop {
        line.clear();
        let length = lines.read_until(b'\n', &mut line)? as u64;
        if !line.ends_with(b"\n") {
            return Ok(end);
        }
        if let Some(row) = parse(&line)
            && let Some(hash) = &row.hash
        {
            let place = Place {
                offset: end,
                length,
            };
            let key = key(&row.path, hash, &row.settings, &row.version);
            hear(key, place, row);
        }
        end += length;
    }
}

fn parse(line: &[u8]) -> Option<Row> {
    let (sum, json) = line.strip_suffix(b"\n")?.split_at_checked(CHECKSUM)?;
    let json = json.strip_prefix(b" ")?;
    (checksum(json).as_bytes() == sum).then(|| serde_json::from_slice(json).ok())?
}

fn checksum(bytes: &[u8]) -> String {
    let mut sum = blake3::hash(bytes).to_hex().to_string();
    sum.truncate(CHECKSUM);
    sum
}

#[cfg(test)]
mod tests {
    use super::*;

    fn row(number: usize) -> Row {
        Row {
            path: format!("{number}.ply"),
            hash: Some(number.to_string()),
            figures: vec![Some(0.1 + number as f64), None],
            ..Row::default()
        }
    }

    #[test]
    fn a_journal_cut_anywhere_holds_the_whole_rows_before_the_cut_and_goes_on() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("journal");
        let mut journal = Journal::open(&path).unwrap();
        let ends: Vec<u64> = (0..4)
            .map(|number| {
                journal.add(&row(number)).unwrap();
                journal.end
            })
            .collect();
        let whole = std::fs::read(&path).unwrap();
        for cut in (0..=whole.len()).step_by(7) {
            std::fs::write(&path, &whole[..cut]).unwrap();
            let mut journal = Journal::open(&path).unwrap();
            let kept = ends.iter().filter(|end| **end <= cut as u64).count();
            assert_eq!(journal.known.len(), kept, "cut at {cut}");
            let place = journal.add(&row(9)).unwrap();
            assert_eq!(journal.read(place).unwrap(), row(9));
            let again = Journal::open(&path).unwrap();
            let place = again.find(&key("9.ply", "9", "", "")).unwrap();
            assert_eq!(again.read(place).unwrap(), row(9));
        }
    }

    #[test]
    fn a_row_whose_bytes_were_changed_is_none() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("journal");
        Journal::open(&path).unwrap().add(&row(1)).unwrap();
        let mut bytes = std::fs::read(&path).unwrap();
        let at = bytes.iter().position(|byte| *byte == b'1').unwrap();
        bytes[at + 30] ^= 1;
        std::fs::write(&path, bytes).unwrap();
        assert!(Journal::open(&path).unwrap().known.is_empty());
    }
}
