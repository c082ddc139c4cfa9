//! The data file: grains, and the five bodies that hold them.

use crate::engines::deck::{Deck, Placed};
use crate::engines::file::row;
use crate::engines::superellipsoid::Superellipsoid;
use nalgebra::{UnitQuaternion, Vector3};
use std::io::{self, Write};

/// Semi-axes of a wall along it, in sides of the box. So long that it is flat to 2e-7 of a side where grains touch it.
const LONG: f64 = 3.0;

/// Its exponents. Of thinner or sharper walls the search of LAMMPS, as its source has it, misses contacts; of these it found
/// each of ten thousand, of grains of many shapes in boxes of 6 to 300 of their radii.
const EXPONENT: f64 = 8.0;

/// Types are the kinds, the last that of the walls. Mass and inertia are for LAMMPS to make from density and shape.
pub(super) fn data(deck: &Deck, bodies: &[Superellipsoid], file: &mut dyn Write) -> io::Result<()> {
    let walls = walls(deck, bodies.len());
    let count = deck.grains.len() + walls.len();
    let types = bodies.len() + 1;
    write!(
        file,
        "# superellipsoids by grainform, SI units\n\n{count} atoms\n{count} ellipsoids\n{types} atom types\n"
    )?;
    // The centres of the walls lie inside too.
    let margin = 2.0 * thickness(deck);
    for (side, axis) in sides(deck).into_iter().zip(["x", "y", "z"]) {
        writeln!(file, "{:e} {:e} {axis}lo {axis}hi", -margin, side + margin)?;
    }
    let rows = || {
        let grains = deck.grains.iter();
        let grains = grains.map(|grain| (*grain, bodies[grain.kind]));
        (1..).zip(grains.chain(walls))
    };
    writeln!(file, "\nAtoms # ellipsoid\n")?;
    for (id, (placed, body)) in rows() {
        let numbers = [body.density]
            .into_iter()
            .chain(placed.centre.iter().copied());
        writeln!(file, "{id} {} 1 {}", placed.kind + 1, row(numbers))?;
    }
    writeln!(file, "\nEllipsoids\n")?;
    for (id, (placed, body)) in rows() {
        let turn = placed.turn * body.turn;
        let diameters = body.semi_axes.map(|axis| 2.0 * axis).into_iter();
        let numbers = diameters
            .chain([turn.w, turn.i, turn.j, turn.k])
            .chain(body.exponents);
        writeln!(file, "{id} {}", row(numbers))?;
    }
    writeln!(file, "\nVelocities\n")?;
    for (id, (placed, _)) in rows() {
        writeln!(file, "{id} {} 0 0 0", row(placed.velocity.iter().copied()))?;
    }
    Ok(())
}

/// The sides of the box that holds the grains at the start.
fn sides(deck: &Deck) -> [f64; 3] {
    let [width, depth] = deck.floor;
    [width, depth, deck.height]
}

/// A semi-axis of a wall across it, in metres: as wide as the box.
fn thickness(deck: &Deck) -> f64 {
    deck.floor[0].max(deck.floor[1])
}

/// The floor and the walls on either side, of a type of their own.
fn walls(deck: &Deck, kind: usize) -> [(Placed, Superellipsoid); 5] {
    let sides = Vector3::from(sides(deck));
    [(2, 0.0), (0, 0.0), (0, 1.0), (1, 0.0), (1, 1.0)].map(|(axis, at)| {
        let (mut centre, mut semi_axes) = (0.5 * sides, LONG * sides);
        semi_axes[axis] = thickness(deck);
        centre[axis] = at * sides[axis] + (2.0 * at - 1.0) * semi_axes[axis];
        let placed = Placed {
            kind,
            centre,
            turn: UnitQuaternion::identity(),
            velocity: Vector3::zeros(),
        };
        let body = Superellipsoid {
            semi_axes: semi_axes.into(),
            exponents: [EXPONENT; 2],
            turn: UnitQuaternion::identity(),
            density: deck.material.density,
            swelling: 0.0,
        };
        (placed, body)
    })
}
