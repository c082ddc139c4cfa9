//! A rectangular parallelepiped.

use super::Cylinder;
use super::gauge::{derivatives, radius_and_gradient};
use super::section::along_side;
use super::solid::{Solid, closed_form};
use crate::measure::Integrals;
use crate::model::{Derivatives, StarSurface};
use crate::sphere::{Jet, Symmetry};
use nalgebra::{Point3, Vector3};
use std::f64::consts::FRAC_2_PI;

/// The rectangular parallelepiped max(|x|/a, |y|/b, |z|/c) <= 1, centred at the origin; a cube when
/// all three are equal.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Cuboid {
    /// Half-edges a, b, c along x, y, z, positive.
    pub half_edges: Vector3<f64>,
}

impl Cuboid {
    /// The slope of the gauge |x_i| / a_i of the face that `n` meets.
    fn slope(&self, n: &Vector3<f64>) -> Vector3<f64> {
        let axis = n.component_div(&self.half_edges).iamax();
        Vector3::ith(axis, n[axis].signum() / self.half_edges[axis])
    }

    /// The surface points of a lattice of `n` x `n` x `n` points over the body, `n` at least 2:
    /// 6 (n - 1)² + 2, so 866 for the 13 of Radvilaite's study of the cube (2014).
    pub fn lattice(&self, n: usize) -> Vec<Point3<f64>> {
        let last = n.max(2) - 1;
        let share = |i: usize| 2.0 * i as f64 / last as f64 - 1.0;
        let is_border = |i: usize| i == 0 || i == last;
        let mut points = Vec::with_capacity(6 * last * last + 2);
        for i in 0..=last {
            for j in 0..=last {
                let step = if is_border(i) || is_border(j) {
                    1
                } else {
                    last
                };
                for k in (0..=last).step_by(step) {
                    let place = Vector3::new(share(i), share(j), share(k));
                    points.push(Point3::from(self.half_edges.component_mul(&place)));
                }
            }
        }
        points
    }

    /// Mean radius: that of cylinders over the two sides of the rectangle in a quadrant of z = 0.
    fn mean_radius(&self) -> f64 {
        let [a, b, half_height]: [f64; 3] = self.half_edges.into();
        let cylinder = |radius| {
            Cylinder {
                radius,
                half_height,
            }
            .mean_radius()
        };
        FRAC_2_PI * (along_side(a, [0.0, b / a], cylinder) + along_side(b, [0.0, a / b], cylinder))
    }
}

impl StarSurface for Cuboid {
    fn radius(&self, n: &Vector3<f64>) -> f64 {
        1.0 / n.component_div(&self.half_edges).amax()
    }

    fn radius_and_gradient(&self, n: &Vector3<f64>) -> (f64, Vector3<f64>) {
        radius_and_gradient(n, &self.slope(n))
    }

    fn derivatives(&self, n: &Vector3<f64>) -> Derivatives {
        derivatives(n, &Jet::linear(n, self.slope(n)))
    }
}

impl Solid for Cuboid {
    /// S = 8 (a b + b c + c a), V = 8 a b c, means of the squares a²/3, b²/3, c²/3; the mean radius
    /// by Gauss points that respect the edges.
    fn integrals(&self) -> Integrals {
        let edges = &self.half_edges;
        let faces = edges.x * edges.y + edges.y * edges.z + edges.z * edges.x;
        closed_form(
            self.mean_radius(),
            8.0 * faces,
            8.0 * edges.product(),
            edges.component_mul(edges) / 3.0,
        )
    }

    fn symmetry(&self) -> Symmetry {
        Symmetry::OCTANT
    }

    /// The edge round the top, at atan(rho/c) where the rectangle in z = 0 reaches to rho.
    fn singular_polar_angles(&self, azimuth: f64) -> Vec<f64> {
        let (sin, cos) = azimuth.sin_cos();
        let reach = 1.0 / (cos / self.half_edges.x).max(sin / self.half_edges.y);
        vec![reach.atan2(self.half_edges.z)]
    }

    /// The upright edge, at atan(b/a).
    fn singular_azimuths(&self) -> Vec<f64> {
        vec![self.half_edges.y.atan2(self.half_edges.x)]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sphere::GaussLegendre;
    use approx::assert_relative_eq;
    use nalgebra::Matrix3;
    use std::f64::consts::PI;

    fn cuboid(a: f64, b: f64, c: f64) -> Cuboid {
        Cuboid {
            half_edges: Vector3::new(a, b, c),
        }
    }

    #[test]
    fn the_textbook_values_are_met() {
        // Of edges 2, 3 and 4: I_x = m (3² + 4²)/12, and so on.
        let solid = cuboid(1.0, 1.5, 2.0).integrals().properties;
        assert_relative_eq!(solid.area, 52.0, max_relative = 1e-15);
        assert_relative_eq!(solid.volume, 24.0, max_relative = 1e-15);
        let inertia = Matrix3::from_diagonal(&Vector3::new(50.0, 40.0, 26.0));
        assert_relative_eq!(solid.inertia, inertia, epsilon = 1e-13);
        let cube = cuboid(1.0, 1.0, 1.0).integrals().properties;
        assert_relative_eq!(
            cube.inertia,
            Matrix3::identity() * (16.0 / 3.0),
            epsilon = 1e-14
        );
    }

    /// ∫ r dΩ over a face at height h is h ∫ dA / (h² + x² + y²): a way of its own.
    #[test]
    fn the_mean_radius_is_that_over_the_faces() {
        let rule = GaussLegendre::new(60);
        let quadrant = |a: f64, b: f64, h: f64| -> f64 {
            let nodes = rule
                .on(0.0, a)
                .flat_map(|(x, u)| rule.on(0.0, b).map(move |(y, v)| (x, y, u * v)));
            nodes.map(|(x, y, w)| w * h / (h * h + x * x + y * y)).sum()
        };
        let (a, b, c) = (2.0, 1.3, 0.9);
        let octant = quadrant(a, b, c) + quadrant(b, c, a) + quadrant(c, a, b);
        let found = cuboid(a, b, c).integrals().mean_radius;
        assert_relative_eq!(found, 2.0 * octant / PI, max_relative = 1e-13);
    }

    #[test]
    fn the_mean_radius_does_not_depend_on_which_way_it_lies() {
        let mean = |a, b, c| cuboid(a, b, c).integrals().mean_radius;
        let long = mean(1e4, 1.0, 1e-3);
        assert_relative_eq!(mean(1.0, 1e4, 1e-3), long, max_relative = 1e-14);
        assert_relative_eq!(mean(1e-3, 1.0, 1e4), long, max_relative = 1e-14);
        assert_relative_eq!(mean(1.0, 1e-3, 1e4), long, max_relative = 1e-14);
    }
}
