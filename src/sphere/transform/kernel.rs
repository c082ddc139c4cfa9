//! The kernel of the interpolation, and how much of each frequency it lets through.
//!
//! ```text
//! psi(z) = exp(beta (sqrt(1 - z^2) - 1)),   |z| <= 1 = WIDTH / 2 grid steps
//! ```
//!
//! (Barnett, Magland, af Klinteberg: A parallel nonuniform fast Fourier transform library based on an
//! "exponential of semicircle" kernel, 2019). A sum of psi over the grid times a wave of frequency k
//! is the wave times [`KernelTransform::at`], but for the wave's aliases on the grid. On a grid twice as
//! fine as the largest frequency needs they are below 5e-9 of the amplitude in each direction.

use crate::sphere::GaussLegendre;
use std::f64::consts::PI;

/// Grid points that a place is interpolated from, in each direction.
pub(super) const WIDTH: usize = 10;
/// Grid points on either side of a place.
pub(super) const HALF_WIDTH: usize = WIDTH / 2;
/// beta: least error for this width on a grid oversampled twofold.
const SHARPNESS: f64 = 2.25 * WIDTH as f64;
/// Nodes for the transform of the kernel: it is exact to 1e-12.
const NODES: usize = 48;

fn kernel(z: f64) -> f64 {
    (SHARPNESS * ((1.0 - z * z).max(0.0).sqrt() - 1.0)).exp()
}

/// Weights of the grid points ceil(t) - HALF_WIDTH, ..., ceil(t) + HALF_WIDTH - 1 at the place t, in
/// grid steps.
pub(super) fn weights(t: f64) -> [f64; WIDTH] {
    let first = t.ceil() - t - HALF_WIDTH as f64;
    std::array::from_fn(|i| kernel((first + i as f64) / HALF_WIDTH as f64))
}

/// Fourier transform of the kernel.
pub(super) struct KernelTransform {
    /// Nodes z in (0, 1) and weights times psi(z).
    nodes: Vec<(f64, f64)>,
}

impl KernelTransform {
    pub(super) fn new() -> Self {
        let rule = GaussLegendre::new(NODES);
        Self {
            nodes: rule.on(0.0, 1.0).map(|(z, w)| (z, w * kernel(z))).collect(),
        }
    }

    /// The factor by which waves of `frequency` periods around a grid of `points` come out.
    pub(super) fn at(&self, frequency: usize, points: usize) -> f64 {
        let per_z = 2.0 * PI * (frequency * HALF_WIDTH) as f64 / points as f64;
        let half: f64 = self.nodes.iter().map(|(z, w)| w * (per_z * z).cos()).sum();
        WIDTH as f64 * half
    }
}
