//! Running a batch: threads that take one scan after the other, and final files when all are done.

use super::columns::columns;
use super::error::BatchError;
use super::grain::{Outputs, Settings, grain};
use super::journal::{Journal, Place, Row, key};
use super::population::Population;
use super::results::write_results;
use crate::export::sweep;
use std::collections::HashMap;
use std::fs::{File, TryLockError};
use std::io::{self, Read};
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::{Path, PathBuf};
use std::sync::Mutex;
use std::sync::PoisonError;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::time::Instant;

/// What a batch does.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Batch {
    /// The scans, see [`inputs`](super::inputs()).
    pub inputs: Vec<PathBuf>,
    /// The folder for results. It is made if it is not there.
    pub folder: PathBuf,
    /// What is asked of every grain.
    pub settings: Settings,
    /// Threads, each of which works on one grain.
    pub jobs: usize,
}

/// How far a batch is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Progress {
    /// Grains done, those of earlier runs included.
    pub done: usize,
    /// Of these, grains of earlier runs.
    pub kept: usize,
    /// All grains.
    pub all: usize,
}

/// A batch that is done.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub(crate) struct Done {
    /// Number of scans.
    pub all: usize,
    /// Of these, scans whose rows earlier runs left.
    pub kept: usize,
    /// Scans without a result, and why, in the order of the inputs.
    pub failed: Vec<(String, String)>,
    /// The figures of all others.
    pub population: Population,
    /// The files written.
    pub files: Vec<PathBuf>,
}

/// Runs a batch, or goes on with one that was stopped.
///
/// Rows that earlier runs left in the folder are taken over if path, bytes, settings and version are the same.
/// `progress` is told after every grain.
///
/// # Errors
/// [`BatchError`] if another batch works on the folder, it cannot be written to, or is removed. What is wrong with a scan is told
/// in its row.
pub(crate) fn run(batch: &Batch, progress: &(dyn Fn(Progress) + Sync)) -> Result<Done, BatchError> {
    let folder = &batch.folder;
    std::fs::create_dir_all(folder).map_err(|source| BatchError::Write {
        folder: folder.clone(),
        source,
    })?;
    let done = work(batch, progress);
    match folder.is_dir() {
        true => done,
        false => Err(BatchError::Removed {
            folder: folder.clone(),
        }),
    }
}

fn work(batch: &Batch, progress: &(dyn Fn(Progress) + Sync)) -> Result<Done, BatchError> {
    let folder = &batch.folder;
    let failed = |source| BatchError::Write {
        folder: folder.clone(),
        source,
    };
    let _lock = lock(folder)?;
    sweep(folder);
    for (is_asked, name) in [
        (batch.settings.models, "models"),
        (batch.settings.meshes.is_some(), "meshes"),
    ] {
        if is_asked {
            let path = folder.join(name);
            std::fs::create_dir_all(&path).map_err(failed)?;
            sweep(&path);
        }
    }
    let journal = Journal::open(&folder.join("journal.jsonl")).map_err(failed)?;
    let work = Work {
        batch,
        names: names(&batch.inputs),
        settings: batch.settings.text(),
        next: AtomicUsize::new(0),
        state: Mutex::new(State {
            journal,
            places: vec![None; batch.inputs.len()],
            done: 0,
            kept: 0,
            error: None,
        }),
        progress,
    };
    let pools: Vec<rayon::ThreadPool> = (0..batch.jobs.clamp(1, batch.inputs.len().max(1)))
        .map(|_| rayon::ThreadPoolBuilder::new().num_threads(1).build())
        .collect::<Result<_, _>>()
        .map_err(|source| BatchError::Threads { source })?;
    std::thread::scope(|scope| {
        for pool in &pools {
            scope.spawn(|| pool.install(|| work.go_on()));
        }
    });
    let State {
        mut journal,
        places,
        kept,
        error,
        ..
    } = work
        .state
        .into_inner()
        .unwrap_or_else(PoisonError::into_inner);
    if let Some(error) = error {
        return Err(error);
    }
    journal.force().map_err(failed)?;
    let places: Vec<Place> = places.into_iter().flatten().collect();
    let rows = || places.iter().map(|place| journal.read(*place));
    let columns = columns(&batch.settings.measures);
    let mut failures = Vec::new();
    let mut population = Population::new(&columns);
    for row in rows() {
        let row = row.map_err(failed)?;
        match row.reason {
            Some(reason) => failures.push((row.path, reason)),
            None => population.add(&row),
        }
    }
    population.finish();
    let files = write_results(folder, &columns, &rows, &population)?;
    Ok(Done {
        all: batch.inputs.len(),
        kept,
        failed: failures,
        population,
        files,
    })
}

