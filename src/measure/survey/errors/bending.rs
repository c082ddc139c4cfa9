//! How well curvature, and roundness that follows from it, is known.
//!
//! Where a surface is off by h along its normal, its curvature tensor is off by the second derivatives of h. Where these know no
//! direction, with a norm k: the mean curvature by k / 2, half the difference of the principal curvatures and what turns them by
//! k / sqrt(8) each, and none of these has to do with another (see `fit::estimate::curvature`).

use super::chance::{Part, error_of_mean};
use super::known::KnownPlace;
use super::{Survey, SurveyError};
use crate::measure::curvature_statistics::{End, Kind, is_convex};
use crate::measure::followed::unfollowed;
use crate::measure::{Curvature, Distribution};
use std::f64::consts::{LN_2, SQRT_2};

/// Share of itself by which the roundness of a smooth grain may be off by quadrature.
const OF_ROUNDNESS: f64 = 5e-3;

/// Share of itself by which the total curvature of a grain may be off by quadrature.
const OF_TOTAL: f64 = 5e-4;

/// Of all places the one is told where what it bends and what it is off by add up: its error over that of any place, as fits of particles
/// whose truth is known ask for.
const SELECTED: f64 = 1.5;

/// Share of the error of its curvature by which all of a surface may be off alike.
const ALIKE: f64 = 0.5;

/// Standard errors from where it is told to which a place is looked at, and by how many halvings of the distance it is found how far the
/// farthest is beyond it.
const FARTHEST: f64 = 4.0;
const HALVINGS: usize = 12;

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
    /// not cancel, and chance, of patches of the surface that have nothing to do with each other; of the mean of H and K no more
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
        let length = self.unit.length;
        let [area, volume] = [errors.area / self.area()?, errors.volume / self.volume()?];
        let whole: f64 = places.iter().map(|place| place.area).sum();
        let mean_by = |value: &dyn Fn([f64; 2]) -> f64| {
            let parts: Vec<Part<8>> = places
                .iter()
                .map(|place| bent(place, whole, |k| [1.0, value(k)]))
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
            let of_variance = mean_by(&|k| (kind.of(k) - own.mean).powi(2));
            let end = |end: End| self.end_error(kind, end, places);
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
                least: per * end(End::Least)?,
                largest: per * end(End::Largest)?,
            })
        };
        // Ripples of a fit bend flat sides both ways already: all of them may be off alike.
        let convex = |curvature: f64| {
            let [mut share, mut all] = [0.0; 2];
            for place in places {
                let off = curvature * place.off.curvature;
                share += place.area * f64::from(is_convex(place.principal[1] + off, whole));
                all += place.area;
            }
            share / all
        };
        let alike = [ALIKE, -ALIKE].map(|times| (convex(times) - convex(0.0)).abs());
        Ok(Some(CurvatureErrors {
            mean: of(Kind::Mean)?,
            gaussian: of(Kind::Gaussian)?,
            larger: of(Kind::Larger)?,
            smaller: of(Kind::Smaller)?,
            convex_share: mean_by(&|k| f64::from(is_convex(k[1], whole)))
                .max(alike[0])
                .max(alike[1]),
        }))
    }

    /// Standard error of the [roundness](Self::roundness): what bends, and the inscribed sphere. `None` where the grain tells no errors.
    ///
    /// # Errors
    ///
    /// As [`Self::roundness`].
    pub fn roundness_error(&self) -> Result<Option<f64>, SurveyError> {
        let roundness = self.roundness()?;
        let (Some(of_radius), Some(places)) = (self.inscribed_error()?, self.known_places()) else {
            return Ok(None);
        };
        let whole: f64 = places.iter().map(|place| place.area).sum();
        let radius = self.unit_inscribed()?.radius;
        let corners = |radius: f64| {
            move |[larger, _]: [f64; 2]| match larger * radius > 1.0 {
                true => [1.0, 1.0 / (larger * radius)],
                false => [0.0; 2],
            }
        };
        let parts: Vec<Part<8>> = places
            .iter()
            .map(|place| bent(place, whole, corners(radius)))
            .collect();
        let mut error = error_of_mean(&parts, 1.0).hypot(OF_ROUNDNESS * roundness);
        let share = of_radius / self.inscribed()?.radius;
        let found = self.corners()?;
        let of = |share: f64| found.roundness(radius * (1.0 + share));
        error += [of(share), of(-share)]
            .map(|other| (other - roundness).abs())
            .into_iter()
            .fold(0.0, f64::max);
        Ok(Some(error))
    }

    /// The same of the [regularity](Self::regularity): half of those of roundness and sphericity.
    ///
    /// # Errors
    ///
    /// As [`Self::regularity`].
    pub fn regularity_error(&self) -> Result<Option<f64>, SurveyError> {
        self.regularity()?;
        let (roundness, spheres) = (self.roundness_error()?, self.sphericity_errors()?);
        let both = roundness.zip(spheres);
        Ok(both.map(|(roundness, spheres)| 0.5 * (roundness + spheres.inscribed_enclosing)))
    }

    /// Of a least or a largest value, at unit size.
    fn end_error(&self, kind: Kind, end: End, places: &[KnownPlace]) -> Result<f64, SurveyError> {
        let surface = self.body.surface()?;
        let (n, told) = self.any_curvature()?.end(kind, end);
        if !told.is_finite() {
            return Ok(f64::NAN);
        }
        let own = self.body.local_error(&n).unwrap_or_default().curvature;
        let principal = Curvature::new(&n, &surface.jet(&n)).principal;
        let ripple = kind.off(principal, [0, 1].map(|i| unfollowed(surface, &n, i)));
        let off = |principal: [f64; 2], curvature: f64| kind.off(principal, [curvature; 2]);
        let whole = places.iter().map(|place| place.area).sum();
        let rivals = places.iter().map(|place| Rival {
            beyond: end.sign() * (kind.of(place.principal) - told),
            off: off(place.principal, place.off.curvature),
            patches: place.area / place.patch(whole),
        });
        Ok((SELECTED * off(principal, own))
            .max(expected_beyond(rivals))
            .hypot(ripple))
    }
}

