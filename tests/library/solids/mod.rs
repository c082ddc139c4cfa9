//! Bodies that are not star-shaped, open, hollow or several: each figure is right or is not told; and contacts of
//! superquadrics.

mod bodies;
mod contacts;
#[path = "../../../benches/pairs/mod.rs"]
mod pairs;

use bodies::{banana, cup, torus, u_shape};
use grainform::Mesh;
use grainform::measure::{
    FacesDefect, Survey, SurveyError, inscribed_ball, mesh_properties, scanned_body,
};
use grainform::scan::{Scan, parse_scan};
use nalgebra::{Point3, Vector3};
use std::f64::consts::PI;

/// Distance from a point to the nearest vertex or middle of an edge, and the share of the full sphere
/// that the mesh fills as seen from there.
fn seen(mesh: &Mesh, from: &Point3<f64>) -> f64 {
    let angles = mesh.triangles.iter().map(|corners| {
        let [a, b, c] = corners.map(|i| mesh.vertices[i as usize] - from);
        let [la, lb, lc] = [a, b, c].map(|v| v.norm());
        let across = la * lb * lc + a.dot(&b) * lc + b.dot(&c) * la + c.dot(&a) * lb;
        2.0 * a.dot(&b.cross(&c)).atan2(across)
    });
    angles.sum::<f64>() / (4.0 * PI)
}

#[test]
fn bodies_that_bend_hold_their_medial_ball() {
    let (wall, bottom): (f64, f64) = (1.0, 0.7);
    let corner = wall + bottom - (2.0 * wall * bottom).sqrt();
    for (name, mesh, exact, tolerance, same) in [
        ("torus", torus(3.0, 1.0, 200, 100), 1.0, 1e-3, 1e-9),
        ("thin torus", torus(10.0, 0.3, 400, 60), 0.3, 2e-3, 1e-9),
        ("banana", banana(6.0, 2.5, 1.2), 1.2, 2e-3, 1e-9),
        ("U", u_shape(3.0, 5.0, 0.8), 0.8, 1e-3, 1e-9),
        // It rests in the corner of bottom and wall and touches the edge inside. All around there is one for every facet,
        // and rounding decides between them.
        ("cup", cup(5.0, 8.0, wall, bottom), corner, 1e-4, 1e-5),
    ] {
        let solid = mesh_properties(&mesh).expect("a solid");
        assert!(solid.volume > 0.0, "{name}");
        let ball = inscribed_ball(&mesh).expect("a ball");
        let error = ball.radius / exact - 1.0;
        assert!(
            error.abs() < tolerance,
            "{name}: {} for {exact}",
            ball.radius
        );
        assert!((seen(&mesh, &ball.centre) - 1.0).abs() < 1e-9, "{name}");
        let nearest = mesh
            .vertices
            .iter()
            .map(|v| (v - ball.centre).norm())
            .fold(f64::MAX, f64::min);
        assert!(nearest >= ball.radius * (1.0 - 1e-12), "{name}");
        let survey = Survey::of_mesh(&mesh).expect("a solid");
        let inscribed = survey.inscribed().expect("a ball").radius;
        assert!((inscribed / ball.radius - 1.0).abs() < same, "{name}");
        let ratio = survey.sphericity().expect("spheres").inscribed_enclosing;
        assert!(ratio > 0.0 && ratio < 0.6, "{name}: {ratio}");
    }
}

/// The scan that an OBJ file of these meshes holds.
fn scan(meshes: &[&Mesh]) -> Scan {
    let mut text = String::new();
    let mut first = 1;
    for mesh in meshes {
        for v in &mesh.vertices {
            text += &format!("v {} {} {}\n", v.x, v.y, v.z);
        }
        for [a, b, c] in &mesh.triangles {
            text += &format!("f {} {} {}\n", a + first, b + first, c + first);
        }
        first += mesh.vertices.len() as u32;
    }
    parse_scan(text.as_bytes(), Some("obj")).expect("a scan")
}

fn sphere(radius: f64, at: f64) -> Mesh {
    let mut mesh = Mesh::radial(16, |_| radius);
    mesh.vertices.iter_mut().for_each(|vertex| vertex.x += at);
    mesh
}

fn inside_out(mut mesh: Mesh) -> Mesh {
    mesh.triangles
        .iter_mut()
        .for_each(|corners| corners.reverse());
    mesh
}

