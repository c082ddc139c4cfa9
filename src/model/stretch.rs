//! A linear map along the grain's own axes, after which it is rounder.
//!
//! Expansions in spherical harmonics converge slowly on elongated bodies. A body that is stretched or
//! shortened along its axes until it is nearly round takes fewer of them: with T = diag(t_x, t_y, t_z)
//! and r' the radius of the body T X in the direction of T n,
//!
//! ```text
//! r(n) = r'(q) / |T n|,   q = T n / |T n|
//! ```
//!
//! for T maps the surface point r n to r T n, which is r |T n| far from the centre. In other words
//! r(n) = F(T n), where F(x) = r'(x/|x|) / |x| is the radius r' continued to all of space with degree
//! -1. So the gradient of r is T F'(T n) and its second derivative T F''(T n) T, and no derivative of q
//! is needed.

use super::ray::Ray;
use super::{Derivatives, InvalidGrain, Node};
use crate::sphere::Jet;
use nalgebra::{Matrix3, Vector3};

/// Positive factors along the x, y and z axes of the grain's own frame, by which the grain is
/// multiplied before its radius is expanded: see [`Grain::stretched`](super::StarGrain::stretched).
///
/// Their product need not be one: radii in the stretched space may have another scale.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Stretch {
    factors: Vector3<f64>,
}

/// Largest ratio of two factors. Directions lose as many digits as it has.
const LARGEST_RATIO: f64 = 1e6;

impl Stretch {
    /// No stretch: the factors 1, 1, 1.
    pub const NONE: Self = Self {
        factors: Vector3::new(1.0, 1.0, 1.0),
    };

    /// The stretch by these factors along x, y and z.
    ///
    /// # Errors
    /// [`InvalidGrain::Stretch`] unless they are finite, above zero, and within 1e6 of each other.
    pub fn new(factors: Vector3<f64>) -> Result<Self, InvalidGrain> {
        let (least, largest) = (factors.min(), factors.max());
        // `min` and `max` pass over NaN.
        let is_number = factors.iter().all(|t| t.is_finite());
        if !(is_number && least > 0.0 && largest / least <= LARGEST_RATIO) {
            return Err(InvalidGrain::Stretch {
                factors: factors.into(),
            });
        }
        Ok(Self { factors })
    }

    /// The factors along x, y and z.
    pub fn factors(&self) -> &Vector3<f64> {
        &self.factors
    }

    /// Whether nothing is stretched.
    pub fn is_none(&self) -> bool {
        *self == Self::NONE
    }

    /// Where the unit vector `n` points in the stretched space, T n / |T n|, and |T n|. Without a
    /// stretch `n` itself, to the bit.
    pub fn direction(&self, n: &Vector3<f64>) -> (Vector3<f64>, f64) {
        if self.is_none() {
            return (*n, 1.0);
        }
        let mapped = self.factors.component_mul(n);
        let length = mapped.norm();
        (mapped / length, length)
    }

    /// The radius in a direction, from that of the stretched surface.
    pub(crate) fn radius(
        &self,
        n: &Vector3<f64>,
        stretched: impl FnOnce(&Vector3<f64>) -> f64,
    ) -> f64 {
        let (q, length) = self.direction(n);
        stretched(&q) / length
    }

    /// Radius and surface gradient, likewise.
    pub(crate) fn radius_and_gradient(
        &self,
        n: &Vector3<f64>,
        stretched: impl FnOnce(&Vector3<f64>) -> (f64, Vector3<f64>),
    ) -> (f64, Vector3<f64>) {
        if self.is_none() {
            return stretched(n);
        }
        let (q, length) = self.direction(n);
        let (radius, gradient) = stretched(&q);
        let slope = self.slope(&q, radius, &gradient) / (length * length);
        (radius / length, slope - n * slope.dot(n))
    }

    /// Radius with its first and second derivatives, likewise.
    pub(crate) fn derivatives(
        &self,
        n: &Vector3<f64>,
        stretched: impl FnOnce(&Vector3<f64>) -> Derivatives,
    ) -> Derivatives {
        if self.is_none() {
            return stretched(n);
        }
        let (q, length) = self.direction(n);
        let Derivatives {
            radius,
            gradient,
            hessian,
        } = stretched(&q);
        // F'' at q, from the derivatives on the sphere: F = f |x|^-1 with f constant along rays,
        // f'' = H - q gᵀ - g qᵀ and (|x|^-1)'' = 3 q qᵀ - 1.
        let mixed = q * gradient.transpose();
        let second = hessian - (mixed + mixed.transpose()) * 2.0
            + (q * q.transpose() * 3.0 - Matrix3::identity()) * radius;
        let factors = Matrix3::from_diagonal(&self.factors);
        Derivatives::on_sphere(
            n,
            &Jet {
                value: radius / length,
                gradient: self.slope(&q, radius, &gradient) / (length * length),
                hessian: factors * second * factors / (length * length * length),
            },
        )
    }

    /// T F' at q: with the radius and its surface gradient g there, F' = g - r' q.
    fn slope(&self, q: &Vector3<f64>, radius: f64, gradient: &Vector3<f64>) -> Vector3<f64> {
        self.factors.component_mul(&(gradient - q * radius))
    }

    /// The unit vector n that [`Self::direction`] maps to this one, n', and the factor from radii of the
    /// stretched surface to those of the grain: n = T^-1 n' / a with a = |T^-1 n'| = 1 / |T n|.
    pub(crate) fn back(&self, stretched: &Vector3<f64>) -> (Vector3<f64>, f64) {
        if self.is_none() {
            return (*stretched, 1.0);
        }
        let mapped = stretched.component_div(&self.factors);
        let length = mapped.norm();
        (mapped / length, length)
    }

    /// A node of a quadrature over the directions of the stretched space, and its weight, as one over
    /// those of the grain's own frame: dΩ = det(T^-1) dΩ' / a³.
    pub(crate) fn node(&self, (stretched, solid_angle): Node) -> Node {
        let (direction, a) = self.back(&stretched);
        (
            direction,
            solid_angle / (a * a * a * self.factors.product()),
        )
    }

    /// A ray of the stretched space as one of the grain's own frame. As r = r' a, the integrands of
    /// volume and moments, r³ dΩ = det(T^-1) r'³ dΩ' and so on, are polynomials in the radius r' and
    /// the direction n' as they are without a stretch: what integrates them exactly still does.
    pub(crate) fn ray(&self, ray: Ray) -> Ray {
        if self.is_none() {
            return ray;
        }
        let (direction, a) = self.back(&ray.direction);
        let (_, solid_angle) = self.node((ray.direction, ray.solid_angle));
        let slope = self.slope(&ray.direction, ray.radius, &ray.gradient) * (a * a);
        Ray {
            direction,
            solid_angle,
            radius: ray.radius * a,
            gradient: slope - direction * slope.dot(&direction),
        }
    }
}
