//! Whether what is left of the points is noise, or edges and detail that the estimate does not resolve.
//!
//! Residuals of noise are alike everywhere. Those of edges are large on few points: their distribution has long tails,
//! told by the kurtosis, the mean fourth power over the squared mean square: 3 of normal noise, with the standard
//! deviation sqrt(24 / n). Measured on
//!
//! ```text
//! particles of NIST, clean and with noise, 1538 and 6146 points   2.8 - 4.5, one of 350 above 7
//! bean, chickpea, maize, likewise                                 3.0 - 3.9
//! cube, cylinder, bicone, likewise                                4.2 - 210
//! kernels, stones and a stone core                                7.5 - 230
//! ```
//!
//! Of clean points the residuals of edges may be nothing. But then the spectrum goes on: its last degrees carry .008 to .08 % of
//! the mean radius of a lens, a capsule and balls that are fused, and less than .003 %, or than a seventh of the estimate's own
//! standard deviation, of smooth bodies. Or the points are too few for what there is between them: they leave open more than
//! their own noise, by 3 to 10 000 times of cubes, cylinders, bicones and octahedra with 300 to 1538 points, and less than it, or less
//! than .002 %, of smooth bodies from 300 points on, and of most from 200 on.
//!
//! There figures are told with what the [points left out](super::left_out) say, unless the body is alike on both sides of
//! its centre, as made ones are: an odd part of the radius of 0 to .7 % of the mean radius (cube, cylinder, bicone,
//! octahedron, cuboid), where kernels and stones have 3 to 12. Its edges may all lie alike among the points, and errors
//! that are all of one sign leave nothing in the residuals: of a cube whose edges hold points of the lattice the volume is
//! .9 % off, with other points .03 to .07. So may those of a body that is not symmetric, but has flat sides: of a wedge or a
//! pyramid on a lattice the volume is .3 to .7 % off. Beside edges points may also seem to stand alone, and be left out:
//! of a bicone 4 %.

use super::outcome::{Estimate, last_power};
use crate::fit::points::neighbours::Neighbours;
use crate::sphere::CubeCell;
use crate::spread::{covariance, upper_median};
use nalgebra::Vector3;
use std::f64::consts::PI;

/// Kurtosis of normal noise on a smooth body, whose smoothest and sharpest parts need not be fitted equally well.
const SMOOTH: f64 = 3.6;

/// Standard deviations of the kurtosis of normal noise above that.
const DEVIATIONS: f64 = 8.0;

/// Residuals below this share of the mean radius do not count, whatever their distribution.
pub(super) const FLOOR: f64 = 3e-4;

/// Odd part of the radius, as RMS in units of the mean radius, below which a body is alike on both sides of its centre.
const LEAST_ODD: f64 = 0.015;

/// Share of points left out beyond which they are a part of the body, as along a rim.
const MOST_OUTLIERS: f64 = 0.03;

/// Points near one by which it is told whether it lies on a flat side, itself one of them.
const VICINITY: usize = 7;

/// RMS distance of these from a plane, over their mean square distance from their middle, in units of the mean radius, on
/// flat sides: of a ball it is some 0.3.
const FLAT: f64 = 0.01;

/// Points that are looked at, at least.
const LOOKED_AT: usize = 1000;

/// Share of points on flat sides from which on a body is a made one.
const FLAT_SHARE: f64 = 0.1;

/// Whether so many points were left out that they may be no strays.
fn are_many(outliers: usize, points: usize) -> bool {
    outliers as f64 > MOST_OUTLIERS * (outliers + points) as f64
}

/// Whether a good part of the points, in units of the mean radius, may lie on flat sides. Those on lines of a scanner tell nothing: the
/// nearest lie on one line, and in a plane whatever the body. Were such bodies told from wedges by more of the points around, areas of
/// wedges scanned along 36 meridians with noise would be 3.4 standard errors off.
fn may_be_flat_sided(points: &[Vector3<f64>]) -> bool {
    let neighbours = Neighbours::new(points);
    let looked_at = points.iter().step_by((points.len() / LOOKED_AT).max(1));
    let count = looked_at.len();
    let is_flat = |point: &&Vector3<f64>| {
        let near = neighbours.nearest(point, VICINITY);
        let (_, spread) = covariance(near.iter().map(|&i| points[i]));
        let least = spread.symmetric_eigenvalues().min();
        least.max(0.0).sqrt() < FLAT * spread.trace()
    };
    looked_at.filter(is_flat).count() as f64 > FLAT_SHARE * count as f64
}

