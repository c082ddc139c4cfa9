//! Segmented volumes from the command line.

use super::{errors, folder, grainform, json, names, number, piped, succeed};
use std::cell::Cell;
use std::f64::consts::TAU;
use std::io::Write;
use std::path::Path;

/// A header of bytes in steps of .5, .5 and 1, as NRRD.
fn header(size: [u32; 3]) -> Vec<u8> {
    let [width, height, depth] = size;
    format!(
        "NRRD0004\ntype: uchar\ndimension: 3\nsizes: {width} {height} {depth}\nencoding: raw\n\
         spacings: 0.5 0.5 1\n\n"
    )
    .into_bytes()
}

/// Two balls of radii 8 and 5 with the labels 4 and 9, in voxels of sides .5, .5 and 1, as NRRD.
fn balls(path: &Path) {
    let [width, height, depth] = [80_u32, 40, 20];
    let balls = [([10.2, 10.1, 9.8], 8.0, 4_u8), ([28.1, 9.9, 10.1], 5.0, 9)];
    let label = |x: u32, y: u32, z: u32| {
        let at = [0.5 * f64::from(x), 0.5 * f64::from(y), f64::from(z)];
        let holds = |middle: &[f64; 3], radius: f64| {
            let squares = at.iter().zip(middle).map(|(x, c)| (x - c).powi(2));
            squares.sum::<f64>() < radius * radius
        };
        let found = balls
            .iter()
            .find(|(middle, radius, _)| holds(middle, *radius));
        found.map_or(0, |(_, _, label)| *label)
    };
    let voxels = (0..depth)
        .flat_map(|z| (0..height).flat_map(move |y| (0..width).map(move |x| label(x, y, z))));
    let mut bytes = header([width, height, depth]);
    bytes.extend(voxels);
    std::fs::write(path, bytes).unwrap();
}

#[test]
fn a_label_is_fitted_with_its_volume_and_split_writes_all() {
    let folder = folder();
    balls(&folder.path().join("ct.nrrd"));
    let refused = errors(&grainform(&folder, &["fit", "ct.nrrd"]));
    assert!(
        refused.contains("--label") && refused.contains("labels: 4 ("),
        "{refused}"
    );
    let refused = errors(&grainform(&folder, &["fit", "ct.nrrd", "--label", "7"]));
    assert!(refused.contains("no voxel has the label 7"), "{refused}");
    let ball = 4.0 / 3.0 * std::f64::consts::PI;
    for (label, radius) in [("4", 8.0_f64), ("9", 5.0)] {
        let words = ["fit", "ct.nrrd", "--label", label, "--surface", "star"];
        let report = json(&folder, &words);
        let share = number(&report, "volume") / (ball * radius.powi(3));
        assert!((share - 1.0).abs() < 5e-3, "{label}: {share}");
    }
    succeed(&folder, &["split", "ct.nrrd", "-o", "grains"]);
    assert_eq!(names(&folder.path().join("grains")).len(), 2);
    let measured = json(
        &folder,
        &["measure", "grains/grain_0002.nrrd", "--only", "volume"],
    );
    let share = number(&measured, "volume") / (ball * 125.0);
    assert!((share - 1.0).abs() < 0.02, "{share}");
    let refused = errors(&grainform(
        &folder,
        &["fit", "grains/grain_0001.nrrd", "--label", "9"],
    ));
    assert!(
        refused.contains("no voxel has the label 9; labels: 4 ("),
        "{refused}"
    );
    let words = ["fit", "ct.nrrd", "--label", "one"];
    let refused = errors(&grainform(&folder, &words));
    assert!(refused.contains("expected a whole number"), "{refused}");
    // A split of fewer grains into the same folder leaves the second of these.
    let fewer = ["split", "ct.nrrd", "--label", "9", "-o", "grains"];
    let warnings = json(&folder, &fewer)["warnings"].to_string();
    assert!(
        warnings.contains("grain_0002.nrrd is of an earlier split"),
        "{warnings}"
    );
}

