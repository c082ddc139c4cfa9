//! What the description of a stack tells of it: that of ImageJ, lines `key=value`, that of OME, XML, and the shape of the
//! array that it was.

use crate::scan::volume::{VolumeError, unit};
use nalgebra::Vector3;

/// What a description tells; that of other programs tells nothing.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Description {
    /// Numbers per voxel, each in an image of its own.
    channels: usize,
    times: usize,
    slices: usize,
    /// All images.
    images: usize,
    pub(super) spacing: Spacing,
    pub(super) unit: Option<String>,
}

/// Steps between voxels.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Spacing {
    Untold,
    /// That of slices; within them it is in tags of the file.
    Depth(f64),
    /// Along all axes.
    All(Vector3<f64>),
    /// Not a length above zero along each axis.
    Incomplete,
}

impl Description {
    /// # Errors
    /// [`VolumeError`] where there is more than a stack can hold, or axes are in several units.
    pub(super) fn of(text: &str) -> Result<Self, VolumeError> {
        let told = match text.split("<Pixels").skip(1).collect::<Vec<_>>()[..] {
            _ if text.starts_with("ImageJ=") => Self::of_imagej(text),
            [] => Self::default(),
            [pixels] => Self::of_ome(pixels.split('>').next().unwrap_or_default())?,
            _ => {
                let what = "an OME-TIFF of several images".into();
                return Err(VolumeError::Unsupported { what });
            }
        };
        if axes_of_slices(text) > 1 {
            let what = "a TIFF stack of an array with more than three axes".into();
            return Err(VolumeError::Unsupported { what });
        }
        let counts = [told.channels, told.times, told.slices];
        match counts.iter().filter(|count| **count > 1).count() {
            0 | 1 => Ok(told),
            _ => Err(VolumeError::Hyperstack {
                channels: told.channels,
                times: told.times,
            }),
        }
    }

    fn of_imagej(text: &str) -> Self {
        let value = |key: &str| {
            let mut pairs = text.lines().filter_map(|line| line.split_once('='));
            pairs.find_map(|(own, value)| (own == key).then_some(value.trim()))
        };
        let count = |key| value(key).and_then(|text| text.parse().ok()).unwrap_or(1);
        Self {
            channels: count("channels"),
            times: count("frames"),
            slices: count("slices"),
            images: count("images"),
            spacing: match value("spacing") {
                None => Spacing::Untold,
                Some(depth) => length(depth).map_or(Spacing::Incomplete, Spacing::Depth),
            },
            unit: value("unit").and_then(unit::of),
        }
    }

    /// Of what stands between `<Pixels` and `>`.
    fn of_ome(pixels: &str) -> Result<Self, VolumeError> {
        let value = |key: &str| attribute(pixels, key);
        let count = |key| value(key).and_then(|text| text.parse().ok()).unwrap_or(1);
        let [channels, times, slices] = ["SizeC", "SizeT", "SizeZ"].map(count);
        let sizes = ["PhysicalSizeX", "PhysicalSizeY", "PhysicalSizeZ"].map(value);
        let spacing = match sizes.map(|size| size.and_then(length)) {
            [Some(x), Some(y), Some(z)] => Spacing::All(Vector3::new(x, y, z)),
            _ if sizes == [None; 3] => Spacing::Untold,
            _ => Spacing::Incomplete,
        };
        let units = [
            "PhysicalSizeXUnit",
            "PhysicalSizeYUnit",
            "PhysicalSizeZUnit",
        ];
        let unit = match spacing {
            Spacing::All(_) => unit::common(units.map(|key| value(key).unwrap_or("um")))?,
            _ => None,
        };
        Ok(Self {
            channels,
            times,
            slices,
            images: [channels, times, slices]
                .into_iter()
                .fold(1, usize::saturating_mul),
            spacing,
            unit,
        })
    }

    /// Refuses a file that has fewer slices than it promises.
    pub(super) fn check_slices(&self, found: usize) -> Result<(), VolumeError> {
        let promised = self.images;
        match promised > found {
            true => Err(VolumeError::Slices { promised, found }),
            false => Ok(()),
        }
    }

    /// What is told where slices are none of z.
    pub(super) fn warning(&self) -> Option<&'static str> {
        match (self.channels > 1, self.times > 1) {
            (true, _) => {
                Some("The TIFF stack has channels and no slices: each is taken as a slice along z.")
            }
            (_, true) => {
                Some("The TIFF stack has times and no slices: each is taken as a slice along z.")
            }
            _ => None,
        }
    }
}

impl Default for Description {
    fn default() -> Self {
        Self {
            channels: 1,
            times: 1,
            slices: 1,
            images: 1,
            spacing: Spacing::Untold,
            unit: None,
        }
    }
}

