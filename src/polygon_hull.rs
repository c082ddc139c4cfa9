//! The convex hull of points in the plane.

use crate::predicates::orient2d;
use nalgebra::Vector2;

/// So many points are not worth a look at which of them are inside.
const FEW: usize = 50;

/// Share of the squared size by which a point must be inside to be left out: far more than rounding.
const INSIDE: f64 = 1e-12;

/// The corners of the convex hull of finite points, counter-clockwise and no three of them on one line: by the monotone
/// chain (Andrew 1979) on an exact predicate, in O(n log n). Fewer than three where the points span no area.
pub(crate) fn polygon_hull(points: Vec<Vector2<f64>>) -> Vec<Vector2<f64>> {
    let mut points = outer(points);
    points.sort_unstable_by(|p, q| p.x.total_cmp(&q.x).then_with(|| p.y.total_cmp(&q.y)));
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

/// The area of a convex polygon, its corners counter-clockwise.
pub(crate) fn hull_area(corners: &[Vector2<f64>]) -> f64 {
    let Some(first) = corners.first() else {
        return 0.0;
    };
    let fan = corners.windows(2);
    fan.map(|edge| (edge[0] - first).perp(&(edge[1] - first)))
        .sum::<f64>()
        / 2.0
}

/// Of many points those that are not well inside the octagon of the ones farthest in eight directions (Akl and Toussaint
/// 1978).
fn outer(points: Vec<Vector2<f64>>) -> Vec<Vector2<f64>> {
    let Some(first) = points.first().filter(|_| points.len() > FEW) else {
        return points;
    };
    let mut farthest = [(f64::NEG_INFINITY, *first); 8];
    for p in &points {
        let (along, across) = (p.x + p.y, p.y - p.x);
        let heights = [p.x, along, p.y, across, -p.x, -along, -p.y, -across];
        for (far, height) in farthest.iter_mut().zip(heights) {
            if height > far.0 {
                *far = (height, *p);
            }
        }
    }
    let corners = farthest.map(|far| far.1);
    let edges = std::array::from_fn::<_, 8, _>(|i| (corners[i], corners[(i + 1) % 8] - corners[i]));
    let size = (corners[4] - corners[0]).norm_squared() + (corners[6] - corners[2]).norm_squared();
    if size == 0.0 {
        return points;
    }
    let is_inside = |p: &Vector2<f64>| {
        edges.iter().all(|(corner, edge)| {
            edge.perp(&(p - corner)) > INSIDE * size || *edge == Vector2::zeros()
        })
    };
    points.into_iter().filter(|p| !is_inside(p)).collect()
}
