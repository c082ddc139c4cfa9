//! Sums over the points of bumps about an end, each of which is the square of the one before.

use super::super::cloud::Cloud;
use crate::vectorize::{self, vectorize};
use nalgebra::Vector3;

/// Points that are taken side by side: a processor waits less for one block of numbers where it has another.
const LANES: usize = 2 * vectorize::LANES;

/// Coefficients of exp(-v) by the powers of v - 1/2, over exp(-1/2): to 5e-13 for v from 0 to 1.
const TAYLOR: [f64; 12] = taylor();

/// How often exp(-|n - t|² / 4) is squared to half of the first bump.
const SQUARINGS: usize = 4;

/// Heights are held above this, whose square is still a normal number: others are slow.
const LEAST: f64 = 1e-40;

/// Points with their weights, and weighted residuals, component by component.
pub(super) struct Points {
    directions: [Vec<[f64; LANES]>; 3],
    weights: Vec<[f64; LANES]>,
    weighted: Vec<[f64; LANES]>,
}

/// Of a bump b, the sums of b w e and of w b².
pub(super) type BumpSums = [f64; 2];

impl Points {
    pub(super) fn new(cloud: &Cloud, residuals: &[f64]) -> Self {
        let weighted = cloud.weights.iter().zip(residuals).map(|(w, e)| w * e);
        Self {
            directions: [0, 1, 2]
                .map(|axis| vectorize::blocks(cloud.directions.iter().map(|n| n[axis]))),
            weights: vectorize::blocks(cloud.weights.iter().copied()),
            weighted: vectorize::blocks(weighted),
        }
    }

    /// Sums of the bumps exp(k (n.t - 1)) about the end t: of the first k is 8.
    pub(super) fn bumps<const N: usize>(&self, end: &Vector3<f64>) -> [BumpSums; N] {
        let mut sums = [[[0.0; LANES]; 2]; N];
        vectorize(
            #[inline(always)]
            || {
                let [x, y, z] = &self.directions;
                let points = x.iter().zip(y).zip(z.iter().zip(&self.weights));
                for (((x, y), (z, weight)), weighted) in points.zip(&self.weighted) {
                    let (mut beyond, mut heights) = ([0.0; LANES], [0.0; LANES]);
                    for i in 0..LANES {
                        let away = [x[i] - end.x, y[i] - end.y, z[i] - end.z];
                        let squared = away[0] * away[0] + away[1] * away[1] + away[2] * away[2];
                        beyond[i] = 0.25 * squared - 0.5;
                    }
                    for coefficient in TAYLOR {
                        for i in 0..LANES {
                            heights[i] = heights[i] * beyond[i] + coefficient;
                        }
                    }
                    for _ in 0..SQUARINGS {
                        heights = heights.map(
                            #[inline(always)]
                            |height| height * height,
                        );
                    }
                    for [of_residuals, of_squares] in &mut sums {
                        for i in 0..LANES {
                            of_residuals[i] += weighted[i] * heights[i];
                            let squared = heights[i] * heights[i];
                            heights[i] = if squared < LEAST { LEAST } else { squared };
                            of_squares[i] += weight[i] * heights[i];
                        }
                    }
                }
            },
        );
        sums.map(|of_bump| of_bump.map(|lanes| lanes.iter().sum()))
    }
}

/// Highest power first.
const fn taylor() -> [f64; 12] {
    let mut coefficients = [0.0; 12];
    let mut coefficient = 0.606_530_659_712_633_4;
    let mut power = 0;
    while power < coefficients.len() {
        coefficients[coefficients.len() - 1 - power] = coefficient;
        power += 1;
        coefficient *= -1.0 / power as f64;
    }
    coefficients
}

#[cfg(test)]
mod tests {
    use super::super::super::trial::fibonacci;
    use super::*;
    use approx::assert_relative_eq;

    #[test]
    fn they_are_those_of_exponentials() {
        let directions = fibonacci(203);
        let points: Vec<[f64; 4]> = directions.iter().map(|n| [n.x, n.y, n.z, 1.0]).collect();
        let mut cloud = Cloud::new(&points, None, Vector3::repeat(1.0), Vector3::repeat(1.0));
        for (i, weight) in cloud.weights.iter_mut().enumerate() {
            *weight *= 1.0 + 0.5 * (i as f64).sin();
        }
        let residuals: Vec<f64> = (0..203).map(|i| (0.7 * f64::from(i)).cos()).collect();
        let points = Points::new(&cloud, &residuals);
        for end in [directions[0], -directions[40], Vector3::y()] {
            let exact = |height: &dyn Fn(&Vector3<f64>) -> f64| {
                let mut sums = [0.0; 2];
                for ((n, w), e) in cloud.directions.iter().zip(&cloud.weights).zip(&residuals) {
                    let height = height(n);
                    sums[0] += height * w * e;
                    sums[1] += w * height * height;
                }
                sums
            };
            let check = |found: BumpSums, exact: BumpSums| {
                for (found, exact) in found.iter().zip(exact) {
                    assert_relative_eq!(*found, exact, max_relative = 1e-8, epsilon = 1e-9);
                }
            };
            for (at, found) in points.bumps::<6>(&end).into_iter().enumerate() {
                let k = 8.0 * f64::from(1 << at);
                check(found, exact(&|n| (k * (n.dot(&end) - 1.0)).exp()));
            }
        }
    }
}
