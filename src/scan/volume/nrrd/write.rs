//! An image as NRRD, packed with gzip.

use crate::scan::volume::Volume;
use crate::scan::volume::samples::{Kind, Order};
use flate2::Compression;
use flate2::write::GzEncoder;
use std::io::{self, Write};

impl Volume {
    /// Writes the image as NRRD.
    ///
    /// # Errors
    /// Those of the writer.
    pub fn write_nrrd(&self, mut writer: impl Write) -> io::Result<()> {
        let [width, height, depth] = self.size;
        let order = match self.samples.order {
            Order::Little => "little",
            Order::Big => "big",
        };
        let [x, y, z] = [0, 1, 2].map(|axis| vector(self.steps.column(axis).into_owned().into()));
        write!(
            writer,
            "NRRD0004\n\
             type: {}\n\
             dimension: 3\n\
             space dimension: 3\n\
             sizes: {width} {height} {depth}\n\
             space directions: {x} {y} {z}\n\
             space origin: {}\n\
             kinds: domain domain domain\n\
             endian: {order}\n\
             encoding: gzip\n",
            name(self.samples.kind),
            vector(self.origin.into()),
        )?;
        if let Some(unit) = &self.unit {
            writeln!(writer, "space units: \"{unit}\" \"{unit}\" \"{unit}\"")?;
        }
        writeln!(writer)?;
        let mut packed = GzEncoder::new(writer, Compression::default());
        packed.write_all(&self.samples.bytes)?;
        packed.finish()?.flush()
    }
}

/// `(1,0,0)`
fn vector([x, y, z]: [f64; 3]) -> String {
    format!("({x},{y},{z})")
}

fn name(kind: Kind) -> &'static str {
    match kind {
        Kind::U8 => "uint8",
        Kind::I8 => "int8",
        Kind::U16 => "uint16",
        Kind::I16 => "int16",
        Kind::U32 => "uint32",
        Kind::I32 => "int32",
        Kind::U64 => "uint64",
        Kind::I64 => "int64",
        Kind::F32 => "float",
        Kind::F64 => "double",
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scan::parse_volume;
    use crate::scan::volume::samples::Samples;
    use nalgebra::{Matrix3, Point3};
    use std::path::Path;

    #[test]
    fn what_is_written_is_read_again() {
        let kinds = [
            Kind::U8,
            Kind::I8,
            Kind::U16,
            Kind::I16,
            Kind::U32,
            Kind::I32,
            Kind::U64,
            Kind::I64,
            Kind::F32,
            Kind::F64,
        ];
        for (kind, unit) in kinds
            .into_iter()
            .zip([Some("um"), None].into_iter().cycle())
        {
            for order in [Order::Little, Order::Big] {
                let samples = Samples {
                    bytes: (0..24 * kind.bytes() as u8).collect(),
                    kind,
                    order,
                };
                let steps = Matrix3::new(0.1, 0.2, 0.0, 0.0, -0.3, 1e-7, 0.0, 0.1, 1.0 / 3.0);
                let origin = Point3::new(1e9 / 3.0, -0.1, 0.0);
                let volume = Volume::new([4, 3, 2], samples, origin, steps).unwrap();
                let volume = volume.in_unit(unit.map(str::to_owned));
                let mut bytes = Vec::new();
                volume.write_nrrd(&mut bytes).unwrap();
                let read = parse_volume(Path::new("x.nrrd"), &bytes, 1000).unwrap();
                assert_eq!(read, Some(volume));
            }
        }
    }
}
