//! How well curvature is known.
//!
//! Where a surface is off by h along its normal, its curvature tensor is off by the second derivatives of h. Where these know no
//! direction, with a norm k: the mean curvature by k / 2, half the difference of the principal curvatures and what turns them by
//! k / sqrt(8) each, and none of these has to do with another (see `fit::estimate::curvature`).

use super::chance::{Part, error_of_mean};
use super::known::KnownPlace;
use super::{Survey, SurveyError};
use crate::measure::Distribution;
use crate::measure::curvature::kind::{End, Kind};
use crate::measure::curvature::statistics::is_convex;
use std::f64::consts::SQRT_2;

/// Share of itself by which the total curvature of a grain may be off by quadrature.
const OF_TOTAL: f64 = 5e-4;

/// The same of the convex share, for nodes may lie in rows along its border; of bodies that are all convex nothing is.
const OF_SHARE: f64 = 4e-3;

/// Share of the error of its curvature by which all of a surface may be off alike.
const ALIKE: f64 = 0.25;

/// Standard errors of curvature over a surface.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize)]
#[non_exhaustive]
pub struct CurvatureErrors {
    /// Of mean curvature.
    pub mean: Distribution,
    /// Of Gaussian curvature.
    pub gaussian: Distribution,
    /// Of the larger principal curvature.
    pub larger: Distribution,
    /// Of the smaller principal curvature.
    pub smaller: Distribution,
    /// Of the share of the area that is convex.
    pub convex_share: f64,
}

impl Survey<'_> {
    /// Standard errors of the [curvature](Self::curvature). Of means, deviations and the share: what bends is expected to add, for it does
    /// not cancel, what the nodes of deviations miss, what lies between the places where errors are told as far as the ends are in doubt, and chance, of patches of the surface that have nothing to do with each other; of the mean of H and K no more
    /// than what moves them, which is the surface itself. Of the least and largest values: that of the place where they are, by how much
    /// they are more than the surface turns there, and how much farther another place may be. `None` where the grain tells no
    /// errors.
    ///
    /// # Errors
    ///
    /// As [`Self::curvature`].
    pub fn curvature_errors(&self) -> Result<Option<CurvatureErrors>, SurveyError> {
        let found = self.curvature()?;
        let (Ok(errors), Some(places)) = (self.standard_errors(), self.known_places()) else {
            return Ok(None);
        };
        let length = self.scale.length;
        let [area, volume] = [errors.area / self.area()?, errors.volume / self.volume()?];
        let whole: f64 = places.iter().map(|place| place.area).sum();
        let mean_by = |value: &dyn Fn([f64; 2]) -> f64| {
            let parts: Vec<Part<8>> = places
                .iter()
                .map(|place| bent(place, |k| [1.0, value(k)]))
                .collect();
            error_of_mean(&parts, 0.0)
        };
        let told = Kind::ALL.map(|kind| found.at_unit_size(kind));
        let of_mean_curvature = moved(places, whole, told[Kind::Mean as usize].mean)
            .hypot(told[Kind::Mean as usize].mean * (area + volume / 3.0));
        let apart = mean_by(&|[larger, smaller]| 0.5 * (larger - smaller));
        let total = area.hypot(found.gauss_bonnet_error()).hypot(OF_TOTAL);
        let of = |kind: Kind| {
            let own = told[kind as usize];
            let variance = own.standard_deviation.powi(2);
            let end = |end: End| self.end_error(kind, end, places);
            let (least, largest) = (end(End::Least)?, end(End::Largest)?);
            let square = |k| (kind.of(k) - own.mean).powi(2);
            let squares = places
                .iter()
                .map(|place| square(place.principal) * place.area);
            let between = variance - squares.sum::<f64>() / whole;
            let doubt = (least / (own.least - own.mean))
                .abs()
                .max((largest / (own.largest - own.mean)).abs());
            let of_variance = mean_by(&square)
                .hypot(found.missed_variance(kind, own.mean))
                .hypot(between * (2.0 * doubt).min(1.0));
            let per = kind.per(length);
            Ok::<_, SurveyError>(Distribution {
                mean: per
                    * match kind {
                        Kind::Mean => of_mean_curvature,
                        Kind::Gaussian => own.mean * total,
                        Kind::Larger | Kind::Smaller => of_mean_curvature + apart,
                    },
                standard_deviation: per
                    * ((variance + of_variance).sqrt() - own.standard_deviation),
                least: per * least,
                largest: per * largest,
            })
        };
        // Ripples of a fit bend flat sides both ways already: all of them may be off alike.
        let convex = |alike: f64| -> f64 {
            let bent = |place: &&KnownPlace| {
                is_convex(place.principal[1] + alike * place.off.curvature, whole)
            };
            places.iter().filter(bent).map(|place| place.area).sum()
        };
        let [more, less] = [ALIKE, -ALIKE].map(|alike| (convex(alike) - convex(0.0)).abs() / whole);
        let share = found.convex_share();
        let of_nodes = OF_SHARE * (4.0 * share * (1.0 - share)).max(0.0).sqrt();
        Ok(Some(CurvatureErrors {
            mean: of(Kind::Mean)?,
            gaussian: of(Kind::Gaussian)?,
            larger: of(Kind::Larger)?,
            smaller: of(Kind::Smaller)?,
            convex_share: mean_by(&|k| f64::from(is_convex(k[1], whole)))
                .max(more)
                .max(less)
                .hypot(of_nodes),
        }))
    }
}

