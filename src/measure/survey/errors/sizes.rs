//! How well the least box, the ellipsoid of equal moments and the convex hull are known.

use super::{OF_MESH, Survey, SurveyError};
use crate::measure::boxes::minimum_box::{LeastBoxes, boxes_beside};
use crate::measure::{Convexity, SideRatios};
use crate::sphere::cube_grid;
use crate::spread::root_mean_square;
use nalgebra::Vector3;

/// Cells along an edge of the cube of directions of the surface that are looked at.
const LOOKED_AT: usize = 12;

/// Standard errors, at most, of a box of least volume.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct BoxErrors {
    /// Of length, width and thickness.
    pub extents: Vector3<f64>,
    /// Of the volume.
    pub volume: f64,
}

impl Survey<'_> {
    /// Standard errors, at most, of the [least box](Self::minimum_box). Of the sides each that of the dimension that is known worst, as
    /// a share, for the box need not lie along the dimensions, and by what other boxes differ whose volumes are no larger than
    /// that of this one may be: any of them may be the least, the less likely the larger it is. Of the volume that of three such dimensions. `None` where the grain
    /// tells no errors of its dimensions.
    ///
    /// # Errors
    ///
    /// As [`Self::minimum_box`].
    pub fn minimum_box_errors(&self) -> Result<Option<BoxErrors>, SurveyError> {
        let found = self.box_errors.get_or_init(|| self.found_box_errors());
        found.clone()
    }

    fn found_box_errors(&self) -> Result<Option<BoxErrors>, SurveyError> {
        let Some(off) = self.relative_dimension_errors()? else {
            return Ok(None);
        };
        let share = off.max().hypot(OF_MESH);
        let LeastBoxes { least, others } = self.unit_least_boxes()?;
        let volume = 3.0 * share * least.volume();
        let largest = least.volume() + volume;
        // What is no local minimum differs from the least by no more than the surface does between places that lie close together.
        let beside = boxes_beside(self.hull()?, least, [share, 3.0 * share]);
        let others = others.iter().filter(|other| other.volume() <= largest);
        let rivals = others.chain(&beside);
        let sd = off.norm().hypot(OF_MESH) * least.volume();
        let apart = rivals.fold(Vector3::zeros(), |apart: Vector3<f64>, other| {
            let larger = (other.volume() - least.volume()) / sd;
            let likely = (-0.25 * larger * larger).exp();
            apart.sup(&((other.extents - least.extents).abs() * likely))
        });
        let sides = least
            .extents
            .zip_map(&apart, |side, apart| (side * share).hypot(apart));
        Ok(Some(BoxErrors {
            extents: self.scale.vector(&sides),
            volume: self.scale.volume(volume),
        }))
    }

    /// The same of the [ratios of its sides](Self::side_ratios).
    ///
    /// # Errors
    ///
    /// As [`Self::side_ratios`].
    pub fn side_ratio_errors(&self) -> Result<Option<SideRatios>, SurveyError> {
        let ratios = self.side_ratios()?;
        let sides = self.minimum_box()?.extents;
        Ok(self.minimum_box_errors()?.map(|off| {
            let off = off.extents.component_div(&sides);
            SideRatios {
                short_to_long: ratios.short_to_long * (off.z + off.x),
                intermediate_to_long: ratios.intermediate_to_long * (off.y + off.x),
                short_to_intermediate: ratios.short_to_intermediate * (off.z + off.y),
            }
        }))
    }

    /// Standard errors, at most, of the semi-axes of the [ellipsoid of equal moments](Self::ellipsoid), a² = 5 (J + K - I) / 2 V
    /// with the moments I about this axis, J and K about the others.
    ///
    /// # Errors
    ///
    /// As [`Self::ellipsoid`].
    pub fn ellipsoid_errors(&self) -> Result<Option<Vector3<f64>>, SurveyError> {
        let semi_axes = self.ellipsoid()?.semi_axes;
        // Where there are none, moments may be beyond the range of numbers.
        let Ok(errors) = self.standard_errors() else {
            return Ok(None);
        };
        let (moments, volume) = (self.principal()?.moments, self.volume()?);
        let (all, off) = (moments.sum(), errors.moments.sum());
        let of_axis = |semi_axis: f64, moment: f64| {
            let square = off / (all - 2.0 * moment) + errors.volume / volume;
            0.5 * semi_axis * square
        };
        Ok(Some(semi_axes.zip_map(&moments, of_axis)))
    }

    /// Standard errors, at most, of [how much of its hull the body fills](Self::convexity): as the surface may be off, all of it alike
    /// where the hull touches it and not at all elsewhere. `None` where the grain does not tell how well its surface is known.
    ///
    /// # Errors
    ///
    /// As [`Self::convexity`].
    pub fn convexity_errors(&self) -> Result<Option<Convexity>, SurveyError> {
        let found = self.convexity()?;
        let (Ok(errors), Some(surface)) = (self.standard_errors(), self.surface_error()) else {
            return Ok(None);
        };
        let (area, volume) = (self.area()?, self.volume()?);
        let hull = (surface * area / volume).hypot(OF_MESH);
        Ok(Some(Convexity {
            volume: found.volume * (hull + errors.volume / volume),
            area: found.area * (2.0 / 3.0 * hull + errors.area / area),
        }))
    }

    /// How far the surface may be off, the root mean square over directions.
    fn surface_error(&self) -> Option<f64> {
        let (directions, _) = cube_grid(LOOKED_AT);
        let places = directions.iter();
        let places = places.map(|n| Some(self.body.local_error(n)?.place));
        let places: Vec<f64> = places.collect::<Option<_>>()?;
        Some(root_mean_square(places) * self.scale.length)
    }
}

