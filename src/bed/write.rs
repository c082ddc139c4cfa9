//! A bed in the formats of OVITO and ParaView.

use super::paint::painted;
use super::settle::Bed;
use crate::export::WriteError;
use nalgebra::{Rotation3, UnitQuaternion};
use std::io::Write;

/// Cells along an edge of the cube of directions of a grain.
const RESOLUTION: usize = 6;

/// Writes all parts of the grains as a frame of a LAMMPS dump, lengths divided by `unit` metres: a row for each part,
/// `mol` being its grain, shapes as diameters, quaternions as LAMMPS has them. OVITO draws ellipsoids of these, and
/// superquadrics once the last two columns, 2/n2 and 2/n1 of the positive sides, are mapped to its roundness.
///
/// # Errors
/// [`WriteError::Io`].
pub fn write_dump(bed: &Bed, unit: f64, writer: &mut dyn Write) -> Result<(), WriteError> {
    let rows = bed.bodies().iter();
    let rows: usize = rows.map(|body| bed.kinds()[body.kind].parts.len()).sum();
    let [low, high] = bed.extent().map(|corner| corner / unit);
    writeln!(
        writer,
        "ITEM: TIMESTEP\n{}\nITEM: NUMBER OF ATOMS\n{rows}",
        bed.steps()
    )?;
    writeln!(writer, "ITEM: BOX BOUNDS ff ff ff")?;
    for axis in 0..3 {
        writeln!(writer, "{:.9e} {:.9e}", low[axis], high[axis])?;
    }
    writeln!(
        writer,
        "ITEM: ATOMS id type mol x y z vx vy vz quati quatj quatk quatw shapex shapey shapez phi theta"
    )?;
    let mut id = 0;
    for (number, body) in bed.bodies().iter().enumerate() {
        let kind = &bed.kinds()[body.kind];
        let frames = kind.placed(body.position, body.axes()).zip(&kind.parts);
        for (frame, part) in frames {
            id += 1;
            let turn =
                UnitQuaternion::from_rotation_matrix(&Rotation3::from_matrix_unchecked(frame.axes));
            let shape = &part.part.shape;
            let middle = shape.semi_axes().map(|[more, less]| 0.5 * (more - less));
            let centre = frame.to_scan(&middle.into()) / unit;
            let diameters = shape.semi_axes().map(|[more, less]| (more + less) / unit);
            let velocity = body.velocity / unit;
            write!(writer, "{id} {} {}", body.kind + 1, number + 1)?;
            let numbers = [
                centre.x, centre.y, centre.z, velocity.x, velocity.y, velocity.z,
            ];
            let turn = [turn.i, turn.j, turn.k, turn.w];
            let round = [2.0 / shape.n2()[0][0], 2.0 / shape.n1()[0]];
            for value in numbers.iter().chain(&turn).chain(&diameters).chain(&round) {
                write!(writer, " {value:.9e}")?;
            }
            writeln!(writer)?;
        }
    }
    Ok(())
}

/// Writes the grains as polygons of a legacy VTK file, lengths divided by `unit` metres, each triangle with the number
/// of its grain and its colour.
///
/// # Errors
/// [`WriteError`].
pub fn write_vtk(bed: &Bed, unit: f64, writer: &mut dyn Write) -> Result<(), WriteError> {
    let grains: Vec<_> = painted(bed, RESOLUTION).collect();
    let vertices: usize = grains.iter().map(|grain| grain.mesh.vertices.len()).sum();
    let triangles: usize = grains.iter().map(|grain| grain.mesh.triangles.len()).sum();
    // The format counts in 32 bits with a sign.
    if i32::try_from(4 * triangles).is_err() {
        return Err(WriteError::TooMany {
            what: "triangles",
            count: triangles,
        });
    }
    writeln!(
        writer,
        "# vtk DataFile Version 3.0\ngrainform bed\nBINARY\nDATASET POLYDATA\nPOINTS {vertices} float"
    )?;
    for vertex in grains.iter().flat_map(|grain| &grain.mesh.vertices) {
        for axis in 0..3 {
            writer.write_all(&((vertex[axis] / unit) as f32).to_be_bytes())?;
        }
    }
    writeln!(writer, "\nPOLYGONS {triangles} {}", 4 * triangles)?;
    let mut first = 0;
    for grain in &grains {
        for corners in &grain.mesh.triangles {
            writer.write_all(&3_u32.to_be_bytes())?;
            for corner in corners {
                writer.write_all(&(first + corner).to_be_bytes())?;
            }
        }
        first += grain.mesh.vertices.len() as u32;
    }
    writeln!(
        writer,
        "\nCELL_DATA {triangles}\nSCALARS grain int 1\nLOOKUP_TABLE default"
    )?;
    for grain in &grains {
        for _ in &grain.mesh.triangles {
            writer.write_all(&(grain.number as u32).to_be_bytes())?;
        }
    }
    writeln!(writer, "\nCOLOR_SCALARS colour 3")?;
    for grain in &grains {
        for _ in &grain.mesh.triangles {
            writer.write_all(&grain.colour)?;
        }
    }
    Ok(writeln!(writer)?)
}
