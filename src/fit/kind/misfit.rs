//! Whether a radius misses its scan, and what is told of it then.

use crate::fit::options::FitOptions;
use crate::fit::outcome::Fitted;
use crate::fit::points::scatter::{FAR, scatter};
use crate::fit::warning::FitWarning;
use crate::measure::{Deviation, feet};
use crate::model::{Grain, NoStandardErrors, StarSurface, Surface};
use crate::scan::Scan;
use crate::sphere::cube_grid;
use nalgebra::{Point3, Vector3};

/// Cosine of the angle between a direction and the normal there below which a radius is steep, and ...
const STEEP: f64 = 0.2;

/// ... the share of directions in which it may be.
const STEEP_SHARE: f64 = 0.005;

/// Cells along a cube's edge of the directions looked at.
const LOOKED_AT: usize = 24;

/// What a radius does not see is far from it in few places: the mean of all distances is then less than this share of
/// their RMS. Of noise it is .80 (Geary 1935).
const LONG_TAILS: f64 = 0.74;

/// So many times larger than their scatter their noise is something else. Of bodies with noise it is 1.5 at most, of a
/// blackberry whose bumps are taken for noise 2.1.
const NOISY: f64 = 1.8;

/// What a radius hides is told of where it is more than this share of the area. Of stones of which it hid .01 and .05 % its area was
/// within .2 %, that of positions .5 and .7 % too small.
const HIDDEN_SHARE: f64 = 0.002;

/// Most vertices of a scan whose distances from a radius are compared with those from a position.
const MOST_COMPARED: usize = 4000;

/// So many times their RMS the largest residual of noise is at most, of ten million points. Where patches stand for points these are
/// looked at only beyond it, ...
pub(crate) const LARGEST_OF_NOISE: f64 = 6.0;

/// ... and so many of them: farther apart they scatter more about what is smooth between them.
const MOST_NEAR: usize = 20_000;

/// What a radius misses is something in few places if the mean of all distances is less than this share of their RMS: of handles, fins
/// and stalks it is .20 to .43, of stones .67 and more, of kernels with what is left of their awns .43 and more.
const IN_FEW_PLACES: f64 = 0.35;

/// The same where positions follow what a radius misses: of pins .29 to .34, of clusters of dust .46 to .48, of scans without .68 and more.
const OF_FEW: f64 = 0.57;

impl Fitted {
    /// A radius without errors, if it misses its scan in few places: what it misses there is no noise and no texture, and no error
    /// tells of it.
    pub(super) fn without_errors_if_local(self, missed: Option<FitWarning>, scan: &Scan) -> Self {
        match missed {
            Some(missed) if is_in_few_places(&self, scan) => self.without_errors(Some(missed)),
            _ => self,
        }
    }

    /// A surface that misses its scan, without errors and noise; one with a hole as it is, for its errors are those of a guess.
    pub(super) fn without_errors(mut self, missed: Option<FitWarning>) -> Self {
        if self.grain.unseen().is_some() {
            return self;
        }
        self.warnings.extend(missed);
        self.errors = Some(Err(NoStandardErrors::NotFollowed));
        self.search.noise = None;
        self.edged = None;
        Self {
            posterior: None,
            ..self.beside_polyhedron()
        }
    }
}

/// The share of the area that a radius hides.
pub(super) fn hidden_share(fitted: &Fitted) -> f64 {
    let hidden = fitted.warnings.iter().find_map(|warning| match warning {
        FitWarning::NotStarShaped { share } => Some(*share),
        _ => None,
    });
    hidden.unwrap_or(0.0)
}

/// Whether that is much.
pub(super) fn hides_much(fitted: &Fitted) -> bool {
    hidden_share(fitted) > HIDDEN_SHARE
}

/// Whether it is much and no noise, by the distances of points from the surface.
pub(super) fn is_hiding(fitted: &Fitted, distances: &Deviation) -> bool {
    hides_much(fitted) && distances.mean_absolute < LONG_TAILS * distances.rms()
}

/// Whether a radius hides much of the area, or is steep.
pub(super) fn does_not_see(fitted: &Fitted) -> bool {
    if hides_much(fitted) {
        return true;
    }
    let Some(star) = fitted.grain.star() else {
        return false;
    };
    let (directions, _) = cube_grid(LOOKED_AT);
    let is_steep = |n: &&Vector3<f64>| {
        let (radius, gradient) = star.radius_and_gradient(n);
        radius < STEEP * radius.hypot(gradient.norm())
    };
    let steep = directions.iter().filter(is_steep).count();
    steep as f64 > STEEP_SHARE * directions.len() as f64
}