#[test]
fn a_torus_without_a_triangle_has_its_area_within_the_fill() {
    let whole = torus(3.0, 1.0, 48, 24);
    let truth = mesh_properties(&whole).expect("a solid");
    for missing in [0, 700, 1500] {
        let mut open = whole.clone();
        open.triangles.remove(missing);
        let found = scanned_body(&scan(&[&open])).expect("faces");
        let fill = found.fill.expect("a fill");
        assert_eq!((fill.holes, fill.edges, found.bodies), (1, 3, 1));
        let survey = Survey::of_scanned(&found);
        let properties = survey.properties().expect("a solid");
        assert!((properties.area - truth.area).abs() <= fill.area);
        assert!((properties.area / truth.area - 1.0).abs() < 1e-9);
        assert!((properties.volume / truth.volume - 1.0).abs() < 1e-9);
    }
}

#[test]
fn several_missing_triangles_side_by_side_are_one_hole() {
    let whole = Mesh::radial(24, |_| 1.0);
    let truth = mesh_properties(&whole).expect("a solid");
    let mut open = whole.clone();
    open.triangles.retain(|corners| !corners.contains(&100));
    let found = scanned_body(&scan(&[&open])).expect("faces");
    let fill = found.fill.expect("a fill");
    assert_eq!(fill.holes, 1);
    let properties = Survey::of_scanned(&found).properties().expect("a solid");
    assert!((properties.area - truth.area).abs() <= fill.area);
    assert!(properties.volume < truth.volume && properties.volume > truth.volume * 0.999);
}

#[test]
fn what_is_open_has_neither_area_nor_volume() {
    let mut half = Mesh::radial(16, |n| 1.0 + 0.2 * n.x);
    let vertices = half.vertices.clone();
    half.triangles
        .retain(|corners| corners.iter().all(|&i| vertices[i as usize].z > -0.3));
    let found = scanned_body(&scan(&[&half])).expect("faces");
    assert!(
        matches!(found.defect, Some(FacesDefect::Open { holes: 1, .. })),
        "{found:?}"
    );
    let survey = Survey::of_scanned(&found);
    assert!(matches!(survey.area(), Err(SurveyError::Faces(_))));
    assert!(survey.volume().is_err() && survey.dimensions().is_err());
    assert!(survey.inscribed().is_err() && survey.sphericity().is_err());
    assert!(survey.spectrum().is_err() && survey.projections().is_err());
    // What the faces that are there say by themselves.
    assert!((survey.enclosing().expect("a sphere").radius - 1.0).abs() < 0.1);
    assert!(survey.minimum_box().is_ok());
}

#[test]
fn a_hollow_sphere_is_its_shell() {
    let (outer, inner) = (sphere(2.0, 0.0), sphere(1.0, 0.1));
    let [large, small] = [&outer, &inner].map(|mesh| mesh_properties(mesh).expect("a solid"));
    let found = scanned_body(&scan(&[&outer, &inside_out(inner.clone())])).expect("faces");
    assert_eq!((found.bodies, found.cavities, found.defect), (1, 1, None));
    let survey = Survey::of_scanned(&found);
    let shell = survey.properties().expect("a solid");
    assert!((shell.volume / (large.volume - small.volume) - 1.0).abs() < 1e-9);
    assert!((shell.area / (large.area + small.area) - 1.0).abs() < 1e-9);
    // The largest ball is where the wall is thickest: between -2 and -0.9 along x.
    let ball = survey.inscribed().expect("a ball");
    assert!((ball.radius - 0.55).abs() < 5e-3, "{ball:?}");
    // Wound outwards both, they may be a hollow body or two scans of one.
    let doubled = scanned_body(&scan(&[&outer, &inner])).expect("faces");
    assert!(matches!(
        doubled.defect,
        Some(FacesDefect::Overlapping { parts: 2 })
    ));
    assert!(Survey::of_scanned(&doubled).volume().is_err());
}

