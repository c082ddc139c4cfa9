//! Running a batch: threads that take one scan after the other, and final files when all are done.

use super::columns::{FIRST, columns};
use super::error::BatchError;
use super::grain::{Outputs, Settings, grain};
use super::in_the_way::check_own;
use super::inputs::JOURNAL;
use super::journal::{Journal, Place, Row, key};
use super::left_over::{MESHES, MODELS, left_over, mesh, model};
use super::names::of_scans;
use super::population::Population;
use super::queue::{Queue, Task, with_label, without_label};
use super::results::write_results;
use crate::export::sweep;
use std::collections::hash_map::Entry;
use std::collections::{BTreeMap, HashMap};
use std::fs::{File, TryLockError};
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::{Path, PathBuf};
use std::sync::Mutex;
use std::sync::PoisonError;
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
    /// Threads, each of which works on one grain at a time.
    pub jobs: usize,
}

/// How far a batch is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Progress {
    /// Grains done, those of earlier runs included.
    pub done: usize,
    /// Of these, grains of earlier runs.
    pub kept: usize,
    /// All grains that are known of: the labels of an image are when it is read.
    pub all: usize,
}

/// What is heard of a grain, by its name.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Step<'a> {
    /// Work on it begins.
    Begun(&'a str),
    /// It is done, and the batch so far.
    Done(&'a str, Progress),
}

/// A batch that is done.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub(crate) struct Done {
    /// Number of grains.
    pub all: usize,
    /// Of these, grains whose rows earlier runs left.
    pub kept: usize,
    /// Grains without a result, and why, in the order of the inputs.
    pub failed: Vec<(String, String)>,
    /// The figures of all others.
    pub population: Population,
    /// The files written.
    pub files: Vec<PathBuf>,
    /// Models and meshes of earlier runs, which no row is of.
    pub left_over: Vec<PathBuf>,
}

/// Runs a batch, or goes on with one that was stopped.
///
/// Rows that earlier runs left in the folder are taken over if path, bytes, settings and version are the same.
/// `hear` is told of every grain, when it begins and when it is done.
///
/// # Errors
/// [`BatchError`] if no scan is there, another batch works on the folder, it holds files of others, cannot be written to, or
/// is removed. What is wrong with a scan is told in its row.
pub(crate) fn run(batch: &Batch, hear: &(dyn Fn(Step) + Sync)) -> Result<Done, BatchError> {
    let folder = &batch.folder;
    if let Some(first) = batch.inputs.first()
        && !batch.inputs.iter().any(|path| path.exists())
    {
        return Err(BatchError::Missing {
            path: first.clone(),
            scans: batch.inputs.len(),
        });
    }
    check_own(folder)?;
    std::fs::create_dir_all(folder).map_err(|source| BatchError::NoFolder {
        folder: folder.clone(),
        source,
    })?;
    let done = work(batch, hear);
    match folder.is_dir() {
        true => done,
        false => Err(BatchError::Removed {
            folder: folder.clone(),
        }),
    }
}