/// How a radius does not follow a body that is smooth among neighbours: held-out points are much farther from it than
/// from the surfaces through their neighbours, or what they scatter by is much less than the noise that is told.
pub(super) fn missed(star: &Fitted, scan: &Scan, options: &FitOptions) -> Option<FitWarning> {
    let times = held_out_over_fitted(star);
    let off = |rms: f64| rms * times;
    let good = options.tolerance.length(star.mean_radius);
    if off(star.residuals.rms) <= FAR * good {
        return None;
    }
    let places = places(star, scan)?;
    // So far faces lie within a smooth surface through their corners.
    let sag = star.reference.bulge / star.reference.area;
    let scatter = scatter(&places)?.max(sag).max(good);
    if let Some(noise) = star.search.noise.filter(|noise| *noise > NOISY * scatter) {
        return Some(FitWarning::NoiseBeyondScatter { noise, scatter });
    }
    if off(star.residuals.rms) <= FAR * scatter {
        return None;
    }
    let frame = star.grain.frame();
    let points: Vec<_> = places.iter().map(|place| frame.to_scan(place)).collect();
    let rms = off(normal_distances(&star.grain, &points).rms());
    (rms > FAR * scatter).then_some(FitWarning::FarFromNeighbours { rms, scatter })
}

/// The points that a radius rests on, in the grain's own frame; where patches stand for them, some of the scan's, if any is farther off
/// than noise.
fn places(star: &Fitted, scan: &Scan) -> Option<Vec<Vector3<f64>>> {
    if let Some(places) = star.posterior.as_ref()?.points() {
        return Some(places);
    }
    let is_noise = star.residuals.max <= LARGEST_OF_NOISE * star.residuals.rms;
    let is_of_faces = !scan.triangles().is_empty();
    if is_noise || is_of_faces {
        return None;
    }
    let every = scan.points().len().div_ceil(MOST_NEAR);
    let some = scan.points().iter().step_by(every);
    let frame = star.grain.frame();
    Some(some.map(|point| frame.to_local(point)).collect())
}

/// Whether most points are much nearer to a radius than the root mean square tells.
fn is_in_few_places(star: &Fitted, scan: &Scan) -> bool {
    let distances = normal_distances(&star.grain, scan.points());
    distances.mean_absolute < IN_FEW_PLACES * distances.rms()
}

/// What stands out of a body that a radius follows, by the distances of points from it: the mean of these is then much less than
/// their RMS, and no area is hidden.
pub(super) fn stands_out(star: &Fitted, distances: &Deviation) -> Option<FitWarning> {
    let is_out = !hides_much(star) && distances.mean_absolute < OF_FEW * distances.rms();
    is_out.then_some(FitWarning::StandsOut)
}

/// How many times farther points are from a fitted radius that are held out, by the radial distances of both; with the
/// mean of their leverages, for on a steep flank, where single points decide the radius, they do not decide the distance.
pub(super) fn held_out_over_fitted(star: &Fitted) -> f64 {
    let choice = star.search.choice();
    let held_out = match (&star.posterior, choice.estimate_rms) {
        (Some(estimate), Some(rms)) => Some(rms.hypot(estimate.held_out_by_mean())),
        _ => choice.heldout_rms,
    };
    let times = held_out.map_or(1.0, |rms| rms / star.residuals.rms);
    if times.is_finite() {
        times.max(1.0)
    } else {
        1.0
    }
}

