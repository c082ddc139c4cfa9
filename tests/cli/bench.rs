use super::{errors, folder, grainform, json, names, number, succeed};
use serde_json::Value;
use std::process::Command;

/// A folder with two small scans of about so many points.
fn scans(points: &str) -> tempfile::TempDir {
    let folder = folder();
    succeed(
        &folder,
        &["synth", "bean", "--points", points, "-o", "small.ply"],
    );
    std::fs::create_dir(folder.path().join("other")).unwrap();
    std::fs::copy(
        folder.path().join("small.ply"),
        folder.path().join("other/small.xyz.ply"),
    )
    .unwrap();
    folder
}

#[test]
fn writes_a_table_and_plots_and_nothing_else() {
    let folder = scans("50");
    let words = ["bench", "small.ply", "-o", "a/b", "--unit", "mm"];
    let report = json(&folder, &words);
    assert_eq!(report["unit"], "mm");
    assert_eq!(
        names(&folder.path().join("a/b")),
        [
            "bench.csv",
            "small-coefficients.svg",
            "small-nanoseconds.svg",
            "small-seconds.svg"
        ]
    );
    let scan = &report["scans"][0];
    assert_eq!(scan["points"], 56);
    assert_eq!(scan["reference"], "directions");
    assert!(scan["noise"].is_null());
    let rows = scan["rows"].as_array().unwrap();
    let skipped = scan["skipped"].as_u64().unwrap() as usize;
    let refused = scan["refused"].as_u64().unwrap() as usize;
    assert_eq!(
        rows.len() + skipped + refused,
        20 + 16 * 7 + 5 * 5 + 8 + 7 + 3
    );
    assert!(rows.len() > 30 && skipped > 30);

    let mut automatic = 0;
    for row in rows {
        let is_adaptive = row["family"] == "adaptive" || row["family"] == "estimate";
        let has_degree = !is_adaptive && row["family"] != "superquadric";
        automatic += usize::from(is_adaptive && row["tolerance"].is_null());
        assert!(is_adaptive || row["tolerance"].is_null(), "{row}");
        assert_eq!(row["degree"].is_number(), has_degree, "{row}");
        assert!(row["nanoseconds"].as_f64() > Some(0.0), "{row}");
        assert!(row["seconds"].as_f64() <= row["seconds_most"].as_f64());
        assert!(row["hidden_share"].is_null() && row["nanoseconds_bulk"].is_null());
    }
    assert_eq!(automatic, 1);

    let text = std::fs::read_to_string(folder.path().join("a/b/bench.csv")).unwrap();
    let mut lines = text.lines();
    let columns: Vec<&str> = lines.next().unwrap().split(',').collect();
    assert_eq!(lines.clone().count(), rows.len());
    for (line, row) in lines.zip(rows) {
        let cells: Vec<&str> = line.splitn(columns.len(), ',').collect();
        assert_eq!(cells.len(), columns.len(), "{line}");
        for (cell, column) in cells.iter().zip(&columns) {
            match row.get(*column).unwrap_or(&scan[*column]) {
                Value::Null => assert_eq!(*cell, ""),
                Value::String(text) => assert_eq!(cell.trim_matches('"'), text),
                value => assert_eq!(cell.parse::<f64>().ok(), value.as_f64()),
            }
        }
    }
    let fields = rows[0].as_object().unwrap().len()
        + ["scan", "points", "hidden", "noise", "reference"].len();
    assert_eq!(columns.len(), fields, "a field without a column");
}

#[test]
fn the_table_lists_the_front_of_every_scan() {
    let folder = scans("98");
    let words = [
        "synth",
        "bean",
        "--points",
        "8",
        "-o",
        "other/small.xyz.ply",
    ];
    succeed(&folder, &words);
    let text = succeed(&folder, &["bench", "small.ply", "other/small.xyz.ply"]);
    for heading in ["small.ply: 98 points", "other/small.xyz.ply: 8 points"] {
        assert!(text.contains(heading), "{text}");
    }
    assert!(text.contains("settings have more coefficients than half of the points"));
    assert_eq!(text.matches("wrote ").count(), 7);
    assert_eq!(names(&folder.path().join("bench")).len(), 7);
    // Which rows are least for seconds is up to the clock; whole or in segments, the estimate has the least error.
    let is_estimate = |row: &&str| row.starts_with("adaptive") || row.starts_with("estimate");
    let rows = text.lines().map(str::trim_start);
    let least = rows.filter(|row| row.contains("coefficients"));
    assert!(least.filter(is_estimate).count() >= 4, "{text}");
}

#[test]
fn quiet_says_nothing() {
    let folder = scans("8");
    let output = grainform(&folder, &["bench", "small.ply", "--quiet"]);
    assert!(output.status.success());
    assert!(output.stdout.is_empty() && errors(&output).is_empty());
}

#[test]
fn rivals_without_python_are_told_how_to_get_them() {
    let folder = scans("8");
    let output = Command::new(assert_cmd::cargo::cargo_bin!("grainform"))
        .args(["bench", "small.ply", "--rivals"])
        .env("PATH", folder.path())
        .current_dir(folder.path())
        .output()
        .expect("the binary is built");
    assert_eq!(output.status.code(), Some(2));
    assert!(errors(&output).contains("python3 -m pip install ducc0 numpy"));
    assert!(!folder.path().join("bench").exists());
}

#[test]
#[ignore = "needs python3 with ducc0 and numpy in the path"]
fn rivals_are_least_squares_fits_judged_by_the_same_hidden_points() {
    let folder = scans("386");
    let scan = &json(&folder, &["bench", "small.ply", "--rivals"])["scans"][0];
    let hidden = number(scan, "hidden");
    assert!(hidden > 3.0 && hidden + number(scan, "points") == 386.0);
    let of_family = |family: &str| -> Vec<Value> {
        let rows = scan["rows"].as_array().unwrap().iter();
        let of_family = rows.filter(|row| row["family"] == family);
        of_family.cloned().collect()
    };
    let (own, rivals) = (of_family("whole"), of_family("ducc0"));
    assert_eq!(own.len(), rivals.len());
    assert!(own.len() > 3);
    // Of fewer points the iterations that suit ducc0 best end before the least squares.
    for (own, rival) in own.iter().zip(&rivals) {
        assert_eq!(own["degree"], rival["degree"]);
        let ratio = number(rival, "hidden_share") / number(own, "hidden_share");
        assert!((ratio - 1.0).abs() < 0.03, "{own} {rival}");
        assert!(number(rival, "nanoseconds") > 0.0 && number(rival, "nanoseconds_bulk") > 0.0);
    }
}
