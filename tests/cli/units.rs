use super::{errors, folder, grain, grainform, json, succeed};
use serde_json::Value;
use tempfile::TempDir;

const QUICK: [&str; 2] = ["--tolerance", "5%"];

#[test]
fn a_unit_labels_lengths_areas_and_volumes_and_is_in_the_json() {
    let folder = folder();
    let bean = grain("bean.ply");
    succeed(
        &folder,
        &[&["fit", &bean, "-o", "m.json"], &QUICK[..]].concat(),
    );
    let fit = [&["fit", &bean], &QUICK[..]].concat();
    let search = [&["search", &bean], &QUICK[..]].concat();
    let quadric = ["fit", &bean, "--surface", "superquadric"];
    let measure = ["measure", "m.json"];
    for (words, labelled) in [
        (
            &fit[..],
            &[" mm², ", " mm³\n", "mm (", "mean radius   4.", "are in mm."][..],
        ),
        (&search, &["RMS, mm", " mm ("]),
        (&quadric, &[" mm², ", " mm³", "are in mm."]),
        (
            &measure,
            &[
                " mm²\n",
                " mm³\n",
                " mm⁵\n",
                " /mm\n",
                " /mm²\n",
                "are in mm,",
            ],
        ),
    ] {
        let text = succeed(&folder, &[words, &["--unit", "MM"]].concat());
        for label in labelled {
            assert!(text.contains(label), "{label:?} in {text}");
        }
        let plain = succeed(&folder, words);
        assert!(!plain.contains("mm"), "{plain}");
        let report = json(&folder, &[words, &["--unit", "mm"]].concat());
        assert_eq!(report["unit"], "mm");
        assert!(json(&folder, words).get("unit").is_none());
    }
    succeed(&folder, &["fit", &bean, "-o", "m.json"]);
    let load = "--indentation-um 10 --youngs-modulus-mpa 9 --unit Mm";
    let load: Vec<&str> = load.split(' ').collect();
    let output = grainform(&folder, &[&["contact", "m.json"], &load[..]].concat());
    let told = errors(&output);
    assert!(
        told.contains("expected nm, um, mm, cm, dm, m or inch"),
        "{told}"
    );
    let load = [&load[..5], &["CM"]].concat();
    let contact = [&["contact", "m.json"], &load[..]].concat();
    assert_eq!(json(&folder, &contact)["unit"], "cm");
    assert!(succeed(&folder, &contact).contains(" cm\n"));
}

#[test]
fn a_bare_tolerance_is_told_as_the_length_that_it_is() {
    let folder = folder();
    let bean = grain("bean.ply");
    let text = succeed(&folder, &["fit", &bean, "--tolerance", "0.5"]);
    assert!(
        text.contains("\ntolerance     0.500000 in the scan's unit, 11.517 % of the mean radius\n"),
        "{text}"
    );
    let words = ["fit", &bean, "--tolerance", "0.5", "--unit", "um"];
    let text = succeed(&folder, &words);
    assert!(
        text.contains("\ntolerance     0.500000 um, 11.517 %"),
        "{text}"
    );
    assert_eq!(json(&folder, &words)["tolerance"], 0.5);
}

/// A ball of radius 6 in voxels of side 1, as NRRD whose header says this unit.
fn ball(folder: &TempDir, name: &str, unit: &str) {
    let head = format!(
        "NRRD0004\ntype: uchar\ndimension: 3\nsizes: 20 20 20\nencoding: raw\nspacings: 1 1 1\n\
         space units: \"{unit}\" \"{unit}\" \"{unit}\"\n\n"
    );
    let square = |at: u32| (f64::from(at) - 9.6).powi(2);
    let holds = |x, y, z| square(x) + square(y) + square(z) < 36.0;
    let voxels = (0..20).flat_map(|z| (0..20).map(move |y| (z, y)));
    let voxels = voxels.flat_map(|(z, y)| (0..20).map(move |x| u8::from(holds(x, y, z))));
    let bytes: Vec<u8> = head.into_bytes().into_iter().chain(voxels).collect();
    std::fs::write(folder.path().join(name), bytes).unwrap();
}

#[test]
fn a_batch_tells_the_units_of_headers_and_no_mean_over_several() {
    let folder = folder();
    for (name, unit) in [("a.nrrd", "mm"), ("b.nrrd", "mm"), ("c.nrrd", "micron")] {
        ball(&folder, name, unit);
    }
    std::fs::copy(folder.path().join("c.nrrd"), folder.path().join("d.nrrd")).unwrap();
    let batch = |output: &str, scans: &[&str]| {
        let only = ["-o", output, "--only", "volume,sphericity"];
        errors(&grainform(&folder, &[&["batch"], scans, &only].concat()))
    };
    let told = batch("r", &["a.nrrd", "c.nrrd"]);
    let rows = super::batch::rows(&folder.path().join("r/results.csv"));
    assert_eq!([&rows[0]["unit"], &rows[1]["unit"]], ["mm", "um"]);
    let summary = std::fs::read(folder.path().join("r/summary.json")).unwrap();
    let summary: Value = serde_json::from_slice(&summary).unwrap();
    let measures = summary["measures"].as_array().unwrap().iter();
    let measures: Vec<_> = measures.map(|one| one["measure"].as_str()).collect();
    assert_eq!(measures, [Some("sphericity.wadell")]);
    assert_eq!(summary["correlations"].as_array().unwrap().len(), 1);
    let warning = summary["warnings"][0].as_str().unwrap();
    assert!(
        warning.starts_with("Lengths are in mm and um, "),
        "{warning}"
    );
    assert!(
        warning.contains("not told: volume, heldout_rms."),
        "{warning}"
    );
    assert!(told.contains(&format!("warning: {warning}\n")), "{told}");
    let output = grainform(&folder, &["report", "r", "-o", "r.html"]);
    assert!(errors(&output).contains("Lengths in r are in mm and um"));
    let bed = "bed a.nrrd --sizes r --spheres 3 --grains 9 --box 60,60 --unit mm -o bed";
    let bed: Vec<&str> = bed.split(' ').collect();
    assert!(errors(&grainform(&folder, &bed)).contains("more than one unit"));

    for (output, scans) in [("mm", ["a.nrrd", "b.nrrd"]), ("um", ["c.nrrd", "d.nrrd"])] {
        assert!(!batch(output, &scans).contains("Lengths"));
    }
    let refused = grainform(&folder, &["compare", "mm", "um"]);
    assert_eq!(refused.status.code(), Some(2));
    assert!(errors(&refused).contains("lots in mm and um are not to be compared"));
}

