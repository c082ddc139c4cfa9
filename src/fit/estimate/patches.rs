//! Patches of a dense cloud: means of the points of small regions stand for them.
//!
//! A mean over a patch is biased by slope and curvature inside it. One correction removes that: the patch
//! means of the residuals against a first estimate are added to what it says at the patches. These means are taken over
//! six places with the mean and the covariance of the patch's points: they are those over all points but for fourth
//! derivatives, and for how far the points of a patch lean to one side.

use crate::fit::prepare::Sample;
use crate::sphere::CubeCell;
use crate::spread::{covariance, median, robust_deviation};
use nalgebra::{Matrix3, Vector3};

/// Clouds up to this size are used point by point.
pub(crate) const WHOLE_CLOUD: usize = 30_000;

/// Patches along an edge of the cube: 6 x 64^2 = 24 576 in all.
const PER_EDGE: u16 = 64;

/// Points of a patch that stand apart from its median radius by more than this many standard deviations
/// are left out, ...
const DEVIATIONS: f64 = 6.0;

/// ... if they also do by this share of the radius.
const LEAST: f64 = 0.01;

/// Points that it takes to tell.
const FEWEST: usize = 8;

/// Places that stand for the points of a patch; fewer points stand for themselves.
const PLACES: usize = 6;

/// A cloud in patches.
pub(crate) struct Patches {
    /// Mean direction and radius per patch that holds points.
    pub(crate) means: Vec<Sample>,
    /// Points per patch.
    pub(crate) counts: Vec<f64>,
    /// Points left out.
    pub(crate) left_out: usize,
    places: Vec<Sample>,
    /// Places of a patch begin where those of the one before end.
    ends: Vec<usize>,
}

impl Patches {
    /// Gathers samples in patches.
    pub(crate) fn new(samples: &[Sample]) -> Self {
        let cells = 6 * usize::from(PER_EDGE).pow(2);
        let place: Vec<u32> = samples
            .iter()
            .map(|&[x, y, z, _]| CubeCell::position(PER_EDGE, &Vector3::new(x, y, z)) as u32)
            .collect();
        let mut starts = vec![0_usize; cells + 1];
        for &cell in &place {
            starts[cell as usize + 1] += 1;
        }
        for cell in 0..cells {
            starts[cell + 1] += starts[cell];
        }
        let mut members = vec![0_u32; samples.len()];
        let mut next = starts.clone();
        for (index, &cell) in place.iter().enumerate() {
            members[next[cell as usize]] = index as u32;
            next[cell as usize] += 1;
        }
        let mut patches = Self {
            means: Vec::new(),
            counts: Vec::new(),
            left_out: 0,
            places: Vec::new(),
            ends: Vec::new(),
        };
        for pair in starts.windows(2).filter(|pair| pair[0] < pair[1]) {
            patches.add(samples, &members[pair[0]..pair[1]]);
        }
        patches
    }

    fn add(&mut self, samples: &[Sample], members: &[u32]) {
        let mut radii: Vec<f64> = members.iter().map(|&i| samples[i as usize][3]).collect();
        let middle = median(&mut radii).unwrap_or(0.0);
        let limit = if members.len() < FEWEST {
            f64::INFINITY
        } else {
            let spread = robust_deviation(radii.iter().map(|r| r - middle));
            (DEVIATIONS * spread).max(LEAST * middle)
        };
        let kept = members.iter().map(|&index| samples[index as usize]);
        let kept: Vec<Sample> = kept.filter(|[.., r]| (r - middle).abs() <= limit).collect();
        let (mut direction, mut radius) = (Vector3::zeros(), 0.0);
        for &[x, y, z, r] in &kept {
            direction += Vector3::new(x, y, z);
            radius += r;
        }
        let n = direction.normalize();
        self.means.push([n.x, n.y, n.z, radius / kept.len() as f64]);
        self.counts.push(kept.len() as f64);
        self.left_out += members.len() - kept.len();
        match kept.len() <= PLACES {
            true => self.places.extend(kept),
            false => self.places.extend(places(&kept)),
        }
        self.ends.push(self.places.len());
    }

    /// Means, over the points of each patch, of a function of samples, given many at once.
    pub(crate) fn means_of(&self, function: impl FnOnce(&[Sample]) -> Vec<f64>) -> Vec<f64> {
        let values = function(&self.places);
        let mut start = 0;
        let mean = |&end: &usize| {
            let of_patch = &values[start..end];
            start = end;
            of_patch.iter().sum::<f64>() / of_patch.len() as f64
        };
        self.ends.iter().map(mean).collect()
    }
}

/// Places with the mean and the covariance of some samples as points: from the mean, up and down the columns of the
/// covariance's Cholesky factor.
fn places(samples: &[Sample]) -> [Sample; PLACES] {
    let point = |[x, y, z, r]: &Sample| Vector3::new(*x, *y, *z) * *r;
    let (mean, covariance) = covariance(samples.iter().map(point));
    let columns = factor(covariance * 3.0);
    std::array::from_fn(|i| {
        let column = columns.column(i / 2);
        let place = mean + column * [1.0, -1.0][i % 2];
        let radius = place.norm();
        let n = place / radius;
        [n.x, n.y, n.z, radius]
    })
}

/// The Cholesky factor of a covariance, which may be singular.
fn factor(mut rest: Matrix3<f64>) -> Matrix3<f64> {
    let mut factor = Matrix3::zeros();
    for i in 0..3 {
        let pivot = rest[(i, i)];
        if pivot > 0.0 {
            let column = rest.column(i) / pivot.sqrt();
            rest -= column * column.transpose();
            factor.set_column(i, &column);
        }
    }
    factor
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shapes::Sampling;

    /// An ellipsoid of 300 000 points, rough by a wave.
    fn samples() -> Vec<Sample> {
        let directions = Sampling::Fibonacci.directions(300_000, 0).unwrap();
        let axes = Vector3::new(2.0, 1.5, 1.0);
        let radius =
            |n: &Vector3<f64>| (1.0 + 0.001 * (40.0 * n.x).sin()) / n.component_div(&axes).norm();
        directions
            .iter()
            .map(|n| [n.x, n.y, n.z, radius(n)])
            .collect()
    }

    /// A function of place of the second degree has the same mean over a patch's places as over its points.
    #[test]
    fn places_stand_for_points_to_the_second_degree() {
        let samples = samples();
        let patches = Patches::new(&samples);
        let of_places = |function: fn(&Sample) -> f64| {
            patches.means_of(|places| places.iter().map(function).collect())
        };
        let total = |means: Vec<f64>| -> f64 {
            means
                .iter()
                .zip(&patches.counts)
                .map(|(mean, count)| mean * count)
                .sum()
        };
        let second =
            |&[x, y, z, r]: &Sample| r * r * (x * x - 0.3 * y * z) + r * (y - 2.0 * x) + 0.1;
        let exact: f64 = samples.iter().map(second).sum();
        let found = total(of_places(second));
        assert!((found / exact - 1.0).abs() < 1e-12, "{found} {exact}");
        // Of the tenth degree over patches of 1.4 degrees.
        let tenth = |&[x, _, z, r]: &Sample| r * (x * x - z * z).powi(5);
        let exact: f64 = samples.iter().map(|sample| tenth(sample).abs()).sum();
        let off = total(of_places(tenth)) - samples.iter().map(tenth).sum::<f64>();
        assert!((off / exact).abs() < 1e-6, "{off} {exact}");
        assert!(patches.counts.iter().any(|&count| count > PLACES as f64));
        assert_eq!(patches.left_out, 0);
    }
}
