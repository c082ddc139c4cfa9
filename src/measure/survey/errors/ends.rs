//! How well the least and largest curvatures are known.

use super::known::KnownPlace;
use super::{Survey, SurveyError};
use crate::measure::Curvature;
use crate::measure::curvature::kind::{End, Kind};
use crate::measure::curvature::unfollowed::unfollowed;
use nalgebra::Vector3;
use std::f64::consts::{LN_2, SQRT_2};

/// Of all places the one is told where what it bends and what it is off by add up: its error over that of any place, as fits of particles
/// whose truth is known ask for.
const SELECTED: f64 = 1.5;

/// The places near by: as many as a cell of errors holds.
const NEAR: usize = 4;

/// Standard errors from where it is told to which a place is looked at, and by how many halvings of the distance it is found how far the
/// farthest is beyond it.
const FARTHEST: f64 = 4.0;
const HALVINGS: usize = 12;

impl Survey<'_> {
    /// Standard error of a least or a largest value, at unit size: of the place where it is, of a ripple there that is too narrow for
    /// anything to have told it, and of other places that may be beyond it.
    pub(super) fn end_error(
        &self,
        kind: Kind,
        end: End,
        places: &[KnownPlace],
    ) -> Result<f64, SurveyError> {
        let surface = self.body.surface()?;
        let (n, told) = self.any_curvature()?.end(kind, end);
        if !told.is_finite() {
            return Ok(f64::NAN);
        }
        let own = self.body.local_error(&n).unwrap_or_default().curvature;
        let principal = Curvature::new(&n, &surface.jet(&n)).principal;
        let ripple = kind.off(principal, [0, 1].map(|i| unfollowed(surface, &n, i)));
        let off = |principal: [f64; 2], curvature: f64| kind.off(principal, [curvature; 2]);
        let rivals = places.iter().map(|place| Rival {
            beyond: end.sign() * (kind.of(place.principal) - told),
            off: off(place.principal, place.off.curvature),
            patches: place.area / place.patch,
        });
        let times = SELECTED.max(sharper(&surface.place(&n), &principal, places));
        Ok((times * off(principal, own))
            .max(expected_beyond(rivals))
            .hypot(ripple))
    }
}

/// How many times as sharply the surface is curved where it has a place as at the places near by whose errors are known: in a dimple
/// between them it is off by as much more.
fn sharper(place: &Vector3<f64>, principal: &[f64; 2], places: &[KnownPlace]) -> f64 {
    let away = |known: &KnownPlace| (known.place - place).norm_squared();
    let mut near: Vec<(f64, f64)> = places
        .iter()
        .map(|known| (away(known), square(&known.principal)))
        .collect();
    let count = NEAR.min(near.len());
    if count == 0 {
        return 1.0;
    }
    near.select_nth_unstable_by(count - 1, |one, other| one.0.total_cmp(&other.0));
    let of_near: f64 = near[..count].iter().map(|(_, square)| square).sum();
    let times = (square(principal) * count as f64 / of_near).sqrt();
    if times.is_finite() { times } else { 1.0 }
}

fn square([larger, smaller]: &[f64; 2]) -> f64 {
    larger * larger + smaller * smaller
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

#[cfg(test)]
mod tests {
    use super::super::testing::bent_egg;
    use super::*;
    use crate::measure::{CurvatureErrors, Scheme};
    use crate::model::LocalError;
    use approx::assert_relative_eq;

    #[test]
    fn the_ends_are_off_as_the_surface_is_bent_where_they_are_and_where_others_may_be() {
        let told = |place, curvature| -> CurvatureErrors {
            let grain = bent_egg(place, curvature);
            let survey = Survey::of_grain(&grain, Scheme::Exact);
            survey.curvature_errors().unwrap().unwrap()
        };
        let narrow = told(1e-3, 1e-3);
        assert_relative_eq!(narrow.larger.largest, SELECTED * 1e-3, max_relative = 0.2);
        assert_relative_eq!(narrow.smaller.least, SELECTED * 1e-3, max_relative = 0.2);
        assert_relative_eq!(
            narrow.mean.largest,
            SELECTED * 1e-3 / 2.0_f64.sqrt(),
            max_relative = 0.2
        );
        // One of some hundred patches is bent by more than two standard errors.
        let wide = told(1e-3, 0.5);
        assert!((1.0..2.0).contains(&wide.larger.largest), "{wide:?}");
    }

    #[test]
    fn a_dimple_between_places_is_off_by_as_much_more_as_it_is_sharper() {
        let known = |x: f64, principal| KnownPlace {
            place: Vector3::new(x, 0.0, 0.0),
            normal: Vector3::z(),
            principal,
            area: 1.0,
            off: LocalError::default(),
            patch: 1.0,
        };
        let beside = [-2.0, -1.0, 1.0, 2.0].map(|x| known(x, [3.0, -1.0]));
        let places = [&beside[..], &[known(9.0, [500.0, 0.0])]].concat();
        let at = |principal| sharper(&Vector3::zeros(), &principal, &places);
        assert_relative_eq!(at([3.0, -1.0]), 1.0);
        assert_relative_eq!(at([-60.0, -20.0]), 20.0);
        assert_eq!(sharper(&Vector3::zeros(), &[1.0, 1.0], &[]), 1.0);
        let flat = [known(0.0, [0.0, 0.0])];
        assert_eq!(sharper(&Vector3::zeros(), &[0.0, 0.0], &flat), 1.0);
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
}
