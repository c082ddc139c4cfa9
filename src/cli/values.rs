//! Values of arguments that have a notation of their own.

use super::numbers::{numbers, share};
use crate::engines::Engine;
use crate::fit::{Form, Kind, MAX_UNION_PARTS, Seams, Tolerance};
use crate::measure::Scheme;
use crate::shapes::{Body, Curled, UnknownBody};
use nalgebra::{Quaternion, UnitQuaternion, Vector3};
use std::path::PathBuf;
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

/// What is fitted to a scan.
#[derive(Debug, Clone, Copy)]
pub(super) enum SurfaceArg {
    Kind(Kind),
    Superquadric(SuperquadricArg),
}

/// One superquadric, or a union of some at most.
#[derive(Debug, Clone, Copy)]
pub(super) enum SuperquadricArg {
    Single(Form),
    Multi(usize),
}

/// Parts of a union where no number is given.
const USUAL_PARTS: usize = 4;

impl FromStr for SurfaceArg {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, Self::Err> {
        let parts = |text: &str| {
            let parts = text.parse().ok();
            let parts = parts.filter(|parts| (1..=MAX_UNION_PARTS).contains(parts));
            parts.ok_or(format!("expected from 1 to {MAX_UNION_PARTS} parts"))
        };
        Ok(Self::Superquadric(match text.split_once(':') {
            Some(("multi", count)) => SuperquadricArg::Multi(parts(count)?),
            None if text == "multi" => SuperquadricArg::Multi(USUAL_PARTS),
            None if text == "superquadric" => SuperquadricArg::Single(Form::Single),
            None if text == "poly" => SuperquadricArg::Single(Form::Poly8),
            None if text == "poly12" => SuperquadricArg::Single(Form::Poly12),
            None if text == "auto" => return Ok(Self::Kind(Kind::Auto)),
            None if text == "star" => return Ok(Self::Kind(Kind::Star)),
            None if text == "position" => return Ok(Self::Kind(Kind::Position)),
            _ => {
                let known =
                    "auto, star, position, superquadric, poly, poly12, multi or multi:PARTS";
                return Err(format!("expected {known}"));
            }
        }))
    }
}

/// An engine, or the format of shapes.
#[derive(Debug, Clone, Copy)]
pub(super) enum EngineArg {
    Deck(Engine),
    Anm,
}

impl FromStr for EngineArg {
    type Err = &'static str;

    fn from_str(name: &str) -> Result<Self, Self::Err> {
        match name {
            "anm" => Ok(Self::Anm),
            name => name.parse().map(Self::Deck),
        }
    }
}

/// Where a body is: turned about the origin, then moved.
#[derive(Debug, Clone, Copy)]
pub(super) struct PoseArg {
    pub(super) aside: Vector3<f64>,
    pub(super) turn: UnitQuaternion<f64>,
}

impl FromStr for PoseArg {
    type Err = &'static str;

    fn from_str(text: &str) -> Result<Self, Self::Err> {
        let wrong = "expected seven finite numbers X,Y,Z,QW,QX,QY,QZ";
        let numbers = text.split(',').map(|number| number.trim().parse::<f64>());
        let numbers: Vec<f64> = numbers.collect::<Result<_, _>>().map_err(|_| wrong)?;
        let [x, y, z, w, i, j, k] = numbers[..] else {
            return Err(wrong);
        };
        if numbers.iter().any(|number| !number.is_finite()) {
            return Err(wrong);
        }
        let turn = Quaternion::new(w, i, j, k);
        // First by its largest part: the squares of what is left neither overflow nor vanish.
        let turn = UnitQuaternion::try_new(turn / turn.coords.amax(), 0.0);
        Ok(Self {
            aside: Vector3::new(x, y, z),
            turn: turn.ok_or("the quaternion must not be zero")?,
        })
    }
}

/// The law of a normal force.
#[derive(Debug, Clone, Copy)]
pub(super) enum LawArg {
    Hertz,
    Volume,
}

impl FromStr for LawArg {
    type Err = &'static str;

    fn from_str(text: &str) -> Result<Self, Self::Err> {
        match text {
            "hertz" => Ok(Self::Hertz),
            "volume" => Ok(Self::Volume),
            _ => Err("expected hertz or volume"),
        }
    }
}

