//! What all bodies share: a surface, and what is known of it.

use crate::measure::{Integrals, MassProperties, integrate};
use crate::model::StarSurface;
use crate::sphere::Symmetry;
use nalgebra::{Matrix3, Point3, Vector3};

/// Relative tolerance of integrals that have no closed form.
const QUADRATURE_TOLERANCE: f64 = 1e-10;

/// Relative error of closed forms: some tens of roundings.
const ROUNDING: f64 = 1e-14;

/// A body whose mean radius, area, volume and inertia are known, in its own frame.
pub trait Solid: StarSurface + Send {
    /// Those figures and their error: by adaptive quadrature to 1e-10, or, where there are closed
    /// forms, by them to 1e-14 and without a single evaluation of the surface.
    fn integrals(&self) -> Integrals {
        integrate(self, QUADRATURE_TOLERANCE)
    }

    /// The mirror planes that are known of it: all three of a shape, none of a grain.
    fn symmetry(&self) -> Symmetry {
        Symmetry::NONE
    }

    /// Polar angles in \[0, pi/2\] at which the surface has an edge, a corner or an apex along the
    /// meridian of an azimuth in \[0, pi/2\], ascending: there the surface gradient jumps.
    fn singular_polar_angles(&self, _azimuth: f64) -> Vec<f64> {
        Vec::new()
    }

    /// Azimuths in \[0, pi/2\] along which an edge runs that lies in the plane of a meridian, ascending:
    /// there the surface gradient jumps along the parallels that the edge reaches.
    fn singular_azimuths(&self) -> Vec<f64> {
        Vec::new()
    }
}

