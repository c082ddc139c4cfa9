//! A radius made of overlapping expansions, blended so that no seam is left.

use super::InvalidGrain;
use super::invalid::check_expansion;
use crate::sphere::{Cap, CapBasis, Cover, Jet};
use crate::vectorize::vectorize;
use nalgebra::Vector3;
use rayon::prelude::*;

/// r(n) = sum of w_i(n) f_i(n) / sum of w_i(n), with an expansion f_i in spherical harmonics and a
/// smooth weight w_i per cell of a [`Cover`]: continuous with two derivatives everywhere.
///
/// The weights are those of the cover: 1 in the middle of a cell, 0 beyond its margin. One evaluation
/// touches the expansions of the one to four cells near by (a few more where cells of different sizes
/// meet).
#[derive(Debug, Clone)]
pub struct Blended {
    cover: Cover,
    coefficients: Vec<Vec<f64>>,
    basis: CapBasis,
}

impl Blended {
    /// A blend of one list of cap-basis coefficients per cell of the cover, in its order.
    ///
    /// # Errors
    /// [`InvalidGrain`] if the lists do not fit the cover or hold a number that is not finite.
    pub fn new(cover: Cover, coefficients: Vec<Vec<f64>>) -> Result<Self, InvalidGrain> {
        if coefficients.len() != cover.cells().len() {
            return Err(InvalidGrain::SegmentCount {
                found: coefficients.len(),
                expected: cover.cells().len(),
            });
        }
        let mut degree = 0;
        for (cell, list) in coefficients.iter().enumerate() {
            degree = degree.max(check_expansion(cell, list)?);
        }
        Ok(Self {
            cover,
            coefficients,
            basis: CapBasis::new(degree),
        })
    }

    /// The cells and their weights.
    pub fn cover(&self) -> &Cover {
        &self.cover
    }

    /// The cap-basis coefficients of every cell: (L+1)^2 numbers each, in the scan's unit.
    pub fn coefficients(&self) -> &[Vec<f64>] {
        &self.coefficients
    }

    /// The surface so many times as large.
    pub(crate) fn times(&self, factor: f64) -> Self {
        let mut found = self.clone();
        for coefficient in found.coefficients.iter_mut().flatten() {
            *coefficient *= factor;
        }
        found
    }

    /// The largest degree of any cell.
    pub fn degree(&self) -> usize {
        self.basis.degree()
    }

    /// The number of coefficients that an evaluation touches, as a mean over all directions.
    pub fn coefficients_touched(&self) -> f64 {
        let mut shares = Vec::new();
        let (directions, _) = crate::sphere::cube_grid(PLACES_PER_EDGE);
        let touched: usize = directions
            .iter()
            .map(|n| {
                self.cover.shares(n, &mut shares);
                let count = |&(cell, _): &(u16, f64)| self.coefficients[usize::from(cell)].len();
                shares.iter().map(count).sum::<usize>()
            })
            .sum();
        touched as f64 / directions.len() as f64
    }

    /// The basis, the cap and the coefficients of a cell.
    pub(super) fn expansion(&self, cell: usize) -> (&CapBasis, &Cap, &[f64]) {
        (&self.basis, self.cover.cap(cell), &self.coefficients[cell])
    }

    /// Radius of a cell's expansion in a direction of its cap.
    pub(super) fn cell_radius(&self, cell: usize, n: &Vector3<f64>) -> f64 {
        self.basis
            .value(self.cover.cap(cell), &self.coefficients[cell], n)
    }

    /// Radius in a direction of the grain's own frame.
    pub(crate) fn radius(&self, n: &Vector3<f64>) -> f64 {
        self.radius_and_gradient(n).0
    }

    /// Radius and surface gradient in a direction of the grain's own frame.
    pub(crate) fn radius_and_gradient(&self, n: &Vector3<f64>) -> (f64, Vector3<f64>) {
        let near = self.cover.near(self.cover.bucket(n));
        let (radius, gradient) = self.blend(near, &[[n.x], [n.y], [n.z]]);
        (
            radius[0],
            Vector3::from(gradient.map(|[component]| component)),
        )
    }

