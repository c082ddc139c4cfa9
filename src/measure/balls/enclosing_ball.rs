//! The smallest ball that holds all points.

use nalgebra::{Matrix3, Point3, Vector3};
use thiserror::Error;

/// A ball.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Ball {
    /// Centre.
    pub centre: Point3<f64>,
    /// Radius.
    pub radius: f64,
}

/// Why points have no smallest ball.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Error)]
#[non_exhaustive]
pub enum EnclosingBallError {
    /// There are no points.
    #[error("there are no points")]
    NoPoints,
    /// A coordinate is NaN or infinite, or points are so far apart that their distance is.
    #[error("a coordinate is not finite")]
    NotFinite,
}

/// Farthest points taken in after which the search ends; 5 to 20 are usual.
const PIVOTS: usize = 1000;

/// How far outside a ball a point may lie and count as inside, relative to the radius.
const INSIDE: f64 = 1e-14;

/// The smallest ball that holds all points: two to four of them lie on its sphere and fix it.
///
/// By the pivoting rule of Gärtner 1999: the point that is farthest outside joins the few that carry
/// the ball, and the smallest ball round these is found by trying all subsets of them. The ball grows in
/// every round. Cost: a few passes over the points.
///
/// Error: the radius is the distance of the farthest point from the centre, so every point is inside to
/// rounding, and it is larger than the least by some 1e-14 of itself.
///
/// # Errors
///
/// See [`EnclosingBallError`].
pub fn enclosing_ball(points: &[Point3<f64>]) -> Result<Ball, EnclosingBallError> {
    let origin = *points.first().ok_or(EnclosingBallError::NoPoints)?;
    // A largest coordinate may pass over NaN.
    let mut coordinates = points.iter().flat_map(|point| point.iter());
    if !coordinates.all(|x| x.is_finite()) {
        return Err(EnclosingBallError::NotFinite);
    }
    let distances = points.iter().map(|point| (point - origin).amax());
    let size = distances.fold(0.0, f64::max);
    if !size.is_finite() {
        return Err(EnclosingBallError::NotFinite);
    }
    if size == 0.0 {
        return Ok(Ball {
            centre: origin,
            radius: 0.0,
        });
    }
    let offset = |point: &Point3<f64>| (point - origin) / size;
    let farthest = |centre: &Vector3<f64>| {
        points.iter().map(offset).fold((0.0, *centre), |far, p| {
            let squared = (p - centre).norm_squared();
            if squared > far.0 { (squared, p) } else { far }
        })
    };
    // The start does not depend on the order of the points: it is far from their mean.
    let mean = points.iter().map(offset).sum::<Vector3<f64>>() / points.len() as f64;
    let mut carriers = vec![farthest(&mean).1];
    let (mut centre, mut squared_radius) = (carriers[0], 0.0);
    for _ in 0..PIVOTS {
        let (squared, point) = farthest(&centre);
        if squared <= squared_radius * (1.0 + INSIDE) {
            break;
        }
        carriers.push(point);
        let Some((grown, squared, kept)) = ball_of_few(&carriers) else {
            break;
        };
        if squared <= squared_radius {
            break;
        }
        (centre, squared_radius, carriers) = (grown, squared, kept);
    }
    Ok(Ball {
        centre: origin + centre * size,
        radius: farthest(&centre).0.sqrt() * size,
    })
}

/// Centre, squared radius and carriers of the smallest ball round at most five points, the last of which
/// is on its sphere. `None` if rounding lets none be found.
fn ball_of_few(points: &[Vector3<f64>]) -> Option<(Vector3<f64>, f64, Vec<Vector3<f64>>)> {
    let (last, others) = points.split_last()?;
    (1..1_u32 << others.len())
        .filter_map(|chosen| {
            let others = others.iter().enumerate();
            let mut carriers: Vec<_> = others
                .filter(|(i, _)| chosen >> i & 1 == 1)
                .map(|(_, point)| *point)
                .collect();
            let centre =
                last + centre_through(&carriers.iter().map(|p| p - last).collect::<Vec<_>>())?;
            carriers.push(*last);
            let squared = (centre - last).norm_squared();
            let holds =
                |p: &Vector3<f64>| (p - centre).norm_squared() <= squared * (1.0 + 4.0 * INSIDE);
            points
                .iter()
                .all(holds)
                .then_some((centre, squared, carriers))
        })
        .min_by(|a, b| a.1.total_cmp(&b.1))
}

