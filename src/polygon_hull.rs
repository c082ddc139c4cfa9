//! The convex hull of points in the plane.

use crate::predicates::orient2d;
use nalgebra::Vector2;

/// The corners of the convex hull of finite points, counter-clockwise and no three of them on one line: by the monotone
/// chain (Andrew 1979) on an exact predicate, in O(n log n). Fewer than three where the points span no area.
pub(crate) fn polygon_hull(mut points: Vec<Vector2<f64>>) -> Vec<Vector2<f64>> {
    points.sort_unstable_by(|p, q| p.x.total_cmp(&q.x).then(p.y.total_cmp(&q.y)));
    points.dedup();
    if points.len() < 3 {
        return points;
    }
    let mut corners: Vec<Vector2<f64>> = Vec::with_capacity(points.len() + 1);
    let mut append = |start: usize, point: &Vector2<f64>| {
        while let [.., p, q] = corners[start..]
            && orient2d([p, q, *point]) <= 0.0
        {
            corners.pop();
        }
        corners.push(*point);
        corners.len()
    };
    let mut lower = 0;
    for point in &points {
        lower = append(0, point);
    }
    for point in points.iter().rev().skip(1) {
        append(lower - 1, point);
    }
    corners.pop();
    corners
}
