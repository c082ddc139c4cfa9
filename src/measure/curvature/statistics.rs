//! Curvature over a whole surface.

use super::kind::{End, Kind};
use super::peaks::{Peak, highest};
use crate::measure::integrals::nodes::{curved_nodes, on_planes};
use crate::model::Surface;
use nalgebra::Vector3;
use rayon::prelude::*;
use serde::Serialize;
use std::f64::consts::PI;

/// Curvature of a flat side by rounding, in one over the root of the area.
const ROUNDING: f64 = 1e-9;

/// Share of the largest curvature that is rounding, where the surface is flat.
const NOTHING: f64 = 1e-12;

/// Squares of curvatures lie closer together than curvatures: nodes miss so many times the share. In a dimple of a stone they
/// missed 3.6 times as much.
const OF_SQUARES: f64 = 4.0;

/// Share of the total curvature that nodes may miss.
const MISSED: f64 = 0.01;

/// Curvatures at the nodes of a quadrature over a surface, with the areas that they stand for, and their extremes.
#[derive(Debug, Clone)]
pub struct CurvatureStatistics {
    /// (principal curvatures, the larger first; area).
    nodes: Vec<([f64; 2], f64)>,
    /// Least and largest values, kind by kind.
    extremes: [[f64; 2]; Kind::ALL.len()],
    /// Directions of the places where they are, in the frame of the surface's places.
    ends: [[Vector3<f64>; 2]; Kind::ALL.len()],
    /// The length that is one here, in the surface's unit.
    unit: f64,
}

/// How a curvature is distributed over a surface, by area.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Distribution {
    /// Mean.
    pub mean: f64,
    /// Standard deviation; NaN where the curvature has no bound, for then no nodes settle it.
    pub standard_deviation: f64,
    /// Least value of the surface itself, to 1e-5 of it: the lowest that is found by descent from the lowest nodes of the
    /// quadrature that are apart. Infinite where it falls without bound, as on the edges of some superquadrics.
    pub least: f64,
    /// Largest value, likewise.
    pub largest: f64,
}

impl Distribution {
    fn times(self, factor: f64) -> Self {
        Self {
            mean: self.mean * factor,
            standard_deviation: self.standard_deviation * factor,
            least: self.least * factor,
            largest: self.largest * factor,
        }
    }
}

impl CurvatureStatistics {
    /// The statistics of a surface, from nodes all over its [tiling](Surface::tiling).
    pub fn new(surface: &(impl Surface + ?Sized)) -> Self {
        let (found, on_planes) = (curved_nodes(surface), on_planes(surface));
        let ends = Kind::ALL.map(|kind| End::BOTH.map(|end| (kind, end)));
        let unbounded = surface.unbounded_curvatures().unwrap_or_default();
        let peak = |&(kind, end): &(Kind, End)| match kind.is_unbounded(end, unbounded) {
            true => Peak::UNBOUNDED,
            false => highest(surface, &found, &on_planes, |k| end.sign() * kind.of(k)),
        };
        let peaks: Vec<Peak> = ends.as_flattened().par_iter().map(peak).collect();
        let ends =
            ends.map(|ends| ends.map(|(kind, end)| (peaks[2 * kind as usize + end as usize], end)));
        let mut extremes = ends.map(|ends| ends.map(|(peak, end)| end.sign() * peak.value));
        for (kind, ends) in Kind::ALL.into_iter().zip(&mut extremes) {
            let sizes = found.iter().map(|node| kind.of(node.principal).abs());
            let size = sizes.filter(|size| size.is_finite()).fold(0.0, f64::max);
            for end in ends.iter_mut().filter(|end| end.abs() < NOTHING * size) {
                *end = 0.0;
            }
        }
        // Where one has no bound others have none; a climb may have missed it.
        let [mean, gaussian, larger, smaller] = &mut extremes;
        if smaller[1] == f64::INFINITY {
            [mean[1], gaussian[1]] = [f64::INFINITY; 2];
        }
        if mean[1].max(gaussian[1]) == f64::INFINITY {
            larger[1] = f64::INFINITY;
        }
        if mean[0].min(larger[0]) == f64::NEG_INFINITY {
            smaller[0] = f64::NEG_INFINITY;
        }
        Self {
            extremes,
            ends: ends.map(|ends| ends.map(|(peak, _)| peak.n)),
            nodes: found
                .iter()
                .map(|node| (node.principal, node.area))
                .collect(),
            unit: 1.0,
        }
    }

