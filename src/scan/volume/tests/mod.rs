mod headers;

use super::*;
use crate::measure::mesh_properties;
use approx::assert_relative_eq;

/// Labels of an ellipsoid (7), a second body of one voxel (3), and what is around them.
fn labels(size: [usize; 3]) -> Vec<u8> {
    let [width, height, depth] = size;
    let middle = size.map(|side| side as f64 / 2.0 - 0.4);
    let voxels = (0..width * height * depth).map(|index| {
        let at = [
            index % width,
            index / width % height,
            index / (width * height),
        ];
        let squares =
            [0, 1, 2].map(|i| ((at[i] as f64 - middle[i]) / (0.4 * size[i] as f64)).powi(2));
        match squares.iter().sum::<f64>() < 1.0 {
            true => 7,
            false if index == 0 => 3,
            false => 0,
        }
    });
    voxels.collect()
}

const SIZE: [usize; 3] = [24, 20, 16];

fn read(name: &str, bytes: &[u8]) -> Volume {
    parse_volume(Path::new(name), bytes, 1 << 24)
        .unwrap()
        .unwrap()
}

fn properties(scan: &Scan) -> (f64, Point3<f64>) {
    let mesh = Mesh {
        vertices: scan.points().to_vec(),
        triangles: scan.triangles().to_vec(),
    };
    let found = mesh_properties(&mesh).unwrap();
    (found.volume, found.centroid)
}

/// The same image in each format, with steps of .5, 1 and 2 and its first voxel at (10, 20, 30) where that can be told.
fn formats() -> Vec<(&'static str, Vec<u8>, bool)> {
    let [width, height, depth] = SIZE;
    let voxels = labels(SIZE);
    let with = |head: &str| [head.as_bytes(), &voxels].concat();
    let wide: Vec<u8> = voxels
        .iter()
        .flat_map(|label| u16::from(*label).to_be_bytes())
        .collect();
    let nrrd = format!(
        "NRRD0004\n# by hand\ntype: unsigned short\ndimension: 3\nsizes: {width} {height} {depth}\nencoding: raw\n\
         endian: big\nspace directions: (0.5,0,0) (0,1,0) (0,0,2)\nspace origin: (10,20,30)\n\n"
    );
    let meta = format!(
        "ObjectType = Image\nNDims = 3\nDimSize = {width} {height} {depth}\nElementType = MET_UCHAR\n\
         ElementSpacing = 0.5 1 2\nOffset = 10 20 30\nElementDataFile = LOCAL\n"
    );
    let mut nifti = vec![0; 352];
    nifti[..4].copy_from_slice(&348_i32.to_le_bytes());
    for (at, short) in [3, width, height, depth].into_iter().enumerate() {
        nifti[40 + 2 * at..42 + 2 * at].copy_from_slice(&(short as i16).to_le_bytes());
    }
    nifti[70] = 2;
    nifti[254] = 1;
    let floats = [
        (108, 352.0),
        (280, 0.5),
        (292, 10.0),
        (300, 1.0),
        (308, 20.0),
        (320, 2.0),
        (324, 30.0),
    ];
    for (at, float) in floats {
        nifti[at..at + 4].copy_from_slice(&f32::to_le_bytes(float));
    }
    nifti[344..348].copy_from_slice(b"n+1\0");
    let shape = format!(
        "{{'descr': '|u1', 'fortran_order': False, 'shape': ({depth}, {height}, {width}), }}\n"
    );
    let mut npy = b"\x93NUMPY\x01\x00".to_vec();
    npy.extend((shape.len() as u16).to_le_bytes());
    npy.extend(shape.bytes().chain(voxels.clone()));
    let mut stack = std::io::Cursor::new(Vec::new());
    let mut encoder = ::tiff::encoder::TiffEncoder::new(&mut stack).unwrap();
    for slice in voxels.chunks(width * height) {
        let (width, height) = (width as u32, height as u32);
        encoder
            .write_image::<::tiff::encoder::colortype::Gray8>(width, height, slice)
            .unwrap();
    }
    vec![
        ("a.nrrd", [nrrd.as_bytes(), &wide].concat(), true),
        ("a.mha", with(&meta), true),
        ("a.nii", [&nifti[..], &voxels].concat(), true),
        ("a.npy", npy, false),
        ("a.tif", stack.into_inner(), false),
    ]
}