#[cfg(test)]
mod tests {
    use super::super::testing::egg;
    use super::*;
    use crate::measure::Scheme;
    use approx::assert_relative_eq;

    /// Of a round egg boxes that lie otherwise are larger by some percent.
    #[test]
    fn the_least_box_and_its_ratios_are_as_uncertain_as_the_worst_dimension_and_boxes_as_small() {
        let told = |percent: f64| {
            let grain = egg([0.0, 0.0, percent / 2.0, percent, percent / 5.0], 0.02);
            let survey = Survey::of_grain(&grain, Scheme::Exact);
            let ratios = survey.side_ratios().unwrap();
            let off = survey.side_ratio_errors().unwrap().unwrap();
            let found = survey.minimum_box().unwrap();
            let errors = survey.minimum_box_errors().unwrap().unwrap();
            let ratio = off.short_to_long / ratios.short_to_long;
            (found, errors, ratio)
        };
        let (found, off, ratio) = told(0.1);
        let share = 0.001_f64.hypot(OF_MESH);
        let beyond = (off.extents - found.extents * share).component_div(&found.extents);
        assert!(
            beyond.min() >= 0.0 && beyond.max() < 2.0 * share,
            "{beyond}"
        );
        assert_relative_eq!(
            off.volume,
            3.0 * share * found.volume(),
            max_relative = 1e-9
        );
        assert!((2.0 * share..6.0 * share).contains(&ratio), "{ratio}");
        let (found, off, _) = told(1.0);
        assert!(off.extents.z > 1.2 * 0.01 * found.extents.z, "{off:?}");
        assert_relative_eq!(off.volume, 0.03 * found.volume(), max_relative = 1e-3);
    }

    /// a² = 5 (J + K - I) / 2 V: of moments that are off by one, two and three percent, and a volume by four.
    #[test]
    fn semi_axes_are_as_uncertain_as_the_moments_and_the_volume() {
        let grain = egg([5.0, 4.0, 0.5, 1.0, 0.2], 0.02);
        let survey = Survey::of_grain(&grain, Scheme::Exact);
        let off = survey.ellipsoid_errors().unwrap().unwrap();
        let semi_axes = survey.ellipsoid().unwrap().semi_axes;
        let moments = survey.principal().unwrap().moments;
        let errors = 0.01 * moments.x + 0.02 * moments.y + 0.03 * moments.z;
        let square = errors / (moments.y + moments.z - moments.x) + 0.04;
        assert_relative_eq!(off.x / semi_axes.x, square / 2.0, max_relative = 1e-9);
    }

    #[test]
    fn a_hull_may_be_off_as_the_surface_is() {
        let grain = egg([5.0, 4.0, 0.5, 1.0, 0.2], 0.02);
        let survey = Survey::of_grain(&grain, Scheme::Exact);
        let (found, off) = (
            survey.convexity().unwrap(),
            survey.convexity_errors().unwrap().unwrap(),
        );
        let hull = 0.02 * survey.area().unwrap() / survey.volume().unwrap();
        assert_relative_eq!(off.volume / found.volume, hull + 0.04, max_relative = 1e-3);
        assert_relative_eq!(
            off.area / found.area,
            hull * 2.0 / 3.0 + 0.05,
            max_relative = 1e-3
        );
    }
}
