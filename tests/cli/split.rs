use super::{errors, folder, grainform, json, names, succeed};
use std::collections::BTreeSet;

#[test]
fn a_tray_becomes_a_file_for_each_grain_in_the_frame_of_the_tray() {
    let folder = folder();
    let words = [
        "synth", "tray", "--grains", "4", "--points", "12000", "--seed", "3",
    ];
    let words = [&words[..], &["-o", "tray.ply", "--labels", "labels.txt"]].concat();
    let made = json(&folder, &words);
    let report = json(
        &folder,
        &["split", "tray.ply", "-o", "grains", "--unit", "mm"],
    );
    assert_eq!(report["grains"].as_array().unwrap().len(), 4);
    assert_eq!(
        (&report["unit"], &report["dust"]),
        (&"mm".into(), &8.into())
    );
    let files = names(&folder.path().join("grains"));
    assert_eq!(
        files,
        [
            "grain_0001.ply",
            "grain_0002.ply",
            "grain_0003.ply",
            "grain_0004.ply"
        ]
    );

    let read = |name: &str| {
        let scan = grainform::scan::read_scan(&folder.path().join(name)).unwrap();
        let bits = scan.points().iter().map(|p| p.coords.map(f64::to_bits));
        bits.map(<[u64; 3]>::from).collect::<Vec<_>>()
    };
    let labels = std::fs::read_to_string(folder.path().join("labels.txt")).unwrap();
    let all = read("tray.ply");
    assert_eq!((all.len(), labels.lines().count()), (all.len(), all.len()));
    assert_eq!(made["points"], all.len());
    let mut found = BTreeSet::new();
    for file in files {
        let own: BTreeSet<_> = read(&format!("grains/{file}")).into_iter().collect();
        let of_point = all.iter().zip(labels.lines());
        let of_own: Vec<&str> = of_point
            .filter(|(p, _)| own.contains(*p))
            .map(|(_, label)| label)
            .collect();
        assert_eq!(of_own.len(), own.len());
        let label = of_own[own.len() / 2];
        let foreign = of_own.iter().filter(|other| **other != label).count();
        assert!(100 * foreign <= own.len(), "{foreign} of {}", own.len());
        found.insert(label);
    }
    assert_eq!(found.into_iter().collect::<Vec<_>>(), ["1", "2", "3", "4"]);
    let text = succeed(&folder, &["split", "tray.ply", "-o", "again"]);
    assert!(text.contains("neighbours    are at most"), "{text}");
}

#[test]
fn what_is_cut_apart_is_told_and_can_be_left_whole() {
    let folder = folder();
    let words = ["synth", "sphere", "--points", "3000", "-o", "one.xyz"];
    succeed(&folder, &words);
    let one = std::fs::read_to_string(folder.path().join("one.xyz")).unwrap();
    let points: Vec<Vec<f64>> = one
        .lines()
        .map(|line| {
            line.split_whitespace()
                .filter_map(|word| word.parse().ok())
                .collect()
        })
        .filter(|point: &Vec<f64>| point.len() >= 3)
        .collect();
    let widest = points.iter().map(|point| point[0]).fold(0.0, f64::max);
    for (name, at) in [
        ("two.xyz", &[0.0, 1.99][..]),
        ("three.xyz", &[0.0, 1.99, 3.98]),
    ] {
        let moved = |p: &Vec<f64>, x: &f64| format!("{} {} {}\n", p[0] + x * widest, p[1], p[2]);
        let row = points
            .iter()
            .flat_map(|p| at.iter().map(move |x| moved(p, x)));
        std::fs::write(folder.path().join(name), row.collect::<String>()).unwrap();
    }
    let report = json(&folder, &["split", "two.xyz", "-o", "cut"]);
    assert_eq!(
        (&report["cuts"], report["grains"].as_array().unwrap().len()),
        (&1.into(), 2)
    );
    let warnings = report["warnings"].to_string();
    assert!(
        warnings.contains("grain_0001.ply from grain_0002.ply ("),
        "{warnings}"
    );
    assert!(warnings.contains("--uncut"), "{warnings}");
    let report = json(&folder, &["split", "three.xyz", "-o", "of_three"]);
    assert_eq!(report["cuts"], 2);
    // Pieces of three that touch may be wrong, those of two hardly.
    for (grain, is_told) in [("cut", false), ("of_three", true)] {
        let fitted = json(&folder, &["fit", &format!("{grain}/grain_0001.ply")]);
        let warnings = fitted["warnings"].to_string();
        let told = warnings.contains("cut from a heap of 3:");
        assert_eq!(told, is_told, "{warnings}");
    }
    let report = json(&folder, &["split", "two.xyz", "-o", "whole", "--uncut"]);
    assert_eq!(
        (&report["cuts"], report["grains"].as_array().unwrap().len()),
        (&0.into(), 1)
    );
    assert_eq!(report["grains"][0]["may_touch"], true);
}

#[test]
fn a_grain_does_not_replace_the_scan_that_it_is_split_from() {
    let folder = folder();
    let scan = folder.path().join("grain_0001.ply");
    succeed(&folder, &["synth", "bean", "-o", "grain_0001.ply"]);
    let before = std::fs::read(&scan).unwrap();
    std::fs::create_dir(folder.path().join("in")).unwrap();
    for output in [".", "in/.."] {
        let words = ["split", "grain_0001.ply", "-o", output];
        let refused = grainform(&folder, &words);
        assert_eq!(refused.status.code(), Some(2));
        let told = errors(&refused);
        assert!(
            told.contains("the input grain_0001.ply is named as one"),
            "{told}"
        );
    }
    assert!(before == std::fs::read(&scan).unwrap());
}

#[test]
fn grains_that_are_small_beside_a_table_are_told_and_a_scan_of_dust_is_refused() {
    let folder = folder();
    // A block, and two that are a hundredth as large.
    let mut mesh = String::new();
    for (block, (side, x)) in [(100, 0), (1, 200), (1, 300)].into_iter().enumerate() {
        for corner in 0..8 {
            let [i, j, k] = [corner & 1, corner >> 1 & 1, corner >> 2].map(|bit| bit * side);
            mesh += &format!("v {} {j} {k}\n", i + x);
        }
        for corners in [
            [1, 3, 4, 2],
            [5, 6, 8, 7],
            [1, 2, 6, 5],
            [3, 7, 8, 4],
            [1, 5, 7, 3],
            [2, 4, 8, 6],
        ] {
            let [a, b, c, d] = corners.map(|corner| corner + 8 * block);
            mesh += &format!("f {a} {b} {c} {d}\n");
        }
    }
    std::fs::write(folder.path().join("all.obj"), mesh).unwrap();
    let report = json(&folder, &["split", "all.obj", "-o", "grains"]);
    assert_eq!(report["dust"], 2);
    let told = report["warnings"][0].as_str().unwrap();
    assert!(
        told.starts_with("2 heaps were left out as dust, for they are small"),
        "{told}"
    );

    let few: String = (0..20).map(|i| format!("{i} {} 0\n", i * i)).collect();
    std::fs::write(folder.path().join("few.xyz"), few).unwrap();
    let refused = grainform(&folder, &["split", "few.xyz", "-o", "none"]);
    assert_eq!(refused.status.code(), Some(2));
    let told = errors(&refused);
    assert!(told.contains("large enough for a grain"), "{told}");
    assert!(!folder.path().join("none").exists());
}
