//! Two lots beside each other.

use super::{errors, folder, grainform, json, succeed};

#[test]
fn a_table_of_something_else_is_not_compared() {
    let folder = folder();
    std::fs::write(folder.path().join("t.csv"), "OFF\n1\n2\n3\n").unwrap();
    let output = grainform(&folder, &["compare", "t.csv", "t.csv"]);
    assert_eq!(output.status.code(), Some(2));
    assert!(
        errors(&output).contains("no table of grains"),
        "{}",
        errors(&output)
    );
}

#[test]
fn lots_in_different_units_are_not_compared() {
    let folder = folder();
    let lot = |name: &str, unit: &str| {
        let rows = format!("a.ply,done,{unit},1.5\nb.ply,done,{unit},1.7\n");
        let table = format!("path,status,unit,volume\n{rows}");
        std::fs::write(folder.path().join(name), table).unwrap();
    };
    lot("mm.csv", "mm");
    lot("um.csv", "um");
    lot("none.csv", "");
    let compared = |other: &str| grainform(&folder, &["compare", "mm.csv", other]);
    for other in ["mm.csv", "none.csv"] {
        assert!(compared(other).status.success(), "{other}");
    }
    let told = errors(&compared("none.csv"));
    assert!(told.contains("none.csv tells no unit"), "{told}");
    assert_eq!(errors(&compared("mm.csv")), "");
    let report = json(&folder, &["compare", "mm.csv", "none.csv"]);
    assert!(report["warnings"][0].as_str().unwrap().contains("no unit"));
    let refused = compared("um.csv");
    assert_eq!(refused.status.code(), Some(2));
    let message = errors(&refused);
    assert!(message.contains("lots in mm and um"), "{message}");
}

#[test]
fn grains_without_a_unit_among_others_are_told() {
    let folder = folder();
    let table = "path,status,unit,volume\na.ply,ok,mm,1.5\nb.ply,ok,,1.7\nc.ply,failed,,\n";
    std::fs::write(folder.path().join("t.csv"), table).unwrap();
    let report = json(&folder, &["compare", "t.csv", "t.csv"]);
    let told = "t.csv tells no unit of 1 grain: lengths are taken to be in mm there too.";
    let [first, other] = ["first", "other"]
        .map(|which| format!("1 row of the {which} lot failed, and is not among its grains."));
    let expected = serde_json::json!([told, told, first, other]);
    assert_eq!(report["warnings"], expected);
}

#[test]
fn grains_unlike_the_rest_of_their_lot_are_named() {
    let folder = folder();
    let lot = |name: &str, last: &str| {
        let volumes = ["1.5", "1.7", "1.6", "1.4", "1.5", "1.8", "1.6", "1.3", last];
        let rows = volumes.iter().enumerate();
        let rows = rows.map(|(at, volume)| format!("{at}.ply,ok,mm,{volume},2,.6\n"));
        let table = format!(
            "path,status,unit,volume,area,area_se\n{}",
            rows.collect::<String>()
        );
        std::fs::write(
            folder.path().join(name),
            table.replace("7.ply,ok,mm,1.3,2,", "7.ply,ok,mm,1.3,2.5,"),
        )
        .unwrap();
    };
    lot("sound.csv", "1.5");
    lot("edited.csv", "-40");
    let report = json(&folder, &["compare", "sound.csv", "edited.csv"]);
    assert_eq!(report["outliers"][0], serde_json::json!([]));
    let outliers = report["outliers"][1].as_array().unwrap();
    // An area that is off by less than its standard error is none.
    assert_eq!(outliers.len(), 1);
    assert_eq!(
        (
            outliers[0]["path"].as_str(),
            outliers[0]["measure"].as_str()
        ),
        (Some("8.ply"), Some("volume"))
    );
    let told = succeed(&folder, &["compare", "edited.csv", "sound.csv"]);
    assert!(
        told.contains("worth a look in the first lot: 8.ply, its volume is"),
        "{told}"
    );
}