#[test]
fn a_batch_has_a_row_for_each_label_of_an_image() {
    let folder = folder();
    balls(&folder.path().join("ct.nrrd"));
    let words = |output: &'static str, jobs: &'static str| {
        let only = ["--only", "area,volume", "--models", "--meshes"];
        [
            &["batch", "ct.nrrd", "-o", output, "--jobs", jobs][..],
            &only,
        ]
        .concat()
    };
    succeed(&folder, &words("one", "1"));
    succeed(&folder, &words("three", "3"));
    let read = |name: &str| std::fs::read(folder.path().join(name)).unwrap();
    for name in ["results.csv", "results.parquet", "summary.json"] {
        let [one, three] = ["one", "three"].map(|output| read(&format!("{output}/{name}")));
        assert!(one == three, "{name}");
    }
    let mut reader = csv::Reader::from_path(folder.path().join("one/results.csv")).unwrap();
    let rows: Vec<std::collections::BTreeMap<String, String>> =
        reader.deserialize().map(|row| row.unwrap()).collect();
    assert_eq!(rows.len(), 2);
    let hash = blake3::hash(&read("ct.nrrd")).to_hex().to_string();
    for (row, label) in rows.iter().zip(["4", "9"]) {
        assert_eq!(row["path"], format!("ct.nrrd#{label}"));
        assert_eq!(row["hash"], hash);
        let words = ["fit", "ct.nrrd", "--label", label];
        let fitted = number(&json(&folder, &words), "volume");
        assert_eq!(row["volume"].parse().ok(), Some(fitted), "{label}");
    }
    assert_eq!(
        names(&folder.path().join("one/models")),
        ["ct#4.json", "ct#9.json"]
    );
    assert_eq!(
        names(&folder.path().join("one/meshes")),
        ["ct#4.ply", "ct#9.ply"]
    );
    let again = grainform(&folder, &words("one", "2"));
    assert!(errors(&again).contains("2 of 2 rows are those of an earlier run"));
    std::fs::write(
        folder.path().join("truth.csv"),
        "file,volume\nct.nrrd#9,523.6\n",
    )
    .unwrap();
    succeed(
        &folder,
        &["report", "one", "--truth", "truth.csv", "-o", "one.html"],
    );
}

#[test]
fn the_steps_between_voxels_are_no_texture() {
    let folder = folder();
    balls(&folder.path().join("ct.nrrd"));
    for (label, radius) in [("4", 8.0_f64), ("9", 5.0)] {
        let report = json(&folder, &["fit", "ct.nrrd", "--label", label]);
        assert_eq!(report["surface"], "position");
        assert_eq!(report["reference"]["kind"], "voxels");
        let area = 4.0 * std::f64::consts::PI * radius * radius;
        let truth = [("area", area), ("volume", area * radius / 3.0)];
        for (figure, truth) in truth {
            let off = number(&report, figure) - truth;
            let error = number(&report["standard_errors"], figure);
            assert!(off.abs() < 2.0 * error, "{figure} {off} {error}");
            assert!(error < 0.02 * truth, "{figure} {error}");
        }
    }
    let measured = json(
        &folder,
        &["measure", "ct.nrrd", "--label", "4", "--only", "area"],
    );
    assert_eq!(measured["of"], "voxels");
    assert!(measured["area"].is_null());
    let reason = measured["not_measured"][0]["reason"].as_str().unwrap();
    assert!(reason.contains("steps, as voxels leave them"), "{reason}");
    let warning = measured["warnings"][0].as_str().unwrap();
    assert!(
        warning.contains("cut off the corners of voxels, whose volume is"),
        "{warning}"
    );
}

#[test]
fn the_largest_of_two_bodies_with_one_label_is_fitted_as_voxels() {
    let folder = folder();
    balls(&folder.path().join("ct.nrrd"));
    let bytes = std::fs::read(folder.path().join("ct.nrrd")).unwrap();
    for (name, label) in [("two.nrrd", 4), ("alone.nrrd", 0)] {
        let bytes = bytes
            .iter()
            .map(|&byte| if byte == 9 { label } else { byte });
        std::fs::write(folder.path().join(name), bytes.collect::<Vec<u8>>()).unwrap();
    }
    let largest = json(&folder, &["fit", "two.nrrd", "--largest"]);
    let alone = json(&folder, &["fit", "alone.nrrd"]);
    assert_eq!(largest["surface"], "position");
    assert_eq!(largest["reference"]["kind"], "voxels");
    let share = number(&largest, "volume") / number(&alone, "volume");
    assert!((share - 1.0).abs() < 2e-3, "{share}");
    let [of_largest, of_alone] =
        [&largest, &alone].map(|report| number(&report["standard_errors"], "volume"));
    assert!(
        (of_largest / of_alone - 1.0).abs() < 0.2,
        "{of_largest} {of_alone}"
    );
    let words = ["batch", "two.nrrd", "--largest", "-o", "r", "--quiet"];
    succeed(&folder, &words);
    let rows = super::batch::rows(&folder.path().join("r/results.csv"));
    let volume: f64 = rows[0]["volume"].parse().unwrap();
    assert_eq!(volume, number(&largest, "volume"));
}

