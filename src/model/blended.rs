//! A radius made of overlapping expansions, blended so that no seam is left.

use super::InvalidGrain;
use super::blend::Blend;
use super::invalid::check_expansion;
use crate::sphere::{Cap, CapBasis, Cover, Jet};
use nalgebra::Vector3;

/// r(n) = sum of w_i(n) f_i(n) / sum of w_i(n), with an expansion f_i in spherical harmonics and a
/// smooth weight w_i per cell of a [`Cover`]: continuous with two derivatives everywhere.
///
/// The weights are those of the cover: 1 in the middle of a cell, 0 beyond its margin. One evaluation
/// touches the expansions of the one to four cells near by (a few more where cells of different sizes
/// meet).
#[derive(Debug, Clone)]
pub struct Blended {
    radius: Blend<1>,
}

impl Blended {
    /// A blend of one list of cap-basis coefficients per cell of the cover, in its order.
    ///
    /// # Errors
    /// [`InvalidGrain`] if the lists do not fit the cover or hold a number that is not finite.
    pub fn new(cover: Cover, coefficients: Vec<Vec<f64>>) -> Result<Self, InvalidGrain> {
        Ok(Self {
            radius: Blend::new(cover, coefficients, check_expansion)?,
        })
    }

    /// The cells and their weights.
    pub fn cover(&self) -> &Cover {
        &self.radius.cover
    }

    /// The cap-basis coefficients of every cell: (L+1)^2 numbers each, in the scan's unit.
    pub fn coefficients(&self) -> &[Vec<f64>] {
        &self.radius.coefficients
    }

    /// The surface so many times as large.
    pub(crate) fn times(&self, factor: f64) -> Self {
        Self {
            radius: self.radius.times(factor),
        }
    }

    /// The largest degree of any cell.
    pub fn degree(&self) -> usize {
        self.radius.basis.degree()
    }

    /// The number of coefficients that an evaluation touches, as a mean over all directions.
    pub fn coefficients_touched(&self) -> f64 {
        self.radius.coefficients_touched()
    }

    /// The basis, the cap and the coefficients of a cell.
    pub(super) fn expansion(&self, cell: usize) -> (&CapBasis, &Cap, &[f64]) {
        let Blend {
            cover,
            coefficients,
            basis,
            ..
        } = &self.radius;
        (basis, cover.cap(cell), &coefficients[cell])
    }

    /// Radius of a cell's expansion in a direction of its cap.
    pub(super) fn cell_radius(&self, cell: usize, n: &Vector3<f64>) -> f64 {
        let (basis, cap, coefficients) = self.expansion(cell);
        basis.value(cap, coefficients, n)
    }

    /// Radius in a direction of the grain's own frame.
    pub(crate) fn radius(&self, n: &Vector3<f64>) -> f64 {
        let [radius] = self.radius.values(n);
        radius
    }

    /// Radius and surface gradient in a direction of the grain's own frame.
    pub(crate) fn radius_and_gradient(&self, n: &Vector3<f64>) -> (f64, Vector3<f64>) {
        let [found] = self.radius.values_and_gradients(n);
        found
    }

    /// Radii in many directions, in their order.
    pub(crate) fn radii(&self, directions: &[Vector3<f64>]) -> Vec<f64> {
        self.radius.many_values(directions).into_flattened()
    }

    /// Radii and surface gradients in many directions, in their order.
    pub(crate) fn radii_and_gradients(
        &self,
        directions: &[Vector3<f64>],
    ) -> Vec<(f64, Vector3<f64>)> {
        let found = self.radius.many_values_and_gradients(directions);
        found.into_iter().map(|[radius]| radius).collect()
    }

    /// Radius and its derivatives with respect to the components of `n`.
    pub(crate) fn jet(&self, n: &Vector3<f64>) -> Jet {
        let [jet] = self.radius.jets(n);
        jet
    }

    /// The same in many directions, in their order.
    pub(crate) fn jets(&self, directions: &[Vector3<f64>]) -> Vec<Jet> {
        self.radius.many_jets(directions).into_flattened()
    }
}