#[test]
fn cells_that_hold_no_number_are_told_and_left_out() {
    let folder = folder();
    let lot = |name: &str, cells: [&str; 4]| {
        let rows = cells.map(|cell| format!("{cell}.ply,ok,{cell},bean\n"));
        let table = format!("path,status,volume,variety\n{}", rows.concat());
        std::fs::write(folder.path().join(name), table).unwrap();
    };
    lot("a.csv", ["1.5", "1;7", "1.9", "2.0"]);
    lot("b.csv", ["1.5", " 1.7", "", "NaN"]);
    let report = json(&folder, &["compare", "a.csv", "b.csv"]);
    let lacking = "Of 4 grains of the other lot 2 lack volume: means are of the rest, which may be unlike these.";
    let told = "Cells of the first lot that hold no number are left out: 1 of volume.";
    assert_eq!(report["warnings"], serde_json::json!([lacking, told]));
    assert_eq!(report["measures"][0]["counts"], serde_json::json!([3, 2]));
}

#[test]
fn a_column_without_any_number_is_told_where_it_should_have_some() {
    let folder = folder();
    let lot = |name: &str, volumes: [&str; 2]| {
        let rows = volumes.map(|volume| format!("\"{volume}.ply\",ok,2.5,\"{volume}\"\n"));
        let table = format!("path,status,area,volume\n{}", rows.concat());
        std::fs::write(folder.path().join(name), table).unwrap();
    };
    lot("a.csv", ["inf", "42,740.8"]);
    lot("b.csv", ["42", "43"]);
    let told = |first, other| errors(&grainform(&folder, &["compare", first, other]));
    let warning = "lot that hold no number are left out: 2 of volume.";
    for (found, which) in [
        (told("a.csv", "b.csv"), "first"),
        (told("b.csv", "a.csv"), "other"),
    ] {
        assert_eq!(found, format!("warning: Cells of the {which} {warning}\n"));
    }
}

#[test]
fn measures_of_one_lot_alone_are_told() {
    let folder = folder();
    let lot = |name: &str, columns: &str| {
        let rows = ["a", "b"].map(|grain| {
            let values = columns.split(',').map(|_| ",1.5").collect::<String>();
            format!("{grain}{name}.ply,ok{values}\n")
        });
        let table = format!("path,status,{columns}\n{}", rows.concat());
        std::fs::write(folder.path().join(name), table).unwrap();
    };
    lot(
        "a.csv",
        "area,volume,form.elongation,sphericity.wadell,sphericity.maximum_projection",
    );
    lot("b.csv", "volume,volume_se,form.elongation,form.flatness");
    let told = errors(&grainform(&folder, &["compare", "a.csv", "b.csv"]));
    assert_eq!(
        told,
        "warning: Only the first lot has figures of area and sphericity: they are not compared.\n\
         warning: Only the other lot has figures of form.flatness: they are not compared.\n"
    );
    assert_eq!(
        errors(&grainform(&folder, &["compare", "a.csv", "a.csv"])),
        ""
    );
}

/// Writes a lot of five grains whose convexities scatter by nothing but rounding.
fn convex(folder: &tempfile::TempDir, name: &str, mean: f64) {
    let rows = (0..5).map(|grain| {
        let convexity = mean + 1e-9 * f64::from(grain);
        format!("{name}{grain}.ply,ok,{convexity}\n")
    });
    let head = "path,status,convexity.area\n";
    let table = format!("{head}{}", rows.collect::<String>());
    std::fs::write(folder.path().join(name), table).unwrap();
}

#[test]
fn a_difference_below_how_well_it_is_computed_is_no_effect() {
    let folder = folder();
    convex(&folder, "a.csv", 0.9999);
    convex(&folder, "b.csv", 0.9998);
    let words = ["compare", "a.csv", "b.csv"];
    let measure = json(&folder, &words)["measures"][0].clone();
    assert!(measure["effect"].is_null() && measure["effect_interval"].is_null());
    let end = |at: usize| measure["difference_interval"][at].as_f64().unwrap();
    assert!(end(0) < -2.3e-4 && end(1) > 4e-5, "{measure}");
    let text = succeed(&folder, &words);
    let row = text.lines().find(|line| line.contains("convexity.area"));
    assert!(row.unwrap().contains("below error"), "{text}");
    convex(&folder, "b.csv", 0.999);
    let measure = json(&folder, &words)["measures"][0].clone();
    assert!(measure["effect"].as_f64() < Some(-1e3), "{measure}");
}

