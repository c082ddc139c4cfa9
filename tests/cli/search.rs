use super::{folder, grain, json, names, succeed};

#[test]
fn lists_every_candidate_and_chooses_what_fit_chooses() {
    let folder = folder();
    let maize = grain("maize.ply");
    let report = json(&folder, &["search", &maize]);
    let candidates = report["candidates"].as_array().unwrap();
    assert_eq!(candidates.len(), 40);
    for row in candidates {
        assert!(row["heldout_rms"].is_f64(), "{row}");
        let reason = row["rejected"].as_str().unwrap_or_default();
        assert!(!reason.starts_with("skipped"), "{row}");
    }
    let fitted = json(&folder, &["fit", &maize]);
    let chosen = &candidates[report["chosen"].as_u64().unwrap() as usize];
    for name in [
        "degree",
        "segments",
        "coefficients",
        "heldout_rms",
        "reduced_segments",
    ] {
        assert_eq!(chosen[name], fitted[name], "{name}");
    }
    for name in ["rule", "limit", "noise", "mean_radius", "reference"] {
        assert_eq!(report[name], fitted[name], "{name}");
    }
}

#[test]
fn the_table_marks_the_choice() {
    let folder = folder();
    let text = succeed(&folder, &["search", &grain("bean.ply"), "--exhaustive"]);
    let marked: Vec<&str> = text
        .lines()
        .filter(|l| l.trim_start().starts_with("* "))
        .collect();
    let row: Vec<&str> = marked[0].split_whitespace().collect();
    assert_eq!(row[..4], ["*", "16", "3", "256"]);
    assert!(marked[1].contains("held-out RMS is within the limit"));
    assert!(names(folder.path()).is_empty());
}

#[test]
fn csv_has_the_columns_and_rows_of_the_json() {
    let folder = folder();
    let report = json(&folder, &["search", &grain("bean.ply"), "--csv", "all.csv"]);
    let text = std::fs::read_to_string(folder.path().join("all.csv")).unwrap();
    let mut lines = text.lines();
    let columns: Vec<&str> = lines.next().unwrap().split(',').collect();
    let candidates = report["candidates"].as_array().unwrap();
    assert_eq!(lines.clone().count(), candidates.len());
    for (line, row) in lines.zip(candidates) {
        for (cell, column) in line.splitn(columns.len(), ',').zip(&columns) {
            match &row[*column] {
                serde_json::Value::Null => assert_eq!(cell, ""),
                serde_json::Value::String(text) => assert_eq!(cell, format!("\"{text}\"")),
                value => assert_eq!(cell.parse::<f64>().ok(), value.as_f64()),
            }
        }
    }
}
