//! What is written is read back as LAMMPS reads it.

use super::{files, remarks};
use crate::clump::Clump;
use crate::engines::{Deck, GrainMaterial, Kind};
use crate::measure::{Ball, superquadric_properties};
use crate::model::Superquadric;
use approx::assert_relative_eq;
use libm::tgamma;
use nalgebra::{Matrix3, Point3, Quaternion, UnitQuaternion, Vector3};

/// A deck of one kind, semi-axes in mm.
fn deck(semi_axes: [f64; 3], n1: f64, n2: f64) -> Deck {
    let shape = Superquadric::single(semi_axes, n1, n2).unwrap();
    let clump = Clump {
        spheres: vec![Ball {
            centre: Point3::origin(),
            radius: 1.0,
        }],
        grain: superquadric_properties(&shape).properties,
        rms: 0.1,
        volume_error: 0.0,
    };
    let kind = Kind::new("a", &clump, 1e-3, 1300.0).unwrap();
    let kind = kind.with_superquadric(&shape, 1e-3);
    Deck::column(vec![kind], 12, GrainMaterial::trial(1300.0), 7).unwrap()
}

/// The rows of a section, without ids.
fn section(deck: &Deck, name: &str) -> Vec<Vec<f64>> {
    let ([data, _], _) = files(deck).unwrap();
    let mut bytes = Vec::new();
    data.write(&mut bytes).unwrap();
    let text = String::from_utf8(bytes).unwrap();
    let (_, rows) = text.split_once(&format!("\n{name}\n\n")).unwrap();
    let rows = rows.lines().take_while(|line| !line.is_empty());
    let numbers = |line: &str| line.split(' ').map(|x| x.parse().unwrap()).collect();
    let rows: Vec<Vec<f64>> = rows.map(numbers).collect();
    assert!((1..).zip(&rows).all(|(id, row)| row[0] == f64::from(id)));
    rows.into_iter().map(|row| row[1..].to_vec()).collect()
}

/// Volume and principal moments per density, as LAMMPS makes them of a row (Jaklič, Leonardis and Solina 2000).
fn of_row(row: &[f64]) -> (f64, Vector3<f64>) {
    let [a, b, c] = [row[0], row[1], row[2]].map(|diameter| diameter / 2.0);
    let [e1, e2] = [row[7], row[8]].map(|n| 2.0 / n);
    let beta = |x: f64, y: f64| tgamma(x) * tgamma(y) / tgamma(x + y);
    let volume = 2.0 * a * b * c * e1 * e2;
    let volume = volume * beta(0.5 * e1 + 1.0, e1) * beta(0.5 * e2, 0.5 * e2);
    let across = beta(0.5 * e1, 1.0 + 2.0 * e1) * beta(0.5 * e2, 1.5 * e2) / 2.0;
    let along = beta(1.5 * e1, 1.0 + e1) * beta(0.5 * e2, 0.5 * e2);
    let share = volume / (beta(0.5 * e1, 1.0 + e1) * beta(0.5 * e2, 0.5 * e2));
    let [x, y, z] = [a * a * across, b * b * across, c * c * along].map(|m| m * share);
    (volume, Vector3::new(y + z, x + z, x + y))
}

fn turn(row: &[f64]) -> UnitQuaternion<f64> {
    UnitQuaternion::new_unchecked(Quaternion::new(row[3], row[4], row[5], row[6]))
}

#[test]
fn mass_centre_and_inertia_of_each_grain_are_those_of_its_kind() {
    // The long axis is y, and so no axis of the shape has the place that it has among the principal ones.
    let deck = deck([1.0, 3.0, 2.0], 2.5, 4.0);
    assert!(remarks(&deck).is_empty());
    let kind = &deck.kinds[0];
    let rows = section(&deck, "Atoms # ellipsoid");
    let shapes = section(&deck, "Ellipsoids");
    assert_eq!((rows.len(), shapes.len()), (17, 17));
    for ((row, shape), grain) in rows.iter().zip(&shapes).zip(&deck.grains) {
        assert_eq!(row[..2], [1.0, 1.0]);
        assert_eq!(Vector3::from_column_slice(&row[3..6]), grain.centre);
        let (volume, moments) = of_row(shape);
        assert_relative_eq!(row[2] * volume, kind.mass, max_relative = 1e-9);
        let turn = turn(shape).to_rotation_matrix();
        let inertia = turn * Matrix3::from_diagonal(&(moments * row[2])) * turn.transpose();
        let expected = kind.inertia(&grain.turn);
        assert_relative_eq!(inertia, expected, epsilon = 1e-9 * expected.norm());
        // As the clump lies: its long axis is the kind's first.
        let [one, other] = [turn * Vector3::y(), grain.turn * Vector3::x()];
        assert_relative_eq!(one.dot(&other).abs(), 1.0, epsilon = 1e-9);
    }
}

