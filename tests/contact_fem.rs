//! The finite elements of the example `contact_fem`.

#[path = "../examples/contact_fem/answer.rs"]
mod answer;
#[path = "../examples/contact_fem/deck.rs"]
mod deck;
#[path = "../examples/contact_fem/mesh.rs"]
mod mesh;
#[path = "../examples/contact_fem/press.rs"]
mod press;

use answer::Answer;
use approx::assert_relative_eq;
use grainform::shapes::Ellipsoid;
use mesh::Mesh;
use nalgebra::{Matrix3, RowVector3, Vector3};
use press::Contact;
use std::f64::consts::PI;

/// The octant of a sphere of radius 1 whose bricks are small within a tenth of it.
fn ball(axis: usize, count: usize) -> Mesh {
    let semi_axes = Vector3::repeat(1.0);
    Mesh::new(&Ellipsoid { semi_axes }, axis, [0.1; 3], count)
}

/// Jacobian determinants of a brick at its eight Gauss points, the corners' order being that of C3D8.
fn determinants(corners: [Vector3<f64>; 8]) -> Vec<f64> {
    const SIGNS: [[f64; 3]; 8] = [
        [-1.0, -1.0, -1.0],
        [1.0, -1.0, -1.0],
        [1.0, 1.0, -1.0],
        [-1.0, 1.0, -1.0],
        [-1.0, -1.0, 1.0],
        [1.0, -1.0, 1.0],
        [1.0, 1.0, 1.0],
        [-1.0, 1.0, 1.0],
    ];
    let at = |point: [f64; 3]| {
        let mut jacobian = Matrix3::zeros();
        for (corner, sign) in corners.iter().zip(SIGNS) {
            let factor = |i: usize| 1.0 + sign[i] * point[i];
            let slopes =
                [0, 1, 2].map(|i| sign[i] * factor((i + 1) % 3) * factor((i + 2) % 3) / 8.0);
            jacobian += corner * RowVector3::from(slopes);
        }
        jacobian.determinant()
    };
    SIGNS
        .map(|sign| at(sign.map(|sign| sign / 3.0_f64.sqrt())))
        .to_vec()
}

#[test]
fn the_bricks_stand_upright_and_fill_the_octant() {
    for axis in 0..3 {
        let mesh = ball(axis, 16);
        let bricks = mesh.bricks.iter();
        let found: Vec<f64> = bricks
            .flat_map(|brick| determinants(brick.map(|node| mesh.nodes[node])))
            .collect();
        assert!(found.iter().all(|determinant| *determinant > 0.0));
        assert_relative_eq!(found.iter().sum::<f64>(), PI / 6.0, max_relative = 1e-2);
    }
}

#[test]
fn what_is_held_lies_on_the_planes_of_symmetry_and_the_face_on_the_surface() {
    let mesh = ball(1, 6);
    for (axis, held) in mesh.held.iter().enumerate() {
        let on_the_plane = mesh.nodes.iter().filter(|node| node[axis] == 0.0).count();
        assert_eq!(held.len(), on_the_plane);
        assert!(held.iter().all(|&node| mesh.nodes[node][axis] == 0.0));
    }
    for &node in &mesh.face {
        assert_relative_eq!(mesh.nodes[node].norm(), 1.0, max_relative = 1e-14);
    }
    let cut = mesh.cut_off(0.02);
    let deepest = cut.iter().map(|(_, depth)| *depth).fold(0.0, f64::max);
    assert_relative_eq!(deepest, 0.02, max_relative = 1e-12);
}

const PRINTED: &str = "
 displacements (vx,vy,vz) for set WATCHED and time  0.1000000E+01

       649 -2.000000E-02  0.000000E+00  0.000000E+00
       650 -1.895936E-02  0.000000E+00 -7.954568E-04

 forces (fx,fy,fz) for set WATCHED and time  0.1000000E+01

       649 -3.840661E-05  2.002165E-05  3.264063E-05
       650 -7.708046E-05  4.020125E-05 -3.176374E-20
";

#[test]
fn displacements_and_forces_are_told_apart() {
    let answer = Answer::read(PRINTED, &[648, 649]).unwrap();
    assert_eq!(answer.displacements[1], [-1.895936e-2, 0.0, -7.954568e-4]);
    assert_eq!(answer.forces[0], [-3.840661e-5, 2.002165e-5, 3.264063e-5]);
}

#[test]
fn an_answer_that_is_cut_short_or_not_of_numbers_is_refused() {
    let half = PRINTED.split(" forces").next().unwrap();
    for printed in [
        "",
        half,
        &PRINTED.replace("650", "651"),
        &PRINTED.replace("-7.708046E-05", "*************"),
    ] {
        assert!(Answer::read(printed, &[648, 649]).is_err());
    }
}

/// The force that takes a sphere of radius 1 between two planes, pressed in by `indentation` each, by
/// Tatara (1991): Hertz, less what the sphere's middle moves in the field of both forces,
///
/// ```text
/// u = u_Hertz - F/(pi E) (2 (1 + nu) R² / (a² + 4 R²)^(3/2) + (1 - nu²) / (a² + 4 R²)^(1/2))
/// ```
///
/// with a the radius of the patch, E / (1 - nu²) = 1.
fn tatara(indentation: f64) -> f64 {
    let nu = deck::POISSONS_RATIO;
    let (mut force, mut hertz) = (0.0, indentation);
    for _ in 0..50 {
        let square: f64 = hertz + 4.0;
        let field = 2.0 * (1.0 + nu) / square.powf(1.5) + (1.0 - nu * nu) / square.sqrt();
        hertz = indentation + force * field / (PI * (1.0 - nu * nu));
        force = 4.0 / 3.0 * hertz.powf(1.5);
    }
    force
}

#[test]
#[ignore = "needs CalculiX (ccx) in the path"]
fn a_sphere_between_two_planes_takes_the_force_of_tatara() {
    assert!(deck::is_solver_there());
    let folder = tempfile::tempdir().unwrap();
    let mesh = ball(2, 12);
    let pressed = Contact::new(&mesh, 0.01).solve(folder.path()).unwrap();
    assert!(pressed.touching > 20);
    // 5.8 % more than by Hertz.
    assert_relative_eq!(pressed.force, tatara(0.01), max_relative = 5e-3);
}
