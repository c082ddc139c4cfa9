use super::{errors, folder, grainform, json, names, succeed};
use serde_json::Value;
use std::collections::BTreeMap;
use std::path::Path;
use std::process::{Child, Command, Stdio};
use std::time::Instant;
use tempfile::TempDir;

/// What is measured: little, so that it takes no time.
const FEW: [&str; 3] = ["--only", "area,volume,dimensions", "-q"];

/// The files that are the same bytes in every run.
const RESULTS: [&str; 3] = ["results.csv", "results.parquet", "summary.json"];

/// A folder with some small scans in the folder `lot`.
pub(super) fn lot(count: usize) -> TempDir {
    let folder = folder();
    std::fs::create_dir(folder.path().join("lot")).unwrap();
    for number in 0..count {
        let axes = format!("{},2,1.5", 2.0 + 0.1 * number as f64);
        let name = format!("lot/{number:02}.xyz");
        let words = [
            "synth",
            "ellipsoid",
            "--axes",
            &axes,
            "--points",
            "50",
            "-o",
            &name,
        ];
        succeed(&folder, &words);
    }
    folder
}

fn batch<'a>(words: &[&'a str]) -> Vec<&'a str> {
    [&["batch"], words, &FEW].concat()
}

fn bytes(folder: &TempDir, results: &str) -> Vec<Vec<u8>> {
    let read = |name: &&str| std::fs::read(folder.path().join(results).join(name)).expect("a file");
    RESULTS.iter().map(read).collect()
}

/// The rows of a table by the names of their columns.
pub(super) fn rows(path: &Path) -> Vec<BTreeMap<String, String>> {
    let mut reader = csv::Reader::from_path(path).unwrap();
    reader.deserialize().map(|row| row.unwrap()).collect()
}

#[test]
fn rows_are_the_same_bytes_with_any_number_of_threads_and_bad_files_are_told() {
    let folder = lot(3);
    std::fs::write(folder.path().join("lot/bad, \"very\".ply"), "no scan").unwrap();
    let paths = ["lot", "gone.ply"];
    let run = |output: &str, jobs: &str| {
        let output = ["-o", output, "--jobs", jobs, "--unit", "mm"];
        grainform(&folder, &batch(&[&paths[..], &output].concat()))
    };
    let one = run("one", "1");
    assert_eq!(one.status.code(), Some(1), "{}", errors(&one));
    assert!(
        errors(&one).contains("2 of 5 scans have no result"),
        "{}",
        errors(&one)
    );
    assert_eq!(run("three", "3").status.code(), Some(1));
    assert_eq!(bytes(&folder, "one"), bytes(&folder, "three"));

    let rows = rows(&folder.path().join("one/results.csv"));
    let paths: Vec<&str> = rows.iter().map(|row| row["path"].as_str()).collect();
    let expected = [
        "lot/00.xyz",
        "lot/01.xyz",
        "lot/02.xyz",
        "lot/bad, \"very\".ply",
        "gone.ply",
    ];
    assert_eq!(paths, expected);
    for row in &rows[..3] {
        assert_eq!((row["status"].as_str(), row["unit"].as_str()), ("ok", "mm"));
    }
    let row = &rows[0];
    let fit = json(&folder, &["fit", &row["path"]]);
    for (column, value) in [
        ("area", &fit["area"]),
        ("area_se", &fit["standard_errors"]["area"]),
        (
            "dimensions.width_se",
            &fit["standard_errors"]["dimensions"]["width"],
        ),
        ("volume_se", &fit["standard_errors"]["volume"]),
        ("dimensions.length", &fit["dimensions"]["length"]),
        ("heldout_rms", &fit["heldout_rms"]),
    ] {
        assert_eq!(row[column].parse().ok(), value.as_f64(), "{column}");
    }
    assert!(rows[3]["reason"].contains("expected `ply`") && rows[3]["area"].is_empty());
    assert!(rows[4]["reason"].contains("cannot read the file gone.ply"));
    assert!(rows[4]["hash"].is_empty() && rows[3]["hash"].len() == 64);

    let [csv, parquet] = ["one/results.csv", "three"]
        .map(|lot| json(&folder, &["compare", lot, "one/results.parquet"]));
    assert_eq!(csv, parquet);
    let area = &csv["measures"][0];
    assert_eq!(
        (area["measure"].as_str(), area["difference"].as_f64()),
        (Some("area"), Some(0.0))
    );
    assert_eq!(area["counts"], serde_json::json!([3, 3]));
}

