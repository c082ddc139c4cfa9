//! Tables of numbers: what their columns are, and what is told where that is not known.

use super::batch::rows;
use super::{errors, folder, grainform, json, number};
use tempfile::TempDir;

/// A folder with a table of normals and places of an ellipsoid of semi-axes 3, 2 and 1.5.
fn table(heading: &str) -> TempDir {
    let folder = folder();
    let rows = (0..600).map(|row| {
        let z = (f64::from(row) + 0.5) / 300.0 - 1.0;
        let (sin, cos) = (2.4 * f64::from(row)).sin_cos();
        let r = (1.0 - z * z).sqrt();
        let place = [3.0 * r * cos, 2.0 * r * sin, 1.5 * z];
        let normal = [r * cos / 3.0, r * sin / 2.0, z / 1.5];
        let length = normal.map(|n: f64| n * n).iter().sum::<f64>().sqrt();
        let numbers = normal.map(|n| n / length).into_iter().chain(place);
        numbers
            .map(|x| format!("{x:.6}"))
            .collect::<Vec<_>>()
            .join(" ")
            + "\n"
    });
    let text = format!("{heading}{}", rows.collect::<String>());
    std::fs::write(folder.path().join("a.xyz"), text).unwrap();
    folder
}

#[test]
fn places_are_fitted_and_not_the_normals_before_them() {
    let truth = 4.0 / 3.0 * std::f64::consts::PI * 9.0;
    for heading in [
        "# nx ny nz x y z\n",
        "//Nx Ny Nz X Y Z\n",
        "a b c px py pz\n",
    ] {
        let report = json(&table(heading), &["fit", "a.xyz"]);
        let share = number(&report, "volume") / truth;
        assert!((share - 1.0).abs() < 0.01, "{heading}: {share}");
    }
    let refused = grainform(&table("# by hand\n"), &["fit", "a.xyz"]);
    let told = errors(&refused);
    assert!(
        told.contains("a.xyz: line 2: ") && told.contains("as normals are"),
        "{told}"
    );
    assert_eq!(refused.status.code(), Some(2));
}

#[test]
fn an_unread_heading_is_told_beside_what_it_led_to() {
    let folder = folder();
    let points = "1 0 0\n0 1 0\n2 1 0\n0 3 0\n5 5 0\n4 1 0\n";
    let text = format!("east north height\n{points}");
    std::fs::write(folder.path().join("a.xyz"), text).unwrap();
    let heading = ". The heading `east north height` does not name the columns";
    for command in ["fit", "measure", "clump", "bench", "search"] {
        let refused = grainform(&folder, &[command, "a.xyz"]);
        let told = errors(&refused);
        assert_eq!(refused.status.code(), Some(2), "{command}");
        assert!(
            told.starts_with("error: ") && told.contains(heading),
            "{told}"
        );
    }
    let words = ["batch", "a.xyz", "-o", "r"];
    assert_eq!(grainform(&folder, &words).status.code(), Some(1));
    let rows = rows(&folder.path().join("r/results.csv"));
    assert!(rows[0]["reason"].contains(heading), "{}", rows[0]["reason"]);
}
