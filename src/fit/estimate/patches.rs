//! Patches of a dense cloud: means of the points of small regions stand for them.
//!
//! A mean over a patch is biased by slope and curvature inside it. One correction removes that: the patch
//! means of all points' residuals against a first estimate are added to what it says at the patches.

use crate::fit::prepare::Sample;
use crate::sphere::CubeCell;
use crate::spread::{median, robust_deviation};
use nalgebra::Vector3;

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

/// A cloud in patches.
pub(crate) struct Patches {
    /// Mean direction and radius per patch that holds points.
    pub(crate) means: Vec<Sample>,
    /// Points per patch.
    pub(crate) counts: Vec<f64>,
    /// The patch of every point; `None` of those left out.
    pub(crate) patch_of: Vec<Option<u32>>,
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
            patch_of: vec![None; samples.len()],
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
        let number = self.means.len() as u32;
        let (mut direction, mut radius, mut count) = (Vector3::zeros(), 0.0, 0.0);
        for &index in members {
            let [x, y, z, r] = samples[index as usize];
            if (r - middle).abs() <= limit {
                direction += Vector3::new(x, y, z);
                radius += r;
                count += 1.0;
                self.patch_of[index as usize] = Some(number);
            }
        }
        let n = direction.normalize();
        self.means.push([n.x, n.y, n.z, radius / count]);
        self.counts.push(count);
    }

    /// Points left out.
    pub(crate) fn left_out(&self) -> usize {
        self.patch_of.iter().filter(|patch| patch.is_none()).count()
    }
}
