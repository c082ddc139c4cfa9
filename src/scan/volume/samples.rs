//! The numbers of an image, as they are in the file.

use super::VolumeError;
use crate::digits::plural;
use std::ops::Range;

/// A type of numbers.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Kind {
    U8,
    I8,
    U16,
    I16,
    U32,
    I32,
    U64,
    I64,
    F32,
    F64,
}

impl Kind {
    /// Bytes of a number.
    pub(super) fn bytes(self) -> usize {
        match self {
            Self::U8 | Self::I8 => 1,
            Self::U16 | Self::I16 => 2,
            Self::U32 | Self::I32 | Self::F32 => 4,
            Self::U64 | Self::I64 | Self::F64 => 8,
        }
    }
}

/// Order of the bytes of a number.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Order {
    Little,
    Big,
}

/// Numbers of one type, one after the other.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Samples {
    pub(super) bytes: Vec<u8>,
    pub(super) kind: Kind,
    pub(super) order: Order,
}

/// The number in the first bytes of a slice.
macro_rules! number {
    ($type:ty, $bytes:expr, $order:expr) => {{
        let bytes = *$bytes.first_chunk()?;
        match $order {
            Order::Little => <$type>::from_le_bytes(bytes),
            Order::Big => <$type>::from_be_bytes(bytes),
        }
    }};
}

impl Samples {
    pub(super) fn count(&self) -> usize {
        self.bytes.len() / self.kind.bytes()
    }

    /// What to say where there are more bytes than so many numbers have.
    pub(super) fn surplus(&self, numbers: usize) -> Option<String> {
        let promised = numbers.checked_mul(self.kind.bytes())?;
        let left = self.bytes.len().checked_sub(promised).filter(|n| *n > 0)?;
        let bytes = plural(left, "byte");
        let warning = format!("Left {bytes} unread after the voxels that the header counts.");
        let times = [(2, "twice"), (4, "four times"), (8, "eight times")];
        let times = times
            .iter()
            .find(|(times, _)| promised.checked_mul(*times) == Some(self.bytes.len()));
        Some(match times {
            Some((_, times)) => format!(
                "{warning} There are exactly {times} as many bytes as it promises: its type of numbers may be wrong."
            ),
            None => warning,
        })
    }

    /// So many zeros of the same type.
    pub(super) fn blank(&self, count: usize) -> Self {
        Self {
            bytes: vec![0; count * self.kind.bytes()],
            ..*self
        }
    }

    /// Copies samples of the same type to where they begin here.
    pub(super) fn copy(&mut self, to: usize, other: &Self, from: Range<usize>) {
        let size = self.kind.bytes();
        let from = &other.bytes[size * from.start..size * from.end];
        self.bytes[size * to..][..from.len()].copy_from_slice(from);
    }

    /// A sample as a label.
    pub(super) fn label(&self, index: usize) -> Result<i64, VolumeError> {
        let value = self.value(index);
        value.map_err(|value| VolumeError::GreyValues { index, value })
    }

    /// A sample that is a whole number, or else what it is.
    fn value(&self, index: usize) -> Result<i64, f64> {
        self.number(index).unwrap_or(Err(f64::NAN))
    }

    #[inline]
    fn number(&self, index: usize) -> Option<Result<i64, f64>> {
        let bytes = self.bytes.get(index * self.kind.bytes()..)?;
        let order = self.order;
        Some(match self.kind {
            Kind::U8 => Ok(number!(u8, bytes, order).into()),
            Kind::I8 => Ok(number!(i8, bytes, order).into()),
            Kind::U16 => Ok(number!(u16, bytes, order).into()),
            Kind::I16 => Ok(number!(i16, bytes, order).into()),
            Kind::U32 => Ok(number!(u32, bytes, order).into()),
            Kind::I32 => Ok(number!(i32, bytes, order).into()),
            Kind::U64 => {
                let value = number!(u64, bytes, order);
                i64::try_from(value).map_err(|_| value as f64)
            }
            Kind::I64 => Ok(number!(i64, bytes, order)),
            Kind::F32 => whole(number!(f32, bytes, order).into()),
            Kind::F64 => whole(number!(f64, bytes, order)),
        })
    }
}

/// A number without a fraction, such as f64 holds all of.
fn whole(value: f64) -> Result<i64, f64> {
    const EXACT: f64 = 9_007_199_254_740_992.0;
    match value.fract() == 0.0 && value.abs() <= EXACT {
        true => Ok(value as i64),
        false => Err(value),
    }
}