/// The lock of a folder, held while it lives.
fn lock(folder: &Path) -> Result<File, BatchError> {
    let failed = |source| BatchError::Write {
        folder: folder.into(),
        source,
    };
    let file = File::create(folder.join(".lock")).map_err(failed)?;
    match file.try_lock() {
        Err(TryLockError::WouldBlock) => Err(BatchError::Locked {
            folder: folder.into(),
        }),
        Err(TryLockError::Error(source)) => Err(failed(source)),
        Ok(()) => Ok(file),
    }
}

/// What the threads share.
struct Work<'a> {
    batch: &'a Batch,
    /// What models and meshes are called.
    names: Vec<String>,
    settings: String,
    next: AtomicUsize,
    state: Mutex<State>,
    progress: &'a (dyn Fn(Progress) + Sync),
}

struct State {
    journal: Journal,
    places: Vec<Option<Place>>,
    done: usize,
    kept: usize,
    /// What stops the batch.
    error: Option<BatchError>,
}

impl Work<'_> {
    /// Takes one scan after the other until none is left.
    fn go_on(&self) {
        loop {
            let number = self.next.fetch_add(1, Ordering::Relaxed);
            let Some(path) = self.batch.inputs.get(number) else {
                return;
            };
            if !self.one(number, path) {
                return;
            }
        }
    }

    /// Works on one scan; tells whether to go on.
    fn one(&self, number: usize, path: &Path) -> bool {
        let started = Instant::now();
        let outputs = self.outputs(number);
        let shown = path.display().to_string();
        let version = env!("CARGO_PKG_VERSION");
        let bytes = read(path, self.batch.settings.max_bytes);
        let hash = bytes
            .as_ref()
            .ok()
            .map(|bytes| blake3::hash(bytes).to_hex().to_string());
        let known = hash.as_ref().and_then(|hash| {
            let key = key(&shown, hash, &self.settings, version);
            self.state().journal.find(&key)
        });
        if let Some(place) = known
            && (outputs.exist() || self.is_failure(place))
        {
            return self.note(number, true, |_| Ok(place));
        }
        let row = match &bytes {
            Ok(bytes) => catch_unwind(AssertUnwindSafe(|| {
                grain(path, bytes, &self.batch.settings, &outputs)
            }))
            .unwrap_or_else(|_| {
                Ok(Row {
                    reason: Some(
                        "the fit ended by a fault of the program; please tell its authors".into(),
                    ),
                    ..Row::default()
                })
            }),
            Err(error) => Ok(Row {
                reason: Some(format!("cannot read the file {shown}: {error}")),
                ..Row::default()
            }),
        };
        let row = row.map(|row| Row {
            path: shown,
            hash,
            version: version.into(),
            settings: self.settings.clone(),
            seconds: started.elapsed().as_secs_f64(),
            ..row
        });
        self.note(number, false, |journal| {
            journal.add(&row?).map_err(|source| BatchError::Write {
                folder: self.batch.folder.clone(),
                source,
            })
        })
    }

    fn is_failure(&self, place: Place) -> bool {
        let row = self.state().journal.read(place);
        row.is_ok_and(|row| row.reason.is_some())
    }

    /// Notes where the row of a scan stands; tells whether to go on.
    fn note(
        &self,
        number: usize,
        is_kept: bool,
        place: impl FnOnce(&mut Journal) -> Result<Place, BatchError>,
    ) -> bool {
        let mut state = self.state();
        match place(&mut state.journal) {
            Ok(place) => state.places[number] = Some(place),
            Err(error) => state.error = Some(error),
        }
        state.done += 1;
        state.kept += usize::from(is_kept);
        let told = Progress {
            done: state.done,
            kept: state.kept,
            all: self.batch.inputs.len(),
        };
        let goes_on = state.error.is_none() && self.batch.folder.is_dir();
        drop(state);
        (self.progress)(told);
        goes_on
    }

    fn state(&self) -> std::sync::MutexGuard<'_, State> {
        self.state.lock().unwrap_or_else(PoisonError::into_inner)
    }

    fn outputs(&self, number: usize) -> Outputs {
        let settings = &self.batch.settings;
        let named = |folder: &str, extension: &str| {
            let name = format!("{}.{extension}", self.names[number]);
            self.batch.folder.join(folder).join(name)
        };
        Outputs {
            model: settings.models.then(|| named("models", "json")),
            mesh: settings.meshes.map(|_| named("meshes", "ply")),
        }
    }
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

/// A name for every scan, by which its model and its mesh are saved: that of its file, or where several have it, that of
/// its path.
pub(crate) fn names(inputs: &[PathBuf]) -> Vec<String> {
    let stem = |path: &Path| {
        path.file_stem()
            .unwrap_or_default()
            .to_string_lossy()
            .into_owned()
    };
    let mut counts = HashMap::new();
    for path in inputs {
        *counts.entry(stem(path)).or_insert(0_usize) += 1;
    }
    let name = |path: &PathBuf| match counts.get(&stem(path)) {
        Some(1) => stem(path),
        _ => path.to_string_lossy().replace(['/', '\\', ':'], "_"),
    };
    inputs.iter().map(name).collect()
}
