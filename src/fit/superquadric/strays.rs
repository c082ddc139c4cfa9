//! Points that are astray: far from the body, and far from what their neighbours are off it.
//!
//! Nearly least squares follow them, and the loss that leaves them out is taken only where half of the points come much nearer
//! by it, which noise hides: of twenty bodies in noise of 2 %, with a tenth of all points strewn about, volumes were up to 4 %
//! too large, 3 standard errors as a root mean square. What a body misses of a grain its neighbours are off as well.

use super::bodies::Body;
use super::cloud::Cloud;
use super::least_squares::ROUNDING;
use super::normal_equations::distances;
use crate::fit::points::neighbours::Neighbours;
use crate::spread::{robust_deviation, upper_median};
use nalgebra::Vector3;

/// Neighbours by direction from the middle of the cloud.
const NEIGHBOURS: usize = 16;

/// Standard deviations by which strays are off at least, of all points and of their neighbours, told by the medians. Of these
/// because most of an egg or a kernel may be a superquadric all but exactly, and its tip is none.
const FAR: f64 = 4.0;

/// Fewer points than this share of all do little.
const LEAST_SHARE: f64 = 0.02;

/// Which points of a cloud are astray, in its order; `None` if next to none are.
pub(super) fn strays(cloud: &Cloud, bodies: &[Body]) -> Option<Vec<bool>> {
    let off = distances(bodies, &cloud.points);
    let limit = (FAR * robust_deviation(off.iter().copied())).max(ROUNDING);
    let least = LEAST_SHARE * off.len() as f64;
    let far = off.iter().filter(|off| off.abs() > limit).count();
    if (far as f64) < least {
        return None;
    }
    let directions: Vec<Vector3<f64>> = cloud
        .points
        .iter()
        .map(|point| point.try_normalize(0.0).unwrap_or_default())
        .collect();
    let neighbours = Neighbours::new(&directions);
    let is_stray = |at: usize| {
        off[at].abs() > limit && {
            let near = neighbours.nearest(&directions[at], NEIGHBOURS);
            let mut near: Vec<f64> = near.into_iter().map(|other| off[other]).collect();
            let middle = upper_median(&mut near).unwrap_or(0.0);
            let scatter = robust_deviation(near.into_iter().map(|other| other - middle));
            (off[at] - middle).abs() > limit.max(FAR * scatter)
        }
    };
    let strays: Vec<bool> = (0..off.len()).map(is_stray).collect();
    let count = strays.iter().filter(|is_stray| **is_stray).count();
    (count as f64 >= least).then_some(strays)
}

#[cfg(test)]
mod tests {
    use super::super::form::Form;
    use super::super::search::best;
    use super::super::single::fit_superquadric;
    use super::*;
    use crate::fit::Context;
    use crate::model::{StarSurface, Superquadric};
    use crate::shapes::Sampling;
    use nalgebra::Point3;

    #[test]
    fn the_rounding_of_exact_points_is_not_astray() {
        let block = Superquadric::single([2.0, 2.0, 1.0], 20.0, 20.0).unwrap();
        let directions = Sampling::Cube.directions(386, 0).unwrap().into_iter();
        let points: Vec<_> = directions
            .map(|n| Point3::from(n * block.radius(&n)))
            .collect();
        let found = fit_superquadric(&points, None, Form::Single, &Context::default()).unwrap();
        assert_eq!(found.strays, 0);
    }

    #[test]
    fn points_strewn_about_a_ball_are_astray_and_its_beak_is_not() {
        let ball = Sampling::Fibonacci.directions(3000, 0).unwrap();
        let noise = (0..).map(|i| 0.004 * ((f64::from(i) * 0.618_033_989).fract() - 0.5));
        let noisy = ball.into_iter().zip(noise).map(|(n, off)| n * (1.0 + off));
        let ball: Vec<Point3<f64>> = noisy.map(Point3::from).collect();
        let cloud = Cloud::new(&ball, None, Form::Single.parameters()).unwrap();
        let found = best(&cloud, Form::Single, &Context::default()).unwrap();
        assert_eq!(strays(&cloud, &found.bodies), None);
        let mut beaked = cloud.clone();
        for point in &mut beaked.points {
            let inside = 1.0 - point.angle(&Vector3::x()) / 0.5;
            *point *= 1.0 + 0.6 * inside.max(0.0).powi(2);
        }
        assert_eq!(strays(&beaked, &found.bodies), None);
        let mut strewn = cloud;
        for point in strewn.points.iter_mut().step_by(20) {
            *point *= 1.3;
        }
        let told = strays(&strewn, &found.bodies).unwrap();
        assert!(
            told.iter()
                .enumerate()
                .all(|(at, is_stray)| *is_stray == (at % 20 == 0))
        );
    }
}
