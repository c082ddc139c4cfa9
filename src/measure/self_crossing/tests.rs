use super::*;
use crate::measure::crossings::all_crossings;
use crate::measure::mesh_properties;
use proptest::prelude::*;
use std::f64::consts::PI;

/// A body and its mirror image, so far along x, as one: a triangle on top of each is taken out, and the holes are joined by
/// a tube that rises from the one, turns, and comes down to the other.
fn twins(mut one: Mesh, apart: f64) -> Mesh {
    let rim = cut_top(&mut one);
    let ring = raised(&mut one, rim);
    let count = one.vertices.len() as u32;
    let mirrored = |vertex: &Point3<f64>| Point3::new(apart - vertex.x, vertex.y, vertex.z);
    let vertices: Vec<_> = one.vertices.iter().map(mirrored).collect();
    let turned = |&[a, b, c]: &[u32; 3]| [c, b, a].map(|corner| corner + count);
    let triangles: Vec<_> = one.triangles.iter().map(turned).collect();
    one.vertices.extend(vertices);
    one.triangles.extend(triangles);
    tube(&mut one, ring, ring.map(|corner| corner + count));
    one.check_closed().unwrap();
    one
}

/// Takes the topmost triangle out.
fn cut_top(mesh: &mut Mesh) -> [u32; 3] {
    let height = |corners: &[u32; 3]| -> f64 {
        let heights = corners.map(|corner| mesh.vertices[corner as usize].z);
        heights.into_iter().sum()
    };
    let heights = mesh.triangles.iter().map(height).enumerate();
    let (top, _) = heights.max_by(|a, b| a.1.total_cmp(&b.1)).unwrap();
    mesh.triangles.swap_remove(top)
}

/// The rim of a hole on top drawn out to a ring two above it, which looks along x.
fn raised(mesh: &mut Mesh, rim: [u32; 3]) -> [u32; 3] {
    let places = rim.map(|corner| mesh.vertices[corner as usize].coords);
    let middle = places.into_iter().sum::<Vector3<f64>>() / 3.0;
    let first = mesh.vertices.len() as u32;
    for place in places {
        let turned = Vector3::new(0.0, place.y - middle.y, middle.x - place.x);
        let ring = middle + turned + Vector3::z() * 2.0;
        mesh.vertices.push(Point3::from(ring));
    }
    let ring = [first, first + 1, first + 2];
    tube(mesh, rim, ring);
    ring
}

fn tube(mesh: &mut Mesh, from: [u32; 3], to: [u32; 3]) {
    for (at, next) in [(0, 1), (1, 2), (2, 0)] {
        mesh.triangles.push([from[at], from[next], to[next]]);
        mesh.triangles.push([from[at], to[next], to[at]]);
    }
}

fn balls(apart: f64) -> Mesh {
    twins(Mesh::radial(48, |_| 1.0), apart)
}

fn topmost(mesh: &Mesh) -> u32 {
    let heights = mesh.vertices.iter().map(|vertex| vertex.z).enumerate();
    let (top, _) = heights.max_by(|a, b| a.1.total_cmp(&b.1)).unwrap();
    top as u32
}

/// The lens that two balls have in common is counted twice, and its area is inside.
#[test]
fn what_two_ends_of_a_body_have_in_common_is_how_far_its_figures_are_off() {
    for apart in [1.5, 1.9, 1.99] {
        let mesh = balls(apart);
        let found = self_crossing(&mesh).unwrap();
        let whole = mesh_properties(&mesh).unwrap();
        let lens = PI * (4.0 + apart) * (2.0 - apart).powi(2) / 12.0;
        let caps = 4.0 * PI * (1.0 - apart / 2.0);
        let volume = found.volume * whole.volume / lens;
        let area = found.area * (whole.area - caps) / caps;
        // Above the truth by the triangles that cross.
        assert!((0.99..2.0).contains(&volume), "{apart}: {volume}");
        assert!((0.99..3.0).contains(&area), "{apart}: {area}");
        assert!(
            (found.place - Point3::new(apart / 2.0, 0.0, 0.0)).norm() < 0.1,
            "{found:?}"
        );
        assert_eq!(found.places, 1);
        assert_eq!(found.hides_volume(), apart == 1.5);
        assert_eq!(found.hides_area(), apart < 1.95);
    }
    assert_eq!(self_crossing(&balls(2.01)), None);
}

