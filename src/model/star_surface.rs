//! Surfaces that every ray from one point meets once.

use super::{Surface, SurfaceJet};
use crate::sphere::Jet;
use nalgebra::{Matrix3, Vector3};

/// A closed surface that every ray from the origin meets once: r = r(n), n a unit vector; of a
/// [`StarGrain`](super::StarGrain) a vector of any length but zero.
///
/// Everything is said in terms of the direction `n`, never of angles, so nothing is singular at the
/// poles. With the surface gradient g (the tangential derivative of r on the unit sphere, a vector
/// orthogonal to n), the outward normal is along `r n - g` and the element of area is
/// `r sqrt(r^2 + |g|^2)` per unit solid angle.
///
/// On an edge derivatives are those of one of its sides. Threads share a surface.
pub trait StarSurface: Sync {
    /// Radius in the direction of the unit vector `n`.
    fn radius(&self, n: &Vector3<f64>) -> f64;

    /// Radius and its surface gradient (length per radian, orthogonal to `n`).
    fn radius_and_gradient(&self, n: &Vector3<f64>) -> (f64, Vector3<f64>);

    /// Radius with its first and second derivatives, from the formulas of the surface.
    fn derivatives(&self, n: &Vector3<f64>) -> Derivatives;
}

/// A radius and its derivatives on the unit sphere.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Derivatives {
    /// Radius.
    pub radius: f64,
    /// Surface gradient: length per radian, orthogonal to the direction.
    pub gradient: Vector3<f64>,
    /// Second covariant derivatives on the sphere: length per square radian, symmetric, with the
    /// direction in its kernel. Along a great circle of unit tangent t the radius has the second
    /// derivative t.H t.
    pub hessian: Matrix3<f64>,
}

impl Derivatives {
    /// The derivatives on the sphere, at `n`, of a function of space.
    pub(crate) fn on_sphere(n: &Vector3<f64>, jet: &Jet) -> Self {
        let across = Matrix3::identity() - n * n.transpose();
        Self {
            radius: jet.value,
            gradient: across * jet.gradient,
            hessian: across * jet.hessian * across - across * jet.gradient.dot(n),
        }
    }

    /// The same in another frame, whose axes are the columns of `axes`.
    pub(crate) fn turned(&self, axes: &Matrix3<f64>) -> Self {
        Self {
            radius: self.radius,
            gradient: axes * self.gradient,
            hessian: axes * self.hessian * axes.transpose(),
        }
    }
}

impl Derivatives {
    /// Those of the surface r(n) n.
    pub(crate) fn radial(&self, n: &Vector3<f64>) -> SurfaceJet {
        let Self {
            radius,
            gradient,
            hessian,
        } = self;
        let across = Matrix3::identity() - n * n.transpose();
        let bend = |i: usize| {
            let mixed = gradient * across.row(i);
            (hessian - across * *radius) * n[i] + mixed + mixed.transpose()
        };
        SurfaceJet {
            place: n * *radius,
            slopes: n * gradient.transpose() + across * *radius,
            bends: [0, 1, 2].map(bend),
        }
    }
}

/// The slopes of the surface r(n) n where the radius has this gradient.
pub(super) fn radial_slopes(
    n: &Vector3<f64>,
    (radius, gradient): (f64, Vector3<f64>),
) -> Matrix3<f64> {
    n * (gradient - n * radius).transpose() + Matrix3::from_diagonal_element(radius)
}

/// A star-shaped surface about the origin as one over the sphere: X(n) = r(n) n, with edges between octants at most.
#[derive(Debug)]
pub struct Radial<'a, S: ?Sized>(pub &'a S);

impl<S: ?Sized> Clone for Radial<'_, S> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<S: ?Sized> Copy for Radial<'_, S> {}

impl<S: StarSurface + ?Sized> Surface for Radial<'_, S> {
    fn place(&self, n: &Vector3<f64>) -> Vector3<f64> {
        n * self.0.radius(n)
    }

    fn place_and_slopes(&self, n: &Vector3<f64>) -> (Vector3<f64>, Matrix3<f64>) {
        let found = self.0.radius_and_gradient(n);
        (n * found.0, radial_slopes(n, found))
    }

    fn jet(&self, n: &Vector3<f64>) -> SurfaceJet {
        self.0.derivatives(n).radial(n)
    }

    fn may_cross(&self) -> bool {
        false
    }
}
