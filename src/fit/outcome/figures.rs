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

use crate::measure::{MassProperties, Moments, PrincipalInertia, inertia};
use nalgebra::{Matrix3, Point3, SMatrix, SVector, Vector3};

/// Area, volume, three first moments and six second moments, as a list.
pub(in crate::fit) const INTEGRALS: usize = 11;

/// Second moments of the list: xx, yy, zz, yz, xz, xy.
pub(in crate::fit) const PAIRS: [(usize, usize); 6] =
    [(0, 0), (1, 1), (2, 2), (1, 2), (0, 2), (0, 1)];

/// Figures of a grain along its own axes and from its own centre, in powers of the scan's unit.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(in crate::fit) struct Figures {
    /// Surface area.
    pub(in crate::fit) area: f64,
    /// Volume.
    pub(in crate::fit) volume: f64,
    /// Centroid.
    pub(in crate::fit) centroid: Vector3<f64>,
    /// Inertia tensor about the centroid.
    pub(in crate::fit) inertia: Matrix3<f64>,
    /// Principal moments of inertia, ascending.
    pub(in crate::fit) moments: Vector3<f64>,
    /// Length, width and thickness: extents along the principal axes, the largest first.
    pub(in crate::fit) dimensions: Vector3<f64>,
}

#[cfg(test)]
impl Figures {
    /// Those of no body in particular.
    pub(in crate::fit) const SOME: Self = Self {
        area: 10.0,
        volume: 8.0,
        centroid: Vector3::new(0.0, 0.0, 0.0),
        inertia: Matrix3::new(1.0, 0.0, 0.0, 0.0, 2.0, 0.0, 0.0, 0.0, 3.0),
        moments: Vector3::new(1.0, 2.0, 3.0),
        dimensions: Vector3::new(2.0, 2.0, 2.0),
    };
}

/// Which of the extents along the principal axes is the length, the width and the thickness: they are told by their size,
/// which is not always that of the moments.
pub(in crate::fit) fn by_size(extents: &Vector3<f64>) -> [usize; 3] {
    let mut order = [0, 1, 2];
    order.sort_by(|&one, &other| extents[other].total_cmp(&extents[one]));
    order
}

/// Squares of the standard errors of extents, the largest extent first, from those along each axis: of extents that are
/// alike it is not known which is the larger, so that each may be any of them, and the longest found is one of those that are
/// told too long.
pub(in crate::fit) fn squares_by_size(
    extents: &Vector3<f64>,
    squares: &Vector3<f64>,
) -> Vector3<f64> {
    let of_rank = |i: usize| {
        let apart = |j: usize| (extents[j] - extents[i]).powi(2);
        let is_alike = |j: &usize| *j == i || apart(*j) < squares[*j] + squares[i];
        let alike: Vec<usize> = (0..3).filter(is_alike).collect();
        let mean = alike.iter().map(|&j| squares[j]).sum::<f64>() / alike.len() as f64;
        let farthest = alike.iter().map(|&j| apart(j)).fold(0.0, f64::max);
        mean.max(squares[i]) + farthest
    };
    Vector3::from(by_size(extents).map(of_rank))
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
            second: inertia(&central),
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

/// Moments as a list.
pub(in crate::fit) fn list(moments: &Moments) -> SVector<f64, INTEGRALS> {
    let Moments {
        area,
        volume,
        first,
        second,
    } = moments;
    let mut list = SVector::<f64, INTEGRALS>::zeros();
    list[0] = *area;
    list[1] = *volume;
    list.fixed_rows_mut::<3>(2).copy_from(first);
    for (at, pair) in PAIRS.into_iter().enumerate() {
        list[5 + at] = second[pair];
    }
    list
}

/// A list as moments.
pub(in crate::fit) fn unlist(list: &SVector<f64, INTEGRALS>) -> Moments {
    let mut second = Matrix3::zeros();
    for (at, (i, j)) in PAIRS.into_iter().enumerate() {
        second[(i, j)] = list[5 + at];
        second[(j, i)] = list[5 + at];
    }
    Moments {
        area: list[0],
        volume: list[1],
        first: list.fixed_rows::<3>(2).into_owned(),
        second,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_length_is_the_largest_extent() {
        assert_eq!(by_size(&Vector3::new(2.2, 2.3, 2.0)), [1, 0, 2]);
        assert_eq!(by_size(&Vector3::new(1.0, 2.0, 2.0)), [1, 2, 0]);
    }

    #[test]
    fn extents_that_are_alike_are_each_as_uncertain_as_any_of_them() {
        // A bar of square section: its sides are told anywhere between side and diagonal.
        let extents = Vector3::new(40.0, 41.0, 42.0);
        let squares = Vector3::new(1.0, 49.0, 34.0);
        let ranked = squares_by_size(&extents, &squares);
        assert_eq!(ranked, Vector3::new(34.0 + 4.0, 49.0 + 1.0, 28.0 + 4.0));
        let apart = Vector3::new(0.01, 0.02, 0.03);
        let ranked = squares_by_size(&extents, &apart);
        assert_eq!(ranked, Vector3::new(0.03, 0.02, 0.01));
    }
}