    /// The same, of the surface that is so many times as large.
    pub(in crate::measure) fn in_unit(self, length: f64) -> Self {
        let unit = self.unit * length;
        Self { unit, ..self }
    }

    /// Mean curvature H = (k1 + k2)/2, one over length; 1/R of a sphere.
    pub fn mean(&self) -> Distribution {
        self.distribution(Kind::Mean)
    }

    /// Gaussian curvature K = k1 k2, one over length squared; 1/R² of a sphere.
    pub fn gaussian(&self) -> Distribution {
        self.distribution(Kind::Gaussian)
    }

    /// The larger principal curvature, one over length, positive where convex.
    pub fn larger(&self) -> Distribution {
        self.distribution(Kind::Larger)
    }

    /// The smaller principal curvature, negative in hollows.
    pub fn smaller(&self) -> Distribution {
        self.distribution(Kind::Smaller)
    }

    /// ∫ K dS, which the theorem of Gauss and Bonnet says is 4 pi on a closed surface without edges:
    /// what is missing lies in edges and seams, or tells how good the quadrature is.
    pub fn total(&self) -> f64 {
        self.integral(|k| Kind::Gaussian.of(k))
    }

    /// Whether so much of the curvature lies on edges and creases, where it has no bound, that the nodes miss some of it: means
    /// are not to be told then.
    pub(in crate::measure) fn is_on_edges(&self) -> bool {
        self.gauss_bonnet_error().abs() > MISSED
    }

    /// Share of the area where the surface is convex: no principal curvature below zero, by more than rounding.
    pub fn convex_share(&self) -> f64 {
        let area = self.area();
        let convex = |[_, smaller]: [f64; 2]| f64::from(is_convex(smaller, area));
        self.integral(convex) / area
    }

    /// How a curvature is distributed over the surface at unit size.
    pub(in crate::measure) fn at_unit_size(&self, kind: Kind) -> Distribution {
        let area = self.area();
        let mean = self.integral(|k| kind.of(k)) / area;
        let variance = self.integral(|k| (kind.of(k) - mean).powi(2)) / area;
        let [least, largest] = self.extremes[kind as usize];
        let is_settled = least.is_finite() && largest.is_finite();
        Distribution {
            mean,
            standard_deviation: if is_settled {
                variance.sqrt()
            } else {
                f64::NAN
            },
            least,
            largest,
        }
    }

    /// Direction of the place where a curvature is least or largest, in the frame of the surface's places, and its value there at unit size.
    pub(in crate::measure) fn end(&self, kind: Kind, end: End) -> (Vector3<f64>, f64) {
        let [kind, end] = [kind as usize, end as usize];
        (self.ends[kind][end], self.extremes[kind][end])
    }

    /// Of the variance of a curvature about its mean at unit size, what the nodes miss if what they miss of the total curvature lies
    /// where Gaussian curvature is largest. NaN where that has no bound.
    pub(in crate::measure) fn missed_variance(&self, kind: Kind, mean: f64) -> f64 {
        let farthest = |kind: Kind, from: f64| {
            let ends = self.extremes[kind as usize].iter();
            ends.map(|end| (end - from).abs()).fold(0.0, f64::max)
        };
        let missed = (self.total() - 4.0 * PI).abs() / farthest(Kind::Gaussian, 0.0);
        OF_SQUARES * missed * farthest(kind, mean).powi(2) / self.area()
    }

    fn area(&self) -> f64 {
        self.integral(|_| 1.0)
    }