#[test]
fn exponents_below_two_are_raised_and_the_mass_stays() {
    let deck = deck([1.0, 3.0, 2.0], 1.4, 3.0);
    let [row, shape] =
        ["Atoms # ellipsoid", "Ellipsoids"].map(|name| section(&deck, name).remove(0));
    assert_eq!(shape[7..], [2.0, 3.0]);
    assert_relative_eq!(shape[1], 6e-3, max_relative = 1e-12);
    let (volume, _) = of_row(&shape);
    assert_relative_eq!(row[2] * volume, deck.kinds[0].mass, max_relative = 1e-9);
    let swelling = 100.0 * (volume * 1300.0 / deck.kinds[0].mass - 1.0);
    let expected = format!("raised to 2 for superellipsoids: {swelling:.2} % more volume");
    let remarks = remarks(&deck);
    assert!(
        swelling > 5.0 && remarks[0].contains(&expected),
        "{remarks:?}"
    );
}

#[test]
fn walls_end_where_the_box_does() {
    let deck = deck([1.0, 1.2, 1.1], 2.0, 2.0);
    let [width, depth] = deck.floor;
    let rows = section(&deck, "Atoms # ellipsoid");
    let shapes = section(&deck, "Ellipsoids");
    let walls: Vec<(Vector3<f64>, Superquadric)> = rows[12..]
        .iter()
        .zip(&shapes[12..])
        .map(|(row, shape)| {
            assert_eq!((row[0], turn(shape).angle()), (2.0, 0.0));
            let semi_axes = [0, 1, 2].map(|axis| shape[axis] / 2.0);
            let body = Superquadric::single(semi_axes, shape[7], shape[8]).unwrap();
            (Vector3::from_column_slice(&row[3..6]), body)
        })
        .collect();
    let is_in_a_wall = |place: Vector3<f64>| {
        let mut gauges = walls
            .iter()
            .map(|(centre, body)| body.gauge(&(place - centre)));
        gauges.any(|gauge| gauge < 1.0)
    };
    let sides = Vector3::new(width, depth, deck.height);
    let near = 1e-5 * width;
    for i in 0..=10 {
        for j in 0..=10 {
            let [s, t] = [i, j].map(|k| f64::from(k) / 10.0);
            for (axis, at) in [(2, 0.0), (0, 0.0), (0, 1.0), (1, 0.0), (1, 1.0)] {
                let place = |inwards: f64| {
                    let mut place = Vector3::repeat(2.0 * near);
                    let within = sides - 2.0 * place;
                    place[(axis + 1) % 3] += s * within[(axis + 1) % 3];
                    place[(axis + 2) % 3] += t * within[(axis + 2) % 3];
                    place[axis] = at * sides[axis] + (1.0 - 2.0 * at) * inwards;
                    place
                };
                assert!(is_in_a_wall(place(-near)) && !is_in_a_wall(place(near)));
            }
        }
    }
}

#[test]
fn other_grains_and_round_walls_are_left_to_clumps() {
    let deck = deck([1.0; 3], 2.0, 2.0);
    let round = Deck {
        cylinder: Some(0.01),
        ..deck.clone()
    };
    assert!(files(&deck).is_some() && files(&round).is_none());
    let mut mixed = deck;
    mixed.kinds.push(Kind {
        superquadric: None,
        doubts: Vec::new(),
        ..mixed.kinds[0].clone()
    });
    assert!(files(&mixed).is_none() && remarks(&mixed).is_empty());
}
