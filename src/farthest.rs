//! Which of many points lies farthest along a direction.

use crate::vectorize::{LANES, vectorize};
use nalgebra::Vector3;

/// Points, component by component, to be looked at side by side.
pub(crate) struct Farthest {
    points: [Vec<[f64; LANES]>; 3],
    count: usize,
}

impl Farthest {
    pub(crate) fn new(points: impl Iterator<Item = Vector3<f64>>) -> Self {
        let points: Vec<Vector3<f64>> = points.collect();
        let first = points.first().copied().unwrap_or_default();
        let component = |axis: usize| {
            let block = |points: &[Vector3<f64>]| {
                std::array::from_fn(|i| points.get(i).unwrap_or(&first)[axis])
            };
            points.chunks(LANES).map(block).collect()
        };
        Self {
            points: [0, 1, 2].map(component),
            count: points.len(),
        }
    }

    /// The number of the point that lies farthest along a vector, of points that are not all NaN.
    pub(crate) fn along(&self, towards: &Vector3<f64>) -> Option<usize> {
        let (mut highest, mut at) = ([f64::NEG_INFINITY; LANES], [0; LANES]);
        vectorize(
            #[inline(always)]
            || {
                let [x, y, z] = &self.points;
                for (block, ((x, y), z)) in x.iter().zip(y).zip(z).enumerate() {
                    for i in 0..LANES {
                        let height = x[i] * towards.x + y[i] * towards.y + z[i] * towards.z;
                        if height > highest[i] {
                            (highest[i], at[i]) = (height, block);
                        }
                    }
                }
            },
        );
        let lane = (0..LANES).max_by(|&i, &j| highest[i].total_cmp(&highest[j]))?;
        let found = at[lane] * LANES + lane;
        // Beyond the last one the first is repeated.
        match self.count {
            0 => None,
            count => Some(if found < count { found } else { 0 }),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shapes::Sampling;

    #[test]
    fn the_farthest_point_is_found_of_any_number_and_wherever_they_lie() {
        let offset = Vector3::new(-50.0, 20.0, 3.0);
        for count in [1, 2, LANES - 1, LANES, LANES + 1, 100] {
            let points = Sampling::Random.directions(100, 3).unwrap().into_iter();
            let points: Vec<_> = points.take(count).map(|n| n + offset).collect();
            let farthest = Farthest::new(points.iter().copied());
            for towards in Sampling::Fibonacci.directions(30, 0).unwrap() {
                let highest = points.iter().map(|p| p.dot(&towards));
                let highest = highest.fold(f64::NEG_INFINITY, f64::max);
                let found = farthest.along(&towards).unwrap();
                assert!((points[found].dot(&towards) - highest).abs() < 1e-12);
            }
        }
        assert_eq!(Farthest::new(std::iter::empty()).along(&Vector3::x()), None);
    }
}
