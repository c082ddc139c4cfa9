//! The folder of a bed: what is made, what goes on, what is removed, what is refused.

use super::bed::{brief, models};
use super::{errors, grainform, json, names, succeed};
use std::fs;
use std::process::Command;

#[test]
fn more_seconds_let_a_bed_go_on() {
    let folder = models();
    let run = |seconds| json(&folder, &brief(seconds, "bed"))["runs"][0].clone();
    let (short, long) = (run("0.02"), run("0.04"));
    assert_eq!(short["is_at_rest"], false);
    let [short, long] = [short, long].map(|run| run["steps"].as_u64().unwrap());
    assert!(long > short, "{short} {long}");
    let text = succeed(&folder, &brief("0.04", "other"));
    assert!(text.contains(&format!("{long} steps")), "{text}");
    let [state, other] = ["bed", "other"].map(|name| {
        let path = folder.path().join(name).join("state.json");
        fs::read(path).unwrap()
    });
    assert!(state == other);
}

#[test]
fn a_new_bed_removes_what_a_former_one_left() {
    let folder = models();
    succeed(&folder, &brief("0.11", "bed"));
    let bed = folder.path().join("bed");
    assert_eq!(names(&bed.join("frames")).len(), 3);
    fs::remove_file(bed.join("state.json")).unwrap();
    // What a process that is gone was about to write.
    let mut child = Command::new(assert_cmd::cargo::cargo_bin!("grainform"))
        .arg("--version")
        .stdout(std::process::Stdio::null())
        .spawn()
        .unwrap();
    child.wait().unwrap();
    let temporary = format!(".grainform-{}-a.tmp", child.id());
    for place in [&bed, &bed.join("frames")] {
        fs::write(place.join(&temporary), "").unwrap();
    }
    fs::write(bed.join("frames/mine.txt"), "").unwrap();
    succeed(&folder, &brief("0.01", "bed"));
    assert_eq!(names(&bed.join("frames")), ["bed.00000.dump", "mine.txt"]);
    assert_eq!(names(&bed), ["bed.png", "bed.vtk", "frames", "state.json"]);
}

#[test]
fn a_state_that_no_bed_can_be_in_is_refused() {
    let folder = models();
    let words = brief("0.01", "bed");
    succeed(&folder, &words);
    let path = folder.path().join("bed/state.json");
    let state = fs::read_to_string(&path).unwrap();
    let (head, tail) = state.split_once("\"velocity\":[").unwrap();
    let fast = format!(
        "{head}\"velocity\":[1e300{}",
        &tail[tail.find(',').unwrap()..]
    );
    for (text, cause) in [
        (&state[..200], "EOF while parsing"),
        (&fast, "no bed can go on"),
    ] {
        fs::write(&path, text).unwrap();
        let message = errors(&grainform(&folder, &words));
        assert!(
            message.contains("choose another folder, or remove it"),
            "{message}"
        );
        assert_eq!(message.matches(cause).count(), 1, "{message}");
    }
}

/// A LAMMPS that reads and runs nothing.
#[cfg(unix)]
#[test]
fn the_folder_of_a_bed_is_none_for_lammps_and_a_dry_run_is_told_as_json() {
    use std::os::unix::fs::PermissionsExt;
    let folder = models();
    let engine = folder.path().join("lmp");
    let script = "#!/bin/sh\necho GRANULAR RIGID\necho '  30 rigid bodies with 90 atoms'\n";
    fs::write(&engine, script).unwrap();
    fs::set_permissions(&engine, fs::Permissions::from_mode(0o755)).unwrap();
    let dry = [
        "--engine",
        "lammps",
        "--spheres",
        "3",
        "--dry-run",
        "--json",
    ];
    let run = |name| {
        Command::new(assert_cmd::cargo::cargo_bin!("grainform"))
            .args([&brief("0.1", name)[..], &dry].concat())
            .current_dir(folder.path())
            .env("PATH", format!("{}:/usr/bin:/bin", folder.path().display()))
            .output()
            .unwrap()
    };
    let output = run("deck");
    assert!(output.status.success(), "{}", errors(&output));
    let report: serde_json::Value = serde_json::from_slice(&output.stdout).unwrap();
    assert_eq!(report["runs"][0]["grains"], 30);
    assert_eq!(report["runs"][0]["spheres"], 90);
    assert_eq!(report["runs"][0]["folder"], "deck");
    succeed(&folder, &brief("0.01", "bed"));
    let refused = errors(&run("bed"));
    assert!(refused.contains("is the state of another bed"), "{refused}");
    fs::remove_file(folder.path().join("bed/state.json")).unwrap();
    assert!(run("bed").status.success());
    assert!(!folder.path().join("bed/frames").exists());
}