/// Centre of the smallest sphere through the origin and one to three points; `None` if they are not
/// independent or more than three.
fn centre_through(points: &[Vector3<f64>]) -> Option<Vector3<f64>> {
    // 2 p . c = |p|² for each point, and c in their span: with the cross product as third point of two.
    let rows = match *points {
        [p] => return Some(p / 2.0),
        [p, q] => [p, q, p.cross(&q)],
        [p, q, r] => [p, q, r],
        _ => return None,
    };
    let lengths = rows.map(|row| row.norm());
    if lengths.contains(&0.0) {
        return None;
    }
    let matrix = Matrix3::from_fn(|i, j| rows[i][j] / lengths[i]);
    let right = Vector3::from_fn(|i, _| {
        if i < points.len() {
            lengths[i] / 2.0
        } else {
            0.0
        }
    });
    let decomposed = matrix.full_piv_lu();
    let centre = decomposed.solve(&right)?;
    centre.iter().all(|c| c.is_finite()).then_some(centre)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shapes::{Body, Sampling};
    use approx::assert_relative_eq;
    use nalgebra::Rotation3;
    use proptest::prelude::*;

    fn ball(points: &[[f64; 3]]) -> Ball {
        enclosing_ball(&points.iter().map(|p| Point3::from(*p)).collect::<Vec<_>>()).unwrap()
    }

    #[test]
    fn simple_sets_have_their_closed_forms() {
        let single = ball(&[[1.0, 2.0, 3.0]; 4]);
        assert_eq!(
            single,
            Ball {
                centre: Point3::new(1.0, 2.0, 3.0),
                radius: 0.0
            }
        );
        let pair = ball(&[[1.0, 0.0, 0.0], [-1.0, 0.0, 0.0], [0.0, 0.5, 0.0]]);
        assert_relative_eq!(pair.radius, 1.0, epsilon = 1e-15);
        let acute = ball(&[
            [1.0, 0.0, 0.0],
            [-0.5, 0.75_f64.sqrt(), 0.0],
            [-0.5, -0.75_f64.sqrt(), 0.0],
        ]);
        assert_relative_eq!(acute.radius, 1.0, epsilon = 1e-14);
        let corners: Vec<_> = (0..8)
            .map(|i| [i & 1, i >> 1 & 1, i >> 2].map(f64::from))
            .collect();
        let cube = ball(&corners);
        assert_relative_eq!(cube.radius, 0.75_f64.sqrt(), epsilon = 1e-14);
        assert_relative_eq!(cube.centre, Point3::new(0.5, 0.5, 0.5), epsilon = 1e-14);
        let tetrahedron = [
            [1.0, 1.0, 1.0],
            [1.0, -1.0, -1.0],
            [-1.0, 1.0, -1.0],
            [-1.0, -1.0, 1.0],
        ];
        assert_relative_eq!(ball(&tetrahedron).radius, 3.0_f64.sqrt(), epsilon = 1e-14);
    }

    #[test]
    fn points_that_are_all_on_the_sphere_give_it() {
        for sampling in Sampling::ALL {
            let directions = sampling.directions(20_000, 5).unwrap();
            let points: Vec<_> = directions
                .iter()
                .map(|n| Point3::new(1.0, 2.0, 3.0) + n * 4.0)
                .collect();
            let found = enclosing_ball(&points).unwrap();
            assert_relative_eq!(found.radius, 4.0, epsilon = 1e-12);
            assert_relative_eq!(found.centre, Point3::new(1.0, 2.0, 3.0), epsilon = 1e-6);
        }
    }

    #[test]
    fn the_ball_of_an_ellipsoid_has_its_longest_axis() {
        let body = Body::Ellipsoid
            .with_axes(Vector3::new(3.0, 2.0, 1.0))
            .unwrap();
        let mut directions = Sampling::Fibonacci.directions(5000, 0).unwrap();
        directions.extend([Vector3::x(), -Vector3::x()]);
        let points: Vec<_> = directions
            .iter()
            .map(|n| Point3::from(n * body.radius(n)))
            .collect();
        assert_relative_eq!(
            enclosing_ball(&points).unwrap().radius,
            3.0,
            epsilon = 1e-12
        );
    }

    #[test]
    fn no_points_and_points_that_are_not_finite_are_refused() {
        assert_eq!(enclosing_ball(&[]), Err(EnclosingBallError::NoPoints));
        for bad in [f64::NAN, f64::INFINITY] {
            for place in 0..3 {
                let points = vec![Point3::new(1.0, 2.0, 3.0); 3];
                for axis in 0..3 {
                    let mut points = points.clone();
                    points[place][axis] = bad;
                    assert_eq!(enclosing_ball(&points), Err(EnclosingBallError::NotFinite));
                }
            }
        }
        let apart = [f64::MAX, -f64::MAX].map(|x| Point3::new(0.0, x, 0.0));
        assert_eq!(enclosing_ball(&apart), Err(EnclosingBallError::NotFinite));
    }

    proptest! {
        #[test]
        fn the_ball_holds_all_points_and_no_shift_of_it_can_be_smaller(
            points in prop::collection::vec(prop::array::uniform3(-3..4_i32), 1..40),
            angles in prop::array::uniform3(-3.0..3.0_f64),
            size in -40..40_i32,
        ) {
            let points: Vec<_> = points.iter().map(|p| Point3::from(p.map(f64::from))).collect();
            let found = enclosing_ball(&points).unwrap();
            let tolerance = 1e-12 * found.radius;
            for point in &points {
                prop_assert!((point - found.centre).norm() <= found.radius + tolerance);
            }
            // The distance to the farthest point is convex, so a local minimum is the least.
            for n in Sampling::Fibonacci.directions(200, 0).unwrap() {
                let centre = found.centre + n * (1e-3 * found.radius);
                let radius = points.iter().map(|p| (p - centre).norm()).fold(0.0, f64::max);
                prop_assert!(radius >= found.radius - tolerance);
            }
            let turn = Rotation3::from_euler_angles(angles[0], angles[1], angles[2]);
            let scale = 10.0_f64.powi(size);
            let shift = Vector3::new(1.0, -2.0, 3.0);
            let moved: Vec<_> = points.iter().rev().map(|p| (turn * p + shift) * scale).collect();
            let other = enclosing_ball(&moved).unwrap();
            assert_relative_eq!(other.radius, found.radius * scale, max_relative = 1e-12);
            let centre = (turn * found.centre + shift) * scale;
            prop_assert!((other.centre - centre).norm() <= 1e-6 * scale);
        }
    }
}
