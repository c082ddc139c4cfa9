//! An ellipsoid.

use super::solid::{Solid, closed_form};
use crate::elliptic::{rf, rg};
use crate::measure::Integrals;
use crate::model::{Derivatives, StarSurface};
use crate::sphere::{Jet, Symmetry};
use nalgebra::{Matrix3, Vector3};
use std::f64::consts::PI;

/// The ellipsoid r(n) = (n_x²/a² + n_y²/b² + n_z²/c²)^(-1/2), centred at the origin.
///
/// Its gradient is the tangential part of -r³ (n_x/a², n_y/b², n_z/c²).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Ellipsoid {
    /// Semi-axes a, b, c along x, y, z, positive.
    pub semi_axes: Vector3<f64>,
}

impl StarSurface for Ellipsoid {
    fn radius(&self, n: &Vector3<f64>) -> f64 {
        1.0 / n.component_div(&self.semi_axes).norm()
    }

    fn radius_and_gradient(&self, n: &Vector3<f64>) -> (f64, Vector3<f64>) {
        let scaled = n.component_div(&self.semi_axes);
        let r = 1.0 / scaled.norm();
        let slope = scaled.component_div(&self.semi_axes) * -r.powi(3);
        (r, slope - n * n.dot(&slope))
    }

    fn derivatives(&self, n: &Vector3<f64>) -> Derivatives {
        let weights = self.semi_axes.map(|axis| axis.powi(-2));
        let weighted = n.component_mul(&weights);
        let square = Jet {
            value: n.dot(&weighted),
            gradient: weighted * 2.0,
            hessian: Matrix3::from_diagonal(&weights) * 2.0,
        };
        Derivatives::on_sphere(n, &square.powf(-0.5))
    }
}

impl Solid for Ellipsoid {
    /// S = 4 pi R_G(a² b², b² c², c² a²) (DLMF 19.33.1), V = 4/3 pi a b c, means of the squares a²/5,
    /// b²/5, c²/5 and mean radius R_F(1/a², 1/b², 1/c²), for R_F is the mean of
    /// (x n_x² + y n_y² + z n_z²)^(-1/2) over the unit sphere.
    fn integrals(&self) -> Integrals {
        let axes = &self.semi_axes;
        let squares = axes.component_mul(axes);
        let [x, y, z]: [f64; 3] = squares.into();
        closed_form(
            rf(1.0 / x, 1.0 / y, 1.0 / z),
            4.0 * PI * rg(x * y, y * z, z * x),
            4.0 / 3.0 * PI * axes.product(),
            squares / 5.0,
        )
    }

    fn symmetry(&self) -> Symmetry {
        Symmetry::OCTANT
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;

    fn ellipsoid(a: f64, b: f64, c: f64) -> Integrals {
        let semi_axes = Vector3::new(a, b, c);
        Ellipsoid { semi_axes }.integrals()
    }

    #[test]
    fn spheroids_have_their_elementary_area_and_mean_radius() {
        // With e² = 1 - 1/4, oblate: 2 pi a² (1 + (1 - e²)/e artanh(e)), prolate:
        // 2 pi a² (1 + c/(a e) arcsin(e)).
        let e = 0.75_f64.sqrt();
        let oblate = 8.0 * PI * (1.0 + (1.0 - e * e) / e * e.atanh());
        assert_relative_eq!(oblate, 34.68753, epsilon = 5e-6);
        let prolate = 2.0 * PI * (1.0 + 2.0 / e * e.asin());
        for (axes, area) in [
            ([2.0, 2.0, 1.0], oblate),
            ([2.0, 1.0, 2.0], oblate),
            ([1.0, 1.0, 2.0], prolate),
            ([2.0, 1.0, 1.0], prolate),
        ] {
            let found = ellipsoid(axes[0], axes[1], axes[2]).properties;
            assert_relative_eq!(found.area, area, max_relative = 1e-14);
        }
        // ∫_0^1 du / sqrt((1 - u²)/4 + u²) = 2/sqrt(3) arsinh(sqrt(3)).
        let mean = 2.0 / 3.0_f64.sqrt() * 3.0_f64.sqrt().asinh();
        let found = ellipsoid(2.0, 2.0, 1.0).mean_radius;
        assert_relative_eq!(found, mean, max_relative = 1e-14);
    }

    #[test]
    fn a_flat_one_has_the_area_of_two_ellipses() {
        let found = ellipsoid(3.0, 2.0, 1e-6).properties;
        assert_relative_eq!(found.area, 12.0 * PI, max_relative = 1e-10);
        let turned = ellipsoid(1e-6, 3.0, 2.0).properties;
        assert_relative_eq!(turned.area, found.area, max_relative = 1e-14);
    }
}