/// A row with fewer figures, as of a table that had fewer columns, is made again.
#[test]
fn a_row_is_taken_over_only_with_all_its_figures() {
    let folder = folder();
    let synth = "synth ellipsoid --points 800 --noise 0.002 -o s.ply";
    succeed(&folder, &synth.split(' ').collect::<Vec<_>>());
    let words = ["batch", "s.ply", "-o", "lot", "--only", "area,curvature"];
    succeed(&folder, &words);
    let table = folder.path().join("lot/results.csv");
    let row = &rows(&table)[0];
    let [largest, error] = ["", "_se"].map(|end| {
        let cell = &row[&format!("curvature.larger.largest{end}")];
        cell.parse::<f64>().expect("a number")
    });
    assert!(error > 0.0 && error < largest, "{largest} ± {error}");
    let whole = std::fs::read(&table).unwrap();
    let journal = folder.path().join("lot/journal.jsonl");
    let text = std::fs::read_to_string(&journal).unwrap();
    let (_, json) = text.trim_end().split_once(' ').unwrap();
    let mut older: Value = serde_json::from_str(json).unwrap();
    older["figures"].as_array_mut().unwrap().remove(1);
    let json = older.to_string();
    let sum = blake3::hash(json.as_bytes()).to_hex();
    std::fs::write(&journal, format!("{} {json}\n", &sum[..16])).unwrap();
    succeed(&folder, &words);
    assert_eq!(std::fs::read(&table).unwrap(), whole);
}

/// A command that is begun, and not waited for.
pub(super) fn begin(folder: &TempDir, words: &[&str]) -> Child {
    Command::new(assert_cmd::cargo::cargo_bin!("grainform"))
        .args(words)
        .current_dir(folder.path())
        .stderr(Stdio::piped())
        .spawn()
        .expect("the binary is built")
}

/// The lines of a journal.
fn lines(journal: &Path) -> usize {
    std::fs::read_to_string(journal).map_or(0, |text| text.lines().count())
}

#[test]
fn a_batch_that_is_killed_at_any_moment_goes_on_without_loss() {
    let folder = lot(6);
    let started = Instant::now();
    succeed(&folder, &batch(&["lot", "-o", "whole", "--models"]));
    let whole = started.elapsed();
    let words = ["lot", "-o", "killed", "--models", "--jobs", "2"];
    for moment in 0..25 {
        // Later runs go on from what is there, and so would soon be done.
        if moment % 5 == 0 {
            let _ = std::fs::remove_dir_all(folder.path().join("killed"));
        }
        let mut child = begin(&folder, &batch(&words));
        // The golden ratio spreads the moments.
        std::thread::sleep(whole.mul_f64((0.618034 * f64::from(moment)).fract()));
        child.kill().unwrap();
        child.wait().unwrap();
    }
    let journal = folder.path().join("killed/journal.jsonl");
    // What a power cut may leave.
    let mut text = std::fs::read(&journal).unwrap();
    text.extend(b"0123456789abcdef {\"path\":\"lot/1");
    std::fs::write(&journal, text).unwrap();
    succeed(&folder, &batch(&words));
    assert_eq!(bytes(&folder, "killed"), bytes(&folder, "whole"));
    assert_eq!(names(&folder.path().join("killed/models")).len(), 6);
    assert_eq!(lines(&journal), 6, "every grain once");
}

