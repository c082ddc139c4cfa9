use super::*;
use crate::scan::Scan;

/// A stack of slices of 12 x 10 samples, the least byte first, made by hand.
#[derive(Clone, Copy)]
struct Stack<'a> {
    slices: &'a [Vec<u8>],
    bits: u16,
    /// 0 where white is zero, 1 where black is, 3 of colours in a table.
    interpretation: u32,
    description: &'a [u8],
    /// Pixels per unit, along x and y.
    resolution: Option<[u32; 2]>,
}

const WIDTH: usize = 12;
const HEIGHT: usize = 10;
const DEPTH: usize = 9;

impl Stack<'_> {
    fn bytes(&self) -> Vec<u8> {
        let mut file = b"II*\0\0\0\0\0".to_vec();
        let mut link = 4;
        for slice in self.slices {
            let mut put = |bytes: &[u8]| {
                let at = file.len() as u32;
                file.extend(bytes);
                file.resize(file.len().next_multiple_of(4), 0);
                at
            };
            let text = [self.description, b"\0"].concat();
            let (text_at, samples_at) = (put(&text), put(slice));
            // Tag, type (2 text, 3 short, 4 long, 5 rational), count, value or where it is.
            let mut entries: Vec<[u32; 4]> = vec![
                [256, 3, 1, WIDTH as u32],
                [257, 3, 1, HEIGHT as u32],
                [258, 3, 1, self.bits.into()],
                [259, 3, 1, 1],
                [262, 3, 1, self.interpretation],
                [270, 2, text.len() as u32, text_at],
                [273, 4, 1, samples_at],
                [277, 3, 1, 1],
                [278, 3, 1, HEIGHT as u32],
                [279, 4, 1, slice.len() as u32],
            ];
            for (tag, per_unit) in [282, 283]
                .into_iter()
                .zip(self.resolution.into_iter().flatten())
            {
                let at = put(&[per_unit.to_le_bytes(), 1_u32.to_le_bytes()].concat());
                entries.push([tag, 5, 1, at]);
            }
            let at = file.len() as u32;
            file[link..link + 4].copy_from_slice(&at.to_le_bytes());
            file.extend((entries.len() as u16).to_le_bytes());
            for [tag, kind, count, value] in entries {
                file.extend((tag as u16).to_le_bytes());
                file.extend((kind as u16).to_le_bytes());
                file.extend(count.to_le_bytes());
                file.extend(value.to_le_bytes());
            }
            link = file.len();
            file.extend([0; 4]);
        }
        file
    }

    fn read(&self) -> Result<Volume, VolumeError> {
        parse(&self.bytes(), 1 << 20)
    }
}

/// A box of 10 x 8 x 7 voxels with a margin of 1.
fn is_inside(x: usize, y: usize, z: usize) -> bool {
    (1..WIDTH - 1).contains(&x) && (1..HEIGHT - 1).contains(&y) && (1..DEPTH - 1).contains(&z)
}

fn slices(label: u8) -> Vec<Vec<u8>> {
    let slice = |z| {
        let places = (0..HEIGHT).flat_map(|y| (0..WIDTH).map(move |x| (x, y)));
        let labels = places.map(|(x, y)| label * u8::from(is_inside(x, y, z)));
        labels.collect()
    };
    (0..DEPTH).map(slice).collect()
}

fn described<'a>(slices: &'a [Vec<u8>], description: &'a (impl AsRef<[u8]> + ?Sized)) -> Stack<'a> {
    Stack {
        slices,
        bits: 8,
        interpretation: 1,
        description: description.as_ref(),
        resolution: None,
    }
}

fn extent(scan: &Scan) -> Vector3<f64> {
    let first = scan.points()[0];
    let ends = scan
        .points()
        .iter()
        .fold((first, first), |(low, high), point| {
            (low.inf(point), high.sup(point))
        });
    ends.1 - ends.0
}

/// Box of the label's voxels, and what is told of it.
const SIDES: [f64; 3] = [10.0, 8.0, 7.0];

#[test]
fn the_spacing_of_imagej_and_of_ome_is_read_with_its_unit() {
    let slices = slices(5);
    let imagej = "ImageJ=1.53t\nimages=9\nslices=9\nunit=\\u00B5m\nspacing=3\n";
    let ome = "<?xml version='1.0'?><OME><Image><Pixels SizeC='1' SizeT='1' SizeZ='9' PhysicalSizeX='.5' \
               PhysicalSizeY='.25' PhysicalSizeZ='3'/></Image></OME>";
    let latin = b"ImageJ=1\nimages=9\nslices=9\nunit=\xb5m\nspacing=3\n";
    let told = [
        (&latin[..], Some([2, 4])),
        (imagej.as_bytes(), Some([2, 4])),
        (ome.as_bytes(), None),
    ];
    for (description, resolution) in told {
        let stack = Stack {
            resolution,
            ..described(&slices, description)
        };
        let volume = stack.read().unwrap();
        assert_eq!(volume.unit(), Some("um"));
        assert_eq!(
            volume.warnings,
            ["The image's lengths are in um, as its header says."]
        );
        let steps = Vector3::new(0.5, 0.25, 3.0);
        let sides = Vector3::from(SIDES).component_mul(&steps);
        assert_eq!(
            extent(&volume.scan(Some(5)).unwrap()),
            sides,
            "{}",
            description.escape_ascii()
        );
    }
}

