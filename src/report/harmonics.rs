//! The published coefficients a_l^m as CSV.

use crate::model::{Frame, PositionGrain, PublishedExpansion, Region, StarGrain, Stretch, Surface};
use crate::sphere::{AngleRectangle, Symmetry};
use std::io::{self, Write};

/// The largest loss of the conversion over all expansions, in the scan's unit.
pub fn largest_loss<'a>(expansions: impl IntoIterator<Item = &'a PublishedExpansion>) -> f64 {
    let losses = expansions.into_iter().map(|expansion| expansion.loss);
    losses.fold(0.0, f64::max)
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
    let Some(first) = segments.first() else {
        return Ok(());
    };
    let how = match first.region {
        Region::Cell { margin, .. } => blending("r", margin),
        Region::Mirrored(symmetry) => mirroring(symmetry),
        Region::Rectangle(_) => "in each segment".into(),
    };
    let expansion =
        format!("radius r(theta, phi) = sum over l, m of a_l^m Y_l^m(theta, phi) {how}");
    let loss = largest_loss(segments);
    let stretch = stretching(grain.stretch());
    write_head(writer, &expansion, &stretch, &grain.frame(), loss)?;
    write_rows(writer, ["a"], segments.as_chunks().0)
}

/// The same of what [`PositionGrain::published`] gave, with the coefficients of x, y and z in a row.
///
/// # Errors
/// Those of the writer.
pub fn write_position_harmonics(
    grain: &PositionGrain,
    segments: &[[PublishedExpansion; 3]],
    writer: &mut impl Write,
) -> io::Result<()> {
    let Some([first, ..]) = segments.first() else {
        return Ok(());
    };
    let how = match first.region {
        Region::Cell { margin, .. } => blending("X", margin),
        _ => "over the whole sphere".into(),
    };
    let expansion = format!(
        "point X(theta, phi) = (x, y, z) = sum over l, m of (x, y, z)_l^m Y_l^m(theta, phi) {how}"
    );
    let point = "# X is seen from the centre of the grain along its axes; theta and phi are parameters, not the direction of X\n";
    let loss = largest_loss(segments.as_flattened());
    write_head(writer, &expansion, point, &grain.frame(), loss)?;
    write_rows(writer, ["x", "y", "z"], segments)
}

/// By which conventions to read what follows.
fn write_head(
    writer: &mut impl Write,
    expansion: &str,
    more: &str,
    frame: &Frame,
    loss: f64,
) -> io::Result<()> {
    let [x, y, z] = [0, 1, 2].map(|i| row(frame.axes.column(i).into_owned().into()));
    write!(
        writer,
        "# {expansion}\n\
         # Y_l^m: real and orthonormal on the unit sphere, without the Condon-Shortley phase;\n\
         #   m > 0: sqrt(2) N P_l^m(cos theta) cos(m phi), m < 0: sqrt(2) N P_l^|m|(cos theta) \
         sin(|m| phi)\n\
         # theta from the grain's z axis, phi from its x axis towards its y axis, in radians\n\
         {more}\
         # centre of the grain in the scan: {}\n\
         # x axis of the grain in the scan: {x}\n\
         # y axis of the grain in the scan: {y}\n\
         # z axis of the grain in the scan: {z}\n\
         # coefficients and the centre are in the scan's unit\n\
         # largest loss of the conversion: {loss:e} in the scan's unit\n",
        row(frame.centre.coords.into()),
    )
}

/// The names of the columns, and a row per coefficient, or per one of each of several expansions in the same region.
fn write_rows<const C: usize>(
    writer: &mut impl Write,
    names: [&str; C],
    segments: &[[PublishedExpansion; C]],
) -> io::Result<()> {
    let region = segments.as_flattened().first().map(|first| &first.region);
    let place = region.map_or("", Region::columns);
    writeln!(writer, "segment,{place},l,m,{}", names.join(","))?;
    for (number, expansions) in segments.iter().enumerate() {
        let place = expansions[0].region.row();
        for index in 0..expansions[0].coefficients.len() {
            let l = index.isqrt();
            let m = index as i64 - (l * (l + 1)) as i64;
            let values = expansions
                .each_ref()
                .map(|own| own.coefficients[index].to_string());
            writeln!(writer, "{number},{place},{l},{m},{}", values.join(","))?;
        }
    }
    Ok(())
}

impl Region {
    /// The names of what [`Self::row`] tells.
    fn columns(&self) -> &'static str {
        match self {
            Self::Cell { .. } => "face,parts,row,column",
            _ => "theta_min,theta_max,phi_min,phi_max",
        }
    }

    fn row(&self) -> String {
        match self {
            Self::Rectangle(rectangle) => bounds(rectangle),
            Self::Mirrored(symmetry) => bounds(&symmetry.rectangle()),
            Self::Cell { cell: c, .. } => {
                format!("{},{},{},{}", c.face, c.parts, c.row, c.column)
            }
        }
    }
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

/// How the expansions of cells make a radius or a point, by its name.
fn blending(blended: &str, margin: f64) -> String {
    format!(
        "f of all cells, blended:\n\
         #   {blended} = sum of w f / sum of w over the cells, w = S(beta) S(gamma) on the half sphere of \
         the cell's face and 0 elsewhere;\n\
         #   face 2a + s: axis a (0: x, 1: y, 2: z), side s (0: +, 1: -); tan(beta) = n_b / |n_a|, \
         tan(gamma) = n_c / |n_a| with b, c the axes after a;\n\
         #   the cell spans beta = (row + 0..1) pi / (2 parts) - pi/4 and gamma likewise by column; \
         S rises from 0 to 1 over {margin} widths, at most 36 degrees, on both sides of one border,\n\
         #   as s^3 (10 - 15 s + 6 s^2), s linear in tan(beta / 2), times the like that falls at the other"
    )
}
