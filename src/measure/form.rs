//! Ratios of length, width and thickness: (1.1)–(1.3) of Radvilaite 2016 by name; the definitions are
//! those of Zingg 1935.

use super::bounds::{OutOfBounds, between, ratio};
use nalgebra::Vector3;
use serde::Serialize;

/// Ratios of the three dimensions of a body, L >= W >= T: pure numbers that tell its form.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Form {
    /// Aspect ratio L / T, at least 1.
    pub aspect_ratio: f64,
    /// Elongation W / L, above 0 to 1.
    pub elongation: f64,
    /// Flatness T / W, above 0 to 1.
    pub flatness: f64,
}

impl Form {
    /// Those of a body with these dimensions, in any order.
    pub fn new(dimensions: &Vector3<f64>) -> Self {
        let [length, width, thickness] = descending(dimensions);
        Self {
            aspect_ratio: length / thickness,
            elongation: width / length,
            flatness: thickness / width,
        }
    }

    /// The same, if each is within its range.
    pub(super) fn checked(self) -> Result<Self, OutOfBounds> {
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
        for sides in [[4.0, 2.0, 1.0], [1.0, 4.0, 2.0]] {
            let form = Form::new(&Vector3::from(sides));
            assert_eq!(form.aspect_ratio, 4.0);
            assert_eq!(form.elongation, 0.5);
            assert_eq!(form.flatness, 0.5);
        }
    }
}
