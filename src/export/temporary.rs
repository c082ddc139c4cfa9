//! Temporary files that do not outlive their process.
//!
//! Each has the process id in its name and is locked while it is written. Whoever ends the process by a signal
//! removes them with [`remove_temporaries`]; what a process leaves that had no time for it, the next one to write
//! into the folder takes away with [`sweep`].

use std::collections::BTreeSet;
use std::fs::{File, Permissions};
use std::io;
use std::path::{Path, PathBuf};
use std::sync::{Mutex, MutexGuard, PoisonError};

use tempfile::{Builder, NamedTempFile};

/// How the names of temporary files begin; the process id follows, and a dash.
const PREFIX: &str = ".grainform-";

/// How they end.
const SUFFIX: &str = ".tmp";

/// The temporary files of this process. Only who holds the lock creates, renames or removes one.
static LIVING: Mutex<BTreeSet<PathBuf>> = Mutex::new(BTreeSet::new());

fn living() -> MutexGuard<'static, BTreeSet<PathBuf>> {
    LIVING.lock().unwrap_or_else(PoisonError::into_inner)
}

/// A file beside the one it is to become.
pub(super) struct Temporary(Option<NamedTempFile>);

impl Temporary {
    /// Creates one in a folder.
    pub(super) fn new(folder: &Path) -> io::Result<Self> {
        let prefix = format!("{PREFIX}{}-", std::process::id());
        let mut builder = Builder::new();
        builder.prefix(&prefix).suffix(SUFFIX);
        if let Some(permissions) = permissions() {
            builder.permissions(permissions);
        }
        let mut living = living();
        let file = builder.tempfile_in(folder).map_err(nameless)?;
        living.insert(file.path().into());
        // Where a file system has no locks, the process id alone keeps the file.
        let _ = file.as_file().try_lock();
        Ok(Self(Some(file)))
    }

    pub(super) fn file(&self) -> io::Result<&File> {
        let gone = || io::Error::from(io::ErrorKind::NotFound);
        self.0.as_ref().map(NamedTempFile::as_file).ok_or_else(gone)
    }

    /// Takes the name of the target, in place of what had it.
    pub(super) fn persist(mut self, target: &Path) -> io::Result<()> {
        let Some(file) = self.0.take() else {
            return Ok(());
        };
        let mut living = living();
        living.remove(file.path());
        match file.persist(target) {
            Ok(_) => Ok(()),
            Err(failed) => Err(failed.error),
        }
    }
}

impl Drop for Temporary {
    fn drop(&mut self) {
        if let Some(file) = self.0.take() {
            let mut living = living();
            living.remove(file.path());
            drop(file);
        }
    }
}

/// What a new file asks for, before the umask: a temporary file would be its owner's only.
#[cfg(unix)]
fn permissions() -> Option<Permissions> {
    use std::os::unix::fs::PermissionsExt;
    Some(Permissions::from_mode(0o666))
}

#[cfg(not(unix))]
fn permissions() -> Option<Permissions> {
    None
}

/// The same error without the name of a temporary file, which says nothing to who named another.
fn nameless(error: io::Error) -> io::Error {
    match error.raw_os_error() {
        Some(_) => error,
        None => error.kind().into(),
    }
}

/// Removes all temporary files of this process, whose threads can then create no others and finish none: for a
/// process that is about to end.
#[cfg(feature = "cli")]
pub(crate) fn remove_temporaries() {
    let living = living();
    for path in living.iter() {
        let _ = std::fs::remove_file(path);
    }
    std::mem::forget(living);
}

/// Removes the temporary files in a folder whose processes are gone, as after `kill -9`. What cannot be removed
/// stays: it is in nobody's way.
pub fn sweep(folder: &Path) {
    let Ok(entries) = folder.read_dir() else {
        return;
    };
    for entry in entries.flatten() {
        let name = entry.file_name();
        let process = name.to_str().and_then(process);
        if process.is_some_and(is_gone) && is_unlocked(&entry.path()) {
            let _ = std::fs::remove_file(entry.path());
        }
    }
}

/// The id of the process that a temporary file of this name belongs to.
fn process(name: &str) -> Option<i32> {
    let inner = name.strip_prefix(PREFIX)?.strip_suffix(SUFFIX)?;
    inner.split_once('-')?.0.parse().ok().filter(|id| *id > 0)
}

#[cfg(unix)]
fn is_gone(process: i32) -> bool {
    use rustix::io::Errno;
    use rustix::process::{Pid, test_kill_process};
    Pid::from_raw(process).is_some_and(|id| test_kill_process(id) == Err(Errno::SRCH))
}

/// The lock alone tells.
#[cfg(not(unix))]
fn is_gone(process: i32) -> bool {
    u32::try_from(process) != Ok(std::process::id())
}

/// Whether no process writes it: one in another container, whose ids are not ours, may.
fn is_unlocked(path: &Path) -> bool {
    File::open(path).is_ok_and(|file| file.try_lock().is_ok())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_names_of_ours_have_a_process() {
        assert_eq!(process(".grainform-42-aB3.tmp"), Some(42));
        for name in [
            "grainform-42-a.tmp",
            ".grainform-42.tmp",
            ".grainform-x-a.tmp",
            ".grainform-0-a.tmp",
            ".grainform-42-a",
        ] {
            assert_eq!(process(name), None, "{name}");
        }
    }

    #[cfg(unix)]
    #[test]
    fn a_sweep_takes_what_the_dead_left_and_nothing_else() {
        let folder = tempfile::tempdir().unwrap();
        let dead = {
            let mut child = std::process::Command::new("true").spawn().unwrap();
            child.wait().unwrap();
            child.id()
        };
        let left = |name: String| {
            let path = folder.path().join(name);
            std::fs::write(&path, "").unwrap();
            path
        };
        let (orphan, locked) = (
            left(format!("{PREFIX}{dead}-a{SUFFIX}")),
            left(format!("{PREFIX}{dead}-b{SUFFIX}")),
        );
        let lock = File::open(&locked).unwrap();
        lock.try_lock().unwrap();
        let other = left(".grainform-notes.tmp".into());
        let own = Temporary::new(folder.path()).unwrap();
        sweep(folder.path());
        assert!(!orphan.exists());
        assert!(locked.exists() && other.exists());
        assert_eq!(folder.path().read_dir().unwrap().count(), 3);
        drop(own);
        assert_eq!(folder.path().read_dir().unwrap().count(), 2);
    }
}
