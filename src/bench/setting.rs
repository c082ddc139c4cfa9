//! What is compared: families of models and their settings.

use crate::fit::{FitOptions, Form, Seams, Tolerance};
use crate::sphere::coefficient_count;
use serde::Serialize;
use std::fmt;
use std::ops::RangeInclusive;

/// Degrees of the whole surface.
const WHOLE_DEGREES: RangeInclusive<usize> = 1..=20;

/// Parts per angle of uniform segments.
const UNIFORM_PARTS: RangeInclusive<usize> = 1..=16;

/// Degrees in uniform segments.
const UNIFORM_DEGREES: RangeInclusive<usize> = 0..=6;

/// Parts per edge of the cube's faces of uniform blended cells.
const BLENDED_PARTS: RangeInclusive<usize> = 1..=5;

/// Degrees in uniform blended cells.
const BLENDED_DEGREES: RangeInclusive<usize> = 1..=5;

/// Tolerances of adaptive cells, as shares of the mean radius.
const TOLERANCES: [f64; 7] = [0.01, 0.005, 0.003, 0.002, 0.001, 0.0005, 0.0002];

/// A family of models.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Family {
    /// One expansion for the whole surface, fitted to the points by least squares.
    Whole,
    /// k x k segments, equal in angle and of one degree, fitted independently.
    Uniform,
    /// n x n overlapping cells on each face of a cube, of one degree, fitted together to the estimate.
    Blended,
    /// Overlapping cells of degree 4 or less, split where the estimate asks for it.
    Adaptive,
    /// The estimate itself, cut at the lowest degree that is near enough to it.
    Estimate,
    /// One superquadric: few numbers and fast contacts, at the price of a rough surface.
    Superquadric,
    /// The rival: an expansion of the whole sphere by ducc0's least squares.
    Ducc0,
}

/// One model of a family.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Setting {
    /// Of [`Family::Whole`].
    Whole {
        /// Degree of the expansion.
        degree: usize,
    },
    /// Of [`Family::Uniform`].
    Uniform {
        /// Parts per angle, k.
        parts: usize,
        /// Degree of the segments' expansions.
        degree: usize,
    },
    /// Of [`Family::Blended`].
    Blended {
        /// Parts per edge of the cube's faces, n.
        parts: usize,
        /// Degree of the cells' expansions.
        degree: usize,
    },
    /// Of [`Family::Adaptive`]: the default options, with a tolerance that follows the scan.
    Automatic,
    /// Of [`Family::Adaptive`].
    Adaptive {
        /// RMS error that is good enough, as a share of the mean radius.
        tolerance: f64,
    },
    /// Of [`Family::Estimate`].
    Estimate {
        /// RMS error that is good enough, as a share of the mean radius.
        tolerance: f64,
    },
    /// Of [`Family::Superquadric`].
    Superquadric {
        /// How many numbers it is given.
        form: Form,
    },
}

/// By what a setting is fitted.
#[derive(Debug, Clone, PartialEq)]
pub enum Asked {
    /// Harmonics, by these options.
    Harmonics(FitOptions),
    /// A superquadric of so many numbers.
    Superquadric(Form),
}

/// By what a setting is fitted.
pub fn asked(setting: &Setting) -> Asked {
    let uniform = |seams, segments, degree| FitOptions {
        seams,
        degree: Some(degree),
        segments: Some(segments),
        ..FitOptions::default()
    };
    let adaptive = |tolerance, segments| FitOptions {
        seams: Seams::Blended,
        tolerance: Tolerance::OfMeanRadius(tolerance),
        segments,
        ..FitOptions::default()
    };
    Asked::Harmonics(match *setting {
        Setting::Whole { degree } => uniform(Seams::None, 1, degree),
        Setting::Uniform { parts, degree } => uniform(Seams::None, parts * parts, degree),
        Setting::Blended { parts, degree } => uniform(Seams::Blended, 6 * parts * parts, degree),
        Setting::Automatic => FitOptions::default(),
        Setting::Adaptive { tolerance } => adaptive(tolerance, None),
        Setting::Estimate { tolerance } => adaptive(tolerance, Some(1)),
        Setting::Superquadric { form } => return Asked::Superquadric(form),
    })
}

impl Family {
    /// All families of grainform.
    pub const ALL: [Self; 6] = [
        Self::Whole,
        Self::Uniform,
        Self::Blended,
        Self::Adaptive,
        Self::Estimate,
        Self::Superquadric,
    ];

