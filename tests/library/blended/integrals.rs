//! Area, volume and inertia of the blended surface against routes that know nothing of cells.

use super::grains::{all, plain, turned};
use gauss_quad::GaussLegendre;
use grainform::fit::fit;
use grainform::measure::{Moments, grain_properties, mesh_properties};
use grainform::scan::Scan;
use grainform::shapes::{Body, SynthOptions, synthesize};
use grainform::{FitOptions, StarGrain, StarSurface, Surface};
use nalgebra::{Point3, Vector3};
use std::f64::consts::{PI, TAU};

/// Compares the integrals with those of a product rule in polar angle and azimuth.
pub(crate) fn check(grain: &StarGrain, bound: f64) {
    let found = grain_properties(grain).properties;
    let mut moments = Moments::default();
    let turns = 720;
    for &(x, weight) in GaussLegendre::new(360.try_into().expect("a count")).iter() {
        let (s, c) = (0.5 * PI * (x + 1.0)).sin_cos();
        for turn in 0..turns {
            let (sp, cp) = (TAU * (turn as f64 + 0.5) / turns as f64).sin_cos();
            let n = Vector3::new(s * cp, s * sp, c);
            let (radius, gradient) = grain.radius_and_gradient(&n);
            let area =
                (n * radius - gradient) * (radius * 0.5 * PI * weight * s * TAU / turns as f64);
            moments.add_element(&(n * radius), &area);
        }
    }
    let exact = moments.about_centroid(&grain.frame().centre);
    let (area, volume) = (
        found.area / exact.area - 1.0,
        found.volume / exact.volume - 1.0,
    );
    assert!(area.abs() < bound, "area {area}");
    assert!(volume.abs() < bound, "volume {volume}");
    let size = exact.volume.cbrt();
    let centroid = (found.centroid - exact.centroid).norm() / size;
    assert!(centroid < bound, "centroid {centroid}");
    let inertia = (found.inertia - exact.inertia).norm() / exact.inertia.norm();
    assert!(inertia < 2.0 * bound, "inertia {inertia}");
}

fn fitted(body: Body) -> StarGrain {
    let scan = Scan::from_points(
        synthesize(&SynthOptions::clean(body))
            .expect("valid options")
            .points,
    );
    let fitted = fit(&scan, &FitOptions::default()).expect("a grain");
    fitted.grain.star().cloned().expect("a star-shaped grain")
}

#[test]
fn integrals_of_made_grains_are_those_of_a_product_rule() {
    for frame in [plain(), turned()] {
        for grain in all(frame) {
            check(&grain, 1e-6);
        }
    }
}

#[test]
fn integrals_of_fitted_grains_are_those_of_a_product_rule_and_of_a_fine_mesh() {
    for body in [Body::Bean, Body::Chickpea, Body::Maize] {
        let grain = fitted(body);
        check(&grain, 1e-6);
        let found = grain_properties(&grain).properties;
        let mesh = mesh_properties(&grain.mesh(128)).expect("closed");
        assert!((mesh.volume / found.volume - 1.0).abs() < 4e-4);
        assert!((mesh.area / found.area - 1.0).abs() < 4e-4);
        assert!((mesh.centroid - found.centroid).norm() < 1e-4 * found.volume.cbrt());
    }
}

#[test]
fn meshes_are_closed_and_lie_on_the_surface() {
    for grain in all(turned()) {
        for resolution in [1, 2, 7, 40] {
            let mesh = grain.mesh(resolution);
            mesh.check_closed().expect("closed and oriented");
            assert_eq!(mesh.vertices.len(), 6 * resolution * resolution + 2);
            for vertex in &mesh.vertices {
                let offset: Vector3<f64> = vertex - grain.frame().centre;
                let on_surface: Point3<f64> = grain.point(&offset.normalize());
                assert!((vertex - on_surface).norm() < 1e-11);
            }
        }
    }
}
