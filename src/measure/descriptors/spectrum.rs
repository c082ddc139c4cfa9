//! The power of a surface's radius per degree of spherical harmonics.

use crate::measure::integrals::elements::Element;
use crate::sphere::{AccurateHarmonics, coefficient_count};
use nalgebra::Vector3;
use serde::Serialize;
use std::f64::consts::PI;

/// Largest degree of a [`Spectrum`]: the largest that the source uses for whole grains.
pub const SPECTRUM_DEGREE: usize = 20;

/// Largest degree of a [`RadialExpansion`]: the largest that models of grains have.
pub const EXPANSION_DEGREE: usize = 128;

/// How the radius, seen from the centroid, is made of harmonics of each degree: r = sum of a_l^m Y_l^m
/// with the real orthonormal harmonics of [`harmonics`](crate::sphere::harmonics).
///
/// Invariant under rotation and translation (Kazhdan, Funkhouser and Rusinkiewicz 2003).
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Spectrum {
    /// Power of degree l = 0, 1, ..., [`SPECTRUM_DEGREE`]: the sum over the orders m of (a_l^m)², in
    /// the unit squared. All powers add up to ∫ r² dΩ.
    pub power: Vec<f64>,
    /// sqrt(power_l / power_0): pure numbers, the same for bodies of the same shape and any size; 1 at
    /// degree 0, 0 beyond it for a sphere.
    pub relative_amplitude: Vec<f64>,
}

/// The radius seen from the centroid as harmonics.
#[derive(Debug, Clone, PartialEq)]
pub struct RadialExpansion {
    /// Coefficients a_l^m of the real orthonormal harmonics at index l(l+1) + m, in the unit, along the axes of the
    /// scan.
    pub coefficients: Vec<f64>,
    /// Root mean square over all directions of what the harmonics miss of the radius, in the unit.
    pub rms: f64,
}

impl RadialExpansion {
    /// That of the surface made of these elements, seen from the centroid.
    pub(in crate::measure) fn new(elements: &[Element], degree: usize) -> Self {
        let seen = Seen::new(elements, degree);
        let coefficients = seen.coefficients();
        Self {
            rms: seen.missed(&coefficients),
            coefficients,
        }
    }
}

impl Spectrum {
    /// That of the surface made of these elements, seen from the centroid.
    pub(in crate::measure) fn new(elements: &[Element]) -> Self {
        let found = Seen::new(elements, SPECTRUM_DEGREE).coefficients();
        let power: Vec<f64> = (0..=SPECTRUM_DEGREE)
            .map(|degree| {
                let own = degree * degree..coefficient_count(degree);
                found[own].iter().map(|a| a * a).sum()
            })
            .collect();
        Self {
            relative_amplitude: power.iter().map(|p| (p / power[0]).sqrt()).collect(),
            power,
        }
    }
}

/// A surface as it is seen from a point: how far off, in which directions and over which solid angles.
struct Seen {
    degree: usize,
    harmonics: AccurateHarmonics,
    distances: Vec<f64>,
    solid_angles: Vec<f64>,
}

impl Seen {
    fn new(elements: &[Element], degree: usize) -> Self {
        let mut seen: [Vec<f64>; 2] = Default::default();
        let directions = elements.iter().map(|element| {
            let (direction, distance, solid_angle) = element.seen();
            seen[0].push(distance);
            seen[1].push(solid_angle);
            direction
        });
        let directions: Vec<Vector3<f64>> = directions.collect();
        let [distances, solid_angles] = seen;
        Self {
            degree,
            harmonics: AccurateHarmonics::new(degree, &directions),
            distances,
            solid_angles,
        }
    }

    /// Coefficients of the radius.
    fn coefficients(&self) -> Vec<f64> {
        let terms = self.distances.iter().zip(&self.solid_angles);
        let terms: Vec<f64> = terms
            .map(|(distance, solid_angle)| distance * solid_angle)
            .collect();
        let mut coefficients = vec![0.0; coefficient_count(self.degree)];
        self.harmonics.adjoint(&terms, &mut coefficients);
        coefficients
    }

    /// Root mean square over all directions of what coefficients miss of the radius.
    fn missed(&self, coefficients: &[f64]) -> f64 {
        let mut found = vec![0.0; self.distances.len()];
        self.harmonics.synthesis(coefficients, &mut found);
        let squares = found
            .iter()
            .zip(&self.distances)
            .map(|(found, distance)| (found - distance).powi(2));
        let sum: f64 = squares
            .zip(&self.solid_angles)
            .map(|(square, solid_angle)| square * solid_angle)
            .sum();
        (sum / (4.0 * PI)).max(0.0).sqrt()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Mesh;
    use crate::measure::integrals::elements::mesh_elements;
    use crate::shapes::Body;
    use approx::assert_relative_eq;
    use nalgebra::{Point3, Rotation3};

    /// That of a mesh of a body, turned and moved.
    fn spectrum(body: Body, angle: f64) -> Spectrum {
        let surface = body.surface();
        let turn = Rotation3::from_euler_angles(angle, 2.0 * angle, 3.0 * angle);
        let from = Point3::from(Vector3::repeat(angle));
        let mut mesh = Mesh::radial(64, |n| surface.radius(n));
        for vertex in &mut mesh.vertices {
            *vertex = from + turn * vertex.coords;
        }
        Spectrum::new(&mesh_elements(&mesh, &from))
    }

    #[test]
    fn a_sphere_has_power_in_degree_zero_only() {
        let found = spectrum(Body::Sphere, 0.0);
        assert_relative_eq!(found.power[0], 4.0 * PI * 25.0, max_relative = 1e-3);
        assert_eq!(found.relative_amplitude[0], 1.0);
        assert!(found.relative_amplitude[1..].iter().all(|a| *a < 1e-3));
    }

    #[test]
    fn powers_add_up_to_the_mean_square_radius() {
        // r² of the oblate ellipsoid is 1/(x²/4 + z²), whose mean over z is closed.
        let found = spectrum(Body::Ellipsoid, 0.0);
        let root = 3.0_f64.sqrt();
        let exact = 4.0 * PI * 4.0 * root.atan() / root;
        let sum: f64 = found.power.iter().sum();
        assert_relative_eq!(sum, exact, max_relative = 1e-3);
        // Symmetric in z: no odd degree.
        assert!(found.power.iter().skip(1).step_by(2).all(|p| *p < 1e-6));
    }

    #[test]
    fn a_body_keeps_its_spectrum_when_it_is_turned_and_moved() {
        let (still, turned) = (spectrum(Body::Maize, 0.0), spectrum(Body::Maize, 0.7));
        for (one, other) in still.power.iter().zip(&turned.power) {
            assert!((one - other).abs() < 1e-10 * still.power[0]);
        }
    }
}
