//! Curvature over a whole surface, and the roundness that follows from it.

use super::Curvature;
use crate::model::{Node, Surface};
use nalgebra::Vector3;
use rayon::prelude::*;
use serde::Serialize;
use std::f64::consts::PI;

/// Nodes at which the surface is evaluated together.
const CHUNK: usize = 4096;

/// Curvatures at the nodes of a quadrature over a surface, with the areas that they stand for.
#[derive(Debug, Clone)]
pub struct CurvatureStatistics {
    /// (principal curvatures, the larger first; area).
    nodes: Vec<([f64; 2], f64)>,
    /// Direction of the node with the largest curvature.
    sharpest: Vector3<f64>,
    /// The length that is one here, in the surface's unit.
    unit: f64,
}

/// How a curvature is distributed over a surface, by area.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Distribution {
    /// Mean.
    pub mean: f64,
    /// Standard deviation.
    pub standard_deviation: f64,
    /// Least value at any node of the quadrature: a bound from above for that of the surface.
    pub least: f64,
    /// Largest value at any node: a bound from below.
    pub largest: f64,
}

impl Distribution {
    fn over(self, length: f64) -> Self {
        Self {
            mean: self.mean / length,
            standard_deviation: self.standard_deviation / length,
            least: self.least / length,
            largest: self.largest / length,
        }
    }
}

impl CurvatureStatistics {
    /// That of a surface at the nodes of a quadrature over its [tiling](Surface::tiling).
    pub fn new(surface: &(impl Surface + ?Sized), nodes: &[Node]) -> Self {
        let of_chunk = |nodes: &[Node]| {
            let nodes: Vec<Node> = nodes.iter().map(|node| surface.node(*node)).collect();
            let directions: Vec<_> = nodes.iter().map(|(n, _)| *n).collect();
            let found = nodes.into_iter().zip(surface.jets(&directions));
            found.map(|((n, solid_angle), jet)| {
                let curvature = Curvature::new(&n, &jet);
                (n, (curvature.principal, curvature.area() * solid_angle))
            })
        };
        let chunks = nodes.par_chunks(CHUNK);
        let found: Vec<_> = chunks.flat_map_iter(of_chunk).collect();
        let sharpness = |(_, ([first, _], _)): &&(Vector3<f64>, ([f64; 2], f64))| *first;
        let sharpest = found
            .iter()
            .max_by(|a, b| sharpness(a).total_cmp(&sharpness(b)))
            .map_or(Vector3::zeros(), |(n, _)| *n);
        Self {
            nodes: found.into_iter().map(|(_, node)| node).collect(),
            sharpest,
            unit: 1.0,
        }
    }

    /// The same, of the surface that is so many times as large.
    pub(super) fn in_unit(self, length: f64) -> Self {
        let unit = self.unit * length;
        Self { unit, ..self }
    }

    /// Mean curvature H = (k1 + k2)/2, one over length; 1/R of a sphere.
    pub fn mean(&self) -> Distribution {
        self.distribution(|[first, second]| 0.5 * (first + second))
            .over(self.unit)
    }

    /// Gaussian curvature K = k1 k2, one over length squared; 1/R² of a sphere.
    pub fn gaussian(&self) -> Distribution {
        self.distribution(|[first, second]| first * second)
            .over(self.unit)
            .over(self.unit)
    }

    /// The larger principal curvature, one over length, positive where convex.
    pub fn larger(&self) -> Distribution {
        self.distribution(|[first, _]| first).over(self.unit)
    }

    /// The direction, in the frame of the surface's places, of the node with the largest principal curvature.
    pub fn sharpest(&self) -> Vector3<f64> {
        self.sharpest
    }

    /// The smaller principal curvature, negative in hollows.
    pub fn smaller(&self) -> Distribution {
        self.distribution(|[_, second]| second).over(self.unit)
    }

