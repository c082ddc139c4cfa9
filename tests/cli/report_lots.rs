//! Pages of folders of results, and what is known of their grains.

use super::report::record;
use super::{errors, folder, grainform, succeed};
use serde_json::Value;
use std::fs;
use tempfile::TempDir;

/// A folder with a table of results in its folder `lot`.
fn results(table: &str) -> TempDir {
    let folder = folder();
    fs::create_dir(folder.path().join("lot")).unwrap();
    fs::write(folder.path().join("lot/results.csv"), table).unwrap();
    folder
}

/// The exit code, and what is told on standard error, of a report of these results beside a table of truths.
fn beside(folder: &TempDir, truth: &str) -> (Option<i32>, String) {
    fs::write(folder.path().join("truth.csv"), truth).unwrap();
    let words = ["report", "lot", "--truth", "truth.csv", "-o", "r.html"];
    let output = grainform(folder, &words);
    (output.status.code(), errors(&output))
}

#[test]
fn a_truth_that_tells_nothing_of_the_results_is_refused() {
    let folder = results("path,status,degree,area,area_se,volume\na/one.ply,ok,3,2.5,0.1,7\n");
    let told = |truth: &str| beside(&folder, truth);
    let (code, message) = told("file,mesh_area\none.ply,2.4\n");
    assert_eq!(code, Some(2));
    assert!(
        message.ends_with("as these are: area, volume\n"),
        "{message}"
    );
    let (code, message) = told("file,area\nanother.ply,2.4\n");
    assert_eq!(code, Some(2));
    assert!(message.contains("such as one.ply"), "{message}");
    assert_eq!(told("file,mesh_area,area\none.ply,2.4,2.4\n").0, Some(0));
}

#[test]
fn a_truth_is_told_by_path_where_names_are_there_twice() {
    let folder = results("path,status,area\na/one.ply,ok,2.5\nb/one.ply,ok,3.5\n");
    let told = |truth: &str| beside(&folder, truth);
    let (code, message) = told("file,area\none.ply,2.4\n");
    assert_eq!(code, Some(2));
    assert!(message.contains("such as a/one.ply"), "{message}");
    let by_path = "file,area\nb/one.ply,3.4\na/one.ply,2.4\n";
    assert_eq!(told(by_path), (Some(0), String::new()));
    let page = fs::read_to_string(folder.path().join("r.html")).unwrap();
    assert!(page.contains("[[\"a/one.ply\",\"2.4\"],[\"b/one.ply\",\"3.4\"]]"));
    let of_one = "file,area\na/one.ply,2.4\n";
    assert_eq!(told(of_one), (Some(0), String::new()));
}

#[test]
fn a_truth_that_tells_of_a_scan_twice_is_refused_and_rows_of_no_scan_are_counted() {
    let folder = results("path,status,area\na/one.ply,ok,2.5\nb/two.ply,ok,3.5\n");
    let told = |truth: &str| beside(&folder, truth);
    let twice = "file,area\na/one.ply,2.4\nb/two.ply,3.4\na/one.ply,9.9\n";
    let (code, message) = told(twice);
    assert_eq!(code, Some(2));
    assert!(
        message.contains("truth.csv tells of a/one.ply twice, in lines 2 and 4: leave one"),
        "{message}"
    );
    let (code, message) = told("file,area\na/one.ply,2.4\ntwo.ply,3.4\n");
    assert_eq!((code, message.as_str()), (Some(0), ""));
    let (code, message) = told("file,area\na/one.ply,2.4\nthree.ply,1\nfour.ply,1\n");
    assert_eq!(code, Some(0));
    let warning = "2 rows of truth.csv name no scan of lot.";
    assert_eq!(message, format!("warning: {warning}\n"));
    let page = fs::read_to_string(folder.path().join("r.html")).unwrap();
    assert_eq!(record(&page)["page"]["lots"][0]["warnings"][0], warning);
}