    /// Radii and surface gradients in many directions, in their order.
    pub(crate) fn radii_and_gradients(
        &self,
        directions: &[Vector3<f64>],
    ) -> Vec<(f64, Vector3<f64>)> {
        // Sorted by bucket, so that each bucket looks up once what is near.
        let buckets: Vec<u32> = directions
            .iter()
            .map(|n| self.cover.bucket(n) as u32)
            .collect();
        let mut starts = vec![0_usize; self.cover.buckets() + 1];
        for &bucket in &buckets {
            starts[bucket as usize + 1] += 1;
        }
        for bucket in 1..starts.len() {
            starts[bucket] += starts[bucket - 1];
        }
        let mut sorted = vec![0_u32; directions.len()];
        let mut next = starts.clone();
        for (index, &bucket) in buckets.iter().enumerate() {
            sorted[next[bucket as usize]] = index as u32;
            next[bucket as usize] += 1;
        }
        let parts: Vec<Vec<(f64, Vector3<f64>)>> = (0..self.cover.buckets())
            .into_par_iter()
            .with_min_len(16)
            .map(|bucket| {
                let members = &sorted[starts[bucket]..starts[bucket + 1]];
                self.blend_near(self.cover.near(bucket), members, directions)
            })
            .collect();
        let mut out = vec![(0.0, Vector3::zeros()); directions.len()];
        for (&index, value) in sorted.iter().zip(parts.into_iter().flatten()) {
            out[index as usize] = value;
        }
        out
    }

    /// Radii and surface gradients in some of many directions, all near the same cells.
    fn blend_near(
        &self,
        near: &[u16],
        members: &[u32],
        directions: &[Vector3<f64>],
    ) -> Vec<(f64, Vector3<f64>)> {
        let mut out = Vec::with_capacity(members.len());
        vectorize(
            #[inline(always)]
            || {
                for block in members.chunks(LANES) {
                    let mut n = [[0.0; LANES]; 3];
                    for lane in 0..LANES {
                        let direction = directions[block[lane.min(block.len() - 1)] as usize];
                        for axis in 0..3 {
                            n[axis][lane] = direction[axis];
                        }
                    }
                    let (radius, [x, y, z]) = self.blend(near, &n);
                    for lane in 0..block.len() {
                        out.push((radius[lane], Vector3::new(x[lane], y[lane], z[lane])));
                    }
                }
            },
        );
        out
    }

    /// Radii and surface gradients in N directions, given component by component, that are near the
    /// given cells.
    #[inline(always)]
    fn blend<const N: usize>(&self, near: &[u16], n: &[[f64; N]; 3]) -> ([f64; N], [[f64; N]; 3]) {
        let (mut sums, mut weights) = ([0.0; N], [0.0; N]);
        let (mut slopes, mut weight_slopes) = ([[0.0; N]; 3], [[0.0; N]; 3]);
        for &cell in near {
            let cell = usize::from(cell);
            let (w, dw) = self.cover.weight(cell).values_and_gradients(n);
            let mut touched = 0.0;
            for w in w {
                touched += w;
            }
            if touched == 0.0 {
                continue;
            }
            let own = &self.coefficients[cell];
            let (f, df) = self
                .basis
                .values_and_gradients(self.cover.cap(cell), own, n);
            for i in 0..N {
                sums[i] += w[i] * f[i];
                weights[i] += w[i];
            }
            for axis in 0..3 {
                let (slope, weight_slope) = (&mut slopes[axis], &mut weight_slopes[axis]);
                let (df, dw) = (&df[axis], &dw[axis]);
                for i in 0..N {
                    slope[i] += w[i] * df[i] + dw[i] * f[i];
                    weight_slope[i] += dw[i];
                }
            }
        }
        let mut radii = [0.0; N];
        let mut gradients = [[0.0; N]; 3];
        for i in 0..N {
            let per_weight = 1.0 / weights[i];
            let radius = sums[i] * per_weight;
            let mut along = 0.0;
            for axis in 0..3 {
                let slope = (slopes[axis][i] - weight_slopes[axis][i] * radius) * per_weight;
                gradients[axis][i] = slope;
                along += slope * n[axis][i];
            }
            for axis in 0..3 {
                gradients[axis][i] -= along * n[axis][i];
            }
            radii[i] = radius;
        }
        (radii, gradients)
    }

    /// Radius and its derivatives with respect to the components of `n`.
    pub(crate) fn jet(&self, n: &Vector3<f64>) -> Jet {
        let (mut sum, mut weights) = (Jet::default(), Jet::default());
        for &cell in self.cover.near(self.cover.bucket(n)) {
            let weight = self.cover.weight(cell.into()).jet(n);
            if weight.value > 0.0 {
                let cap = self.cover.cap(cell.into());
                let expansion = self
                    .basis
                    .jet(cap, &self.coefficients[usize::from(cell)], n);
                sum = sum.plus(&weight.times(&expansion));
                weights = weights.plus(&weight);
            }
        }
        sum.over(&weights)
    }
}

/// Directions evaluated together.
const LANES: usize = 8;

/// Directions along a cube's edge at which touched coefficients are counted.
const PLACES_PER_EDGE: usize = 32;