    /// ∫ K dS, which the theorem of Gauss and Bonnet says is 4 pi on a closed surface without edges:
    /// what is missing lies in edges and seams, or tells how good the quadrature is.
    pub fn total(&self) -> f64 {
        self.integral(|[first, second]| first * second)
    }

    /// Share of the area where the surface is convex: both principal curvatures above zero.
    pub fn convex_share(&self) -> f64 {
        let convex = |[_, second]: [f64; 2]| f64::from(second > 0.0);
        self.integral(convex) / self.integral(|_| 1.0)
    }

    /// Roundness: the mean, by area, of the radius of curvature 1/k1 at the corners over the radius R
    /// of the largest inscribed sphere, a corner being where k1 > 1/R. Above 0 to 1; 1 without corners.
    ///
    /// Wadell 1932 has the mean radius of the corners of a plane outline over that of its inscribed
    /// circle; with curvature, in space, it is by area (after Bullard and Garboczi 2013 and Zhao and
    /// Wang 2016).
    pub fn roundness(&self, inscribed_radius: f64) -> f64 {
        let radius = inscribed_radius / self.unit;
        let sharpness = |[first, _]: [f64; 2]| first * radius;
        let corners = self.integral(|k| f64::from(sharpness(k) > 1.0));
        if corners == 0.0 {
            return 1.0;
        }
        let radii = self.integral(|k| match sharpness(k) > 1.0 {
            true => 1.0 / sharpness(k),
            false => 0.0,
        });
        radii / corners
    }

    fn integral(&self, value: impl Fn([f64; 2]) -> f64) -> f64 {
        self.nodes.iter().map(|&(k, area)| value(k) * area).sum()
    }

    fn distribution(&self, value: impl Fn([f64; 2]) -> f64) -> Distribution {
        let area = self.integral(|_| 1.0);
        let mean = self.integral(&value) / area;
        let variance = self.integral(|k| (value(k) - mean).powi(2)) / area;
        let values = || self.nodes.iter().map(|&(k, _)| value(k));
        Distribution {
            mean,
            standard_deviation: variance.sqrt(),
            least: values().fold(f64::INFINITY, f64::min),
            largest: values().fold(f64::NEG_INFINITY, f64::max),
        }
    }

    /// ∫ K dS over 4 pi, less one: see [`Self::total`].
    pub fn gauss_bonnet_error(&self) -> f64 {
        self.total() / (4.0 * PI) - 1.0
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::{Radial, StarSurface};
    use crate::shapes::{Body, Ellipsoid, Sphere};
    use crate::sphere::{AngleRectangle, GaussLegendre};
    use approx::assert_relative_eq;
    use std::f64::consts::TAU;

    fn statistics(surface: &(impl StarSurface + ?Sized)) -> CurvatureStatistics {
        let sphere = AngleRectangle {
            theta: [0.0, PI],
            phi: [0.0, TAU],
        };
        let rule = GaussLegendre::new(48);
        let nodes: Vec<Node> = sphere
            .quarters()
            .into_iter()
            .flat_map(|part| part.quarters())
            .flat_map(|part| part.nodes(&rule, &rule))
            .collect();
        CurvatureStatistics::new(&Radial(surface), &nodes)
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
    fn a_sphere_is_curved_alike_everywhere_and_has_no_corner() {
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
        assert_eq!(found.roundness(1.99), 1.0);
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
    fn roundness_is_the_mean_radius_of_the_corners() {
        let found = CurvatureStatistics {
            nodes: vec![([0.5, 0.5], 7.0), ([2.0, 1.0], 3.0), ([4.0, -1.0], 1.0)],
            sharpest: Vector3::x(),
            unit: 1.0,
        };
        // Corners of radii 1/2 and 1/4 of an inscribed radius of 1, by area.
        assert_relative_eq!(found.roundness(1.0), (3.0 * 0.5 + 0.25) / 4.0);
        assert_relative_eq!(found.convex_share(), 10.0 / 11.0);
    }
}
