//! How well outlines are known.

use super::{OF_MESH, Survey, SurveyError};
use crate::measure::{Curvature, Outline, are_apart};
use crate::model::StandardErrors;
use crate::sphere::cube_grid;
use crate::spread::root_mean_square;
use nalgebra::{Matrix3, Vector3};
use std::f64::consts::{FRAC_PI_2, TAU};

/// Cells along an edge of the cube of directions of the surface that are looked at.
const LOOKED_AT: usize = 24;

/// Cosine of the angle between a normal and the plane of an outline up to which a place is on its rim, beyond that of the place
/// that is nearest to it.
const ON_RIM: f64 = 0.05;

/// Turns to either side that are looked at.
const TURNS: u32 = 4;

/// Standard errors, at most, of what is measured of an outline, as shares of it; those of ratios are sums of these, each times its
/// power.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct OutlineErrors {
    /// Of the area: as the surface may be off on the rim, all of that alike, at least as the two dimensions that are seen are, and as
    /// the axis that it is seen along may be turned.
    pub area: f64,
    /// Of the perimeter: of that too, and of the area of the whole surface, which holds what fine detail adds.
    pub perimeter: f64,
    /// Of diameters that hold the outline: the larger one of the errors of the two dimensions that are seen.
    pub diameter: f64,
    /// Of the diameter of the inscribed circle: that too, and at least as the surface may be off on two sides of it, for a bent body
    /// is as wide there as no dimension tells.
    pub inscribed: f64,
}

impl Survey<'_> {
    /// How well the [outlines](Self::projections) are known. `None` where the grain does not tell how well its surface is.
    ///
    /// # Errors
    ///
    /// As [`Self::projections`].
    pub fn projection_errors(
        &self,
        outlines: &[Outline; 3],
    ) -> Result<Option<[OutlineErrors; 3]>, SurveyError> {
        let (Ok(errors), Some(off)) = (self.standard_errors(), self.relative_dimension_errors()?)
        else {
            return Ok(None);
        };
        let axes = self.unit_axes()?;
        let Some(rims) = self.rim_errors(&axes) else {
            return Ok(None);
        };
        let turned = self.turned(&axes, &errors)?;
        let area = errors.area / self.area()?;
        let of = |i: usize| {
            let outline = &outlines[i];
            let (rim, turned) = (rims[i], turned[i].hypot(OF_MESH));
            let (one, other) = (off[(i + 1) % 3], off[(i + 2) % 3]);
            let diameter = one.max(other).hypot(OF_MESH);
            let seen = one.hypot(other);
            let own_area = (rim * outline.perimeter / outline.area).max(seen);
            let own_perimeter = (rim * TAU / outline.perimeter).max(0.5 * seen);
            OutlineErrors {
                area: own_area.hypot(turned),
                perimeter: own_perimeter.hypot(area).hypot(turned),
                diameter,
                inscribed: diameter.max(2.0 * rim / outline.inscribed_diameter),
            }
        };
        Ok(Some([0, 1, 2].map(of)))
    }

    /// How far the surface may be off where lines along each axis graze it, the root mean square.
    fn rim_errors(&self, axes: &Matrix3<f64>) -> Option<[f64; 3]> {
        let surface = self.body.surface().ok()?;
        let (directions, _) = cube_grid(LOOKED_AT);
        let jets = surface.jets(&directions);
        let mut places = Vec::with_capacity(directions.len());
        for (n, jet) in directions.iter().zip(&jets) {
            let normal = axes.tr_mul(&Curvature::new(n, jet).normal);
            places.push((normal.map(f64::abs), self.body.local_error(n)?.place));
        }
        let rim = |axis: usize| {
            let least = |least: f64, (normal, _): &(Vector3<f64>, f64)| least.min(normal[axis]);
            let limit = places.iter().fold(1.0, least) + ON_RIM;
            let is_on = |(normal, _): &&(Vector3<f64>, f64)| normal[axis] <= limit;
            let places = places.iter().filter(is_on).map(|(_, place)| *place);
            root_mean_square(places) * self.unit.length
        };
        Some([0, 1, 2].map(rim))
    }

    /// By what share the areas of outlines change where their axes are turned by what these are uncertain by, as those of convex
    /// bodies do: by half of what all facets cover.
    fn turned(
        &self,
        axes: &Matrix3<f64>,
        errors: &StandardErrors,
    ) -> Result<[f64; 3], SurveyError> {
        let mesh = self.mesh();
        let facets = mesh.triangles.iter().map(|corners| {
            let [a, b, c] = corners.map(|corner| mesh.vertices[corner as usize]);
            (b - a).cross(&(c - a))
        });
        let facets: Vec<Vector3<f64>> = facets.collect();
        let covered =
            |axis: &Vector3<f64>| -> f64 { facets.iter().map(|facet| facet.dot(axis).abs()).sum() };
        let moments = axes.tr_mul(&(self.inertia()? * axes));
        let own = self.axes().tr_mul(axes).abs();
        let off = own.tr_mul(&(errors.inertia * own));
        let of = |i: usize| {
            let axis = axes.column(i).into_owned();
            let straight = covered(&axis);
            let changes = (1..3).map(|ahead| {
                let j = (i + ahead) % 3;
                let (sd, gap) = (off[(i, j)], (moments[(i, i)] - moments[(j, j)]).abs());
                let most = match are_apart(sd, gap) {
                    true => sd / gap,
                    false => FRAC_PI_2,
                };
                let turns = (1..=TURNS).flat_map(|turn| {
                    let (sin, cos) = (most * f64::from(turn) / f64::from(TURNS)).sin_cos();
                    [sin, -sin].map(|sin| axis * cos + axes.column(j) * sin)
                });
                let change = |axis: Vector3<f64>| (covered(&axis) / straight - 1.0).abs();
                turns.map(change).fold(0.0, f64::max)
            });
            changes.fold(0.0, f64::hypot)
        };
        Ok([0, 1, 2].map(of))
    }
}

