//! The record of an outline.

use super::WithErrors;
use crate::measure::{Outline, OutlineErrors};
use serde::Serialize;

/// The outline of a body seen along an axis, see [`Outline`].
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[non_exhaustive]
pub struct ProjectionRecord {
    /// "length", "width" or "thickness".
    pub along: &'static str,
    /// What is measured of it.
    #[serde(flatten)]
    pub outline: WithErrors<OutlineFigures>,
}

/// Sizes and ratios of an outline.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[non_exhaustive]
pub struct OutlineFigures {
    /// Area.
    pub area: f64,
    /// Perimeter.
    pub perimeter: f64,
    /// Diameter of the circle of equal area.
    pub equivalent_diameter: f64,
    /// Largest distance between parallel tangents.
    pub largest_feret: f64,
    /// Smallest distance between parallel tangents.
    pub smallest_feret: f64,
    /// Diameter of the smallest enclosing circle.
    pub enclosing_diameter: f64,
    /// Diameter of the largest inscribed circle.
    pub inscribed_diameter: f64,
    /// Area over that of the enclosing circle.
    pub area_sphericity: f64,
    /// Equivalent over enclosing diameter.
    pub diameter_sphericity: f64,
    /// Inscribed over enclosing diameter.
    pub circle_ratio: f64,
    /// Square root of the circle ratio.
    pub riley_sphericity: f64,
    /// Perimeter of the circle of equal area over the perimeter.
    pub perimeter_sphericity: f64,
    /// 4 pi area over the perimeter squared.
    pub circularity: f64,
    /// Smallest over largest Feret diameter.
    pub width_to_length: f64,
    /// Area over that of the convex hull.
    pub solidity: f64,
    /// Perimeter of the convex hull over the perimeter.
    pub convexity: f64,
    /// Mean radius of the corners over the inscribed radius; `null` of outlines so thin that it would be that of the smoothing, and not
    /// that of the same outline seen a little turned.
    pub roundness: Option<f64>,
}

/// Smallest over largest Feret diameter of the thinnest outline that has a roundness: of ellipses 50 times as long as wide it
/// changes by .001 when they are turned, of ones 200 times as long by .04.
const THINNEST: f64 = 0.02;

impl ProjectionRecord {
    pub(super) fn new(
        along: &'static str,
        outline: &Outline,
        errors: Option<&OutlineErrors>,
    ) -> Self {
        let figures = OutlineFigures::new(outline);
        Self {
            along,
            outline: WithErrors::new(figures, errors.map(|errors| figures.off(errors))),
        }
    }
}

impl OutlineFigures {
    fn new(outline: &Outline) -> Self {
        Self {
            area: outline.area,
            perimeter: outline.perimeter,
            equivalent_diameter: outline.equivalent_diameter(),
            largest_feret: outline.largest_feret,
            smallest_feret: outline.smallest_feret,
            enclosing_diameter: outline.enclosing_diameter,
            inscribed_diameter: outline.inscribed_diameter,
            area_sphericity: outline.area_sphericity().min(1.0),
            diameter_sphericity: outline.diameter_sphericity().min(1.0),
            circle_ratio: outline.circle_ratio().min(1.0),
            riley_sphericity: outline.riley_sphericity().min(1.0),
            perimeter_sphericity: outline.perimeter_sphericity().min(1.0),
            circularity: outline.circularity().min(1.0),
            width_to_length: outline.width_to_length().min(1.0),
            solidity: outline.solidity().min(1.0),
            convexity: outline.convexity().min(1.0),
            roundness: (outline.width_to_length() >= THINNEST)
                .then_some(outline.roundness.min(1.0)),
        }
    }

    /// Their standard errors, given those of area, perimeter and diameters: each takes those of what it is made of, times its
    /// power.
    fn off(&self, errors: &OutlineErrors) -> Self {
        let OutlineErrors {
            area,
            perimeter,
            diameter,
            inscribed,
            roundness,
            ..
        } = *errors;
        Self {
            area: self.area * area,
            perimeter: self.perimeter * perimeter,
            equivalent_diameter: self.equivalent_diameter * area / 2.0,
            largest_feret: self.largest_feret * diameter,
            smallest_feret: self.smallest_feret * diameter,
            enclosing_diameter: self.enclosing_diameter * diameter,
            inscribed_diameter: self.inscribed_diameter * inscribed,
            area_sphericity: self.area_sphericity * (area + 2.0 * diameter),
            diameter_sphericity: self.diameter_sphericity * (area / 2.0 + diameter),
            circle_ratio: self.circle_ratio * (diameter + inscribed),
            riley_sphericity: self.riley_sphericity * (diameter + inscribed) / 2.0,
            perimeter_sphericity: self.perimeter_sphericity * (area / 2.0 + perimeter),
            circularity: self.circularity * (area + 2.0 * perimeter),
            width_to_length: self.width_to_length * 2.0 * diameter,
            solidity: self.solidity * area,
            convexity: self.convexity * perimeter,
            roundness: self.roundness.and(Some(roundness)),
        }
    }
}
