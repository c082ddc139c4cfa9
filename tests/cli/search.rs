use super::{INDEPENDENT, folder, grain, json, names, succeed};

#[test]
fn lists_every_candidate_and_chooses_what_fit_chooses() {
    let folder = folder();
    let maize = grain("maize.ply");
    for options in [&[][..], &INDEPENDENT[..]] {
        let report = json(&folder, &[&["search", &maize], options].concat());
        let candidates = report["candidates"].as_array().unwrap();
        if options.is_empty() {
            // The whole sphere at the degree that is near enough, then the covers that were fitted.
            assert_eq!(candidates[0]["segments"], 1);
            assert!(candidates.len() > 1);
            assert!(
                candidates[1..]
                    .iter()
                    .all(|row| row["segments"].as_u64() >= Some(6))
            );
        } else {
            assert_eq!(candidates.len(), 40);
        }
        for row in candidates {
            assert!(row["heldout_rms"].is_f64(), "{row}");
            assert_eq!(row["estimate_rms"].is_f64(), options.is_empty(), "{row}");
            assert_eq!(row["area_error"].is_null(), options.is_empty(), "{row}");
            let reason = row["rejected"].as_str().unwrap_or_default();
            assert!(!reason.starts_with("skipped"), "{row}");
        }
        let fitted = json(&folder, &[&["fit", &maize], options].concat());
        let chosen = &candidates[report["chosen"].as_u64().unwrap() as usize];
        for name in [
            "degree",
            "segments",
            "coefficients",
            "heldout_rms",
            "estimate_rms",
            "reduced_segments",
        ] {
            assert_eq!(chosen[name], fitted[name], "{name}");
        }
        for name in ["rule", "limit", "noise", "mean_radius", "reference"] {
            assert_eq!(report[name], fitted[name], "{name}");
        }
    }
}

#[test]
fn the_table_marks_the_choice() {
    let folder = folder();
    let bean = grain("bean.ply");
    let words = [&["search", &bean], &INDEPENDENT[..]].concat();
    let text = succeed(&folder, &words);
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
fn the_table_of_the_default_search_lists_the_rounds_and_marks_the_choice() {
    let folder = folder();
    let maize = grain("maize.ply");
    let text = succeed(&folder, &["search", &maize]);
    let listed = json(&folder, &["search", &maize]);
    let fitted = json(&folder, &["fit", &maize]);
    let rounds = listed["candidates"].as_array().unwrap().len();
    // A heading of two lines, the rounds, the rule.
    assert_eq!(text.lines().count(), 2 + rounds + 1, "{text}");
    // The chosen cover has the fewest coefficients of those within the limit; the whole sphere comes first.
    let chosen = listed["chosen"].as_u64().unwrap() as usize;
    assert!(chosen > 0);
    for row in &listed["candidates"].as_array().unwrap()[1..] {
        let is_within = row["estimate_rms"].as_f64() <= listed["limit"].as_f64();
        let is_smaller = row["coefficients"].as_u64() < fitted["coefficients"].as_u64();
        assert!(!(is_within && is_smaller), "{row}");
    }
    let marked: Vec<&str> = text
        .lines()
        .filter(|l| l.trim_start().starts_with("* "))
        .collect();
    let row: Vec<&str> = marked[0].split_whitespace().collect();
    let figure = |name: &str| fitted[name].as_u64().unwrap().to_string();
    assert_eq!(
        row[1..4],
        [figure("segments"), figure("degree"), figure("coefficients")]
    );
    assert!(marked[1].contains(fitted["rule"].as_str().unwrap()));
}

#[test]
fn csv_has_the_columns_and_rows_of_the_json() {
    let folder = folder();
    let maize = grain("maize.ply");
    for (options, name) in [
        (&[][..], "joined.csv"),
        (&INDEPENDENT[..], "independent.csv"),
    ] {
        let report = json(
            &folder,
            &[&["search", &maize, "--csv", name], options].concat(),
        );
        let mut table = csv::Reader::from_path(folder.path().join(name)).unwrap();
        let columns = table.headers().unwrap().clone();
        assert!(columns.iter().any(|column| column == "chosen"));
        let lines: Vec<csv::StringRecord> = table.records().map(Result::unwrap).collect();
        let candidates = report["candidates"].as_array().unwrap();
        assert_eq!(lines.len(), candidates.len());
        for (at, (line, row)) in lines.iter().zip(candidates).enumerate() {
            for (cell, column) in line.iter().zip(&columns) {
                if column == "chosen" {
                    assert_eq!(cell == "1", report["chosen"] == at, "{line:?}");
                    continue;
                }
                match &row[column] {
                    serde_json::Value::Null => assert_eq!(cell, ""),
                    serde_json::Value::String(text) => assert_eq!(cell, text),
                    value => assert_eq!(cell.parse::<f64>().ok(), value.as_f64()),
                }
            }
        }
    }
}

/// Planes do not follow the bean: of the covers that were tried the nearest is marked, with the error that the summary tells.
#[test]
fn the_nearest_of_covers_that_are_too_far_is_marked() {
    let folder = folder();
    let bean = grain("bean.ply");
    for most in ["60", "600"] {
        let bounds = ["--max-degree", "1", "--max-segments", most];
        let found = json(&folder, &[&["search", &bean], &bounds[..]].concat());
        let candidates = found["candidates"].as_array().unwrap();
        let rms = |row: &serde_json::Value| row["estimate_rms"].as_f64().unwrap();
        let covers = candidates[1..].iter();
        let nearest = covers.clone().map(rms).fold(f64::INFINITY, f64::min);
        let chosen = &candidates[found["chosen"].as_u64().unwrap() as usize];
        assert_eq!(rms(chosen), nearest);
        let most: u64 = most.parse().unwrap();
        assert!(
            covers
                .clone()
                .all(|row| row["segments"].as_u64() <= Some(most))
        );
        let fitted = json(&folder, &[&["fit", &bean], &bounds[..]].concat());
        let warning = fitted["warnings"].to_string();
        assert!(
            warning.contains(&grainform::report::short(nearest)),
            "{warning}"
        );
        let largest = fitted["estimate"]["largest_difference"].as_f64().unwrap();
        assert!(largest > nearest && largest < 0.1 * fitted["mean_radius"].as_f64().unwrap());
    }
}

/// What a search tells of independent segments is what their fit tells, of steep ones too.
#[test]
fn areas_of_candidates_are_those_of_their_fits() {
    let folder = folder();
    succeed(
        &folder,
        &["synth", "ellipsoid", "--axes", "6,2,1", "-o", "long.ply"],
    );
    let words = ["long.ply", "--seams", "none", "--max-segments", "25"];
    let found = json(&folder, &[&["search"], &words[..]].concat());
    let chosen = &found["candidates"][found["chosen"].as_u64().unwrap() as usize];
    let fitted = json(&folder, &[&["fit"], &words[..]].concat());
    for name in ["area_error", "volume_error"] {
        let [one, other] = [&chosen[name], &fitted[name]].map(|error| error.as_f64().unwrap());
        assert!((one - other).abs() < 2e-5, "{name}: {one} {other}");
    }
}