/// Distances of points from a surface, along its normals.
pub(super) fn normal_distances(grain: &Grain, points: &[Point3<f64>]) -> Deviation {
    let every = points.len().div_ceil(MOST_COMPARED).max(1);
    let some: Vec<_> = points.iter().step_by(every).copied().collect();
    let feet = feet(grain, &some);
    Deviation::of(feet.iter().map(|foot| (foot.distance, 1.0)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fit::context::Context;
    use crate::fit::kind::choice::KindChoice;
    use crate::fit::prepare::PreparedScan;
    use crate::shapes::{Body, Sampling, SynthOptions, synthesize};
    use crate::sphere::Symmetry;
    use std::f64::consts::TAU;

    /// How a fit of the maize of such a degree misses its points, which have so much noise, and whether it keeps its errors.
    fn misses(degree: usize, noise: f64, told: Option<f64>) -> [bool; 2] {
        let options = SynthOptions::clean(Body::Maize)
            .with_points(1538)
            .with_noise(noise);
        let scan = Scan::from_points(synthesize(&options).unwrap().points);
        let own = FitOptions::default().with_segments(1).with_degree(degree);
        let prepared = PreparedScan::new(&scan, Symmetry::NONE).unwrap();
        let mut fitted = prepared.fit(&own, &Context::default()).unwrap();
        if let Some(told) = told {
            fitted.search.noise = Some(told * fitted.mean_radius);
        }
        let found = missed(&fitted, &scan, &FitOptions::default());
        [
            found.is_some(),
            fitted
                .without_errors_if_local(found, &scan)
                .errors
                .is_none(),
        ]
    }

    fn is_missed(degree: usize, noise: f64, told: Option<f64>) -> bool {
        misses(degree, noise, told)[0]
    }

    #[test]
    fn what_is_missed_all_over_leaves_the_errors() {
        assert_eq!(misses(12, 0.02, Some(0.08)), [true, true]);
    }

    #[test]
    fn a_radius_that_does_not_follow_smooth_points_misses_them() {
        assert!(is_missed(4, 0.0, None));
        assert!(!is_missed(20, 0.0, None));
        assert!(!is_missed(12, 0.02, None));
    }

    #[test]
    fn noise_that_neighbours_do_not_have_is_none() {
        assert!(is_missed(12, 0.02, Some(0.08)));
        assert!(!is_missed(12, 0.02, Some(0.025)));
    }

    /// A ball with a handle, a rod of radius .05.
    fn cup() -> Scan {
        let ball = Sampling::Fibonacci.directions(6000, 0).unwrap();
        let handle = (0..300).map(|i| {
            let (sin, cos) = (TAU * f64::from(i) / 300.0).sin_cos();
            let (height, out) = (0.618 * TAU * f64::from(i)).sin_cos();
            let r = 0.5 + 0.05 * out;
            Vector3::new(1.0 + r * cos, r * sin, 0.05 * height)
        });
        let outside = handle.filter(|place| place.norm() > 1.0);
        let all = ball.into_iter().chain(outside);
        Scan::from_points(all.map(Point3::from).collect())
    }

    /// Positions that go out to a pin or to dust are told as such; those of a body that hides from a radius are not.
    #[test]
    fn what_stands_out_of_a_body_that_a_radius_follows_is_told() {
        let directions = Sampling::Fibonacci.directions(5000, 0).unwrap();
        let pin = (0..36).map(|i| {
            let (sin, cos) = f64::from(i).sin_cos();
            Vector3::new(0.05 * sin, 0.05 * cos, 1.1 + f64::from(i) / 72.0)
        });
        let told = |points: Vec<Vector3<f64>>| {
            let scan = Scan::from_points(points.into_iter().map(Point3::from).collect());
            let star = PreparedScan::new(&scan, Symmetry::NONE).unwrap();
            let star = star
                .fit(&FitOptions::default(), &Context::default())
                .unwrap();
            stands_out(&star, &normal_distances(&star.grain, scan.points()))
        };
        let with_pin = directions.iter().copied().chain(pin).collect();
        assert_eq!(told(with_pin), Some(FitWarning::StandsOut));
        assert_eq!(told(directions), None);
    }

    #[test]
    fn a_handle_that_is_missed_takes_the_errors() {
        let (scan, options) = (cup(), FitOptions::default());
        let star = PreparedScan::new(&scan, Symmetry::NONE).unwrap();
        let star = star.fit(&options, &Context::default()).unwrap();
        assert!(star.errors.is_none() && star.search.noise.is_some());
        let found = missed(&star, &scan, &options);
        let without = star.without_errors_if_local(found, &scan);
        assert_eq!(without.errors, Some(Err(NoStandardErrors::NotFollowed)));
        assert_eq!(without.search.noise, None);
        let fitted = crate::fit::fit(&scan, &options).unwrap();
        assert!(matches!(fitted.kind, KindChoice::NoPositions(_)));
        assert_eq!(fitted.errors, Some(Err(NoStandardErrors::NotFollowed)));
    }
}
