//! PLY, in text or binary of either byte order.
//!
//! ply-rs reads the header and the binary rows. Text rows are read by `ascii`, which says why.

mod ascii;
mod binary;
mod header;
mod meaning;
mod spare;
mod strips;

use ply_rs::ply::Encoding;

use super::unseen::drop_unseen;
use super::{ParseError, Scan};

pub(super) fn parse(bytes: &[u8]) -> Result<Scan, ParseError> {
    let header = header::read(bytes)?;
    let mut scan = match header.encoding {
        Encoding::Ascii => ascii::read(bytes, &header)?,
        Encoding::BinaryLittleEndian | Encoding::BinaryBigEndian => binary::read(bytes, &header)?,
    };
    drop_unseen(&mut scan)?;
    scan.unit = header.unit;
    scan.warnings.extend(header.warnings);
    if !header.known_version {
        let warning = "The PLY version is not 1.0; the file was read as if it were.";
        scan.warnings.push(warning.into());
    }
    Ok(scan)
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::point;

    #[test]
    fn another_file_behind_the_first_is_told() {
        for (encoding, row) in [
            ("ascii", "1 2 3\n"),
            ("binary_little_endian", "abcdefghijkl"),
        ] {
            let one = format!(
                "ply\nformat {encoding} 1.0\nelement vertex 1\nproperty float x\nproperty float y\nproperty float z\n\
                 end_header\n{row}"
            );
            let scan = parse(one.repeat(2).as_bytes()).unwrap();
            assert!(
                scan.warnings[0].contains("Another PLY file begins there"),
                "{:?}",
                scan.warnings
            );
        }
    }

    /// Three points of numbers of three types and the triangle over them, in a byte order.
    fn binary(order: &str) -> Vec<u8> {
        let header = "ply\nformat binary_ORDER_endian 1.0\nelement vertex 3\nproperty double x\n\
                      property float y\nproperty short z\nelement face 1\n\
                      property list ushort int vertex_indices\nend_header\n";
        let mut bytes = header.replace("ORDER", order).into_bytes();
        let mut put = |big_endian: &[u8]| match order {
            "big" => bytes.extend(big_endian),
            _ => bytes.extend(big_endian.iter().rev()),
        };
        for (x, y, z) in [(0.1_f64, 1.25_f32, 258_i16), (-2.0, 0.0, 1), (0.0, 3.0, -2)] {
            put(&x.to_be_bytes());
            put(&y.to_be_bytes());
            put(&z.to_be_bytes());
        }
        put(&3_u16.to_be_bytes());
        for corner in [0_i32, 2, 1] {
            put(&corner.to_be_bytes());
        }
        bytes
    }

    #[test]
    fn both_byte_orders_are_read() {
        for order in ["big", "little"] {
            let scan = parse(&binary(order)).unwrap();
            let points = [
                point![0.1, 1.25, 258.0],
                point![-2.0, 0.0, 1.0],
                point![0.0, 3.0, -2.0],
            ];
            assert_eq!(scan.points, points, "{order}");
            assert_eq!(scan.triangles, [[0, 2, 1]], "{order}");
            assert_eq!(scan.warnings, [""; 0], "{order}");
        }
    }
}
