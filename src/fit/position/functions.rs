//! The functions that coordinates are made of, evaluated in many directions.

use crate::model::{InvalidGrain, Position};
use crate::sphere::{
    CapBasis, Cover, CoverError, CubeCell, GaussLegendre, HarmonicBasis, Places, coefficient_count,
    tangents,
};
use nalgebra::Vector3;
use rayon::prelude::*;
use std::borrow::Cow;
use std::collections::BTreeMap;

/// Margin of covers, in widths of a cell.
const MARGIN: f64 = 0.4;

/// Nodes per side of a cell at which roughness is measured: 16 for the 16 functions of degree 3, three figures each.
const ROUGHNESS_NODES: usize = 4;

/// Distance of the directions whose difference is a derivative, in widths of a cell.
const DIFFERENCE: f64 = 0.05;

/// Cells per edge of the cube where the roughness of functions on the whole sphere is measured.
const WHOLE_PARTS: u16 = 3;

/// The functions of a surface.
#[derive(Debug, Clone)]
pub(super) struct Functions {
    degree: usize,
    kind: Kind,
}

#[derive(Debug, Clone)]
enum Kind {
    /// Harmonics of the whole sphere, as of one cell.
    Whole(HarmonicBasis),
    /// Those of every cell times its share.
    Cells(Cover, CapBasis),
}

/// Rows of a design matrix that touch the same cells.
pub(super) struct Rows {
    /// Ascending.
    pub(super) cells: Vec<u16>,
    /// What the rows belong to, by number.
    pub(super) members: Vec<u32>,
    /// Column-major, the columns of one cell after those of another.
    pub(super) values: Vec<f64>,
}

impl Rows {
    /// Functions of one cell.
    pub(super) fn per_cell(&self) -> usize {
        self.values.len() / (self.members.len() * self.cells.len())
    }
}

impl Functions {
    /// Harmonics of the whole sphere.
    pub(super) fn whole(degree: usize) -> Self {
        Self {
            degree,
            kind: Kind::Whole(HarmonicBasis::new(degree)),
        }
    }

    /// Expansions of the same degree on cells that tile the sphere.
    pub(super) fn on_cells(cells: Vec<CubeCell>, degree: usize) -> Result<Self, CoverError> {
        let cover = Cover::with_margin(cells, MARGIN)?;
        Ok(Self {
            degree,
            kind: Kind::Cells(cover, CapBasis::new(degree)),
        })
    }

    /// The cells; `None` of the whole sphere.
    pub(super) fn cover(&self) -> Option<&Cover> {
        match &self.kind {
            Kind::Whole(_) => None,
            Kind::Cells(cover, _) => Some(cover),
        }
    }

