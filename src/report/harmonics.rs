//! The published coefficients a_l^m as CSV.

use crate::model::{Frame, PublishedSegment};
use std::io::{self, Write};

/// The largest loss of the conversion over all segments, in the scan's unit.
pub fn largest_loss(segments: &[PublishedSegment]) -> f64 {
    segments.iter().fold(0.0, |most, s| most.max(s.loss))
}

/// Writes what [`Grain::published`](crate::Grain::published) gave as CSV, a row per coefficient. Lines
/// at the head, marked with `#`, say by which conventions to read it.
///
/// # Errors
/// Those of the writer.
pub fn write_harmonics(
    frame: &Frame,
    segments: &[PublishedSegment],
    writer: &mut impl Write,
) -> io::Result<()> {
    let row = |v: [f64; 3]| v.map(|x| x.to_string()).join(" ");
    let [x, y, z] = [0, 1, 2].map(|i| row(frame.axes.column(i).into_owned().into()));
    write!(
        writer,
        "# radius r(theta, phi) = sum over l, m of a_l^m Y_l^m(theta, phi) in each segment\n\
         # Y_l^m: real and orthonormal on the unit sphere, without the Condon-Shortley phase;\n\
         #   m > 0: sqrt(2) N P_l^m(cos theta) cos(m phi), m < 0: sqrt(2) N P_l^|m|(cos theta) \
         sin(|m| phi)\n\
         # theta from the grain's z axis, phi from its x axis towards its y axis, in radians\n\
         # centre of the grain in the scan: {}\n\
         # x axis of the grain in the scan: {x}\n\
         # y axis of the grain in the scan: {y}\n\
         # z axis of the grain in the scan: {z}\n\
         # a and the centre are in the scan's unit\n\
         # largest loss of the conversion: {:e} in the scan's unit\n\
         segment,theta_min,theta_max,phi_min,phi_max,l,m,a\n",
        row(frame.centre.coords.into()),
        largest_loss(segments),
    )?;
    for (number, segment) in segments.iter().enumerate() {
        let ([top, bottom], [west, east]) = (segment.rectangle.theta, segment.rectangle.phi);
        for (index, a) in segment.coefficients.iter().enumerate() {
            let l = index.isqrt();
            let m = index as i64 - (l * (l + 1)) as i64;
            writeln!(writer, "{number},{top},{bottom},{west},{east},{l},{m},{a}")?;
        }
    }
    Ok(())
}
