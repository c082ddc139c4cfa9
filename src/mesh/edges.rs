//! The edges of triangles.

/// Those of a triangle, each from a corner to the next.
pub(crate) fn edges(&[a, b, c]: &[u32; 3]) -> [[u32; 2]; 3] {
    [[a, b], [b, c], [c, a]]
}

/// An edge whichever way it is gone: the lower end first.
pub(crate) fn undirected([from, to]: [u32; 2]) -> [u32; 2] {
    [from.min(to), from.max(to)]
}
