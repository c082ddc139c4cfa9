use super::{errors, folder, grain, grainform, json, names, number, succeed};
use serde_json::Value;
use std::f64::consts::PI;
use std::path::Path;
use std::process::Command;
use tempfile::TempDir;

/// Writes the input of an engine into the folder `dem`.
fn export(folder: &TempDir, engine: &str, more: &[&str]) -> String {
    let bean = grain("bean.ply");
    let words = [
        "export-dem",
        &bean,
        "--engine",
        engine,
        "-o",
        "dem",
        "--unit",
        "mm",
    ];
    succeed(folder, &[&words[..], more].concat())
}

fn read(folder: &Path, name: &str) -> String {
    std::fs::read_to_string(folder.join(name)).unwrap_or_else(|error| panic!("{name}: {error}"))
}

/// These measures of what is fitted to the points of the bean.
fn of_fit(folder: &TempDir, only: &str) -> Value {
    succeed(folder, &["fit", &grain("bean.ply"), "-o", "bean.json"]);
    json(folder, &["measure", "bean.json", "--only", only])
}

#[test]
fn a_folder_holds_mass_and_inertia_of_the_grain() {
    let folder = folder();
    let told = export(&folder, "lammps", &["--spheres", "5", "--grains", "8"]);
    assert!(
        told.contains("5 spheres") && told.contains("wrote dem: 4 files"),
        "{told}"
    );
    let dem = folder.path().join("dem");
    assert_eq!(
        names(&dem),
        ["README", "bodies.in", "data.clumps", "in.settle"]
    );
    assert_eq!(read(&dem, "README").lines().count(), 3);
    let measured = of_fit(&folder, "volume,principal");
    let bodies = read(&dem, "bodies.in");
    let first: Vec<f64> = bodies
        .lines()
        .nth(1)
        .unwrap()
        .split(' ')
        .map(|x| x.parse().unwrap())
        .collect();
    let mass = number(&measured, "volume") * 1e-9 * 2500.0;
    assert!((first[1] / mass - 1.0).abs() < 1e-6);
    // The trace is the same in all axes.
    let trace: f64 = first[5..8].iter().sum();
    let moments = measured["principal"]["moments"].as_array().unwrap();
    let expected: f64 = moments.iter().map(|moment| moment.as_f64().unwrap()).sum();
    assert!((trace / (expected * 1e-15 * 2500.0) - 1.0).abs() < 1e-6);
    let atoms = read(&dem, "data.clumps");
    assert!(atoms.contains("40 atoms"));
    // The same words give the same bytes.
    export(&folder, "lammps", &["--spheres", "5", "--grains", "8"]);
    assert!(read(&dem, "bodies.in") == bodies && read(&dem, "data.clumps") == atoms);
}

#[test]
fn shapes_for_nist_are_centred_and_their_loss_is_told() {
    let folder = folder();
    let told = export(&folder, "anm", &[]);
    assert!(told.contains("degree 20, RMS"), "{told}");
    let anm = read(&folder.path().join("dem"), "bean.anm");
    let lines: Vec<Vec<f64>> = anm
        .lines()
        .map(|line| {
            line.split_whitespace()
                .map(|x| x.parse().unwrap())
                .collect()
        })
        .collect();
    assert_eq!(lines.len(), 21 * 21);
    // a_00 is the mean radius times sqrt(4 pi), in metres.
    let measured = of_fit(&folder, "spheres,spectrum");
    let power = measured["spectrum"]["power"][0].as_f64().unwrap();
    assert_eq!(lines[0][..2], [0.0, 0.0]);
    assert!((lines[0][2] / (power.sqrt() * 1e-3) - 1.0).abs() < 1e-9);
    let mirrored = |line: &&Vec<f64>| line[0] == 3.0 && line[1].abs() == 3.0;
    let [plus, minus] = lines.iter().filter(mirrored).collect::<Vec<_>>()[..] else {
        panic!()
    };
    assert_eq!((plus[2], plus[3]), (-minus[2], minus[3]));
}

/// Writes the input of an engine for a superquadric of semi-axes 3, 2 and 1.5 cm into the folder `dem`.
fn export_superquadric(folder: &TempDir, exponents: &str, engine: &str) -> String {
    let body = ["--axes", "3,2,1.5", "--exponents", exponents];
    let synth = [&["synth", "superquadric", "-o", "c.ply"], &body[..]].concat();
    succeed(folder, &synth);
    let fit = ["fit", "c.ply", "--surface", "superquadric", "-o", "c.json"];
    succeed(folder, &fit);
    let words = ["--engine", engine, "--unit", "cm", "--spheres", "8"];
    let export = [&["export-dem", "c.json", "-o", "dem"], &words[..]].concat();
    succeed(folder, &export)
}