    /// The cells; of the whole sphere those of a quadrature.
    pub(super) fn cells(&self) -> Cow<'_, [CubeCell]> {
        match self.cover() {
            Some(cover) => cover.cells().into(),
            None => CubeCell::uniform(WHOLE_PARTS).into(),
        }
    }

    pub(super) fn cell_count(&self) -> usize {
        self.cover().map_or(1, |cover| cover.cells().len())
    }

    /// Functions of one cell.
    pub(super) fn per_cell(&self) -> usize {
        coefficient_count(self.degree)
    }

    /// All functions.
    pub(super) fn count(&self) -> usize {
        self.cell_count() * self.per_cell()
    }

    /// The surface with the given coefficients: per cell x of all functions, then y, then z.
    pub(super) fn surface(&self, coefficients: Vec<Vec<f64>>) -> Result<Position, InvalidGrain> {
        let size = self.per_cell();
        let triples = |own: Vec<f64>| {
            let triple = |function: usize| [0, 1, 2].map(|i| own[i * size + function]);
            (0..size).flat_map(triple).collect()
        };
        let coefficients: Vec<Vec<f64>> = coefficients.into_iter().map(triples).collect();
        match self.cover() {
            None => Position::whole(coefficients.concat()),
            Some(cover) => Position::blended(cover.clone(), coefficients),
        }
    }

    /// The functions in the given directions.
    pub(super) fn rows(&self, directions: &[Vector3<f64>]) -> Vec<Rows> {
        let shares = |n: &Vector3<f64>| match self.cover() {
            None => vec![(0, 1.0)],
            Some(cover) => {
                let mut shares = Vec::new();
                cover.shares(n, &mut shares);
                shares.sort_unstable_by_key(|&(cell, _)| cell);
                shares
            }
        };
        let shares: Vec<Vec<(u16, f64)>> = directions.iter().map(shares).collect();
        let groups = grouped(shares.iter().map(|own| own.iter().map(|&(cell, _)| cell)));
        let evaluate = |(cells, members): (Vec<u16>, Vec<u32>)| {
            let height = members.len();
            let own: Vec<Vector3<f64>> =
                members.iter().map(|&at| directions[at as usize]).collect();
            let mut values = vec![0.0; height * cells.len() * self.per_cell()];
            let columns = values.chunks_exact_mut(height * self.per_cell());
            for ((at, &cell), columns) in cells.iter().enumerate().zip(columns) {
                self.evaluate(usize::from(cell), &own, columns);
                for column in columns.chunks_exact_mut(height) {
                    for (value, &member) in column.iter_mut().zip(&members) {
                        *value *= shares[member as usize][at].1;
                    }
                }
            }
            Rows {
                cells,
                members,
                values,
            }
        };
        groups.into_par_iter().map(evaluate).collect()
    }

    /// The functions of a cell, without its share.
    fn evaluate(&self, cell: usize, directions: &[Vector3<f64>], out: &mut [f64]) {
        let height = directions.len();
        match &self.kind {
            Kind::Whole(basis) => {
                let mut values = vec![0.0; self.per_cell()];
                for (row, n) in directions.iter().enumerate() {
                    basis.evaluate(n, &mut values);
                    for (column, value) in values.iter().enumerate() {
                        out[column * height + row] = *value;
                    }
                }
            }
            Kind::Cells(cover, basis) => {
                let located: Vec<[f64; 4]> =
                    directions.iter().map(|n| [n.x, n.y, n.z, 0.0]).collect();
                let mut places = Places::default();
                cover.cap(cell).locate(&located, &mut places);
                basis.evaluate(&places, out, height);
            }
        }
    }

    /// Rows whose squares add up to the roughness of a function f: the mean over the sphere of
    /// |Hess f + f g|², with g the metric. What is linear in n, as the coordinates of an ellipsoid are, has none.
    pub(super) fn roughness(&self) -> Vec<Rows> {
        let rule = GaussLegendre::new(ROUGHNESS_NODES);
        let nodes: Vec<(Vector3<f64>, f64, f64)> = self
            .cells()
            .iter()
            .flat_map(|cell| {
                let step = DIFFERENCE * cell.width();
                let nodes = cell.rectangle().nodes(&rule).into_iter();
                nodes.map(move |(n, solid_angle)| (n, solid_angle, step))
            })
            .collect();
        let directions: Vec<Vector3<f64>> = nodes
            .iter()
            .flat_map(|(n, _, step)| stencil(n, *step))
            .collect();
        let evaluated = self.rows(&directions);
        // The directions of one stencil may touch different cells: put them together again by node.
        let mut found: Vec<BTreeMap<u16, Vec<f64>>> = vec![BTreeMap::new(); nodes.len()];
        let per_cell = self.per_cell();
        for rows in &evaluated {
            let height = rows.members.len();
            for (row, member) in rows.members.iter().enumerate() {
                let (node, place) = (*member as usize / STENCIL, *member as usize % STENCIL);
                let (_, solid_angle, step) = nodes[node];
                let factors = differences(place, step, solid_angle);
                for (at, cell) in rows.cells.iter().enumerate() {
                    let own = found[node]
                        .entry(*cell)
                        .or_insert_with(|| vec![0.0; 3 * per_cell]);
                    for function in 0..per_cell {
                        let value = rows.values[(at * per_cell + function) * height + row];
                        for (figure, factor) in factors.iter().enumerate() {
                            own[3 * function + figure] += factor * value;
                        }
                    }
                }
            }
        }
        let groups = grouped(found.iter().map(|own| own.keys().copied()));
        let gather = |(cells, members): (Vec<u16>, Vec<u32>)| {
            let mut values = Vec::with_capacity(3 * members.len() * cells.len() * per_cell);
            for cell in &cells {
                for function in 0..per_cell {
                    for &member in &members {
                        values
                            .extend_from_slice(&found[member as usize][cell][3 * function..][..3]);
                    }
                }
            }
            Rows {
                cells,
                members: members.iter().flat_map(|&member| [member; 3]).collect(),
                values,
            }
        };
        groups.into_iter().map(gather).collect()
    }
}

/// The numbers of lists of cells, by list.
fn grouped(lists: impl Iterator<Item = impl Iterator<Item = u16>>) -> BTreeMap<Vec<u16>, Vec<u32>> {
    let mut groups: BTreeMap<Vec<u16>, Vec<u32>> = BTreeMap::new();
    for (number, list) in lists.enumerate() {
        groups
            .entry(list.collect())
            .or_default()
            .push(number as u32);
    }
    groups
}

/// Directions of a [`stencil`].
const STENCIL: usize = 9;

/// A direction and those at an angle from it, forth and back, along two tangents and their two bisectors.
fn stencil(n: &Vector3<f64>, angle: f64) -> [Vector3<f64>; STENCIL] {
    let [a, b] = tangents(n);
    let (sin, cos) = angle.sin_cos();
    let half = std::f64::consts::FRAC_1_SQRT_2;
    let along = [a, b, (a + b) * half, (a - b) * half];
    std::array::from_fn(|place| match place {
        0 => *n,
        _ => {
            let side = if place % 2 == 1 { sin } else { -sin };
            n * cos + along[(place - 1) / 2] * side
        }
    })
}

/// What the value at a place of the stencil adds to H_aa + f, H_bb + f and sqrt(2) H_ab, each times the root of the
/// node's share of the sphere. Along a great circle f'' is (f(+) + f(-) - 2 f cos) / (2 - 2 cos) - f, exact for what
/// is linear in n.
fn differences(place: usize, angle: f64, solid_angle: f64) -> [f64; 3] {
    let share = (solid_angle / (4.0 * std::f64::consts::PI)).sqrt();
    let per = share / (2.0 - 2.0 * angle.cos());
    let mixed = per * std::f64::consts::FRAC_1_SQRT_2;
    match place {
        // (f(+) + f(-) - 2 f) / (2 - 2 cos) + f.
        0 => [share - 2.0 * per, share - 2.0 * per, 0.0],
        1 | 2 => [per, 0.0, 0.0],
        3 | 4 => [0.0, per, 0.0],
        5 | 6 => [0.0, 0.0, mixed],
        _ => [0.0, 0.0, -mixed],
    }
}