#[test]
fn lots_that_were_fitted_otherwise_or_share_grains_are_told_to_be() {
    let folder = folder();
    let lot = |name: &str, settings: &str, hashes: [&str; 3]| {
        let rows = hashes.map(|hash| {
            let volume = 1.0 + 0.1 * hash.len() as f64;
            format!("{hash}.ply,ok,{hash},0.1.0,{settings} only=volume,{volume}\n")
        });
        // A scan without a result counts for nothing.
        let failed = "bad.ply,failed,bad,0.1.0,tolerance=Auto segments=7 only=volume,\n";
        let table = format!(
            "path,status,hash,version,settings,volume\n{}{failed}",
            rows.concat()
        );
        std::fs::write(folder.path().join(name), table).unwrap();
    };
    lot("a.csv", "tolerance=Auto segments=1", ["a", "bb", "ccc"]);
    lot("b.csv", "tolerance=Auto segments=6", ["ccc", "dddd", "a"]);
    lot("c.csv", "tolerance=Auto segments=1", ["dd", "eee", "ffff"]);
    let output = grainform(&folder, &["compare", "a.csv", "b.csv"]);
    let told = errors(&output);
    let lines: Vec<&str> = told.lines().collect();
    assert!(
        lines[0].contains("(segments 1, in the other lot 6)"),
        "{told}"
    );
    assert!(
        lines[1].starts_with("warning: The lots share 2 grains,"),
        "{told}"
    );
    let report = json(&folder, &["compare", "a.csv", "b.csv"]);
    // The others tell of the rows that failed.
    assert_eq!(report["warnings"].as_array().unwrap().len(), 4);
    assert_eq!(report["measures"][0]["measure"], "volume");
    let told = errors(&grainform(&folder, &["compare", "a.csv", "c.csv"]));
    assert!(
        told.lines().all(|line| line.contains("lot failed")),
        "{told}"
    );
}

#[test]
fn of_a_folder_the_table_that_is_edited_is_compared() {
    let folder = folder();
    let words = ["synth", "bean", "--points", "300", "-o", "a.ply"];
    succeed(&folder, &words);
    let only = ["--only", "volume", "--quiet"];
    succeed(
        &folder,
        &[&["batch", "a.ply", "-o", "r"], &only[..]].concat(),
    );
    let path = folder.path().join("r/results.csv");
    let table = std::fs::read_to_string(&path).unwrap();
    let row = table.lines().nth(1).unwrap();
    std::fs::write(&path, format!("{table}{}\n", row.replace("a.ply", "b.ply"))).unwrap();
    let report = json(&folder, &["compare", "r", "r"]);
    assert_eq!(report["measures"][0]["counts"][0], 2, "{report}");
}

#[test]
fn numbers_with_decimal_commas_and_columns_that_others_part_are_refused() {
    let folder = folder();
    let compared = |table: &str| {
        std::fs::write(folder.path().join("t.csv"), table).unwrap();
        let output = grainform(&folder, &["compare", "t.csv", "t.csv"]);
        assert_eq!(output.status.code(), Some(2), "{table}");
        errors(&output)
    };
    let told = compared("path,status,volume\na.ply,ok,\"21,5\"\nb.ply,ok,\"3,25\"\n");
    assert!(
        told.contains("column volume of t.csv have commas") && told.contains("21,5"),
        "{told}"
    );
    let words = "path,status,volume,plot\na.ply,ok,21.5,\"3,4\"\nb.ply,ok,20.5,\"3,5\"\n";
    std::fs::write(folder.path().join("t.csv"), words).unwrap();
    let report = json(&folder, &["compare", "t.csv", "t.csv"]);
    assert_eq!(report["measures"].as_array().unwrap().len(), 1);
    let told = compared("path;status;volume\na.ply;ok;21,5\n");
    assert!(told.contains("semicolons part its columns"), "{told}");
}
