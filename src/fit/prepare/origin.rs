//! What the points that a radius is estimated from are.

/// What an estimate is made from.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Origin {
    /// Points, beside which dust may lie.
    Points,
    /// The vertices of a closed surface, each of which may be a stray.
    Faces,
    /// Places on large faces too, and none is a stray.
    LargeFaces,
}
