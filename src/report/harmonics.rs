//! The published coefficients a_l^m as CSV.

use crate::model::{PublishedExpansion, Region, StarGrain, Stretch, Surface};
use crate::sphere::{AngleRectangle, Symmetry};
use std::io::{self, Write};

/// The largest loss of the conversion over all segments, in the scan's unit.
pub fn largest_loss(segments: &[PublishedExpansion]) -> f64 {
    segments.iter().fold(0.0, |most, s| most.max(s.loss))
}

/// Writes what [`StarGrain::published`] gave as CSV, a row per coefficient. Lines at the head, marked with
/// `#`, say by which conventions to read it.
///
/// # Errors
/// Those of the writer.
pub fn write_harmonics(
    grain: &StarGrain,
    segments: &[PublishedExpansion],
    writer: &mut impl Write,
) -> io::Result<()> {
    let frame = grain.frame();
    let [x, y, z] = [0, 1, 2].map(|i| row(frame.axes.column(i).into_owned().into()));
    let angles = "theta_min,theta_max,phi_min,phi_max";
    let (how, columns) = match segments.first().map(|s| s.region) {
        Some(Region::Cell { margin, .. }) => (blending(margin), "face,parts,row,column"),
        Some(Region::Mirrored(symmetry)) => (mirroring(symmetry), angles),
        _ => ("in each segment".into(), angles),
    };
    write!(
        writer,
        "# radius r(theta, phi) = sum over l, m of a_l^m Y_l^m(theta, phi) {how}\n\
         # Y_l^m: real and orthonormal on the unit sphere, without the Condon-Shortley phase;\n\
         #   m > 0: sqrt(2) N P_l^m(cos theta) cos(m phi), m < 0: sqrt(2) N P_l^|m|(cos theta) \
         sin(|m| phi)\n\
         # theta from the grain's z axis, phi from its x axis towards its y axis, in radians\n\
         {}\
         # centre of the grain in the scan: {}\n\
         # x axis of the grain in the scan: {x}\n\
         # y axis of the grain in the scan: {y}\n\
         # z axis of the grain in the scan: {z}\n\
         # a and the centre are in the scan's unit\n\
         # largest loss of the conversion: {:e} in the scan's unit\n\
         segment,{columns},l,m,a\n",
        stretching(grain.stretch()),
        row(frame.centre.coords.into()),
        largest_loss(segments),
    )?;
    for (number, segment) in segments.iter().enumerate() {
        let region = match segment.region {
            Region::Rectangle(rectangle) => bounds(&rectangle),
            Region::Mirrored(symmetry) => bounds(&symmetry.rectangle()),
            Region::Cell { cell: c, .. } => {
                format!("{},{},{},{}", c.face, c.parts, c.row, c.column)
            }
        };
        for (index, a) in segment.coefficients.iter().enumerate() {
            let l = index.isqrt();
            let m = index as i64 - (l * (l + 1)) as i64;
            writeln!(writer, "{number},{region},{l},{m},{a}")?;
        }
    }
    Ok(())
}

fn row(v: [f64; 3]) -> String {
    v.map(|x| x.to_string()).join(" ")
}

fn bounds(rectangle: &AngleRectangle) -> String {
    let AngleRectangle { theta, phi } = rectangle;
    format!("{},{},{},{}", theta[0], theta[1], phi[0], phi[1])
}

/// How to read radii of the stretched space; nothing without a stretch.
fn stretching(stretch: &Stretch) -> String {
    if stretch.is_none() {
        return String::new();
    }
    format!(
        "# r is the radius of the grain stretched along its own axes, by t = {}\n\
         #   that of the grain itself in a direction n: with q = (t_x n_x, t_y n_y, t_z n_z), find r as \
         said here for the direction q / |q|, and divide it by |q|\n",
        row((*stretch.factors()).into()),
    )
}

/// How the expansion of a part of the sphere makes a radius.
fn mirroring(symmetry: Symmetry) -> String {
    let names = symmetry.names();
    let absolute: Vec<String> = names.iter().map(|name| format!("|{name}|")).collect();
    format!(
        "in the region given, and mirrored:\n\
         #   r of a direction (x, y, z) elsewhere is that of its image there, with {} in the place of {}",
        absolute.join(", "),
        names.join(", "),
    )
}

/// How the expansions of cells make a radius.
fn blending(margin: f64) -> String {
    format!(
        "f of all cells, blended:\n\
         #   r = sum of w f / sum of w over the cells, w = S(beta) S(gamma) on the half sphere of \
         the cell's face and 0 elsewhere;\n\
         #   face 2a + s: axis a (0: x, 1: y, 2: z), side s (0: +, 1: -); tan(beta) = n_b / |n_a|, \
         tan(gamma) = n_c / |n_a| with b, c the axes after a;\n\
         #   the cell spans beta = (row + 0..1) pi / (2 parts) - pi/4 and gamma likewise by column; \
         S rises from 0 to 1 over {margin} widths, at most 36 degrees, on both sides of one border,\n\
         #   as s^3 (10 - 15 s + 6 s^2), s linear in tan(beta / 2), times the like that falls at the other"
    )
}
