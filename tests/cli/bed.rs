//! Beds from the command line: a mixture falls, is told, and goes on where it was.

use super::{errors, folder, grain, grainform, json, names, succeed};
use serde_json::Value;
use std::fs;
use std::process::Command;

/// A folder with a scan and a model of it that is convex.
pub(super) fn models() -> tempfile::TempDir {
    let folder = folder();
    let scan = ["synth", "ellipsoid", "--points", "400", "-o", "s.ply"];
    succeed(&folder, &scan);
    let fit = [
        "fit",
        "s.ply",
        "--surface",
        "superquadric",
        "-o",
        "lens.json",
    ];
    succeed(&folder, &fit);
    folder
}

pub(super) const BED: [&str; 13] = [
    "bed",
    "lens.json:1",
    "--grains",
    "30",
    "--box",
    "12,12",
    "--unit",
    "mm",
    "--diameter",
    "3",
    "--seconds",
    "0.3",
    "-o",
];

/// The words of the same bed that ends after so many seconds, in a folder.
pub(super) fn brief<'a>(seconds: &'a str, folder: &'a str) -> Vec<&'a str> {
    let is_time = |word: &&str| *word == "--seconds";
    let at = BED.iter().position(is_time).unwrap();
    [&BED[..=at], &[seconds, "-o", folder]].concat()
}

#[test]
fn a_bed_settles_and_is_told() {
    let folder = models();
    let report = json(&folder, &[&BED[..], &["bed"]].concat());
    let run = &report["runs"][0];
    assert_eq!(report["kinds"][0]["grains"], 30);
    assert!((report["kinds"][0]["diameter_m"].as_f64().unwrap() - 3e-3).abs() < 1e-9);
    assert!(run["fabric"]["neighbours"].as_f64().unwrap() > 2.0);
    let whole = run["packing"]["whole"]["value"].as_f64().unwrap();
    assert!((0.4..0.75).contains(&whole), "{whole}");
    let files = names(&folder.path().join("bed"));
    assert_eq!(files, ["bed.png", "bed.vtk", "frames", "state.json"]);
    let dump = fs::read_to_string(folder.path().join("bed/frames/bed.00000.dump")).unwrap();
    assert!(dump.starts_with("ITEM: TIMESTEP\n0\nITEM: NUMBER OF ATOMS\n30\n"));
    assert_eq!(dump.lines().count(), 39);
    let vtk = fs::read(folder.path().join("bed/bed.vtk")).unwrap();
    assert!(vtk.starts_with(b"# vtk DataFile Version 3.0\n"));

    // Started again it is at its end, and with one thread it is the same bed.
    let again = json(&folder, &[&BED[..], &["bed"]].concat());
    assert_eq!(again, report);
    succeed(&folder, &[&BED[..], &["one", "--threads", "1"]].concat());
    let [state, other] =
        ["bed", "one"].map(|name| fs::read(folder.path().join(name).join("state.json")).unwrap());
    assert!(state == other);
    let refused = grainform(&folder, &[&BED[..], &["bed", "--friction", "0.5"]].concat());
    assert!(
        errors(&refused).contains("state of another bed"),
        "{}",
        errors(&refused)
    );
}

#[test]
fn seeds_tell_errors_and_a_cylinder_and_a_mesh_hold() {
    let folder = models();
    // A plate across the cylinder, on which all grains come to lie.
    let plate = "v -9 -9 5\nv 9 -9 5\nv 9 9 5\nv -9 9 5\nf 1 2 3\nf 1 3 4\n";
    fs::write(folder.path().join("plate.obj"), plate).unwrap();
    let words = [
        "bed",
        "lens.json",
        "--grains",
        "16",
        "--cylinder",
        "12",
        "--walls",
        "plate.obj",
        "--unit",
        "mm",
        "--diameter",
        "3",
        "--seconds",
        "0.2",
        "--seeds",
        "2",
        "-o",
        "bed",
    ];
    let report = json(&folder, &words);
    for figure in ["contacts", "force", "largest_force"] {
        let values = report["runs"].as_array().unwrap().iter().map(|run| {
            let fabric = &run["fabric"];
            let value = match figure {
                "force" => &fabric["forces"]["mean"],
                "largest_force" => &fabric["forces"]["largest"],
                other => &fabric[other],
            };
            value.as_f64().unwrap()
        });
        let values: Vec<f64> = values.collect();
        let told = &report["means"][figure];
        let [mean, error] = ["value", "error"].map(|name| told[name].as_f64().unwrap());
        assert!(
            (mean - 0.5 * (values[0] + values[1])).abs() < 1e-12,
            "{figure}"
        );
        assert!(
            (error - 0.5 * (values[0] - values[1]).abs()).abs() < 1e-12,
            "{figure}"
        );
    }
    let quantiles = report["means"]["force_quantiles"].as_array().unwrap();
    assert!(quantiles.len() == 5 && quantiles[2]["error"].is_f64());
    let text = succeed(&folder, &words);
    assert!(
        text.contains("runs          2")
            && text.contains("cylinder of diameter 12.0000 mm, and the faces of a mesh")
            && text.contains("not told: how much of the container the mesh takes"),
        "{text}"
    );
    // The room below the plate is none for grains.
    for run in report["runs"].as_array().unwrap() {
        let packing = &run["packing"];
        assert!(packing["core"].is_null() && packing["whole"].is_null());
        assert_eq!(packing["layers"], serde_json::json!([]));
    }
    for seed in ["seed_0", "seed_1"] {
        let state = fs::read(folder.path().join("bed").join(seed).join("state.json")).unwrap();
        let state: serde_json::Value = serde_json::from_slice(&state).unwrap();
        for body in state["state"]["bodies"].as_array().unwrap() {
            assert!(body["position"][2].as_f64().unwrap() > 5e-3);
        }
    }
}

