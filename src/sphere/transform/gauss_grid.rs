//! Values of an expansion at Gauss-Legendre rings of equispaced azimuths, and the transpose.

use super::azimuth::{AzimuthSeries, AzimuthTerms, IMAGES};
use super::kept::Kept;
use super::polar::PolarTable;
use crate::sphere::{GaussLegendre, HarmonicBasis};
use std::f64::consts::PI;
use std::sync::Arc;

/// Grids of all degrees, and degrees of exactness, that have been asked for.
static GRIDS: Kept<[usize; 2], GaussGrid> = Kept::new();

/// A grid on which sums with [`Self::weights`] are integrals of all polynomials up to a degree, for
/// expansions up to another. Values are stored as by an [`AzimuthSeries`], the rings as by
/// [`PolarTable::row`]: nodes that stand twice, and those of padding, have no weight.
pub(super) struct GaussGrid {
    polar: PolarTable,
    series: AzimuthSeries,
    orders: usize,
    /// Solid angle of a node of each ring.
    weights: Vec<f64>,
}

impl GaussGrid {
    /// The grid for expansions up to `degree`, exact for polynomials of degree `exact`. It is made once in a process,
    /// and kept.
    pub(super) fn of_degree(degree: usize, exact: usize) -> Arc<Self> {
        GRIDS.get([degree, exact], || Self::new(degree, exact))
    }

    /// The grid of products of two expansions up to `degree`: with the nodes of that which is exact for products of such
    /// products, for expansions up to twice the degree.
    pub(super) fn wide(degree: usize) -> Arc<Self> {
        Self::of_degree(2 * degree, 4 * degree)
    }

    fn new(degree: usize, exact: usize) -> Self {
        let rule = GaussLegendre::new(exact / 2 + 1);
        let series = AzimuthSeries::new(degree + 1, exact + 1);
        let rings = rule.len();
        let northern = rule.on(1.0, -1.0).take(rings.div_ceil(2));
        let cosines: Vec<f64> = northern.map(|(cos, _)| cos).collect();
        let basis = HarmonicBasis::new(degree);
        let columns = basis.polar_parts(&cosines, PolarTable::rows(rings));
        let polar = PolarTable::new(degree, rings, columns);
        let per_node = 2.0 * PI / series.points() as f64;
        Self {
            polar,
            orders: degree + 1,
            weights: rule.on(-1.0, 1.0).map(|(_, w)| w * per_node).collect(),
            series,
        }
    }

    /// Number of values.
    pub(super) fn len(&self) -> usize {
        IMAGES * self.series.of_quarter() * self.rows()
    }

    /// Values of a point of all rings: of northern ones and of southern ones.
    fn rows(&self) -> usize {
        2 * self.polar.column_length()
    }

    /// Solid angles of the nodes.
    pub(super) fn weights(&self) -> Vec<f64> {
        let northern = self.weights.len().div_ceil(2);
        let mut of_rings = vec![0.0; self.rows()];
        let (north, south) = of_rings.split_at_mut(self.polar.column_length());
        north[..northern].copy_from_slice(&self.weights[..northern]);
        // An equator is a northern ring.
        let southern = self.weights.len() - northern;
        south[..southern].copy_from_slice(&self.weights[..southern]);
        let points = 0..self.series.of_quarter();
        let mut weights = Vec::with_capacity(self.len());
        for (image, point) in (0..IMAGES).flat_map(|i| points.clone().map(move |t| (i, t))) {
            let own = f64::from(u8::from(self.series.is_own(image, point)));
            weights.extend(of_rings.iter().map(|weight| own * weight));
        }
        weights
    }

    /// The polar parts of the harmonics.
    pub(super) fn polar(&self) -> &PolarTable {
        &self.polar
    }

    /// The terms of the azimuth of values at the nodes, of each order a column like those of [`Self::polar`]: first the
    /// sums of a ring's and its mirror image's, then their differences; of each that of the cosine and that of the sine.
    pub(super) fn folded_terms(&self, values: &[f64]) -> [Vec<[Vec<f64>; 2]>; 2] {
        let mut terms = self.polar.terms();
        self.series.adjoint(&mut values.to_vec(), &mut terms);
        [1.0, -1.0].map(|sign| {
            let folded = |column: &[f64]| {
                let (north, south) = column.split_at(column.len() / 2);
                let rings = north.iter().zip(south);
                rings.map(|(north, south)| north + sign * south).collect()
            };
            let of_order = |m: usize| terms.of_order(m).map(folded);
            (0..self.orders).map(of_order).collect()
        })
    }

    /// Room for the terms of the azimuth.
    pub(super) fn terms(&self) -> AzimuthTerms {
        self.polar.terms()
    }

    /// Values of an expansion at the nodes; overwrites all of them and of `terms`.
    pub(super) fn synthesis(
        &self,
        coefficients: &[f64],
        terms: &mut AzimuthTerms,
        values: &mut [f64],
    ) {
        self.polar.synthesis(coefficients, terms);
        self.series.synthesis(terms, values);
    }

    /// The transpose of [`Self::synthesis`]. Overwrites `values` and all of `terms`.
    pub(super) fn adjoint(
        &self,
        values: &mut [f64],
        terms: &mut AzimuthTerms,
        coefficients: &mut [f64],
    ) {
        self.series.adjoint(values, terms);
        self.polar.adjoint(terms, coefficients);
    }
}