/// A model keeps the unit that its scan's file told, or that it was fitted with, and no other is taken for it.
#[test]
fn a_model_keeps_its_unit() {
    let folder = folder();
    let bean = grain("bean.ply");
    succeed(
        &folder,
        &["synth", "bean", "--points", "600", "-o", "s.xyz"],
    );
    let rows = std::fs::read_to_string(folder.path().join("s.xyz")).unwrap();
    let rows: Vec<String> = rows.lines().map(|row| row.replace(' ', ",")).collect();
    let table = |unit: &str| format!("x [{unit}],y [{unit}],z [{unit}]\n{}", rows.join("\n"));
    std::fs::write(folder.path().join("um.csv"), table("um")).unwrap();
    std::fs::write(folder.path().join("odd.csv"), table("1e-6 m")).unwrap();
    for (words, unit) in [
        (&["fit", "um.csv", "-o", "um.json"][..], "um"),
        (
            &[
                "fit",
                "um.csv",
                "--surface",
                "superquadric",
                "-o",
                "parts.json",
            ],
            "um",
        ),
        (&["fit", &bean, "--unit", "inch", "-o", "in.json"], "inch"),
        (
            &["batch", "um.csv", "--models", "-o", "r", "--only", "volume"],
            "um",
        ),
    ] {
        succeed(&folder, words);
        let model = words
            .iter()
            .find(|word| word.ends_with(".json"))
            .unwrap_or(&"r/models/um.json");
        assert_eq!(json(&folder, &["measure", model])["unit"], unit, "{model}");
        for command in ["measure", "clump"] {
            let output = grainform(&folder, &[command, model, "--unit", "mm"]);
            assert_eq!(output.status.code(), Some(2), "{command} {words:?}");
            let told = errors(&output);
            let expected =
                format!("says itself that lengths are in {unit}, and --unit that they are in mm");
            assert!(told.contains(&expected), "{told}");
        }
    }
    succeed(&folder, &["split", "um.csv", "-o", "grains"]);
    assert_eq!(
        json(&folder, &["measure", "grains/grain_0001.ply"])["unit"],
        "um"
    );
    let load = ["--indentation-um", "0.01", "--youngs-modulus-mpa", "200"];
    let contact = [&["contact", "um.json"], &load[..]].concat();
    let told = json(&folder, &contact);
    assert_eq!(told["unit"], "um");
    assert_eq!(
        json(&folder, &[&contact[..], &["--unit", "um"]].concat()),
        told
    );
    let both = [&contact[..2], &["in.json"], &contact[2..]].concat();
    let told = errors(&grainform(&folder, &both));
    assert!(
        told.contains("um.json has its lengths in um, and in.json in inch"),
        "{told}"
    );
    for command in [
        &["export-dem", "--engine", "lammps"][..],
        &["bed", "--box", "9,9"],
    ] {
        let rest = ["um.json", "--unit", "mm", "-o", "out", "--spheres", "3"];
        let output = grainform(&folder, &[command, &rest[..]].concat());
        assert!(
            errors(&output).contains("says itself that lengths are in um"),
            "{output:?}"
        );
    }
    let output = grainform(&folder, &["measure", "odd.csv", "--unit", "mm"]);
    assert!(
        errors(&output).contains("says itself that lengths are in 1e-6 m"),
        "{output:?}"
    );
    assert!(succeed(&folder, &["measure", "odd.csv"]).contains("in the scan's unit"));
}

#[test]
fn a_unit_that_is_not_known_here_is_told_and_none_beside_it_taken() {
    let folder = folder();
    let rows: String = (0..400)
        .map(|i| {
            let (z, turn) = (1.0 - (2.0 * f64::from(i) + 1.0) / 400.0, 2.4 * f64::from(i));
            let across = (1.0 - z * z).sqrt();
            format!("{},{},{z}\n", across * turn.cos(), across * turn.sin())
        })
        .collect();
    std::fs::write(
        folder.path().join("far.csv"),
        format!("x [km],y [km],z [km]\n{rows}"),
    )
    .unwrap();
    succeed(&folder, &["fit", "far.csv", "-o", "far.json"]);
    let report = json(&folder, &["measure", "far.json", "--only", "volume"]);
    assert!(report["unit"].is_null());
    let told = "far.json says that its lengths are in km, and so are its figures: no unit is told with them.";
    assert_eq!(report["warnings"][0], told);
    assert!(errors(&grainform(&folder, &["clump", "far.json"])).contains(told));
    let export = |unit: &[&str]| {
        let words = [
            &["export-dem", "far.json", "--engine", "yade", "-o", "dem"],
            unit,
        ]
        .concat();
        errors(&grainform(&folder, &words))
    };
    assert!(export(&[]).contains(
        "far.json has its lengths in km: expected nm, um, mm, cm, dm, m or inch; convert the scan"
    ));
    assert!(export(&["--unit", "mm"]).contains("convert the scan, or correct the file"));
}