/// The image of the balls with other labels.
pub(super) fn relabelled(folder: &Path, name: &str, label: impl Fn(usize, u8) -> u8) {
    balls(&folder.join("ct.nrrd"));
    let bytes = std::fs::read(folder.join("ct.nrrd")).unwrap();
    let head = header([80, 40, 20]);
    let voxels = bytes[head.len()..].iter().enumerate();
    let voxels = voxels.map(|(at, &old)| label(at, old)).collect::<Vec<u8>>();
    std::fs::write(folder.join(name), [head, voxels].concat()).unwrap();
}

#[test]
fn bodies_of_one_label_are_split_into_files_that_are_fitted_as_voxels() {
    let folder = folder();
    let is_speck = |at: usize| [5, 6, 700].contains(&at);
    relabelled(folder.path(), "two.nrrd", |at, old| {
        u8::from(old > 0 || is_speck(at))
    });
    let refused = errors(&grainform(&folder, &["fit", "two.nrrd"]));
    assert!(refused.contains("2 separate bodies"), "{refused}");
    let report = json(&folder, &["split", "two.nrrd", "-o", "grains"]);
    assert_eq!(names(&folder.path().join("grains")).len(), 2);
    assert_eq!(
        (&report["dust"], &report["dust_points"]),
        (&2.into(), &3.into())
    );
    assert_eq!(report["warnings"].to_string(), "[]");
    for (file, label) in [("grain_0001", "4"), ("grain_0002", "9")] {
        let own = json(&folder, &["fit", &format!("grains/{file}.nrrd")]);
        let expected = json(&folder, &["fit", "ct.nrrd", "--label", label]);
        for key in ["volume", "area", "standard_errors", "reference"] {
            assert_eq!(own[key], expected[key], "{key}");
        }
    }
    let words = ["batch", "grains", "-o", "r", "--only", "volume", "--quiet"];
    succeed(&folder, &words);
    assert_eq!(
        super::batch::rows(&folder.path().join("r/results.csv")).len(),
        2
    );
}

#[test]
fn a_neck_between_voxels_is_told_and_a_label_of_specks_is_left_out() {
    let folder = folder();
    // A bar of 5 by 5 by 3 voxels joins the balls; a label of single voxels lies beside them.
    relabelled(folder.path(), "bar.nrrd", |at, old| {
        let [x, y, z] = [at % 80, at / 80 % 40, at / 3200];
        let is_bar = (20..56).contains(&x) && (18..23).contains(&y) && (9..12).contains(&z);
        match (x, y) {
            (2 | 4, 2) => 7,
            _ => u8::from(old > 0 || is_bar),
        }
    });
    let report = json(&folder, &["split", "bar.nrrd", "-o", "grains"]);
    assert_eq!(report["grains"].as_array().unwrap().len(), 1);
    assert_eq!(report["grains"][0]["may_touch"], true);
    let warnings = report["warnings"].to_string();
    assert!(warnings.contains("voxels are not cut apart"), "{warnings}");
    let told = "the label 7 is 2 specks of less than 30 voxels each";
    assert!(warnings.contains(told), "{warnings}");
}

#[test]
fn voxels_that_miss_inside_of_a_grain_are_hollows() {
    let folder = folder();
    let (grain, pores) = (Cell::new(0), Cell::new(0));
    relabelled(folder.path(), "pores.nrrd", |at, old| {
        let place = [at % 80, at / 80 % 40, at / 3200];
        let is_within = (12..28).contains(&place[0]) && (12..28).contains(&place[1]);
        let is_deep = is_within && (6..14).contains(&place[2]);
        let is_pore = is_deep && place.iter().all(|i| i % 4 == 0);
        grain.set(grain.get() + u32::from(old == 4));
        pores.set(pores.get() + u32::from(old == 4 && is_pore));
        u8::from(old == 4 && !is_pore)
    });
    let warnings = json(&folder, &["fit", "pores.nrrd"])["warnings"].to_string();
    let share = 100.0 * f64::from(pores.get()) / f64::from(grain.get());
    let told = format!("{} hollows in it", pores.get());
    assert!(warnings.contains(&told), "{warnings}");
    let told = format!("these make {share:.2} % of its volume");
    assert!(warnings.contains(&told), "{warnings}");
    assert!(!warnings.contains("detached"), "{warnings}");
    let words = ["measure", "pores.nrrd", "--only", "volume"];
    let warnings = json(&folder, &words)["warnings"].to_string();
    assert!(warnings.contains("(of hollows)"), "{warnings}");
    let volume = 0.25 * f64::from(grain.get() - pores.get());
    let told = format!("whose volume is {volume}");
    assert!(warnings.contains(&told), "{warnings}");
}

