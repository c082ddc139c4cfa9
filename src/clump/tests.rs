use super::gap::root_mean_square;
use super::*;
use crate::measure::{even_places, mesh_properties};
use approx::assert_relative_eq;
use nalgebra::{Point3, Rotation3, Vector3};

/// Balls that overlap along x, as seen from the origin, in which all of them are.
const BALLS: [(f64, f64); 2] = [(-0.7, 1.0), (0.6, 0.8)];

fn body() -> Mesh {
    Mesh::radial(40, |n| {
        let exit = |(x, radius): (f64, f64)| {
            let square = radius * radius - x * x * (1.0 - n.x * n.x);
            x * n.x + square.max(0.0).sqrt()
        };
        BALLS.map(exit).into_iter().fold(0.0, f64::max)
    })
}

fn found(mesh: &Mesh, target: ClumpTarget) -> Clump {
    clump(mesh, &mesh_properties(mesh).unwrap(), target).unwrap()
}

#[test]
fn the_balls_that_a_body_is_made_of_are_found() {
    let mesh = body();
    let mut spheres = found(&mesh, ClumpTarget::Spheres(2)).spheres;
    spheres.sort_by(|one, other| one.centre.x.total_cmp(&other.centre.x));
    assert_eq!(spheres.len(), 2);
    for (ball, (x, radius)) in spheres.iter().zip(BALLS) {
        assert_relative_eq!(ball.centre, Point3::new(x, 0.0, 0.0), epsilon = 5e-3);
        assert_relative_eq!(ball.radius, radius, max_relative = 5e-3);
    }
    let fewest = found(&mesh, ClumpTarget::Error(0.01));
    assert_eq!(fewest.spheres.len(), 2);
    assert!(fewest.rms < 0.01 * fewest.equivalent_radius());
}

/// An ellipsoid.
fn ellipsoid(semi_axes: [f64; 3]) -> Mesh {
    let mut mesh = Mesh::radial(32, |_| 1.0);
    for vertex in &mut mesh.vertices {
        vertex
            .coords
            .component_mul_assign(&Vector3::from(semi_axes));
    }
    mesh
}

/// The fit of a sphere sees no harm in leaving through a tip, beyond which there is no surface.
#[test]
fn spheres_stay_in_a_tetrahedron() {
    let corners = [
        [1.0, 1.0, 1.0],
        [1.0, -1.0, -1.0],
        [-1.0, 1.0, -1.0],
        [-1.0, -1.0, 1.0],
    ];
    let mesh = Mesh {
        vertices: corners.map(Point3::from).to_vec(),
        triangles: vec![[0, 1, 2], [0, 3, 1], [0, 2, 3], [1, 3, 2]],
    };
    for (count, error) in [(5, 0.35), (20, 0.15), (40, 0.1)] {
        let clump = found(&mesh, ClumpTarget::Spheres(count));
        assert!(clump.rms < error * clump.equivalent_radius(), "{count}");
        for ball in &clump.spheres {
            // The faces are x + y - z = 1 and the like.
            let [x, y, z] = ball.centre.coords.into();
            let beyond = [x + y - z, x - y + z, -x + y + z, -x - y - z];
            assert!(
                beyond.iter().all(|height| *height < 1.0),
                "{count} {ball:?}"
            );
        }
    }
}

#[test]
fn needles_and_plates_have_more_spheres_and_less_error_the_more_are_asked_for() {
    for semi_axes in [[50.0, 1.0, 1.0], [20.0, 1.0, 1.0], [20.0, 20.0, 1.0]] {
        let mesh = ellipsoid(semi_axes);
        let mut last = f64::INFINITY;
        for count in [3, 10, 30, 100] {
            let clump = found(&mesh, ClumpTarget::Spheres(count));
            assert!(clump.spheres.len() > count / 2, "{semi_axes:?} {count}");
            assert!(clump.rms < 0.75 * last, "{semi_axes:?} {count}");
            assert!(clump.volume_error.abs() < 1e-4, "{semi_axes:?} {count}");
            last = clump.rms;
        }
        assert!(last < 0.15 * equivalent_radius(mesh_properties(&mesh).unwrap().volume));
    }
}

#[test]
fn the_error_told_is_that_of_places_that_were_not_fitted() {
    let bumps = |n: &Vector3<f64>| {
        1.0 + 0.1 * (7.0 * n.x).sin() * (6.0 * n.y).cos() + 0.1 * (8.0 * n.z).sin()
    };
    let mesh = Mesh::radial(64, bumps);
    let clump = found(&mesh, ClumpTarget::Spheres(200));
    let elsewhere = root_mean_square(&even_places(&mesh, 40_013), &clump.spheres);
    assert_relative_eq!(clump.rms, elsewhere, max_relative = 0.03);
}