/// A format of scans.
#[derive(Debug, Clone, Copy)]
pub(super) struct ScanFormat(pub(super) &'static str);

impl FromStr for ScanFormat {
    type Err = &'static str;

    fn from_str(text: &str) -> Result<Self, Self::Err> {
        let known = ["ply", "stl", "obj", "xyz"].into_iter();
        let mut named = known.filter(|name| text.eq_ignore_ascii_case(name));
        named
            .next()
            .map(Self)
            .ok_or("expected ply, stl, obj or xyz")
    }
}

/// A format that points are written in.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum CloudFormat {
    Ply,
    Xyz,
}

impl FromStr for CloudFormat {
    type Err = &'static str;

    fn from_str(text: &str) -> Result<Self, Self::Err> {
        match text.to_ascii_lowercase().as_str() {
            "ply" => Ok(Self::Ply),
            "xyz" => Ok(Self::Xyz),
            _ => Err("expected ply or xyz"),
        }
    }
}

/// What a synthetic scan is of.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Subject {
    Body(Body),
    Curled(Curled),
    Superquadric,
    Poly,
    Tray,
}

impl FromStr for Subject {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, Self::Err> {
        let curled = Curled::ALL.into_iter().find(|body| body.name() == text);
        match (text, curled) {
            (_, Some(curled)) => Ok(Self::Curled(curled)),
            ("tray", _) => Ok(Self::Tray),
            ("superquadric", _) => Ok(Self::Superquadric),
            ("poly", _) => Ok(Self::Poly),
            (name, _) => name.parse().map(Self::Body).map_err(|error: UnknownBody| {
                let curled = Curled::ALL.map(Curled::name).join(", ");
                format!("{error}, superquadric, poly, {curled}, tray")
            }),
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
                Err(_) => Err("expected a whole number of zero or more, or auto"),
            },
        }
    }
}

/// The largest coordinate of a scan: beyond it shares of its lengths may be no numbers.
const MOST_TOLERANCE: f64 = 1e100;

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
        Ok(value) if value > MOST_TOLERANCE => Err(format!(
            "expected at most {MOST_TOLERANCE:e}, which no scan reaches"
        )),
        Ok(value) if value > 0.0 && of_radius => Ok(Tolerance::OfMeanRadius(value / 100.0)),
        Ok(value) if value > 0.0 => Ok(Tolerance::Length(value)),
        _ => Err("expected a positive length such as 0.02, a share such as 0.3%, or auto".into()),
    }
}

/// Semi-axes, separated by commas: three, or those on the positive and on the negative side of x, y and z.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum SemiAxes {
    Three([f64; 3]),
    Six([[f64; 2]; 3]),
}

impl FromStr for SemiAxes {
    type Err = &'static str;

    fn from_str(text: &str) -> Result<Self, Self::Err> {
        match numbers(text).as_deref() {
            Some(&[x, y, z]) => Ok(Self::Three([x, y, z])),
            Some(&[a, b, c, d, e, f]) => Ok(Self::Six([[a, b], [c, d], [e, f]])),
            _ => Err("expected three numbers such as 2,2,1, or six of a poly"),
        }
    }
}

/// A file and its share of something; 1 where it is not told.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct ShareArg {
    pub(super) path: PathBuf,
    pub(super) share: f64,
}

impl FromStr for ShareArg {
    type Err = &'static str;

    fn from_str(text: &str) -> Result<Self, Self::Err> {
        let told = text.rsplit_once(':');
        let (path, share) = match told.and_then(|(path, end)| Some((path, share(end).ok()?))) {
            Some((path, share)) => (path, share),
            None => (text, 1.0),
        };
        match share > 0.0 && share.is_finite() && !path.is_empty() {
            true => Ok(Self {
                path: path.into(),
                share,
            }),
            false => Err("expected a file, or a file and a share above zero such as lens.json:0.7"),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_format_may_have_letters_of_either_case() {
        for name in ["ply", "PLY", "Ply"] {
            assert_eq!(name.parse(), Ok(CloudFormat::Ply));
        }
        assert!("stl".parse::<CloudFormat>().is_err());
    }

    #[test]
    fn a_file_may_have_a_share() {
        let read = |text: &str| text.parse().map(|ShareArg { path, share }| (path, share));
        assert_eq!(read("a.json:0.7"), Ok(("a.json".into(), 0.7)));
        assert_eq!(read("a.json:30%"), Ok(("a.json".into(), 0.3)));
        assert_eq!(read("C:a.json"), Ok(("C:a.json".into(), 1.0)));
        for text in [":1", "a:0", "a:-1", "a:inf", ""] {
            assert!(read(text).is_err(), "{text}");
        }
    }
}
