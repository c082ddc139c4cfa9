//! The reference of `--json` is complete: each key that is printed is in its section of docs/json.md, and none but these.
//! A script stands for LAMMPS, hence Unix alone.

#![cfg(unix)]

use super::{folder, run};
use serde_json::Value;
use std::collections::BTreeSet;
use std::fs;
use std::os::unix::fs::PermissionsExt;

const JSON: &str = include_str!("../../docs/json.md");
const MEASURES: &str = include_str!("../../docs/measures.md");

/// The sections, and what prints the keys in them. Lines are run in this order, with `--json`, and take files of those before.
const LINES: &[(&str, &[&str])] = &[
    (
        "synth",
        &[
            "synth bean --points 200 --missing-cap 60 -o cap.ply",
            "synth sphere --points 26 -o ball.ply",
            "synth sphere --points 400 --noise 1% -o noisy.ply",
            "synth ellipsoid --points 200 -o ellipsoid.ply",
            "synth superquadric --axes 1.5,1,1 --exponents 2,2 --points 200 -o rod.ply",
        ],
    ),
    ("synth of curled bodies", &["synth hook"]),
    (
        "synth tray",
        &["synth tray --grains 6 --points 3000 -o tray.ply"],
    ),
    (
        "fit",
        &[
            "fit grains/bean.ply --unit mm --tolerance 0.03% --harmonics bean.csv -o bean.json",
            "fit ellipsoid.ply --symmetry z --degree 2 -o mirrored.json",
            "fit ellipsoid.ply --surface position",
            "fit noisy.ply -o noisy.json",
            "fit cap.ply",
        ],
    ),
    (
        "fit --surface superquadric",
        &[
            "fit rod.ply --surface superquadric --unit mm -o rod.json",
            "fit rod.ply --surface multi:2",
            "fit cap.ply --surface superquadric",
        ],
    ),
    (
        "search",
        &["search ellipsoid.ply --seams none --max-segments 4 --unit mm --csv search.csv"],
    ),
    (
        "measure",
        &[
            "measure bean.json --unit mm",
            "measure rod.json --only area,volume",
            "measure open.obj --only volume,spectrum",
        ],
    ),
    (
        "contact",
        &[
            "contact mirrored.json mirrored.json --towards 1,0,0 --other-towards -1,0,0 --edge-radius 0.1 --unit mm \
             --indentation-um 1 --youngs-modulus-mpa 9",
        ],
    ),
    (
        "contact --pose-b",
        &[
            "contact noisy.json noisy.json --pose-b 0,0,9.9,1,0,0,0 --unit mm",
            "contact noisy.json noisy.json --pose-b 0,0,10.03,1,0,0,0",
        ],
    ),
    (
        "contact --pose-b of unions",
        &["contact rod.json rod.json --pose-b 0,0,1.9,1,0,0,0 --unit mm"],
    ),
    ("clump", &["clump bean.json --spheres 2 --unit mm"]),
    (
        "split",
        &[
            "split tray.ply --unit mm -o cloud",
            "split labels.nrrd -o labels",
        ],
    ),
    ("compare", &["compare results results"]),
    (
        "bed",
        &[
            "bed rod.json --grains 200 --cylinder 14 --unit mm --seconds 0.05 -o bed",
            "bed rod.json --grains 2 --box 9,9 --unit mm --seconds 0.001 -o box",
        ],
    ),
    (
        "bed --dry-run",
        &[
            "bed rod.json --grains 4 --box 9,9 --unit mm --engine lammps --spheres 2 --dry-run -o deck",
        ],
    ),
    ("bench", &["bench ball.ply --unit mm"]),
];

/// A folder with what no line makes: the grains, a mesh with a hole, a ball of voxels, results of two scans, and a LAMMPS that reads
/// the files of a bed.
fn furnished() -> tempfile::TempDir {
    let folder = folder();
    let path = |name: &str| folder.path().join(name);
    let write = |name: &str, content: &[u8]| fs::write(path(name), content).expect("a file");

    run("synth hook -o open.obj", folder.path());
    let mesh = fs::read_to_string(path("open.obj")).expect("a mesh");
    let (open, _) = mesh.trim_end().rsplit_once('\n').expect("a last face");
    write("open.obj", open.as_bytes());

    let head = "NRRD0004\ntype: uint8\ndimension: 3\nsizes: 12 12 12\nencoding: raw\n\n";
    let square = |x: usize| (2 * x).abs_diff(11).pow(2);
    let is_inside = |at: usize| square(at % 12) + square(at / 12 % 12) + square(at / 144) < 80;
    let voxels = (0..12 * 12 * 12).map(|at| u8::from(is_inside(at)));
    write(
        "labels.nrrd",
        &head.bytes().chain(voxels).collect::<Vec<u8>>(),
    );

    for seed in ["0", "1"] {
        let noisy = format!("synth sphere --points 100 --noise 1% --seed {seed} -o {seed}.ply");
        run(&noisy, folder.path());
    }
    run("batch 0.ply 1.ply --only volume -o results", folder.path());

    let script = "#!/bin/sh\necho GRANULAR RIGID\necho '  4 rigid bodies with 8 atoms'\n";
    write("lmp", script.as_bytes());
    fs::set_permissions(path("lmp"), fs::Permissions::from_mode(0o755)).expect("a script");
    folder
}