#[test]
fn every_format_gives_the_same_grain_with_its_spacing_and_origin() {
    for (name, bytes, is_placed) in formats() {
        let volume = read(name, &bytes);
        let counts = volume.labels().unwrap();
        assert_eq!(counts.keys().copied().collect::<Vec<_>>(), [3, 7], "{name}");
        let scan = volume.scan(Some(7)).unwrap();
        assert!(scan.topology().unwrap().closed, "{name}");
        let (volume, centroid) = properties(&scan);
        // The boundary cuts the corners of voxels.
        let voxels = counts[&7] as f64;
        assert_relative_eq!(volume, voxels, max_relative = 0.01);
        let middle = SIZE.map(|side| side as f64 / 2.0 - 0.4);
        let expected = match is_placed {
            true => [
                10.0 + 0.5 * middle[0],
                20.0 + middle[1],
                30.0 + 2.0 * middle[2],
            ],
            false => middle,
        };
        assert!(
            (centroid - Point3::from(expected)).amax() < 0.05,
            "{name}: {centroid}"
        );
        assert_eq!(
            scan.warnings().is_empty(),
            is_placed,
            "{name}: {:?}",
            scan.warnings()
        );
    }
}

#[test]
fn labels_are_listed_and_missing_ones_refused() {
    let (name, bytes, _) = formats().swap_remove(1);
    let volume = read(name, &bytes);
    let told = |label| volume.scan(label).unwrap_err().to_string();
    assert!(
        told(None).contains("labels: 3 (1 voxel), 7 ("),
        "{}",
        told(None)
    );
    assert!(told(Some(4)).starts_with("no voxel has the label 4; labels: 3"));
}

#[test]
fn headers_that_promise_too_much_are_refused() {
    for (name, bytes, _) in formats() {
        for end in [bytes.len() / 2, 400, 100, 20] {
            let found = parse_volume(Path::new(name), &bytes[..end], 1 << 24);
            assert!(!matches!(found, Ok(Some(_))), "{name} of {end} bytes");
        }
    }
    let head = "NRRD0004\ntype: double\ndimension: 3\nsizes: 4000000000 4000000000 4000000000\nencoding: raw\n\n";
    let found = parse_volume(Path::new("a.nrrd"), head.as_bytes(), 1 << 24);
    assert!(matches!(
        found,
        Err(ReadError::Volume {
            source: VolumeError::Size { .. },
            ..
        })
    ));
}

#[test]
fn grey_values_and_files_elsewhere_are_refused() {
    let text = "NRRD0004\ntype: float\ndimension: 3\nsizes: 1 1 1\nencoding: raw\n\n";
    let bytes = [text.as_bytes(), &0.5_f32.to_le_bytes()].concat();
    let found = read("a.nrrd", &bytes).labels();
    assert!(matches!(
        found,
        Err(VolumeError::GreyValues {
            index: 0,
            value: 0.5
        })
    ));
    let text =
        "NRRD0004\ntype: uchar\ndimension: 3\nsizes: 1 1 1\nencoding: raw\ndata file: ../a.raw\n\n";
    let found = parse_volume(Path::new("a.nhdr"), text.as_bytes(), 1 << 24);
    assert!(matches!(
        found,
        Err(ReadError::Volume {
            source: VolumeError::Elsewhere { .. },
            ..
        })
    ));
}

