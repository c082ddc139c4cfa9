//! Numbers within a page: 32 bits each, little-endian, in base 64.

use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use nalgebra::Vector3;
use serde::Serialize;

/// Packed numbers.
#[derive(Debug, Clone, Serialize)]
#[serde(transparent)]
pub(super) struct Packed(String);

impl Packed {
    /// Floating-point numbers; what is not known is not a number.
    pub(super) fn floats(numbers: impl IntoIterator<Item = f64>) -> Self {
        let numbers = numbers.into_iter();
        Self::bytes(
            numbers
                .flat_map(|number| (number as f32).to_le_bytes())
                .collect(),
        )
    }

    /// The coordinates of vectors.
    pub(super) fn vectors(vectors: impl IntoIterator<Item = Vector3<f64>>) -> Self {
        let vectors = vectors.into_iter();
        Self::floats(vectors.flat_map(|vector| -> [f64; 3] { vector.into() }))
    }

    /// The coordinates of unit vectors, a signed byte each: to half a degree.
    pub(super) fn units(vectors: impl IntoIterator<Item = Vector3<f64>>) -> Self {
        let part = |part: f64| (127.0 * part).round() as i8 as u8;
        let vectors = vectors.into_iter();
        Self::bytes(
            vectors
                .flat_map(|vector| <[f64; 3]>::from(vector).map(part))
                .collect(),
        )
    }

    /// Whole numbers.
    pub(super) fn counts(numbers: impl IntoIterator<Item = u32>) -> Self {
        Self::bytes(numbers.into_iter().flat_map(u32::to_le_bytes).collect())
    }

    fn bytes(bytes: Vec<u8>) -> Self {
        Self(STANDARD.encode(bytes))
    }
}
