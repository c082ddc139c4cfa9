use super::*;
use crate::measure::grain_properties;
use crate::model::{Family, Frame, Region, StarGrain, grain_from_json, grain_to_json};
use crate::sphere::{cube_grid, harmonics};
use nalgebra::{Point3, Rotation3};

const SYMMETRIES: [&str; 4] = ["none", "y", "xz", "xyz"];

/// A body of degree 3 with some 10 % of relief.
fn body(symmetry: &str) -> Mirrored {
    let coefficients = (0..16)
        .map(|i| match i {
            0 => 3.0,
            _ => 0.1 * (1.7 * i as f64).sin(),
        })
        .collect();
    Mirrored::new(symmetry.parse().expect("mirrors"), coefficients).expect("16 numbers")
}

#[test]
fn mirror_images_have_the_same_radius_and_mirrored_gradients() {
    let (directions, _) = cube_grid(5);
    for name in SYMMETRIES {
        let surface = body(name);
        for n in &directions {
            let folded = surface.symmetry().fold(n);
            let (radius, gradient) = surface.radius_and_gradient(n);
            let (image_radius, image) = surface.radius_and_gradient(&folded);
            assert_eq!(radius, image_radius);
            assert_eq!(radius, surface.radius(n));
            let mirrored = image.component_mul(&surface.symmetry().signs(n));
            assert_eq!(gradient, mirrored);
        }
    }
}

#[test]
fn the_radius_is_continuous_across_the_mirrors() {
    for name in SYMMETRIES {
        let surface = body(name);
        for n in [Vector3::new(0.6, 0.0, 0.8), Vector3::new(0.0, 0.28, -0.96)] {
            for step in [Vector3::x(), Vector3::y(), Vector3::z()].map(|axis| 1e-9 * axis) {
                let across =
                    [n - step, n + step].map(|n: Vector3<f64>| surface.radius(&n.normalize()));
                assert!((across[0] - across[1]).abs() < 1e-8);
            }
        }
    }
}

#[test]
fn derivatives_are_those_of_the_radius() {
    let (directions, _) = cube_grid(3);
    let h = 1e-5;
    for name in SYMMETRIES {
        let surface = body(name);
        for n in directions.iter().filter(|n| n.amin() > 1e-3) {
            let (radius, gradient) = surface.radius_and_gradient(n);
            let jet = surface.jet(n);
            assert!((jet.value - radius).abs() < 1e-14);
            let tangential = jet.gradient - n * jet.gradient.dot(n);
            assert!((tangential - gradient).norm() < 1e-13);
            let first = n.cross(&Vector3::new(0.3, 0.5, -0.7)).normalize();
            for tangent in [first, n.cross(&first)] {
                let at = |angle: f64| surface.radius(&(n * angle.cos() + tangent * angle.sin()));
                let slope = (at(h) - at(-h)) / (2.0 * h);
                assert!((gradient.dot(&tangent) - slope).abs() < 1e-8);
                let bend = (at(h) - 2.0 * radius + at(-h)) / (h * h);
                let along = tangent.dot(&(jet.hessian * tangent)) - jet.gradient.dot(n);
                assert!((along - bend).abs() < 1e-4, "{along} {bend}");
            }
        }
    }
}

#[test]
fn what_is_no_expansion_is_refused() {
    for coefficients in [vec![], vec![1.0; 3], vec![1.0, 0.0, f64::NAN, 0.0]] {
        assert!(Mirrored::new(Symmetry::OCTANT, coefficients).is_err());
    }
}

/// The body as a grain whose axes are none of the scan's.
fn grain(symmetry: &str) -> StarGrain {
    let frame = Frame {
        centre: Point3::new(7.0, -1.0, 0.5),
        axes: Rotation3::from_euler_angles(0.3, -0.8, 2.0).into_inner(),
    };
    StarGrain::new(frame, Family::Mirrored(body(symmetry))).expect("a grain")
}

#[test]
fn a_saved_grain_is_the_same_to_the_last_bit() {
    for name in SYMMETRIES {
        let grain = grain(name);
        let text = grain_to_json(&grain.clone().into());
        assert!(text.contains(&format!("\"symmetry\": \"{name}\"")));
        let loaded = grain_from_json(&text)
            .expect("a model")
            .star()
            .cloned()
            .expect("a radius");
        assert_eq!(loaded.frame(), grain.frame());
        assert_eq!(loaded.coefficients(), grain.coefficients());
        let symmetry = |grain: &StarGrain| grain.family().mirrored().map(Mirrored::symmetry);
        assert_eq!(symmetry(&loaded), symmetry(&grain));
        assert_eq!(grain_to_json(&loaded.into()), text);
    }
}

