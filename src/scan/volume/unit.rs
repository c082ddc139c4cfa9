//! The unit of lengths, as a header writes it.

use super::VolumeError;

/// The short name of a unit, such as `um`, or the name as it is written where it is not known; `None` where it names no
/// unit of length, as `pixel` does.
pub(super) fn of(name: &str) -> Option<String> {
    let name = name.trim();
    let short = match name.to_lowercase().as_str() {
        "" | "pixel" | "pixels" | "px" | "voxel" | "voxels" | "none" | "unknown" => return None,
        "nm" | "nanometer" | "nanometers" | "nanometre" | "nanometres" => "nm",
        "um" | "\u{b5}m" | "\u{3bc}m" | "\\u00b5m" | "&#181;m" | "&#xb5;m" | "micron"
        | "microns" | "micrometer" | "micrometers" | "micrometre" | "micrometres" => "um",
        "mm" | "millimeter" | "millimeters" | "millimetre" | "millimetres" => "mm",
        "cm" | "centimeter" | "centimeters" | "centimetre" | "centimetres" => "cm",
        "m" | "meter" | "meters" | "metre" | "metres" => "m",
        "in" | "inch" | "inches" | "\"" => "inch",
        _ => name,
    };
    Some(short.into())
}

/// The unit that all axes have, of those that tell one.
///
/// # Errors
/// [`VolumeError::SeveralUnits`] where they differ: lengths are not converted.
pub(super) fn common<'a>(
    names: impl IntoIterator<Item = &'a str>,
) -> Result<Option<String>, VolumeError> {
    let mut units: Vec<String> = Vec::new();
    for unit in names.into_iter().filter_map(of) {
        if !units.contains(&unit) {
            units.push(unit);
        }
    }
    match units.len() {
        0 | 1 => Ok(units.pop()),
        _ => Err(VolumeError::SeveralUnits { units }),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn units_have_one_name_each_and_axes_one_unit() {
        for name in ["um", "µm", "μm", "Microns", "\\u00B5m", " micrometer "] {
            assert_eq!(of(name).as_deref(), Some("um"), "{name}");
        }
        assert_eq!(of("pixel"), None);
        assert_eq!(of("furlong").as_deref(), Some("furlong"));
        assert_eq!(common(["mm", "", "MM"]), Ok(Some("mm".into())));
        assert_eq!(common(["", "pixel"]), Ok(None));
        let units = vec!["mm".into(), "um".into()];
        assert_eq!(
            common(["mm", "um", "mm"]),
            Err(VolumeError::SeveralUnits { units })
        );
    }
}
