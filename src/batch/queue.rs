//! Which grain comes next: the scans in their order, and of an image of several labels each of these.

use super::grain::told;
use super::inputs::is_image;
use super::shown::shown;
use crate::scan::{
    Extent, ReadError, Scan, Volume, parse_file, parse_volume, read_stream, voxel_file,
};
use std::collections::{BTreeMap, VecDeque};
use std::fs::File;
use std::io::{self, Read};
use std::panic::catch_unwind;
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

/// A grain to be worked on.
pub(super) struct Task<'a> {
    /// The number of its scan, and its own among those of the scan.
    pub(super) number: (usize, usize),
    /// Its scan.
    pub(super) path: &'a Path,
    /// Which label it is, where the scan is an image of several.
    pub(super) label: Option<i64>,
    image: Option<(Arc<Image>, Extent)>,
}

/// What a grain is read from.
pub(super) enum Content {
    /// The bytes of a file.
    Bytes(Vec<u8>),
    /// A label of an image.
    Label(Arc<Image>, i64, Extent),
}

/// An image of labels that is read once for all of its grains.
pub(super) struct Image {
    volume: Volume,
    hash: String,
}

/// The grains that nobody works on yet.
pub(super) struct Queue<'a> {
    scans: &'a [PathBuf],
    limit: u64,
    state: Mutex<State<'a>>,
}

struct State<'a> {
    next: usize,
    /// Grains that are known of.
    count: usize,
    /// Of the image that was read last.
    labels: VecDeque<Task<'a>>,
}

impl<'a> Queue<'a> {
    /// The grains of some scans, of at most so many bytes each.
    pub(super) fn new(scans: &'a [PathBuf], limit: u64) -> Self {
        Self {
            scans,
            limit,
            state: Mutex::new(State {
                next: 0,
                count: scans.len(),
                labels: VecDeque::new(),
            }),
        }
    }

    /// All grains that are known of: a scan that was not read yet counts as one.
    pub(super) fn count(&self) -> usize {
        self.state().count
    }

    fn state(&self) -> MutexGuard<'_, State<'a>> {
        self.state.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// The next grain. While one thread reads an image the others wait: they will have its labels.
    pub(super) fn next(&self) -> Option<Task<'a>> {
        let mut state = self.state();
        if let Some(task) = state.labels.pop_front() {
            return Some(task);
        }
        let scan = state.next;
        let path = self.scans.get(scan)?;
        state.next += 1;
        let image = is_image(path).then(|| catch_unwind(|| Image::read(path, self.limit)));
        let Some(Ok(Some((image, labels)))) = image else {
            return Some(Task {
                number: (scan, 0),
                path,
                label: None,
                image: None,
            });
        };
        let image = Arc::new(image);
        state.labels = (0..)
            .zip(labels)
            .map(|(own, (label, extent))| Task {
                number: (scan, own),
                path,
                label: Some(label),
                image: Some((image.clone(), extent)),
            })
            .collect();
        state.count += state.labels.len() - 1;
        state.labels.pop_front()
    }
}

impl Task<'_> {
    /// What the grain is called: its path and, where it is one of several, its label.
    pub(super) fn name(&self) -> String {
        with_label(&shown(self.path), self.label)
    }

    /// What it is read from, of at most so many bytes.
    pub(super) fn content(&self, limit: u64) -> io::Result<Content> {
        match (&self.image, self.label) {
            (Some((image, extent)), Some(label)) => {
                Ok(Content::Label(image.clone(), label, *extent))
            }
            _ => read(self.path, limit).map(Content::Bytes),
        }
    }
}

impl Content {
    /// The hash of the file, and of the one beside it that has the voxels, where it is a header.
    pub(super) fn hash(&self, path: &Path, limit: u64) -> String {
        match self {
            Self::Bytes(bytes) => hash(path, bytes, limit),
            Self::Label(image, ..) => image.hash.clone(),
        }
    }

    /// The scan, or why there is none.
    pub(super) fn scan(&self, path: &Path, limit: u64) -> Result<Scan, String> {
        match self {
            Self::Bytes(bytes) => {
                let bytes = read_stream(&bytes[..], path, limit).map_err(|error| told(&error))?;
                scan(path, &bytes, limit).map_err(|error| told(&error))
            }
            Self::Label(image, label, extent) => {
                let scan = image.volume.grain(*label, extent);
                scan.map_err(|error| {
                    format!("cannot read a grain from {}: {error}", path.display())
                })
            }
        }
    }
}

/// The scan in the bytes of a file, of whose voxels at most so many bytes are unpacked.
fn scan(path: &Path, bytes: &[u8], limit: u64) -> Result<Scan, ReadError> {
    match parse_volume(path, bytes, limit)? {
        Some(volume) => volume.scan(None).map_err(|source| ReadError::Volume {
            path: path.into(),
            source,
        }),
        None => parse_file(path, bytes, None),
    }
}

impl Image {
    /// The image in a file and its labels, if it has several; what is wrong with it is told when it is read as one grain.
    fn read(path: &Path, limit: u64) -> Option<(Self, BTreeMap<i64, Extent>)> {
        let bytes = read(path, limit).ok()?;
        let unpacked = read_stream(&bytes[..], path, limit).ok()?;
        let volume = parse_volume(path, &unpacked, limit).ok()??;
        let labels = volume.grains().ok().filter(|labels| labels.len() > 1)?;
        let hash = hash(path, &bytes, limit);
        Some((Self { volume, hash }, labels))
    }
}

fn hash(path: &Path, bytes: &[u8], limit: u64) -> String {
    let mut hasher = blake3::Hasher::new();
    hasher.update(bytes);
    let voxels = is_image(path).then(|| voxel_file(path, bytes)).flatten();
    if let Some(Ok(voxels)) = voxels.map(|voxels| read(&voxels, limit)) {
        hasher.update(&voxels);
    }
    hasher.finalize().to_hex().to_string()
}

/// `ct.nrrd#3`, or the name alone.
pub(super) fn with_label(name: &str, label: Option<i64>) -> String {
    label.map_or(name.to_owned(), |label| format!("{name}#{label}"))
}

/// The scan and the label that a row is called by.
pub(super) fn without_label(name: &str) -> (&str, Option<i64>) {
    let parts = name
        .rsplit_once('#')
        .filter(|(scan, _)| is_image(Path::new(scan)));
    let parts = parts.and_then(|(scan, label)| Some((scan, label.parse().ok()?)));
    parts.map_or((name, None), |(scan, label)| (scan, Some(label)))
}

/// The bytes of a file as they are, at most so many.
fn read(path: &Path, limit: u64) -> io::Result<Vec<u8>> {
    let mut bytes = Vec::new();
    let file = File::open(path)?;
    if file.metadata()?.is_dir() {
        return Err(io::ErrorKind::IsADirectory.into());
    }
    file.take(limit.saturating_add(1)).read_to_end(&mut bytes)?;
    match bytes.len() as u64 > limit {
        true => Err(io::Error::other(format!(
            "it holds more than {limit} bytes; allow more with --max-bytes"
        ))),
        false => Ok(bytes),
    }
}