#[test]
fn superquadrics_are_written_as_such_where_liggghts_knows_them() {
    let folder = folder();
    export_superquadric(&folder, "8,2", "liggghts");
    let script = read(&folder.path().join("dem"), "in.superquadrics");
    let (_, shape) = script.split_once("shape constant ").expect("a shape");
    let shape = shape.split(' ').take(3).map(|x| x.parse().unwrap());
    let mut shape: Vec<f64> = shape.collect();
    shape.sort_by(f64::total_cmp);
    for (found, expected) in shape.iter().zip([0.015, 0.02, 0.03]) {
        assert!((found / expected - 1.0).abs() < 1e-6, "{shape:?}");
    }
}

#[test]
fn superquadrics_are_superellipsoids_of_lammps_and_what_that_loses_is_told() {
    let folder = folder();
    let told = export_superquadric(&folder, "1.5,4", "lammps");
    let dem = folder.path().join("dem");
    assert!(names(&dem).contains(&"in.superellipsoids".into()));
    let remark = "Exponents of c below 2 are raised to 2 for superellipsoids: 24.05 % more volume";
    let readme = read(&dem, "README");
    assert!(told.contains(remark) && readme.contains(remark), "{told}");
    assert!(readme.contains("not run here") && readme.lines().count() == 3);
}

/// A run of micrometre grains is over in less time than lies between two frames of larger ones.
#[test]
fn runs_of_small_grains_have_frames_and_looks() {
    let folder = folder();
    export_superquadric(&folder, "3,2", "lammps");
    let export = ["export-dem", "c.json", "--engine", "lammps", "-o", "um"];
    let more = ["--unit", "um", "--spheres", "8", "--grains", "3"];
    succeed(&folder, &[&export[..], &more].concat());
    let scripts = [
        ("in.superellipsoids", "dump frames grains custom "),
        ("in.settle", "dump frames all custom "),
    ];
    for (script, frames) in scripts {
        let script = read(&folder.path().join("um"), script);
        let first = |text: &str| -> Option<f64> { text.split_whitespace().next()?.parse().ok() };
        let runs = script.split("\nrun ").skip(1).filter_map(first);
        let steps = runs.fold(0.0, f64::max);
        let every = script.split(frames).nth(1).and_then(first);
        assert!(every.is_some_and(|every| every <= steps / 9.0), "{script}");
    }
}

#[test]
fn what_no_engine_can_run_is_refused_in_a_sentence() {
    let folder = folder();
    let bean = grain("bean.ply");
    for (more, sentence) in [
        (
            &["--engine", "abacus"][..],
            "expected lammps, yade, liggghts, mercurydpm or anm",
        ),
        (
            &["--engine", "yade", "--grains", "0"],
            "there are no grains",
        ),
        (
            &["--engine", "yade", "--density", "0"],
            "the density must be a finite number above zero, not 0 kg/m³",
        ),
        (
            &["--engine", "yade", "--poissons-ratio", "0.7"],
            "Poisson's ratio must be from 0 to below 0.5, not 0.7",
        ),
        (
            &["--engine", "yade", "--density", "1e300"],
            "too soft for their weight",
        ),
    ] {
        let words = ["export-dem", &bean, "--unit", "mm", "-o", "dem"];
        let output = grainform(&folder, &[&words[..], more].concat());
        assert_eq!(output.status.code(), Some(2));
        let message = errors(&output);
        assert!(message.contains(sentence), "{message}");
    }
}

#[test]
fn a_folder_tells_what_is_not_to_be_relied_on() {
    let folder = folder();
    let synth = "synth sphere --missing-cap 50 -o hole.ply";
    succeed(&folder, &synth.split(' ').collect::<Vec<_>>());
    for engine in ["yade", "anm"] {
        let words = format!("export-dem hole.ply --engine {engine} --unit mm -o {engine}");
        succeed(&folder, &words.split(' ').collect::<Vec<_>>());
        let readme = read(&folder.path().join(engine), "README");
        assert!(readme.contains("hole: No point lies within"), "{readme}");
    }
}