#[test]
fn what_makes_no_bed_is_refused() {
    let folder = models();
    let star = ["fit", "s.ply", "--segments", "1", "-o", "star.json"];
    succeed(&folder, &star);
    for (words, reason) in [
        (&["star.json", "--box", "9,9"][..], "take --spheres"),
        (&["lens.json", "--box", "1,1"], "too narrow"),
        (&["lens.json:0", "--box", "9,9"], "share above zero"),
        (&["lens.json", "--box", "9,nan"], "above zero"),
        (&["lens.json", "--cylinder", "-1"], "'-1' for '--cylinder"),
    ] {
        refuse(&folder, words, reason);
    }
    let fair = ["lens.json", "--box", "9,9"];
    for (word, value, reason) in [
        ("--grains", "0", "from 1 to 1000000"),
        ("--diameter", "0", "above zero"),
        ("--diameter", "20", "mm wide"),
        (
            "--density",
            "0",
            "the density must be a finite number above zero",
        ),
        ("--density", "1e300", "too soft for their weight"),
        ("--density", "1e-300", "at most 1000000000 are taken"),
        (
            "--youngs-modulus-mpa",
            "1e200",
            "at most 1000000000 are taken",
        ),
        ("--poissons-ratio", "-1", "above -1 and at most 0.5, not -1"),
        ("--seconds", "1e300", "at most 1000000000 are taken"),
        ("--seconds", "inf", "a finite number above zero, not inf"),
        ("--rest", "nan", "above 0 and at most 0.01, not NaN"),
        ("--rest", "1e9", "above 0 and at most 0.01, not 1"),
        ("--friction", "-1e300", "zero or above, not -1e300"),
        ("--seed", "18446744073709551616", "18446744073709551616"),
        ("--sizes", "no", "cannot read no as CSV"),
        ("--sizes", "lens.json", "cannot read lens.json as CSV"),
    ] {
        refuse(&folder, &[&fair[..], &[word, value]].concat(), reason);
    }
    let last = ["--seed", "18446744073709551615", "--seeds", "2"];
    refuse(
        &folder,
        &[&fair[..], &last].concat(),
        "there are no 2 seeds",
    );
}

/// Makes no bed: it is told why in one sentence, in which nothing is said twice, and no folder is left.
fn refuse(folder: &tempfile::TempDir, words: &[&str], reason: &str) {
    let all = [&["bed"], words, &["--unit", "mm", "-o", "in/bed"]].concat();
    let output = grainform(folder, &all);
    assert_eq!(output.status.code(), Some(2), "{words:?}");
    let message = errors(&output);
    assert!(message.contains(reason), "{message}");
    assert_eq!(message.lines().count(), 1, "{message}");
    let causes: Vec<&str> = message.trim().split(": ").collect();
    assert!(causes.windows(2).all(|two| two[0] != two[1]), "{message}");
    assert!(message.len() < 400, "{message}");
    assert!(!folder.path().join("in").exists(), "{words:?}");
}

#[test]
fn the_last_seed_makes_a_bed() {
    let folder = models();
    let last = ["--seed", "18446744073709551615"];
    let report = json(&folder, &[&brief("0.01", "bed")[..], &last].concat());
    assert_eq!(report["runs"][0]["seed"], u64::MAX);
}