/// A place of a surface as it may be bent.
pub(super) fn bent(place: &KnownPlace, sums: impl Fn([f64; 2]) -> [f64; 2]) -> Part<8> {
    let [larger, smaller] = place.principal;
    let (mean, apart) = (0.5 * (larger + smaller), 0.5 * (larger - smaller));
    let off = place.off.curvature;
    let may_be = [0, 1, 2, 3, 4, 5, 6, 7].map(|signs: u8| {
        let sign = |bit: u8| if signs >> bit & 1 == 0 { 1.0 } else { -1.0 };
        let mean = mean + sign(0) * off / 2.0;
        let turn = off / (2.0 * SQRT_2);
        let apart = (apart + sign(1) * turn).hypot(sign(2) * turn);
        sums([mean + apart, mean - apart])
    });
    Part {
        measure: place.area,
        patch: place.patch,
        told: sums(place.principal),
        may_be,
    }
}

/// Standard error by chance of the mean M of the mean curvature H: where the surface moves by h, the integral of H changes by that of K h,
/// and the area by that of 2 H h.
fn moved(places: &[KnownPlace], whole: f64, mean: f64) -> f64 {
    let variance = |place: &KnownPlace| {
        let [larger, smaller] = place.principal;
        let change = larger * smaller - (larger + smaller) * mean;
        (change * place.off.place).powi(2) * place.patch * place.area
    };
    places.iter().map(variance).sum::<f64>().sqrt() / whole
}

#[cfg(test)]
mod tests {
    use super::super::testing::bent_egg;
    use super::*;
    use crate::measure::Scheme;
    use crate::model::{
        Family, Frame, Grain, LocalError, LocalErrors, StandardErrors, StarGrain, Whole,
    };
    use crate::sphere::CubeCell;
    use approx::assert_relative_eq;
    use nalgebra::{Matrix3, Point3};
    use std::f64::consts::PI;

    fn told(grain: &Grain) -> CurvatureErrors {
        let survey = Survey::of_grain(grain, Scheme::Exact);
        survey.curvature_errors().unwrap().unwrap()
    }

    #[test]
    fn without_errors_of_the_surface_there_are_none_of_its_curvature() {
        let grain = bent_egg(0.0, 0.0).with_local_errors(None);
        let survey = Survey::of_grain(&grain, Scheme::Exact);
        assert_eq!(survey.curvature_errors(), Ok(None));
    }

    /// The egg is nearly a ball of radius R: its mean curvature changes by h / R², and is off alike over 8 pi h / k.
    #[test]
    fn the_mean_of_mean_curvature_moves_with_the_surface_only() {
        let (place, curvature) = (1e-3, 4e-2);
        let grain = bent_egg(place, curvature);
        let survey = Survey::of_grain(&grain, Scheme::Exact);
        let (area, mean) = (
            survey.area().unwrap(),
            survey.curvature().unwrap().mean().mean,
        );
        let patch = 8.0 * PI * place / curvature;
        let expected = mean * mean * place * (patch / area).sqrt();
        assert_relative_eq!(told(&grain).mean.mean, expected, max_relative = 0.1);
    }

    /// A peak at the pole, between the places where errors are told; its sharpness is in doubt.
    #[test]
    fn deviations_are_in_doubt_as_far_as_they_come_from_between_the_places() {
        let degree = 110;
        let mut harmonics = vec![0.0; (degree + 1) * (degree + 1)];
        for l in 0..=degree {
            let own = l as f64;
            harmonics[l * l + l] = 3e-5 * (2.0 * own + 1.0).sqrt() * (-(own / 45.0).powi(2)).exp();
        }
        harmonics[0] = 3.5;
        let frame = Frame {
            centre: Point3::origin(),
            axes: Matrix3::identity(),
        };
        let peak = Family::Whole(Whole::new(harmonics).unwrap());
        let peak = StarGrain::new(frame, peak).unwrap();
        let cells = CubeCell::uniform(LocalErrors::PARTS);
        let error = LocalError {
            place: 1e-6,
            curvature: 1e-3,
        };
        let grain = Grain::from(peak)
            .with_standard_errors(Ok(StandardErrors::ZERO))
            .with_local_errors(LocalErrors::new(vec![error; cells.len()]));
        let survey = Survey::of_grain(&grain, Scheme::Exact);
        let found = survey.curvature().unwrap().mean().standard_deviation;
        assert!(told(&grain).mean.standard_deviation > 0.3 * found);
    }

    /// k1 - k2 of the egg is small beside what bends it: half of it is expected to be the length of two parts of k / sqrt(8) each.
    #[test]
    fn what_bends_parts_the_principal_curvatures() {
        let curvature = 20.0;
        let off = told(&bent_egg(1e-4, curvature));
        let expected = curvature / 2.0;
        assert_relative_eq!(off.larger.mean, expected, max_relative = 0.1);
        assert_relative_eq!(off.smaller.mean, expected, max_relative = 0.1);
        assert!(off.mean.mean < 1e-3 * expected, "{off:?}");
    }
}
