use super::*;
use crate::measure::mesh_properties;
use crate::mesh::MeshDefect;
use crate::sphere::cube_grid;
use std::f64::consts::TAU;

fn mapped(mesh: &Mesh) -> Result<Vec<Vector3<f64>>, MapError> {
    let context = Context::default();
    SphericalMap::new(mesh, &context)?.whole(&context)
}

/// Asserts that a mesh has a map; [`SphericalMap`] certifies what it gives.
fn assert_mapped(name: &str, mesh: &Mesh) -> Vec<Vector3<f64>> {
    let found = mapped(mesh);
    let places = found.unwrap_or_else(|error| panic!("{name}: {error}"));
    assert_eq!(places.len(), mesh.vertices.len());
    assert!(places.iter().all(|n| (n.norm() - 1.0).abs() < 1e-12));
    places
}

fn refusal(mesh: &Mesh) -> MapError {
    mapped(mesh).expect_err("no map")
}

/// A ball of 1538 vertices, each moved.
fn moved(to: impl Fn(usize, Vector3<f64>) -> Vector3<f64>) -> Mesh {
    let (directions, triangles) = cube_grid(16);
    let vertices = directions.iter().enumerate();
    Mesh {
        vertices: vertices.map(|(i, n)| Point3::from(to(i, *n))).collect(),
        triangles,
    }
}

/// Something like a random vector.
fn arbitrary(i: usize) -> Vector3<f64> {
    let at = i as f64;
    [12.9, 78.2, 37.7]
        .map(|factor| (at * factor).sin() * 43758.5)
        .map(|x| x - x.floor() - 0.5)
        .into()
}

