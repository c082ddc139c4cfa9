//! Values of an expansion at Gauss-Legendre rings of equispaced azimuths, and the transpose.

use super::kept::Kept;
use super::polar::PolarTable;
use crate::sphere::azimuth_fft::{AzimuthFft, even_smooth_number};
use crate::sphere::{GaussLegendre, HarmonicBasis, harmonic_index};
use nalgebra::Vector3;
use realfft::num_complex::Complex;
use std::f64::consts::PI;
use std::sync::Arc;

/// Grids of all degrees, and degrees of exactness, that have been asked for.
static GRIDS: Kept<[usize; 2], GaussGrid> = Kept::new();

/// A grid on which sums with [`Self::weights`] are integrals of all polynomials up to a degree, for
/// expansions up to another. Values are stored ring by ring, from the north pole.
pub(super) struct GaussGrid {
    polar: PolarTable,
    fft: AzimuthFft,
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

    fn new(degree: usize, exact: usize) -> Self {
        let rule = GaussLegendre::new(exact / 2 + 1);
        let fft = AzimuthFft::new(even_smooth_number(exact + 1));
        let rings = rule.len();
        let basis = HarmonicBasis::new(degree);
        let mut values = vec![0.0; (degree + 1) * (degree + 1)];
        let northern: Vec<Vec<f64>> = rule
            .on(1.0, -1.0)
            .take(rings.div_ceil(2))
            .map(|(cos, _)| {
                let sin = ((1.0 - cos) * (1.0 + cos)).sqrt();
                basis.evaluate(&Vector3::new(sin, 0.0, cos), &mut values);
                values.clone()
            })
            .collect();
        let polar = PolarTable::new(degree, rings, |l, m, column| {
            for (entry, values) in column.iter_mut().zip(&northern) {
                *entry = values[harmonic_index(l, m as isize)];
            }
        });
        let per_node = 2.0 * PI / fft.points() as f64;
        Self {
            polar,
            orders: degree + 1,
            weights: rule.on(-1.0, 1.0).map(|(_, w)| w * per_node).collect(),
            fft,
        }
    }

    /// Number of nodes.
    pub(super) fn len(&self) -> usize {
        self.weights.len() * self.fft.points()
    }

    /// Solid angles of the nodes.
    pub(super) fn weights(&self) -> impl Iterator<Item = f64> {
        let azimuths = self.fft.points();
        self.weights
            .iter()
            .flat_map(move |&weight| std::iter::repeat_n(weight, azimuths))
    }

    /// The polar parts of the harmonics.
    pub(super) fn polar(&self) -> &PolarTable {
        &self.polar
    }

    /// The terms of the azimuth, of orders 0 to `order`, of values at the nodes: of each order a column like those of
    /// [`Self::polar`]. First the sums of a ring's and its mirror image's, then their differences.
    pub(super) fn folded_terms(&self, values: &[f64], order: usize) -> [Vec<Vec<Complex<f64>>>; 2] {
        let column = vec![Complex::ZERO; self.polar.column_length()];
        let mut folded = [(); 2].map(|()| vec![column.clone(); order + 1]);
        let mut terms = vec![Complex::ZERO; order + 1];
        let mut workspace = self.fft.workspace();
        let rings = self.weights.len();
        for (ring, values) in values.chunks_exact(self.fft.points()).enumerate() {
            self.fft
                .adjoint(&mut values.to_vec(), &mut terms, &mut workspace);
            let mirrored = rings - 1 - ring;
            for (k, term) in terms.iter().enumerate() {
                folded[0][k][ring.min(mirrored)] += term;
                folded[1][k][ring.min(mirrored)] += if ring <= mirrored { *term } else { -term };
            }
        }
        folded
    }

    /// Values of an expansion at the nodes.
    pub(super) fn synthesis(&self, coefficients: &[f64], values: &mut [f64]) {
        let mut terms = vec![Complex::ZERO; self.weights.len() * self.orders];
        self.polar.synthesis(coefficients, &mut terms);
        let mut workspace = self.fft.workspace();
        let rings = values.chunks_exact_mut(self.fft.points());
        for (terms, ring) in terms.chunks_exact(self.orders).zip(rings) {
            self.fft.synthesis(terms, ring, &mut workspace);
        }
    }

    /// The transpose of [`Self::synthesis`]. Overwrites `values`.
    pub(super) fn adjoint(&self, values: &mut [f64], coefficients: &mut [f64]) {
        let mut terms = vec![Complex::ZERO; self.weights.len() * self.orders];
        let mut workspace = self.fft.workspace();
        let rings = values.chunks_exact_mut(self.fft.points());
        for (terms, ring) in terms.chunks_exact_mut(self.orders).zip(rings) {
            self.fft.adjoint(ring, terms, &mut workspace);
        }
        self.polar.adjoint(&terms, coefficients);
    }
}