/// Of an array, `{"shape": [2, 40, 60, 80]}`, the axes along which there are several slices.
fn axes_of_slices(text: &str) -> usize {
    let shape = text
        .strip_prefix("{\"shape\": [")
        .and_then(|rest| rest.split(']').next());
    let sides: Vec<&str> = shape.map_or(Vec::new(), |shape| shape.split(',').collect());
    let of_slices = sides.iter().rev().skip(2);
    of_slices.filter(|side| side.trim() != "1").count()
}

fn length(text: &str) -> Option<f64> {
    let length = text.parse().ok();
    length.filter(|length: &f64| *length > 0.0 && length.is_finite())
}

/// The value of ` name="value"`.
fn attribute<'a>(element: &'a str, name: &str) -> Option<&'a str> {
    element.match_indices(name).find_map(|(at, _)| {
        let is_whole = element[..at].ends_with(char::is_whitespace);
        let rest = element[at + name.len()..].trim_start().strip_prefix('=')?;
        let rest = rest.trim_start();
        let quote = rest
            .chars()
            .next()
            .filter(|c| is_whole && "\"'".contains(*c))?;
        rest[1..].split_once(quote).map(|(value, _)| value)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn ome(attributes: &str) -> Result<Description, VolumeError> {
        let sizes = "SizeX='4' SizeY='3' SizeZ='2'";
        Description::of(&format!(
            "<OME><Image><Pixels {sizes} {attributes}><Channel/></Pixels></Image></OME>"
        ))
    }

    #[test]
    fn spacing_and_unit_of_ome_are_read() {
        let told = ome("PhysicalSizeX=\".5\" PhysicalSizeY='1' PhysicalSizeZ = \"2\"").unwrap();
        let spacing = Spacing::All(Vector3::new(0.5, 1.0, 2.0));
        assert_eq!((told.spacing, told.unit.as_deref()), (spacing, Some("um")));
        assert_eq!((told.slices, told.images), (2, 2));
        let in_mm = ["X", "Y", "Z"]
            .map(|axis| format!("PhysicalSize{axis}Unit='mm' PhysicalSize{axis}='3'"));
        let told = ome(&in_mm.join("\n")).unwrap();
        assert_eq!(told.spacing, Spacing::All(Vector3::repeat(3.0)));
        assert_eq!(told.unit.as_deref(), Some("mm"));
        let several = ome(&in_mm.join(" ").replacen("mm", "um", 1));
        let units = vec!["um".into(), "mm".into()];
        assert_eq!(several, Err(VolumeError::SeveralUnits { units }));
        for part in [
            "PhysicalSizeX='1' PhysicalSizeY='1'",
            "PhysicalSizeX='0' PhysicalSizeY='1' PhysicalSizeZ='1'",
        ] {
            assert_eq!(ome(part).unwrap().spacing, Spacing::Incomplete);
        }
        assert_eq!(ome("").unwrap().spacing, Spacing::Untold);
    }

    #[test]
    fn stacks_of_several_channels_or_times_are_refused() {
        let refused = |channels, times| Err(VolumeError::Hyperstack { channels, times });
        assert_eq!(ome("SizeC='2' SizeT='1'"), refused(2, 1));
        assert_eq!(ome("SizeC='1' SizeT='3'"), refused(1, 3));
        let imagej = |lines: &str| Description::of(&format!("ImageJ=1.53t\nimages=4\n{lines}"));
        assert_eq!(
            imagej("channels=2\nslices=2\nhyperstack=true"),
            refused(2, 1)
        );
        assert_eq!(imagej("slices=2\nframes=2"), refused(1, 2));
        let two = Description::of("<Pixels SizeZ='2'/><Pixels SizeZ='2'/>");
        assert!(
            matches!(two, Err(VolumeError::Unsupported { .. })),
            "{two:?}"
        );
        let shape = |sides: &str| Description::of(&format!("{{\"shape\": [{sides}]}}"));
        assert!(shape("1, 4, 60, 80").is_ok());
        let four = shape("2, 2, 60, 80");
        assert!(
            matches!(four, Err(VolumeError::Unsupported { .. })),
            "{four:?}"
        );
        // What is along z is often saved as times.
        let told = imagej("frames=4").unwrap();
        assert!(told.warning().unwrap().contains("times"));
        assert_eq!(told.check_slices(4), Ok(()));
        let cut = VolumeError::Slices {
            promised: 4,
            found: 1,
        };
        assert_eq!(told.check_slices(1), Err(cut));
        assert_eq!(imagej("slices=4").unwrap().warning(), None);
    }
}
