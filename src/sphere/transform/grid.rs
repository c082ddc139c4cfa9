//! An expansion on an oversampled grid of the doubled sphere, ready to be interpolated from.

use super::kept::Kept;
use super::kernel::KernelPolynomials;
use super::oversampled::oversampled;
use super::polar::PolarTable;
use crate::sphere::azimuth_fft::{AzimuthFft, even_smooth_number};
use nalgebra::Vector3;
use realfft::num_complex::Complex;
use std::f64::consts::PI;
use std::sync::Arc;

/// Tables of all degrees and widths of the kernel that have been asked for.
static GRIDS: Kept<[usize; 2], Grid> = Kept::new();

/// A grid of rings theta_i = 2 pi i / n, i = 0, ..., n / 2, and equispaced azimuths, twice as fine as
/// the degree needs, with a halo of half the kernel's width around it: beyond a pole the function goes on
/// as f(2 pi - theta, phi) = f(theta, phi + pi). Rows are stored ring by ring.
pub(super) struct Grid {
    polar: PolarTable,
    fft: AzimuthFft,
    around: usize,
    orders: usize,
    halo: usize,
    kernel: KernelPolynomials,
}

impl Grid {
    /// The grid of a degree, for a kernel of an even width. It is made once in a process, and kept.
    pub(super) fn of_degree(degree: usize, width: usize) -> Arc<Self> {
        GRIDS.get([degree, width], || Self::new(degree, width))
    }

    fn new(degree: usize, width: usize) -> Self {
        // At least as many that the halo is copied from within the grid.
        let least = (2 * (2 * degree + 1)).max(2 * width);
        let around = least.next_multiple_of(2);
        let fft = AzimuthFft::new(even_smooth_number(least));
        Self {
            polar: oversampled(degree, width, around, fft.points()),
            fft,
            around,
            orders: degree + 1,
            halo: width / 2,
            kernel: KernelPolynomials::new(width),
        }
    }

    /// The kernel to interpolate with.
    pub(super) fn kernel(&self) -> &KernelPolynomials {
        &self.kernel
    }

    /// Length of a row with its halo.
    pub(super) fn stride(&self) -> usize {
        self.fft.points() + 2 * self.halo
    }

    /// Number of points with the halo.
    pub(super) fn len(&self) -> usize {
        (self.polar.rings() + 2 * self.halo) * self.stride()
    }

    /// Polar angle and azimuth of a direction as coordinates in grid steps, such that their ceilings are the first row and
    /// column to interpolate from.
    pub(super) fn place(&self, n: &Vector3<f64>) -> [f64; 2] {
        let theta = n.x.hypot(n.y).atan2(n.z);
        let phi = n.y.atan2(n.x);
        let phi = if phi < 0.0 { phi + 2.0 * PI } else { phi };
        let (rows, columns) = (self.around as f64, self.fft.points() as f64);
        [
            (theta / (2.0 * PI) * rows).min(rows / 2.0),
            (phi / (2.0 * PI) * columns).min(columns),
        ]
    }

    /// The expansion, each of its waves divided by the kernel's transform, on the grid and its halo.
    pub(super) fn synthesis(&self, coefficients: &[f64]) -> Vec<f64> {
        let mut terms = self.polar.terms();
        self.polar.synthesis(coefficients, &mut terms);
        let mut of_ring = vec![Complex::ZERO; self.orders];
        let mut points = vec![0.0; self.len()];
        let mut workspace = self.fft.workspace();
        for (ring, row) in self.rings(&mut points).enumerate() {
            let at = self.polar.row(ring);
            for (m, term) in of_ring.iter_mut().enumerate() {
                let [cosine, sine] = terms.of_order(m);
                *term = Complex::new(cosine[at], sine[at]);
            }
            self.fft
                .synthesis(&of_ring, self.inner(row), &mut workspace);
        }
        for (ring, beyond) in self.beyond_poles() {
            let (ring, beyond) = self.two_rows(&mut points, ring, beyond);
            let (ring, beyond) = (self.inner(ring), self.inner(beyond));
            let half = ring.len() / 2;
            beyond[..half].copy_from_slice(&ring[half..]);
            beyond[half..].copy_from_slice(&ring[..half]);
        }
        for row in points.chunks_exact_mut(self.stride()) {
            let end = row.len() - self.halo;
            row.copy_within(end - self.halo..end, 0);
            row.copy_within(self.halo..2 * self.halo, end);
        }
        points
    }

    /// The transpose of [`Self::synthesis`]. Overwrites `points`.
    pub(super) fn adjoint(&self, points: &mut [f64], coefficients: &mut [f64]) {
        for row in points.chunks_exact_mut(self.stride()) {
            let end = row.len() - self.halo;
            for i in 0..self.halo {
                row[end - self.halo + i] += row[i];
                row[self.halo + i] += row[end + i];
            }
        }
        for (ring, beyond) in self.beyond_poles() {
            let (ring, beyond) = self.two_rows(points, ring, beyond);
            let (ring, beyond) = (self.inner(ring), self.inner(beyond));
            let half = ring.len() / 2;
            for i in 0..half {
                ring[half + i] += beyond[i];
                ring[i] += beyond[half + i];
            }
        }
        let mut terms = self.polar.terms();
        let mut of_ring = vec![Complex::ZERO; self.orders];
        let mut workspace = self.fft.workspace();
        for (ring, row) in self.rings(points).enumerate() {
            self.fft
                .adjoint(self.inner(row), &mut of_ring, &mut workspace);
            let at = self.polar.row(ring);
            for (m, term) in of_ring.iter().enumerate() {
                let [cosine, sine] = terms.of_order_mut(m);
                (cosine[at], sine[at]) = (term.re, term.im);
            }
        }
        self.polar.adjoint(&terms, coefficients);
    }

    /// Rows of the grid proper.
    fn rings<'a>(&self, points: &'a mut [f64]) -> impl Iterator<Item = &'a mut [f64]> {
        points
            .chunks_exact_mut(self.stride())
            .skip(self.halo)
            .take(self.polar.rings())
    }

    /// Rows of the grid with the rows of the halo that continue them beyond a pole.
    fn beyond_poles(&self) -> impl Iterator<Item = (usize, usize)> + use<> {
        let (north, south) = (self.halo, self.halo + self.polar.rings() - 1);
        (1..=self.halo).flat_map(move |i| [(north + i, north - i), (south - i, south + i)])
    }

    /// Two different rows.
    fn two_rows<'a>(
        &self,
        points: &'a mut [f64],
        first: usize,
        second: usize,
    ) -> (&'a mut [f64], &'a mut [f64]) {
        let stride = self.stride();
        let (low, high) = points.split_at_mut(first.max(second) * stride);
        let low = &mut low[first.min(second) * stride..][..stride];
        let high = &mut high[..stride];
        if first < second {
            (low, high)
        } else {
            (high, low)
        }
    }

    /// A row without its halo.
    fn inner<'a>(&self, row: &'a mut [f64]) -> &'a mut [f64] {
        let end = row.len() - self.halo;
        &mut row[self.halo..end]
    }
}
