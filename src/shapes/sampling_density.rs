//! Few directions that do the work of many: Gauss points that respect the edges of a body.
//!
//! Between the edges of a body its radius is smooth, and so is all that the normal equations of a fit
//! are made of. Gauss points in each smooth piece give these integrals, for any smooth density, with an
//! error that falls exponentially: a fit to some hundred such points is that to a grid without end. So
//! the density alone is left to choose.

use super::Solid;
use crate::sphere::GaussLegendre;
use nalgebra::Vector3;
use std::f64::consts::FRAC_PI_2;

/// What a sample counts, per step of the polar angle theta and of the azimuth:
/// sin(theta)^a r^b cos(gamma)^c, with gamma the angle between the ray and the normal.
///
/// (0, 0, 0) is the density of an equiangular grid, (1, 0, 0) that of the solid angle, (1, 2, -1) that
/// of the surface's area. With b = 2 less, the relative deviation is what is fitted. With (1, 2, 0) the
/// volume is right to second order, for one of the normal equations then says that the integral of
/// r² (model - r) over all directions is zero. Edges and corners, where rays graze the surface, count
/// for more the more negative c is.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SamplingDensity {
    /// The exponent a of sin(theta).
    pub sine: f64,
    /// The exponent b of the radius.
    pub radius: f64,
    /// The exponent c of the cosine between ray and normal.
    pub slope: f64,
}

impl SamplingDensity {
    /// That of the surface's area.
    pub const AREA: Self = Self {
        sine: 1.0,
        radius: 2.0,
        slope: -1.0,
    };

    /// Directions in the octant of positive x, y, z and their weights: `azimuth` Gauss points, shared
    /// evenly among the pieces between singular azimuths, and on the meridian of each `polar` Gauss
    /// points, shared likewise. `polar` x `azimuth` directions, all inside the octant.
    pub fn sample(
        &self,
        body: &dyn Solid,
        polar: usize,
        azimuth: usize,
    ) -> Vec<(Vector3<f64>, f64)> {
        let mut samples = Vec::with_capacity(polar * azimuth);
        for (phi, width) in nodes(&body.singular_azimuths(), azimuth) {
            for (theta, height) in nodes(&body.singular_polar_angles(phi), polar) {
                let (sin, cos) = theta.sin_cos();
                let n = Vector3::new(sin * phi.cos(), sin * phi.sin(), cos);
                samples.push((n, width * height * self.at(body, &n)));
            }
        }
        samples
    }

    /// The density in a direction of a body.
    fn at(&self, body: &dyn Solid, n: &Vector3<f64>) -> f64 {
        let (r, gradient) = body.radius_and_gradient(n);
        let cosine = r / r.hypot(gradient.norm());
        n.x.hypot(n.y).powf(self.sine) * r.powf(self.radius) * cosine.powf(self.slope)
    }
}

/// Gauss points and weights on the pieces between singular angles.
fn nodes(singular: &[f64], count: usize) -> Vec<(f64, f64)> {
    let inner = singular.iter().copied();
    let inner = inner.filter(|&angle| angle > 0.0 && angle < FRAC_PI_2);
    let ends: Vec<f64> = [0.0].into_iter().chain(inner).chain([FRAC_PI_2]).collect();
    let pieces = ends.len() - 1;
    let mut nodes = Vec::with_capacity(count);
    for (i, ends) in ends.windows(2).enumerate() {
        let rule = GaussLegendre::new((i + 1) * count / pieces - i * count / pieces);
        nodes.extend(rule.on(ends[0], ends[1]));
    }
    nodes
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shapes::Body;
    use approx::assert_relative_eq;
    use std::f64::consts::PI;

    const SOLID_ANGLE: SamplingDensity = SamplingDensity {
        sine: 1.0,
        radius: 0.0,
        slope: 0.0,
    };

    #[test]
    fn the_weights_of_a_hundred_directions_integrate_over_bodies_with_edges() {
        for body in [Body::Ellipsoid, Body::Cylinder, Body::Cuboid] {
            let shape = body.surface();
            let exact = shape.integrals().properties;
            let sum = |density: SamplingDensity, polar, azimuth, f: &dyn Fn(f64) -> f64| {
                let samples = density.sample(shape.as_ref(), polar, azimuth);
                assert_eq!(samples.len(), polar * azimuth);
                8.0 * samples
                    .iter()
                    .map(|(n, weight)| weight * f(shape.radius(n)))
                    .sum::<f64>()
            };
            let whole = sum(SOLID_ANGLE, 12, 8, &|_| 1.0);
            let volume = sum(SOLID_ANGLE, 12, 8, &|r| r * r * r / 3.0);
            let area = sum(SamplingDensity::AREA, 12, 8, &|_| 1.0);
            assert_relative_eq!(whole, 4.0 * PI, max_relative = 1e-5);
            assert_relative_eq!(volume, exact.volume, max_relative = 1e-4);
            assert_relative_eq!(area, exact.area, max_relative = 1e-4);
            let area = sum(SamplingDensity::AREA, 48, 32, &|_| 1.0);
            assert_relative_eq!(area, exact.area, max_relative = 1e-11);
        }
    }

    #[test]
    fn all_directions_asked_for_come_however_many_the_pieces() {
        let cuboid = Body::Cuboid.surface();
        for (polar, azimuth) in [(0, 5), (1, 1), (5, 7)] {
            let samples = SOLID_ANGLE.sample(cuboid.as_ref(), polar, azimuth);
            assert_eq!(samples.len(), polar * azimuth);
        }
    }
}
