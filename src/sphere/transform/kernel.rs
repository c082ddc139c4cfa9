//! The kernel of the interpolation, and how much of each frequency it lets through.
//!
//! ```text
//! psi(z) = exp(beta (sqrt(1 - z^2) - 1)),   |z| <= 1 = WIDTH / 2 grid steps
//! ```
//!
//! (Barnett, Magland, af Klinteberg: A parallel nonuniform fast Fourier transform library based on an
//! "exponential of semicircle" kernel, 2019). A sum of psi over the grid times a wave of frequency k
//! is the wave times [`KernelTransform::at`], but for the wave's aliases on the grid. On a grid twice as
//! fine as the largest frequency needs they are below 5e-9 of the amplitude in each direction for a WIDTH
//! of 10, and below 1e-14 for one of 16.

use crate::sphere::GaussLegendre;
use std::f64::consts::PI;

/// beta over WIDTH: least error on a grid oversampled twofold.
const SHARPNESS: f64 = 2.25;
/// Nodes for the transform of the kernel: it is exact to 1e-14.
const NODES: usize = 80;

fn kernel(width: usize, z: f64) -> f64 {
    (SHARPNESS * width as f64 * ((1.0 - z * z).max(0.0).sqrt() - 1.0)).exp()
}

/// The weights of the WIDTH grid points around a place. Within a grid step each of them is a polynomial of degree WIDTH in
/// where the place lies, to 1e-10 for a WIDTH of 10 and to 1e-14 for one of 16: less than the aliases.
pub(super) struct Weights<const WIDTH: usize> {
    /// Of all weights the coefficients of the highest power of x, of the next, ...: x runs from -1 to 1 over the step.
    powers: Vec<[f64; WIDTH]>,
}

impl<const WIDTH: usize> Weights<WIDTH> {
    /// Finds the polynomials by interpolation at Chebyshev's nodes.
    pub(super) fn new() -> Self {
        let (count, half) = (WIDTH + 1, (WIDTH / 2) as f64);
        let angle = |node: usize| PI * (node as f64 + 0.5) / count as f64;
        let value = |i: usize, node: usize| {
            let from_place = 0.5 * (angle(node).cos() + 1.0) - half + i as f64;
            kernel(WIDTH, from_place / half)
        };
        let mut powers = vec![[0.0; WIDTH]; count];
        // The powers in T_(j-1) and in T_j.
        let (mut below, mut current) = (vec![0.0; count], vec![0.0; count]);
        current[0] = 1.0;
        for j in 0..count {
            let per = if j == 0 { 1.0 } else { 2.0 };
            for i in 0..WIDTH {
                let wave = |node: usize| value(i, node) * (j as f64 * angle(node)).cos();
                let share = per / count as f64 * (0..count).map(wave).sum::<f64>();
                for (power, in_current) in powers.iter_mut().rev().zip(&current) {
                    power[i] += share * in_current;
                }
            }
            for (power, below) in below.iter_mut().enumerate() {
                let lower = power.checked_sub(1).map_or(0.0, |lower| current[lower]);
                *below = per * lower - *below;
            }
            std::mem::swap(&mut below, &mut current);
        }
        Self { powers }
    }

    /// Weights of the grid points ceil(t) - WIDTH / 2, ..., ceil(t) + WIDTH / 2 - 1 at the place t, in grid steps.
    #[inline(always)]
    pub(super) fn at(&self, t: f64) -> [f64; WIDTH] {
        let x = 2.0 * (t.ceil() - t) - 1.0;
        let mut weights = [0.0; WIDTH];
        for coefficients in &self.powers {
            for i in 0..WIDTH {
                weights[i] = weights[i] * x + coefficients[i];
            }
        }
        weights
    }
}

/// Fourier transform of the kernel.
pub(super) struct KernelTransform {
    width: usize,
    /// Nodes z in (0, 1) and weights times psi(z).
    nodes: Vec<(f64, f64)>,
}

impl KernelTransform {
    pub(super) fn new(width: usize) -> Self {
        let rule = GaussLegendre::new(NODES);
        let nodes = rule.on(0.0, 1.0).map(|(z, w)| (z, w * kernel(width, z)));
        Self {
            width,
            nodes: nodes.collect(),
        }
    }

    /// The factor by which waves of `frequency` periods around a grid of `points` come out.
    pub(super) fn at(&self, frequency: usize, points: usize) -> f64 {
        let per_z = PI * (frequency * self.width) as f64 / points as f64;
        let half: f64 = self.nodes.iter().map(|(z, w)| w * (per_z * z).cos()).sum();
        self.width as f64 * half
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn error<const WIDTH: usize>() -> f64 {
        let (weights, half) = (Weights::<WIDTH>::new(), (WIDTH / 2) as f64);
        let errors = (1..1000).flat_map(|k| {
            let t = 3.0 + 1e-3 * f64::from(k);
            let found = weights.at(t).into_iter().enumerate();
            found.map(move |(i, w)| (w - kernel(WIDTH, (4.0 - half + i as f64 - t) / half)).abs())
        });
        errors.fold(0.0, f64::max)
    }

    #[test]
    fn weights_are_those_of_the_kernel() {
        assert!(error::<10>() < 1e-10, "{:e}", error::<10>());
        assert!(error::<16>() < 1e-14, "{:e}", error::<16>());
    }
}
