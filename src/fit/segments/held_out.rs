//! What a fit says of samples that it has not seen: leave-one-out errors in closed form.
//!
//! Predicted from the fit of all samples but itself, a sample is missed by e / (1 - h), with e its
//! residual and h its leverage, the squared length of z = R^-T b; exact for least squares. The
//! columns of z are ordered by degree, so one pass gives the errors of every degree.

use crate::fit::linear::Triangle;
use crate::fit::prepare::Sample;
use crate::sphere::coefficient_count;
use crate::vectorize::vectorize;

/// Floor of 1 - h: rounding can take the leverage of a sample that alone decides a coefficient to 1.
const LEAST_SPARE: f64 = 1e-6;

/// Partial sums, whose fixed number makes the result independent of the processor.
const LANES: usize = 8;

/// Errors of predicted samples.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct HeldOut {
    /// Sum of squared errors.
    pub(crate) squared: f64,
    /// Largest error, relative to the radius.
    pub(crate) worst: f64,
    /// Number of samples predicted.
    pub(crate) count: usize,
}

impl HeldOut {
    /// The errors of two sets of samples together.
    pub(crate) fn and(self, other: Self) -> Self {
        Self {
            squared: self.squared + other.squared,
            worst: self.worst.max(other.worst),
            count: self.count + other.count,
        }
    }
}

/// Predicts every probe at all degrees up to `top`. `basis` holds the basis values at the probes,
/// column by column, and is overwritten.
pub(crate) fn leave_one_out(
    triangle: &Triangle<'_>,
    top: usize,
    probes: &[Sample],
    basis: &mut [f64],
) -> Vec<HeldOut> {
    let rows = probes.len();
    let mut out = vec![HeldOut::default(); top + 1];
    if rows == 0 {
        return out;
    }
    triangle.whiten(basis, rows, coefficient_count(top));
    let mut residual: Vec<f64> = probes.iter().map(|sample| sample[3]).collect();
    let per_radius: Vec<f64> = residual.iter().map(|radius| 1.0 / radius).collect();
    let mut spare = vec![1.0; rows];
    vectorize(
        #[inline(always)]
        || {
            for (degree, out) in out.iter_mut().enumerate() {
                for j in degree * degree..coefficient_count(degree) {
                    let projection = triangle.projection(j);
                    let z = &basis[j * rows..(j + 1) * rows];
                    for ((residual, spare), z) in residual.iter_mut().zip(&mut spare).zip(z) {
                        *residual -= z * projection;
                        *spare -= z * z;
                    }
                }
                *out = errors(&residual, &spare, &per_radius);
            }
        },
    );
    out
}

/// Sums up the errors residual / spare.
#[inline(always)]
fn errors(residual: &[f64], spare: &[f64], per_radius: &[f64]) -> HeldOut {
    let (mut squared, mut worst) = ([0.0; LANES], [0.0_f64; LANES]);
    let mut add = |lane: usize, residual: f64, spare: f64, per_radius: f64| {
        let error = residual
            / if spare > LEAST_SPARE {
                spare
            } else {
                LEAST_SPARE
            };
        let relative = (error * per_radius).abs();
        squared[lane] += error * error;
        worst[lane] = if relative > worst[lane] {
            relative
        } else {
            worst[lane]
        };
    };
    let whole = residual.len() / LANES * LANES;
    for at in (0..whole).step_by(LANES) {
        let block =
            |list: &[f64]| -> [f64; LANES] { list[at..at + LANES].try_into().expect("LANES long") };
        let (residual, spare, per_radius) = (block(residual), block(spare), block(per_radius));
        for lane in 0..LANES {
            add(lane, residual[lane], spare[lane], per_radius[lane]);
        }
    }
    for i in whole..residual.len() {
        add(i - whole, residual[i], spare[i], per_radius[i]);
    }
    HeldOut {
        squared: squared.iter().sum(),
        worst: worst.into_iter().fold(0.0, f64::max),
        count: residual.len(),
    }
}
