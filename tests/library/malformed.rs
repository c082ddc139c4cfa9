//! One small broken file per trap that a reader, or a library below it, once fell into.

use grainform::scan::{ParseError, ReadError, Scan, parse_scan, read_scan};
use nalgebra::Point3;

const AXES: &str = "property float x\nproperty float y\nproperty float z\n";
const BODY: &str = "0 0 0\n1 0 0\n0 1 0\n0 0 1\n";

fn text_ply(elements: &str, body: &str) -> Result<Scan, ParseError> {
    let text = format!("ply\nformat ascii 1.0\n{elements}end_header\n{body}");
    parse_scan(text.as_bytes(), Some("ply"))
}

fn binary_ply(elements: &str, body: &[u8]) -> Result<Scan, ParseError> {
    let header = format!("ply\nformat binary_little_endian 1.0\n{elements}end_header\n");
    parse_scan(&[header.as_bytes(), body].concat(), Some("ply"))
}

/// Four points as 32-bit numbers.
fn points() -> Vec<u8> {
    let rows = [
        [0.0_f32; 3],
        [1.0, 0.0, 0.0],
        [0.0, 1.0, 0.0],
        [0.0, 0.0, 1.0],
    ];
    rows.as_flattened()
        .iter()
        .flat_map(|c| c.to_le_bytes())
        .collect()
}

/// A binary STL of a tetrahedron whose header starts with the given bytes.
fn binary_stl(title: &[u8]) -> Vec<u8> {
    let corners = [
        [0.0_f32; 3],
        [1.0, 0.0, 0.0],
        [0.0, 1.0, 0.0],
        [0.0, 0.0, 1.0],
    ];
    let mut bytes = title.to_vec();
    bytes.resize(80, b' ');
    bytes.extend(4_u32.to_le_bytes());
    for face in [[0, 2, 1], [0, 1, 3], [1, 2, 3], [0, 3, 2]] {
        bytes.extend([0; 12]);
        bytes.extend(
            face.iter()
                .flat_map(|&i: &usize| corners[i])
                .flat_map(f32::to_le_bytes),
        );
        bytes.extend([0; 2]);
    }
    bytes
}

fn facet(corners: &str) -> String {
    format!("facet normal 0 0 0\nouter loop\n{corners}endloop\nendfacet\n")
}

fn text_stl(start: &str, end: &str) -> Result<Scan, ParseError> {
    let first = facet("vertex 0 0 0\nvertex 0 1 0\nvertex 1 0 0\n");
    let second = facet("vertex 0 0 0\nvertex 1 0 0\nvertex 0 0 1\n");
    parse_scan(
        format!("{start}\n{first}{second}{end}").as_bytes(),
        Some("stl"),
    )
}

#[test]
fn an_element_without_properties_does_not_fill_the_memory() {
    let empty = "element nothing 4000000000\n";
    let error = text_ply(&format!("element vertex 4\n{AXES}{empty}"), BODY).unwrap_err();
    assert!(error.to_string().contains("none in `nothing`"), "{error}");
    assert!(binary_ply(&format!("{empty}element vertex 4\n{AXES}"), &points()).is_err());
}

#[test]
fn an_element_declared_twice_does_not_replace_the_first() {
    let twice = format!("element vertex 4\n{AXES}element vertex 4000000000\n");
    assert!(binary_ply(&twice, &points()).is_err());
    let error = text_ply(&format!("{twice}{AXES}"), BODY).unwrap_err();
    assert!(error.to_string().starts_with("line 7:"), "{error}");
}

#[test]
fn counts_beyond_the_file_are_refused_at_once() {
    for count in [
        "4294967295",
        "18446744073709551615",
        "99999999999999999999999999",
    ] {
        let elements = format!("element vertex {count}\n{AXES}");
        assert!(binary_ply(&elements, &points()).is_err(), "{count}");
        assert!(text_ply(&elements, BODY).is_err(), "{count}");
    }
    let mut stl = binary_stl(b"");
    stl[80..84].copy_from_slice(&u32::MAX.to_le_bytes());
    assert!(matches!(
        parse_scan(&stl, None),
        Err(ParseError::Unknown { .. })
    ));
    assert!(matches!(
        parse_scan(&stl, Some("stl")),
        Err(ParseError::CountTooLarge { .. })
    ));
}

#[test]
fn list_lengths_beyond_the_file_and_below_zero_are_refused() {
    for (length_type, length) in [("uint", 4_000_000_000_u32), ("int", u32::MAX - 4)] {
        let list = format!("element face 1\nproperty list {length_type} int vertex_indices\n");
        let body = [points(), length.to_le_bytes().to_vec()].concat();
        assert!(binary_ply(&format!("element vertex 4\n{AXES}{list}"), &body).is_err());
        let body = format!("{BODY}{} 0 1 2\n", length.cast_signed());
        assert!(text_ply(&format!("element vertex 4\n{AXES}{list}"), &body).is_err());
    }
}

