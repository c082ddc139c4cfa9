//! An expansion on a cap, in the form in which it is evaluated.
//!
//! In the coordinates z = u + iv and x of its [cap](super::cap_basis) an expansion is
//!
//! ```text
//! f = Re sum over m of z^m sum over j of c_mj T_j(x),   m = 0..L,  j = 0..L-m
//! ```
//!
//! with complex numbers c_mj and the Chebyshev polynomials T_j: Horner's rule in z, Clenshaw's in x, and derivatives
//! of both. Three operations on the real or the imaginary part of a number c_mj are a third of what the Jacobi
//! polynomials of the basis take, and Clenshaw's rule is stable for any degree.

use super::jets::entry;
use super::{Cap, CapBasis, Jet, Jets};
use nalgebra::Vector3;

/// K expansions on a cap, ready to be evaluated. Up to degree 20 they agree with those of [`CapBasis`] to 1e-13 of the
/// sum of the coefficients' sizes.
#[derive(Debug, Clone)]
pub(crate) struct CapExpansion<const K: usize> {
    centre: Vector3<f64>,
    /// Gradients of u and v.
    tangents: [Vector3<f64>; 2],
    per_height: f64,
    degree: usize,
    /// The real and the imaginary parts of c_mj, m and within it j falling.
    terms: Vec<[[f64; K]; 2]>,
}

/// A polynomial of z and x at N places, and its derivatives; complex.
#[derive(Clone, Copy)]
struct Complex<const N: usize>([f64; N], [f64; N]);

impl<const N: usize> Complex<N> {
    const ZERO: Self = Self([0.0; N], [0.0; N]);

    /// This number times z plus another.
    #[inline(always)]
    fn step(&self, [u, v]: [&[f64; N]; 2], other: &Self) -> Self {
        let mut out = Self::ZERO;
        for i in 0..N {
            out.0[i] = self.0[i] * u[i] - self.1[i] * v[i] + other.0[i];
            out.1[i] = self.0[i] * v[i] + self.1[i] * u[i] + other.1[i];
        }
        out
    }

    #[inline(always)]
    fn twice(&self) -> Self {
        let mut out = *self;
        for i in 0..N {
            out.0[i] *= 2.0;
            out.1[i] *= 2.0;
        }
        out
    }
}

impl<const K: usize> CapExpansion<K> {
    /// The expansions whose coefficients in the basis stand side by side.
    pub(crate) fn new(basis: &CapBasis, cap: &Cap, coefficients: &[[f64; K]]) -> Self {
        Self {
            centre: cap.centre,
            tangents: cap.tangents.map(|e| e / cap.tangent_length()),
            per_height: 1.0 / cap.height,
            degree: coefficients.len().isqrt().saturating_sub(1),
            terms: basis.chebyshev(coefficients),
        }
    }

    /// The expansions in N directions, given component by component.
    #[inline(always)]
    pub(crate) fn jets<const ORDER: usize, const N: usize>(
        &self,
        n: &[[f64; N]; 3],
    ) -> [Jets<ORDER, N>; K] {
        let (mut u, mut v, mut x) = ([0.0; N], [0.0; N], [0.0; N]);
        let (c, [e1, e2]) = (&self.centre, &self.tangents);
        for i in 0..N {
            let n = Vector3::new(n[0][i], n[1][i], n[2][i]);
            (u[i], v[i]) = (e1.dot(&n), e2.dot(&n));
            x[i] = (n - c).norm_squared() * self.per_height - 1.0;
        }
        let mut out = [Jets::ZERO; K];
        for (k, out) in out.iter_mut().enumerate() {
            // In one direction, loops of the degrees that cells usually have are unrolled; in many at once
            // registers would not do.
            let z = [&u, &v];
            let [p, p_z, p_x, p_zz, p_zx, p_xx] = match self.degree {
                1 if N == 1 => self.polynomial::<ORDER, N>(1, k, z, &x),
                2 if N == 1 => self.polynomial::<ORDER, N>(2, k, z, &x),
                3 if N == 1 => self.polynomial::<ORDER, N>(3, k, z, &x),
                4 if N == 1 => self.polynomial::<ORDER, N>(4, k, z, &x),
                degree => self.polynomial::<ORDER, N>(degree, k, z, &x),
            };
            out.value = p.0;
            if ORDER > 0 {
                self.add_gradient(&p_z, &p_x, out);
            }
            if ORDER > 1 {
                self.add_hessian(&p_zz, &p_zx, &p_xx, out);
            }
        }
        out
    }

