//! K functions on a cover of the sphere, blended so that no seam is left.

use super::InvalidGrain;
use crate::sphere::{CapBasis, Cover, Jet, cube_grid};
use crate::vectorize::vectorize;
use nalgebra::Vector3;
use rayon::prelude::*;

/// Values and surface gradients (per radian, orthogonal to the direction) of K functions.
pub(super) type Blends<const K: usize> = [(f64, Vector3<f64>); K];

/// K functions f_k(n) = sum of w_i(n) f_ki(n) / sum of w_i(n), with the weights w_i of a [`Cover`] and
/// expansions f_ki in the cap bases of its cells: continuous with two derivatives everywhere. One
/// evaluation of the bases serves all K.
#[derive(Debug, Clone)]
pub(super) struct Blend<const K: usize> {
    pub(super) cover: Cover,
    /// Of each cell, the K coefficients of its first function, of its second, ...
    pub(super) coefficients: Vec<Vec<f64>>,
    pub(super) basis: CapBasis,
}

impl<const K: usize> Blend<K> {
    /// A blend of one list of coefficients per cell of the cover, in its order; `degree_of` checks the list of a cell
    /// and tells its degree.
    ///
    /// # Errors
    /// [`InvalidGrain`] if the lists are not as many as the cells, or one of them is refused.
    pub(super) fn new(
        cover: Cover,
        coefficients: Vec<Vec<f64>>,
        degree_of: impl Fn(usize, &[f64]) -> Result<usize, InvalidGrain>,
    ) -> Result<Self, InvalidGrain> {
        if coefficients.len() != cover.cells().len() {
            return Err(InvalidGrain::SegmentCount {
                found: coefficients.len(),
                expected: cover.cells().len(),
            });
        }
        let mut degree = 0;
        for (cell, list) in coefficients.iter().enumerate() {
            degree = degree.max(degree_of(cell, list)?);
        }
        Ok(Self {
            cover,
            coefficients,
            basis: CapBasis::new(degree),
        })
    }

    /// The K coefficients of each function of a cell.
    pub(super) fn of_cell(&self, cell: usize) -> &[[f64; K]] {
        self.coefficients[cell].as_chunks().0
    }

    /// All coefficients so many times as large.
    pub(super) fn times(&self, factor: f64) -> Self {
        let mut found = self.clone();
        for coefficient in found.coefficients.iter_mut().flatten() {
            *coefficient *= factor;
        }
        found
    }

