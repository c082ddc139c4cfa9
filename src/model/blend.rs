//! K functions on a cover of the sphere, blended so that no seam is left.

use super::InvalidGrain;
use crate::buckets::Buckets;
use crate::sphere::{CapBasis, CapExpansion, Cover, FacePlaces, Jet, Jets, cube_grid};
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
    expansions: Vec<CapExpansion<K>>,
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
        Ok(Self::of(cover, coefficients, CapBasis::new(degree)))
    }

    fn of(cover: Cover, coefficients: Vec<Vec<f64>>, basis: CapBasis) -> Self {
        let lists = coefficients.iter().enumerate();
        let expansions = lists
            .map(|(cell, own)| CapExpansion::new(&basis, cover.cap(cell), own.as_chunks().0))
            .collect();
        Self {
            cover,
            coefficients,
            basis,
            expansions,
        }
    }

    /// All coefficients so many times as large.
    pub(super) fn times(&self, factor: f64) -> Self {
        let mut coefficients = self.coefficients.clone();
        for coefficient in coefficients.iter_mut().flatten() {
            *coefficient *= factor;
        }
        Self::of(self.cover.clone(), coefficients, self.basis.clone())
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
        let n_at = [[n.x], [n.y], [n.z]];
        self.blend::<1, 1>(self.near(n), &n_at).map(|mut jets| {
            jets.keep_along_sphere(&n_at);
            (jets.value[0], jets.gradient_at(0))
        })
    }

    /// Values in a direction.
    pub(super) fn values(&self, n: &Vector3<f64>) -> [f64; K] {
        let found = self.blend::<0, 1>(self.near(n), &[[n.x], [n.y], [n.z]]);
        found.map(|jets| jets.value[0])
    }

    /// The functions and their derivatives with respect to the components of `n`.
    pub(super) fn jets(&self, n: &Vector3<f64>) -> [Jet; K] {
        let found = self.blend::<2, 1>(self.near(n), &[[n.x], [n.y], [n.z]]);
        found.map(|jets| jets.jet_at(0))
    }

    /// Values in many directions, in their order.
    pub(super) fn many_values(&self, directions: &[Vector3<f64>]) -> Vec<[f64; K]> {
        self.many::<0, _>(directions, [0.0; K], |jets, lane| {
            std::array::from_fn(|k| jets[k].value[lane])
        })
    }

    /// Values and surface gradients in many directions, in their order.
    pub(super) fn many_values_and_gradients(&self, directions: &[Vector3<f64>]) -> Vec<Blends<K>> {
        let none = [(0.0, Vector3::zeros()); K];
        self.many::<1, _>(directions, none, |jets, lane| {
            std::array::from_fn(|k| (jets[k].value[lane], jets[k].gradient_at(lane)))
        })
    }

    /// The functions and their derivatives in many directions, in their order.
    pub(super) fn many_jets(&self, directions: &[Vector3<f64>]) -> Vec<[Jet; K]> {
        self.many::<2, _>(directions, [Jet::default(); K], |jets, lane| {
            std::array::from_fn(|k| jets[k].jet_at(lane))
        })
    }

    /// The cells near a direction.
    fn near(&self, n: &Vector3<f64>) -> &[u16] {
        self.cover.near(self.cover.bucket(n))
    }

    /// What `of` takes of the functions with ORDER derivatives in many directions, in their order, from a
    /// lane of them.
    fn many<const ORDER: usize, T: Copy + Send + Sync>(
        &self,
        directions: &[Vector3<f64>],
        none: T,
        of: impl Fn(&[Jets<ORDER, LANES>; K], usize) -> T + Copy + Sync,
    ) -> Vec<T> {
        // Sorted by bucket, so that each bucket looks up once what is near.
        let buckets: Vec<u32> = directions
            .iter()
            .map(|n| self.cover.bucket(n) as u32)
            .collect();
        let sorted = Buckets::new(self.cover.buckets(), &buckets);
        let parts: Vec<Vec<T>> = (0..self.cover.buckets())
            .into_par_iter()
            .with_min_len(16)
            .map(|bucket| {
                let near = self.cover.near(bucket);
                self.blend_near(near, sorted.get(bucket), directions, of)
            })
            .collect();
        let mut out = vec![none; directions.len()];
        for (&index, value) in sorted.members().iter().zip(parts.into_iter().flatten()) {
            out[index as usize] = value;
        }
        out
    }

    /// The same in some of the directions, all near the same cells.
    fn blend_near<const ORDER: usize, T>(
        &self,
        near: &[u16],
        members: &[u32],
        directions: &[Vector3<f64>],
        of: impl Fn(&[Jets<ORDER, LANES>; K], usize) -> T + Copy,
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
                    let mut jets = self.blend::<ORDER, LANES>(near, &n);
                    if ORDER == 1 {
                        for jets in &mut jets {
                            jets.keep_along_sphere(&n);
                        }
                    }
                    for lane in 0..block.len() {
                        out.push(of(&jets, lane));
                    }
                }
            },
        );
        out
    }

    /// The functions in N directions, given component by component, that are near the given cells.
    #[inline(always)]
    fn blend<const ORDER: usize, const N: usize>(
        &self,
        near: &[u16],
        n: &[[f64; N]; 3],
    ) -> [Jets<ORDER, N>; K] {
        let (mut sums, mut weights) = ([Jets::ZERO; K], Jets::ZERO);
        let (mut face, mut places) = (u8::MAX, FacePlaces::NOWHERE);
        for &cell in near {
            let cell = usize::from(cell);
            let weight = self.cover.weight(cell);
            if face != weight.face() {
                face = weight.face();
                places = FacePlaces::new::<ORDER>(face, n);
            }
            let weight = weight.jets::<ORDER, N>(&places);
            let mut touched = 0.0;
            for value in weight.value {
                touched += value;
            }
            if touched == 0.0 {
                continue;
            }
            weights.add(&weight);
            let expansions = self.expansions[cell].jets::<ORDER, N>(n);
            for k in 0..K {
                sums[k].add_product(&weight, &expansions[k]);
            }
        }
        for sum in &mut sums {
            *sum = sum.over(&weights);
        }
        sums
    }
}

/// Directions evaluated together.
const LANES: usize = 8;

/// Directions along a cube's edge at which touched coefficients are counted.
const PLACES_PER_EDGE: usize = 32;