/// A tube round a ring.
fn torus() -> Mesh {
    let (long, short) = (24, 12);
    let vertex = |i: usize| {
        let (u, v) = (
            (i / short) as f64 / long as f64 * TAU,
            (i % short) as f64 / short as f64 * TAU,
        );
        Point3::new(
            (2.0 + v.cos()) * u.cos(),
            (2.0 + v.cos()) * u.sin(),
            v.sin(),
        )
    };
    let at = |i: usize, j: usize| (i % long * short + j % short) as u32;
    let cells = (0..long * short).map(|cell| (cell / short, cell % short));
    let triangles = cells.flat_map(|(i, j)| {
        let [a, b, c, d] = [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
        [[a, b, c], [a, c, d]]
    });
    Mesh {
        vertices: (0..long * short).map(vertex).collect(),
        triangles: triangles.collect(),
    }
}

#[test]
fn bodies_that_are_hard_to_map_have_a_map() {
    let stretched =
        |x, y, z| move |_: usize, n: Vector3<f64>| n.component_mul(&Vector3::new(x, y, z));
    assert_mapped("needle", &moved(stretched(1.0, 0.01, 0.01)));
    assert_mapped("plate", &moved(stretched(1.0, 1.0, 0.01)));
    assert_mapped("spike", &moved(|i, n| if i == 0 { n * 100.0 } else { n }));
    assert_mapped("noise", &moved(|i, _| arbitrary(i)));
    let sheared = |_, n: Vector3<f64>| Vector3::new(n.x, 1e-3 * n.y, n.z + 1e-6 * n.y);
    assert_mapped("slivers", &moved(sheared));
    let half = |_, n: Vector3<f64>| if n.z > 0.0 { Vector3::z() } else { n };
    assert_mapped("half the vertices coincide", &moved(half));
    let four = |i: usize, n: Vector3<f64>| {
        if i.is_multiple_of(400) {
            n
        } else {
            Vector3::zeros()
        }
    };
    assert_mapped("all vertices but four coincide", &moved(four));
    let tentacles = |_, n: Vector3<f64>| {
        let grown = |k| 8.0 * ((n.dot(&arbitrary(k).normalize()) - 1.0) / 0.002).exp();
        n * (1.0 + (0..20).map(grown).sum::<f64>())
    };
    assert_mapped("tentacles", &moved(tentacles));
}

#[test]
fn a_pole_of_many_neighbours_is_no_trouble() {
    let (count, rows) = (2000, 3);
    let ring = |row: usize| {
        let theta = std::f64::consts::PI * row as f64 / (rows + 1) as f64;
        let at = move |i: usize| (i as f64 / count as f64 * TAU).sin_cos();
        (0..count).map(move |i| {
            let (sin, cos) = at(i);
            Point3::new(theta.sin() * cos, theta.sin() * sin, theta.cos())
        })
    };
    let poles = [Point3::new(0.0, 0.0, 1.0), Point3::new(0.0, 0.0, -1.0)];
    let at = |row: usize, i: usize| (2 + (row - 1) * count + i % count) as u32;
    let mut triangles = Vec::new();
    for i in 0..count {
        triangles.push([0, at(1, i), at(1, i + 1)]);
        triangles.push([1, at(rows, i + 1), at(rows, i)]);
        for row in 1..rows {
            let [a, b] = [at(row, i), at(row, i + 1)];
            let [c, d] = [at(row + 1, i), at(row + 1, i + 1)];
            triangles.extend([[a, c, d], [a, d, b]]);
        }
    }
    let vertices = poles.into_iter().chain((1..=rows).flat_map(ring)).collect();
    assert_mapped(
        "pole",
        &Mesh {
            vertices,
            triangles,
        },
    );
}

#[test]
fn a_ball_is_mapped_to_its_directions_and_areas_are_kept_elsewhere() {
    let ball = moved(|_, n| n * 3.0 + Vector3::new(5.0, 0.0, 1.0));
    let (directions, _) = cube_grid(16);
    for (place, n) in assert_mapped("ball", &ball).iter().zip(directions) {
        assert!((place - n).norm() < 0.02, "{place} {n}");
    }
    // Where a conformal map shrinks the tips of a spindle to nothing, this one keeps half their area.
    let spindle = moved(|_, n| n.component_mul(&Vector3::new(1.0, 1.0, 10.0)));
    let places = assert_mapped("spindle", &spindle);
    let area = |[a, b, c]: [Vector3<f64>; 3]| (b - a).cross(&(c - a)).norm();
    let on_sphere = spindle
        .triangles
        .iter()
        .map(|t| area(t.map(|v| places[v as usize])));
    let on_surface = spindle
        .triangles
        .iter()
        .map(|t| area(t.map(|v| spindle.vertices[v as usize].coords)));
    let mean = 8.0 * std::f64::consts::PI / on_surface.clone().sum::<f64>();
    let is_far_off = |(image, own): &(f64, f64)| !(0.4..2.5).contains(&(image / own / mean));
    let far_off = on_sphere
        .zip(on_surface)
        .filter(is_far_off)
        .map(|(image, _)| image);
    assert!(far_off.sum::<f64>() < 0.01 * 8.0 * std::f64::consts::PI);
}

#[test]
fn what_is_no_ball_is_refused_with_the_reason() {
    assert_eq!(refusal(&torus()), MapError::Handles { genus: 1 });
    let ball = moved(|_, n| n);
    let mut open = ball.clone();
    open.triangles.pop();
    assert!(matches!(
        refusal(&open),
        MapError::NotClosed(MeshDefect::OpenEdge { .. })
    ));
    let mut wound = ball.clone();
    wound.triangles[7].swap(0, 1);
    assert!(matches!(
        refusal(&wound),
        MapError::NotClosed(MeshDefect::EdgeUsedTwice { .. })
    ));
    let mut unused = ball.clone();
    unused.vertices.push(Point3::origin());
    assert_eq!(refusal(&unused), MapError::UnusedVertex { vertex: 1538 });
    let mut named = ball.clone();
    named.triangles[3][1] = 9999;
    let unknown = MeshDefect::IndexOutOfRange { triangle: 3 };
    assert_eq!(refusal(&named), MapError::NotClosed(unknown));

    let second = |joint: Option<u32>| {
        let mut two = ball.clone();
        let shift = |v: u32| if Some(v) == joint { v } else { v + 1538 };
        two.triangles
            .extend(ball.triangles.iter().map(|t| t.map(shift)));
        two.vertices
            .extend(ball.vertices.iter().map(|v| v + Vector3::x() * 5.0));
        two
    };
    assert_eq!(
        refusal(&second(None)),
        MapError::SeveralBodies { bodies: 2 }
    );
    let mut joined = second(Some(1537));
    joined.vertices.pop();
    assert_eq!(refusal(&joined), MapError::PinchedVertex { vertex: 1537 });

    let flat = Mesh {
        vertices: vec![
            Point3::origin(),
            Point3::new(1.0, 0.0, 0.0),
            Point3::new(0.0, 1.0, 0.0),
        ],
        triangles: vec![[0, 1, 2], [0, 2, 1]],
    };
    assert_eq!(refusal(&flat), MapError::NoBody);
    assert_eq!(refusal(&moved(|_, _| Vector3::x())), MapError::NoBody);
    assert_eq!(
        refusal(&moved(|i, n| n * if i == 5 { f64::NAN } else { 1.0 })),
        MapError::NoBody
    );
    assert_eq!(refusal(&Mesh::default()), MapError::NoBody);
}

#[test]
fn collapses_are_undone_to_the_last_half_edge() {
    let ball = moved(|_, n| n);
    let mut half_edges = HalfEdges::new(&ball).unwrap();
    let points = scaled(&ball.vertices).unwrap();
    let removed = simplify(&mut half_edges, &points, &Context::default()).unwrap();
    assert_eq!(removed.len(), 1534);
    for &h in removed.iter().rev() {
        half_edges.split(h);
    }
    for (triangle, corners) in ball.triangles.iter().enumerate() {
        assert_eq!(half_edges.corners(triangle as u32), *corners);
    }
    for v in 0..1538 {
        assert_eq!(half_edges.around(v).count(), half_edges.valence(v));
    }
}

#[test]
fn some_vertices_are_mapped_first_and_the_others_between_them() {
    let spindle = moved(|_, n| n.component_mul(&Vector3::new(1.0, 1.0, 5.0)));
    let context = Context::default();
    let mut map = SphericalMap::new(&spindle, &context).unwrap();
    let coarse = map.coarse(300, &context).unwrap();
    assert_eq!(coarse.mesh.vertices.len(), 300);
    let properties = [&coarse.mesh, &spindle].map(|mesh| mesh_properties(mesh).unwrap());
    assert!(properties[0].volume > 0.95 * properties[1].volume);
    let turned = |n: &Vector3<f64>| Vector3::new(n.y, n.z, n.x);
    let given: Vec<_> = coarse.places.iter().map(turned).collect();
    let places = map.between(&given, &context).unwrap();
    let at = |point: &Point3<f64>| spindle.vertices.iter().position(|vertex| vertex == point);
    for (point, place) in coarse.mesh.vertices.iter().zip(&given) {
        assert_eq!(places[at(point).unwrap()], *place);
    }
    let finer = map.coarse(600, &context).unwrap();
    assert_eq!(finer.mesh.vertices.len(), 600);
    assert_eq!(map.whole(&context).unwrap().len(), 1538);
}
