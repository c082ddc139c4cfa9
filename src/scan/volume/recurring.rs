//! Directions from point to point that recur all over a cloud, as they do on a lattice.

use nalgebra::{Point3, Vector3};

/// Places of the cloud that are looked at, and points about each.
const PLACES: usize = 12;
const NEAR: usize = 32;

/// Differences between points this near, over how far these are from their place, are one.
const SAME: f64 = 2e-3;

/// A difference that is there as often in one place recurs: of points at random none is there twice.
const OFTEN: u16 = 5;

/// Cosine of directions that are one.
const PARALLEL: f64 = 0.9999;

/// Directions that recur, up to their sign, those of the nearest points first; none where points are at random.
pub(super) fn recurring(points: &[Point3<f64>]) -> Vec<Vector3<f64>> {
    let every = points.len().div_ceil(PLACES).max(1);
    let mut found: Vec<Vector3<f64>> = Vec::new();
    for place in points.iter().step_by(every) {
        let here = recurring_at(place, points);
        if here.is_empty() && found.is_empty() {
            break;
        }
        found.extend(here);
    }
    found.sort_by(|one, other| one.norm_squared().total_cmp(&other.norm_squared()));
    let mut directions: Vec<Vector3<f64>> = Vec::new();
    for difference in found {
        let own = difference.normalize();
        let is_new = |known: &Vector3<f64>| known.dot(&own).abs() < PARALLEL;
        if directions.iter().all(is_new) {
            directions.push(own);
        }
    }
    directions
}

/// The differences that recur among the points nearest to a place.
fn recurring_at(place: &Point3<f64>, points: &[Point3<f64>]) -> Vec<Vector3<f64>> {
    let mut near: Vec<Vector3<f64>> = points.iter().map(|point| point - place).collect();
    if near.len() > NEAR {
        near.select_nth_unstable_by(NEAR - 1, |one, other| {
            one.norm_squared().total_cmp(&other.norm_squared())
        });
        near.truncate(NEAR);
    }
    let reach = near.iter().map(Vector3::norm).fold(0.0, f64::max);
    let pairs = (0..near.len()).flat_map(|i| (0..i).map(move |j| (i, j)));
    let mut left: Vec<Vector3<f64>> = pairs.map(|(i, j)| near[i] - near[j]).collect();
    left.retain(|difference| difference.norm() > SAME * reach);
    let mut found = Vec::new();
    while let Some(first) = left.pop() {
        let (mut sum, mut count) = (first, 1_u16);
        left.retain(|other| {
            let other = other * first.dot(other).signum();
            let is_same = (other - first).norm() < SAME * reach;
            if is_same {
                sum += other;
                count += 1;
            }
            !is_same
        });
        if count >= OFTEN {
            found.push(sum / f64::from(count));
        }
    }
    found
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scan::volume::frames::frames;
    use nalgebra::Rotation3;
    use rand::SeedableRng;
    use rand_chacha::ChaCha8Rng;
    use rand_distr::{Distribution, UnitSphere};

    fn ball() -> Vec<Point3<f64>> {
        let mut random = ChaCha8Rng::seed_from_u64(1);
        let directions = (0..3000).map(|_| UnitSphere.sample(&mut random));
        directions
            .map(|n: [f64; 3]| Point3::from(n) * 9.0)
            .collect()
    }

    #[test]
    fn the_axes_of_a_turned_lattice_recur_and_nothing_does_at_random() {
        assert!(recurring(&ball()).is_empty());
        let sides = Vector3::new(1.0, 1.0, 2.5);
        let turn = Rotation3::from_euler_angles(0.4, 0.7, 1.3);
        let places = ball().into_iter().map(|point| {
            let place = point.coords.component_div(&sides).map(f64::round);
            turn * Point3::from(place.component_mul(&sides))
        });
        let mut places: Vec<Point3<f64>> = places.collect();
        places.sort_by(|one, other| {
            one.coords
                .as_slice()
                .partial_cmp(other.coords.as_slice())
                .unwrap()
        });
        places.dedup();
        let is_own = |frame: &nalgebra::Matrix3<f64>| {
            let cosines = frame.transpose() * turn.matrix();
            cosines
                .iter()
                .all(|x| x.abs() < 1e-6 || (x.abs() - 1.0).abs() < 1e-6)
        };
        assert!(frames(recurring(&places)).any(|frame| is_own(&frame)));
    }
}