#[test]
fn files_of_an_earlier_run_are_told() {
    let folder = folder();
    let bean = grain("bean.ply");
    let words = [
        "export-dem",
        &bean,
        "--unit",
        "mm",
        "-o",
        "dem",
        "--spheres",
        "2",
    ];
    let first = grainform(&folder, &[&words[..], &["--engine", "yade"]].concat());
    assert!(!errors(&first).contains("also holds"), "{}", errors(&first));
    std::fs::write(folder.path().join("dem/data.old"), "").unwrap();
    let second = grainform(&folder, &[&words[..], &["--engine", "yade"]].concat());
    assert!(second.status.success());
    let told = "warning: dem also holds what this run did not write: data.old.";
    assert!(errors(&second).contains(told), "{}", errors(&second));
}

/// Runs an engine in the folder `dem`; gives what it prints.
fn printed(folder: &TempDir, program: &str, words: &[&str]) -> String {
    let output = Command::new(program)
        .args(words)
        .current_dir(folder.path().join("dem"))
        .env("OMP_NUM_THREADS", "1")
        .output()
        .expect("the engine is in the path");
    let printed = String::from_utf8_lossy(&output.stdout).into_owned();
    assert!(output.status.success(), "{printed} {}", errors(&output));
    printed
}

/// Runs an engine in the folder `dem`; gives what it prints after `at rest:`.
fn run(folder: &TempDir, program: &str, words: &[&str]) -> String {
    let printed = printed(folder, program, words);
    // LAMMPS prints the command too, with the names of its variables.
    let mut ends = printed
        .lines()
        .filter_map(|line| line.strip_prefix("at rest: "));
    ends.next().expect("an end").to_owned()
}

/// The number after some words.
fn after(printed: &str, words: &str) -> f64 {
    let (_, rest) = printed.split_once(words).expect(words);
    rest.split_whitespace().next().unwrap().parse().unwrap()
}

/// The coordinates of spheres, in metres, and their radii.
fn settled(text: &str, separator: char, skip: usize) -> Vec<Vec<f64>> {
    let numbers = |line: &str| -> Option<Vec<f64>> {
        let words = line.split(separator).skip(skip);
        let words = words.filter(|word| !word.is_empty());
        let numbers: Vec<f64> = words
            .map(|x| x.trim().parse().ok())
            .collect::<Option<_>>()?;
        (numbers.len() == 4).then_some(numbers)
    };
    text.lines().filter_map(numbers).collect()
}

/// The grains lie in the box, the lowest spheres on the floor, and no higher than grains can.
fn assert_lies(spheres: &[Vec<f64>], count: usize) {
    assert_eq!(spheres.len(), count);
    let low = |sphere: &Vec<f64>| sphere[2] - sphere[3];
    let lowest = spheres.iter().map(low).fold(f64::MAX, f64::min);
    let highest = spheres.iter().map(|sphere| sphere[2]).fold(0.0, f64::max);
    assert!(lowest.abs() < 1e-4, "{lowest}");
    assert!(highest < 0.08, "{highest}");
}

#[test]
#[ignore = "needs LAMMPS (lmp) in the path"]
fn lammps_lets_two_hundred_grains_come_to_rest() {
    let folder = folder();
    export(&folder, "lammps", &["--spheres", "5"]);
    let printed = run(&folder, "lmp", &["-in", "in.settle"]);
    assert!(after(&printed, "kinetic energy ") < 1e-9, "{printed}");
    assert!(printed.contains("1000 spheres"), "{printed}");
    let dump = read(&folder.path().join("dem"), "settled.dump");
    assert_lies(&settled(&dump, ' ', 3), 1000);
}

#[test]
#[ignore = "needs LAMMPS (lmp) in the path"]
fn lammps_lets_balls_come_to_rest() {
    let folder = folder();
    export(&folder, "lammps", &["--spheres", "1", "--grains", "12"]);
    let printed = printed(&folder, "lmp", &["-in", "in.settle"]);
    assert!(printed.contains("at rest: kinetic energy"), "{printed}");
}

