//! PLY, in text or binary of either byte order.
//!
//! ply-rs reads the header and the binary rows. Text rows are read by `ascii`, which says why.

mod ascii;
mod binary;
mod header;

use ply_rs::ply::Encoding;

use super::{ParseError, Scan};

pub(super) fn parse(bytes: &[u8]) -> Result<Scan, ParseError> {
    let header = header::read(bytes)?;
    let mut scan = match header.encoding {
        Encoding::Ascii => ascii::read(bytes, &header)?,
        Encoding::BinaryLittleEndian | Encoding::BinaryBigEndian => binary::read(bytes, &header)?,
    };
    if !header.known_version {
        let warning = "The PLY version is not 1.0; the file was read as if it were.";
        scan.warnings.push(warning.into());
    }
    Ok(scan)
}
