//! The power of a surface's radius per degree of spherical harmonics.

use super::elements::Element;
use crate::sphere::{HarmonicBasis, coefficient_count};
use rayon::prelude::*;
use serde::Serialize;
use std::f64::consts::PI;

/// Largest degree of a [`Spectrum`]: the largest that the source uses for whole grains.
pub const SPECTRUM_DEGREE: usize = 20;

/// Largest degree of a [`RadialExpansion`]: the largest that models of grains have.
pub const EXPANSION_DEGREE: usize = 128;

/// Elements added up by one task; the sums of tasks are added in order, so that the result does not
/// depend on the number of threads.
const PER_TASK: usize = 4096;

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
    pub(super) fn new(elements: &[Element], degree: usize) -> Self {
        let coefficients = coefficients(elements, degree);
        let basis = HarmonicBasis::new(degree);
        let missed = |element: &Element| {
            let (direction, distance, solid_angle) = element.seen();
            let mut values = vec![0.0; coefficients.len()];
            basis.evaluate(&direction, &mut values);
            let found: f64 = values.iter().zip(&coefficients).map(|(y, a)| y * a).sum();
            (found - distance).powi(2) * solid_angle
        };
        let missed: Vec<f64> = elements.par_iter().map(missed).collect();
        Self {
            rms: (missed.iter().sum::<f64>() / (4.0 * PI)).max(0.0).sqrt(),
            coefficients,
        }
    }
}

impl Spectrum {
    /// That of the surface made of these elements, seen from the centroid.
    pub(super) fn new(elements: &[Element]) -> Self {
        let found = coefficients(elements, SPECTRUM_DEGREE);
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

/// Coefficients of the radius up to a degree.
fn coefficients(elements: &[Element], degree: usize) -> Vec<f64> {
    let count = coefficient_count(degree);
    let basis = HarmonicBasis::new(degree);
    let sums: Vec<Vec<f64>> = elements
        .par_chunks(PER_TASK)
        .map(|elements| {
            let (mut sums, mut values) = (vec![0.0; count], vec![0.0; count]);
            for element in elements {
                let (direction, distance, solid_angle) = element.seen();
                basis.evaluate(&direction, &mut values);
                let weight = distance * solid_angle;
                for (sum, value) in sums.iter_mut().zip(&values) {
                    *sum += value * weight;
                }
            }
            sums
        })
        .collect();
    let coefficient = |j: usize| sums.iter().map(|sums| sums[j]).sum::<f64>();
    (0..count).map(coefficient).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Mesh;
    use crate::measure::elements::mesh_elements;
    use crate::shapes::Body;
    use approx::assert_relative_eq;
    use nalgebra::{Point3, Rotation3, Vector3};
    use std::f64::consts::PI;

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