    fn integral(&self, value: impl Fn([f64; 2]) -> f64) -> f64 {
        self.nodes.iter().map(|&(k, area)| value(k) * area).sum()
    }

    fn distribution(&self, kind: Kind) -> Distribution {
        self.at_unit_size(kind).times(kind.per(self.unit))
    }

    /// ∫ K dS over 4 pi, less one: see [`Self::total`].
    pub fn gauss_bonnet_error(&self) -> f64 {
        self.total() / (4.0 * PI) - 1.0
    }
}

/// Whether a surface of this area is convex where its smaller principal curvature is this one, up to rounding.
pub(in crate::measure) fn is_convex(smaller: f64, area: f64) -> bool {
    smaller > -ROUNDING / area.sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::{
        Frame, MultiSuperquadric, Part, Radial, StarSurface, Superquadric, SuperquadricGrain,
    };
    use crate::shapes::{Body, Ellipsoid, Sphere};
    use approx::assert_relative_eq;
    use nalgebra::{Point3, Rotation3};
    use std::f64::consts::TAU;

    fn statistics(surface: &(impl StarSurface + ?Sized)) -> CurvatureStatistics {
        CurvatureStatistics::new(&Radial(surface))
    }

    #[test]
    fn the_total_curvature_of_closed_surfaces_is_4_pi() {
        for body in [Body::Bean, Body::Chickpea, Body::Maize, Body::Ellipsoid] {
            let found = statistics(body.surface().as_ref());
            let error = found.gauss_bonnet_error().abs();
            assert!(error < 1e-7, "{body}: {error:e}");
        }
    }

    #[test]
    fn a_sphere_is_curved_alike_everywhere() {
        let found = statistics(&Sphere { radius: 2.0 });
        for (distribution, value) in [
            (found.mean(), 0.5),
            (found.gaussian(), 0.25),
            (found.larger(), 0.5),
            (found.smaller(), 0.5),
        ] {
            assert_relative_eq!(distribution.mean, value, max_relative = 1e-13);
            assert_relative_eq!(distribution.least, value, max_relative = 1e-13);
            assert_relative_eq!(distribution.largest, value, max_relative = 1e-13);
            assert!(distribution.standard_deviation < 1e-13);
        }
        assert_relative_eq!(found.convex_share(), 1.0, max_relative = 1e-13);
    }

    #[test]
    fn a_spheroid_has_its_extreme_curvatures_and_its_mean_one() {
        // a = b = 1, c = 2: k = a/c² on the equator along the meridian, c/a² at the poles. Its mean
        // curvature over the area, by the formula of the support function: ∫ H dS = 2 pi times the
        // mean width, which is that of h = sqrt(1 + 3 u²) over u.
        let found = statistics(&Ellipsoid {
            semi_axes: Vector3::new(1.0, 1.0, 2.0),
        });
        assert_relative_eq!(found.smaller().least, 0.25, max_relative = 1e-3);
        assert_relative_eq!(found.larger().largest, 2.0, max_relative = 1e-3);
        let root = 3.0_f64.sqrt();
        let mean_width = 2.0 + root.asinh() / root;
        let area = found.integral(|_| 1.0);
        assert_relative_eq!(
            found.mean().mean * area,
            TAU * mean_width,
            max_relative = 1e-9
        );
    }

    #[test]
    fn of_edges_without_a_bound_no_deviation_is_told_and_of_sharp_ones_nothing() {
        let found = |n1, n2| {
            let shape = Superquadric::single([3.0, 2.0, 1.5], n1, n2).unwrap();
            CurvatureStatistics::new(&SuperquadricGrain::single(Frame::SCAN, shape).unwrap())
        };
        let rim = found(1.8, 2.0);
        assert!(!rim.is_on_edges() && rim.larger().largest.is_infinite());
        assert!(rim.larger().standard_deviation.is_nan());
        assert!(rim.smaller().standard_deviation.is_nan());
        let blunt = found(1.95, 1.91);
        assert!(blunt.mean().largest.is_infinite() && blunt.larger().largest.is_infinite());
        assert!(found(1.2, 1.2).is_on_edges());
        // Two spheres meet in a crease, which bends the other way: what is round is more than 4 pi.
        let ball = |x| Part {
            shape: Superquadric::single([1.0; 3], 2.0, 2.0).unwrap(),
            frame: Frame {
                centre: Point3::new(x, 0.0, 0.0),
                ..Frame::SCAN
            },
        };
        let pair = MultiSuperquadric::new([-0.5, 0.5].map(ball).into()).unwrap();
        let pair = SuperquadricGrain::multi(Frame::SCAN, pair).unwrap();
        assert!(CurvatureStatistics::new(&pair).is_on_edges());
        let rounded = found(6.0, 6.0);
        assert!(!rounded.is_on_edges() && rounded.larger().standard_deviation > 0.0);
    }

    /// At the end of z of n1 below two both principal curvatures have no bound; across y = 0 of n2 below two one has none, and the other is
    /// that of the outline, which is largest there.
    #[test]
    fn of_superquadrics_below_ellipsoids_the_curvatures_without_a_bound_are_told() {
        let found = |axes, n1, n2| {
            let shape = Superquadric::single(axes, n1, n2).unwrap();
            CurvatureStatistics::new(&SuperquadricGrain::single(Frame::SCAN, shape).unwrap())
        };
        let pointed = found([2.0, 2.0, 0.5], 1.8, 2.0);
        assert!(pointed.smaller().largest.is_infinite() && pointed.larger().largest.is_infinite());
        assert!(pointed.smaller().standard_deviation.is_nan());
        let edged = found([3.0, 2.0, 1.0], 4.0, 1.95);
        assert!(edged.larger().largest.is_infinite() && edged.gaussian().least == 0.0);
        let [near, far] = [edged, found([3.0, 2.0, 1.0], 4.0, 1.7)].map(|found| found.smaller());
        assert!(near.standard_deviation > 0.0);
        assert_relative_eq!(near.largest, far.largest, max_relative = 1e-3);
    }

    /// On the planes of its octants one principal curvature vanishes, by the power .04 of the distance, and at its tips both do.
    #[test]
    fn a_superquadric_a_little_beyond_an_ellipsoid_is_flat_at_its_tips() {
        let turn = Rotation3::from_euler_angles(0.3, 0.5, 0.7).into_inner();
        let frame = Frame {
            axes: turn,
            ..Frame::SCAN
        };
        let shape = Superquadric::single([4.0, 7.0, 3.2], 2.04, 2.3).unwrap();
        let found = CurvatureStatistics::new(&SuperquadricGrain::single(frame, shape).unwrap());
        let kinds = [found.mean(), found.larger(), found.smaller()];
        for least in kinds.map(|kind| kind.least) {
            assert_eq!(least, 0.0);
        }
        assert!(found.larger().largest > 0.5);
    }

    #[test]
    fn flat_sides_are_convex() {
        let shape = Superquadric::single([2.0, 1.5, 1.0], 20.0, 20.0).unwrap();
        let grain = SuperquadricGrain::single(Frame::SCAN, shape).unwrap();
        assert_relative_eq!(CurvatureStatistics::new(&grain).convex_share(), 1.0);
    }

    #[test]
    fn what_nodes_miss_of_a_variance_lies_where_curvature_is_largest() {
        let found = CurvatureStatistics {
            nodes: vec![([1.0, 1.0], 12.0)],
            extremes: [[-30.0, 2.0], [-1.0, 400.0], [0.0, 9.0], [0.0, 9.0]],
            ends: Default::default(),
            unit: 1.0,
        };
        let missed = OF_SQUARES * (4.0 * PI - 12.0) / 400.0;
        let told = found.missed_variance(Kind::Mean, 1.0);
        assert_relative_eq!(told, missed * 31.0 * 31.0 / 12.0, max_relative = 1e-12);
        let told = found.missed_variance(Kind::Gaussian, 1.0);
        assert_relative_eq!(told, missed * 399.0 * 399.0 / 12.0, max_relative = 1e-12);
    }
}
