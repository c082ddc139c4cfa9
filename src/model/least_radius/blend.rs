//! Parts of the sphere where expansions are blended.

use super::bound::{Bound, CapBound, angle};
use super::recentred::Recentring;
use super::{Judged, Part};
use crate::model::Blended;
use nalgebra::Vector3;

/// A bound for each cell.
pub(super) fn bounds(surface: &Blended) -> Vec<CapBound> {
    let cells = surface.coefficients().iter().enumerate();
    cells
        .map(|(cell, own)| CapBound::new(surface.cover().cap(cell), own))
        .collect()
}

/// A rectangle of tangents on a face of the cube, and the cells that may have a weight there.
pub(super) struct BlendPart<'a> {
    surface: &'a Blended,
    bounds: &'a [CapBound],
    recentring: &'a Recentring,
    face: usize,
    tangents: [[f64; 2]; 2],
    cells: Vec<u16>,
}

impl<'a> BlendPart<'a> {
    /// The six faces.
    pub(super) fn faces(
        surface: &'a Blended,
        bounds: &'a [CapBound],
        recentring: &'a Recentring,
    ) -> Vec<Self> {
        let face = |face| {
            let part = Self {
                surface,
                bounds,
                recentring,
                face,
                tangents: [[-1.0, 1.0]; 2],
                cells: (0..surface.cover().cells().len() as u16).collect(),
            };
            part.with_cells_that_touch()
        };
        (0..6).map(face).collect()
    }

    fn with_cells_that_touch(mut self) -> Self {
        let corners = self.corners();
        let cover = self.surface.cover();
        self.cells
            .retain(|&cell| cover.weight(cell.into()).may_touch(&corners));
        self
    }

    fn at(&self, [b, c]: [f64; 2]) -> Vector3<f64> {
        let mut place = Vector3::zeros();
        place[self.face / 2] = 1.0 - 2.0 * (self.face % 2) as f64;
        place[(self.face / 2 + 1) % 3] = b;
        place[(self.face / 2 + 2) % 3] = c;
        place
    }

    /// What a cell's radius is not less than within a cap, sought until it is enough, and the work that took beside
    /// values.
    fn least_of(
        &self,
        cell: usize,
        middle: &Vector3<f64>,
        radius: f64,
        enough: f64,
    ) -> (f64, usize) {
        let bound = &self.bounds[cell];
        let least = match bound.holds(middle) {
            true => bound.within(middle, radius, self.surface.cell_radius(cell, middle)),
            false => bound.everywhere(),
        };
        let expansion = || self.surface.expansion(cell);
        let recentred = match least < enough {
            true => self.recentring.least(expansion(), middle, radius),
            false => None,
        };
        recentred.map_or((least, 0), |(found, work)| (least.max(found), work))
    }

    fn corners(&self) -> [Vector3<f64>; 4] {
        let [b, c] = self.tangents;
        [(0, 0), (0, 1), (1, 0), (1, 1)].map(|(i, j)| self.at([b[i], c[j]]))
    }
}

impl Part for BlendPart<'_> {
    fn judge(&self, enough: f64) -> Judged {
        let cells = || self.cells.iter().map(|&cell| usize::from(cell));
        let everywhere = cells().map(|cell| self.bounds[cell].everywhere());
        let least = everywhere.fold(f64::INFINITY, f64::min);
        if least >= enough {
            return Judged {
                least,
                value: None,
                work: 1 + self.cells.len(),
            };
        }
        let corners = self.corners();
        let middle = self.middle();
        let farthest = corners.map(|corner| (corner.normalize() - middle).norm_squared());
        // The cap round the middle through the farthest corner holds the rectangle, whose sides are arcs of
        // great circles.
        let radius = angle(0.5 * farthest.into_iter().fold(0.0, f64::max));
        let value = self.surface.radius(&middle);
        // The mean of the bounds, weighed in the worst way, is enough if this is not below zero.
        let (mut excess, mut recentred) = (0.0, 0);
        for cell in cells() {
            let (least, work) = self.least_of(cell, &middle, radius, enough);
            recentred += work;
            let [lightest, heaviest] = self.surface.cover().weight(cell).range(&corners);
            let weight = if least < enough { heaviest } else { lightest };
            excess += weight * (least - enough);
        }
        let terms: usize = cells().map(|cell| self.bounds[cell].terms()).sum();
        Judged {
            least: if excess >= 0.0 { enough } else { least },
            value: Some(value),
            // Values for that are evaluated many at once.
            work: 2 * terms + recentred / 4,
        }
    }

    fn quarters(&self) -> Vec<Self> {
        let halves = |[low, high]: [f64; 2]| {
            let middle = 0.5 * (low + high);
            [[low, middle], [middle, high]]
        };
        let [along_b, along_c] = self.tangents.map(halves);
        let quarter = |tangents| {
            let part = Self {
                tangents,
                cells: self.cells.clone(),
                ..*self
            };
            part.with_cells_that_touch()
        };
        [(0, 0), (0, 1), (1, 0), (1, 1)]
            .map(|(i, j)| quarter([along_b[i], along_c[j]]))
            .into()
    }

    fn middle(&self) -> Vector3<f64> {
        self.at(self.tangents.map(|[low, high]| 0.5 * (low + high)))
            .normalize()
    }
}
