//! A cover of the sphere by overlapping cells with weights that make a partition of unity.

use super::cell_weight::CellWeight;
use super::face_places::place;
use super::{Cap, CubeCell, FaceRectangle, MARGIN};
use nalgebra::Vector3;
use std::ops::Range;

/// Cells that tile the sphere, each with a weight that reaches into its neighbours. Divided by their
/// sum, the weights are a partition of unity with two continuous derivatives.
#[derive(Debug, Clone)]
pub struct Cover {
    cells: Vec<CubeCell>,
    margin: f64,
    caps: Vec<Cap>,
    weights: Vec<CellWeight>,
    /// Faces are cut in this many equal tangents along each edge, for looking up what is near.
    bucket_parts: usize,
    /// Half of them.
    per_bucket: f64,
    /// Bucket b may be touched by the cells `near[starts[b]..starts[b + 1]]`.
    starts: Vec<u32>,
    near: Vec<u16>,
}

/// Why cells do not make a cover.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum CoverError {
    /// A face, a row or a column that does not exist, or more cells than can be numbered.
    #[error("cell {cell} does not exist on a cube with faces cut in up to {MAX_FACE_PARTS} parts")]
    NoSuchCell {
        /// Position in the list.
        cell: usize,
    },
    /// A cell lies on another one.
    #[error("cell {cell} overlaps another cell")]
    Overlap {
        /// Position in the list.
        cell: usize,
    },
    /// The cells leave a gap.
    #[error("the cells do not cover the sphere")]
    Gap,
    /// A margin that no cover can have.
    #[error("the margin must be from {LEAST_MARGIN} to 1 of the width of a cell")]
    Margin,
}

/// Least margin: that of a finest cell is 2.5e-4 radians wide, which directions still resolve.
const LEAST_MARGIN: f64 = 0.01;

/// Least number of buckets per edge of a face: in each a direction is weighed against one cell more than it touches.
const LEAST_BUCKETS: usize = 12;

/// Most parts per edge of a face.
pub const MAX_FACE_PARTS: u16 = 64;

impl Cover {
    /// A cover by cells that tile the sphere: on each face, n x n squares, of which any may be cut in
    /// four again and again. They are kept in the order given.
    ///
    /// # Errors
    /// [`CoverError`] if they do not tile the sphere in this way.
    pub fn new(cells: Vec<CubeCell>) -> Result<Self, CoverError> {
        Self::with_margin(cells, MARGIN)
    }

    /// As [`Self::new`], where neighbours blend within so many widths of a cell on both sides of its
    /// border, but at most within 36 degrees. Beyond .5 a direction touches many cells: 17 at margin 1
    /// where sizes mix.
    ///
    /// # Errors
    /// [`CoverError`] if the cells do not tile the sphere, or the margin is not one from .01 to 1.
    pub fn with_margin(cells: Vec<CubeCell>, margin: f64) -> Result<Self, CoverError> {
        if !(LEAST_MARGIN..=1.0).contains(&margin) {
            return Err(CoverError::Margin);
        }
        check(&cells)?;
        let caps: Vec<Cap> = cells.iter().map(|cell| cell.cap(margin)).collect();
        let weights: Vec<CellWeight> = cells
            .iter()
            .map(|cell| CellWeight::new(cell, margin))
            .collect();
        let finest = cells.iter().map(|cell| cell.parts).max().unwrap_or(1);
        let bucket_parts = usize::from(finest).max(LEAST_BUCKETS);
        let per_bucket = 0.5 * bucket_parts as f64;
        let mut near_buckets = vec![Vec::new(); 6 * bucket_parts * bucket_parts];
        for (face, buckets) in near_buckets
            .chunks_mut(bucket_parts * bucket_parts)
            .enumerate()
        {
            let face = Face {
                number: face,
                parts: bucket_parts,
                weights: &weights,
            };
            // Those of a face stand together, so that what they share is found once.
            let mut all: Vec<u16> = (0..cells.len() as u16).collect();
            all.sort_by_key(|&cell| cells[usize::from(cell)].face);
            face.find_near([0..bucket_parts, 0..bucket_parts], &all, buckets);
        }
        let (mut starts, mut near) = (vec![0], Vec::new());
        for bucket in near_buckets {
            near.extend(bucket);
            starts.push(near.len() as u32);
        }
        Ok(Self {
            cells,
            margin,
            caps,
            weights,
            bucket_parts,
            per_bucket,
            starts,
            near,
        })
    }

    /// The cells.
    pub fn cells(&self) -> &[CubeCell] {
        &self.cells
    }

    /// The number of the cell that the direction `n` lies in, margins left aside.
    pub(crate) fn cell(&self, n: &Vector3<f64>) -> usize {
        let mut near = self
            .near(self.bucket(n))
            .iter()
            .map(|cell| usize::from(*cell));
        near.find(|cell| self.cells[*cell].holds(n)).unwrap_or(0)
    }

    /// How far neighbours blend on both sides of a cell's border, in widths of the cell.
    pub fn margin(&self) -> f64 {
        self.margin
    }

    /// The cap in which the expansion of a cell lives.
    ///
    /// # Panics
    /// If there are not so many [cells](Self::cells).
    pub fn cap(&self, cell: usize) -> &Cap {
        &self.caps[cell]
    }

    /// The weight of a cell, ready to be evaluated.
    pub(crate) fn weight(&self, cell: usize) -> &CellWeight {
        &self.weights[cell]
    }

