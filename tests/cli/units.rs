use super::{errors, folder, grain, grainform, json, succeed};

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
    let measure = ["measure", "m.json"];
    for (words, labelled) in [
        (
            &fit[..],
            &[" mm², ", " mm³\n", "mm (", "mean radius   4.", "are in mm."][..],
        ),
        (&search, &["RMS, mm", " mm ("]),
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
    assert!(told.contains("expected um, mm, cm or m"), "{told}");
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
        text.contains("\ntolerance     0.500000 in the scan's unit, 11.538 % of the mean radius\n"),
        "{text}"
    );
    let words = ["fit", &bean, "--tolerance", "0.5", "--unit", "um"];
    let text = succeed(&folder, &words);
    assert!(
        text.contains("\ntolerance     0.500000 um, 11.538 %"),
        "{text}"
    );
    assert_eq!(json(&folder, &words)["tolerance"], 0.5);
}
