//! A radius made of one expansion of the whole sphere.

mod azimuth;
mod degrees;

use super::invalid::check_expansion;
use super::{Derivatives, InvalidGrain, StarSurface};
use crate::sphere::{HarmonicBasis, Jet, Jets};
use crate::vectorize::vectorize;
use azimuth::Azimuth;
use degrees::{Degrees, Sums};
use nalgebra::Vector3;
use rayon::prelude::*;

/// r(n) = sum of a_l^m Y_l^m(n) over the whole sphere, in the real orthonormal harmonics of
/// [`HarmonicBasis`]: smooth everywhere. Each evaluation touches every
/// coefficient.
#[derive(Debug, Clone)]
pub struct Whole {
    pub(super) coefficients: Vec<f64>,
    basis: HarmonicBasis,
    degrees: Degrees,
}

/// Directions evaluated together: more than fit a register, for each step of the recurrence waits for the
/// one before.
const LANES: usize = 16;

/// The same with derivatives, which take more registers.
const FEWER_LANES: usize = 8;

impl Whole {
    /// The largest degree of an expansion.
    pub const MAX_DEGREE: usize = 128;

    /// The expansion with the coefficients a_l^m at index l(l+1) + m, in the scan's unit.
    ///
    /// # Errors
    /// [`InvalidGrain`] if they are not (L+1)^2 finite numbers, or L is above [`Self::MAX_DEGREE`].
    pub fn new(coefficients: Vec<f64>) -> Result<Self, InvalidGrain> {
        let degree = check_expansion(0, &coefficients)?;
        Ok(Self {
            coefficients,
            basis: HarmonicBasis::new(degree),
            degrees: Degrees::new(degree),
        })
    }

    /// The coefficients a_l^m at index l(l+1) + m, in the scan's unit.
    pub fn coefficients(&self) -> &[f64] {
        &self.coefficients
    }

    /// The surface so many times as large.
    pub(crate) fn times(&self, factor: f64) -> Self {
        let mut found = self.clone();
        for coefficient in found.coefficients.iter_mut() {
            *coefficient *= factor;
        }
        found
    }

    /// The degree of the expansion.
    pub fn degree(&self) -> usize {
        self.degrees.degree()
    }

    /// Radii in many directions, in their order.
    pub(crate) fn radii(&self, directions: &[Vector3<f64>]) -> Vec<f64> {
        many(
            directions,
            #[inline(always)]
            |[x, y, z], count, radii| {
                radii.extend_from_slice(&self.values::<LANES>([x, y, z])[..count]);
            },
        )
    }

    /// Radii and their derivatives with respect to the components of the direction, likewise.
    pub(crate) fn jets(&self, directions: &[Vector3<f64>]) -> Vec<Jet> {
        many(
            directions,
            #[inline(always)]
            |[x, y, z], count, jets| {
                let found = self.derivatives_in::<FEWER_LANES>([x, y, z]);
                jets.extend((0..count).map(|lane| found.jet_at(lane)));
            },
        )
    }

    /// Radii in N directions, given component by component.
    #[inline(always)]
    fn values<const N: usize>(&self, [x, y, z]: [&[f64; N]; 3]) -> [f64; N] {
        let mut values = [0.0; N];
        let (mut re, mut im) = ([1.0; N], [0.0; N]);
        self.degrees.sums(
            &self.coefficients,
            z,
            #[inline(always)]
            |[a]: &Sums<1, N>, [b]: &Sums<1, N>| {
                for i in 0..N {
                    values[i] += a[i] * re[i] + b[i] * im[i];
                    (re[i], im[i]) = (re[i] * x[i] - im[i] * y[i], re[i] * y[i] + im[i] * x[i]);
                }
            },
        );
        values
    }

    /// Radii and their derivatives in N directions, likewise.
    #[inline(always)]
    fn derivatives_in<const N: usize>(&self, [x, y, z]: [&[f64; N]; 3]) -> Jets<2, N> {
        let mut jets = Jets::<2, N>::ZERO;
        // (x + iy)^m, ^(m-1) and ^(m-2); zero where the power is negative.
        let mut re = [[1.0; N], [0.0; N], [0.0; N]];
        let mut im = [[0.0; N]; 3];
        let mut order = 0.0;
        self.degrees.sums(
            &self.coefficients,
            z,
            #[inline(always)]
            |a: &Sums<3, N>, b: &Sums<3, N>| {
                let twice = order * (order - 1.0);
                for i in 0..N {
                    let along_x =
                        |d: usize, low: usize| a[d][i] * re[low][i] + b[d][i] * im[low][i];
                    let along_y =
                        |d: usize, low: usize| b[d][i] * re[low][i] - a[d][i] * im[low][i];
                    jets.value[i] += along_x(0, 0);
                    jets.gradient[0][i] += order * along_x(0, 1);
                    jets.gradient[1][i] += order * along_y(0, 1);
                    jets.gradient[2][i] += along_x(1, 0);
                    jets.hessian[0][i] += twice * along_x(0, 2);
                    jets.hessian[1][i] -= twice * along_x(0, 2);
                    jets.hessian[2][i] += along_x(2, 0);
                    jets.hessian[3][i] += order * along_y(1, 1);
                    jets.hessian[4][i] += order * along_x(1, 1);
                    jets.hessian[5][i] += twice * along_y(0, 2);
                }
                (re[2], im[2]) = (re[1], im[1]);
                (re[1], im[1]) = (re[0], im[0]);
                for i in 0..N {
                    let (c, s) = (re[0][i], im[0][i]);
                    (re[0][i], im[0][i]) = (c * x[i] - s * y[i], c * y[i] + s * x[i]);
                }
                order += 1.0;
            },
        );
        jets
    }