    /// The cells in pieces, cut where weights stop being smooth.
    pub(crate) fn zones(&self) -> Vec<FaceRectangle> {
        let cells = self.cells.iter();
        cells.flat_map(|cell| cell.zones(self.margin)).collect()
    }

    /// The number of buckets in which directions have the same cells near them.
    pub(crate) fn buckets(&self) -> usize {
        self.starts.len() - 1
    }

    /// The bucket of a direction.
    #[inline]
    pub(crate) fn bucket(&self, n: &Vector3<f64>) -> usize {
        let axis = n.iamax();
        let per_depth = 1.0 / n[axis].abs();
        let parts = self.bucket_parts;
        let place =
            |height: f64| (((height * per_depth + 1.0) * self.per_bucket) as usize).min(parts - 1);
        let face = 2 * axis + usize::from(n[axis] < 0.0);
        (face * parts + place(n[(axis + 1) % 3])) * parts + place(n[(axis + 2) % 3])
    }

    /// The cells that may have a weight above zero in the directions of a bucket.
    #[inline]
    pub(crate) fn near(&self, bucket: usize) -> &[u16] {
        &self.near[self.starts[bucket] as usize..self.starts[bucket + 1] as usize]
    }

    /// The cells that count in the direction `n`, each with its share of the surface there; the
    /// shares add up to 1.
    pub(crate) fn shares(&self, n: &Vector3<f64>, out: &mut Vec<(u16, f64)>) {
        out.clear();
        let components = (*n).into();
        let mut places = [None; 6];
        let mut sum = 0.0;
        for &cell in self.near(self.bucket(n)) {
            let face = self.cells[usize::from(cell)].face;
            let place = places[usize::from(face)].get_or_insert_with(|| place(face, &components));
            let weight = self.weights[usize::from(cell)].value(place);
            if weight > 0.0 {
                out.push((cell, weight));
                sum += weight;
            }
        }
        for (_, weight) in out.iter_mut() {
            *weight /= sum;
        }
    }
}

/// A face cut in buckets by equal steps of the tangents.
struct Face<'a> {
    number: usize,
    parts: usize,
    weights: &'a [CellWeight],
}

impl Face<'_> {
    /// Finds the cells that may touch each of a rectangle of buckets, halving it again and again.
    fn find_near(
        &self,
        [rows, columns]: [Range<usize>; 2],
        candidates: &[u16],
        near: &mut [Vec<u16>],
    ) {
        let corners = [
            (rows.start, columns.start),
            (rows.start, columns.end),
            (rows.end, columns.start),
            (rows.end, columns.end),
        ]
        .map(|(row, column)| self.corner(row, column));
        let touches = |&&cell: &&u16| self.weights[usize::from(cell)].may_touch(&corners);
        let touching: Vec<u16> = candidates.iter().filter(touches).copied().collect();
        if rows.len() == 1 && columns.len() == 1 {
            near[rows.start * self.parts + columns.start] = touching;
            return;
        }
        for rows in halves(&rows) {
            for columns in halves(&columns) {
                self.find_near([rows.clone(), columns], &touching, near);
            }
        }
    }

    fn corner(&self, row: usize, column: usize) -> Vector3<f64> {
        let tangent = |i: usize| 2.0 * i as f64 / self.parts as f64 - 1.0;
        let mut n = Vector3::zeros();
        n[self.number / 2] = 1.0 - 2.0 * (self.number % 2) as f64;
        n[(self.number / 2 + 1) % 3] = tangent(row);
        n[(self.number / 2 + 2) % 3] = tangent(column);
        n
    }
}

/// A range in two, or alone if it cannot be cut.
fn halves(range: &Range<usize>) -> Vec<Range<usize>> {
    let middle = range.start + range.len() / 2;
    match range.len() {
        1 => vec![range.clone()],
        _ => vec![range.start..middle, middle..range.end],
    }
}

/// Each face is tiled by squares that are nested in larger ones or apart, so they tile it if none
/// lies in another and their areas add up.
fn check(cells: &[CubeCell]) -> Result<(), CoverError> {
    let known: std::collections::HashSet<&CubeCell> = cells.iter().collect();
    let base = cells.iter().map(|cell| odd_part(cell.parts)).max();
    let mut covered = [0.0; 6];
    for (index, cell) in cells.iter().enumerate() {
        let exists = cell.face < 6
            && (1..=MAX_FACE_PARTS).contains(&cell.parts)
            && cell.row < cell.parts
            && cell.column < cell.parts
            && index < usize::from(u16::MAX);
        if !exists || Some(odd_part(cell.parts)) != base {
            return Err(CoverError::NoSuchCell { cell: index });
        }
        let mut above = cell.parent();
        while let Some(ancestor) = above {
            if known.contains(&ancestor) {
                return Err(CoverError::Overlap { cell: index });
            }
            above = ancestor.parent();
        }
        covered[usize::from(cell.face)] += f64::from(cell.parts).powi(-2);
    }
    if known.len() < cells.len() {
        return Err(CoverError::Overlap { cell: known.len() });
    }
    if covered.iter().any(|share| (share - 1.0).abs() > 1e-9) {
        return Err(CoverError::Gap);
    }
    Ok(())
}

fn odd_part(parts: u16) -> u16 {
    parts.checked_shr(parts.trailing_zeros()).unwrap_or(0)
}

#[cfg(test)]
mod tests;