/// Whether the surface of these coefficients is alike on both sides of its centre.
fn is_symmetric(coefficients: &[f64]) -> bool {
    // Degree 1 only moves the surface.
    let odd = (3..coefficients.len().isqrt()).step_by(2);
    let squares = odd.flat_map(|l| &coefficients[l * l..(l + 1) * (l + 1)]);
    let sum: f64 = squares.map(|x| x * x).sum();
    sum < 4.0 * PI * LEAST_ODD * LEAST_ODD
}

/// Kurtosis of residuals in units of the mean radius, with normal noise of [`FLOOR`] on them.
pub(super) fn kurtosis(residuals: &[f64]) -> f64 {
    let count = residuals.len().max(1) as f64;
    let floor = FLOOR * FLOOR;
    let second = residuals.iter().map(|e| e * e).sum::<f64>() / count;
    let fourth = residuals.iter().map(|e| e.powi(4)).sum::<f64>() / count;
    (fourth + 6.0 * second * floor + 3.0 * floor * floor) / (second + floor).powi(2)
}

/// Whether these residuals are no noise.
pub(super) fn is_rough(residuals: &[f64]) -> bool {
    kurtosis(residuals) > limit(residuals.len())
}

impl Estimate {
    /// Whether what it leaves of the points is no noise, but edges and detail.
    pub(crate) fn is_rough(&self) -> bool {
        is_rough(&self.cloud.of_mean_weight(&self.residuals()))
    }

    /// Whether it is a made body with edges that it does not resolve, so that its errors are not known: where residuals are no
    /// noise (`is_rough`), where points of a rim were left out, or where the last degrees still carry something.
    pub(crate) fn hides_edges(&self, is_rough: bool) -> bool {
        let may_have_edges = is_rough
            || are_many(self.outliers, self.cloud.len())
            || self.goes_on()
            || self.is_sparse();
        may_have_edges
            && (is_symmetric(&self.coefficients) || may_be_flat_sided(&self.cloud.points()))
    }

    /// Whether its last degrees carry more than is small beside its own error: then those above would carry as much.
    fn goes_on(&self) -> bool {
        let small = (LEAST_TAIL * self.deviation() / self.cloud.mean).max(FLOOR_OF_TAIL);
        last_power(&self.coefficients, self.degree) > small * small
    }

    /// Whether the points leave open more than their noise, and not only over a hole or where they are thin.
    fn is_sparse(&self) -> bool {
        let limit = self.spectrum.noise().max(FLOOR_OF_DEVIATION);
        self.deviation() / self.cloud.mean > limit && self.usual_deviation() > limit
    }

    /// The standard deviation of the radius that is exceeded in half of the directions, in units of the mean radius.
    fn usual_deviation(&self) -> f64 {
        let cells = CubeCell::uniform(PLACES_PER_EDGE);
        let places: Vec<Vector3<f64>> = cells.iter().map(CubeCell::middle).collect();
        let posterior = self.posterior();
        let mut variances = self.given(&posterior).directional_variances(&places);
        upper_median(&mut variances).unwrap_or(0.0).sqrt()
    }
}

/// Places along an edge of the cube where that is looked at.
const PLACES_PER_EDGE: u16 = 4;

/// What points may leave open of any body, in units of the mean radius.
const FLOOR_OF_DEVIATION: f64 = 2e-5;

/// RMS of their part of the radius that is small beside the standard deviation of the estimate, ...
const LEAST_TAIL: f64 = 0.3;

/// ... or in units of the mean radius.
const FLOOR_OF_TAIL: f64 = 2e-5;

/// The largest kurtosis of so many residuals that passes for noise.
fn limit(points: usize) -> f64 {
    SMOOTH + DEVIATIONS * (24.0 / points.max(1) as f64).sqrt()
}

#[cfg(test)]
mod tests {
    use super::super::cloud::Cloud;
    use super::super::trial::{estimated, fibonacci, samples};
    use super::*;
    use crate::shapes::Sampling;
    use rand::SeedableRng;
    use rand_chacha::ChaCha8Rng;
    use rand_distr::{Distribution, StandardNormal};

    #[test]
    fn what_two_sides_differ_by_is_of_odd_degrees() {
        let mut coefficients = vec![0.1; 16];
        coefficients[9..].fill(0.0);
        assert!(is_symmetric(&coefficients));
        // As RMS over all directions, 2 and 1 % of the mean radius.
        coefficients[12] = 0.02 * (4.0 * PI).sqrt();
        assert!(!is_symmetric(&coefficients));
        coefficients[12] *= 0.5;
        assert!(is_symmetric(&coefficients));
    }