#[test]
fn a_batch_on_a_full_disk_keeps_what_was_done_and_goes_on() {
    let folder = lot(3);
    let words = batch(&["lot", "-o", "full", "--jobs", "1"]);
    // Files of at most 1024 bytes: the first row has no room, or the second.
    let script = "trap '' XFSZ; ulimit -f 1; exec \"$@\"";
    let stopped = Command::new("bash")
        .args(["-c", script, "bash"])
        .arg(assert_cmd::cargo::cargo_bin!("grainform"))
        .args(&words)
        .current_dir(folder.path())
        .output()
        .expect("bash is there");
    assert_eq!(stopped.status.code(), Some(2));
    let told = errors(&stopped);
    assert!(
        told.contains("cannot write into full") && told.contains("goes on from there"),
        "{told}"
    );
    assert!(!folder.path().join("full/results.csv").exists());
    succeed(&folder, &words);
    succeed(&folder, &batch(&["lot", "-o", "whole"]));
    assert_eq!(bytes(&folder, "full"), bytes(&folder, "whole"));
}

#[test]
fn files_that_are_left_out_are_told() {
    let folder = lot(1);
    for name in ["a.csv", "b.csv", "README"] {
        std::fs::write(folder.path().join("lot").join(name), "1").unwrap();
    }
    let only = ["--only", "volume"];
    let told = |named: &str| {
        let words = [&["batch", named, "-o", "r"], &only[..]].concat();
        errors(&grainform(&folder, &words))
    };
    let note = "note: left 3 files out, such as lot/README, whose endings (.csv, none) are not those of scans: name those \
                that hold points to fit them too";
    assert!(told("lot").starts_with(note), "{}", told("lot"));
    assert!(!told("lot/00.xyz").contains("left"));
}

/// What is told on standard error of a folder with an ellipsoid, and with one that has no points in a band around it.
fn with_a_band(folder: &TempDir) -> String {
    let path = |name: &str| folder.path().join(name);
    std::fs::create_dir(path("lot")).unwrap();
    let synth = ["synth", "ellipsoid", "--axes", "6,4,3", "--points", "2000"];
    succeed(folder, &[&synth[..], &["-o", "lot/whole.xyz"]].concat());
    let text = std::fs::read_to_string(path("lot/whole.xyz")).unwrap();
    let is_seen = |line: &&str| {
        let x: f64 = line.split(' ').next().unwrap().parse().unwrap();
        (x / 6.0).abs() > 0.35
    };
    let rest: Vec<&str> = text.lines().filter(is_seen).collect();
    std::fs::write(path("lot/band.xyz"), rest.join("\n")).unwrap();
    errors(&grainform(
        folder,
        &["batch", "lot", "-o", "r", "--only", "area,volume"],
    ))
}

#[test]
fn what_is_withheld_of_some_grains_is_told_of_their_means() {
    let folder = folder();
    let told = with_a_band(&folder);
    let summary = std::fs::read_to_string(folder.path().join("r/summary.json")).unwrap();
    let summary: Value = serde_json::from_str(&summary).unwrap();
    let [lacking, own] = [0, 1].map(|at| summary["warnings"][at].as_str().unwrap());
    let expected =
        "Of 2 grains 1 lacks area and volume (no point lies in holes as large as a cap of ";
    assert!(lacking.starts_with(expected), "{lacking}");
    assert!(own.starts_with("1 of 2 grains has warnings"), "{own}");
    assert!(told.contains(lacking) && told.contains(own), "{told}");
    let told = errors(&grainform(&folder, &["report", "r", "-o", "r.html"]));
    assert!(
        told.starts_with("warning: Of 2 grains of r 1 lacks area and volume ("),
        "{told}"
    );
    // The advice can be followed.
    let reason = &rows(&folder.path().join("r/results.csv"))[0]["not_measured"];
    assert!(
        reason.ends_with("take the guess (fit, measure and report --extrapolate)"),
        "{reason}"
    );
    let guess = ["fit", "lot/band.xyz", "--extrapolate"];
    assert!(json(&folder, &guess)["volume"].is_number());
}

#[test]
fn a_model_that_is_named_is_told_to_be_one() {
    let folder = lot(1);
    std::fs::write(
        folder.path().join("m.json"),
        "{\"format\": \"grainform model\"}",
    )
    .unwrap();
    grainform(&folder, &batch(&["m.json", "-o", "r"]));
    let reason = &rows(&folder.path().join("r/results.csv"))[0]["reason"];
    let expected = "m.json is no scan: it is JSON, as models are, which measure, mesh, report, contact, clump, export-dem and bed read; a scene of glTF is to be converted to PLY";
    assert_eq!(reason, expected);
    let fitted = errors(&grainform(&folder, &["fit", "m.json"]));
    assert_eq!(fitted, format!("error: {expected}\n"));
}