#[cfg(test)]
mod tests {
    use super::super::testing::{egg, local_errors};
    use super::*;
    use crate::measure::Scheme;
    use crate::model::Grain;
    use approx::assert_relative_eq;

    fn told(grain: &Grain) -> ([Outline; 3], [OutlineErrors; 3]) {
        let survey = Survey::of_grain(grain, Scheme::Exact);
        let outlines = survey.projections().unwrap();
        let errors = survey.projection_errors(&outlines).unwrap().unwrap();
        (outlines, errors)
    }

    #[test]
    fn an_outline_is_as_uncertain_as_the_surface_on_its_rim_and_the_dimensions_that_are_seen() {
        let (outlines, errors) = told(&egg([5.0, 4.0, 3.0, 2.0, 1.0], 0.02));
        for (i, one, other) in [(0, 0.02, 0.01), (1, 0.01, 0.03), (2, 0.03, 0.02)] {
            let (outline, off) = (&outlines[i], errors[i]);
            let seen = f64::hypot(one, other);
            let area = (0.02 * outline.perimeter / outline.area).max(seen);
            assert_relative_eq!(off.area, area, max_relative = 1e-3);
            let perimeter = (0.02 * TAU / outline.perimeter).max(seen / 2.0);
            assert_relative_eq!(off.perimeter, perimeter.hypot(0.05), max_relative = 1e-3);
            let diameter = f64::max(one, other);
            assert_relative_eq!(off.diameter, diameter, max_relative = 1e-3);
            assert_relative_eq!(off.inscribed, diameter, max_relative = 1e-3);
        }
    }

    /// Of tips that are known badly only the outlines that show them suffer.
    #[test]
    fn the_rim_of_an_outline_is_what_the_lines_of_sight_graze() {
        let grain = egg([0.0; 5], 0.0);
        let axes = Survey::of_grain(&grain, Scheme::Exact).unit_axes().unwrap();
        let along = axes.column(0).into_owned();
        let is_tip = |n: &Vector3<f64>| n.dot(&along).abs() > 0.8;
        let local = local_errors(|n| if is_tip(n) { 0.1 } else { 0.0 });
        let (outlines, errors) = told(&grain.with_local_errors(local));
        let inscribed = 2.0 * errors[1].area * outlines[1].area
            / (outlines[1].perimeter * outlines[1].inscribed_diameter);
        assert_relative_eq!(errors[1].inscribed, inscribed, max_relative = 1e-2);
        assert!(errors[0].area < 2e-4, "{errors:?}");
        assert!(errors[1].area > 0.01 && errors[2].area > 0.01, "{errors:?}");
    }

    /// Two moments that cannot be told apart: the axes along which width and thickness are seen may be any.
    #[test]
    fn turns_of_the_axes_change_outlines() {
        let grain = egg([0.0; 5], 0.0);
        let survey = Survey::of_grain(&grain, Scheme::Exact);
        let moments = survey.principal().unwrap().moments;
        let errors = StandardErrors {
            inertia: Matrix3::from_element(0.05 * (moments.z - moments.y)),
            ..StandardErrors::NONE
        };
        let (outlines, errors) = told(&grain.clone().with_standard_errors(Ok(errors)));
        let ratio = outlines[2].area / outlines[1].area;
        // An ellipse's shadow: A² = (A cos)² + (B sin)², of a turn by .05.
        let turned = (0.05_f64.cos().powi(2) + (0.05_f64.sin() * ratio).powi(2)).sqrt() - 1.0;
        assert_relative_eq!(errors[1].area, turned.hypot(OF_MESH), max_relative = 0.2);
    }
}