#[test]
fn a_speck_of_an_image_is_no_grain() {
    let folder = folder();
    let path = folder.path().join("ct.nrrd");
    balls(&path);
    let mut bytes = std::fs::read(&path).unwrap();
    let last = bytes.len() - 2000;
    bytes[last] = 77;
    std::fs::write(&path, bytes).unwrap();
    let report = json(&folder, &["split", "ct.nrrd", "-o", "grains"]);
    assert_eq!(report["grains"].as_array().unwrap().len(), 2);
    let warnings = report["warnings"].to_string();
    assert!(warnings.contains("too few"), "{warnings}");
}

#[test]
fn labels_that_the_border_cuts_off_or_of_few_voxels_are_refused() {
    let folder = folder();
    let size = [20, 20, 20];
    let label = |x: u32, y: u32, z: u32| {
        let squares = [x, y, z].map(|i| (f64::from(i) - 9.3).powi(2));
        // A ball that touches a side, one in a corner that is cut off, and a speck.
        match squares.iter().sum::<f64>() < 95.0 {
            true => 1,
            false if x + y + z < 6 => 2,
            false if [x, y, z] == [18, 18, 18] => 3,
            false => 0,
        }
    };
    let mut bytes = header(size);
    let all = (0..20).flat_map(|z| (0..20).flat_map(move |y| (0..20).map(move |x| (x, y, z))));
    bytes.extend(all.map(|(x, y, z)| label(x, y, z)));
    std::fs::write(folder.path().join("ct.nrrd"), bytes).unwrap();
    for (label, reason) in [("2", "cut off at the border"), ("3", "1 voxel, too few")] {
        let refused = errors(&grainform(&folder, &["fit", "ct.nrrd", "--label", label]));
        assert!(refused.contains(reason), "{refused}");
    }
    let report = json(&folder, &["fit", "ct.nrrd", "--label", "1"]);
    let warnings = report["warnings"].to_string();
    assert!(warnings.contains("touches the border"), "{warnings}");
    let report = json(&folder, &["split", "ct.nrrd", "-o", "grains"]);
    assert_eq!(names(&folder.path().join("grains")).len(), 1);
    assert_eq!(report["warnings"].as_array().unwrap().len(), 2);
    // The grain that touches the border does so in a file of its own, too.
    let report = json(&folder, &["fit", "grains/grain_0001.nrrd"]);
    let warnings = report["warnings"].to_string();
    assert!(warnings.contains("touches the border"), "{warnings}");
}

/// An image of cubes of side 1 with one label, in those that the function says.
fn image(path: &Path, size: [u32; 3], holds: impl Fn([f64; 3]) -> bool) {
    let [width, height, depth] = size;
    let head = String::from_utf8(header(size)).unwrap();
    let mut bytes = head.replace("0.5 0.5 1", "1 1 1").into_bytes();
    for z in 0..depth {
        for y in 0..height {
            bytes.extend((0..width).map(|x| u8::from(holds([x, y, z].map(f64::from)))));
        }
    }
    std::fs::write(path, bytes).unwrap();
}

fn is_in_ball([x, y, z]: [f64; 3], middle: [f64; 3], radius: f64) -> bool {
    let squares = [x - middle[0], y - middle[1], z - middle[2]].map(|x| x * x);
    squares.iter().sum::<f64>() < radius * radius
}

#[test]
fn a_label_with_a_tunnel_is_refused_for_its_handle() {
    let folder = folder();
    image(&folder.path().join("ct.nrrd"), [26, 26, 26], |at| {
        let is_tunnel = at[0] == 12.0 && at[1] == 14.0;
        is_in_ball(at, [12.3, 12.6, 12.4], 10.0) && !is_tunnel
    });
    let refused = errors(&grainform(&folder, &["fit", "ct.nrrd"]));
    assert!(refused.contains("has 1 handle"), "{refused}");
}

