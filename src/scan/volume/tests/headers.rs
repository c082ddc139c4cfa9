//! What headers tell, and files beyond it.

use super::*;

/// An NRRD image of bytes with these lines in its header.
fn nrrd(lines: &str, voxels: &[u8]) -> Result<Volume, VolumeError> {
    let head = format!("NRRD0004\ntype: uchar\n{lines}\n\n");
    of("a.nrrd", &[head.as_bytes(), voxels].concat())
}

/// A MetaImage of bytes of this size with these lines in its header, with no name that tells what it is.
fn meta(lines: &str, voxels: &[u8]) -> Result<Volume, VolumeError> {
    let [width, height, depth] = SIZE;
    let head = format!(
        "NDims = 3\nDimSize = {width} {height} {depth}\nElementType = MET_UCHAR\n{lines}\nElementDataFile = Local\n"
    );
    of("standard input", &[head.as_bytes(), voxels].concat())
}

fn of(name: &str, bytes: &[u8]) -> Result<Volume, VolumeError> {
    match parse_volume(Path::new(name), bytes, 1 << 24) {
        Ok(volume) => Ok(volume.expect("an image")),
        Err(ReadError::Volume { source, .. }) => Err(source),
        Err(other) => panic!("{other}"),
    }
}

#[test]
fn ends_of_axes_are_their_spacing_and_place() {
    let read = |lines: &str| {
        let [width, height, depth] = SIZE;
        let head = format!("dimension: 3\nsizes: {width} {height} {depth}\nencoding: raw");
        nrrd(&format!("{head}\n{lines}"), &labels(SIZE)).unwrap()
    };
    let (steps, lows) = (Vector3::new(0.5, 1.0, 2.0), Vector3::new(5.0, -7.0, 9.0));
    let of_nodes = "axis maxs: 16.5 12 39\ncenterings: node node node";
    let cases = [
        ("axis maxs: 17 13 41\ncenterings: cell cell cell", 0.5, None),
        (of_nodes, 0.0, None),
        ("axis maxs: 17 13 41", 0.5, Some("no centerings")),
        ("spacings: 0.5 1 2\ncenters: cell cell cell", 0.5, None),
        ("spacings: 0.5 1 2", 0.5, Some("no centerings")),
    ];
    for (lines, share, warning) in cases {
        let volume = read(&format!("axis mins: 5 -7 9\n{lines}"));
        assert_relative_eq!(
            volume.steps,
            Matrix3::from_diagonal(&steps),
            epsilon = 1e-12
        );
        assert_relative_eq!(volume.origin.coords, lows + share * steps, epsilon = 1e-12);
        let told = volume.warnings.concat();
        assert!(
            warning.map_or(told.is_empty(), |part| told.contains(part)),
            "{lines}: {told}"
        );
    }
    let both = read("spacings: 0.5 1 2\naxis mins: 5 -7 9\nspace origin: (1,2,3)");
    assert_eq!(both.origin, Point3::new(1.0, 2.0, 3.0));
    assert!(both.warnings.is_empty());
    let none = read("axis mins: 5 -7 9\nunits: \"um\" \"um\" \"um\"");
    assert!(none.warnings[0].contains("no spacing"));
    assert_eq!((none.origin, none.unit()), (Point3::origin(), None));
}

#[test]
fn an_axis_of_one_voxel_beside_three_is_left_out() {
    let [width, height, depth] = SIZE;
    let read = |sizes: &str, lines: &str| {
        let head = format!("dimension: 4\nsizes: {sizes}\nEncoding: RAW\n{lines}");
        nrrd(&head, &labels(SIZE))
    };
    let first = format!("1 {width} {height} {depth}");
    let last = format!("{width} {height} {depth} 1");
    let cases = [
        (&first, "space directions: none (0.5,0,0) (0,1,0) (0,0,2)"),
        (&last, "space directions: (0.5,0,0) (0,1,0) (0,0,2) none"),
        (
            &last,
            "spacings: 0.5 1 2 nan\nunits: \"mm\" \"mm\" \"mm\" \"s\"",
        ),
    ];
    for (sizes, lines) in cases {
        let volume = read(sizes, lines).unwrap();
        assert_eq!(volume.size, SIZE);
        assert_eq!(
            volume.steps,
            Matrix3::from_diagonal(&Vector3::new(0.5, 1.0, 2.0))
        );
        assert_eq!(volume.warnings, [""; 0]);
    }
    let two = format!("{width} {height} {} 2", depth / 2);
    assert!(matches!(
        read(&two, "spacings: 1 1 1 1"),
        Err(VolumeError::Unsupported { .. })
    ));
    let units = read(
        &last,
        "spacings: 1 1 1 1\nunits: \"mm\" \"mm\" \"um\" \"s\"",
    );
    assert!(
        matches!(units, Err(VolumeError::SeveralUnits { .. })),
        "{units:?}"
    );
}

