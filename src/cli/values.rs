//! Values of arguments that have a notation of their own.

use crate::fit::{Seams, Tolerance};
use crate::measure::Scheme;
use nalgebra::Vector3;
use std::str::FromStr;

/// `exact` or `four-triangles`.
#[derive(Debug, Clone, Copy)]
pub(super) struct SchemeArg(pub(super) Scheme);

impl FromStr for SchemeArg {
    type Err = &'static str;

    fn from_str(text: &str) -> Result<Self, Self::Err> {
        match text {
            "exact" => Ok(Self(Scheme::Exact)),
            "four-triangles" => Ok(Self(Scheme::FourTriangles)),
            _ => Err("expected exact or four-triangles"),
        }
    }
}

/// A unit of length.
#[derive(Debug, Clone, Copy)]
pub(super) enum Unit {
    Micrometre,
    Millimetre,
    Centimetre,
    Metre,
}

impl Unit {
    /// Its length in metres.
    pub(super) fn metres(self) -> f64 {
        match self {
            Self::Micrometre => 1e-6,
            Self::Millimetre => 1e-3,
            Self::Centimetre => 1e-2,
            Self::Metre => 1.0,
        }
    }
}

impl FromStr for Unit {
    type Err = &'static str;

    fn from_str(text: &str) -> Result<Self, Self::Err> {
        match text {
            "um" => Ok(Self::Micrometre),
            "mm" => Ok(Self::Millimetre),
            "cm" => Ok(Self::Centimetre),
            "m" => Ok(Self::Metre),
            _ => Err("expected um, mm, cm or m"),
        }
    }
}

/// `blended` or `none`.
#[derive(Debug, Clone, Copy)]
pub(super) struct SeamsArg(pub(super) Seams);

impl FromStr for SeamsArg {
    type Err = &'static str;

    fn from_str(text: &str) -> Result<Self, Self::Err> {
        match text {
            "blended" => Ok(Self(Seams::Blended)),
            "none" => Ok(Self(Seams::None)),
            _ => Err("expected blended or none"),
        }
    }
}

/// A number, or `auto` for a search.
#[derive(Debug, Clone, Copy)]
pub(super) struct Auto(pub(super) Option<usize>);

impl FromStr for Auto {
    type Err = &'static str;

    fn from_str(text: &str) -> Result<Self, Self::Err> {
        match text {
            "auto" | "adaptive" => Ok(Self(None)),
            number => match number.parse() {
                Ok(number) => Ok(Self(Some(number))),
                Err(_) => Err("expected a whole number or auto"),
            },
        }
    }
}

/// A length, a percentage of the mean radius, or `auto`.
pub(super) fn tolerance(text: &str) -> Result<Tolerance, String> {
    if text == "auto" {
        return Ok(Tolerance::Auto);
    }
    let (number, of_radius) = match text.strip_suffix('%') {
        Some(percentage) => (percentage.trim_end(), true),
        None => (text, false),
    };
    match number.parse::<f64>() {
        Ok(value) if value > 0.0 && value.is_finite() && of_radius => {
            Ok(Tolerance::OfMeanRadius(value / 100.0))
        }
        Ok(value) if value > 0.0 && value.is_finite() => Ok(Tolerance::Length(value)),
        _ => Err("expected a positive length such as 0.02, a share such as 0.3%, or auto".into()),
    }
}

/// Three components of a vector, separated by commas.
pub(super) fn vector(text: &str) -> Result<Vector3<f64>, String> {
    let numbers: Result<Vec<f64>, _> = text.split(',').map(|part| part.trim().parse()).collect();
    match numbers.as_deref() {
        Ok(&[x, y, z]) => Ok(Vector3::new(x, y, z)),
        _ => Err("expected three numbers such as 10,0,-2.5".into()),
    }
}
