//! The figures of a grain that have standard errors, and how they follow from its integrals.
//!
//! With volume V, first moments F and second moments S about the origin: centroid c = F / V, central second
//! moments K = S - F F' / V, inertia tr(K) - K. To first order
//!
//! ```text
//! dc = (dF - c dV) / V      dK = dS - dF c' - c dF' + c c' dV
//! ```
//!
//! and the principal moments change by the diagonal of the change of the inertia along the principal axes.

use super::functionals::{INTEGRALS, PAIRS, list, unlist};
use crate::measure::{MassProperties, Moments, PrincipalInertia};
use nalgebra::{Matrix3, Point3, SMatrix, SVector, Vector3};

/// Figures of a grain along its own axes and from its own centre, in powers of the scan's unit.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Figures {
    /// Surface area.
    pub(crate) area: f64,
    /// Volume.
    pub(crate) volume: f64,
    /// Centroid.
    pub(crate) centroid: Vector3<f64>,
    /// Inertia tensor about the centroid.
    pub(crate) inertia: Matrix3<f64>,
    /// Principal moments of inertia, ascending.
    pub(crate) moments: Vector3<f64>,
    /// Length, width and thickness: extents along the principal axes.
    pub(crate) dimensions: Vector3<f64>,
}

/// Area, volume, centroid and inertia as a list, in this order.
pub(in crate::fit) type MassList = SVector<f64, INTEGRALS>;

/// Where the inertia stands in the list, in the order of [`PAIRS`].
pub(in crate::fit) const INERTIA: usize = 5;

/// Area, volume, centroid and inertia, and the principal axes if these are finite.
pub(in crate::fit) fn mass(moments: &Moments) -> (MassProperties, Option<PrincipalInertia>) {
    let mass = moments.about_centroid(&Point3::origin());
    (mass, mass.principal())
}

/// The derivatives of area, volume, centroid and inertia (rows) by the integrals (columns).
pub(in crate::fit) fn derivatives(at: &Moments) -> SMatrix<f64, INTEGRALS, INTEGRALS> {
    let centroid = at.first / at.volume;
    let mut all = SMatrix::<f64, INTEGRALS, INTEGRALS>::zeros();
    for column in 0..INTEGRALS {
        let mut unit = MassList::zeros();
        unit[column] = 1.0;
        let d = unlist(&unit);
        let mixed = d.first * centroid.transpose();
        let central =
            d.second - mixed - mixed.transpose() + centroid * centroid.transpose() * d.volume;
        let changed = Moments {
            area: d.area,
            volume: d.volume,
            first: (d.first - centroid * d.volume) / at.volume,
            second: Matrix3::identity() * central.trace() - central,
        };
        all.set_column(column, &list(&changed));
    }
    all
}

/// The derivative of u' I w by the entries of the inertia tensor I, in the order of [`PAIRS`].
pub(in crate::fit) fn form(u: &Vector3<f64>, w: &Vector3<f64>) -> SVector<f64, 6> {
    SVector::from_fn(|at, _| match PAIRS[at] {
        (i, j) if i == j => u[i] * w[i],
        (i, j) => u[i] * w[j] + u[j] * w[i],
    })
}
