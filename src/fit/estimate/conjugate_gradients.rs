//! Posterior systems by conjugate gradients, preconditioned by the matrix of an even cloud or by a rough factor.

use super::dense::Factor;
use super::posterior::{Conditioned, Posterior};
use super::stopping::Enough;
use crate::vectorize::{dot, vectorize};
use rayon::prelude::*;
use std::f64::consts::PI;

/// Steps of a solution at most.
pub(crate) const MOST_STEPS: usize = 1000;

impl Conditioned<'_> {
    /// From Y'WY x to (Y'WY / s^2 + V^-1) x.
    fn add_prior(&self, x: &[f64], out: &mut [f64]) {
        vectorize(
            #[inline(always)]
            || {
                for ((out, x), v) in out.iter_mut().zip(x).zip(&self.variances) {
                    *out = *out / self.noise + x / v;
                }
            },
        );
    }

    /// Solves C^-1 x = right for each right-hand side, side by side; `start` tells where each begins.
    pub(super) fn solve_each(
        &self,
        rights: &[Vec<f64>],
        start: impl Fn(usize) -> Option<Vec<f64>> + Sync,
        enough: Enough,
    ) -> Vec<Vec<f64>> {
        self.posterior.make_gram();
        let rights = rights.par_iter().enumerate();
        let solved = rights.map(|(i, right)| {
            let (x, _) = self.conjugate_gradients(right, start(i).as_deref(), enough);
            x
        });
        solved.collect()
    }

    /// Solves C^-1 x = right, from `start`; also tells the number of steps.
    pub(super) fn conjugate_gradients(
        &self,
        right: &[f64],
        start: Option<&[f64]>,
        enough: Enough,
    ) -> (Vec<f64>, usize) {
        let even = self.posterior.cloud.weights.iter().sum::<f64>() / (4.0 * PI * self.noise);
        let preconditioner: Vec<f64> = self
            .variances
            .iter()
            .map(|v| 1.0 / (even + 1.0 / v))
            .collect();
        let precondition = |r: &[f64], z: &mut [f64]| {
            vectorize(
                #[inline(always)]
                || {
                    for ((z, r), p) in z.iter_mut().zip(r).zip(&preconditioner) {
                        *z = r * p;
                    }
                },
            );
        };
        self.steps(right, start, enough, precondition)
    }

    /// Solves C^-1 x = right to rounding, by a factor of single precision; also tells the number of steps.
    pub(super) fn refined(&self, factor: &Factor, right: &[f64]) -> (Vec<f64>, usize) {
        self.steps(right, None, Enough::Rounding, |r, z| {
            z.copy_from_slice(r);
            factor.solve(z);
        })
    }

    fn steps(
        &self,
        right: &[f64],
        start: Option<&[f64]>,
        enough: Enough,
        precondition: impl Fn(&[f64], &mut [f64]),
    ) -> (Vec<f64>, usize) {
        let count = right.len();
        let Posterior { sums, cloud, .. } = self.posterior;
        let gram = sums.gram(cloud);
        let mut workspace = gram.workspace();
        let mut precision = |x: &[f64], out: &mut [f64]| {
            gram.apply(x, &mut workspace, out);
            self.add_prior(x, out);
        };
        let (mut x, mut q) = (vec![0.0; count], vec![0.0; count]);
        let mut r = right.to_vec();
        if let Some(start) = start {
            x.copy_from_slice(start);
            precision(&x, &mut q);
            r.iter_mut().zip(&q).for_each(|(r, q)| *r -= q);
        }
        let product = |a: &[f64], b: &[f64]| {
            vectorize(
                #[inline(always)]
                || dot(a, b),
            )
        };
        let mut z = vec![0.0; count];
        precondition(&r, &mut z);
        let mut p = z.clone();
        let mut rz = product(&r, &z);
        let mut energies: Vec<f64> = Vec::new();
        while energies.len() < MOST_STEPS && rz > 0.0 {
            precision(&p, &mut q);
            let step = rz / product(&p, &q);
            vectorize(
                #[inline(always)]
                || {
                    let (p, q) = (&p[..count], &q[..count]);
                    let (x, r) = (&mut x[..count], &mut r[..count]);
                    for i in 0..count {
                        x[i] += step * p[i];
                        r[i] -= step * q[i];
                    }
                },
            );
            energies.push(step * rz);
            if enough.is_reached(&energies, rz) {
                break;
            }
            precondition(&r, &mut z);
            let next = product(&r, &z);
            let share = next / rz;
            p.iter_mut().zip(&z).for_each(|(p, z)| *p = z + share * *p);
            rz = next;
        }
        (x, energies.len())
    }
}
