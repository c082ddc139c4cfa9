//! The star-shaped grain: a radius and where it lies in the scan.

use super::star_surface::radial_slopes;
use super::{
    Derivatives, Family, Frame, InvalidGrain, Node, StarSurface, Stretch, Surface, SurfaceElement,
    SurfaceJet, Tiling, Whole,
};
use crate::sphere::unit;
use nalgebra::{Matrix3, Point3, Vector3};
use rayon::prelude::*;

/// Directions whose radii are found at once: what is made of them on the way stays near the processor.
const CHUNK: usize = 1 << 15;

/// A star-shaped surface whose radius is made of expansions in spherical harmonics.
///
/// Directions and positions are those of the scan. The radius is measured from [`Frame::centre`]. The
/// expansions are those of the grain stretched along its own axes, see [`StarGrain::stretched`]. Directions may have any
/// length but zero.
#[derive(Debug, Clone)]
pub struct StarGrain {
    frame: Frame,
    stretch: Stretch,
    family: Family,
}

impl StarGrain {
    /// A grain from its parts, not stretched.
    ///
    /// # Errors
    /// [`InvalidGrain`] if the frame is not orthonormal or not finite.
    pub fn new(frame: Frame, family: Family) -> Result<Self, InvalidGrain> {
        Self::stretched(frame, Stretch::NONE, family)
    }

    /// A grain whose radius is one expansion in real orthonormal harmonics, at their
    /// [indices](crate::sphere::harmonic_index).
    ///
    /// # Errors
    /// [`InvalidGrain`] as [`new`](Self::new), and if the coefficients make no expansion.
    pub fn expansion(frame: Frame, coefficients: Vec<f64>) -> Result<Self, InvalidGrain> {
        Self::new(frame, Family::Whole(Whole::new(coefficients)?))
    }

    /// A grain whose `family` is that of the grain stretched along the axes of the frame: with
    /// T = diag of the factors and r' the radius of the family, r(n) = r'(T n / |T n|) / |T n| for a
    /// unit vector n of the frame.
    ///
    /// # Errors
    /// [`InvalidGrain`] if the frame is not orthonormal or not finite.
    pub fn stretched(frame: Frame, stretch: Stretch, family: Family) -> Result<Self, InvalidGrain> {
        frame.check()?;
        Ok(Self {
            frame,
            stretch,
            family,
        })
    }

    /// The grain about the origin, so many times as large.
    pub(crate) fn about_origin(&self, factor: f64) -> Self {
        Self {
            frame: Frame {
                centre: Point3::origin(),
                ..self.frame
            },
            stretch: self.stretch,
            family: self.family.times(factor),
        }
    }

    /// The stretch along the axes of the frame after which the grain is that of the [family](Self::family).
    pub fn stretch(&self) -> &Stretch {
        &self.stretch
    }

    /// The radius, in the grain's own frame, of the [stretched](Self::stretch) grain.
    pub fn family(&self) -> &Family {
        &self.family
    }

    /// Coefficients per segment: (L+1)^2 numbers in the scan's unit. Of the whole sphere those of the
    /// harmonics, else of the cap basis.
    pub fn coefficients(&self) -> &[Vec<f64>] {
        self.family.coefficients()
    }

    /// The number of segments, that is of expansions.
    pub fn segments(&self) -> usize {
        self.coefficients().len()
    }

    /// The largest degree of any segment.
    pub fn degree(&self) -> usize {
        self.family.degree()
    }

    /// The number of coefficients of all segments together.
    pub fn coefficient_count(&self) -> usize {
        self.coefficients().iter().map(Vec::len).sum()
    }

    /// The number of coefficients that one evaluation touches, as a mean over all directions.
    pub fn coefficients_touched(&self) -> f64 {
        self.family.coefficients_touched()
    }

    /// The unit vector in a direction of the scan, along the grain's own axes.
    fn local(&self, n: &Vector3<f64>) -> Vector3<f64> {
        self.frame.axes.tr_mul(&unit(n))
    }

