//! The convex hull of points in the plane, and what is measured on it with calipers.

use crate::polygon_hull::{hull_area, polygon_hull};
use nalgebra::Vector2;

/// A convex polygon, its corners counter-clockwise and no three of them on one line. It may be a point
/// or a segment, or empty.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct ConvexPolygon {
    corners: Vec<Vector2<f64>>,
}

/// A rectangle round a polygon.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Rectangle {
    /// Unit vector along one side.
    pub(super) axis: Vector2<f64>,
    pub(super) area: f64,
}

/// An edge, by its first corner, and the corners that are farthest along it, across it and back.
#[derive(Clone, Copy)]
struct Grip {
    edge: usize,
    right: usize,
    top: usize,
    left: usize,
}

impl ConvexPolygon {
    /// The convex hull of finite points.
    pub(super) fn hull_of(points: Vec<Vector2<f64>>) -> Self {
        let corners = polygon_hull(points);
        Self { corners }
    }

    pub(super) fn area(&self) -> f64 {
        hull_area(&self.corners)
    }

    /// Length of the border; of a segment, twice its length.
    pub(super) fn perimeter(&self) -> f64 {
        self.edges().map(|edge| edge.norm()).sum()
    }

    /// Largest distance between two corners.
    pub(super) fn largest_feret(&self) -> f64 {
        let ends = self
            .calipers()
            .flat_map(|grip| [(grip.edge, grip), (grip.edge + 1, grip)]);
        ends.map(|(end, grip)| (self.at(end) - self.at(grip.top)).norm())
            .fold(0.0, f64::max)
    }

    /// Smallest distance between two parallel lines with the polygon between them: one of them is
    /// along an edge.
    pub(super) fn smallest_feret(&self) -> f64 {
        let widths = self.calipers().map(|grip| {
            let edge = self.edge(grip.edge);
            edge.perp(&(self.at(grip.top) - self.at(grip.edge))) / edge.norm()
        });
        widths.reduce(f64::min).unwrap_or(0.0)
    }

    /// The rectangle of least area that holds the polygon: one side is along an edge (Freeman and
    /// Shapira 1975). `None` if there are fewer than two corners.
    pub(super) fn least_rectangle(&self) -> Option<Rectangle> {
        let rectangles = self.calipers().map(|grip| {
            let edge = self.edge(grip.edge);
            let along = edge.dot(&(self.at(grip.right) - self.at(grip.left)));
            let across = edge.perp(&(self.at(grip.top) - self.at(grip.edge)));
            (edge, along * across / edge.norm_squared())
        });
        let (edge, area) = rectangles.min_by(|a, b| a.1.total_cmp(&b.1))?;
        Some(Rectangle {
            axis: edge.normalize(),
            area,
        })
    }

    /// The rotating calipers (Shamos 1978, Toussaint 1983): for each edge the corners that are farthest
    /// along it, across it and back, in O(n) for all.
    fn calipers(&self) -> impl Iterator<Item = Grip> {
        let (mut right, mut top, mut left) = (0, 0, 0);
        self.edges().enumerate().map(move |(index, edge)| {
            right = right.max(index);
            while edge.dot(&self.edge(right)) > 0.0 {
                right += 1;
            }
            top = top.max(right);
            while edge.perp(&self.edge(top)) > 0.0 {
                top += 1;
            }
            left = left.max(top);
            while edge.dot(&self.edge(left)) < 0.0 {
                left += 1;
            }
            Grip {
                edge: index,
                right,
                top,
                left,
            }
        })
    }

    /// A corner; numbers go on round the polygon.
    fn at(&self, corner: usize) -> Vector2<f64> {
        let n = self.corners.len();
        self.corners[if corner < n { corner } else { corner % n }]
    }

    /// The edge from a corner to the next.
    fn edge(&self, corner: usize) -> Vector2<f64> {
        self.at(corner + 1) - self.at(corner)
    }

    /// The edges from each corner to the next; none of a point.
    fn edges(&self) -> impl Iterator<Item = Vector2<f64>> {
        let n = self.corners.len();
        (0..if n > 1 { n } else { 0 }).map(|corner| self.edge(corner))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;
    use nalgebra::Rotation2;
    use proptest::prelude::*;

    fn hull(points: &[[f64; 2]]) -> ConvexPolygon {
        ConvexPolygon::hull_of(points.iter().map(|p| Vector2::from(*p)).collect())
    }

    #[test]
    fn a_rectangle_with_points_on_and_inside_it_has_its_closed_forms() {
        let lattice: Vec<_> = (0..20).map(|i| [(i % 5) as f64, (i / 5) as f64]).collect();
        let hull = hull(&lattice);
        assert_eq!(hull.corners.len(), 4);
        assert_eq!(hull.area(), 12.0);
        assert_eq!(hull.perimeter(), 14.0);
        assert_eq!(hull.largest_feret(), 5.0);
        assert_eq!(hull.smallest_feret(), 3.0);
        assert_eq!(hull.least_rectangle().unwrap().area, 12.0);
    }

    #[test]
    fn points_and_segments_have_no_area() {
        for (points, length) in [
            (vec![], 0.0),
            (vec![[1.0, 2.0]], 0.0),
            (vec![[1.0, 2.0]; 60], 0.0),
            (vec![[0.0, 0.0], [3.0, 4.0]], 5.0),
            (vec![[0.0, 0.0], [6.0, 8.0], [3.0, 4.0]], 10.0),
        ] {
            let hull = hull(&points);
            assert_eq!(hull.area(), 0.0);
            assert_eq!(hull.smallest_feret(), 0.0);
            assert_eq!(hull.largest_feret(), length);
            assert_eq!(hull.perimeter(), 2.0 * length);
            assert!(hull.least_rectangle().is_none_or(|least| least.area == 0.0));
        }
    }

    proptest! {
        #[test]
        fn calipers_find_what_trying_all_corners_finds(
            points in prop::collection::vec(prop::array::uniform2(-6..6_i32), 3..120),
            angle in -3.0..3.0_f64,
        ) {
            let turn = Rotation2::new(angle);
            let points: Vec<_> = points
                .into_iter()
                .map(|p| turn * Vector2::from(p.map(f64::from)))
                .collect();
            let hull = ConvexPolygon::hull_of(points.clone());
            let spread = |axis: &Vector2<f64>| {
                let places = || points.iter().map(|p| axis.dot(p));
                places().fold(f64::MIN, f64::max) - places().fold(f64::MAX, f64::min)
            };
            let pairs = || points.iter().flat_map(|p| points.iter().map(move |q| q - p));
            let farthest = pairs().map(|d| d.norm()).fold(0.0, f64::max);
            assert_relative_eq!(hull.largest_feret(), farthest, epsilon = 1e-12);

            let axes = || hull.edges().map(|edge| edge.normalize());
            let across = |axis: Vector2<f64>| spread(&Vector2::new(-axis.y, axis.x));
            let width = axes().map(across).fold(f64::MAX, f64::min);
            let area = axes().map(|a| across(a) * spread(&a)).fold(f64::MAX, f64::min);
            if hull.corners.len() > 2 {
                assert_relative_eq!(hull.smallest_feret(), width, epsilon = 1e-12);
                assert_relative_eq!(hull.least_rectangle().unwrap().area, area, epsilon = 1e-12);
            }
        }
    }
}