/// Faces between the voxels of a long body that is turned lie in rows, and on the sphere some of them were all but flat.
#[test]
fn long_grains_of_voxels_are_fitted_by_positions_however_they_lie() {
    let folder = folder();
    for axis in [[1.0, 2.0, 3.0], [3.0, 4.0, 1.0], [6.0, 1.0, 2.0]] {
        let size = f64::hypot(axis[0], axis[1]).hypot(axis[2]);
        image(&folder.path().join("rice.nrrd"), [125; 3], |place| {
            let off = [0, 1, 2].map(|i| place[i] - [62.3, 61.6, 62.1][i]);
            let along = (0..3).map(|i| off[i] * axis[i] / size).sum::<f64>();
            let across = off.iter().map(|x| x * x).sum::<f64>() - along * along;
            (along / 60.0).powi(2) + across / 225.0 < 1.0
        });
        let report = json(&folder, &["fit", "rice.nrrd"]);
        assert_eq!(report["surface"], "position", "{axis:?}");
        // A prolate spheroid of semi-axes a and c with sin t = e has the area 2 pi a (a + c t / e).
        let eccentricity = (1.0_f64 - 1.0 / 16.0).sqrt();
        let area = TAU * 15.0 * (15.0 + 60.0 * eccentricity.asin() / eccentricity);
        let off = number(&report, "area") - area;
        let error = number(&report["standard_errors"], "area");
        assert!(
            off.abs() < 2.0 * error && error < 5e-3 * area,
            "{axis:?}: {off} {error}"
        );
    }
}

#[test]
fn a_label_of_two_grains_is_told_by_its_neck() {
    let folder = folder();
    let balls = |x: f64| {
        image(&folder.path().join("ct.nrrd"), [50, 28, 28], |at| {
            [13.0, 13.0 + x]
                .iter()
                .any(|&x| is_in_ball(at, [x, 13.0, 13.0], 12.0))
        });
        let report = json(&folder, &["fit", "ct.nrrd"]);
        (
            report["warnings"].to_string(),
            report["standard_errors"].is_null(),
        )
    };
    let (warnings, has_none) = balls(23.0);
    assert!(warnings.contains("has a neck") && has_none, "{warnings}");
    let split = json(&folder, &["split", "ct.nrrd", "-o", "grains"]);
    assert!(split["warnings"].to_string().contains("neck"), "{split}");
    let (warnings, has_none) = balls(8.0);
    assert!(!warnings.contains("has a neck") && !has_none, "{warnings}");
}

#[test]
fn a_batch_sees_that_the_voxels_beside_a_header_changed() {
    let folder = folder();
    balls(&folder.path().join("ct.nrrd"));
    let bytes = std::fs::read(folder.path().join("ct.nrrd")).unwrap();
    std::fs::remove_file(folder.path().join("ct.nrrd")).unwrap();
    let mut head = header([80, 40, 20]);
    let voxels = &bytes[head.len()..];
    head.truncate(head.len() - 1);
    head.extend(b"data file: ct.raw\n\n");
    std::fs::write(folder.path().join("ct.nhdr"), head).unwrap();
    let volumes = |kept: &[u8]| {
        let voxels: Vec<u8> = voxels
            .iter()
            .map(|label| label * u8::from(kept.contains(label)))
            .collect();
        std::fs::write(folder.path().join("ct.raw"), voxels).unwrap();
        let words = ["batch", "ct.nhdr", "-o", "r", "--only", "volume", "--quiet"];
        succeed(&folder, &words);
        let rows = super::batch::rows(&folder.path().join("r/results.csv"));
        let volumes: Vec<String> = rows.into_iter().map(|row| row["volume"].clone()).collect();
        volumes
    };
    let both = volumes(&[4, 9]);
    assert_eq!(both.len(), 2);
    assert_eq!(volumes(&[4]), both[..1]);
    assert_eq!(volumes(&[9]), both[1..]);
}

