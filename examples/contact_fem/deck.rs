//! The input deck of CalculiX, and its run.
//!
//! C3D8I is a brick with eight nodes and incompatible modes, so that it bends without locking.

use crate::mesh::Mesh;
use std::fmt::{Error, Write as _};
use std::path::Path;
use std::process::Command;
use std::{fs, io};

/// Name of the files of one run, without their endings.
const JOB: &str = "octant";

/// Poisson's ratio of the body.
pub(crate) const POISSONS_RATIO: f64 = 0.3;

/// A deck: the octant of effective modulus E / (1 - nu²) = 1, held on its planes of symmetry, with
/// `pressed` nodes displaced along the mesh's axis. The rest of its surface is free of forces, and so
/// are the pressed nodes in the two other directions. Displacements along the axis and the forces of
/// `watched` nodes are printed.
pub(crate) fn text(
    mesh: &Mesh,
    pressed: &[(usize, f64)],
    watched: &[usize],
) -> Result<String, Error> {
    let mut deck = String::from("*NODE\n");
    for (i, node) in (1..).zip(&mesh.nodes) {
        writeln!(
            deck,
            "{i}, {:.12e}, {:.12e}, {:.12e}",
            node.x, node.y, node.z
        )?;
    }
    writeln!(deck, "*ELEMENT, TYPE=C3D8I, ELSET=BODY")?;
    for (i, brick) in (1..).zip(&mesh.bricks) {
        let corners = brick.map(|node| (node + 1).to_string());
        writeln!(deck, "{i}, {}", corners.join(", "))?;
    }
    writeln!(deck, "*NSET, NSET=WATCHED")?;
    for node in watched {
        writeln!(deck, "{},", node + 1)?;
    }
    let youngs_modulus = 1.0 - POISSONS_RATIO * POISSONS_RATIO;
    writeln!(deck, "*MATERIAL, NAME=ELASTIC\n*ELASTIC")?;
    writeln!(deck, "{youngs_modulus:.12e}, {POISSONS_RATIO}")?;
    writeln!(deck, "*SOLID SECTION, ELSET=BODY, MATERIAL=ELASTIC")?;
    writeln!(deck, "*BOUNDARY")?;
    for (direction, nodes) in (1..).zip(&mesh.held) {
        for node in nodes {
            writeln!(deck, "{}, {direction}", node + 1)?;
        }
    }
    writeln!(deck, "*STEP\n*STATIC\n*BOUNDARY")?;
    let direction = mesh.axis + 1;
    for (node, displacement) in pressed {
        writeln!(
            deck,
            "{}, {direction}, {direction}, {displacement:.12e}",
            node + 1
        )?;
    }
    writeln!(deck, "*NODE PRINT, NSET=WATCHED\nU, RF\n*END STEP")?;
    Ok(deck)
}

/// Whether CalculiX is in the path.
pub(crate) fn is_solver_there() -> bool {
    Command::new("ccx").arg("-v").output().is_ok()
}

/// Writes a deck into a folder, which is made where it is not there.
pub(crate) fn write(deck: &str, folder: &Path) -> io::Result<()> {
    fs::create_dir_all(folder)?;
    fs::write(folder.join(JOB).with_extension("inp"), deck)
}

/// Has CalculiX solve the deck in a folder, and gives back what it printed.
pub(crate) fn solve(folder: &Path) -> io::Result<String> {
    let printed = folder.join(JOB).with_extension("dat");
    match fs::remove_file(&printed) {
        Err(error) if error.kind() != io::ErrorKind::NotFound => return Err(error),
        _ => {}
    }
    let output = Command::new("ccx").arg(JOB).current_dir(folder).output()?;
    match fs::read_to_string(printed) {
        Ok(text) if output.status.success() => Ok(text),
        _ => Err(io::Error::other(format!(
            "ccx did not solve the deck:\n{}",
            String::from_utf8_lossy(&output.stdout)
        ))),
    }
}