#[test]
fn a_truth_that_is_not_clear_is_refused() {
    let folder = results("path,status,area\na/one.ply,ok,2.5\n");
    let refused = |truth: &str| {
        let (code, message) = beside(&folder, truth);
        assert_eq!(code, Some(2), "{message}");
        message
    };
    let message = refused("file,area,area\none.ply,2.4,2.5\n");
    assert!(message.contains("two columns that are called area"));
    for cell in ["n/a", "\"2,400.5\"", "inf"] {
        let message = refused(&format!("file,area\none.ply,{cell}\n"));
        assert!(message.contains("as area, which is no number"), "{message}");
    }
    assert_eq!(beside(&folder, "file,area\none.ply,\n").0, Some(0));
}

/// What a page shows of the results in the folder `r`, and what is told on standard error.
fn shown(folder: &TempDir) -> (Value, String) {
    let output = grainform(folder, &["report", "r", "-o", "r.html"]);
    assert!(output.status.success(), "{}", errors(&output));
    let page = fs::read_to_string(folder.path().join("r.html")).unwrap();
    (record(&page)["page"]["lots"][0].clone(), errors(&output))
}

#[test]
fn a_page_shows_the_models_that_were_saved_with_the_rows_and_no_others() {
    let folder = super::batch::lot(2);
    let batch = |words: &[&str]| {
        let words = [&["batch", "lot", "-o", "r", "-q"], words].concat();
        succeed(&folder, &words);
    };
    let has_surface = |lot: &Value| [0, 1].map(|at| lot["surfaces"][at].is_string());
    let [own, other, journal] = ["models/00.json", "models/01.json", "journal.jsonl"]
        .map(|name| folder.path().join("r").join(name));
    batch(&["--only", "volume", "--models"]);
    let (lot, told) = shown(&folder);
    assert_eq!((has_surface(&lot), told.as_str()), ([true, true], ""));

    let kept = fs::read(&own).unwrap();
    fs::copy(&other, &own).unwrap();
    let (lot, told) = shown(&folder);
    assert_eq!(has_surface(&lot), [false, true]);
    assert!(
        told.contains("warning: 1 model of r is not shown"),
        "{told}"
    );
    assert!(
        told.contains(lot["warnings"][0].as_str().unwrap()),
        "{told}"
    );
    let why = lot["no_surface"][0].as_str().unwrap();
    assert!(
        why.contains("not tell that it was saved with this row"),
        "{why}"
    );

    fs::write(&own, kept).unwrap();
    let lines = fs::read(&journal).unwrap();
    fs::remove_file(&journal).unwrap();
    let (lot, told) = shown(&folder);
    assert_eq!(has_surface(&lot), [false, false]);
    assert!(told.contains("2 models of r are not shown"), "{told}");

    // Rows of other settings, which saved none.
    fs::write(&journal, lines).unwrap();
    batch(&["--only", "area"]);
    let (lot, told) = shown(&folder);
    assert_eq!(has_surface(&lot), [false, false]);
    assert!(told.contains("2 models of r are not shown"), "{told}");
    fs::remove_dir_all(folder.path().join("r/models")).unwrap();
    let (lot, told) = shown(&folder);
    assert_eq!(told, "");
    let why = lot["no_surface"][1].as_str().unwrap();
    assert!(why.contains("batch --models saves"), "{why}");
}

#[test]
fn models_beyond_the_most_surfaces_of_a_page_are_told_to_be_left_out() {
    let rows: String = (0..1002).map(|at| format!("{at}.ply,ok,2.5\n")).collect();
    let folder = results(&format!("path,status,area\n{rows}"));
    fs::rename(folder.path().join("lot"), folder.path().join("r")).unwrap();
    fs::create_dir(folder.path().join("r/models")).unwrap();
    fs::write(folder.path().join("r/models/1000.json"), "{}").unwrap();
    let (lot, told) = shown(&folder);
    let why = |at: usize| lot["no_surface"][at].as_str().unwrap().to_owned();
    assert!(
        why(1000).contains("of the first 1000 scans alone"),
        "{}",
        why(1000)
    );
    for at in [999, 1001] {
        assert!(why(at).contains("There is no model"), "{}", why(at));
    }
    assert!(told.contains("models of 1 more are there"), "{told}");
    assert!(
        told.contains(lot["warnings"][0].as_str().unwrap()),
        "{told}"
    );
}
