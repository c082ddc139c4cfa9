//! One expansion of a part of the sphere, and its mirror images.

use super::invalid::check_expansion;
use super::star_surface::radial_slopes;
use super::{Derivatives, InvalidGrain, StarSurface, Surface, SurfaceJet, Tiling};
use crate::sphere::{CapBasis, CapExpansion, Jet, Symmetry};
use nalgebra::{Matrix3, Vector3};

/// A radius that is mirror-symmetric: r(n) = f(fold(n)), with f one expansion on the region into which
/// the mirrors fold all directions. It is continuous; on the mirror planes it has an edge, and its
/// derivatives are there those of the positive side.
#[derive(Debug, Clone)]
pub struct Mirrored {
    symmetry: Symmetry,
    pub(super) coefficients: Vec<f64>,
    expansion: CapExpansion<1>,
    degree: usize,
}

impl Mirrored {
    /// The expansion with the given coefficients of the cap basis on the least cap round the region that the mirrors
    /// leave.
    ///
    /// # Errors
    /// [`InvalidGrain`] if the coefficients are not (L+1)^2 finite numbers.
    pub fn new(symmetry: Symmetry, coefficients: Vec<f64>) -> Result<Self, InvalidGrain> {
        let degree = check_expansion(0, &coefficients)?;
        Ok(Self::of(symmetry, coefficients, degree))
    }

    fn of(symmetry: Symmetry, coefficients: Vec<f64>, degree: usize) -> Self {
        let (basis, (own, _)) = (CapBasis::new(degree), coefficients.as_chunks());
        Self {
            symmetry,
            expansion: CapExpansion::new(&basis, &symmetry.cap(), own),
            coefficients,
            degree,
        }
    }

    /// The mirrors, in the grain's own frame.
    pub fn symmetry(&self) -> Symmetry {
        self.symmetry
    }

    /// The cap-basis coefficients: (L+1)^2 numbers in the scan's unit.
    pub fn coefficients(&self) -> &[f64] {
        &self.coefficients
    }

    /// The surface so many times as large.
    pub(crate) fn times(&self, factor: f64) -> Self {
        let coefficients = self.coefficients.iter().map(|c| c * factor).collect();
        Self::of(self.symmetry, coefficients, self.degree)
    }

    /// The degree of the expansion.
    pub fn degree(&self) -> usize {
        self.degree
    }

    /// Radius and its derivatives with respect to the components of `n`.
    pub(crate) fn jet(&self, n: &Vector3<f64>) -> Jet {
        let signs = self.symmetry.signs(n);
        let folded = n.component_mul(&signs);
        let jet = self.expansion.jet(&folded);
        let unfold = Matrix3::from_diagonal(&signs);
        Jet {
            value: jet.value,
            gradient: jet.gradient.component_mul(&signs),
            hessian: unfold * jet.hessian * unfold,
        }
    }
}

impl StarSurface for Mirrored {
    fn radius(&self, n: &Vector3<f64>) -> f64 {
        self.expansion.value(&self.symmetry.fold(n))
    }

    fn radius_and_gradient(&self, n: &Vector3<f64>) -> (f64, Vector3<f64>) {
        let signs = self.symmetry.signs(n);
        let folded = n.component_mul(&signs);
        let (radius, gradient) = self.expansion.value_and_gradient(&folded);
        (radius, gradient.component_mul(&signs))
    }

    fn derivatives(&self, n: &Vector3<f64>) -> Derivatives {
        Derivatives::on_sphere(n, &self.jet(n))
    }
}

impl Surface for Mirrored {
    fn place_and_slopes(&self, n: &Vector3<f64>) -> (Vector3<f64>, Matrix3<f64>) {
        let found = self.radius_and_gradient(n);
        (n * found.0, radial_slopes(n, found))
    }

    fn jet(&self, n: &Vector3<f64>) -> SurfaceJet {
        self.derivatives(n).radial(n)
    }

    fn tiling(&self) -> Tiling {
        Tiling::mirrored(self.symmetry)
    }

    fn may_cross(&self) -> bool {
        false
    }
}

#[cfg(test)]
mod tests;
