use super::batch::{begin, lot};
use super::{folder, grain, names, succeed};
use rustix::process::{Pid, Signal, kill_process};
use std::os::unix::process::ExitStatusExt;
use std::process::{Child, Command, Stdio};
use tempfile::TempDir;

/// A folder with a model.
fn model() -> TempDir {
    let folder = folder();
    let bean = grain("bean.ply");
    succeed(
        &folder,
        &["fit", &bean, "--tolerance", "5%", "-o", "m.json"],
    );
    folder
}

/// Cells along an edge of a mesh of some 300 MB, which is not written before a signal arrives.
const LARGE: &str = "700";

/// Cells along an edge of a mesh of some 150 MB, whose writing is seen.
const SMALL: &str = "512";

/// Writes a mesh with `words` before the command, and waits until it is being written.
fn writing(folder: &TempDir, resolution: &str, words: &[&str]) -> Child {
    let grainform = assert_cmd::cargo::cargo_bin!("grainform");
    let grainform = grainform.to_str().expect("text");
    let mesh = ["mesh", "m.json", "-o", "m.stl", "--resolution", resolution];
    let words = [words, &[grainform], &mesh].concat();
    let mut child = Command::new(words[0])
        .args(&words[1..])
        .current_dir(folder.path())
        .stdout(Stdio::null())
        .spawn()
        .expect("a process");
    while !names(folder.path())
        .iter()
        .any(|name| name.starts_with(".grainform-"))
    {
        assert!(child.try_wait().unwrap().is_none(), "it ended too early");
    }
    child
}

fn send(child: &Child, signal: Signal) {
    kill_process(Pid::from_child(child), signal).expect("it lives");
}

/// Whether these tests were started so that a signal is ignored, as by `nohup` or in the background of a script: then so is
/// it by each run.
fn is_ignored(signal: Signal) -> bool {
    let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    let mask = status.lines().find_map(|line| line.strip_prefix("SigIgn:"));
    let mask = mask.and_then(|mask| u64::from_str_radix(mask.trim(), 16).ok());
    mask.is_some_and(|mask| mask >> (signal.as_raw() - 1) & 1 == 1)
}

#[test]
fn a_signal_ends_the_run_and_leaves_no_temporary_file() {
    let folder = model();
    let signals = [Signal::INT, Signal::TERM, Signal::HUP];
    for signal in signals.into_iter().filter(|signal| !is_ignored(*signal)) {
        let mut child = writing(&folder, LARGE, &[]);
        send(&child, signal);
        let status = child.wait().unwrap();
        assert_eq!(status.signal(), Some(signal.as_raw()));
        assert_eq!(names(folder.path()), ["m.json"], "{signal:?}");
    }
}

#[test]
fn what_a_killed_run_leaves_the_next_one_sweeps_up() {
    let folder = model();
    let mut child = writing(&folder, LARGE, &[]);
    send(&child, Signal::KILL);
    child.wait().unwrap();
    let left = names(folder.path());
    assert_eq!(left.len(), 2);
    let own = format!(".grainform-{}-", child.id());
    assert!(left[0].starts_with(&own), "{left:?}");
    succeed(&folder, &["synth", "bean", "-o", "b.ply"]);
    assert_eq!(names(folder.path()), ["b.ply", "m.json"]);
}

#[test]
fn the_temporary_file_of_a_living_run_is_left_alone() {
    let folder = model();
    let mut child = writing(&folder, SMALL, &[]);
    succeed(&folder, &["synth", "bean", "-o", "b.ply"]);
    assert!(child.wait().unwrap().success());
    assert_eq!(names(folder.path()), ["b.ply", "m.json", "m.stl"]);
}

#[test]
fn a_batch_that_is_stopped_tells_how_it_goes_on() {
    if is_ignored(Signal::INT) {
        return;
    }
    let folder = lot(6);
    let child = begin(&folder, &["batch", "lot", "-o", "out", "--jobs", "1"]);
    while !folder.path().join("out/journal.jsonl").exists() {}
    send(&child, Signal::INT);
    let output = child.wait_with_output().unwrap();
    assert_eq!(output.status.signal(), Some(Signal::INT.as_raw()));
    let told = String::from_utf8(output.stderr).unwrap();
    let expected = "stopped: the same command goes on from what is saved";
    assert!(told.contains(expected), "{told}");
}

/// What is told of the work while it lasts is taken off the terminal.
#[cfg(target_os = "linux")]
#[test]
fn a_signal_leaves_no_line_on_the_terminal() {
    let folder = folder();
    let grainform = assert_cmd::cargo::cargo_bin!("grainform").display();
    let run = format!("sleep 5 | timeout --foreground --signal TERM 2 {grainform} fit -");
    let output = Command::new("script")
        .args(["--quiet", "--return", "--command", &run, "/dev/null"])
        .current_dir(folder.path())
        .stdin(Stdio::null())
        .output()
        .expect("a terminal");
    assert_eq!(output.status.code(), Some(124));
    let told = String::from_utf8(output.stdout).unwrap();
    assert!(told.trim_end().ends_with("\r\u{1b}[2K"), "{told:?}");
}

#[cfg(target_os = "linux")]
#[test]
fn a_run_under_nohup_outlives_its_terminal() {
    let folder = model();
    let mut child = writing(
        &folder,
        SMALL,
        &["sh", "-c", "trap '' HUP; exec \"$@\"", "sh"],
    );
    send(&child, Signal::HUP);
    assert!(child.wait().unwrap().success());
    assert_eq!(names(folder.path()), ["m.json", "m.stl"]);
}
