//! Files in the folder for results that a batch would replace, and no batch has written.

use super::error::BatchError;
use super::inputs::JOURNAL;
use super::journal::begins_as_journal;
use super::results::FILES;
use std::path::Path;

/// Refuses a folder with such files. With the results of a batch is its journal.
pub(super) fn check_own(folder: &Path) -> Result<(), BatchError> {
    let journal = folder.join(JOURNAL);
    if !journal.exists() {
        let mut files = FILES.iter().map(|name| folder.join(name));
        return match files.find(|path| path.exists()) {
            Some(path) => Err(BatchError::NotOwn { path }),
            None => Ok(()),
        };
    }
    match begins_as_journal(&journal) {
        Ok(true) => Ok(()),
        Ok(false) => Err(BatchError::NoJournal { path: journal }),
        Err(source) => Err(BatchError::Read {
            path: journal,
            source,
        }),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::fs::{remove_file, write};

    #[test]
    fn what_no_batch_has_written_is_in_the_way() {
        let folder = tempfile::tempdir().unwrap();
        let path = |name: &str| folder.path().join(name);
        let check = || check_own(folder.path());
        write(path("notes.txt"), "").unwrap();
        assert!(check().is_ok());
        for name in FILES {
            write(path(name), "").unwrap();
            let refused = check();
            assert!(
                matches!(&refused, Err(BatchError::NotOwn { path: own }) if *own == path(name)),
                "{refused:?}"
            );
            remove_file(path(name)).unwrap();
        }
        write(path("results.csv"), "").unwrap();
        let whole = "0123456789abcdef {\"path\":\"a\"}\n";
        for cut in 0..whole.len() {
            write(path(JOURNAL), &whole[..cut]).unwrap();
            assert!(check().is_ok(), "cut at {cut}");
        }
        for foreign in [
            "{\"event\":1}\n",
            "day,hour\n",
            "0123456789abcdef\n",
            "\n\n",
        ] {
            write(path(JOURNAL), foreign).unwrap();
            let refused = check();
            assert!(
                matches!(refused, Err(BatchError::NoJournal { .. })),
                "{foreign}"
            );
        }
    }
}