    /// The complex polynomial of which an expansion is the real part, and its derivatives along z, x, zz, zx and xx.
    #[inline(always)]
    fn polynomial<const ORDER: usize, const N: usize>(
        &self,
        degree: usize,
        k: usize,
        z: [&[f64; N]; 2],
        x: &[f64; N],
    ) -> [Complex<N>; 6] {
        let [mut p, mut p_z, mut p_x, mut p_zz, mut p_zx, mut p_xx] = [Complex::ZERO; 6];
        let mut rest = self.terms.as_slice();
        for order in 1..=degree + 1 {
            let (own, others) = rest.split_at(order);
            rest = others;
            let re = clenshaw::<0, ORDER, K, N>(own, k, x);
            let im = clenshaw::<1, ORDER, K, N>(own, k, x);
            let (c, c_x, c_xx) = (
                Complex(re[0], im[0]),
                Complex(re[1], im[1]),
                Complex(re[2], im[2]),
            );
            if ORDER > 1 {
                p_zz = p_zz.step(z, &p_z.twice());
                p_zx = p_zx.step(z, &p_x);
                p_xx = p_xx.step(z, &c_xx);
            }
            if ORDER > 0 {
                p_z = p_z.step(z, &p);
                p_x = p_x.step(z, &c_x);
            }
            p = p.step(z, &c);
        }
        [p, p_z, p_x, p_zz, p_zx, p_xx]
    }

    /// The gradients of u, v and x.
    #[inline(always)]
    fn slopes(&self) -> [Vector3<f64>; 3] {
        let [du, dv] = self.tangents;
        [du, dv, self.centre * (-2.0 * self.per_height)]
    }

    /// Along u and v the derivatives of a real part are the real parts of p_z and i p_z.
    #[inline(always)]
    fn add_gradient<const ORDER: usize, const N: usize>(
        &self,
        p_z: &Complex<N>,
        p_x: &Complex<N>,
        out: &mut Jets<ORDER, N>,
    ) {
        let [du, dv, dx] = self.slopes();
        for axis in 0..3 {
            for i in 0..N {
                out.gradient[axis][i] =
                    du[axis] * p_z.0[i] - dv[axis] * p_z.1[i] + dx[axis] * p_x.0[i];
            }
        }
    }

    #[inline(always)]
    fn add_hessian<const ORDER: usize, const N: usize>(
        &self,
        p_zz: &Complex<N>,
        p_zx: &Complex<N>,
        p_xx: &Complex<N>,
        out: &mut Jets<ORDER, N>,
    ) {
        let [du, dv, dx] = self.slopes();
        for j in 0..3 {
            for k in j..3 {
                let of = |a: &Vector3<f64>, b: &Vector3<f64>| a[j] * b[k];
                let both = |a, b| of(a, b) + of(b, a);
                let (uu, uv, xx) = (of(&du, &du) - of(&dv, &dv), both(&du, &dv), of(&dx, &dx));
                let (ux, vx) = (both(&du, &dx), both(&dv, &dx));
                let bends = out.hessian[entry(j, k)].iter_mut();
                for (i, bend) in bends.enumerate() {
                    *bend = uu * p_zz.0[i] - uv * p_zz.1[i] + ux * p_zx.0[i] - vx * p_zx.1[i]
                        + xx * p_xx.0[i];
                }
            }
        }
    }
}

impl CapExpansion<1> {
    /// The expansion in a direction.
    pub(crate) fn value(&self, n: &Vector3<f64>) -> f64 {
        self.jets::<0, 1>(&[[n.x], [n.y], [n.z]])[0].value[0]
    }

    /// The expansion and its surface gradient (per radian, orthogonal to `n`).
    pub(crate) fn value_and_gradient(&self, n: &Vector3<f64>) -> (f64, Vector3<f64>) {
        let n = [[n.x], [n.y], [n.z]];
        let [mut found] = self.jets::<1, 1>(&n);
        found.keep_along_sphere(&n);
        (found.value[0], found.gradient_at(0))
    }

    /// The expansion with its derivatives with respect to the components of `n`.
    pub(crate) fn jet(&self, n: &Vector3<f64>) -> Jet {
        self.jets::<2, 1>(&[[n.x], [n.y], [n.z]])[0].jet_at(0)
    }
}

