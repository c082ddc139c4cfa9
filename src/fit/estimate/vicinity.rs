//! By how much an end of an extent lies off the smooth surface through the points nearest to it.
//!
//! Where a groove is finer than the points tell, the surface ripples between them, on the other side of the grain too, and yet goes
//! through them all: of coffee beans whose thickness was 1 to 8 % too large by that, polynomials through ten and sixteen points round each
//! end tell so. Over noise, and next to edges, they tell nothing: there they are themselves off the points by as much.

use super::cloud::Cloud;
use crate::fit::points::quadric::at_centre;
use crate::sphere::across;
use nalgebra::Vector3;

/// Points that tell what is smooth round an end: where a groove is near, the fewer.
const NEAREST: [usize; 2] = [10, MOST];
const MOST: usize = 16;

/// By how much a place lies off the polynomial of second degree through the points nearest to it, along a unit vector, beyond what that
/// leaves open. In the stretched space, in units of the mean.
pub(super) fn off_smooth(cloud: &Cloud, place: &Vector3<f64>, towards: &Vector3<f64>) -> f64 {
    let near = nearest(cloud, place);
    let reach = near.last().map_or(1.0, |offset| offset.norm());
    let aside = across(towards);
    let seen = |offset: &Vector3<f64>| {
        let [x, y] = aside.map(|axis| axis.dot(offset) / reach);
        [x, y, towards.dot(offset)]
    };
    let places: Vec<[f64; 3]> = near.iter().map(seen).collect();
    let offs = NEAREST.map(|count| {
        let height = at_centre(&places[..count.min(places.len())]);
        height.map_or(0.0, |height| height.value.abs() - height.error)
    });
    offs.into_iter().fold(0.0, f64::max)
}

/// The [`MOST`] points nearest to a place, nearest first, from it.
fn nearest(cloud: &Cloud, place: &Vector3<f64>) -> Vec<Vector3<f64>> {
    let mut found: Vec<(f64, Vector3<f64>)> = Vec::with_capacity(MOST + 1);
    for (n, radius) in cloud.directions.iter().zip(&cloud.radii) {
        let offset = n * *radius - place;
        let square = offset.norm_squared();
        let at = found.partition_point(|(nearer, _)| *nearer <= square);
        if at < MOST {
            found.insert(at, (square, offset));
            found.truncate(MOST);
        }
    }
    found.into_iter().map(|(_, offset)| offset).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shapes::Sampling;

    /// An egg of which every other point is moved by so much outwards.
    fn egg(moved: f64) -> Cloud {
        let directions = Sampling::Fibonacci.directions(2000, 0).unwrap();
        let samples: Vec<_> = directions
            .iter()
            .enumerate()
            .map(|(at, n)| {
                let sign = if at % 2 == 0 { moved } else { -moved };
                [n.x, n.y, n.z, 1.0 + 0.2 * n.z * n.z + sign]
            })
            .collect();
        let even = Vector3::repeat(1.0);
        Cloud::new(&samples, None, even, even)
    }

    #[test]
    fn a_place_is_off_by_what_it_lies_above_or_below_its_neighbours() {
        let cloud = egg(0.0);
        let tip = Vector3::z() * 1.2 / cloud.mean;
        assert!(off_smooth(&cloud, &tip, &Vector3::z()) < 1e-3);
        for height in [0.1, -0.1] {
            let off = off_smooth(&cloud, &(tip + Vector3::z() * height), &Vector3::z());
            assert!((off - 0.1).abs() < 2e-3, "{off}");
        }
    }

    #[test]
    fn what_noise_explains_is_not_off() {
        let cloud = egg(0.02);
        let tip = Vector3::z() * 1.2 / cloud.mean;
        assert_eq!(
            off_smooth(&cloud, &(tip + Vector3::z() * 0.015), &Vector3::z()),
            0.0
        );
        let off = off_smooth(&cloud, &(tip + Vector3::z() * 0.1), &Vector3::z());
        assert!((0.06..0.09).contains(&off), "{off}");
    }
}