    /// Few points on a lattice fit edges as well as anything, and leave nothing; of an ellipsoid they tell all, if there are enough.
    #[test]
    fn few_points_of_made_bodies_do_not_tell_whether_there_are_edges() {
        let ellipsoid = |n: &Vector3<f64>| (n.x / 3.0).hypot(n.yz().norm()).recip();
        // Those of the polyhedron of few points.
        let axes = Vector3::new(2.6, 1.0, 1.0);
        let octahedron = |n: &Vector3<f64>| n.abs().sum().recip();
        for (points, radius, axes, is_told) in [
            (
                500,
                &octahedron as &dyn Fn(&Vector3<f64>) -> f64,
                Vector3::repeat(1.0),
                false,
            ),
            (50, &ellipsoid, axes, false),
            (300, &ellipsoid, axes, true),
        ] {
            let samples = samples(&fibonacci(points), radius, 0.0);
            let estimate = estimated(&samples, axes);
            let hides = estimate.hides_edges(estimate.is_rough());
            assert_eq!(hides, !is_told, "{points} {}", estimate.deviation());
        }
    }

    /// A hole leaves more open than noise, and says nothing of edges.
    #[test]
    fn a_smooth_body_with_a_hole_hides_no_edges() {
        let axes = Vector3::new(1.3, 1.1, 1.0);
        let radius = |n: &Vector3<f64>| {
            n.component_div(&axes).norm().recip()
                + 0.02 * (12.0 * n.x).cos() * (11.0 * n.y + 1.0).cos()
        };
        let all = fibonacci(6000).into_iter();
        let seen: Vec<Vector3<f64>> = all.filter(|n| n.z > -0.6_f64.cos()).collect();
        let estimate = estimated(&samples(&seen, radius, 0.0), axes);
        let deviation = estimate.deviation() / estimate.cloud.mean;
        assert!(deviation > 2.0 * FLOOR_OF_DEVIATION, "{deviation}");
        assert!(!estimate.hides_edges(estimate.is_rough()));
    }

    #[test]
    fn half_a_ball_has_a_flat_side_and_a_ball_has_none() {
        let ball = Sampling::Fibonacci.directions(2000, 0).unwrap();
        assert!(!may_be_flat_sided(&ball));
        // Its lower half moved up along the axis, into a disc.
        let half: Vec<_> = ball
            .iter()
            .map(|n| Vector3::new(n.x, n.y, n.z.max(0.0)))
            .collect();
        assert!(may_be_flat_sided(&half));
        let rough: Vec<_> = half
            .iter()
            .enumerate()
            .map(|(i, n)| n + Vector3::z() * (2e-3 * (i % 2) as f64))
            .collect();
        assert!(!may_be_flat_sided(&rough));
        assert!(!are_many(2, 98) && are_many(4, 96));
    }

    #[test]
    fn means_of_one_and_of_sixteen_points_scatter_alike_when_weighed() {
        let samples = [[1.0, 0.0, 0.0, 1.0], [0.0, 1.0, 0.0, 1.0]];
        let cloud = Cloud::new(
            &samples,
            Some(&[1.0, 16.0]),
            Vector3::repeat(1.0),
            Vector3::repeat(1.0),
        );
        let weighed = cloud.of_mean_weight(&[4.0, 1.0]);
        let expected = 4.0 / 8.5_f64.sqrt();
        assert!(weighed.iter().all(|e| (e - expected).abs() < 1e-12));
    }

    #[test]
    fn noise_passes_and_larger_noise_on_a_few_points_does_not() {
        let mut random = ChaCha8Rng::seed_from_u64(1);
        let noise: Vec<f64> = (0..4000)
            .map(|_| -> f64 { StandardNormal.sample(&mut random) })
            .collect();
        let times = |factor: f64| noise.iter().map(|e| factor * e).collect::<Vec<_>>();
        assert!((kurtosis(&times(0.01)) - 3.0).abs() < 0.3);
        let mut edges = times(0.002);
        for edge in edges.iter_mut().step_by(20) {
            *edge *= 5.0;
        }
        assert!(kurtosis(&edges) > limit(edges.len()));
        // Too small to count.
        for edge in &mut edges {
            *edge *= 1e-3;
        }
        assert!((kurtosis(&edges) - 3.0).abs() < 0.1);
        assert!(kurtosis(&[]).is_finite());
        // (1 + 6 + 3) / (1 + 1)^2 of residuals that all have the size of the floor.
        assert!((kurtosis(&[FLOOR, -FLOOR]) - 2.5).abs() < 1e-12);
        assert!((limit(2400) - (3.6 + 8.0 * 0.1)).abs() < 1e-12);
    }
}