/// A sum of Chebyshev polynomials, from coefficients of falling degree, at N places, and its derivatives.
#[inline(always)]
fn clenshaw<const PART: usize, const ORDER: usize, const K: usize, const N: usize>(
    falling: &[[[f64; K]; 2]],
    k: usize,
    x: &[f64; N],
) -> [[f64; N]; 3] {
    // b_j = c_j + 2x b_(j+1) - b_(j+2) and its derivatives; the sum is c_0 + x b_1 - b_2.
    let ([mut b, mut b_x, mut b_xx], mut after) = ([[0.0; N]; 3], [[0.0; N]; 3]);
    let mut c = 0.0;
    for (j, term) in falling.iter().enumerate() {
        c = term[PART][k];
        if j + 1 == falling.len() {
            break;
        }
        for i in 0..N {
            let (x, b0, b1, b2) = (2.0 * x[i], b[i], b_x[i], b_xx[i]);
            b[i] = c + x * b0 - after[0][i];
            after[0][i] = b0;
            if ORDER > 0 {
                b_x[i] = 2.0 * b0 + x * b1 - after[1][i];
                after[1][i] = b1;
            }
            if ORDER > 1 {
                b_xx[i] = 4.0 * b1 + x * b2 - after[2][i];
                after[2][i] = b2;
            }
        }
    }
    let mut sum = [[0.0; N]; 3];
    for i in 0..N {
        sum[0][i] = c + x[i] * b[i] - after[0][i];
        if ORDER > 0 {
            sum[1][i] = b[i] + x[i] * b_x[i] - after[1][i];
        }
        if ORDER > 1 {
            sum[2][i] = 2.0 * b_x[i] + x[i] * b_xx[i] - after[2][i];
        }
    }
    sum
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Expansions of a degree on a cap of a height, the second with coefficients in reverse.
    fn expansions(degree: usize, height: f64) -> (CapBasis, Cap, Vec<[f64; 2]>) {
        let count = (degree + 1) * (degree + 1);
        let arbitrary = |i: usize| (1.7 * i as f64 + 0.3 * (i * i) as f64).sin();
        let coefficients = (0..count).map(|i| [arbitrary(i), arbitrary(count - i)]);
        let cap = Cap::new(0.8, 2.1, height);
        (CapBasis::new(degree), cap, coefficients.collect())
    }

    /// Directions in a cap.
    fn directions(cap: &Cap) -> Vec<Vector3<f64>> {
        let at = |i: usize| {
            let (turn, cos) = (2.4 * i as f64, 1.0 - cap.height * (i as f64 + 0.5) / 40.0);
            let across = cap.tangents[0] * turn.cos() + cap.tangents[1] * turn.sin();
            cap.centre * cos + across * (1.0 - cos * cos).sqrt()
        };
        (0..40).map(at).collect()
    }

    #[test]
    fn values_are_those_of_the_basis_to_rounding() {
        for (degree, height) in [(0, 0.3), (1, 2.0), (4, 0.4), (4, 1e-4), (9, 0.1), (20, 0.7)] {
            let (basis, cap, coefficients) = expansions(degree, height);
            let expansion = CapExpansion::new(&basis, &cap, &coefficients);
            for k in 0..2 {
                let own: Vec<f64> = coefficients.iter().map(|pair| pair[k]).collect();
                let size: f64 = own.iter().map(|c| c.abs()).sum();
                for n in directions(&cap) {
                    let found = expansion.jets::<0, 1>(&[[n.x], [n.y], [n.z]])[k].value[0];
                    let error = (found - basis.value(&cap, &own, &n)).abs();
                    assert!(
                        error <= 1e-13 * size,
                        "degree {degree}, {height}: {error:e}"
                    );
                }
            }
        }
    }

    #[test]
    fn derivatives_are_those_of_differences() {
        let (basis, cap, coefficients) = expansions(4, 0.4);
        let expansion = CapExpansion::new(&basis, &cap, &coefficients);
        let jets = |n: &Vector3<f64>| expansion.jets::<2, 1>(&[[n.x], [n.y], [n.z]]);
        let step = 1e-6_f64;
        for n in directions(&cap) {
            let tangent = n.cross(&Vector3::new(0.3, 0.8, 0.1)).normalize();
            let [ahead, behind] = [step, -step].map(|s| n * s.cos() + tangent * s.sin());
            for k in 0..2 {
                let (jet, ahead, behind) = (
                    jets(&n)[k].jet_at(0),
                    jets(&ahead)[k].jet_at(0),
                    jets(&behind)[k].jet_at(0),
                );
                let slope = (ahead.value - behind.value) / (2.0 * step);
                assert!((jet.gradient.dot(&tangent) - slope).abs() < 1e-7);
                let bend = (ahead.gradient - behind.gradient) / (2.0 * step);
                assert!((jet.hessian * tangent - bend).amax() < 1e-6);
            }
        }
    }
}
