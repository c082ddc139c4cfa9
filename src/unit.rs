//! The unit of a scan's lengths: as a header or a heading says, or somebody who knows it.

use serde::Serialize;
use std::fmt;
use std::str::FromStr;

/// A unit of length.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
pub enum Unit {
    /// `nm`
    #[serde(rename = "nm")]
    Nanometre,
    /// `um`
    #[serde(rename = "um")]
    Micrometre,
    /// `mm`
    #[serde(rename = "mm")]
    Millimetre,
    /// `cm`
    #[serde(rename = "cm")]
    Centimetre,
    /// `dm`
    #[serde(rename = "dm")]
    Decimetre,
    /// `m`
    #[serde(rename = "m")]
    Metre,
    /// `inch`
    #[serde(rename = "inch")]
    Inch,
}

impl Unit {
    /// Its length in metres.
    pub fn metres(self) -> f64 {
        match self {
            Self::Nanometre => 1e-9,
            Self::Micrometre => 1e-6,
            Self::Millimetre => 1e-3,
            Self::Centimetre => 1e-2,
            Self::Decimetre => 0.1,
            Self::Metre => 1.0,
            Self::Inch => 0.0254,
        }
    }

    /// Whether lengths may be in this unit for all that a file says.
    ///
    /// # Errors
    /// [`UnitContradicted`] where it says that they are in another, or in one that is not known here.
    pub fn check(self, told: Option<&str>) -> Result<(), UnitContradicted> {
        match told.filter(|told| told.parse() != Ok(self)) {
            Some(told) => Err(UnitContradicted {
                told: told.into(),
                asked: self,
            }),
            None => Ok(()),
        }
    }
}

/// The unit that is told with figures and kept with a model: the one asked for, or what the file says, known here or not.
#[cfg(feature = "cli")]
pub(crate) fn asked_or_told(asked: Option<Unit>, told: Option<&str>) -> Option<String> {
    asked
        .map(|unit| unit.to_string())
        .or_else(|| told.map(str::to_owned))
}

/// Lengths are said to be in one unit, and the header of an image, the heading of a table, or a model, says another.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error(
    "it says itself that lengths are in {}, and --unit that they are in {asked}: {}",
    told.escape_debug(), self.advice()
)]
pub struct UnitContradicted {
    /// The unit that the file tells.
    pub told: String,
    /// The other.
    pub asked: Unit,
}

impl UnitContradicted {
    fn advice(&self) -> &'static str {
        match self.told.parse::<Unit>() {
            Ok(_) => "leave --unit out, or correct the file",
            Err(_) => "convert the scan, or correct the file",
        }
    }
}

impl fmt::Display for Unit {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Nanometre => "nm",
            Self::Micrometre => "um",
            Self::Millimetre => "mm",
            Self::Centimetre => "cm",
            Self::Decimetre => "dm",
            Self::Metre => "m",
            Self::Inch => "inch",
        })
    }
}

impl FromStr for Unit {
    type Err = &'static str;

    /// All letters in one case: `Mm` would be a megametre, and `M` no length at all.
    fn from_str(text: &str) -> Result<Self, Self::Err> {
        match text {
            "nm" => Ok(Self::Nanometre),
            "um" | "UM" | "µm" | "μm" => Ok(Self::Micrometre),
            "mm" | "MM" => Ok(Self::Millimetre),
            "cm" | "CM" => Ok(Self::Centimetre),
            "dm" | "DM" => Ok(Self::Decimetre),
            "m" => Ok(Self::Metre),
            "inch" | "in" => Ok(Self::Inch),
            _ => Err("expected nm, um, mm, cm, dm, m or inch"),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn case_is_free_where_no_other_unit_is_meant() {
        for text in ["nm", "um", "UM", "mm", "MM", "cm", "CM", "dm", "m", "inch"] {
            let unit: Unit = text.parse().unwrap();
            assert_eq!(unit.to_string(), text.to_lowercase());
        }
        for text in ["M", "Mm", "mM", "Cm", "km", ""] {
            assert!(text.parse::<Unit>().is_err(), "{text}");
        }
    }

    #[test]
    fn units_have_their_lengths() {
        for (text, metres) in [
            ("nm", 1e-9),
            ("um", 1e-6),
            ("mm", 1e-3),
            ("cm", 1e-2),
            ("dm", 0.1),
            ("m", 1.0),
            ("in", 0.0254),
        ] {
            assert_eq!(text.parse().map(Unit::metres), Ok(metres), "{text}");
        }
    }

    #[test]
    fn a_file_may_say_nothing_or_the_same_unit() {
        let um = Unit::Micrometre;
        for told in [None, Some("um"), Some("µm")] {
            assert_eq!(um.check(told), Ok(()), "{told:?}");
        }
        let told = |told| um.check(Some(told)).unwrap_err().to_string();
        assert!(told("mm").ends_with(
            "in mm, and --unit that they are in um: leave --unit out, or correct the file"
        ));
        assert!(told("furlong").ends_with("convert the scan, or correct the file"));
        assert!(told("\u{1b}[2J").contains("in \\u{1b}[2J, and"));
    }
}