#[cfg(unix)]
#[test]
fn a_pipe_in_a_folder_is_told_and_not_waited_for() {
    let folder = lot(1);
    let pipe = folder.path().join("lot/p.ply");
    assert!(Command::new("mkfifo").arg(pipe).status().unwrap().success());
    let output = grainform(&folder, &["batch", "lot", "-o", "r", "--only", "volume"]);
    let told = errors(&output);
    let note = "note: left out lot/p.ply, which is no file";
    assert!(output.status.success() && told.starts_with(note), "{told}");
}

#[cfg(unix)]
#[test]
fn a_pipe_that_is_named_is_refused_and_not_waited_for() {
    let folder = lot(1);
    let pipe = folder.path().join("p.ply");
    assert!(Command::new("mkfifo").arg(pipe).status().unwrap().success());
    let output = grainform(&folder, &batch(&["lot", "p.ply", "-o", "r"]));
    let told = errors(&output);
    assert!(
        told.starts_with("error: p.ply is no file but a pipe"),
        "{told}"
    );
    assert!(!folder.path().join("r").exists());
}

#[test]
fn copies_of_a_scan_are_told_by_the_batch_and_beside_another_lot() {
    let folder = lot(3);
    let path = |name: &str| folder.path().join(name);
    std::fs::copy(path("lot/01.xyz"), path("lot/02.xyz")).unwrap();
    let run = |words: &[&str]| {
        let words = [&["batch"], words, &["--only", "volume"]].concat();
        errors(&grainform(&folder, &words))
    };
    assert_eq!(run(&["lot/00.xyz", "lot/01.xyz", "-o", "apart"]), "");
    let told = run(&["lot", "-o", "lots"]);
    let warning =
        "warning: 1 scan has the same bytes as another, such as lot/02.xyz as lot/01.xyz: ";
    assert!(told.starts_with(warning), "{told}");
    let summary = std::fs::read_to_string(path("lots/summary.json")).unwrap();
    assert!(summary.contains("\"1 scan has the same bytes as another"));
    let told = errors(&grainform(&folder, &["compare", "apart", "lots"]));
    let warning = "warning: 1 grain of the other lot is of scans that others are of";
    assert!(told.contains(warning), "{told}");
    assert!(!told.contains("first lot"), "{told}");
}

#[test]
fn so_many_jobs_are_lowered_with_a_note() {
    let folder = lot(1);
    let words = [
        "batch", "lot", "-o", "r", "--only", "volume", "--jobs", "30000",
    ];
    let output = grainform(&folder, &words);
    let told = errors(&output);
    let note = "note: --jobs asks for 30000 threads; ";
    assert!(output.status.success() && told.starts_with(note), "{told}");
}

#[cfg(unix)]
#[test]
fn scans_whose_names_are_not_utf_8_have_rows_of_their_own() {
    use std::os::unix::ffi::OsStrExt;
    let folder = lot(2);
    let path = |name: &[u8]| {
        folder
            .path()
            .join("lot")
            .join(std::ffi::OsStr::from_bytes(name))
    };
    std::fs::rename(path(b"00.xyz"), path(b"\xfe.xyz")).unwrap();
    std::fs::rename(path(b"01.xyz"), path(b"\xff.xyz")).unwrap();
    succeed(&folder, &batch(&["lot", "-o", "r", "--models"]));
    let rows = rows(&folder.path().join("r/results.csv"));
    let paths: Vec<&str> = rows.iter().map(|row| row["path"].as_str()).collect();
    assert_eq!(paths, [r"lot/\xfe.xyz", r"lot/\xff.xyz"]);
    let models = names(&folder.path().join("r/models"));
    assert_eq!(models, [r"\xfe.json", r"\xff.json"]);
}