#[test]
fn overlaps_are_told_and_packing_fractions_that_they_spoil_are_not() {
    let folder = models();
    let soft = ["--youngs-modulus-mpa", "0.003"];
    let words = [&brief("0.4", "bed")[..], &soft].concat();
    let text = succeed(&folder, &words);
    assert!(text.contains("not told: grains overlap too much"), "{text}");
    assert!(text.contains("overlap       at most "), "{text}");
    let report = json(&folder, &words);
    let run = &report["runs"][0];
    assert!(run["fabric"]["largest_overlap"].as_f64().unwrap() > 0.1);
    assert!(run["packing"]["whole"].is_null() && report["means"]["whole"].is_null());
    let warnings = report["warnings"].to_string();
    assert!(
        warnings.contains("too much for a packing fraction"),
        "{warnings}"
    );
}

#[test]
fn a_scan_is_a_clump_in_the_sizes_of_a_batch() {
    let folder = folder();
    // Volumes of balls of 2, 3 and 4 mm.
    let table = "path,volume,volume_se\na.ply,4.18879,0.1\nb.ply,14.13717,0.1\nc.ply,33.51032,0.1\nd.ply,much,\n";
    fs::write(folder.path().join("results.csv"), table).unwrap();
    let words =
        "--sizes results.csv --spheres 3 --grains 9 --box 12,12 --unit mm --seconds 0.05 -o bed";
    let bean = grain("bean.ply");
    let words: Vec<&str> = ["bed", &bean].into_iter().chain(words.split(' ')).collect();
    let report = json(&folder, &words);
    let kinds = report["kinds"].as_array().unwrap();
    let mut found: Vec<(f64, u64)> = kinds
        .iter()
        .map(|kind| {
            let diameter = 1e3 * kind["diameter_m"].as_f64().unwrap();
            (
                (1e4 * diameter).round() / 1e4,
                kind["grains"].as_u64().unwrap(),
            )
        })
        .collect();
    found.sort_by(|one, other| one.0.total_cmp(&other.0));
    assert_eq!(found, [(2.0, 3), (3.0, 3), (4.0, 3)]);
    let told = report["warnings"].to_string();
    assert!(told.contains("is a clump of 3 spheres here"), "{told}");
    assert!(
        told.contains("tells no unit: its volumes are taken to be in mm³"),
        "{told}"
    );
    assert!(
        told.contains("results.csv has 1 cell of volume without a number"),
        "{told}"
    );
    assert!(!told.contains("lack"), "{told}");
    // Of two more grains, or of all, the volume is withheld.
    let rows = "path,volume,not_measured\na.ply,4.18879,\nb.ply,14.13717,\nc.ply,33.51032,\n";
    let withheld = "d.ply,,volume: half unseen\ne.ply,,volume: half unseen\n";
    let path = folder.path().join("withheld.csv");
    fs::write(&path, [rows, withheld].concat()).unwrap();
    let mut words_of_rest = words.clone();
    *words_of_rest.last_mut().unwrap() = "rest";
    let sizes = words_of_rest
        .iter_mut()
        .find(|word| **word == "results.csv");
    *sizes.unwrap() = "withheld.csv";
    let told = json(&folder, &words_of_rest)["warnings"].to_string();
    let expected = "of 5 grains 2 lack volume (half unseen): sizes are those of the rest";
    assert!(told.contains(expected), "{told}");
    fs::write(&path, ["path,volume,not_measured\n", withheld].concat()).unwrap();
    let refused = errors(&grainform(&folder, &words_of_rest));
    assert!(
        refused.contains("tells no volumes: of 2 grains all lack volume (half unseen)"),
        "{refused}"
    );
    fs::write(&path, "path,status,volume\na.ply,failed,\nb.ply,failed,\n").unwrap();
    let refused = errors(&grainform(&folder, &words_of_rest));
    assert!(refused.contains("has no grain with a result"), "{refused}");
    // The same grains in micrometres, in another folder.
    let told = "path,unit,volume\na.ply,um,4.18879e9\nb.ply,um,1.413717e10\nc.ply,um,3.351032e10\nd.ply,,\n";
    fs::write(folder.path().join("results_um.csv"), told).unwrap();
    let small: Vec<&str> = words
        .iter()
        .map(|word| match *word {
            "results.csv" => "results_um.csv",
            "bed" => "bed_um",
            word => word,
        })
        .collect();
    let small = [&["bed"], &small[1..]].concat();
    let converted = json(&folder, &small);
    for (kind, other) in kinds.iter().zip(converted["kinds"].as_array().unwrap()) {
        let [one, other] = [kind, other].map(|kind| kind["diameter_m"].as_f64().unwrap());
        assert!((one / other - 1.0).abs() < 1e-6, "{one} {other}");
    }
    let told = converted["warnings"].to_string();
    assert!(
        told.contains("are in um³, and are converted to mm³"),
        "{told}"
    );
    assert!(told.contains("tells no unit of 1 grain"), "{told}");
    let both = "path,unit,volume\na.ply,um,4e9\nb.ply,mm,14\n";
    fs::write(folder.path().join("results_um.csv"), both).unwrap();
    let refused = errors(&grainform(&folder, &small));
    assert!(refused.contains("more than one unit"), "{refused}");
    let text = succeed(&folder, &words);
    assert!(
        text.contains("grains        9 of ") && text.contains("2.00000 to 4.00000 mm"),
        "{text}"
    );
}