/// A place where a curvature may be beyond the value that is told.
struct Rival {
    /// How far it is beyond it; as a rule below zero.
    beyond: f64,
    off: f64,
    /// How many places are off by themselves in what it stands for.
    patches: f64,
}

/// How far beyond the value that is told the largest of all rivals is as likely as not; zero if not so.
fn expected_beyond(rivals: impl Iterator<Item = Rival>) -> f64 {
    let rivals: Vec<Rival> = rivals
        .filter(|rival| rival.beyond + FARTHEST * rival.off > 0.0)
        .collect();
    let farther = |than: f64| -> f64 {
        let number = |rival: &Rival| {
            let deviations = (than - rival.beyond) / rival.off;
            rival.patches * 0.5 * libm::erfc(deviations / SQRT_2)
        };
        rivals.iter().map(number).sum()
    };
    let reach = |rival: &Rival| rival.beyond + FARTHEST * rival.off;
    let (mut low, mut high) = (0.0, rivals.iter().map(reach).fold(0.0, f64::max));
    for _ in 0..HALVINGS {
        let middle = 0.5 * (low + high);
        if farther(middle) > LN_2 {
            low = middle;
        } else {
            high = middle;
        }
    }
    low
}

/// A place of a surface as it may be bent.
fn bent(place: &KnownPlace, whole: f64, sums: impl Fn([f64; 2]) -> [f64; 2]) -> Part<8> {
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
        patch: place.patch(whole),
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
        (change * place.off.place).powi(2) * place.patch(whole) * place.area
    };
    places.iter().map(variance).sum::<f64>().sqrt() / whole
}

#[cfg(test)]
mod tests {
    use super::super::testing::bent_egg;
    use super::*;
    use crate::measure::Scheme;
    use crate::model::Grain;
    use approx::assert_relative_eq;
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
        assert_eq!(survey.roundness_error(), Ok(None));
        assert_eq!(survey.regularity_error(), Ok(None));
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

    #[test]
    fn the_ends_are_off_as_the_surface_is_bent_where_they_are_and_where_others_may_be() {
        let narrow = told(&bent_egg(1e-3, 1e-3));
        assert_relative_eq!(narrow.larger.largest, SELECTED * 1e-3, max_relative = 0.2);
        assert_relative_eq!(narrow.smaller.least, SELECTED * 1e-3, max_relative = 0.2);
        assert_relative_eq!(
            narrow.mean.largest,
            SELECTED * 1e-3 / 2.0_f64.sqrt(),
            max_relative = 0.2
        );
        // One of some hundred patches is bent by more than two standard errors.
        let wide = told(&bent_egg(1e-3, 0.5));
        assert!((1.0..2.0).contains(&wide.larger.largest), "{wide:?}");
    }

    #[test]
    fn ends_of_rivals_are_those_of_the_farthest_of_them() {
        let rival = |beyond, patches| Rival {
            beyond,
            off: 1.0,
            patches,
        };
        // As likely as not one of n is beyond Q^-1(ln 2 / n), 2.46 for a hundred.
        let found = expected_beyond([rival(0.0, 100.0)].into_iter());
        assert_relative_eq!(found, 2.461, max_relative = 2e-3);
        let found = expected_beyond([rival(-1.0, 100.0), rival(-9.0, 1e3)].into_iter());
        assert_relative_eq!(found, 1.461, max_relative = 3e-3);
        assert_eq!(expected_beyond([rival(-9.0, 1e3)].into_iter()), 0.0);
    }

    #[test]
    fn roundness_is_off_as_the_surface_is_bent_and_the_sphere_inside_is() {
        let error = |place, curvature| {
            let grain = bent_egg(place, curvature);
            let survey = Survey::of_grain(&grain, Scheme::Exact);
            let error = survey.roundness_error().unwrap().unwrap();
            let regularity = survey.regularity_error().unwrap().unwrap();
            let spheres = survey
                .sphericity_errors()
                .unwrap()
                .unwrap()
                .inscribed_enclosing;
            assert_relative_eq!(regularity, 0.5 * (error + spheres), max_relative = 1e-12);
            error
        };
        let [least, bent, moved] = [error(0.0, 0.0), error(1e-4, 0.1), error(0.05, 1e-9)];
        assert!(least < 0.006, "{least}");
        assert!(bent > 3.0 * least && bent < 0.1, "{bent}");
        assert!(moved > 2.0 * least, "{moved}");
    }
}