#[test]
fn models_that_earlier_runs_left_are_told() {
    let folder = lot(3);
    let told = |words: &[&str]| {
        let words = [&["batch"], words, &["-o", "r", "--only", "volume"]].concat();
        errors(&grainform(&folder, &words))
    };
    assert_eq!(told(&["lot", "--models", "--meshes"]), "");
    let left = told(&["lot/00.xyz", "--models"]);
    let note = "note: no row is of 4 files that earlier runs left, such as r/meshes/01.ply: ";
    assert!(left.contains(note), "{left}");
    // Of the same scan by other settings.
    let left = told(&["lot/00.xyz", "--segments", "1"]);
    assert!(left.contains("no row is of 6 files"), "{left}");
}

#[test]
fn a_batch_that_cannot_do_anything_writes_nothing() {
    let folder = lot(2);
    for (words, expected) in [
        (&["nothere", "-o", "r"][..], "there is no nothere; correct"),
        (
            &["gone.ply", "gone.stl", "-o", "r"],
            "there is no gone.ply, nor any other of the 2 scans; correct",
        ),
        (
            &["lot", "-o", "lot"],
            "the results cannot go into lot, for scans are looked for in it",
        ),
    ] {
        let refused = grainform(&folder, &batch(words));
        assert_eq!(refused.status.code(), Some(2), "{words:?}");
        let told = errors(&refused);
        assert!(told.starts_with(&format!("error: {expected}")), "{told}");
    }
    assert_eq!(names(folder.path()), ["lot"]);
    assert_eq!(names(&folder.path().join("lot")), ["00.xyz", "01.xyz"]);
}

#[test]
fn results_are_no_scans() {
    let folder = lot(1);
    succeed(&folder, &batch(&["lot", "-o", "r"]));
    let refused = errors(&grainform(&folder, &batch(&["r", "-o", "again"])));
    assert!(
        refused.starts_with("error: r holds the results of a batch"),
        "{refused}"
    );
}

#[test]
fn a_batch_whose_folder_is_removed_stops_and_says_so() {
    let folder = lot(6);
    let child = begin(&folder, &batch(&["lot", "-o", "gone", "--jobs", "1"]));
    while lines(&folder.path().join("gone/journal.jsonl")) == 0 {
        std::thread::yield_now();
    }
    std::fs::remove_dir_all(folder.path().join("gone")).unwrap();
    let ended = child.wait_with_output().unwrap();
    assert_eq!(ended.status.code(), Some(2));
    let told = errors(&ended);
    assert!(
        told.starts_with("error: the folder gone was removed"),
        "{told}"
    );
    assert_eq!(names(folder.path()), ["lot"]);
}

#[test]
fn what_was_changed_is_done_again_and_nothing_else() {
    let folder = lot(2);
    succeed(&folder, &batch(&["lot", "-o", "r"]));
    let kept = |words: &[&str]| {
        let words: Vec<&str> = batch(words)
            .into_iter()
            .filter(|word| *word != "-q")
            .collect();
        let told = errors(&grainform(&folder, &words));
        let note = told.lines().find_map(|line| line.strip_prefix("note: "));
        note.map_or(0, |note| note.split(' ').next().unwrap().parse().unwrap())
    };
    assert_eq!(kept(&["lot", "-o", "r"]), 2);
    succeed(
        &folder,
        &["synth", "sphere", "--points", "98", "-o", "lot/01.xyz"],
    );
    assert_eq!(kept(&["lot", "-o", "r"]), 1);
    assert_eq!(kept(&["lot", "-o", "r", "--segments", "1"]), 0);
    assert_eq!(kept(&["lot/0[02].xyz", "-o", "r"]), 1);
    assert_eq!(rows(&folder.path().join("r/results.csv")).len(), 1);
}

#[test]
fn a_model_that_was_damaged_is_made_again() {
    let folder = lot(1);
    let words = batch(&["lot", "-o", "r", "--models", "--meshes"]);
    succeed(&folder, &words);
    for file in ["r/models/00.json", "r/meshes/00.ply"] {
        let path = folder.path().join(file);
        let whole = std::fs::read(&path).unwrap();
        std::fs::write(&path, "xx").unwrap();
        succeed(&folder, &words);
        assert!(std::fs::read(&path).unwrap() == whole, "{file}");
    }
}

