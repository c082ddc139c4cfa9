//! When so much of a grain was not seen that it is told of, and what that does to its figures.

use super::empty_caps::random_gap;
use crate::fit::outcome::figures::Figures;
use crate::model::{StandardErrors, Unseen};
use std::f64::consts::PI;

/// Half-angle, in radians, of the largest hole that is told of as if it were seen. In holes of 20 degrees the radius is
/// off by 0.2 to 5 %, in holes of 40 by 10 to 26 %.
const LARGEST_WITH_FIGURES: f64 = PI / 6.0;

/// Standard deviation of the radius where nothing was seen, as a share of the mean radius: the largest error of holes of
/// 40 degrees. All of a hole is off together.
const GUESS: f64 = 0.25;

impl Unseen {
    /// A cap without points, if it is larger than is told of, and than those that few points leave by chance.
    pub(in crate::fit) fn hole(half_angle: f64, points: usize) -> Option<Self> {
        let is_large = half_angle > LARGEST_WITH_FIGURES.max(random_gap(points));
        is_large.then_some(Self::Hole { half_angle })
    }

    /// Standard errors of figures with a guess in them: to those that the points tell of, if known, is added that the
    /// radius is off there. Area, volume, moments go with its powers; the centroid with the volume, three quarters of the
    /// radius away.
    pub(in crate::fit) fn errors(
        &self,
        told: &Figures,
        mean_radius: f64,
        known: Option<StandardErrors>,
    ) -> StandardErrors {
        let known = known.unwrap_or(StandardErrors::ZERO);
        let of_all = GUESS * self.share();
        let inertia = 5.0 * of_all * told.inertia.trace() / 3.0;
        StandardErrors {
            area: known.area.hypot(2.0 * of_all * told.area),
            volume: known.volume.hypot(3.0 * of_all * told.volume),
            centroid: known
                .centroid
                .map(|error| error.hypot(2.25 * of_all * mean_radius)),
            inertia: known.inertia.map(|error| error.hypot(inertia)),
            moments: known.moments.map(|error| error.hypot(inertia)),
            // An end that was not seen is off as the radius is.
            dimensions: known
                .dimensions
                .map(|error| error.hypot(GUESS * mean_radius)),
            dimensions_excess: known.dimensions_excess,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;

    /// A hole of 60 degrees hides a quarter of the directions; the radius there is off by a quarter.
    #[test]
    fn errors_of_a_guess_go_with_the_powers_of_the_radius() {
        let hole = Unseen::Hole {
            half_angle: PI / 3.0,
        };
        assert_relative_eq!(hole.share(), 0.25, max_relative = 1e-14);
        let open = Unseen::Open {
            holes: 1,
            share: 0.25,
        };
        assert_relative_eq!(open.share(), 0.2);
        let told = Figures::SOME;
        let guess = hole.errors(&told, 4.0, None);
        assert_relative_eq!(guess.area, 2.0 * 0.0625 * 10.0, max_relative = 1e-14);
        assert_relative_eq!(guess.volume, 3.0 * 0.0625 * 8.0, max_relative = 1e-14);
        assert_relative_eq!(guess.centroid.x, 2.25 * 0.0625 * 4.0, max_relative = 1e-14);
        assert_relative_eq!(guess.moments.x, 5.0 * 0.0625 * 2.0, max_relative = 1e-14);
        assert_relative_eq!(guess.inertia.m12, 5.0 * 0.0625 * 2.0, max_relative = 1e-14);
        assert_relative_eq!(guess.dimensions.z, 0.25 * 4.0, max_relative = 1e-14);
        let both = hole.errors(&told, 4.0, Some(guess));
        assert_relative_eq!(both.area, 2.0_f64.sqrt() * guess.area, max_relative = 1e-14);
        assert_relative_eq!(
            both.dimensions.x,
            2.0_f64.sqrt() * guess.dimensions.x,
            max_relative = 1e-14
        );
    }

    #[test]
    fn holes_are_told_of_beyond_thirty_degrees_and_what_chance_leaves() {
        let hole = |degrees: f64, points| Unseen::hole(degrees.to_radians(), points).is_some();
        assert!(!hole(29.0, 10_000) && hole(31.0, 10_000));
        assert!(!hole(50.0, 20));
    }
}
