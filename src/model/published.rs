//! The coefficients as the dissertation publishes them, a_l^m of the real orthonormal harmonics, and those of positions likewise.

use super::{Family, PositionGrain, StarGrain};
use crate::sphere::{
    AngleRectangle, AngularPartition, Cap, CapBasis, CubeCell, GaussLegendre, HarmonicBasis,
    Symmetry, coefficient_count,
};
use nalgebra::Vector3;
use std::f64::consts::TAU;

/// An expansion in the real orthonormal harmonics: r = sum of a_l^m Y_l^m, or one coordinate of positions.
#[derive(Debug, Clone, PartialEq)]
pub struct PublishedExpansion {
    /// Where it holds, in the grain's own frame; of a grain that is [stretched](StarGrain::stretched), in
    /// the directions of the stretched space.
    pub region: Region,
    /// a_l^m at index l(l+1) + m, in the scan's unit, with respect to the grain's own axes.
    pub coefficients: Vec<f64>,
    /// What the conversion loses: the largest difference from the cap-basis expansion at 81 places
    /// of the region, in the scan's unit. The harmonics are nearly dependent on a small region, so
    /// their coefficients are large and cancel: expect 1e-12 of the radius at k = 2 and 1e-7 at
    /// k = 10, L = 3.
    pub loss: f64,
}

/// Where an expansion holds.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Region {
    /// A segment of the angle domain, alone; or all of it.
    Rectangle(AngleRectangle),
    /// A cell of a cube's face, blended with its neighbours.
    Cell {
        /// The cell.
        cell: CubeCell,
        /// How far it blends on both sides of its border, in widths of the cell.
        margin: f64,
    },
    /// The region into which mirrors fold all directions, and its images.
    Mirrored(Symmetry),
}

impl Region {
    fn direction(&self, s: f64, t: f64) -> Vector3<f64> {
        match self {
            Self::Rectangle(rectangle) => rectangle.direction(s, t),
            Self::Cell { cell, .. } => cell.at(s, t),
            Self::Mirrored(symmetry) => symmetry.rectangle().direction(s, t),
        }
    }
}

impl StarGrain {
    /// The published coefficients of every segment. Exact but for rounding: the cap basis spans the
    /// same functions, which are continued over the whole sphere and projected there by a product
    /// rule that is exact for their degree. Those of the whole sphere are the model's own.
    pub fn published(&self) -> Vec<PublishedExpansion> {
        let place = |segment: usize| match self.family() {
            Family::Blended(surface) => {
                let cover = surface.cover();
                let (cell, margin) = (cover.cells()[segment], cover.margin());
                Some((Region::Cell { cell, margin }, *cover.cap(segment)))
            }
            Family::Segmented(surface) => {
                let rectangle = surface.partition().rectangle(segment);
                Some((Region::Rectangle(rectangle), rectangle.cap()))
            }
            Family::Mirrored(surface) => {
                let symmetry = surface.symmetry();
                Some((Region::Mirrored(symmetry), symmetry.cap()))
            }
            Family::Whole(_) => None,
        };
        let basis = CapBasis::new(self.degree());
        let expansions = self.coefficients().iter().enumerate();
        expansions
            .map(|(segment, own)| match place(segment) {
                Some((region, cap)) => publish(&basis, &cap, own, region),
                None => PublishedExpansion::of_sphere(own.clone()),
            })
            .collect()
    }
}

impl PositionGrain {
    /// The same of x, y and z in the grain's own frame, for every cell: of the whole sphere these are the coefficients of SPHARM
    /// (Brechbühler, Gerig, Kübler 1995).
    pub fn published(&self) -> Vec<[PublishedExpansion; 3]> {
        let position = self.position();
        let basis = CapBasis::new(position.degree());
        let expansions = position.coefficients().iter().enumerate();
        expansions
            .map(|(at, own)| {
                std::array::from_fn(|axis| {
                    let own: Vec<f64> = own.iter().skip(axis).step_by(3).copied().collect();
                    match position.cover() {
                        Some(cover) => {
                            let (cell, margin) = (cover.cells()[at], cover.margin());
                            publish(&basis, cover.cap(at), &own, Region::Cell { cell, margin })
                        }
                        None => PublishedExpansion::of_sphere(own),
                    }
                })
            })
            .collect()
    }
}

impl PublishedExpansion {
    /// One that is published as it is.
    fn of_sphere(coefficients: Vec<f64>) -> Self {
        Self {
            region: Region::Rectangle(AngularPartition::new(1).rectangle(0)),
            coefficients,
            loss: 0.0,
        }
    }
}

fn publish(basis: &CapBasis, cap: &Cap, own: &[f64], region: Region) -> PublishedExpansion {
    let degree = own.len().isqrt() - 1;
    let turns = 2 * degree + 1;
    let harmonics = HarmonicBasis::new(degree);
    let mut values = vec![0.0; coefficient_count(degree)];
    let mut coefficients = values.clone();
    for (z, weight) in GaussLegendre::new(degree + 1).on(-1.0, 1.0) {
        let s = (1.0 - z * z).sqrt();
        for turn in 0..turns {
            let (sp, cp) = (TAU * turn as f64 / turns as f64).sin_cos();
            let n = Vector3::new(s * cp, s * sp, z);
            let radius = basis.value(cap, own, &n);
            let solid_angle = TAU * weight / turns as f64;
            harmonics.evaluate(&n, &mut values);
            for (a, y) in coefficients.iter_mut().zip(&values) {
                *a += solid_angle * radius * y;
            }
        }
    }
    let loss = (0..81)
        .map(|i| region.direction((i / 9) as f64 / 8.0, (i % 9) as f64 / 8.0))
        .map(|n| {
            harmonics.evaluate(&n, &mut values);
            let sum: f64 = values.iter().zip(&coefficients).map(|(y, a)| y * a).sum();
            (sum - basis.value(cap, own, &n)).abs()
        })
        .fold(0.0, f64::max);
    PublishedExpansion {
        region,
        coefficients,
        loss,
    }
}
