//! Files that appear whole or not at all.

use std::fs::{File, Permissions};
use std::io::{self, BufWriter, Write};
use std::path::Path;

use tempfile::Builder;

use super::{SaveError, WriteError};

/// Writes a file through a buffered temporary one beside it, which takes its name at the end.
///
/// Readers see the old file or the whole new one, never a part, and a failure leaves the old one
/// as it was. The new file has the permissions of any new file. A link is followed. What exists
/// and is no file, such as `/dev/stdout`, is written to directly.
///
/// # Errors
///
/// [`SaveError::NoFolder`] where the folder is missing, [`SaveError::Write`] where `write` or the
/// system fails.
pub fn write_atomically(
    path: &Path,
    write: impl FnOnce(&mut BufWriter<&File>) -> Result<(), WriteError>,
) -> Result<(), SaveError> {
    let target = path.canonicalize().unwrap_or_else(|_| path.into());
    let folder = match target.parent() {
        Some(folder) if folder != Path::new("") => folder,
        _ => Path::new("."),
    };
    if !folder.is_dir() {
        return Err(SaveError::NoFolder {
            path: path.into(),
            folder: folder.into(),
        });
    }
    let is_special = target.exists() && !target.is_file();
    let result = if is_special {
        File::options()
            .write(true)
            .open(&target)
            .map_err(WriteError::from)
            .and_then(|file| fill(&file, write))
    } else {
        replace(&target, folder, write)
    };
    result.map_err(|source| SaveError::Write {
        path: path.into(),
        source,
    })
}

fn replace(
    target: &Path,
    folder: &Path,
    write: impl FnOnce(&mut BufWriter<&File>) -> Result<(), WriteError>,
) -> Result<(), WriteError> {
    let mut builder = Builder::new();
    if let Some(permissions) = permissions() {
        builder.permissions(permissions);
    }
    let file = builder.tempfile_in(folder)?;
    fill(file.as_file(), write)?;
    file.persist(target).map_err(io::Error::from)?;
    Ok(())
}

fn fill(
    file: &File,
    write: impl FnOnce(&mut BufWriter<&File>) -> Result<(), WriteError>,
) -> Result<(), WriteError> {
    let mut writer = BufWriter::with_capacity(1 << 16, file);
    write(&mut writer)?;
    Ok(writer.flush()?)
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_failure_leaves_the_old_file_and_nothing_else() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.txt");
        std::fs::write(&path, "old").unwrap();
        let result = write_atomically(&path, |writer| {
            writer.write_all(b"new")?;
            Err(io::Error::other("disk full").into())
        });
        assert!(matches!(result, Err(SaveError::Write { .. })));
        assert_eq!(std::fs::read(&path).unwrap(), b"old");
        assert_eq!(folder.path().read_dir().unwrap().count(), 1);
    }

    #[test]
    fn a_missing_folder_is_named() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("none/a.txt");
        let error = write_atomically(&path, |w| Ok(w.write_all(b"")?)).unwrap_err();
        assert!(error.to_string().contains("none does not exist"), "{error}");
    }

    #[cfg(unix)]
    #[test]
    fn permissions_are_those_of_any_new_file_and_links_are_followed() {
        use std::os::unix::fs::PermissionsExt;
        let folder = tempfile::tempdir().unwrap();
        let mode = |name: &str| {
            let data = std::fs::metadata(folder.path().join(name)).unwrap();
            data.permissions().mode()
        };
        std::fs::write(folder.path().join("plain"), "").unwrap();
        std::os::unix::fs::symlink("plain", folder.path().join("link")).unwrap();
        for name in ["ours", "link"] {
            write_atomically(&folder.path().join(name), |w| Ok(w.write_all(b"new")?)).unwrap();
        }
        assert_eq!(mode("ours"), mode("plain"));
        assert_eq!(std::fs::read(folder.path().join("plain")).unwrap(), b"new");
        assert!(folder.path().join("link").is_symlink());
    }

    #[cfg(unix)]
    #[test]
    fn a_device_is_written_to_and_not_replaced() {
        write_atomically(Path::new("/dev/null"), |w| Ok(w.write_all(b"x")?)).unwrap();
        assert!(!Path::new("/dev/null").is_file());
    }
}
