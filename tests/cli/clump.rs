use super::{errors, folder, grain, grainform, json, number, succeed};
use grainform::nalgebra::{Point3, Vector3};
use grainform::scan::read_scan;
use serde_json::Value;

/// Centres and radii.
fn spheres(report: &Value) -> Vec<(Vector3<f64>, f64)> {
    let sphere = |record: &Value| {
        let [x, y, z, r] = ["x", "y", "z", "r"].map(|name| number(record, name));
        (Vector3::new(x, y, z), r)
    };
    let records = report["spheres"].as_array().expect("spheres");
    records.iter().map(sphere).collect()
}

/// Root mean square over the points of a scan of the radial distance to the outside of a clump, relative to the mean
/// radius: as the figures that are to be met were measured.
fn radial_error(points: &[Point3<f64>], spheres: &[(Vector3<f64>, f64)]) -> f64 {
    let count = points.len() as f64;
    let centre = points.iter().map(|p| p.coords).sum::<Vector3<f64>>() / count;
    let (mut squares, mut radii) = (0.0, 0.0);
    for point in points {
        let radius = (point.coords - centre).norm();
        let n = (point.coords - centre) / radius;
        let exit = |(place, r): &(Vector3<f64>, f64)| {
            let from = place - centre;
            let square = from.dot(&n).powi(2) - from.norm_squared() + r * r;
            from.dot(&n) + square.max(0.0).sqrt() * if square > 0.0 { 1.0 } else { f64::NAN }
        };
        let out = spheres.iter().map(exit).fold(0.0, f64::max);
        squares += (out - radius).powi(2);
        radii += radius;
    }
    (squares / count).sqrt() / (radii / count)
}

#[test]
fn clumps_come_as_near_to_maize_and_bean_as_is_promised() {
    let folder = folder();
    succeed(
        &folder,
        &[
            "fit",
            &grain("bean.ply"),
            "-o",
            "bean.json",
            "--segments",
            "1",
        ],
    );
    succeed(&folder, &["fit", &grain("maize.ply"), "-o", "maize.json"]);
    for (input, scan, model, promised) in [
        (
            grain("maize.ply"),
            "maize.ply",
            "maize.json",
            [0.055, 0.034, 0.010],
        ),
        (
            "bean.json".into(),
            "bean.ply",
            "bean.json",
            [0.041, 0.014, 0.0045],
        ),
    ] {
        let scan = read_scan(grain(scan).as_ref()).unwrap();
        let measured = json(&folder, &["measure", model, "--only", "volume,centroid"]);
        for (count, promised) in [10, 30, 100].into_iter().zip(promised) {
            let report = json(&folder, &["clump", &input, "--spheres", &count.to_string()]);
            let found = spheres(&report);
            assert!(
                found.len() <= count && found.len() >= count - 2,
                "{input} {count}"
            );
            let error = radial_error(scan.points(), &found);
            assert!(error < promised, "{input} {count}: {error}");
            assert!(number(&report, "relative_rms") < promised);
            assert!(number(&report, "volume_error").abs() < 1e-3);
            // Mass and centre are the grain's, of points that of a fit.
            assert_eq!(report["volume"], measured["volume"]);
            assert_eq!(report["centroid"], measured["centroid"]);
        }
    }
}

#[test]
fn a_clump_stops_at_an_error_and_is_written_as_a_table_or_an_object() {
    let folder = folder();
    succeed(
        &folder,
        &["synth", "ellipsoid", "--points", "6146", "-o", "s.ply"],
    );
    let fit = ["fit", "s.ply", "--surface", "superquadric", "-o", "m.json"];
    succeed(&folder, &fit);
    let clump = ["clump", "m.json", "--error", "3%"];
    let printed = json(&folder, &[&clump[..], &["-o", "c.csv"]].concat());
    assert!(number(&printed, "relative_rms") <= 0.03);
    let table = std::fs::read_to_string(folder.path().join("c.csv")).unwrap();
    let mut rows = table.lines();
    assert_eq!(rows.next(), Some("x,y,z,r"));
    let rows: Vec<Vec<f64>> = rows
        .map(|row| row.split(',').map(|x| x.parse().unwrap()).collect())
        .collect();
    let found = spheres(&printed);
    assert_eq!(rows.len(), found.len());
    for (row, (place, r)) in rows.iter().zip(&found) {
        assert_eq!(row[..], [place.x, place.y, place.z, *r]);
    }
    let text = succeed(
        &folder,
        &[&clump[..], &["-o", "c.json", "--unit", "mm"]].concat(),
    );
    assert!(text.contains("wrote c.json"), "{text}");
    let saved = std::fs::read_to_string(folder.path().join("c.json")).unwrap();
    let saved: Value = serde_json::from_str(&saved).unwrap();
    assert_eq!(saved["spheres"], printed["spheres"]);
    assert_eq!(saved["unit"], "mm");
    // The figures hold for a clump of one less too: more than 3 %.
    let one_less = (found.len() - 1).to_string();
    let coarser = json(&folder, &["clump", "m.json", "--spheres", &one_less]);
    assert!(number(&coarser, "relative_rms") > 0.03);
}

#[test]
fn a_ball_is_one_sphere() {
    let folder = folder();
    succeed(&folder, &["synth", "sphere", "-o", "s.ply"]);
    let report = json(&folder, &["clump", "s.ply", "--spheres", "10"]);
    let [(_, radius)] = spheres(&report)[..] else {
        panic!("{report}")
    };
    assert!((radius / number(&report, "equivalent_radius") - 1.0).abs() < 1e-4);
}

#[test]
fn what_is_no_clump_is_refused_in_a_sentence() {
    let folder = folder();
    let bean = grain("bean.ply");
    for (more, sentence) in [
        (
            &["--spheres", "0"][..],
            "a clump has 1 to 500 spheres, not 0",
        ),
        (
            &["--error", "0%"],
            "must be a share above zero and below one, not 0",
        ),
        (
            &["--error", "100%"],
            "must be a share above zero and below one, not 1",
        ),
        (
            &["--error", "1e-9%"],
            "% of the equivalent radius (RMS), not within 1.00e-9 %",
        ),
        (&["-o", "c.ply"], "its extension must be json or csv"),
    ] {
        let output = grainform(&folder, &[&["clump", &bean], more].concat());
        assert_eq!(output.status.code(), Some(2));
        let message = errors(&output);
        assert!(message.contains(sentence), "{message}");
    }
}

/// The polyhedron through a hundred points of an ellipsoid lacks an eighth of its volume.
#[test]
fn a_clump_of_points_has_the_volume_of_the_grain_that_is_fitted_to_them() {
    let folder = folder();
    let synth = "synth ellipsoid --axes 3,2,1 --points 98 -o e.ply";
    succeed(&folder, &synth.split(' ').collect::<Vec<_>>());
    let told = json(&folder, &["clump", "e.ply", "--spheres", "5"]);
    let volume = told["volume"].as_f64().unwrap();
    let exact = 8.0 * std::f64::consts::PI;
    let error = told["volume_standard_error"].as_f64().unwrap();
    assert!(
        (volume - exact).abs() < 3.0 * error && error < 0.01 * exact,
        "{volume} ± {error}"
    );
}
