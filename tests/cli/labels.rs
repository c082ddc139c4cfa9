//! Labels of segmented volumes, and meshes, that are not what they seem.

use super::volumes::relabelled;
use super::{errors, folder, grainform, json, number};
use grainform::Mesh;
use grainform::export::save_mesh;
use grainform::nalgebra::Vector3;
use grainform::scan::read_scan;
use serde_json::Value;

#[test]
fn a_label_that_surrounds_the_grains_is_told_as_such() {
    let folder = folder();
    relabelled(folder.path(), "full.nrrd", |_, old| old.max(1));
    let report = json(&folder, &["split", "full.nrrd", "-o", "grains"]);
    assert_eq!(report["grains"].as_array().unwrap().len(), 2);
    let warnings = report["warnings"].to_string();
    let told = "the label 1 goes on beyond all six sides of the volume";
    assert!(warnings.contains(told), "{warnings}");
    relabelled(folder.path(), "full.nrrd", |_, _| 1);
    let told = errors(&grainform(&folder, &["split", "full.nrrd", "-o", "none"]));
    assert!(
        told.contains("no whole grain: the label 1 goes on"),
        "{told}"
    );
}

#[test]
fn a_hollow_of_the_largest_body_is_no_other_body() {
    let folder = folder();
    let distance = |at: usize, middle: [usize; 3]| {
        let place = [at % 80, at / 80 % 40, at / 3200];
        let squares = (0..3).map(|axis| place[axis].abs_diff(middle[axis]).pow(2));
        squares.sum::<usize>()
    };
    // The ball of radius 8 about (20, 20, 10) has a hollow of radius 4.
    relabelled(folder.path(), "hollow.nrrd", |at, old| {
        u8::from(old == 4 && distance(at, [20, 20, 10]) > 16)
    });
    let refused = errors(&grainform(&folder, &["fit", "hollow.nrrd"]));
    assert!(refused.contains("1 inner surface"), "{refused}");
    assert!(!refused.contains("either"), "{refused}");
    let report = json(&folder, &["fit", "hollow.nrrd", "--largest"]);
    let whole = json(&folder, &["fit", "ct.nrrd", "--label", "4"]);
    assert_eq!(report["volume"], whole["volume"]);
    let warnings = report["warnings"].to_string();
    assert!(
        warnings.contains("The scan has 1 hollow in it"),
        "{warnings}"
    );
    assert!(!warnings.contains("body was left out"), "{warnings}");
}

#[test]
fn a_mesh_of_marching_cubes_is_taken_as_the_voxels_it_was_made_of() {
    let folder = folder();
    relabelled(folder.path(), "one.nrrd", |_, old| u8::from(old == 4));
    let path = |name: &str| folder.path().join(name);
    let scan = read_scan(&path("one.nrrd")).unwrap();
    let mut mesh = Mesh {
        vertices: scan.points().to_vec(),
        triangles: scan.triangles().to_vec(),
    };
    save_mesh(&path("one.stl"), &mesh).unwrap();
    let of_voxels = json(&folder, &["fit", "one.nrrd"]);
    let of_mesh = json(&folder, &["fit", "one.stl"]);
    assert_eq!(of_mesh["reference"]["kind"], "voxels");
    let same = |one: &Value, key: &str| {
        let share = number(one, key) / number(&of_voxels, key) - 1.0;
        assert!(share.abs() < 1e-5, "{key} {share}");
    };
    for key in ["area", "volume"] {
        same(&of_mesh, key);
    }
    let told = of_mesh["warnings"].to_string();
    assert!(told.contains("voxels of 0.5000 x 0.5000 x 1.000"), "{told}");
    let measured = json(&folder, &["measure", "one.stl", "--only", "area"]);
    assert_eq!(
        (&measured["of"], &measured["area"]),
        (&"voxels".into(), &Value::Null)
    );
    // Beside a smaller body, in voxels of its own.
    let before = mesh.vertices.len() as u32;
    let small = mesh
        .vertices
        .iter()
        .map(|place| place * 0.3 + Vector3::new(40.0, 0.0, 0.0));
    let small: Vec<_> = small.collect();
    let triangles = mesh
        .triangles
        .iter()
        .map(|corners| corners.map(|corner| corner + before));
    let triangles: Vec<_> = triangles.collect();
    mesh.vertices.extend(small);
    mesh.triangles.extend(triangles);
    save_mesh(&path("two.stl"), &mesh).unwrap();
    let largest = json(&folder, &["fit", "two.stl", "--largest"]);
    for key in ["area", "volume"] {
        same(&largest, key);
    }
}
