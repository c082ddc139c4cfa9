//! Ratios of three lengths: of the sides of the least box, as (1.1) to (1.3) of Radvilaite 2016 have them, and
//! of the dimensions along the principal axes.

use super::bounds::{OutOfBounds, between, ratio};
use nalgebra::Vector3;
use serde::Serialize;

/// Ratios of the sides of the box of least volume, S <= I <= L: those of Radvilaite 2016, after Mollon and
/// Zhao 2012. Each is above 0 to 1.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[non_exhaustive]
pub struct SideRatios {
    /// S / L, the source's aspect ratio (1.1).
    pub short_to_long: f64,
    /// I / L, the source's elongation (1.2).
    pub intermediate_to_long: f64,
    /// S / I, the source's flatness (1.3).
    pub short_to_intermediate: f64,
}

impl SideRatios {
    /// The ratios of a box with these sides, in any order.
    pub fn new(sides: &Vector3<f64>) -> Self {
        let [long, intermediate, short] = descending(sides);
        Self {
            short_to_long: short / long,
            intermediate_to_long: intermediate / long,
            short_to_intermediate: short / intermediate,
        }
    }

    /// The same, if each is within its range.
    pub(in crate::measure) fn checked(self) -> Result<Self, OutOfBounds> {
        Ok(Self {
            short_to_long: ratio("S/L", self.short_to_long)?,
            intermediate_to_long: ratio("I/L", self.intermediate_to_long)?,
            short_to_intermediate: ratio("S/I", self.short_to_intermediate)?,
        })
    }
}

/// Ratios of the dimensions of a body along its principal axes, L >= W >= T: pure numbers that tell its form.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[non_exhaustive]
pub struct Form {
    /// Aspect ratio L / T, at least 1: the inverse of the source's kind.
    pub aspect_ratio: f64,
    /// Elongation W / L, above 0 to 1 (Zingg 1935).
    pub elongation: f64,
    /// Flatness T / W, above 0 to 1 (Zingg 1935).
    pub flatness: f64,
}

impl Form {
    /// The form of a body with these dimensions, in any order.
    pub fn new(dimensions: &Vector3<f64>) -> Self {
        let [length, width, thickness] = descending(dimensions);
        Self {
            aspect_ratio: length / thickness,
            elongation: width / length,
            flatness: thickness / width,
        }
    }

    /// The same, if each is within its range.
    pub(in crate::measure) fn checked(self) -> Result<Self, OutOfBounds> {
        Ok(Self {
            aspect_ratio: between("aspect ratio", self.aspect_ratio, [1.0, f64::INFINITY])?,
            elongation: ratio("elongation", self.elongation)?,
            flatness: ratio("flatness", self.flatness)?,
        })
    }
}

/// Length, width and thickness.
pub(super) fn descending(dimensions: &Vector3<f64>) -> [f64; 3] {
    let mut sorted: [f64; 3] = (*dimensions).into();
    sorted.sort_by(|one, other| other.total_cmp(one));
    sorted
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_brick_has_its_ratios_whichever_way_it_lies() {
        for sides in [[10.0, 4.0, 1.0], [1.0, 10.0, 4.0]] {
            let form = Form::new(&Vector3::from(sides));
            assert_eq!(form.aspect_ratio, 10.0);
            assert_eq!(form.elongation, 0.4);
            assert_eq!(form.flatness, 0.25);
            let ratios = SideRatios::new(&Vector3::from(sides));
            assert_eq!(ratios.short_to_long, 0.1);
            assert_eq!(ratios.intermediate_to_long, 0.4);
            assert_eq!(ratios.short_to_intermediate, 0.25);
        }
    }
}