    /// The name, in lower case.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Whole => "whole",
            Self::Uniform => "uniform",
            Self::Blended => "blended",
            Self::Adaptive => "adaptive",
            Self::Estimate => "estimate",
            Self::Superquadric => "superquadric",
            Self::Ducc0 => "ducc0",
        }
    }

    /// The settings that are fitted of it.
    pub fn settings(self) -> Vec<Setting> {
        match self {
            Self::Whole => WHOLE_DEGREES
                .map(|degree| Setting::Whole { degree })
                .collect(),
            Self::Uniform => grid(UNIFORM_PARTS, UNIFORM_DEGREES)
                .map(|(parts, degree)| Setting::Uniform { parts, degree })
                .collect(),
            Self::Blended => grid(BLENDED_PARTS, BLENDED_DEGREES)
                .map(|(parts, degree)| Setting::Blended { parts, degree })
                .collect(),
            Self::Adaptive => TOLERANCES
                .map(|tolerance| Setting::Adaptive { tolerance })
                .into_iter()
                .chain([Setting::Automatic])
                .collect(),
            Self::Estimate => TOLERANCES
                .map(|tolerance| Setting::Estimate { tolerance })
                .into(),
            Self::Superquadric => [Form::Single, Form::Poly8, Form::Poly12]
                .map(|form| Setting::Superquadric { form })
                .into(),
            Self::Ducc0 => Vec::new(),
        }
    }
}

/// All pairs, the second of them running first.
fn grid(
    parts: RangeInclusive<usize>,
    degrees: RangeInclusive<usize>,
) -> impl Iterator<Item = (usize, usize)> {
    parts.flat_map(move |parts| degrees.clone().map(move |degree| (parts, degree)))
}

impl Setting {
    /// The family it belongs to.
    pub fn family(&self) -> Family {
        match self {
            Self::Whole { .. } => Family::Whole,
            Self::Uniform { .. } => Family::Uniform,
            Self::Blended { .. } => Family::Blended,
            Self::Automatic | Self::Adaptive { .. } => Family::Adaptive,
            Self::Estimate { .. } => Family::Estimate,
            Self::Superquadric { .. } => Family::Superquadric,
        }
    }

    /// The degree, where the setting fixes it.
    pub fn degree(&self) -> Option<usize> {
        match *self {
            Self::Whole { degree }
            | Self::Uniform { degree, .. }
            | Self::Blended { degree, .. } => Some(degree),
            Self::Automatic
            | Self::Adaptive { .. }
            | Self::Estimate { .. }
            | Self::Superquadric { .. } => None,
        }
    }

    /// The RMS error asked for, as a share of the mean radius, where the setting asks for one.
    pub fn tolerance(&self) -> Option<f64> {
        match *self {
            Self::Whole { .. }
            | Self::Uniform { .. }
            | Self::Blended { .. }
            | Self::Automatic
            | Self::Superquadric { .. } => None,
            Self::Adaptive { tolerance } | Self::Estimate { tolerance } => Some(tolerance),
        }
    }

    /// Whether so many points can bear it: at least two for each coefficient, and three for each number of a
    /// superquadric and its pose. Adaptive fits see to that themselves.
    pub fn is_supported_by(&self, points: usize) -> bool {
        let coefficients = match *self {
            Self::Whole { degree } => coefficient_count(degree),
            Self::Uniform { parts, degree } => parts * parts * coefficient_count(degree),
            Self::Blended { parts, degree } => 6 * parts * parts * coefficient_count(degree),
            Self::Automatic | Self::Adaptive { .. } | Self::Estimate { .. } => 0,
            Self::Superquadric { form } => return 3 * form.parameters() <= points,
        };
        2 * coefficients <= points
    }
}

impl fmt::Display for Setting {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Whole { degree } => write!(f, "whole surface, degree {degree}"),
            Self::Uniform { parts, degree } => {
                write!(f, "{parts} x {parts} segments, degree {degree}")
            }
            Self::Blended { parts, degree } => {
                write!(f, "6 x {parts} x {parts} blended cells, degree {degree}")
            }
            Self::Automatic => write!(f, "adaptive, by default"),
            Self::Adaptive { tolerance } => {
                write!(f, "adaptive within {} %", 100.0 * tolerance)
            }
            Self::Estimate { tolerance } => {
                write!(f, "estimate within {} %", 100.0 * tolerance)
            }
            Self::Superquadric { form } => {
                write!(f, "superquadric of {} numbers", form.numbers())
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_setting_asks_for_one_fit() {
        let count = |family: Family| family.settings().len();
        assert_eq!(Family::ALL.map(count), [20, 16 * 7, 5 * 5, 8, 7, 3]);
        for family in Family::ALL {
            for setting in family.settings() {
                assert_eq!(setting.family(), family);
                let Asked::Harmonics(options) = asked(&setting) else {
                    assert_eq!(family, Family::Superquadric);
                    continue;
                };
                options.check().expect("in range");
                assert_eq!(options.degree, setting.degree(), "{setting}");
                match setting.tolerance() {
                    Some(share) => {
                        assert_eq!(options.tolerance, Tolerance::OfMeanRadius(share));
                        let of_whole = family == Family::Estimate;
                        assert_eq!(options.segments, of_whole.then_some(1));
                    }
                    None if setting == Setting::Automatic => {
                        assert_eq!(options, FitOptions::default());
                    }
                    None => assert!(options.degree.is_some() && options.segments.is_some()),
                }
            }
        }
    }

    #[test]
    fn names_are_those_of_the_json() {
        for family in Family::ALL {
            assert_eq!(serde_json::to_value(family).unwrap(), family.name());
        }
    }
}
