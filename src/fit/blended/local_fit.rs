//! How well single expansions can do: on every cell by itself, at every degree.
//!
//! A cell's own expansion is fitted over the cell without its margin. The blend errs less, for it has
//! the neighbours' coefficients too: its squared error is .1 to .35 of the sum over the cells, about the
//! same for all covers of a target. (Fits over the margins as well would bound the error of the blend,
//! but by a factor of 3 to 150 that depends on the degree and the size of cells: forecasts with it need
//! up to a quarter more coefficients.)
//!
//! Cells that are turned or mirrored images of each other have the same orthonormal basis: 6 faces and
//! 8 images on each share it.

use super::Target;
use crate::sphere::{CapBasis, CubeCell, GaussLegendre, coefficient_count};
use crate::vectorize::{dot, vectorize};
use nalgebra::Vector3;
use rayon::prelude::*;
use std::collections::HashMap;

/// Least Gauss nodes per side of a cell: 64 in all for the 25 coefficients of degree 4.
const NODES_PER_SIDE: usize = 8;

/// Errors below this part of the radius are rounding.
const ROUNDING: f64 = 1e-11;

/// The local fits of all cells that were asked for.
pub(super) struct LocalFits {
    basis: CapBasis,
    rule: GaussLegendre,
    shapes: HashMap<CubeCell, Shape>,
    known: HashMap<CubeCell, Vec<f64>>,
}

/// A cell of face 0, of which others are images.
struct Shape {
    directions: Vec<Vector3<f64>>,
    /// Square roots of the nodes' solid angles.
    roots: Vec<f64>,
    /// Orthonormal columns, by degree.
    columns: Vec<f64>,
}

/// The symmetry of the cube that takes a cell of face 0 to another cell.
#[derive(Clone, Copy)]
struct Image {
    face: u8,
    flipped: [bool; 2],
    swapped: bool,
}

impl Image {
    /// The cell of face 0 that stands for `cell`, and the way from there.
    fn of(cell: &CubeCell) -> (CubeCell, Self) {
        let last = cell.parts - 1;
        let flipped = [cell.row, cell.column].map(|at| at > last - at);
        let [row, column] = [cell.row, cell.column].map(|at| at.min(last - at));
        let shape = CubeCell {
            face: 0,
            parts: cell.parts,
            row: row.min(column),
            column: row.max(column),
        };
        let swapped = row > column;
        (
            shape,
            Self {
                face: cell.face,
                flipped,
                swapped,
            },
        )
    }

    fn apply(&self, n: &Vector3<f64>) -> Vector3<f64> {
        let axis = usize::from(self.face / 2);
        let (b, c) = if self.swapped { (n.z, n.y) } else { (n.y, n.z) };
        let signed = |flipped: bool, x: f64| if flipped { -x } else { x };
        let mut image = Vector3::zeros();
        image[axis] = signed(!self.face.is_multiple_of(2), n.x);
        image[(axis + 1) % 3] = signed(self.flipped[0], b);
        image[(axis + 2) % 3] = signed(self.flipped[1], c);
        image
    }
}

impl LocalFits {
    /// Fits of degree up to `degree`.
    pub(super) fn new(degree: usize) -> Self {
        Self {
            basis: CapBasis::new(degree),
            rule: GaussLegendre::new(NODES_PER_SIDE.max(degree + 4)),
            shapes: HashMap::new(),
            known: HashMap::new(),
        }
    }

    /// Integrals of the squared errors of every cell's own fits of degree 0, 1, ... They are rounded to
    /// 20 binary digits (1e-6), so that images of a cell in a symmetric target have the same.
    pub(super) fn errors(&mut self, target: &dyn Target, cells: &[CubeCell]) -> Vec<Vec<f64>> {
        let is_new = |cell: &&CubeCell| !self.known.contains_key(*cell);
        let new: Vec<CubeCell> = cells.iter().filter(is_new).copied().collect();
        if !new.is_empty() {
            let errors = self.fit(target, &new);
            self.known.extend(new.into_iter().zip(errors));
        }
        cells.iter().map(|cell| self.known[cell].clone()).collect()
    }