#[test]
fn a_body_that_touches_itself_in_a_face_is_sound() {
    for count in [2, 9] {
        let cube = Mesh::radial(count, |n| 1.0 / n.amax());
        assert_eq!(self_crossing(&twins(cube.clone(), 2.0)), None);
        let inside = self_crossing(&twins(cube, 1.5)).unwrap();
        assert!(inside.hides_volume(), "{inside:?}");
    }
}

/// A ball one side of which is mirrored, and so inside out: its volume is subtracted.
#[test]
fn a_lobe_that_is_inside_out_is_found_where_it_is() {
    let mut mesh = Mesh::radial(32, |_| 1.0);
    for vertex in &mut mesh.vertices {
        vertex.x *= vertex.z + 0.5;
    }
    let found = self_crossing(&mesh).unwrap();
    assert!(found.hides_volume() && found.hides_area(), "{found:?}");
    assert!(found.place.z < -0.5, "{found:?}");
    // Pinched to a vertex, nothing crosses.
    let mut lobes = balls(3.0);
    let ball = Mesh::radial(8, |_| 0.5);
    let (count, tip, top) = (lobes.vertices.len() as u32, topmost(&lobes), topmost(&ball));
    let from = lobes.vertices[tip as usize] + ball.vertices[top as usize].coords;
    let mirrored = |vertex: &Point3<f64>| from - vertex.coords;
    lobes.vertices.extend(ball.vertices.iter().map(mirrored));
    let own = |corner: u32| if corner == top { tip } else { corner + count };
    // Mirrored in its middle, a ball is inside out.
    lobes
        .triangles
        .extend(ball.triangles.iter().map(|corners| corners.map(own)));
    assert!(self_crossing(&lobes).unwrap().hides_volume());
}

#[test]
fn the_place_and_the_shares_are_those_of_any_size_and_either_sense() {
    let mesh = balls(1.5);
    let found = self_crossing(&mesh).unwrap();
    for (size, from) in [(1e-90, 0.0), (1e80, 0.0), (1.0, 1e6)] {
        let mut other = mesh.clone();
        for vertex in &mut other.vertices {
            *vertex = Point3::from(vertex.coords * size + Vector3::repeat(from));
        }
        other
            .triangles
            .iter_mut()
            .for_each(|corners| corners.reverse());
        let scaled = self_crossing(&other).unwrap();
        assert!((scaled.volume / found.volume - 1.0).abs() < 1e-6);
        let place = (scaled.place.coords - Vector3::repeat(from)) / size;
        assert!((place - found.place.coords).norm() < 1e-6);
    }
}

#[test]
fn it_is_told_in_a_sentence() {
    let crossing = SelfCrossing {
        place: Point3::new(1_234.567_89, -0.5, 1e-17),
        places: 3,
        area: 0.02,
        volume: 0.000_4,
    };
    assert_eq!(
        crossing.to_string(),
        "the surface goes through itself near (1234.57, -0.50, 0.00) and at 2 other places: its triangles have up to 2 % \
         too much area, and their volume is up to 0.040 % off"
    );
    let nothing = SelfCrossing {
        volume: f64::NAN,
        ..crossing
    };
    assert!(nothing.hides_volume() && nothing.to_string().ends_with("up to 100 % and more off"));
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]

    /// The screen loses no pair of triangles that cross.
    #[test]
    fn only_candidates_cross(
        moves in prop::collection::vec((0..218_usize, prop::array::uniform3(-1.0..1.0_f64)), 0..12),
    ) {
        let mut mesh = Mesh::radial(6, |n| 1.0 + 0.3 * n.x);
        for (vertex, aside) in moves {
            mesh.vertices[vertex] += Vector3::from(aside);
        }
        let (mesh, _, middle) = outwards(mesh);
        let near = candidates(&mesh, &middle).unwrap_or_default();
        for triangle in all_crossings(&mesh).into_flattened() {
            prop_assert!(near.contains(&triangle));
        }
    }
}
