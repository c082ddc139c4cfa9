//! The rows of a binary PLY, decoded by ply-rs one at a time, so that only the points and
//! triangles are kept in memory.

use nalgebra::Point3;
use ply_rs::parser::Parser;
use ply_rs::ply::{
    ElementDef, Encoding, Property, PropertyAccess, PropertyAccessResult, PropertyType, ScalarType,
};

use super::header::{Header, Skipped};
use super::{spare, strips};
use crate::digits::plural;
use crate::scan::Scan;
use crate::scan::error::{ParseError, Place};
use crate::scan::polygon::Faces;

pub(super) fn read(bytes: &[u8], header: &Header) -> Result<Scan, ParseError> {
    let (mut scan, mut faces) = (Scan::default(), Faces::default());
    let mut rows = Rows {
        bytes,
        rest: &bytes[header.body..],
        encoding: header.encoding,
    };
    for element in &header.elements {
        rows.check_count(element)?;
        match element.name.as_str() {
            "vertex" => {
                scan.points.reserve_exact(element.count);
                rows.read(element, "vertex", |Vertex(point), _| {
                    scan.points.push(point);
                    Ok(())
                })?;
            }
            "face" => rows.read(element, "face", |Indices(indices), place| {
                faces.add_checked(&indices, header.points, place)
            })?,
            "tristrips" => rows.read(element, "strips", |Indices(list), place| {
                strips::add(&list, header.points, place, &mut faces)
            })?,
            _ => rows.read(element, "row", |Skipped, _| Ok(()))?,
        }
    }
    if let count @ 1.. = rows.rest.len() {
        let left = spare::left(&plural(count, "byte"), rows.rest);
        scan.warnings.push(left);
    }
    faces.give(&mut scan);
    Ok(scan)
}

struct Rows<'a> {
    bytes: &'a [u8],
    rest: &'a [u8],
    encoding: Encoding,
}

impl Rows<'_> {
    fn byte(&self) -> usize {
        self.bytes.len() - self.rest.len()
    }

    /// Refuses a count that the bytes left cannot hold, before anything relies on it.
    fn check_count(&self, element: &ElementDef) -> Result<(), ParseError> {
        let row_bytes = element.properties.values().map(least_bytes).sum();
        let needed = element.count.checked_mul(row_bytes);
        if needed.is_some_and(|needed| needed <= self.rest.len()) {
            return Ok(());
        }
        Err(ParseError::CountTooLarge {
            byte: self.byte(),
            element: element.name.clone(),
            rows: element.count,
            row_bytes,
            left: self.rest.len(),
        })
    }

    fn read<E: PropertyAccess>(
        &mut self,
        element: &ElementDef,
        what: &'static str,
        mut keep: impl FnMut(E, Place) -> Result<(), ParseError>,
    ) -> Result<(), ParseError> {
        let parser = Parser::<E>::new();
        for number in 0..element.count {
            let byte = self.byte();
            let place = Place::Record { what, number, byte };
            let row = match self.encoding {
                Encoding::BinaryBigEndian => {
                    parser.read_big_endian_element(&mut self.rest, element)
                }
                _ => parser.read_little_endian_element(&mut self.rest, element),
            };
            keep(row.map_err(|error| broken_row(&error, place))?, place)?;
        }
        Ok(())
    }
}

fn broken_row(error: &ply_rs::parser::ParseError, place: Place) -> ParseError {
    if error.kind() == std::io::ErrorKind::UnexpectedEof {
        return ParseError::CutShort {
            place,
            expected: "the rest of the row",
        };
    }
    ParseError::Unexpected {
        place,
        expected: "a row as the header declares it",
        found: error.to_string(),
    }
}

fn least_bytes(property: &ply_rs::ply::PropertyDef) -> usize {
    match &property.data_type {
        PropertyType::Scalar(scalar) | PropertyType::List(scalar, _) => match scalar {
            ScalarType::Char | ScalarType::UChar => 1,
            ScalarType::Short | ScalarType::UShort => 2,
            ScalarType::Int | ScalarType::UInt | ScalarType::Float => 4,
            ScalarType::Double => 8,
        },
    }
}

struct Vertex(Point3<f64>);

impl Vertex {
    fn set(&mut self, name: &str, value: f64) -> PropertyAccessResult {
        match name {
            "x" => self.0.x = value,
            "y" => self.0.y = value,
            "z" => self.0.z = value,
            _ => return PropertyAccessResult::Ignored,
        }
        PropertyAccessResult::Set
    }
}

/// One setter per type: through the common `set_property` a point takes a third longer.
macro_rules! scalar_setters {
    ($($setter:ident($kind:ty))*) => {$(
        fn $setter(&mut self, name: &str, value: $kind) -> PropertyAccessResult {
            self.set(name, value.into())
        }
    )*};
}

impl PropertyAccess for Vertex {
    fn new() -> Self {
        Self(Point3::origin())
    }

    scalar_setters! {
        set_char(i8) set_uchar(u8) set_short(i16) set_ushort(u16)
        set_int(i32) set_uint(u32) set_float(f32) set_double(f64)
    }
}

/// The corners of a face or of strips.
struct Indices(Vec<i64>);

impl PropertyAccess for Indices {
    fn new() -> Self {
        Self(Vec::new())
    }

    fn set_property(&mut self, name: &str, value: Property) -> PropertyAccessResult {
        fn widen<T: Into<i64>>(values: Vec<T>) -> Vec<i64> {
            values.into_iter().map(Into::into).collect()
        }
        if name != "vertex_indices" {
            return PropertyAccessResult::Ignored;
        }
        self.0 = match value {
            Property::ListChar(values) => widen(values),
            Property::ListUChar(values) => widen(values),
            Property::ListShort(values) => widen(values),
            Property::ListUShort(values) => widen(values),
            Property::ListInt(values) => widen(values),
            Property::ListUInt(values) => widen(values),
            Property::ListFloat(_) | Property::ListDouble(_) => {
                return PropertyAccessResult::UnsupportedType;
            }
            _ => return PropertyAccessResult::Ignored,
        };
        PropertyAccessResult::Set
    }
}