#[test]
fn a_metaimage_is_known_by_its_content_and_refused_as_text() {
    let voxels = labels(SIZE);
    let volume = meta("ElementSpacing = 1 1 1\nDistanceUnits = um", &voxels).unwrap();
    assert_eq!(
        volume.labels().unwrap().keys().copied().collect::<Vec<_>>(),
        [3, 7]
    );
    assert_eq!(volume.unit(), Some("um"));
    let text = meta("BinaryData = False", b"0 0 0 1")
        .unwrap_err()
        .to_string();
    assert!(
        text.contains("as text (BinaryData = False) is not read here"),
        "{text}"
    );
    let other = of(
        "-",
        b"ObjectType = Mesh\nNDims = 3\nElementDataFile = LOCAL\n",
    );
    assert!(
        matches!(other, Err(VolumeError::Unsupported { .. })),
        "{other:?}"
    );
}

#[test]
fn bytes_that_are_left_over_are_told() {
    let spaced = "ElementSpacing = 1 1 1";
    let mut voxels = labels(SIZE);
    assert_eq!(meta(spaced, &voxels).unwrap().warnings, [""; 0]);
    voxels.push(b'\n');
    let warnings = meta(spaced, &voxels).unwrap().warnings;
    assert_eq!(
        warnings,
        ["Left 1 byte unread after the voxels that the header counts."]
    );
    voxels.pop();
    let [width, height, depth] = SIZE;
    let head =
        format!("dimension: 3\nsizes: {width} {height} {depth}\nencoding: raw\nspacings: 1 1 1");
    for (times, word) in [(2, "twice"), (3, ""), (4, "four times"), (8, "eight times")] {
        let told = nrrd(&head, &voxels.repeat(times))
            .unwrap()
            .warnings
            .concat();
        assert!(
            told.starts_with(&format!("Left {} bytes", (times - 1) * voxels.len())),
            "{told}"
        );
        assert_eq!(
            told.contains("type of numbers may be wrong"),
            times != 3,
            "{told}"
        );
        assert!(told.contains(word), "{told}");
    }
}

#[test]
fn the_limit_of_what_is_unpacked_is_named() {
    use std::io::Write;
    let voxels = labels(SIZE);
    let mut zlib = flate2::write::ZlibEncoder::new(Vec::new(), flate2::Compression::best());
    zlib.write_all(&voxels).unwrap();
    let mut gzip = flate2::write::GzEncoder::new(Vec::new(), flate2::Compression::best());
    gzip.write_all(&voxels).unwrap();
    let [width, height, depth] = SIZE;
    let meta = format!(
        "NDims = 3\nDimSize = {width} {height} {depth}\nElementType = MET_UCHAR\nCompressedData = True\n\
         ElementDataFile = LOCAL\n"
    );
    let nrrd = format!(
        "NRRD0004\ntype: uchar\ndimension: 3\nsizes: {width} {height} {depth}\nencoding: gzip\n\n"
    );
    let files = [
        ("a.mha", [meta.as_bytes(), &zlib.finish().unwrap()].concat()),
        (
            "a.nrrd",
            [nrrd.as_bytes(), &gzip.finish().unwrap()].concat(),
        ),
    ];
    for (name, bytes) in files {
        let all = voxels.len() as u64;
        assert!(parse_volume(Path::new(name), &bytes, all).is_ok(), "{name}");
        let Err(ReadError::Volume { source, .. }) = parse_volume(Path::new(name), &bytes, all - 1)
        else {
            panic!("{name} is read beyond the limit");
        };
        assert_eq!(source, VolumeError::TooLarge { limit: all - 1 });
        assert!(source.to_string().contains("--max-bytes"));
    }
}
