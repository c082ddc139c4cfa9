//! The project's own rules: its architecture, its README, the reference of its JSON and its list of mutants.

mod architecture;
mod json;
mod mutants;
mod readme;

use std::path::Path;
use std::process::Command;

/// Runs `grainform` with these words in a folder, whose programs are found first; gives its standard output.
fn run(words: &str, folder: &Path) -> String {
    let path = std::env::var_os("PATH").unwrap_or_default();
    let path = std::iter::once(folder.into()).chain(std::env::split_paths(&path));
    let output = Command::new(assert_cmd::cargo::cargo_bin!("grainform"))
        .args(words.split_whitespace())
        .current_dir(folder)
        .env("PATH", std::env::join_paths(path).expect("a path"))
        .output()
        .expect("the binary is built");
    let errors = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{words}: {errors}");
    String::from_utf8(output.stdout).expect("text")
}

/// A folder with the grains of the repository.
fn folder() -> tempfile::TempDir {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let grains = folder.path().join("grains");
    std::fs::create_dir(&grains).expect("a new folder");
    for entry in Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("grains")
        .read_dir()
        .expect("grains")
    {
        let path = entry.expect("a file").path();
        std::fs::copy(&path, grains.join(path.file_name().expect("a name"))).expect("a copy");
    }
    folder
}