/// Twenty beans of four spheres each, told to LAMMPS.
fn with_lammps(bean: &str) -> Vec<&str> {
    let words = "--spheres 4 --grains 20 --box 30,30 --unit mm --engine lammps -o bed";
    ["bed", bean].into_iter().chain(words.split(' ')).collect()
}

#[test]
fn without_lammps_it_is_told_how_to_come_by_it() {
    let folder = folder();
    let bean = grain("bean.ply");
    let output = Command::new(assert_cmd::cargo::cargo_bin!("grainform"))
        .args(with_lammps(&bean))
        .current_dir(folder.path())
        .env("PATH", folder.path())
        .output()
        .unwrap();
    assert_eq!(output.status.code(), Some(2));
    assert!(
        errors(&output).contains("apt-get install lammps"),
        "{}",
        errors(&output)
    );
}

#[test]
#[ignore = "needs LAMMPS (lmp) in the path"]
fn lammps_settles_the_same_bed_and_it_is_told_alike() {
    let folder = folder();
    let bean = grain("bean.ply");
    let words = with_lammps(&bean);
    let printed = succeed(&folder, &[&words[..], &["--dry-run"]].concat());
    assert!(printed.contains("20 grains of 80 spheres"), "{printed}");
    let report = json(&folder, &words);
    let run = &report["runs"][0];
    assert_eq!(run["is_at_rest"], true);
    assert_eq!(run["fabric"]["loose"], 0);
    // The same bed, settled here.
    let at = words.iter().position(|word| *word == "--engine").unwrap();
    let own = [&words[..at], &["-o", "own"]].concat();
    let own = &json(&folder, &own)["runs"][0];
    for (figure, most) in [("neighbours", 0.8), ("contacts", 1.5)] {
        let [found, expected] = [run, own].map(|run| run["fabric"][figure].as_f64().unwrap());
        assert!(
            (found - expected).abs() < most,
            "{figure}: {found} {expected}"
        );
    }
    let files = names(&folder.path().join("bed"));
    // And in a cylinder, with rolling friction.
    let inside = words.iter().position(|word| *word == "--box").unwrap();
    let round = [
        &words[..inside],
        &["--cylinder", "44", "--rolling-friction", "0.1"],
        &words[inside + 2..words.len() - 1],
        &["round"],
    ];
    let report = json(&folder, &round.concat());
    assert_eq!(report["runs"][0]["is_at_rest"], true);
    assert_eq!(report["runs"][0]["fabric"]["loose"], 0);
    for name in [
        "bed.png",
        "bed.vtk",
        "contacts.dump",
        "grains.dump",
        "frames",
    ] {
        assert!(files.iter().any(|file| file == name), "{files:?}");
    }
}

/// Words of a command, parted by blanks.
fn words(text: &str) -> Vec<&str> {
    text.split(' ').collect()
}

/// Puts a convex model in this unit into a folder.
fn convex(folder: &tempfile::TempDir, unit: &str) {
    succeed(
        folder,
        &words("synth ellipsoid --axes 3,2,1.5 --points 800 -o e.ply"),
    );
    let fit = format!("fit e.ply --surface superquadric --unit {unit} -o {unit}.json");
    succeed(folder, &words(&fit));
}

#[test]
fn the_unit_is_that_which_the_models_tell() {
    let folder = folder();
    convex(&folder, "mm");
    convex(&folder, "um");
    let bed = |models: &str| {
        let bed = format!("bed {models} --grains 3 --box 20,20 --seconds 0.001 -o bed --json");
        grainform(&folder, &words(&bed))
    };
    let report: Value = serde_json::from_slice(&bed("um.json").stdout).unwrap();
    assert_eq!(report["unit"], "um");
    let told = errors(&bed("um.json mm.json"));
    assert!(
        told.contains("um.json has its lengths in um, and mm.json in mm: convert one"),
        "{told}"
    );
}

#[test]
fn what_another_bed_left_in_the_folder_is_told() {
    let folder = folder();
    std::fs::create_dir(folder.path().join("bed")).unwrap();
    std::fs::write(folder.path().join("bed/settled.dump"), "").unwrap();
    convex(&folder, "mm");
    let bed = "bed mm.json --grains 3 --box 20,20 --seconds 0.001 -o bed";
    let told = errors(&grainform(&folder, &words(bed)));
    assert!(
        told.contains("bed also holds what this run did not write: settled.dump."),
        "{told}"
    );
}
