//! Files that appear whole or not at all.

use std::fs::File;
use std::io::{BufWriter, Write};
use std::path::{Path, PathBuf};

use super::temporary::Temporary;
use super::{SaveError, WriteError};

/// Links that are followed, one to the next, as far as the system does.
const MOST_LINKS: usize = 40;

/// Writes a file through a buffered temporary one beside it, which takes its name at the end.
///
/// Readers see the old file or the whole new one, never a part, and a failure leaves the old one
/// as it was. The new file has the mode of the old one, or that of any new file. A link is followed,
/// also where its target is yet to be made. What exists and is no file, such as `/dev/stdout`, is
/// written to directly.
///
/// # Errors
///
/// [`SaveError::NoFolder`] where the folder is missing, [`SaveError::Write`] where `write` or the
/// system fails.
pub fn write_atomically(
    path: &Path,
    write: impl FnOnce(&mut (dyn Write + Send)) -> Result<(), WriteError>,
) -> Result<(), SaveError> {
    let target = followed(path);
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

/// Where a path leads to, link after link.
fn followed(path: &Path) -> PathBuf {
    let mut target = path.to_path_buf();
    for _ in 0..MOST_LINKS {
        let Ok(next) = target.read_link() else { break };
        target = target.parent().unwrap_or(Path::new("")).join(next);
    }
    target
}

fn replace(
    target: &Path,
    folder: &Path,
    write: impl FnOnce(&mut (dyn Write + Send)) -> Result<(), WriteError>,
) -> Result<(), WriteError> {
    let temporary = Temporary::new(folder)?;
    fill(temporary.file()?, write)?;
    if let Ok(old) = target.metadata() {
        temporary.file()?.set_permissions(old.permissions())?;
    }
    Ok(temporary.persist(target)?)
}

fn fill(
    file: &File,
    write: impl FnOnce(&mut (dyn Write + Send)) -> Result<(), WriteError>,
) -> Result<(), WriteError> {
    let mut writer = BufWriter::with_capacity(1 << 16, file);
    write(&mut writer)?;
    Ok(writer.flush()?)
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::io;

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
    fn a_mode_is_kept_and_a_link_to_nothing_makes_its_target() {
        use std::os::unix::fs::PermissionsExt;
        let folder = tempfile::tempdir().unwrap();
        let path = |name: &str| folder.path().join(name);
        std::fs::create_dir(path("to")).unwrap();
        std::fs::write(path("secret"), "").unwrap();
        std::fs::set_permissions(path("secret"), std::fs::Permissions::from_mode(0o600)).unwrap();
        std::os::unix::fs::symlink("to/new", path("next")).unwrap();
        std::os::unix::fs::symlink("next", path("link")).unwrap();
        for name in ["secret", "link"] {
            write_atomically(&path(name), |w| Ok(w.write_all(b"new")?)).unwrap();
            assert_eq!(std::fs::read(path(name)).unwrap(), b"new");
        }
        let mode = std::fs::metadata(path("secret"))
            .unwrap()
            .permissions()
            .mode();
        assert_eq!(mode & 0o777, 0o600);
        assert!(path("link").is_symlink() && path("next").is_symlink());
        assert_eq!(std::fs::read(path("to/new")).unwrap(), b"new");
    }

    #[cfg(unix)]
    #[test]
    fn an_error_does_not_tell_the_name_of_the_temporary_file() {
        let error = write_atomically(Path::new("/proc/none.txt"), |w| Ok(w.write_all(b"")?));
        let error = format!("{:?}", error.unwrap_err());
        assert!(!error.contains(".grainform-"), "{error}");
    }

    #[cfg(unix)]
    #[test]
    fn a_device_is_written_to_and_not_replaced() {
        write_atomically(Path::new("/dev/null"), |w| Ok(w.write_all(b"x")?)).unwrap();
        assert!(!Path::new("/dev/null").is_file());
    }
}
