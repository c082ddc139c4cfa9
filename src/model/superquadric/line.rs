//! Where straight lines go in and out of a union, and how much of it its origin does not see.

use super::{MultiSuperquadric, Part};
use crate::sphere::cube_grid;
use nalgebra::Vector3;

/// Steps allowed on the way to a part; Newton's iteration on a convex function takes fewer than ten.
const MAX_STEPS: usize = 100;

/// Cells along an edge of the cube of directions in which the origin looks round.
const LOOKS: usize = 24;

/// A gap along a line that is a smaller share of its length is none.
const NO_GAP: f64 = 1e-9;

impl Part {
    /// How far from a point along the unit vector `n` a line leaves the part for good; `None` where it does not meet it.
    pub(super) fn exit(&self, from: &Vector3<f64>, n: &Vector3<f64>) -> Option<f64> {
        let along = self.frame.axes.tr_mul(n);
        let from = self.frame.axes.tr_mul(&(from - self.frame.centre.coords));
        let reach = self.shape.bounding_radius();
        // Past the far side the gauge rises along the line, convex, and Newton's iteration comes from there one way.
        let mut t = -from.dot(&along) + reach;
        for _ in 0..MAX_STEPS {
            let (gauge, slope) = self.shape.gauge_and_slope(&(from + along * t));
            let rise = slope.dot(&along);
            if rise <= 0.0 {
                return None;
            }
            let step = (gauge - 1.0) / rise;
            t -= step;
            if step <= 1e-15 * t.abs().max(reach) {
                return Some(t);
            }
        }
        None
    }

    /// Where the line goes in, and where it leaves.
    fn crossed(&self, from: &Vector3<f64>, n: &Vector3<f64>) -> Option<[f64; 2]> {
        let to_centre = self.frame.centre.coords - from;
        let aside = (to_centre - n * to_centre.dot(n)).norm();
        if aside > self.shape.bounding_radius() {
            return None;
        }
        Some([-self.exit(from, &-n)?, self.exit(from, n)?])
    }
}

impl MultiSuperquadric {
    /// The spans of the line from a point along the unit vector `n` that lie in the union, from both sides of the point,
    /// in order and apart.
    pub(super) fn spans(&self, from: &Vector3<f64>, n: &Vector3<f64>) -> Vec<[f64; 2]> {
        let crossed = self.parts().iter().filter_map(|part| part.crossed(from, n));
        let mut crossed: Vec<[f64; 2]> = crossed.collect();
        crossed.sort_by(|p, q| p[0].total_cmp(&q[0]));
        let mut spans: Vec<[f64; 2]> = Vec::new();
        for [start, end] in crossed {
            match spans.last_mut() {
                Some(last) if start <= last[1] + NO_GAP * (last[1] - last[0]) => {
                    last[1] = last[1].max(end);
                }
                _ => spans.push([start, end]),
            }
        }
        spans
    }

    /// Whether the whole way from one point to another lies in the union.
    pub(crate) fn holds_way(&self, from: &Vector3<f64>, to: &Vector3<f64>) -> bool {
        let way = to - from;
        let length = way.norm();
        let Some(n) = way.try_normalize(0.0) else {
            return self.gauge(from) <= 1.0;
        };
        let spans = self.spans(from, &n);
        spans
            .iter()
            .any(|[start, end]| *start <= 0.0 && *end >= length)
    }

    /// Share of the directions in which a ray from the origin leaves the union and meets it again: what lies there is
    /// hidden, and the surface is no radius.
    pub(super) fn hidden_share(&self) -> f64 {
        if self.parts().len() == 1 {
            return 0.0;
        }
        let (directions, _) = cube_grid(LOOKS);
        let is_hidden = |n: &&Vector3<f64>| {
            let spans = self.spans(&Vector3::zeros(), n);
            spans.iter().filter(|span| span[1] > 0.0).count() > 1
        };
        directions.iter().filter(is_hidden).count() as f64 / directions.len() as f64
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::{Frame, Superquadric};
    use approx::assert_relative_eq;
    use nalgebra::Point3;

    /// Places of balls along x, and then along y.
    const ELBOW: [[f64; 3]; 5] = [
        [0.0; 3],
        [1.5, 0.0, 0.0],
        [3.0, 0.0, 0.0],
        [3.0, 1.5, 0.0],
        [3.0, 3.0, 0.0],
    ];

    /// Balls of radius 1 at these places.
    fn balls(places: &[[f64; 3]]) -> MultiSuperquadric {
        let parts = places.iter().map(|place| Part {
            shape: Superquadric::single([1.0; 3], 2.0, 2.0).unwrap(),
            frame: Frame {
                centre: Point3::from(*place),
                ..Frame::SCAN
            },
        });
        MultiSuperquadric::new(parts.collect()).unwrap()
    }

    #[test]
    fn a_line_lies_in_a_union_in_spans() {
        let union = balls(&ELBOW);
        let along = union.spans(&Vector3::zeros(), &Vector3::x());
        assert_eq!(along.len(), 1);
        assert_relative_eq!(along[0][0], -1.0, epsilon = 1e-12);
        assert_relative_eq!(along[0][1], 4.0, epsilon = 1e-12);
        let across = union.spans(&Vector3::new(0.0, 2.0, 0.0), &Vector3::x());
        assert_eq!(across.len(), 1);
        assert!(across[0][0] > 2.0);
        let past = union.spans(&Vector3::new(0.0, 0.0, 1.5), &Vector3::x());
        assert!(past.is_empty());
    }

    #[test]
    fn an_elbow_is_hidden_from_its_end_and_seen_from_its_corner() {
        let hidden = balls(&ELBOW).hidden_share();
        assert!((0.01..0.2).contains(&hidden), "{hidden}");
        let seen = balls(&[[0.0; 3], [1.2, 0.0, 0.0], [0.0, 1.2, 0.0]]);
        assert_eq!(seen.hidden_share(), 0.0);
    }
}