/// The paths of all keys in a value, those in lists below `[]`.
fn collect(value: &Value, path: &str, found: &mut BTreeSet<String>) {
    match value {
        Value::Object(fields) => {
            for (key, value) in fields {
                let path = match path {
                    "" => key.clone(),
                    _ => format!("{path}.{key}"),
                };
                collect(value, &path, found);
                found.insert(path);
            }
        }
        Value::Array(items) => {
            let path = format!("{path}[]");
            items.iter().for_each(|item| collect(item, &path, found));
        }
        _ => {}
    }
}

/// The keys in the first cells of the tables of a text; `.c` after `a.b` is `a.c`.
fn documented(text: &str) -> BTreeSet<String> {
    let mut keys = BTreeSet::new();
    for row in text.lines().filter(|line| line.starts_with("| `")) {
        let cell = row.split(" | ").next().unwrap_or(row);
        let mut parent = "";
        for key in cell.split('`').skip(1).step_by(2) {
            match key.strip_prefix('.') {
                Some(sibling) if sibling.ends_with('.') => {}
                Some(sibling) => _ = keys.insert(format!("{parent}.{sibling}")),
                None => {
                    parent = key.rsplit_once('.').map_or("", |(parent, _)| parent);
                    keys.insert(key.into());
                }
            }
        }
    }
    keys
}

/// The keys of a section of docs/json.md; of `measure` those of docs/measures.md too.
fn keys_of(section: &str) -> BTreeSet<String> {
    let start = format!("\n## {section}\n");
    let (_, rest) = JSON.split_once(&start).expect(section);
    let mut keys = documented(rest.split("\n## ").next().unwrap_or(rest));
    if section == "measure" {
        let measures = documented(MEASURES).into_iter();
        keys.extend(measures.map(|key| key.replace("projections.", "projections[].")));
    }
    keys
}

/// Whether a key that is printed is documented: it, keys in it, or, of a standard error of a measure, that of the measure.
fn is_told(printed: &str, keys: &BTreeSet<String>) -> bool {
    let is_in_it = |key: &String| {
        key.strip_prefix(printed)
            .is_some_and(|rest| rest.is_empty() || rest.starts_with(['.', '[']))
    };
    keys.iter().any(is_in_it) || keys.contains(&printed.replace(".standard_errors", ""))
}

#[test]
fn each_command_that_prints_json_has_a_section() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let help = run("--help", folder.path());
    let (_, commands) = help.split_once("\nCommands:\n").expect("a list");
    let names = commands.lines().take_while(|line| !line.is_empty());
    let names = names.filter_map(|line| line.strip_prefix("  ")?.split(' ').next());
    for name in names.filter(|name| !name.is_empty()) {
        let options = run(&format!("help {name}"), folder.path());
        let mut options = options.lines().map(str::trim);
        let prints = options.any(|line| line == "--json" || line.starts_with("--json  "));
        let has_section = LINES
            .iter()
            .any(|(section, _)| section.split(' ').next() == Some(name));
        assert_eq!(prints, has_section, "{name}");
    }
    assert_eq!(JSON.matches("\n## ").count(), LINES.len());
}

#[test]
fn what_is_printed_as_json_is_documented_and_no_more() {
    let folder = furnished();
    let mut faults = Vec::new();
    for (section, lines) in LINES {
        let mut printed = BTreeSet::new();
        for line in *lines {
            let text = run(&format!("{line} --json"), folder.path());
            let value = serde_json::from_str(&text).expect("one object");
            collect(&value, "", &mut printed);
        }
        let keys = keys_of(section);
        let missing = printed.iter().filter(|key| !is_told(key, &keys));
        faults.extend(missing.map(|key| format!("{section}: {key} is not documented")));
        let dead = keys.difference(&printed);
        faults.extend(dead.map(|key| format!("{section}: {key} is not printed")));
    }
    assert!(faults.is_empty(), "{}", faults.join("\n"));

    let csv = fs::read_to_string(folder.path().join("search.csv")).expect("a table");
    let columns = csv.lines().next().expect("names");
    assert!(JSON.contains(&format!("`{columns}`")), "{columns}");
}
