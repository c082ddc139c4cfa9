//! The unit of a scan's lengths, as somebody who knows it tells it.

use serde::Serialize;
use std::fmt;
use std::str::FromStr;

/// A unit of length.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
pub enum Unit {
    /// `um`
    #[serde(rename = "um")]
    Micrometre,
    /// `mm`
    #[serde(rename = "mm")]
    Millimetre,
    /// `cm`
    #[serde(rename = "cm")]
    Centimetre,
    /// `m`
    #[serde(rename = "m")]
    Metre,
}

impl Unit {
    /// Its length in metres.
    pub fn metres(self) -> f64 {
        match self {
            Self::Micrometre => 1e-6,
            Self::Millimetre => 1e-3,
            Self::Centimetre => 1e-2,
            Self::Metre => 1.0,
        }
    }

    /// Whether lengths may be in this unit for all that the header of an image says. A word that is no unit known here says
    /// nothing.
    ///
    /// # Errors
    /// [`UnitContradicted`] where the header says that they are in another.
    pub fn check(self, header: Option<&str>) -> Result<(), UnitContradicted> {
        let is_known = |told: &&str| told.parse::<Self>().is_ok() || NOT_OFFERED.contains(told);
        match header.filter(is_known) {
            Some(told) if told.parse() != Ok(self) => Err(UnitContradicted {
                header: told.into(),
                asked: self,
            }),
            _ => Ok(()),
        }
    }
}

/// Units of headers in which no lengths are told here.
const NOT_OFFERED: [&str; 3] = ["nm", "dm", "inch"];

/// Lengths are said to be in one unit, and the header of an image, or the heading of a table, says another.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("its header says that lengths are in {header}, and --unit that they are in {asked}: {}", self.advice())]
pub struct UnitContradicted {
    /// The unit of the header.
    pub header: String,
    /// The other.
    pub asked: Unit,
}

impl UnitContradicted {
    fn advice(&self) -> String {
        match NOT_OFFERED.contains(&&*self.header) {
            true => "leave --unit out, or convert the scan".into(),
            false => format!("give --unit {}, or correct the header", self.header),
        }
    }
}

impl fmt::Display for Unit {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Micrometre => "um",
            Self::Millimetre => "mm",
            Self::Centimetre => "cm",
            Self::Metre => "m",
        })
    }
}

impl FromStr for Unit {
    type Err = &'static str;

    /// All letters in one case: `Mm` would be a megametre, and `M` no length at all.
    fn from_str(text: &str) -> Result<Self, Self::Err> {
        match text {
            "um" | "UM" | "µm" | "μm" => Ok(Self::Micrometre),
            "mm" | "MM" => Ok(Self::Millimetre),
            "cm" | "CM" => Ok(Self::Centimetre),
            "m" => Ok(Self::Metre),
            _ => Err("expected um, mm, cm or m"),
        }
    }
}

/// What follows lengths, areas and volumes in a summary; nothing where the unit is not known.
#[derive(Debug, Clone, Copy)]
pub(super) struct Labels(pub(super) Option<Unit>);

impl Labels {
    pub(super) fn length(self) -> String {
        self.power("")
    }

    pub(super) fn area(self) -> String {
        self.power("²")
    }

    pub(super) fn volume(self) -> String {
        self.power("³")
    }

    /// Of moments of inertia at density one.
    pub(super) fn moment(self) -> String {
        self.power("⁵")
    }

    /// Of curvatures.
    pub(super) fn curvature(self) -> String {
        self.0.map_or(String::new(), |unit| format!(" /{unit}"))
    }

    /// Of Gaussian curvatures.
    pub(super) fn gaussian(self) -> String {
        self.0.map_or(String::new(), |unit| format!(" /{unit}²"))
    }

    fn power(self, power: &str) -> String {
        self.0
            .map_or(String::new(), |unit| format!(" {unit}{power}"))
    }

    /// What lengths are in: `the scan's unit`.
    pub(super) fn name(self) -> String {
        self.0
            .map_or("the scan's unit".into(), |unit| unit.to_string())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn case_is_free_where_no_other_unit_is_meant() {
        for text in ["um", "UM", "mm", "MM", "cm", "CM", "m"] {
            let unit: Unit = text.parse().unwrap();
            assert_eq!(unit.to_string(), text.to_lowercase());
        }
        for text in ["M", "Mm", "mM", "Cm", "inch", ""] {
            assert!(text.parse::<Unit>().is_err(), "{text}");
        }
    }

    #[test]
    fn units_have_their_lengths() {
        let lengths = ["um", "mm", "cm", "m"].map(|text| text.parse().map(Unit::metres));
        assert_eq!(lengths, [1e-6, 1e-3, 1e-2, 1.0].map(Ok));
    }

    #[test]
    fn labels_have_powers_or_are_empty() {
        let labels = Labels(Some(Unit::Millimetre));
        assert_eq!(
            [labels.length(), labels.area(), labels.volume()],
            [" mm", " mm²", " mm³"]
        );
        assert_eq!(Labels(None).area(), "");
    }

    #[test]
    fn a_header_may_say_nothing_or_the_same_unit() {
        let um = Unit::Micrometre;
        for header in [None, Some("um"), Some("furlong")] {
            assert_eq!(um.check(header), Ok(()), "{header:?}");
        }
        let told = |header| um.check(Some(header)).unwrap_err().to_string();
        assert!(told("mm").ends_with(
            "in mm, and --unit that they are in um: give --unit mm, or correct the header"
        ));
        assert!(told("nm").ends_with("leave --unit out, or convert the scan"));
    }
}