    /// The number of coefficients that an evaluation touches, as a mean over all directions.
    pub(super) fn coefficients_touched(&self) -> f64 {
        let mut shares = Vec::new();
        let (directions, _) = cube_grid(PLACES_PER_EDGE);
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

    /// Values and surface gradients in a direction.
    pub(super) fn values_and_gradients(&self, n: &Vector3<f64>) -> Blends<K> {
        let near = self.cover.near(self.cover.bucket(n));
        let (values, gradients) = self.blend(near, &[[n.x], [n.y], [n.z]]);
        std::array::from_fn(|k| {
            let gradient = Vector3::from(gradients[k].map(|[component]| component));
            (values[k][0], gradient)
        })
    }

    /// Values in a direction.
    pub(super) fn values(&self, n: &Vector3<f64>) -> [f64; K] {
        let near = self.cover.near(self.cover.bucket(n));
        self.blend(near, &[[n.x], [n.y], [n.z]])
            .0
            .map(|[value]| value)
    }

    /// Values in many directions, in their order.
    pub(super) fn many_values(&self, directions: &[Vector3<f64>]) -> Vec<[f64; K]> {
        self.many(directions, [0.0; K], |values, _| values)
    }

    /// Values and surface gradients in many directions, in their order.
    pub(super) fn many_values_and_gradients(&self, directions: &[Vector3<f64>]) -> Vec<Blends<K>> {
        let none = [(0.0, Vector3::zeros()); K];
        self.many(directions, none, |values, gradients| {
            std::array::from_fn(|k| (values[k], gradients[k]))
        })
    }

    /// What `of` takes of values and surface gradients in many directions, in their order: what it does not take is not
    /// computed.
    fn many<T: Copy + Send + Sync>(
        &self,
        directions: &[Vector3<f64>],
        none: T,
        of: impl Fn([f64; K], [Vector3<f64>; K]) -> T + Copy + Sync,
    ) -> Vec<T> {
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
        let parts: Vec<Vec<T>> = (0..self.cover.buckets())
            .into_par_iter()
            .with_min_len(16)
            .map(|bucket| {
                let members = &sorted[starts[bucket]..starts[bucket + 1]];
                self.blend_near(self.cover.near(bucket), members, directions, of)
            })
            .collect();
        let mut out = vec![none; directions.len()];
        for (&index, value) in sorted.iter().zip(parts.into_iter().flatten()) {
            out[index as usize] = value;
        }
        out
    }

    /// The same in some of the directions, all near the same cells.
    fn blend_near<T>(
        &self,
        near: &[u16],
        members: &[u32],
        directions: &[Vector3<f64>],
        of: impl Fn([f64; K], [Vector3<f64>; K]) -> T + Copy,
    ) -> Vec<T> {
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
                    let (values, gradients) = self.blend(near, &n);
                    for lane in 0..block.len() {
                        let gradient =
                            |[x, y, z]: &[[f64; LANES]; 3]| Vector3::new(x[lane], y[lane], z[lane]);
                        out.push(of(
                            std::array::from_fn(|k| values[k][lane]),
                            std::array::from_fn(|k| gradient(&gradients[k])),
                        ));
                    }
                }
            },
        );
        out
    }

    /// Values and surface gradients in N directions, given component by component, that are near the
    /// given cells.
    #[inline(always)]
    fn blend<const N: usize>(
        &self,
        near: &[u16],
        n: &[[f64; N]; 3],
    ) -> ([[f64; N]; K], [[[f64; N]; 3]; K]) {
        let (mut sums, mut weights) = ([[0.0; N]; K], [0.0; N]);
        let (mut slopes, mut weight_slopes) = ([[[0.0; N]; 3]; K], [[0.0; N]; 3]);
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
            let (cap, own) = (self.cover.cap(cell), self.of_cell(cell));
            let (f, df) = self.basis.values_and_gradients(cap, own, n);
            for i in 0..N {
                weights[i] += w[i];
            }
            for axis in 0..3 {
                for i in 0..N {
                    weight_slopes[axis][i] += dw[axis][i];
                }
            }
            for k in 0..K {
                for i in 0..N {
                    sums[k][i] += w[i] * f[k][i];
                }
                for axis in 0..3 {
                    let slope = &mut slopes[k][axis];
                    let (df, dw) = (&df[k][axis], &dw[axis]);
                    for i in 0..N {
                        slope[i] += w[i] * df[i] + dw[i] * f[k][i];
                    }
                }
            }
        }
        let mut values = [[0.0; N]; K];
        let mut gradients = [[[0.0; N]; 3]; K];
        for k in 0..K {
            for i in 0..N {
                let per_weight = 1.0 / weights[i];
                let value = sums[k][i] * per_weight;
                let mut along = 0.0;
                for axis in 0..3 {
                    let slope = (slopes[k][axis][i] - weight_slopes[axis][i] * value) * per_weight;
                    gradients[k][axis][i] = slope;
                    along += slope * n[axis][i];
                }
                for axis in 0..3 {
                    gradients[k][axis][i] -= along * n[axis][i];
                }
                values[k][i] = value;
            }
        }
        (values, gradients)
    }

    /// The functions and their derivatives with respect to the components of `n`.
    pub(super) fn jets(&self, n: &Vector3<f64>) -> [Jet; K] {
        let (mut sums, mut weights) = ([Jet::default(); K], Jet::default());
        for &cell in self.cover.near(self.cover.bucket(n)) {
            let cell = usize::from(cell);
            let weight = self.cover.weight(cell).jet(n);
            if weight.value > 0.0 {
                let expansions = self.basis.jets(self.cover.cap(cell), self.of_cell(cell), n);
                for (sum, expansion) in sums.iter_mut().zip(&expansions) {
                    *sum = sum.plus(&weight.times(expansion));
                }
                weights = weights.plus(&weight);
            }
        }
        sums.map(|sum| sum.over(&weights))
    }
}

/// Directions evaluated together.
const LANES: usize = 8;

/// Directions along a cube's edge at which touched coefficients are counted.
const PLACES_PER_EDGE: usize = 32;
