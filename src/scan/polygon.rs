//! Faces: checked indices, and polygons as triangles.

use super::Scan;
use super::error::{ParseError, Place};
use crate::digits::plural;
use crate::mesh::{LEAST_AREA_CORNERS, least_area};
use nalgebra::{Point3, Vector3};

/// A fan whose triangle faces backwards by more than this share of the polygon's area is folded.
const FOLDED: f64 = 1e-9;

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

/// Faces while they are read; points may come after them.
#[derive(Default)]
pub(super) struct Faces {
    triangles: Vec<[u32; 3]>,
    /// Of polygons of more than three corners: the first of their triangles, and how many they have.
    polygons: Vec<(usize, usize)>,
    /// Those of the last polygon, whose memory serves the next.
    corners: Vec<u32>,
}

impl Faces {
    /// Appends a polygon whose indices are to be [checked].
    pub(super) fn add_checked(
        &mut self,
        indices: &[i64],
        points: usize,
        place: Place,
    ) -> Result<(), ParseError> {
        let mut corners = std::mem::take(&mut self.corners);
        corners.clear();
        for &index in indices {
            corners.push(checked(index, points, place)?);
        }
        self.add(&corners);
        self.corners = corners;
        Ok(())
    }

    /// Appends a polygon as a fan about its first corner. Fewer than three corners have no area and add nothing.
    pub(super) fn add(&mut self, corners: &[u32]) {
        if let [first, rest @ ..] = corners {
            if rest.len() > 2 {
                self.polygons.push((self.triangles.len(), rest.len() - 1));
            }
            let fan = rest.windows(2).map(|edge| [*first, edge[0], edge[1]]);
            self.triangles.extend(fan);
        }
    }

    pub(super) fn is_empty(&self) -> bool {
        self.triangles.is_empty()
    }

    /// Gives a scan its triangles. All corners must be among its points. Polygons over which a fan is folded, as it is
    /// where they are not convex, get triangles of least area; from 121 corners on that takes too long, and is told.
    pub(super) fn give(mut self, scan: &mut Scan) {
        let mut left = 0;
        for (first, count) in self.polygons {
            let fan = &mut self.triangles[first..first + count];
            if !is_folded(fan, &scan.points) {
                continue;
            }
            let ends = fan.iter().map(|[_, _, end]| *end);
            let corners: Vec<u32> = fan[0][..2].iter().copied().chain(ends).collect();
            if corners.len() > LEAST_AREA_CORNERS {
                left += 1;
                continue;
            }
            let places: Vec<Point3<f64>> = corners
                .iter()
                .map(|&corner| scan.points[corner as usize])
                .collect();
            let least = least_area(&places, |_, _| true).unwrap_or_default();
            for (triangle, named) in fan.iter_mut().zip(least) {
                *triangle = named.map(|corner| corners[corner]);
            }
        }
        if left > 0 {
            let polygons = plural(left, "polygon");
            scan.warnings.push(format!(
                "Cut {polygons} of more than {LEAST_AREA_CORNERS} corners that are not convex into triangles that overlap: \
                 the area is too large."
            ));
        }
        scan.triangles = self.triangles;
    }
}

/// Whether a triangle of a fan faces the other way than all of them together.
fn is_folded(fan: &[[u32; 3]], points: &[Point3<f64>]) -> bool {
    let area = |corners: &[u32; 3]| {
        let [a, b, c] = corners.map(|corner| points[corner as usize]);
        (b - a).cross(&(c - a))
    };
    let all: Vector3<f64> = fan.iter().map(area).sum();
    let least = -FOLDED * all.norm_squared();
    fan.iter().any(|corners| area(corners).dot(&all) < least)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn triangles(points: &[[f64; 2]], polygon: &[u32]) -> Vec<[u32; 3]> {
        let mut scan = Scan::default();
        let points = points.iter().map(|&[x, y]| Point3::new(x, y, 0.0));
        scan.points.extend(points);
        let mut faces = Faces::default();
        faces.add(&[0, 1, 2]);
        faces.add(polygon);
        faces.give(&mut scan);
        assert_eq!(scan.warnings, [""; 0]);
        scan.triangles.split_off(1)
    }

    const SQUARE: [[f64; 2]; 4] = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];

    #[test]
    fn a_quad_makes_two_triangles_wound_alike() {
        let found = triangles(&SQUARE, &[0, 1, 2, 3]);
        assert_eq!(found, [[0, 1, 2], [0, 2, 3]]);
    }

    #[test]
    fn short_polygons_add_nothing() {
        assert!(triangles(&SQUARE, &[]).is_empty());
        assert!(triangles(&SQUARE, &[1, 2]).is_empty());
    }

    /// A square with a notch to its middle: from the corner 0 the notch folds a fan.
    #[test]
    fn a_polygon_that_is_not_convex_has_its_area() {
        let [a, b, c, d] = SQUARE;
        let corners = [a, b, [0.5, 0.5], c, d];
        for turn in 0..5 {
            let polygon: Vec<u32> = (0..5).map(|i| (i + turn) % 5).collect();
            let found = triangles(&corners, &polygon);
            assert_eq!(found.len(), 3);
            let area = |t: &[u32; 3]| {
                let [a, b, c] = t.map(|i| corners[i as usize]);
                0.5 * ((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]))
            };
            assert!(found.iter().all(|t| area(t) >= 0.0), "{found:?}");
            let sum: f64 = found.iter().map(area).sum();
            assert!((sum - 0.75).abs() < 1e-15, "{sum}");
        }
    }
}