#[test]
fn a_ball_is_one_sphere_however_many_are_asked_for() {
    let mesh = Mesh::radial(24, |_| 1.0);
    for count in [1, 10, 30] {
        assert_eq!(found(&mesh, ClumpTarget::Spheres(count)).spheres.len(), 1);
    }
}

#[test]
fn neither_place_nor_turn_nor_unit_nor_order_matter() {
    let mesh = Mesh::radial(24, |n| 1.0 + 0.3 * n.x + 0.2 * n.y * n.z - 0.1 * n.x * n.z);
    let one = found(&mesh, ClumpTarget::Spheres(6));
    let turn = Rotation3::from_euler_angles(0.3, -1.1, 2.0);
    let place = |p: &Point3<f64>| turn * p * 1e-3 + Vector3::new(0.05, -0.02, 0.03);
    let mut triangles = mesh.triangles.clone();
    triangles.reverse();
    let moved = Mesh {
        vertices: mesh.vertices.iter().map(place).collect(),
        triangles,
    };
    let other = found(&moved, ClumpTarget::Spheres(6));
    assert_eq!(one.spheres.len(), other.spheres.len());
    for (ball, other) in one.spheres.iter().zip(&other.spheres) {
        assert_relative_eq!(other.centre, place(&ball.centre), epsilon = 1e-6);
        assert_relative_eq!(other.radius, 1e-3 * ball.radius, max_relative = 1e-3);
    }
}

#[test]
fn what_encloses_nothing_has_no_clump() {
    let mesh = body();
    let grain = mesh_properties(&mesh).unwrap();
    let target = ClumpTarget::Spheres(3);
    assert_eq!(
        clump(&Mesh::default(), &grain, target),
        Err(ClumpError::NoInside)
    );
    let nothing = MassProperties {
        volume: f64::NAN,
        ..grain
    };
    assert_eq!(clump(&mesh, &nothing, target), Err(ClumpError::NoInside));
    let mut broken = mesh;
    broken.triangles[4][1] = u32::MAX;
    assert_eq!(
        clump(&broken, &grain, target),
        Err(ClumpError::MissingVertex { triangle: 4 })
    );
}

/// A corner of a cube cut off, three of its edges being 1, 1 and `height`.
fn corner(height: f64) -> Mesh {
    let corners = [
        [0.0, 0.0, 0.0],
        [1.0, 0.0, 0.0],
        [0.0, 1.0, 0.0],
        [0.0, 0.0, height],
    ];
    Mesh {
        vertices: corners.map(Point3::from).to_vec(),
        triangles: vec![[0, 2, 1], [0, 1, 3], [1, 2, 3], [0, 3, 2]],
    }
}

#[test]
fn what_is_open_flat_or_wound_inwards_has_no_clump() {
    let whole = corner(1.0);
    let grain = mesh_properties(&whole).unwrap();
    let refused = |mesh: &Mesh, grain: &MassProperties| {
        let found = clump(mesh, grain, ClumpTarget::Error(0.2));
        assert_eq!(found, Err(ClumpError::NoInside), "{mesh:?}");
    };
    let inwards = whole.triangles.iter().map(|[a, b, c]| [*a, *c, *b]);
    let open = &whole.triangles[..3];
    for triangles in [open[..1].to_vec(), open.to_vec(), inwards.collect()] {
        let vertices = whole.vertices.clone();
        let mesh = Mesh {
            vertices,
            triangles,
        };
        refused(&mesh, &grain);
    }
    for height in [0.0, 1e-300, 1e-16, 1e-6, 1e17] {
        refused(&corner(height), &grain);
        if let Ok(own) = mesh_properties(&corner(height)) {
            refused(&corner(height), &own);
        }
    }
}

#[test]
fn a_mesh_that_is_not_of_the_grain_has_no_clump() {
    let mesh = body();
    let grain = mesh_properties(&mesh).unwrap();
    let other = MassProperties {
        volume: 1e150,
        ..grain
    };
    let mut far = mesh.clone();
    far.vertices[7].x = 1e150;
    for (mesh, grain) in [(&mesh, other), (&far, grain)] {
        let found = clump(mesh, &grain, ClumpTarget::Spheres(3));
        let is_refused = matches!(found, Err(ClumpError::NoInside | ClumpError::Volume { .. }));
        assert!(is_refused, "{found:?}");
    }
}

#[test]
fn spheres_that_cannot_have_the_volume_of_the_grain_are_no_clump() {
    let mesh = body();
    let grain = mesh_properties(&mesh).unwrap();
    // A volume that is not that of the surface.
    let other = MassProperties {
        volume: 1e-4 * grain.volume,
        ..grain
    };
    let found = clump(&mesh, &other, ClumpTarget::Spheres(3));
    assert!(matches!(found, Err(ClumpError::Volume { .. })), "{found:?}");
}
