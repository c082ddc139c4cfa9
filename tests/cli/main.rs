//! The command line from end to end, through the built binary.

mod batch;
mod bed;
mod bed_folder;
mod bench;
mod clump;
mod compare;
mod contact;
mod errors;
mod export_dem;
mod fit;
mod followed;
#[cfg(unix)]
mod forbidden;
mod harmonics;
mod idle;
mod labels;
mod measure;
mod measure_errors;
mod mesh;
mod model_errors;
mod positions;
mod report;
mod report_lots;
mod search;
#[cfg(unix)]
mod signals;
mod sound;
mod split;
mod streams;
mod superquadric;
mod symmetry;
mod synth;
mod tables;
mod told;
mod unions;
mod units;
mod volumes;
mod whole;
mod withheld;

use serde_json::Value;
use std::io::Write;
use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};
use tempfile::TempDir;

/// Runs `grainform` with these words, in a folder.
fn grainform(folder: &TempDir, words: &[&str]) -> Output {
    Command::new(assert_cmd::cargo::cargo_bin!("grainform"))
        .args(words)
        .current_dir(folder.path())
        .output()
        .expect("the binary is built")
}

/// Runs `grainform` with these bytes on standard input.
fn piped(folder: &TempDir, words: &[&str], input: &[u8]) -> Output {
    let mut child = Command::new(assert_cmd::cargo::cargo_bin!("grainform"))
        .args(words)
        .current_dir(folder.path())
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .expect("the binary is built");
    let mut stdin = child.stdin.take().expect("a pipe");
    std::thread::scope(|scope| {
        // It may refuse before it has read all.
        scope.spawn(move || stdin.write_all(input).is_ok());
        child.wait_with_output().expect("an end")
    })
}

/// Runs `grainform`, which must succeed; gives its standard output.
fn succeed(folder: &TempDir, words: &[&str]) -> String {
    let output = grainform(folder, words);
    assert!(output.status.success(), "{words:?}: {}", errors(&output));
    String::from_utf8(output.stdout).expect("text")
}

/// Runs `grainform --json`, which must succeed.
fn json(folder: &TempDir, words: &[&str]) -> Value {
    let text = succeed(folder, &[words, &["--json"]].concat());
    serde_json::from_str(&text).expect("one JSON object")
}

fn errors(output: &Output) -> String {
    String::from_utf8_lossy(&output.stderr).into_owned()
}

fn folder() -> TempDir {
    tempfile::tempdir().expect("a temporary folder")
}

/// Asks for independent segments, to the tolerance that suits them.
const INDEPENDENT: [&str; 4] = ["--seams", "none", "--tolerance", "0.3%"];

/// A scan of the repository.
fn grain(name: &str) -> String {
    let path = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("grains");
    path.join(name).to_str().expect("text").into()
}

fn names(folder: &Path) -> Vec<String> {
    let entries = folder.read_dir().expect("a folder");
    let mut names: Vec<String> = entries
        .map(|entry| {
            entry
                .expect("an entry")
                .file_name()
                .into_string()
                .expect("text")
        })
        .collect();
    names.sort();
    names
}

fn number(record: &Value, name: &str) -> f64 {
    record[name]
        .as_f64()
        .unwrap_or_else(|| panic!("{name} in {record}"))
}

/// The relative difference of a named number from what it should be.
fn deviation(record: &Value, truth: &Value, name: &str) -> f64 {
    (number(record, name) / number(truth, name) - 1.0).abs()
}
