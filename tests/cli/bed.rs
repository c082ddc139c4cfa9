//! Beds from the command line: a mixture falls, is told, and goes on where it was.

use super::{errors, folder, grain, grainform, json, names, succeed};
use std::fs;
use std::process::Command;

/// A folder with a scan and a model of it that is convex.
fn models() -> tempfile::TempDir {
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

const BED: [&str; 13] = [
    "bed",
    "lens.json:1",
    "--grains",
    "16",
    "--box",
    "9,9",
    "--unit",
    "mm",
    "--diameter",
    "3",
    "--seconds",
    "0.2",
    "-o",
];

#[test]
fn a_bed_settles_and_is_told() {
    let folder = models();
    let report = json(&folder, &[&BED[..], &["bed"]].concat());
    let run = &report["runs"][0];
    assert_eq!(report["kinds"][0]["grains"], 16);
    assert!((report["kinds"][0]["diameter_m"].as_f64().unwrap() - 3e-3).abs() < 1e-9);
    assert!(run["fabric"]["neighbours"].as_f64().unwrap() > 2.0);
    let whole = run["packing"]["whole"]["value"].as_f64().unwrap();
    assert!((0.4..0.75).contains(&whole), "{whole}");
    let files = names(&folder.path().join("bed"));
    assert_eq!(files, ["bed.png", "bed.vtk", "frames", "state.json"]);
    let dump = fs::read_to_string(folder.path().join("bed/frames/bed.00000.dump")).unwrap();
    assert!(dump.starts_with("ITEM: TIMESTEP\n0\nITEM: NUMBER OF ATOMS\n16\n"));
    assert_eq!(dump.lines().count(), 25);
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
        "4",
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
    let text = succeed(&folder, &words);
    assert!(
        text.contains("runs          2") && text.contains("cylinder of diameter 12"),
        "{text}"
    );
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
        (
            &["lens.json", "--box", "9,9", "--grains", "0"],
            "from 1 to 1000000",
        ),
        (&["lens.json", "--box", "9,9", "--density", "0"], "density"),
        (&["lens.json", "--box", "9,nan"], "above zero"),
    ] {
        let all = [&["bed"], words, &["--unit", "mm", "-o", "bed"]].concat();
        let output = grainform(&folder, &all);
        assert_eq!(output.status.code(), Some(2));
        assert!(errors(&output).contains(reason), "{}", errors(&output));
    }
}

#[test]
fn a_scan_is_a_clump_in_the_sizes_of_a_batch() {
    let folder = folder();
    // Volumes of balls of 2, 3 and 4 mm.
    let table =
        "path,volume,volume_se\na.ply,4.18879,0.1\nb.ply,14.13717,0.1\nc.ply,33.51032,0.1\n";
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