    /// The outward unit normal of the surface in the direction `n`, in the scan's frame.
    pub fn normal(&self, n: &Vector3<f64>) -> Vector3<f64> {
        let (radius, gradient) = self.radius_and_gradient(n);
        (unit(n) * radius - gradient).normalize()
    }

    /// The radii in many directions of the scan's frame: as [`StarSurface::radius`], and faster.
    pub fn radii(&self, directions: &[Vector3<f64>]) -> Vec<f64> {
        let of_chunk = |directions: &[Vector3<f64>]| {
            let local: Vec<_> = directions.iter().map(|n| self.local(n)).collect();
            self.local_radii(&local)
        };
        let chunks = directions.par_chunks(CHUNK);
        chunks.flat_map_iter(of_chunk).collect()
    }

    /// Radii in many directions of the grain's own frame.
    pub(crate) fn local_radii(&self, directions: &[Vector3<f64>]) -> Vec<f64> {
        if self.stretch.is_none() {
            return self.family.radii(directions);
        }
        let mapped = directions.par_iter().map(|n| self.stretch.direction(n));
        let (mapped, lengths): (Vec<_>, Vec<_>) = mapped.unzip();
        let radii = self.family.radii(&mapped).into_iter().zip(lengths);
        radii.map(|(radius, length)| radius / length).collect()
    }
}

impl StarSurface for StarGrain {
    fn radius(&self, n: &Vector3<f64>) -> f64 {
        let local = self.local(n);
        self.stretch.radius(&local, |q| self.family.radius(q))
    }

    fn radius_and_gradient(&self, n: &Vector3<f64>) -> (f64, Vector3<f64>) {
        let local = self.local(n);
        let (radius, gradient) = self
            .stretch
            .radius_and_gradient(&local, |q| self.family.radius_and_gradient(q));
        (radius, self.frame.axes * gradient)
    }

    fn derivatives(&self, n: &Vector3<f64>) -> Derivatives {
        let local = self.local(n);
        let derivatives = self
            .stretch
            .derivatives(&local, |q| self.family.derivatives(q));
        derivatives.turned(&self.frame.axes)
    }
}

impl Surface for StarGrain {
    fn frame(&self) -> Frame {
        self.frame
    }

    fn place(&self, n: &Vector3<f64>) -> Vector3<f64> {
        let n = unit(n);
        n * self.radius(&n)
    }

    fn place_and_slopes(&self, n: &Vector3<f64>) -> (Vector3<f64>, Matrix3<f64>) {
        let n = unit(n);
        let found = self.radius_and_gradient(&n);
        (n * found.0, radial_slopes(&n, found))
    }

    fn jet(&self, n: &Vector3<f64>) -> SurfaceJet {
        let n = unit(n);
        self.derivatives(&n).radial(&n)
    }

    fn jets(&self, directions: &[Vector3<f64>]) -> Vec<SurfaceJet> {
        let local: Vec<_> = directions.iter().map(|n| self.local(n)).collect();
        let mapped: Vec<_> = local.iter().map(|n| self.stretch.direction(n).0).collect();
        let found = self.family.many_derivatives(&mapped).into_iter();
        let found = found
            .zip(&local)
            .map(|(found, n)| self.stretch.derivatives(n, |_| found));
        let turned = found.map(|found| found.turned(&self.frame.axes));
        turned
            .zip(directions)
            .map(|(found, n)| found.radial(&unit(n)))
            .collect()
    }

    fn places(&self, directions: &[Vector3<f64>]) -> Vec<Vector3<f64>> {
        let radii = self.radii(directions).into_iter();
        let directions = directions.iter().map(unit);
        directions.zip(radii).map(|(n, r)| n * r).collect()
    }

    fn tiling(&self) -> Tiling {
        self.family.tiling()
    }

    /// From the stretched space.
    fn node(&self, node: Node) -> Node {
        let (direction, solid_angle) = self.stretch.node(node);
        (self.frame.axes * direction, solid_angle)
    }

    fn elements(&self, nodes: &[Node]) -> Vec<SurfaceElement> {
        let rays = self.family.rays(nodes);
        rays.into_iter()
            .map(|ray| self.stretch.ray(ray).element())
            .collect()
    }

    fn may_cross(&self) -> bool {
        false
    }
}