/// All but what is new in LAMMPS of 2026: an ellipsoid falls, its mass made from density and shape.
#[test]
#[ignore = "needs LAMMPS (lmp) in the path"]
fn lammps_before_2026_reads_superellipsoids_that_are_ellipsoids() {
    let folder = folder();
    export_superquadric(&folder, "2,2", "lammps");
    let dem = folder.path().join("dem");
    let is_old = |line: &&str| {
        !["compute block", "variable phi", "variable theta"]
            .iter()
            .any(|new| line.starts_with(new))
    };
    let script = read(&dem, "in.superellipsoids");
    let step = after(&script, "timestep ");
    let script: Vec<&str> = script
        .lines()
        .filter(is_old)
        .map(|line| match line.split(' ').next() {
            Some("atom_style") => "atom_style ellipsoid",
            Some("pair_style") => "pair_style zero 0.01",
            Some("pair_coeff") => "pair_coeff * *",
            Some("dump") => "dump frames grains custom 100 frames/*.dump id c_size[*] c_turn[*]",
            Some("dump_modify") => "dump_modify frames sort id",
            Some("run") => "run 100",
            _ => line,
        })
        .collect();
    std::fs::write(dem.join("in.old"), script.join("\n")).unwrap();
    // Rows of ten words are those of shapes, with exponents at the end.
    let old_row = |line: &str| match line.split(' ').collect::<Vec<_>>()[..] {
        [ref row @ .., _, _] if row.len() == 8 => row.join(" "),
        _ => line.to_owned(),
    };
    let data: Vec<String> = read(&dem, "data.superellipsoids")
        .lines()
        .map(old_row)
        .collect();
    std::fs::write(dem.join("data.superellipsoids"), data.join("\n") + "\n").unwrap();
    let printed = printed(&folder, "lmp", &["-in", "in.old"]);
    let mass = 200.0 * 4.0 / 3.0 * PI * 3e-2 * 2e-2 * 1.5e-2 * 2500.0;
    let energy = 0.5 * mass * (9.81 * 100.0 * step).powi(2);
    assert!(
        (after(&printed, "kinetic energy ") / energy - 1.0).abs() < 1e-6,
        "{printed}"
    );
    assert!(printed.contains("J, 200 grains in the box"), "{printed}");
}

#[test]
#[ignore = "needs YADE (yade) in the path"]
fn yade_takes_mass_centre_and_inertia_as_they_are_and_lets_the_grains_come_to_rest() {
    let folder = folder();
    export(&folder, "yade", &["--spheres", "5"]);
    let dem = folder.path().join("dem");
    let output = Command::new("yade")
        .args(["-n", "-x", "settle.py"])
        .current_dir(&dem)
        .output()
        .expect("the engine is in the path");
    let printed = String::from_utf8_lossy(&output.stdout).into_owned();
    let rest = printed.lines().find(|line| line.starts_with("at rest: "));
    let rest = rest.unwrap_or_else(|| panic!("{printed} {}", errors(&output)));
    assert!(after(rest, "kinetic energy ") < 1e-9, "{rest}");
    assert!(rest.contains("200 grains, 0 lost"), "{rest}");
    let kinds = read(&dem, "kinds.csv");
    let numbers = |line: &str, skip: usize| -> Vec<f64> {
        let words = line.split([',', ' ']).filter_map(|word| word.parse().ok());
        words.skip(skip).collect()
    };
    let expected = numbers(kinds.lines().nth(1).unwrap(), 0);
    let line = printed
        .lines()
        .find(|line| line.starts_with("first grain: "));
    let found = numbers(line.expect("the first grain"), 0);
    let grains = read(&dem, "grains.csv");
    let placed = numbers(grains.lines().nth(1).unwrap(), 0);
    for (found, expected) in [
        (found[0], expected[0]),
        (found[1], placed[0]),
        (found[2], placed[1]),
        (found[3], placed[2]),
        (found[4], expected[1]),
        (found[5], expected[2]),
        (found[6], expected[3]),
    ] {
        assert!((found / expected - 1.0).abs() < 1e-6, "{found} {expected}");
    }
    assert_lies(&settled(&read(&dem, "settled.csv"), ',', 0), 1000);
}

#[test]
#[ignore = "needs LIGGGHTS (liggghts) in the path"]
fn liggghts_lets_two_hundred_grains_come_to_rest() {
    let folder = folder();
    export(&folder, "liggghts", &["--spheres", "5"]);
    let printed = run(&folder, "liggghts", &["-in", "in.settle"]);
    assert!(after(&printed, "kinetic energy ") < 1e-9, "{printed}");
    let dump = read(&folder.path().join("dem"), "settled.dump");
    assert_lies(&settled(&dump, ' ', 2), 1000);
}