    fn fit(&mut self, target: &dyn Target, cells: &[CubeCell]) -> Vec<Vec<f64>> {
        let images: Vec<(CubeCell, Image)> = cells.iter().map(Image::of).collect();
        for (shape, _) in &images {
            if !self.shapes.contains_key(shape) {
                self.shapes.insert(*shape, self.shape(shape));
            }
        }
        let directions: Vec<Vector3<f64>> = images
            .iter()
            .flat_map(|(shape, image)| {
                let shape = &self.shapes[shape].directions;
                shape.iter().map(|n| image.apply(n))
            })
            .collect();
        let mut radii = target.radii(&directions);
        let per_cell = self.rule.len().pow(2);
        radii
            .par_chunks_mut(per_cell)
            .zip(&images)
            .zip(cells)
            .with_min_len(16)
            .map(|((radii, (shape, _)), cell)| {
                let weight = target.weight(&cell.middle());
                let shape = &self.shapes[shape];
                let errors = vectorize(
                    #[inline(always)]
                    || shape.errors(radii, self.basis.degree()),
                );
                errors.into_iter().map(|e| rounded(weight * e)).collect()
            })
            .collect()
    }

    fn shape(&self, cell: &CubeCell) -> Shape {
        let nodes = cell.rectangle().nodes(&self.rule);
        let (mut directions, mut roots) = (Vec::new(), Vec::new());
        for (n, solid_angle) in nodes {
            roots.push(solid_angle.sqrt());
            directions.push(n);
        }
        let rows = directions.len();
        let mut columns = vec![0.0; rows * coefficient_count(self.basis.degree())];
        let mut places = crate::sphere::Places::default();
        let located: Vec<[f64; 4]> = directions.iter().map(|n| [n.x, n.y, n.z, 0.0]).collect();
        cell.cap(0.0).locate(&located, &mut places);
        self.basis.evaluate(&places, &mut columns, rows);
        for column in columns.chunks_exact_mut(rows) {
            for (value, root) in column.iter_mut().zip(&roots) {
                *value *= root;
            }
        }
        orthonormalize(&mut columns, rows);
        Shape {
            directions,
            roots,
            columns,
        }
    }
}

impl Shape {
    /// The squared errors at every degree; overwrites the radii.
    #[inline(always)]
    fn errors(&self, radii: &mut [f64], degree: usize) -> Vec<f64> {
        let rows = radii.len();
        for (radius, root) in radii.iter_mut().zip(&self.roots) {
            *radius *= root;
        }
        let floor = ROUNDING * ROUNDING * dot(radii, radii);
        let mut errors = Vec::with_capacity(degree + 1);
        for d in 0..=degree {
            let columns = &self.columns[d * d * rows..(d + 1) * (d + 1) * rows];
            for column in columns.chunks_exact(rows) {
                remove(radii, column);
            }
            let error = dot(radii, radii);
            errors.push(if error > floor { error } else { 0.0 });
        }
        errors
    }
}

/// The nearest number of 20 binary digits.
pub(super) fn rounded(x: f64) -> f64 {
    const LOST: u64 = 1 << 32;
    f64::from_bits((x.to_bits() + LOST / 2) & !(LOST - 1))
}

/// Makes columns orthonormal one after the other, by two rounds of Gram-Schmidt.
fn orthonormalize(columns: &mut [f64], rows: usize) {
    for at in 0..columns.len() / rows {
        let (done, rest) = columns.split_at_mut(at * rows);
        let own = &mut rest[..rows];
        for _ in 0..2 {
            for other in done.chunks_exact(rows) {
                remove(own, other);
            }
        }
        let norm = dot(own, own).sqrt();
        for value in own {
            *value /= norm;
        }
    }
}

/// Takes the part along a unit vector away.
#[inline(always)]
fn remove(from: &mut [f64], unit: &[f64]) {
    let along = dot(from, unit);
    for (value, unit) in from.iter_mut().zip(unit) {
        *value -= along * unit;
    }
}