/// The integrals of a body that is symmetric in x, y and z: its mean radius, its area, its volume and
/// the means of x², y² and z² over the solid.
pub(super) fn closed_form(
    mean_radius: f64,
    area: f64,
    volume: f64,
    mean_squares: Vector3<f64>,
) -> Integrals {
    let [x, y, z]: [f64; 3] = mean_squares.into();
    let across = Vector3::new(y + z, z + x, x + y);
    Integrals {
        properties: MassProperties {
            area,
            volume,
            centroid: Point3::origin(),
            inertia: Matrix3::from_diagonal(&(across * volume)),
        },
        mean_radius,
        relative_error: ROUNDING,
        evaluations: 0,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Mesh;
    use crate::measure::mesh_properties;
    use crate::shapes::{Body, Cylinder, Ellipsoid, Sampling};
    use crate::sphere::across;
    use approx::assert_relative_eq;
    use proptest::prelude::*;

    /// Largest relative difference of mean radius, area, volume and inertia.
    fn difference(found: &Integrals, other: &Integrals) -> f64 {
        let (a, b) = (&found.properties, &other.properties);
        [
            found.mean_radius / other.mean_radius - 1.0,
            a.area / b.area - 1.0,
            a.volume / b.volume - 1.0,
            (a.inertia - b.inertia).amax() / b.inertia.amax(),
        ]
        .into_iter()
        .fold(0.0, |worst, d| d.abs().max(worst))
    }

    #[test]
    fn closed_forms_agree_with_quadrature_where_that_follows_the_edges() {
        let shapes: [Box<dyn Solid>; 5] = [
            Body::Sphere.surface(),
            Body::Ellipsoid.surface(),
            Body::Bicone.surface(),
            Body::Octahedron.surface(),
            Box::new(Cylinder {
                radius: 1.5,
                half_height: 1.5,
            }),
        ];
        for (i, shape) in shapes.iter().enumerate() {
            let quadrature = integrate(shape.as_ref(), 1e-11);
            assert!(quadrature.relative_error <= 1e-11);
            let difference = difference(&shape.integrals(), &quadrature);
            assert!(difference < 1e-11, "shape {i}: {difference:e}");
        }
    }

    #[test]
    fn closed_forms_agree_with_quadrature_across_the_edges() {
        for body in [Body::Cylinder, Body::Cuboid, Body::Cube] {
            let shape = body.surface();
            let quadrature = integrate(shape.as_ref(), 1e-6);
            let exact = shape.integrals();
            let difference = difference(&exact, &quadrature);
            assert!(difference <= quadrature.relative_error && difference < 1e-3);
            // Only the element of area jumps at an edge; the radius does not.
            let (found, mean) = (quadrature.properties.volume, quadrature.mean_radius);
            assert_relative_eq!(exact.properties.volume, found, max_relative = 1e-7);
            assert_relative_eq!(exact.mean_radius, mean, max_relative = 1e-7);
        }
    }

    #[test]
    fn closed_forms_agree_with_a_fine_mesh() {
        for body in Body::SHAPES {
            let shape = body.surface();
            let mesh = Mesh::radial(128, |n| shape.radius(n));
            let mesh = mesh_properties(&mesh).unwrap();
            let exact = shape.integrals().properties;
            // Edges that the mesh crosses are cut off.
            assert_relative_eq!(mesh.area, exact.area, max_relative = 5e-3);
            assert_relative_eq!(mesh.volume, exact.volume, max_relative = 3e-4);
            let error = (mesh.inertia - exact.inertia).amax();
            assert!(error < 1e-3 * exact.inertia.amax(), "{body}: {error:e}");
            assert!((mesh.centroid - exact.centroid).amax() < 1e-4);
        }
    }

    /// Directions all over the sphere and along the axes: faces, corners, edges and apexes.
    fn directions() -> Vec<Vector3<f64>> {
        let mut all = Sampling::Fibonacci.directions(500, 0).unwrap();
        all.extend(Sampling::Cube.directions(26, 0).unwrap());
        all
    }

    #[test]
    fn gradients_are_tangential_and_finite_everywhere() {
        for body in Body::SHAPES {
            let shape = body.surface();
            for n in directions() {
                let (r, gradient) = shape.radius_and_gradient(&n);
                assert_relative_eq!(r, shape.radius(&n), max_relative = 1e-14);
                assert!(gradient.dot(&n).abs() < 1e-14 * r, "{body} at {n:?}");
            }
        }
    }

    #[test]
    fn gradients_match_differences_away_from_edges() {
        let step = 1e-6_f64;
        for body in Body::SHAPES {
            let shape = body.surface();
            let mut skipped = 0;
            for n in Sampling::Fibonacci.directions(500, 0).unwrap() {
                let (r, gradient) = shape.radius_and_gradient(&n);
                for tangent in across(&n) {
                    let at = |angle: f64| shape.radius(&(n * angle.cos() + tangent * angle.sin()));
                    let slopes = [at(step) - r, r - at(-step)].map(|rise| rise / step);
                    if (slopes[0] - slopes[1]).abs() > 1e-3 {
                        skipped += 1;
                        continue;
                    }
                    let error = gradient.dot(&tangent) - (slopes[0] + slopes[1]) / 2.0;
                    assert!(error.abs() < 1e-7, "{body} at {n:?}: {error:e}");
                }
            }
            assert!(skipped < 10, "{body}: {skipped}");
        }
    }

    #[test]
    fn second_derivatives_match_differences_of_the_gradient_away_from_edges() {
        let step = 1e-5_f64;
        for body in Body::ALL {
            let shape = body.surface();
            let mut skipped = 0;
            for n in Sampling::Fibonacci.directions(500, 0).unwrap() {
                let found = shape.derivatives(&n);
                let (r, gradient) = shape.radius_and_gradient(&n);
                assert_relative_eq!(found.radius, r, max_relative = 1e-14);
                assert!((found.gradient - gradient).norm() < 1e-13 * r);
                assert!((found.hessian * n).norm() < 1e-12 * r);
                for tangent in across(&n) {
                    let [after, before] = [step, -step].map(|angle| {
                        let n = n * angle.cos() + tangent * angle.sin();
                        shape.radius_and_gradient(&n).1
                    });
                    let change = (after - before) / (2.0 * step);
                    let error = change - n * change.dot(&n) - found.hessian * tangent;
                    if change.norm() > 1e3 {
                        skipped += 1;
                        continue;
                    }
                    assert!(error.norm() < 1e-6, "{body} at {n:?}: {error:?}");
                }
            }
            assert!(skipped < 10, "{body}: {skipped}");
        }
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(20))]
        #[test]
        fn a_triaxial_ellipsoid_agrees_with_quadrature(
            a in 1.0..2.5_f64, b in 1.0..2.5_f64, c in 1.0..2.5_f64,
        ) {
            let ellipsoid = Ellipsoid { semi_axes: Vector3::new(a, b, c) };
            let quadrature = integrate(&ellipsoid, 1e-10);
            prop_assert!(difference(&ellipsoid.integrals(), &quadrature) < 1e-9);
        }
    }

    proptest! {
        #[test]
        fn figures_scale_with_the_powers_of_length(
            which in 0..Body::SHAPES.len(),
            flat in -8.0..8.0_f64,
            size in -4.0..4.0_f64,
        ) {
            let body = Body::SHAPES[which];
            let axes = match body {
                Body::Sphere | Body::Cube => Vector3::repeat(1.0),
                _ => Vector3::new(1.0, 1.0, flat.exp()),
            };
            let s = size.exp();
            let one = body.with_axes(axes).unwrap().integrals();
            let scaled = body.with_axes(axes * s).unwrap().integrals();
            let expected = Integrals {
                mean_radius: one.mean_radius * s,
                properties: MassProperties {
                    area: one.properties.area * s.powi(2),
                    volume: one.properties.volume * s.powi(3),
                    inertia: one.properties.inertia * s.powi(5),
                    ..one.properties
                },
                ..one
            };
            prop_assert!(difference(&scaled, &expected) < 2.0 * ROUNDING);
        }

        #[test]
        fn turning_the_axes_turns_the_inertia_and_nothing_else(
            axes in prop::array::uniform3(-3.0..3.0_f64),
            which in 0..3_usize,
        ) {
            let body = [Body::Ellipsoid, Body::Octahedron, Body::Cuboid][which];
            let axes = Vector3::from(axes).map(f64::exp);
            let straight = body.with_axes(axes).unwrap().integrals();
            let mut turned = body.with_axes(axes.yzx()).unwrap().integrals();
            let back = turned.properties.inertia.diagonal().zxy();
            turned.properties.inertia = Matrix3::from_diagonal(&back);
            prop_assert!(difference(&straight, &turned) < 2.0 * ROUNDING);
        }
    }
}