#[test]
fn several_bodies_are_counted_and_added_and_have_no_form() {
    let (one, other) = (sphere(1.0, 0.0), sphere(2.0, 5.0));
    let [small, large] = [&one, &other].map(|mesh| mesh_properties(mesh).expect("a solid"));
    for second in [other.clone(), inside_out(other)] {
        let found = scanned_body(&scan(&[&one, &second])).expect("faces");
        assert_eq!((found.bodies, found.cavities, found.defect), (2, 0, None));
        let survey = Survey::of_scanned(&found);
        let sum = large.volume + small.volume;
        assert!((survey.volume().expect("a solid") / sum - 1.0).abs() < 1e-9);
        assert_eq!(survey.form(), Err(SurveyError::Several { bodies: 2 }));
        assert!(survey.inscribed().is_err() && survey.convexity().is_err());
    }
    // By a half, and by a hundredth of their length.
    for away in [1.0, 1.98] {
        let crossing = scanned_body(&scan(&[&one, &sphere(1.0, away)])).expect("faces");
        assert!(
            matches!(crossing.defect, Some(FacesDefect::Overlapping { parts: 2 })),
            "{away}"
        );
    }
}

#[test]
fn bodies_that_touch_are_two_and_their_sum() {
    let cube = Mesh::radial(2, |n| 0.5 / n.amax());
    let touching = [
        [1.0, 0.0, 0.0],
        [1.0, 1.0, 0.0],
        [1.0, 1.0, 1.0],
        [1.0, 0.5, 0.25],
    ];
    for aside in touching {
        let moved = |vertex: &Point3<f64>| vertex + Vector3::from(aside);
        let other = Mesh {
            vertices: cube.vertices.iter().map(moved).collect(),
            triangles: cube.triangles.clone(),
        };
        let scan = scan(&[&cube, &other]);
        let found = scanned_body(&scan).expect("faces");
        assert_eq!((found.bodies, found.defect), (2, None), "{aside:?}");
        assert_eq!(scan.topology().map(|topology| topology.bodies), Some(2));
        let volume = Survey::of_scanned(&found).volume().expect("a solid");
        assert!((volume - 2.0).abs() < 1e-12, "{volume}");
    }
}

#[test]
fn bodies_that_bend_have_no_star_shaped_figures() {
    let survey_of = |mesh: &Mesh| scanned_body(&scan(&[mesh])).expect("faces");
    for (name, mesh) in [
        ("torus", torus(3.0, 1.0, 60, 30)),
        ("U", u_shape(3.0, 5.0, 0.8)),
        ("cup", cup(5.0, 8.0, 1.0, 0.7)),
    ] {
        let found = survey_of(&mesh);
        let survey = Survey::of_scanned(&found);
        assert!(
            matches!(survey.angularity(), Err(SurveyError::NotStarShaped { .. })),
            "{name}"
        );
        assert!(survey.spectrum().is_err(), "{name}");
        // Seen along its axis, a torus has a hole.
        assert_eq!(survey.projections().is_err(), name == "torus", "{name}");
        let convexity = survey.convexity().expect("a hull").volume;
        assert!(convexity > 0.05 && convexity < 0.95, "{name}: {convexity}");
        let [length, width, thickness] = survey.dimensions().expect("a solid").into();
        assert!(length >= width && width >= thickness, "{name}");
    }
}

#[test]
fn any_unit_of_length_gives_the_same_figures() {
    let plain = torus(3.0, 1.0, 60, 30);
    let here = Survey::of_mesh(&plain).expect("a solid");
    for exponent in [-100, -80, 90, 99] {
        let size = 10_f64.powi(exponent);
        let mut scaled = plain.clone();
        scaled
            .vertices
            .iter_mut()
            .for_each(|vertex| *vertex *= size);
        let found = scanned_body(&scan(&[&scaled])).expect("faces");
        assert_eq!(found.defect, None);
        let survey = Survey::of_scanned(&found);
        let near = |found: f64, expected: f64| {
            assert!(
                (found / expected - 1.0).abs() < 1e-6,
                "{exponent}: {found:e} {expected:e}"
            );
        };
        let own = here.properties().expect("a solid");
        near(survey.area().expect("an area"), own.area * size * size);
        near(
            survey.volume().expect("a volume"),
            own.volume * size * size * size,
        );
        near(
            survey.inscribed().expect("a ball").radius,
            here.inscribed().expect("a ball").radius * size,
        );
        let sphericity = survey.sphericity().expect("spheres");
        near(
            sphericity.wadell,
            here.sphericity().expect("spheres").wadell,
        );
        near(
            survey.dimensions().expect("a solid").x,
            here.dimensions().expect("a solid").x * size,
        );
        // The fifth power of these is no number of 64 bits.
        assert_eq!(survey.inertia(), Err(SurveyError::OutOfRange));
        assert!(survey.principal().is_err());
    }
}