/// An ellipsoid of grey values that fall off outwards, with and without noise, and labels side by side.
#[test]
fn whole_numbers_that_are_grey_values_are_no_labels() {
    const SIDE: i32 = 24;
    let image = |value: &dyn Fn([i32; 3]) -> u8| {
        let places = (0..SIDE.pow(3)).map(|at| [at % SIDE, at / SIDE % SIDE, at / SIDE.pow(2)]);
        let voxels: Vec<u8> = places.map(value).collect();
        let head = "NRRD0004\ntype: uchar\ndimension: 3\nsizes: 24 24 24\nencoding: raw\n\n";
        read("a.nrrd", &[head.as_bytes(), &voxels].concat())
    };
    let share = |at: [i32; 3]| {
        let squares = at
            .map(|i| (f64::from(i) - 11.7).powi(2))
            .into_iter()
            .zip([1.0, 1.3, 1.6]);
        let radius = squares
            .map(|(square, factor)| square * factor)
            .sum::<f64>()
            .sqrt();
        (0.5 * (9.0 - radius)).clamp(-1.0, 1.0)
    };
    let noise = |[x, y, z]: [i32; 3]| ((7919 * x + 104_729 * y + 1_299_709 * z) % 101 % 9) as f64;
    for factor in [0.0, 1.0] {
        let grey = image(&|at| (100.0 + 90.0 * share(at) + factor * noise(at)) as u8 / 2 * 2 - 10);
        let found = grey.labels();
        assert!(
            matches!(found, Err(VolumeError::Scattered { .. })),
            "{found:?}"
        );
        assert!(grey.scan(Some(180)).is_err() && grey.grains().is_err());
    }
    let cells = image(&|[x, y, z]| (1 + x / 4 + 6 * (y / 4) + 36 * (z / 4)) as u8);
    assert_eq!(cells.labels().unwrap().len(), 216);
}

#[test]
fn the_second_version_of_nifti_is_named() {
    let mut header = vec![0; 540];
    header[..8].copy_from_slice(b"\x1c\x02\0\0n+2\0");
    let error = parse_volume(Path::new("a.nii"), &header, 1 << 20).unwrap_err();
    let ReadError::Volume { source, .. } = error else {
        panic!("{error}");
    };
    assert!(source.to_string().contains("NIfTI-2"), "{source}");
}

/// A slope of one, or one that says nothing, leaves labels as they are.
#[test]
fn scaled_numbers_of_nifti_are_refused() {
    let (_, plain, _) = formats().swap_remove(2);
    for (slope, offset, is_read) in [
        (0.0, 5.0, true),
        (1.0, 0.0, true),
        (f32::NAN, 0.0, true),
        (10.0, 0.0, false),
        (1.0, -1.0, false),
    ] {
        let mut bytes = plain.clone();
        bytes[112..116].copy_from_slice(&f32::to_le_bytes(slope));
        bytes[116..120].copy_from_slice(&f32::to_le_bytes(offset));
        let found = parse_volume(Path::new("a.nii"), &bytes, 1 << 24);
        assert_eq!(found.is_ok(), is_read, "{slope} {offset}");
    }
}

#[test]
fn what_headers_do_not_tell_or_tell_in_another_unit_is_warned_of() {
    let [width, height, depth] = SIZE;
    let told = |name: &str, head: String| {
        let bytes = [head.as_bytes(), &labels(SIZE)].concat();
        read(name, &bytes).warnings
    };
    let nrrd = |more: &str| {
        let sizes = format!("sizes: {width} {height} {depth}");
        told(
            "a.nrrd",
            format!("NRRD0004\ntype: uchar\ndimension: 3\n{sizes}\nencoding: raw\n{more}\n"),
        )
    };
    assert!(nrrd("")[0].contains("no spacing"));
    let spaced = "spacings: 1 1 2\nspace units: ";
    assert_eq!(nrrd("spacings: 1 1 2\n"), [""; 0]);
    assert_eq!(nrrd(&format!("{spaced}\"mm\" \"mm\" \"mm\"\n")), [""; 0]);
    let microns = nrrd(&format!("{spaced}\"um\" \"um\" \"um\"\n"));
    assert_eq!(
        microns,
        ["The image's lengths are in um, as its header says."]
    );
    let meta = format!(
        "DimSize = {width} {height} {depth}\nElementType = MET_UCHAR\nElementDataFile = LOCAL\n"
    );
    assert!(told("a.mha", meta)[0].contains("no spacing"));
    let (name, mut nifti, _) = formats().swap_remove(2);
    assert!(name.ends_with(".nii"));
    for (unit, warning) in [(2, None), (3, Some("in um")), (1, Some("in m,"))] {
        nifti[123] = unit;
        let told = read(name, &nifti).warnings.concat();
        assert!(
            warning.map_or(told.is_empty(), |part| told.contains(part)),
            "{told}"
        );
    }
}