#[test]
fn a_unit_that_the_header_contradicts_is_refused() {
    let folder = folder();
    balls(&folder.path().join("ct.nrrd"));
    let bytes = std::fs::read(folder.path().join("ct.nrrd")).unwrap();
    let head = header([80, 40, 20]);
    let mut in_um = head[..head.len() - 1].to_vec();
    in_um.extend(b"space units: \"um\" \"um\" \"um\"\n\n");
    in_um.extend(&bytes[head.len()..]);
    std::fs::write(folder.path().join("um.nrrd"), in_um).unwrap();
    let one = ["--label", "4"];
    for words in [
        &["measure", "um.nrrd"][..],
        &["fit", "um.nrrd"],
        &["fit", "um.nrrd", "--surface", "superquadric"],
        &["search", "um.nrrd"],
        &["clump", "um.nrrd"],
        &["report", "um.nrrd", "-o", "r.html"],
    ] {
        let output = grainform(&folder, &[words, &one, &["--unit", "mm"]].concat());
        let told = errors(&output);
        assert!(!output.status.success(), "{words:?}");
        assert!(
            told.contains("lengths are in um, and --unit that they are in mm: leave --unit out"),
            "{words:?}: {told}"
        );
        assert!(output.stdout.is_empty(), "{words:?}");
    }
    let split = ["split", "um.nrrd", "-o", "grains", "--unit", "mm"];
    assert!(errors(&grainform(&folder, &split)).contains("leave --unit out"));
    let batch = ["batch", "um.nrrd", "-o", "r", "--unit", "mm", "--quiet"];
    assert!(!grainform(&folder, &batch).status.success());
    for row in super::batch::rows(&folder.path().join("r/results.csv")) {
        assert!(row["reason"].contains("leave --unit out"), "{row:?}");
        assert_eq!(row["volume"], "");
    }
    let measure = ["measure", "um.nrrd", "--label", "4", "--only", "volume"];
    let report = json(&folder, &[&measure[..], &["--unit", "um"]].concat());
    assert_eq!(report["unit"], "um");
    assert!(
        json(&folder, &measure)["warnings"]
            .to_string()
            .contains("in um")
    );
}

#[test]
fn a_metaimage_is_read_from_standard_input() {
    let folder = folder();
    balls(&folder.path().join("ct.nrrd"));
    let bytes = std::fs::read(folder.path().join("ct.nrrd")).unwrap();
    let mut meta =
        b"ObjectType = Image\nNDims = 3\nDimSize = 80 40 20\nElementSpacing = 0.5 0.5 1\n\
                     ElementType = MET_UCHAR\nElementDataFile = LOCAL\n"
            .to_vec();
    meta.extend(&bytes[header([80, 40, 20]).len()..]);
    let words = ["measure", "-", "--label", "9", "--only", "volume", "--json"];
    let output = piped(&folder, &words, &meta);
    assert!(output.status.success(), "{}", errors(&output));
    let words = ["measure", "ct.nrrd", "--label", "9", "--only", "volume"];
    let expected = number(&json(&folder, &words), "volume");
    let found: serde_json::Value = serde_json::from_slice(&output.stdout).unwrap();
    assert_eq!(number(&found, "volume"), expected);
}

#[test]
fn the_limit_of_voxels_is_that_of_the_command() {
    let folder = folder();
    balls(&folder.path().join("ct.nrrd"));
    let bytes = std::fs::read(folder.path().join("ct.nrrd")).unwrap();
    let head = header([80, 40, 20]);
    let text = String::from_utf8(head.clone()).unwrap();
    let voxels = bytes[head.len()..]
        .iter()
        .map(|&byte| if byte == 9 { 4 } else { byte });
    let mut packed = flate2::write::GzEncoder::new(
        text.replace("raw", "gzip").into_bytes(),
        flate2::Compression::best(),
    );
    packed.write_all(&voxels.collect::<Vec<u8>>()).unwrap();
    std::fs::write(folder.path().join("one.nrrd"), packed.finish().unwrap()).unwrap();
    let told = "more than the 20000 bytes that may be read; allow more with --max-bytes";
    let refused = errors(&grainform(
        &folder,
        &["fit", "one.nrrd", "--max-bytes", "20k"],
    ));
    assert!(refused.contains(told), "{refused}");
    let words = ["batch", "one.nrrd", "-o", "r", "--max-bytes", "20k"];
    assert!(!grainform(&folder, &words).status.success());
    let rows = super::batch::rows(&folder.path().join("r/results.csv"));
    assert!(rows[0]["reason"].contains(told), "{rows:?}");
    let words = ["measure", "one.nrrd", "--max-bytes", "64k"];
    succeed(&folder, &words);
}
