//! Where a body is as wide in all directions.

use nalgebra::{Matrix3, Vector3};

/// The linear map after which second moments are the same in all directions, and the most by which it stretches; it leaves the
/// longest axis as it is. `None` if the moments are those of something flat.
pub(in crate::fit) fn rounder(moments: Matrix3<f64>) -> Option<(Matrix3<f64>, f64)> {
    let found = moments.symmetric_eigen();
    let most = found.eigenvalues.max();
    let factors: Vector3<f64> = found.eigenvalues.map(|moment| (most / moment).sqrt());
    let is_solid = factors.iter().all(|factor| factor.is_finite());
    let axes = found.eigenvectors;
    is_solid.then(|| {
        let map = axes * Matrix3::from_diagonal(&factors) * axes.transpose();
        (map, factors.max())
    })
}