#[test]
fn what_is_not_told_of_spacing_is_said_as_it_is() {
    let slices = slices(5);
    let cases = [
        ("", None, NO_SPACING),
        ("", Some([1, 1]), NO_SPACING),
        ("", Some([72, 72]), NO_DEPTH),
        (
            "ImageJ=1\nimages=9\nslices=9\nunit=um\n",
            Some([2, 2]),
            NO_DEPTH,
        ),
        ("ImageJ=1\nslices=9\nspacing=2\nunit=um\n", None, INCOMPLETE),
        (
            "<Pixels PhysicalSizeX='2' PhysicalSizeY='2'>",
            None,
            INCOMPLETE,
        ),
    ];
    for (description, resolution, warning) in cases {
        let stack = Stack {
            resolution,
            ..described(&slices, description)
        };
        let volume = stack.read().unwrap();
        assert_eq!(volume.warnings, [warning], "{description}");
        assert_eq!(volume.unit(), None, "{description}");
        assert_eq!(extent(&volume.scan(None).unwrap()), Vector3::from(SIDES));
    }
}

#[test]
fn hyperstacks_and_stacks_without_all_their_slices_are_refused() {
    let slices = slices(5);
    let hyperstack = described(&slices, "ImageJ=1\nimages=8\nchannels=2\nslices=4\n").read();
    assert_eq!(
        hyperstack,
        Err(VolumeError::Hyperstack {
            channels: 2,
            times: 1
        })
    );
    let cut = described(&slices[..1], "ImageJ=1\nimages=9\nslices=9\n").read();
    assert_eq!(
        cut,
        Err(VolumeError::Slices {
            promised: 9,
            found: 1
        })
    );
    let times = described(&slices, "ImageJ=1\nimages=9\nframes=9\n")
        .read()
        .unwrap();
    assert!(
        times.warnings[1].contains("taken as a slice along z"),
        "{:?}",
        times.warnings
    );
}

#[test]
fn labels_are_the_numbers_that_are_stored() {
    let labels = |stack: &Stack<'_>| stack.read().unwrap().labels().unwrap();
    let voxels = 10 * 8 * 7;
    let slices = slices(5);
    let stack = described(&slices, "");
    assert_eq!(labels(&stack), [(5, voxels)].into());
    for interpretation in [0, 3] {
        let shown = Stack {
            interpretation,
            ..stack
        };
        assert_eq!(labels(&shown), [(5, voxels)].into());
    }
    // A row of 12 bits takes two bytes.
    let rows = |z| {
        (0..HEIGHT).flat_map(move |y| {
            let row = (0..WIDTH)
                .filter(|x| is_inside(*x, y, z))
                .fold(0_u16, |row, x| row | 1 << (15 - x));
            row.to_be_bytes()
        })
    };
    let packed: Vec<Vec<u8>> = (0..DEPTH).map(|z| rows(z).collect()).collect();
    for interpretation in [0, 1] {
        let stack = Stack {
            bits: 1,
            interpretation,
            ..described(&packed, "")
        };
        assert_eq!(labels(&stack), [(1, voxels)].into());
    }
}

#[test]
fn large_files_are_read_and_the_limit_is_named() {
    let mut file = Cursor::new(Vec::new());
    let mut encoder = ::tiff::encoder::TiffEncoder::new_big(&mut file).unwrap();
    for slice in slices(5) {
        encoder
            .write_image::<::tiff::encoder::colortype::Gray8>(WIDTH as u32, HEIGHT as u32, &slice)
            .unwrap();
    }
    let bytes = file.into_inner();
    assert!(is_it(&bytes));
    assert_eq!(
        parse(&bytes, 1 << 20).unwrap().labels().unwrap(),
        [(5, 560)].into()
    );
    for limit in [100, 1000] {
        assert_eq!(parse(&bytes, limit), Err(VolumeError::TooLarge { limit }));
    }
}

#[test]
fn damaged_files_are_told_in_plain_words() {
    let slices = slices(5);
    let whole = described(&slices, "").bytes();
    let told = |bytes: &[u8]| parse(bytes, 1 << 20).unwrap_err().to_string();
    let part = told(&whole[..whole.len() / 2]);
    assert!(
        part.contains("it ends before all of them are told"),
        "{part}"
    );
    let of_tag = |tag: u16, value: u16| {
        let entry = [tag.to_le_bytes(), 3_u16.to_le_bytes()].concat();
        let at = whole.windows(4).position(|bytes| bytes == entry).unwrap();
        let mut changed = whole.clone();
        changed[at + 8..at + 10].copy_from_slice(&value.to_le_bytes());
        told(&changed)
    };
    let unknown = of_tag(262, 999);
    assert!(
        unknown.contains("they are stored in a way that is not read here"),
        "{unknown}"
    );
    let packed = of_tag(259, 7);
    assert!(!packed.contains("unsupported error"), "{packed}");
}
