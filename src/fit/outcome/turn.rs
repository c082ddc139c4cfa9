//! How an extent along a principal axis changes as the axis turns with the inertia tensor I: to first order its two ends
//! stay, and it is the span between them times the change of the axis,
//!
//! ```text
//! da_i = sum over j of a_j (a_j' dI a_i) / (I_i - I_j)
//! ```
//!
//! but for j with nearly the same moment: such axes have no direction of their own.

use super::figures::form;
use crate::measure::{PrincipalInertia, are_apart};
use nalgebra::{Matrix3, Matrix6, SVector, Vector3};

/// Standard error of an extent along such an axis, as a share of the range of extents that it may have: it may be told at one
/// end of it and be at the other.
pub(in crate::fit) const OF_RANGE: f64 = 0.6;

/// Steps of half a turn at which the extents along such axes are compared.
pub(in crate::fit) const TURNS: usize = 8;

/// Variance of the entry i, j of the inertia tensor along its principal axes, by the covariance of its entries.
pub(in crate::fit) fn entry_variance(
    covariance: &Matrix6<f64>,
    axes: &Matrix3<f64>,
    i: usize,
    j: usize,
) -> f64 {
    let form = form(&axes.column(i).into(), &axes.column(j).into());
    form.dot(&(covariance * form)).max(0.0)
}

/// The derivative of the extent along the principal axis `i`, from whose one end to the other is `span`, by the entries of the
/// inertia tensor; `sd` says how well an entry is known along the principal axes.
pub(in crate::fit) fn by_inertia(
    principal: &PrincipalInertia,
    i: usize,
    span: &Vector3<f64>,
    sd: impl Fn(usize, usize) -> f64,
) -> SVector<f64, 6> {
    let PrincipalInertia { moments, axes } = principal;
    let gap = |j: usize| moments[i] - moments[j];
    let column = |j: usize| axes.column(j).into_owned();
    let told = (0..3).filter(|&j| j != i && are_apart(sd(i, j), gap(j)));
    told.map(|j| form(&column(j), &column(i)) * (span.dot(&column(j)) / gap(j)))
        .sum()
}