#[test]
fn every_scalar_type_serves_as_a_coordinate() {
    let types = [
        "char", "uchar", "short", "ushort", "int", "uint", "float", "double",
    ];
    for kind in types {
        let axes = AXES.replace("float", kind);
        let number = |value: u8| match kind {
            "char" | "uchar" => vec![value],
            "short" | "ushort" => vec![value, 0],
            "int" | "uint" => vec![value, 0, 0, 0],
            "float" => f32::from(value).to_le_bytes().to_vec(),
            _ => f64::from(value).to_le_bytes().to_vec(),
        };
        let rows = [0, 0, 0, 7, 0, 0, 0, 8, 0, 0, 0, 9]
            .into_iter()
            .flat_map(number);
        let body: Vec<u8> = rows.collect();
        let scan = binary_ply(&format!("element vertex 4\n{axes}"), &body).unwrap();
        assert_eq!(
            scan.points()[1..3],
            [[7.0, 0.0, 0.0], [0.0, 8.0, 0.0]].map(Point3::from)
        );
    }
}

#[test]
fn not_a_number_is_refused_in_every_format_where_a_face_has_it() {
    let mut body = points();
    body[12..16].copy_from_slice(&f32::NAN.to_le_bytes());
    let cloud = format!("element vertex 4\n{AXES}");
    let mesh = format!("{cloud}element face 1\nproperty list uchar uchar vertex_indices\n");
    let scan = binary_ply(&cloud, &body).unwrap();
    assert!(scan.points().len() == 3 && scan.warnings()[0].starts_with("Dropped 1 point "));
    let with_face = [&body[..], &[3, 0, 1, 2]].concat();
    let error = binary_ply(&mesh, &with_face).unwrap_err();
    assert!(error.to_string().starts_with("point 1 "), "{error}");
    let with_face = BODY.replace('1', "nan") + "3 0 1 2\n";
    let error = text_ply(&mesh, &with_face).unwrap_err();
    assert!(error.to_string().starts_with("point 1 "), "{error}");
    let mut stl = binary_stl(b"");
    stl[84 + 50 + 12..][..4].copy_from_slice(&f32::INFINITY.to_le_bytes());
    let error = parse_scan(&stl, None).unwrap_err();
    assert!(error.to_string().starts_with("facet 1 "), "{error}");
    assert!(parse_scan(b"v 0 0 inf\n", None).is_err());
}

#[test]
fn remarks_in_another_encoding_are_passed_over() {
    let header = b"ply\nformat ascii 1.0\ncomment \xe9t\xe9\nobj_info\nelement vertex 4\n";
    let bytes = [header, AXES.as_bytes(), b"end_header\n", BODY.as_bytes()].concat();
    assert_eq!(parse_scan(&bytes, None).unwrap().points().len(), 4);
}

#[test]
fn text_stl_is_read_in_every_legal_dress() {
    for start in [
        "solid",
        "SOLID A",
        " \tsolid",
        "solid \u{e9}",
        "solid facet normal",
    ] {
        assert_eq!(
            text_stl(start, "endsolid").unwrap().triangles().len(),
            2,
            "{start}"
        );
    }
    let second = facet("vertex 0 0 0\nvertex 0 0 1\nvertex 0 1 0\n");
    let two = text_stl(
        "solid a",
        &format!("endsolid a\nsolid b\n{second}endsolid b\n"),
    );
    assert_eq!(two.unwrap().triangles().len(), 3);
    assert!(text_stl("solid", "").unwrap().warnings()[0].contains("endsolid"));
    assert!(text_stl("solid", "facet normal 0 0 0\n").is_err());
}

#[test]
fn a_binary_stl_may_start_with_solid_and_end_with_spare_bytes() {
    for title in [&b"solid part1\n"[..], b"solid", b"solid\xff facet normal"] {
        let mut bytes = binary_stl(title);
        let scan = parse_scan(&bytes, None).unwrap();
        assert_eq!((scan.points().len(), scan.warnings().len()), (4, 0));
        bytes.push(0);
        let scan = parse_scan(&bytes, Some("stl")).unwrap();
        assert_eq!((scan.points().len(), scan.warnings().len()), (4, 1));
    }
}

#[test]
fn a_whole_solid_is_closed_and_wound_outwards() {
    let scan = parse_scan(&binary_stl(b""), None).unwrap();
    let topology = scan.topology().unwrap();
    assert!(topology.closed && topology.volume > 0.16);
    assert_eq!(scan.warnings(), [""; 0]);
}

#[test]
fn flat_points_are_read_with_a_warning() {
    let scan = parse_scan(b"0 0 0\n1 0 0\n0 1 0\n1 1 0", None).unwrap();
    assert!(
        scan.warnings()[0].contains("one plane"),
        "{:?}",
        scan.warnings()
    );
}

#[test]
fn a_faraway_scan_keeps_its_digits() {
    let text = "5000000.001 0 0\n5000000.002 1 0\n5000000.003 0 1\n5000000.004 1 1.5\n";
    let ply = text_ply(&format!("element vertex 4\n{AXES}"), text).unwrap();
    let xyz = parse_scan(text.as_bytes(), Some("xyz")).unwrap();
    assert_eq!(ply.points(), xyz.points());
    assert_eq!(xyz.points()[0].x, 5_000_000.001);
}

#[test]
fn errors_of_files_name_the_file() {
    let missing = std::path::Path::new("no/such/scan.ply");
    let error = read_scan(missing).unwrap_err();
    assert!(matches!(error, ReadError::Io { .. }));
    assert_eq!(error.to_string(), "cannot read the file no/such/scan.ply");
    let manifest = std::path::Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/Cargo.toml"));
    let error = read_scan(manifest).unwrap_err();
    assert!(matches!(error, ReadError::Parse { .. }), "{error}");
    assert!(error.to_string().ends_with("Cargo.toml"), "{error}");
}
