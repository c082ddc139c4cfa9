//! Leverages of few points, computed.
//!
//! With the harmonics Y in the points' directions, their weights W and the prior variances V, 1 - h is the diagonal of
//! (I + W^1/2 Y V Y' W^1/2 / s^2)^-1, and safe also where h is all but 1.

use super::super::cloud::Cloud;
use super::super::dense::Factor;
use super::super::outcome::Estimate;
use crate::sphere::{HarmonicBasis, LowerTriangle};
use faer::linalg::matmul::triangular::{self, BlockStructure};
use faer::{Accum, MatMut, MatRef, Par};

/// What tells leverages.
pub(super) struct Exact<'a> {
    cloud: &'a Cloud,
    basis: HarmonicBasis,
    /// Prior standard deviations of the coefficients.
    deviations: Vec<f64>,
    /// s^2.
    noise: f64,
}

impl<'a> Exact<'a> {
    pub(super) fn new(estimate: &'a Estimate) -> Self {
        let posterior = estimate.posterior();
        let given = estimate.given(&posterior);
        Self {
            cloud: &estimate.cloud,
            basis: HarmonicBasis::new(estimate.degree),
            deviations: given.variances.iter().map(|v| v.sqrt()).collect(),
            noise: given.noise,
        }
    }

    /// 1 - h of every point; `None` where the numbers end before that.
    pub(super) fn spares(&self) -> Option<Vec<f64>> {
        self.spares_among(&(0..self.cloud.len()).collect::<Vec<_>>())
    }

    /// The same of points of which there are no others.
    pub(super) fn spares_among(&self, points: &[usize]) -> Option<Vec<f64>> {
        let (count, size) = (points.len(), self.deviations.len());
        let mut rows = vec![0.0; count * size];
        for (&point, row) in points.iter().zip(rows.chunks_exact_mut(size)) {
            self.basis.evaluate(&self.cloud.directions[point], row);
            for (y, deviation) in row.iter_mut().zip(&self.deviations) {
                *y *= deviation;
            }
        }
        let rows = MatRef::from_column_major_slice(&rows, size, count);
        let mut products = vec![0.0; count * count];
        triangular::matmul(
            MatMut::from_column_major_slice_mut(&mut products, count, count),
            BlockStructure::TriangularLower,
            Accum::Replace,
            rows.transpose(),
            BlockStructure::Rectangular,
            rows,
            BlockStructure::Rectangular,
            1.0,
            Par::Seq,
        );
        let products = LowerTriangle {
            order: (0..count).collect(),
            entries: products,
        };
        let weights: Vec<f64> = points.iter().map(|&i| self.cloud.weights[i]).collect();
        let factor = Factor::double(&products, &weights, self.noise)?;
        let spares = factor.diagonal().into_iter().zip(&weights);
        Some(spares.map(|(spare, w)| spare / w).collect())
    }
}

#[cfg(test)]
mod tests {
    use super::super::super::trial::{estimated, fibonacci, samples};
    use super::*;
    use crate::fit::points::neighbours::Neighbours;
    use nalgebra::Vector3;

    /// Of a box, along whose edges every point decides.
    #[test]
    fn where_points_decide_they_do_so_among_the_nearest() {
        let axes = Vector3::new(2.0, 1.0, 0.6);
        let samples = samples(
            &fibonacci(900),
            |n| 1.0 / n.component_div(&axes).amax(),
            0.0,
        );
        let estimate = estimated(&samples, axes);
        let exact = Exact::new(&estimate);
        let all = exact.spares().unwrap();
        let neighbours = Neighbours::new(&estimate.cloud.directions);
        let small = (0..all.len()).filter(|&i| all[i] < 0.01);
        let overs = small.map(|i| {
            let near = neighbours.nearest(&estimate.cloud.directions[i], 16);
            let own = near.iter().position(|&j| j == i).unwrap();
            exact.spares_among(&near).unwrap()[own] / all[i]
        });
        let overs: Vec<f64> = overs.collect();
        assert!(overs.len() > 100, "{}", overs.len());
        for over in overs {
            assert!((0.8..1.0).contains(&over), "{over}");
        }
    }
}
