//! The support function of a superquadric, in closed form: that of dual norms.

use super::norm::Slopes;
use super::{Octant, Superquadric};
use nalgebra::Vector3;
use std::array::from_fn;

impl Superquadric {
    /// The support function h(d) = max d . x over the body, and the point x where it is met. For a unit vector `d`, h
    /// is the distance of the tangent plane normal to d from the origin. Of d = 0 both are zero.
    ///
    /// The dual of the n-norm is the q-norm with 1/n + 1/q = 1, and so with u = a |d_x| and so on h is the q1-norm of
    /// the q2-norm of (u, v) and w; its gradient is the point.
    #[inline]
    pub fn support(&self, d: &Vector3<f64>) -> (f64, Vector3<f64>) {
        let [found] = Self::supports([self], [d]);
        found
    }

    /// The same of several bodies, each along a direction of its own.
    #[inline]
    pub(crate) fn supports<const N: usize>(
        bodies: [&Self; N],
        d: [&Vector3<f64>; N],
    ) -> [(f64, Vector3<f64>); N] {
        let octants: [Octant; N] = from_fn(|i| bodies[i].octant((*d[i]).into()));
        let scaled = |axis: usize| from_fn(|i: usize| d[i][axis].abs() * octants[i].axes[axis]);
        // q - 1 = 1 / (n - 1).
        let exponents = octants.map(|octant| 1.0 / (octant.n2 - 1.0));
        let inner = Slopes::side_by_side(scaled(0), scaled(1), exponents);
        let exponents = octants.map(|octant| 1.0 / (octant.n1 - 1.0));
        let outer = Slopes::side_by_side(inner.map(|norm| norm.norm), scaled(2), exponents);
        from_fn(|i| {
            let ([p, z], [x, y]) = (outer[i].slopes, inner[i].slopes);
            let slopes = [p * x, p * y, z];
            let [x, y, z] = from_fn(|k| slopes[k] * octants[i].signs[k] * octants[i].axes[k]);
            match outer[i].norm > 0.0 {
                true => (outer[i].norm, Vector3::new(x, y, z)),
                false => (0.0, Vector3::zeros()),
            }
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;

    #[test]
    fn the_support_point_is_on_the_surface_where_the_normal_is_the_direction() {
        let body = Superquadric::poly12(
            [[1.0, 1.5], [2.0, 1.0], [0.7, 0.9]],
            [1.5, 4.0],
            [[2.0, 3.0], [5.0, 1.8]],
        )
        .unwrap();
        for i in 0..200 {
            let t = 2.4 * f64::from(i);
            let z = (f64::from(i) + 0.5) / 100.0 - 1.0;
            let d = Vector3::new(t.cos(), t.sin(), 0.0) * (1.0 - z * z).sqrt() + Vector3::z() * z;
            let (height, point) = body.support(&d);
            let (gauge, slope) = body.gauge_and_slope(&point);
            assert_relative_eq!(gauge, 1.0, max_relative = 1e-13);
            assert_relative_eq!(d.dot(&point), height, max_relative = 1e-13);
            assert_relative_eq!(slope.normalize(), d, epsilon = 1e-9);
        }
    }
}
