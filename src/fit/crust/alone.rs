//! Points that stand alone beside a surface, as scanners strew them: a crust that reaches out to them is closed round nothing.

use super::cloud::spacings;
use crate::spread::upper_median;
use nalgebra::Point3;

/// Their neighbours are so many times as far off as those of the others are, which is told by the median. Along a stalk, or on a
/// second body, that is scanned 12 to 20 times as sparsely they are 3.5 to 4.5 times as far off.
const ALONE: f64 = 4.5;

/// More of them than this share are a part that is scanned sparsely.
const MOST: f64 = 0.05;

/// The points that do not stand alone; `None` if all or too few do not.
pub(in crate::fit) fn without_alone(points: &[Point3<f64>]) -> Option<Vec<Point3<f64>>> {
    let spacings = spacings(points);
    let limit = ALONE * upper_median(&mut spacings.clone())?;
    let kept = points.iter().zip(spacings);
    let kept: Vec<Point3<f64>> = kept
        .filter(|(_, spacing)| *spacing <= limit)
        .map(|(point, _)| *point)
        .collect();
    let left_out = points.len() - kept.len();
    (left_out > 0 && left_out as f64 <= MOST * points.len() as f64).then_some(kept)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shapes::Sampling;
    use nalgebra::Vector3;

    fn with_strays(strays: usize) -> Vec<Point3<f64>> {
        let ball = Sampling::Random.directions(4000, 0).unwrap();
        let beside = Sampling::Random.directions(strays, 1).unwrap();
        let beside = (0..)
            .zip(beside)
            .map(|(i, n): (i32, Vector3<f64>)| n * (1.6 + 0.5 * f64::from(i % 7)));
        ball.into_iter().chain(beside).map(Point3::from).collect()
    }

    #[test]
    fn strays_stand_alone_and_no_point_of_a_ball_does() {
        let kept = without_alone(&with_strays(80)).unwrap();
        assert!(kept.iter().all(|point| point.coords.norm() < 1.1));
        assert!(kept.len() > 3990, "{}", kept.len());
        // Nor is a tenth of the points astray.
        assert_eq!(without_alone(&with_strays(400)), None);
    }
}
