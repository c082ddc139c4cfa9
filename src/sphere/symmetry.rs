//! Mirror planes through the origin, and the region of the sphere that they leave.

use super::tangents::across;
use super::{AngleRectangle, Cap};
use nalgebra::Vector3;
use serde::{Deserialize, Serialize};
use std::f64::consts::{FRAC_PI_2, PI, TAU};
use std::fmt;
use std::str::FromStr;

/// Mirror planes: those through the origin normal to the axes named here.
///
/// Written as the names of these axes, such as `z` or `xyz`, or `none`.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(try_from = "String", into = "String")]
pub struct Symmetry {
    /// The plane x = 0 is a mirror.
    pub x: bool,
    /// The plane y = 0 is a mirror.
    pub y: bool,
    /// The plane z = 0 is a mirror.
    pub z: bool,
}

/// A text that names no mirrors.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
#[error("expected the axes normal to the mirror planes, such as z, xy or xyz, or none")]
pub struct SymmetryError;

impl Symmetry {
    /// No mirror.
    pub const NONE: Self = Self {
        x: false,
        y: false,
        z: false,
    };

    /// All three mirrors: the sphere is folded into one octant.
    pub const OCTANT: Self = Self {
        x: true,
        y: true,
        z: true,
    };

    fn mirrors(&self) -> [bool; 3] {
        [self.x, self.y, self.z]
    }

    /// The axes normal to the mirrors, 0 for x.
    pub(crate) fn normals(&self) -> impl Iterator<Item = usize> {
        let mirrors = self.mirrors();
        (0..3).filter(move |&axis| mirrors[axis])
    }

    /// Names of the axes normal to the mirrors.
    pub(crate) fn names(&self) -> Vec<&'static str> {
        self.normals().map(|axis| ["x", "y", "z"][axis]).collect()
    }

    /// The image of a vector in the region where no mirrored component is negative.
    pub fn fold(&self, n: &Vector3<f64>) -> Vector3<f64> {
        n.component_mul(&self.signs(n))
    }

    /// Factors of the components that fold a vector, and unfold what was found in its image: -1 where a
    /// mirrored component is negative, else 1.
    pub(crate) fn signs(&self, n: &Vector3<f64>) -> Vector3<f64> {
        let mirrors = self.mirrors();
        Vector3::from_fn(|i, _| if mirrors[i] && n[i] < 0.0 { -1.0 } else { 1.0 })
    }

    /// Images of a direction off the mirrors, itself included: 1, 2, 4 or 8.
    pub fn images(&self) -> usize {
        1 << self.mirrors().iter().filter(|&&mirror| mirror).count()
    }

    /// The region into which directions are folded, as a rectangle of angles.
    pub(crate) fn rectangle(&self) -> AngleRectangle {
        AngleRectangle {
            theta: [0.0, if self.z { FRAC_PI_2 } else { PI }],
            phi: match (self.x, self.y) {
                (false, false) => [0.0, TAU],
                (false, true) => [0.0, PI],
                (true, false) => [-FRAC_PI_2, FRAC_PI_2],
                (true, true) => [0.0, FRAC_PI_2],
            },
        }
    }

    /// The cap round the region into which directions are folded: its centre lies along the sum of
    /// the mirrored axes. The whole sphere where there is no mirror.
    pub(crate) fn cap(&self) -> Cap {
        let along = self.mirrors().map(|mirror| f64::from(u8::from(mirror)));
        let centre = match *self {
            Self::NONE => Vector3::z(),
            _ => Vector3::from(along).normalize(),
        };
        Cap {
            centre,
            tangents: across(&centre),
            height: match self.images() {
                1 => 2.0,
                8 => 1.0 - centre.x,
                _ => 1.0,
            },
        }
    }
}

impl fmt::Display for Symmetry {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let names = self.names().concat();
        f.pad(if names.is_empty() { "none" } else { &names })
    }
}

impl FromStr for Symmetry {
    type Err = SymmetryError;

    fn from_str(text: &str) -> Result<Self, SymmetryError> {
        if text == "none" {
            return Ok(Self::NONE);
        }
        let mut found = Self::NONE;
        for name in text.chars() {
            let mirror = match name {
                'x' => &mut found.x,
                'y' => &mut found.y,
                'z' => &mut found.z,
                _ => return Err(SymmetryError),
            };
            if std::mem::replace(mirror, true) {
                return Err(SymmetryError);
            }
        }
        (found != Self::NONE).then_some(found).ok_or(SymmetryError)
    }
}

impl TryFrom<String> for Symmetry {
    type Error = SymmetryError;

    fn try_from(text: String) -> Result<Self, SymmetryError> {
        text.parse()
    }
}

impl From<Symmetry> for String {
    fn from(symmetry: Symmetry) -> Self {
        symmetry.to_string()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sphere::cube_grid;

    fn all() -> impl Iterator<Item = Symmetry> {
        (0..8).map(|bits| Symmetry {
            x: bits & 1 > 0,
            y: bits & 2 > 0,
            z: bits & 4 > 0,
        })
    }

    #[test]
    fn names_read_back_in_any_order() {
        for symmetry in all() {
            let name = symmetry.to_string();
            assert_eq!(name.parse(), Ok(symmetry));
            if name != "none" {
                let reversed: String = name.chars().rev().collect();
                assert_eq!(reversed.parse(), Ok(symmetry));
            }
            let json = serde_json::to_string(&symmetry).expect("a string");
            assert_eq!(json, format!("{name:?}"));
            assert_eq!(serde_json::from_str::<Symmetry>(&json).ok(), Some(symmetry));
        }
    }

    #[test]
    fn other_words_are_refused() {
        for word in ["", "xx", "xyx", "w", "X", "x,y", "nonex", " z"] {
            assert_eq!(word.parse::<Symmetry>(), Err(SymmetryError), "{word:?}");
        }
    }

    #[test]
    fn the_cap_holds_the_region_and_no_more() {
        let (directions, _) = cube_grid(16);
        for symmetry in all() {
            let cap = symmetry.cap();
            let [e1, e2] = cap.tangents;
            assert!((e1.cross(&e2) - cap.centre).norm() < 1e-15);
            assert!((cap.centre.norm() - 1.0).abs() < 1e-15);
            let highest = directions
                .iter()
                .map(|n| 1.0 - symmetry.fold(n).dot(&cap.centre))
                .fold(0.0, f64::max);
            assert!((highest - cap.height).abs() < 1e-15, "{symmetry}");
        }
    }

    #[test]
    fn the_rectangle_is_the_region() {
        for symmetry in all() {
            let rectangle = symmetry.rectangle();
            let share = rectangle.solid_angle() / (4.0 * PI);
            assert!((share * symmetry.images() as f64 - 1.0).abs() < 1e-15);
            for i in 0..9 {
                let n = rectangle.direction((i / 3) as f64 / 2.0, (i % 3) as f64 / 2.0);
                assert!((symmetry.fold(&n) - n).norm() < 1e-15, "{symmetry}");
            }
        }
    }

    #[test]
    fn a_direction_has_as_many_images_as_fold_on_it() {
        let n = Vector3::new(0.48, 0.6, 0.64);
        for symmetry in all() {
            let images = (0..8)
                .map(|bits| n.map_with_location(|i, _, c| if bits >> i & 1 == 0 { c } else { -c }))
                .filter(|image| symmetry.fold(image) == n)
                .count();
            assert_eq!(images, symmetry.images());
        }
    }
}
