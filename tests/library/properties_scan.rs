//! What must hold of every reader and writer, whatever the bytes.

use grainform::Mesh;
use grainform::export::{write_obj, write_ply, write_points_ply, write_points_xyz, write_stl};
use grainform::scan::{Scan, parse_scan};
use nalgebra::Point3;
use proptest::prelude::*;

/// Points of a body: four corners that span space, and any others.
fn points() -> impl Strategy<Value = Vec<Point3<f64>>> {
    let coordinate = || prop_oneof![-1e3..1e3, Just(-0.0), Just(5_000_000.001), -1e-9..1e-9];
    let point = (coordinate(), coordinate(), coordinate()).prop_map(|(x, y, z)| [x, y, z].into());
    prop::collection::vec(point, 0..40).prop_map(|mut points: Vec<Point3<f64>>| {
        points.extend(mesh().vertices);
        points
    })
}

/// A tetrahedron wound outwards.
fn mesh() -> Mesh {
    let far = 2000.0;
    Mesh {
        vertices: [[0.0; 3], [far, 0.0, 0.0], [0.0, far, 0.0], [0.0, 0.0, far]]
            .map(Point3::from)
            .to_vec(),
        triangles: vec![[0, 2, 1], [0, 1, 3], [1, 2, 3], [0, 3, 2]],
    }
}

/// The tetrahedron in every format that is written.
fn files() -> Vec<(&'static str, Vec<u8>)> {
    let [mut stl, mut ply, mut obj, mut cloud, mut xyz] = [const { Vec::new() }; 5];
    let mesh = mesh();
    write_stl(&mesh, &mut stl).unwrap();
    write_ply(&mesh, &mut ply).unwrap();
    write_obj(&mesh, &mut obj).unwrap();
    write_points_ply(&mesh.vertices, &mut cloud).unwrap();
    write_points_xyz(&mesh.vertices, &mut xyz).unwrap();
    vec![
        ("stl", stl),
        ("ply", ply),
        ("obj", obj),
        ("ply", cloud),
        ("xyz", xyz),
    ]
}

fn check_invariants(scan: &Scan) {
    assert!(
        scan.points()
            .iter()
            .flat_map(|p| p.iter())
            .all(|c| c.is_finite())
    );
    let corners = scan.triangles().as_flattened();
    assert!(
        corners
            .iter()
            .all(|&corner| (corner as usize) < scan.points().len())
    );
    assert_eq!(scan.topology().is_some(), !scan.triangles().is_empty());
}

#[test]
fn a_file_cut_at_any_byte_is_refused_or_read_soundly() {
    for (extension, bytes) in files() {
        for end in 0..bytes.len() {
            if let Ok(scan) = parse_scan(&bytes[..end], Some(extension)) {
                check_invariants(&scan);
                let is_text = matches!(extension, "obj" | "xyz");
                assert!(is_text, "{extension} cut at {end} was read");
            }
        }
    }
}

#[test]
fn a_mesh_comes_back_from_every_format() {
    for (extension, bytes) in files() {
        let scan = parse_scan(&bytes, None).unwrap();
        assert_eq!(scan.warnings(), [""; 0], "{extension}");
        let same = |point: &Point3<f64>| mesh().vertices.contains(point);
        assert!(
            scan.points().len() == 4 && scan.points().iter().all(same),
            "{extension}"
        );
        if let Some(topology) = scan.topology() {
            assert!(topology.closed && topology.volume > 0.0, "{extension}");
        }
    }
}

#[test]
fn other_readers_understand_what_is_written() {
    let files = files();
    let stl = stl_io::read_stl(&mut std::io::Cursor::new(&files[0].1)).unwrap();
    stl.validate().unwrap();
    assert_eq!((stl.vertices.len(), stl.faces.len()), (4, 4));
    assert_eq!(stl.faces[2].normal.0, [1.0_f32 / 3.0_f32.sqrt(); 3]);
    let ply = ply_rs::parser::Parser::<ply_rs::ply::DefaultElement>::new()
        .read_ply(&mut &files[1].1[..])
        .unwrap();
    assert_eq!(
        (ply.payload["vertex"].len(), ply.payload["face"].len()),
        (4, 4)
    );
}

proptest! {
    #[test]
    fn points_survive_writing_and_reading(points in points()) {
        let (mut ply, mut xyz, mut obj) = (Vec::new(), Vec::new(), Vec::new());
        write_points_ply(&points, &mut ply).unwrap();
        write_points_xyz(&points, &mut xyz).unwrap();
        let mesh = Mesh { vertices: points.clone(), triangles: Vec::new() };
        write_obj(&mesh, &mut obj).unwrap();
        for bytes in [ply, xyz, obj] {
            let scan = parse_scan(&bytes, None).unwrap();
            prop_assert_eq!(scan.points(), &points[..]);
        }
    }

    #[test]
    fn meshes_survive_writing_and_reading(corners in prop::array::uniform4(
        prop::array::uniform3(-1000_i16..1000),
    )) {
        let mut mesh = mesh();
        mesh.vertices = corners.map(|corner| Point3::from(corner.map(f64::from))).to_vec();
        let [a, b, c, d] = corners.map(|corner| Point3::from(corner.map(f64::from)));
        let volume = (b - a).cross(&(c - a)).dot(&(d - a)) / 6.0;
        prop_assume!(volume.abs() > 1.0);
        let [mut stl, mut ply, mut obj] = [const { Vec::new() }; 3];
        write_stl(&mesh, &mut stl).unwrap();
        write_ply(&mesh, &mut ply).unwrap();
        write_obj(&mesh, &mut obj).unwrap();
        for bytes in [stl, ply, obj] {
            let scan = parse_scan(&bytes, None).unwrap();
            prop_assert!(scan.points().len() == 4 && scan.triangles().len() == 4);
            prop_assert!(scan.points().iter().all(|point| mesh.vertices.contains(point)));
            prop_assert_eq!(scan.warnings().is_empty(), volume > 0.0);
            let topology = scan.topology().unwrap();
            prop_assert!(topology.closed);
            prop_assert!((topology.volume - volume.abs()).abs() < 1e-6 * volume.abs());
        }
    }

    #[test]
    fn arbitrary_bytes_are_refused_or_read_soundly(
        bytes in prop::collection::vec(any::<u8>(), 0..300),
        extension in prop::sample::select(vec![None, Some("ply"), Some("stl"), Some("obj")]),
    ) {
        if let Ok(scan) = parse_scan(&bytes, extension) {
            check_invariants(&scan);
        }
    }

    #[test]
    fn files_with_one_byte_changed_are_refused_or_read_soundly(
        file in 0_usize..5,
        at in any::<prop::sample::Index>(),
        byte in any::<u8>(),
    ) {
        let (extension, mut bytes) = files().swap_remove(file);
        let at = at.index(bytes.len());
        bytes[at] = byte;
        if let Ok(scan) = parse_scan(&bytes, Some(extension)) {
            check_invariants(&scan);
        }
    }
}