#[test]
fn a_broken_file_is_refused() {
    let spoilt = |name: &str, value: serde_json::Value| {
        let text = grain_to_json(&grain("xz").into());
        let mut file: serde_json::Value = serde_json::from_str(&text).expect("JSON");
        file[name] = value;
        let error = grain_from_json(&file.to_string()).expect_err("refused");
        error.to_string()
    };
    let numbers = serde_json::json!([1.0, 2.0, 3.0]);
    for (name, value, says) in [
        ("symmetry", "xx".into(), "axes normal to the mirror planes"),
        ("symmetry", 3.into(), "not a grainform model"),
        ("symmetry", serde_json::Value::Null, "it must hold either"),
        ("coefficients", numbers.clone(), "(L + 1)^2"),
        ("coefficients", serde_json::json!([]), "(L + 1)^2"),
        (
            "coefficients",
            serde_json::Value::Null,
            "it must hold either",
        ),
        (
            "segments",
            serde_json::json!([numbers]),
            "it must hold either",
        ),
        ("parts_per_angle", 1.into(), "it must hold either"),
        ("cells", serde_json::json!([]), "it must hold either"),
    ] {
        let error = spoilt(name, value);
        assert!(error.contains(says), "{name}: {error}");
    }
}

#[test]
fn a_grain_counts_its_one_expansion() {
    let grain = grain("xyz");
    assert_eq!((grain.segments(), grain.degree()), (1, 3));
    assert_eq!(grain.coefficient_count(), 16);
    assert_eq!(grain.coefficients_touched(), 16.0);
    assert_eq!(grain.seam_jump(), 0.0);
    assert!(grain.family().blended().is_none() && grain.family().segmented().is_none());
}

#[test]
fn a_grain_turns_the_surface_into_its_axes() {
    let grain = grain("yz");
    let surface = body("yz");
    let (directions, _) = cube_grid(4);
    let radii = grain.radii(&directions);
    for (n, many) in directions.iter().zip(radii) {
        let local = grain.frame().axes.tr_mul(n);
        let (radius, gradient) = surface.radius_and_gradient(&local);
        let derivatives = grain.derivatives(n);
        assert!((many - radius).abs() < 1e-14);
        assert!((derivatives.radius - radius).abs() < 1e-14);
        assert!((derivatives.gradient - grain.frame().axes * gradient).norm() < 1e-13);
        assert_eq!(grain.radius(n), many);
    }
}

#[test]
fn the_published_coefficients_rebuild_the_region() {
    for name in SYMMETRIES {
        let published = grain(name).published();
        let [expansion] = published.as_slice() else {
            panic!("one expansion");
        };
        let surface = body(name);
        assert_eq!(expansion.region, Region::Mirrored(surface.symmetry()));
        assert!(expansion.loss < 1e-12);
        for n in cube_grid(4).0 {
            let y = harmonics(3, &surface.symmetry().fold(&n));
            let terms = y.iter().zip(&expansion.coefficients);
            let sum: f64 = terms.map(|(y, a)| y * a).sum();
            assert!((sum - surface.radius(&n)).abs() < 1e-12);
        }
    }
}

#[test]
fn measures_are_those_of_a_fine_mesh_and_mirrors_are_principal() {
    for name in SYMMETRIES {
        let grain = grain(name);
        let found = grain_properties(&grain).properties;
        let mesh = grain.mesh(256);
        mesh.check_closed().expect("closed");
        let meshed = crate::measure::mesh_properties(&mesh).expect("a solid");
        // An inscribed polyhedron is too small by the square of its edges.
        assert!((meshed.area / found.area - 1.0).abs() < 3e-4);
        assert!((meshed.volume / found.volume - 1.0).abs() < 3e-4);
        assert!((meshed.centroid - found.centroid).norm() < 1e-3);
        let axes = grain.frame().axes;
        let local = axes.transpose() * found.inertia * axes;
        for axis in body(name).symmetry().normals() {
            for other in (0..3).filter(|&other| other != axis) {
                assert!(local[(axis, other)].abs() < 1e-12 * local.amax());
            }
        }
    }
}
