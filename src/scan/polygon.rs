//! Faces: checked indices, and polygons as fans of triangles.

use super::error::{ParseError, Place};

/// A face's index as an index into the points, or an error naming the place.
pub(super) fn checked(index: i64, points: usize, place: Place) -> Result<u32, ParseError> {
    u32::try_from(index)
        .ok()
        .filter(|&index| (index as usize) < points)
        .ok_or(ParseError::IndexOutOfRange {
            place,
            index,
            points,
            first: 0,
        })
}

/// Appends a polygon as a fan about its first corner. Fewer than three corners have no area and
/// add nothing.
pub(super) fn fan(corners: &[u32], triangles: &mut Vec<[u32; 3]>) {
    if let [first, rest @ ..] = corners {
        triangles.extend(rest.windows(2).map(|edge| [*first, edge[0], edge[1]]));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_quad_makes_two_triangles_wound_alike() {
        let mut triangles = Vec::new();
        fan(&[4, 5, 6, 7], &mut triangles);
        assert_eq!(triangles, [[4, 5, 6], [4, 6, 7]]);
    }

    #[test]
    fn short_polygons_add_nothing() {
        let mut triangles = Vec::new();
        fan(&[], &mut triangles);
        fan(&[1, 2], &mut triangles);
        assert!(triangles.is_empty());
    }
}