    /// The expansion in directions of equal z, order by order: A and B of A Re w^m + B Im w^m with w = x + iy.
    pub(super) fn each_order(&self, z: f64, mut each: impl FnMut(f64, f64)) {
        let value = |[[a]]: &Sums<1, 1>, [[b]]: &Sums<1, 1>| each(*a, *b);
        self.degrees.sums(&self.coefficients, &[z], value);
    }

    /// Radii and surface gradients in directions of equal z, given by their x and y.
    pub(crate) fn radii_and_gradients_at(
        &self,
        z: f64,
        places: &[[f64; 2]],
    ) -> Vec<(f64, Vector3<f64>)> {
        let mut orders = Vec::with_capacity(self.degree() + 1);
        let keep = |a: &Sums<2, 1>, b: &Sums<2, 1>| orders.push((a.map(|[a]| a), b.map(|[b]| b)));
        self.degrees.sums(&self.coefficients, &[z], keep);
        let at = |&[x, y]: &[f64; 2]| {
            let mut azimuth = Azimuth::new(x, y);
            for &(a, b) in &orders {
                azimuth.add(a, b);
            }
            azimuth.on_sphere(&Vector3::new(x, y, z))
        };
        places.iter().map(at).collect()
    }

    /// Radius and its derivatives with respect to the components of `n`.
    pub(crate) fn jet(&self, n: &Vector3<f64>) -> Jet {
        self.basis.jet(&self.coefficients, n)
    }
}

/// What `of` adds, block by block, to a list, from the components of N directions and how many of them are asked for.
fn many<const N: usize, T: Send>(
    directions: &[Vector3<f64>],
    of: impl Fn([&[f64; N]; 3], usize, &mut Vec<T>) + Sync,
) -> Vec<T> {
    let tasks = directions.par_chunks(LANES * 16);
    let parts = tasks.map(|directions| {
        let mut found = Vec::with_capacity(directions.len());
        vectorize(
            #[inline(always)]
            || {
                for block in directions.chunks(N) {
                    let at = |axis: usize| -> [f64; N] {
                        std::array::from_fn(|lane| block[lane.min(block.len() - 1)][axis])
                    };
                    of([&at(0), &at(1), &at(2)], block.len(), &mut found);
                }
            },
        );
        found
    });
    parts.flatten_iter().collect()
}

impl StarSurface for Whole {
    fn radius(&self, n: &Vector3<f64>) -> f64 {
        let [radius] = self.values([&[n.x], &[n.y], &[n.z]]);
        radius
    }

    fn radius_and_gradient(&self, n: &Vector3<f64>) -> (f64, Vector3<f64>) {
        self.basis.value_and_gradient(&self.coefficients, n)
    }

    fn derivatives(&self, n: &Vector3<f64>) -> Derivatives {
        Derivatives::on_sphere(n, &self.jet(n))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shapes::Sampling;
    use approx::assert_relative_eq;

    /// Of more directions than lanes, the poles among them.
    #[test]
    fn many_jets_are_those_of_each_direction() {
        let coefficients = (0..81).map(|i| (1.3 * f64::from(i) + 0.4).sin()).collect();
        let whole = Whole::new(coefficients).unwrap();
        let mut directions = Sampling::Fibonacci.directions(19, 0).unwrap();
        directions.extend([Vector3::z(), -Vector3::z()]);
        let many = whole.jets(&directions);
        assert_eq!(many.len(), directions.len());
        for (n, found) in directions.iter().zip(many) {
            let own = whole.jet(n);
            assert_relative_eq!(found.value, own.value, epsilon = 1e-12);
            assert_relative_eq!(found.gradient, own.gradient, epsilon = 1e-11);
            assert_relative_eq!(found.hessian, own.hessian, epsilon = 1e-10);
        }
    }
}
