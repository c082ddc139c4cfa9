//! Leverages of few points, computed.
//!
//! With the harmonics Y in the points' directions, their weights W and the prior variances V, 1 - h is the diagonal of
//! (I + W^1/2 Y V Y' W^1/2 / s^2)^-1, and safe also where h is all but 1.

use super::super::dense::Factor;
use super::super::outcome::Estimate;
use crate::sphere::{HarmonicBasis, LowerTriangle};
use faer::linalg::matmul::triangular::{self, BlockStructure};
use faer::{Accum, MatMut, MatRef, Par};

/// 1 - h of every point; `None` where the numbers end before that.
pub(super) fn exact(estimate: &Estimate) -> Option<Vec<f64>> {
    let cloud = &estimate.cloud;
    let posterior = estimate.posterior();
    let given = estimate.given(&posterior);
    let roots: Vec<f64> = given.variances.iter().map(|v| v.sqrt()).collect();
    let basis = HarmonicBasis::new(estimate.degree);
    let mut rows = vec![0.0; cloud.len() * roots.len()];
    for (n, row) in cloud
        .directions
        .iter()
        .zip(rows.chunks_exact_mut(roots.len()))
    {
        basis.evaluate(n, row);
        for (y, root) in row.iter_mut().zip(&roots) {
            *y *= root;
        }
    }
    let count = cloud.len();
    let rows = MatRef::from_column_major_slice(&rows, roots.len(), count);
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
    let factor = Factor::double(&products, &cloud.weights, given.noise)?;
    let spares = factor.diagonal().into_iter().zip(&cloud.weights);
    Some(spares.map(|(spare, w)| spare / w).collect())
}