fn work(batch: &Batch, hear: &(dyn Fn(Step) + Sync)) -> Result<Done, BatchError> {
    let folder = &batch.folder;
    let failed = |source| BatchError::Write {
        folder: folder.clone(),
        source,
    };
    let _lock = lock(folder)?;
    sweep(folder);
    for (is_asked, name) in [
        (batch.settings.models, MODELS),
        (batch.settings.meshes.is_some(), MESHES),
    ] {
        if is_asked {
            let path = folder.join(name);
            std::fs::create_dir_all(&path).map_err(failed)?;
            sweep(&path);
        }
    }
    let journal = Journal::open(&folder.join(JOURNAL)).map_err(failed)?;
    let work = Work {
        batch,
        names: of_scans(&batch.inputs),
        settings: batch.settings.text(),
        queue: Queue::new(&batch.inputs, batch.settings.max_bytes),
        state: Mutex::new(State {
            journal,
            places: BTreeMap::new(),
            kept: 0,
            error: None,
        }),
        hear,
    };
    let pools: Vec<rayon::ThreadPool> = (0..batch.jobs.max(1))
        .map(|_| rayon::ThreadPoolBuilder::new().num_threads(1).build())
        .collect::<Result<_, _>>()
        .map_err(|source| BatchError::Threads { source })?;
    work.go_on_in(&pools);
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
    let rows = || places.values().map(|place| journal.read(*place));
    let columns = columns(&batch.settings.measures);
    let mut failures = Vec::new();
    let (mut paths, mut hashes) = (Vec::new(), Vec::new());
    let (mut first, mut copies) = (HashMap::new(), Vec::new());
    let mut population = Population::new(&columns);
    for row in rows() {
        let row = row.map_err(failed)?;
        paths.push(row.path.clone());
        hashes.push([row.model_hash.clone(), row.mesh_hash.clone()]);
        match row.reason {
            Some(reason) => failures.push((row.path, reason)),
            None => {
                population.add(&row);
                let (_, label) = without_label(&row.path);
                match first.entry((row.hash, label)) {
                    Entry::Occupied(own) => copies.push([row.path, String::clone(own.get())]),
                    Entry::Vacant(free) => drop(free.insert(row.path)),
                }
            }
        }
    }
    population.finish(&copies);
    let is_known = [batch.settings.models, batch.settings.meshes.is_some()];
    let files = write_results(folder, &columns, &rows, &population)?;
    Ok(Done {
        all: places.len(),
        kept,
        failed: failures,
        population,
        files,
        left_over: left_over(folder, &paths, hashes, is_known).map_err(failed)?,
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
    /// What models and meshes of each scan are called.
    names: Vec<String>,
    settings: String,
    queue: Queue<'a>,
    state: Mutex<State>,
    hear: &'a (dyn Fn(Step) + Sync),
}

struct State {
    journal: Journal,
    /// Where the row of each grain stands, by the number of its scan and its own.
    places: BTreeMap<(usize, usize), Place>,
    kept: usize,
    /// What stops the batch.
    error: Option<BatchError>,
}

impl Work<'_> {
    /// Goes on in each of some pools, until no grain is left.
    fn go_on_in(&self, pools: &[rayon::ThreadPool]) {
        if let [first, others @ ..] = pools {
            first.in_place_scope(|scope| {
                scope.spawn(|_| self.go_on());
                self.go_on_in(others);
            });
        }
    }

    /// Takes one grain after the other until none is left.
    fn go_on(&self) {
        while let Some(task) = self.queue.next() {
            if !self.one(&task) {
                return;
            }
        }
    }

    /// Works on one grain; tells whether to go on.
    fn one(&self, task: &Task) -> bool {
        let started = Instant::now();
        let settings = &self.batch.settings;
        let outputs = self.outputs(task);
        let shown = task.name();
        (self.hear)(Step::Begun(&shown));
        let version = env!("CARGO_PKG_VERSION");
        let content = task.content(settings.max_bytes);
        let hash = content.as_ref().ok();
        let hash = hash.map(|content| content.hash(task.path, settings.max_bytes));
        let known = hash.as_ref().and_then(|hash| {
            let key = key(&shown, hash, &self.settings, version);
            self.state().journal.find(&key)
        });
        if let Some(place) = known
            && self.is_whole(place, &outputs)
        {
            return self.note(task, true, |_| Ok(place));
        }
        let row = match &content {
            Ok(content) => catch_unwind(AssertUnwindSafe(|| {
                grain(
                    content.scan(task.path, settings.max_bytes),
                    settings,
                    &outputs,
                )
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
                reason: Some(format!(
                    "cannot read the {} {shown}: {error}",
                    if task.path.is_dir() { "folder" } else { "file" }
                )),
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
        self.note(task, false, |journal| {
            journal.add(&row?).map_err(|source| BatchError::Write {
                folder: self.batch.folder.clone(),
                source,
            })
        })
    }

    /// Whether a row that is known is all that is asked for.
    fn is_whole(&self, place: Place, outputs: &Outputs) -> bool {
        let row = self.state().journal.read(place);
        let figures = columns(&self.batch.settings.measures).len() - FIRST.len();
        let has_all = |row: &Row| row.figures.len() == figures && outputs.are_of(row);
        row.is_ok_and(|row| row.reason.is_some() || has_all(&row))
    }

    /// Notes where the row of a grain stands; tells whether to go on.
    fn note(
        &self,
        task: &Task,
        is_kept: bool,
        place: impl FnOnce(&mut Journal) -> Result<Place, BatchError>,
    ) -> bool {
        let mut state = self.state();
        match place(&mut state.journal) {
            Ok(place) => {
                state.places.insert(task.number, place);
            }
            Err(error) => state.error = Some(error),
        }
        state.kept += usize::from(is_kept);
        let told = Progress {
            done: state.places.len(),
            kept: state.kept,
            all: self.queue.count(),
        };
        let goes_on = state.error.is_none() && self.batch.folder.is_dir();
        drop(state);
        (self.hear)(Step::Done(&task.name(), told));
        goes_on
    }

    fn state(&self) -> std::sync::MutexGuard<'_, State> {
        self.state.lock().unwrap_or_else(PoisonError::into_inner)
    }

    fn outputs(&self, task: &Task) -> Outputs {
        let settings = &self.batch.settings;
        let name = with_label(&self.names[task.number.0], task.label);
        let folder = &self.batch.folder;
        Outputs {
            model: settings.models.then(|| model(folder, &name)),
            mesh: settings.meshes.map(|_| mesh(folder, &name)),
        }
    }
}