#[test]
fn results_cannot_go_into_a_file_and_the_reason_is_told_once() {
    let folder = lot(1);
    std::fs::write(folder.path().join("r"), "").unwrap();
    let told = errors(&grainform(&folder, &batch(&["lot", "-o", "r"])));
    assert!(
        told.starts_with("error: cannot make the folder r: "),
        "{told}"
    );
    assert_eq!(told.matches("os error").count(), 1, "{told}");
}

#[cfg(unix)]
#[test]
fn folders_are_looked_into_and_a_dangling_link_is_told() {
    let folder = lot(1);
    let path = |name: &str| folder.path().join(name);
    std::fs::create_dir(path("lot/nested")).unwrap();
    std::fs::rename(path("lot/00.xyz"), path("lot/nested/00.xyz")).unwrap();
    std::os::unix::fs::symlink("..", path("lot/nested/loop")).unwrap();
    std::os::unix::fs::symlink("nowhere", path("lot/gone.ply")).unwrap();
    for named in ["lot", "lot/**/*.[px][ly]?"] {
        let output = grainform(&folder, &batch(&[named, "-o", "lot/r", "--meshes"]));
        assert_eq!(output.status.code(), Some(1));
        let rows = rows(&path("lot/r/results.csv"));
        let told: Vec<[&str; 2]> = rows
            .iter()
            .map(|row| [row["path"].as_str(), row["status"].as_str()])
            .collect();
        let expected = [["lot/gone.ply", "failed"], ["lot/nested/00.xyz", "ok"]];
        assert_eq!(told, expected, "{named}");
        assert!(rows[0]["reason"].contains("cannot read the file lot/gone.ply"));
    }
}

#[test]
fn a_second_batch_on_the_same_folder_refuses() {
    let folder = lot(1);
    std::fs::create_dir(folder.path().join("r")).unwrap();
    let lock = std::fs::File::create(folder.path().join("r/.lock")).unwrap();
    lock.try_lock().unwrap();
    let refused = grainform(&folder, &batch(&["lot", "-o", "r"]));
    assert_eq!(refused.status.code(), Some(2));
    assert!(errors(&refused).starts_with("error: another batch writes into r"));
    assert_eq!(names(&folder.path().join("r")), [".lock"]);
    drop(lock);
    succeed(&folder, &batch(&["lot", "-o", "r"]));
}

#[test]
fn a_table_that_no_batch_has_written_is_not_replaced() {
    let folder = lot(1);
    let table = folder.path().join("own/results.csv");
    std::fs::create_dir(folder.path().join("own")).unwrap();
    std::fs::write(&table, "mine").unwrap();
    let refused = grainform(&folder, &batch(&["lot", "-o", "own"]));
    let told = errors(&refused);
    assert_eq!(refused.status.code(), Some(2), "{told}");
    assert!(told.contains("own/results.csv would be replaced"), "{told}");
    assert_eq!(names(&folder.path().join("own")), ["results.csv"]);
    std::fs::remove_file(&table).unwrap();
    for _ in 0..2 {
        succeed(&folder, &batch(&["lot", "-o", "own"]));
    }
}

#[test]
fn each_scan_is_told_when_it_begins_and_when_it_ends_if_asked_for() {
    let folder = lot(2);
    let words = ["batch", "lot", "-o", "own", "--only", "area", "--jobs", "1"];
    let told = errors(&grainform(&folder, &[&words[..], &["-v"]].concat()));
    let steps: Vec<&str> = told
        .lines()
        .filter_map(|line| Some(line.split_once(" s  ")?.1))
        .collect();
    let expected = [
        "Fitting lot/00.xyz",
        "Ended lot/00.xyz (1 of 2 done)",
        "Fitting lot/01.xyz",
        "Ended lot/01.xyz (2 of 2 done)",
    ];
    assert_eq!(steps, expected);
    assert!(!errors(&grainform(&folder, &words)).contains("Fitting"));
}
