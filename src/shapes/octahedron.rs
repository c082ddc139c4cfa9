//! An octahedron.

use super::Bicone;
use super::gauge::{derivatives, radius_and_gradient};
use super::section::along_side;
use super::solid::{Solid, closed_form};
use crate::measure::Integrals;
use crate::model::{Derivatives, StarSurface};
use crate::sphere::{Jet, Symmetry};
use nalgebra::Vector3;
use std::f64::consts::{FRAC_2_PI, FRAC_PI_2};

/// The octahedron |x|/a + |y|/b + |z|/c <= 1, centred at the origin, its corners on the axes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Octahedron {
    /// Semi-axes a, b, c along x, y, z, positive.
    pub semi_axes: Vector3<f64>,
}

impl Octahedron {
    /// The slope of the gauge |x|/a + |y|/b + |z|/c on the side that `n` meets.
    fn slope(&self, n: &Vector3<f64>) -> Vector3<f64> {
        n.map(f64::signum).component_div(&self.semi_axes)
    }

    /// Mean radius: that of bicones over the side of the rhombus in a quadrant of z = 0.
    fn mean_radius(&self) -> f64 {
        let [a, b, half_height]: [f64; 3] = self.semi_axes.into();
        let distance = a * (b / a.hypot(b));
        let bicone = |radius| {
            Bicone {
                radius,
                half_height,
            }
            .mean_radius()
        };
        FRAC_2_PI * along_side(distance, [-a / b, b / a], bicone)
    }
}

impl StarSurface for Octahedron {
    fn radius(&self, n: &Vector3<f64>) -> f64 {
        1.0 / n.component_div(&self.semi_axes).lp_norm(1)
    }

    fn radius_and_gradient(&self, n: &Vector3<f64>) -> (f64, Vector3<f64>) {
        radius_and_gradient(n, &self.slope(n))
    }

    fn derivatives(&self, n: &Vector3<f64>) -> Derivatives {
        derivatives(n, &Jet::linear(n, self.slope(n)))
    }
}

impl Solid for Octahedron {
    /// S = 4 sqrt(a² b² + b² c² + c² a²), V = 4/3 a b c, means of the squares a²/10, b²/10, c²/10;
    /// the mean radius by Gauss points that respect the edges.
    fn integrals(&self) -> Integrals {
        let axes = &self.semi_axes;
        let products = Vector3::new(axes.x * axes.y, axes.y * axes.z, axes.z * axes.x);
        closed_form(
            self.mean_radius(),
            4.0 * products.norm(),
            4.0 / 3.0 * axes.product(),
            axes.component_mul(axes) / 10.0,
        )
    }

    fn symmetry(&self) -> Symmetry {
        Symmetry::OCTANT
    }

    /// The corner on the axis and the edges round z = 0, at 0 and pi/2.
    fn singular_polar_angles(&self, _azimuth: f64) -> Vec<f64> {
        vec![0.0, FRAC_PI_2]
    }

    /// The edges in the planes y = 0 and x = 0, at 0 and pi/2.
    fn singular_azimuths(&self) -> Vec<f64> {
        vec![0.0, FRAC_PI_2]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Mesh;
    use crate::measure::mesh_properties;
    use approx::assert_relative_eq;
    use nalgebra::Point3;

    #[test]
    fn its_eight_triangles_measure_the_same() {
        let (a, b, c) = (2.0, 1.5, 0.7);
        let corners = [Vector3::x() * a, Vector3::y() * b, Vector3::z() * c];
        let mesh = Mesh {
            vertices: corners
                .into_iter()
                .flat_map(|p| [p, -p])
                .map(Point3::from)
                .collect(),
            triangles: vec![
                [0, 2, 4],
                [2, 1, 4],
                [1, 3, 4],
                [3, 0, 4],
                [2, 0, 5],
                [1, 2, 5],
                [3, 1, 5],
                [0, 3, 5],
            ],
        };
        let mesh = mesh_properties(&mesh).unwrap();
        let semi_axes = Vector3::new(a, b, c);
        let solid = Octahedron { semi_axes }.integrals().properties;
        assert_relative_eq!(solid.area, mesh.area, max_relative = 1e-14);
        assert_relative_eq!(solid.volume, mesh.volume, max_relative = 1e-14);
        assert_relative_eq!(solid.inertia, mesh.inertia, epsilon = 1e-14);
    }

    #[test]
    fn the_regular_one_has_its_area() {
        // Of edge 1: S = 2 sqrt(3), V = sqrt(2)/3.
        let semi_axes = Vector3::repeat(0.5_f64.sqrt());
        let solid = Octahedron { semi_axes }.integrals().properties;
        assert_relative_eq!(solid.area, 2.0 * 3.0_f64.sqrt(), max_relative = 1e-14);
        assert_relative_eq!(solid.volume, 2.0_f64.sqrt() / 3.0, max_relative = 1e-14);
    }
}
