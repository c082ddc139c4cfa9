//! What is compared: families of models and their settings.

use crate::fit::FitOptions;
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

/// A family of models.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Family {
    /// One expansion for the whole surface.
    Whole,
    /// k x k segments, equal in angle and of one degree, fitted independently.
    Uniform,
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
}

/// The options by which a setting is fitted.
pub fn options(setting: &Setting) -> FitOptions {
    let (degree, segments) = match *setting {
        Setting::Whole { degree } => (degree, 1),
        Setting::Uniform { parts, degree } => (degree, parts * parts),
    };
    FitOptions {
        degree: Some(degree),
        segments: Some(segments),
        ..FitOptions::default()
    }
}

impl Family {
    /// All families.
    pub const ALL: [Self; 2] = [Self::Whole, Self::Uniform];

    /// The name, in lower case.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Whole => "whole",
            Self::Uniform => "uniform",
        }
    }

    /// The settings that are fitted of it.
    pub fn settings(self) -> Vec<Setting> {
        match self {
            Self::Whole => WHOLE_DEGREES
                .map(|degree| Setting::Whole { degree })
                .collect(),
            Self::Uniform => UNIFORM_PARTS
                .flat_map(|parts| {
                    UNIFORM_DEGREES.map(move |degree| Setting::Uniform { parts, degree })
                })
                .collect(),
        }
    }
}

impl Setting {
    /// The family it belongs to.
    pub fn family(&self) -> Family {
        match self {
            Self::Whole { .. } => Family::Whole,
            Self::Uniform { .. } => Family::Uniform,
        }
    }

    /// The degree, where the setting fixes it.
    pub fn degree(&self) -> Option<usize> {
        match *self {
            Self::Whole { degree } | Self::Uniform { degree, .. } => Some(degree),
        }
    }

    /// The held-out RMS asked for, as a share of the mean radius, where the setting asks for one.
    pub fn tolerance(&self) -> Option<f64> {
        match self {
            Self::Whole { .. } | Self::Uniform { .. } => None,
        }
    }

    /// Whether so many points can bear it: at least two for each coefficient.
    pub fn is_supported_by(&self, points: usize) -> bool {
        let coefficients = match *self {
            Self::Whole { degree } => coefficient_count(degree),
            Self::Uniform { parts, degree } => parts * parts * coefficient_count(degree),
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
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_setting_asks_for_one_fit() {
        let count = |family: Family| family.settings().len();
        assert_eq!(Family::ALL.map(count), [20, 16 * 7]);
        for family in Family::ALL {
            for setting in family.settings() {
                assert_eq!(setting.family(), family);
                let (degrees, parts) = options(&setting).candidates().unwrap();
                assert_eq!((degrees.len(), parts.len()), (1, 1), "{setting}");
            }
        }
    }
}
