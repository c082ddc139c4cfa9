//! How well outlines are known.

use super::chance::{Part, error_of_mean};
use super::known::KnownPlace;
use super::{OF_MESH, Survey, SurveyError};
use crate::measure::outline::roundness::smoothed;
use crate::measure::{Outline, ROUNDNESS_ORDER, are_apart};
use crate::model::{LocalError, StandardErrors};
use crate::spread::root_mean_square;
use nalgebra::{Matrix3, Vector3};
use std::f64::consts::{FRAC_PI_2, PI, TAU};

/// By how much the roundness of a smooth outline may be off.
const OF_ROUNDNESS: f64 = 2e-3;

/// Cosine of the angle between a normal and the plane of an outline up to which a place is on its rim, beyond that of the place
/// that is nearest to it.
const ON_RIM: f64 = 0.05;

/// Turns to either side that are looked at.
const TURNS: u32 = 4;

/// Two dimensions that differ by fewer standard deviations may be taken for each other, and the outlines along them.
const TAKEN_FOR: f64 = 2.0;

/// Standard errors, at most, of what is measured of an outline, as shares of it, and of which of the dimensions it is seen along; those of ratios are sums of these, each times its
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
    /// Of the roundness, itself and no share: as the curvature on the rim may be off, of what is left of it where the outline is
    /// smoothed, and as the inscribed circle may.
    pub roundness: f64,
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
        let dimensions = self.dimensions()?;
        let sds = dimensions.component_mul(&off);
        let of = |i: usize| {
            let outline = &outlines[i];
            let (known, turned) = (rims[i], turned[i].hypot(OF_MESH));
            let rim = known.place;
            let (one, other) = (off[(i + 1) % 3], off[(i + 2) % 3]);
            let diameter = one.max(other).hypot(OF_MESH);
            let seen = one.hypot(other);
            let own_area = (rim * outline.perimeter / outline.area).max(seen);
            let own_perimeter = (rim * TAU / outline.perimeter).max(0.5 * seen);
            let inscribed = diameter.max(2.0 * rim / outline.inscribed_diameter);
            let is_taken_for = |j: &usize| {
                let gap = (dimensions[i] - dimensions[*j]).abs();
                *j != i && gap < TAKEN_FOR * sds[i].hypot(sds[*j])
            };
            let differs = |of: &dyn Fn(&Outline) -> f64| {
                let others = (0..3).filter(is_taken_for);
                let differ = others.map(|j| (of(&outlines[j]) / of(outline) - 1.0).abs());
                differ.fold(0.0, f64::max)
            };
            let diameters = differs(&|outline| outline.largest_feret)
                .max(differs(&|outline| outline.smallest_feret))
                .max(differs(&|outline| outline.enclosing_diameter));
            let roundness = roundness_error(outline, known, inscribed);
            OutlineErrors {
                area: own_area.hypot(turned).hypot(differs(&|o| o.area)),
                perimeter: own_perimeter
                    .hypot(area)
                    .hypot(turned)
                    .hypot(differs(&|o| o.perimeter)),
                diameter: diameter.hypot(diameters),
                inscribed: inscribed.hypot(differs(&|o| o.inscribed_diameter)),
                roundness: roundness.hypot(outline.roundness * differs(&|o| o.roundness)),
            }
        };
        Ok(Some([0, 1, 2].map(of)))
    }

    /// How far the surface may be off where lines along each axis graze it, the root mean square.
    fn rim_errors(&self, axes: &Matrix3<f64>) -> Option<[LocalError; 3]> {
        let places = self.known_places()?;
        let across = |known: &KnownPlace| (axes.tr_mul(&known.normal).map(f64::abs), known.off);
        let places: Vec<(Vector3<f64>, LocalError)> = places.iter().map(across).collect();
        let rim = |axis: usize| {
            let least =
                |least: f64, (normal, _): &(Vector3<f64>, LocalError)| least.min(normal[axis]);
            let limit = places.iter().fold(1.0, least) + ON_RIM;
            let on_rim = || {
                let all = places.iter();
                all.filter(|(normal, _)| normal[axis] <= limit)
                    .map(|(_, off)| off)
            };
            LocalError {
                place: root_mean_square(on_rim().map(|off| off.place)) * self.scale.length,
                curvature: root_mean_square(on_rim().map(|off| off.curvature)) / self.scale.length,
            }
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

/// Standard error of the roundness of an outline, where the rim is known so well and the inscribed circle to such a share.
fn roundness_error(outline: &Outline, rim: LocalError, inscribed: f64) -> f64 {
    let radius = 0.5 * outline.inscribed_diameter;
    let finest = TAU * ROUNDNESS_ORDER as f64 / outline.perimeter;
    let off = rim.curvature.min(rim.place * finest * finest);
    let patch = (4.0 * PI * rim.place / off).sqrt().min(outline.perimeter);
    let sums = |[speed, turn]: [f64; 2]| match turn * radius > speed {
        true => [turn, speed / radius],
        false => [0.0; 2],
    };
    let samples = smoothed(&outline.points);
    let parts: Vec<Part<2>> = samples
        .iter()
        .map(|&[speed, turn]| Part {
            measure: 1.0,
            patch: patch / speed,
            told: sums([speed, turn]),
            may_be: [off, -off].map(|off| sums([speed, turn + off * speed])),
        })
        .collect();
    let error = error_of_mean(&parts, 1.0).hypot(OF_ROUNDNESS);
    error + outline.roundness * inscribed
}

#[cfg(test)]
mod tests {
    use super::super::testing::{bent_egg, egg, local_errors};
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

    /// Length and width that may be taken for each other, and the outlines along them.
    #[test]
    fn outlines_along_dimensions_that_are_taken_for_each_other_are_off_by_what_they_differ() {
        let (outlines, clear) = told(&egg([0.0; 5], 0.02));
        let (_, errors) = told(&egg([0.0, 0.0, 40.0, 40.0, 0.0], 0.02));
        for (i, j) in [(0, 1), (1, 0)] {
            let differ = outlines[j].area / outlines[i].area - 1.0;
            assert!(differ.abs() > 0.1 && errors[i].area >= differ.abs());
            let differ = outlines[j].largest_feret / outlines[i].largest_feret - 1.0;
            assert!(errors[i].diameter > differ.abs() && clear[i].diameter < 0.01);
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

    /// Corners of the smoothed outline are off as the rim is bent, and by no more than its waves can be where the rim is well known.
    #[test]
    fn the_roundness_of_an_outline_is_off_as_its_rim_is_bent() {
        let error = |place, curvature| told(&bent_egg(place, curvature)).1[1].roundness;
        let [least, bent, wavy] = [error(0.0, 0.0), error(1e-3, 0.05), error(1e-9, 0.05)];
        assert!(least < 1.1 * OF_ROUNDNESS, "{least}");
        assert!(bent > 3.0 * least && bent < 0.2, "{bent}");
        assert!(wavy < 1.1 * least, "{wavy}");
    }

    /// Two moments that cannot be told apart: the axes along which width and thickness are seen may be any.
    #[test]
    fn turns_of_the_axes_change_outlines() {
        let grain = egg([0.0; 5], 0.0);
        let survey = Survey::of_grain(&grain, Scheme::Exact);
        let moments = survey.principal().unwrap().moments;
        let errors = StandardErrors {
            inertia: Matrix3::from_element(0.05 * (moments.z - moments.y)),
            ..StandardErrors::ZERO
        };
        let (outlines, errors) = told(&grain.clone().with_standard_errors(Ok(errors)));
        let ratio = outlines[2].area / outlines[1].area;
        // An ellipse's shadow: A² = (A cos)² + (B sin)², of a turn by .05.
        let turned = (0.05_f64.cos().powi(2) + (0.05_f64.sin() * ratio).powi(2)).sqrt() - 1.0;
        assert_relative_eq!(errors[1].area, turned.hypot(OF_MESH), max_relative = 0.2);
    }
}
