//! What the system does not allow: folders that cannot be read, threads and files that are too many or too large.

use super::batch::{lot, rows};
use super::{errors, folder, names};
use std::fs::{Permissions, copy, create_dir, set_permissions};
use std::os::unix::fs::PermissionsExt;
use std::os::unix::process::CommandExt;
use std::process::{Command, Output};
use tempfile::TempDir;

/// The id of a user who owns nothing.
const NOBODY: u32 = 65534;

/// Runs a script of the shell in a folder, as a user whom rights bind; its `$0` is `grainform`.
fn bound(folder: &TempDir, script: &str) -> Output {
    let path = folder.path();
    let own = path.join("grainform");
    copy(assert_cmd::cargo::cargo_bin!("grainform"), &own).unwrap();
    set_permissions(path, Permissions::from_mode(0o777)).unwrap();
    let mut command = Command::new("sh");
    command.args(["-c", script]).arg(own).current_dir(path);
    if rustix::process::geteuid().is_root() {
        command.uid(NOBODY);
    }
    command.output().expect("a shell")
}

#[test]
fn a_folder_that_cannot_be_read_is_a_row_that_failed() {
    let folder = lot(1);
    let closed = folder.path().join("lot/closed");
    create_dir(&closed).unwrap();
    set_permissions(&closed, Permissions::from_mode(0o0)).unwrap();
    for (number, named) in ["lot", "'lot/**/*.xyz'", "'lot/*' 'lot/*/*.xyz'"]
        .iter()
        .enumerate()
    {
        let done = bound(
            &folder,
            &format!("$0 batch {named} -o {number} --only area"),
        );
        let told = errors(&done);
        assert_eq!(done.status.code(), Some(1), "{named}: {told}");
        let expected = "failed: lot/closed: cannot read the folder lot/closed: Permission denied";
        assert!(told.contains(expected), "{told}");
        let rows = rows(&folder.path().join(format!("{number}/results.csv")));
        let found: Vec<[&str; 2]> = rows
            .iter()
            .map(|row| [row["path"].as_str(), &row["status"]])
            .collect();
        assert_eq!(found, [["lot/00.xyz", "ok"], ["lot/closed", "failed"]]);
    }
    set_permissions(&closed, Permissions::from_mode(0o700)).unwrap();
}

#[test]
fn a_thread_that_cannot_be_started_is_told() {
    let folder = lot(1);
    let allowed = "ulimit -u 1 2> /dev/null || ulimit -p 1";
    for words in ["fit lot/00.xyz", "batch lot -o results"] {
        let done = bound(&folder, &format!("{allowed}; exec $0 {words}"));
        let told = errors(&done);
        assert_eq!(done.status.code(), Some(2), "{told}");
        assert!(told.starts_with("error: cannot start a thread"), "{told}");
    }
}

#[test]
fn a_file_larger_than_allowed_is_told_and_leaves_nothing() {
    let folder = folder();
    let done = bound(&folder, "ulimit -f 8; $0 synth bean -o b.ply");
    let told = errors(&done);
    assert_eq!(done.status.code(), Some(2), "{told}");
    assert!(
        told.contains("cannot save b.ply") && told.contains("File too large"),
        "{told}"
    );
    assert_eq!(names(folder.path()), ["grainform"]);
}
