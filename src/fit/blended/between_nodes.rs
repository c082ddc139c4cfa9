//! The error of a surface at directions that its fit has not used: the nodes of other Gauss rules.

use super::Target;
use super::nodes::{Sampler, Samples};
use crate::model::Blended;
use crate::sphere::CubeCell;
use nalgebra::Vector3;
use std::f64::consts::PI;

/// Cells that err by this share of the largest error at nodes may hold the largest: so many of them are looked at on a lattice of so many
/// steps.
const WORST: f64 = 0.5;
const MOST_WORST: usize = 24;
const LATTICE: usize = 16;

/// That error.
pub(super) struct BetweenNodes {
    pub(super) rms: f64,
    /// The largest in plain space at those directions, cell by cell.
    largest: Vec<f64>,
    /// Integrals of its square over the cells.
    pub(super) squares: Vec<f64>,
}

impl BetweenNodes {
    /// Of a surface whose cells were fitted at so many nodes per side.
    pub(super) fn of(
        surface: &Blended,
        target: &dyn Target,
        sampler: &mut Sampler,
        sides: &[(CubeCell, usize)],
    ) -> Self {
        let sides: Vec<(CubeCell, usize)> = sides.iter().map(|(c, side)| (*c, side - 1)).collect();
        sampler.sample(target, &sides);
        let samples = sides.iter().map(|(cell, side)| sampler.of(cell, *side));
        let directions: Vec<_> = samples
            .clone()
            .flat_map(|samples| &samples.directions)
            .copied()
            .collect();
        let mut found = surface.radii_and_gradients(&directions).into_iter();
        let mut largest = Vec::with_capacity(sides.len());
        let square = |samples: &Samples| {
            let mut most = 0.0_f64;
            let nodes = samples.directions.iter().zip(&samples.weights);
            let known = samples.radii.iter().zip(nodes);
            let squares = known.zip(&mut found);
            let squares = squares.map(|((exact, (n, weight)), (radius, _))| {
                let apart = (radius - exact).abs();
                most = most.max(apart * target.length(n));
                weight * apart * apart
            });
            let sum = squares.sum::<f64>();
            largest.push(most);
            sum
        };
        let squares: Vec<f64> = samples.map(square).collect();
        Self {
            rms: (squares.iter().sum::<f64>() / (4.0 * PI)).sqrt(),
            largest,
            squares,
        }
    }

    /// The largest difference in plain space: in cells where it may be, on a lattice up to their borders.
    pub(super) fn largest(&self, surface: &Blended, target: &dyn Target) -> f64 {
        let most = self.largest.iter().copied().fold(0.0, f64::max);
        let cells = surface.cover().cells().iter().zip(&self.largest);
        let mut worst: Vec<(&CubeCell, f64)> = cells
            .map(|(cell, largest)| (cell, *largest))
            .filter(|(_, largest)| *largest >= WORST * most)
            .collect();
        worst.sort_by(|(_, one), (_, other)| other.total_cmp(one));
        worst.truncate(MOST_WORST);
        let along = || (0..=LATTICE).map(|i| i as f64 / LATTICE as f64);
        let lattice = |(cell, _): (&CubeCell, f64)| {
            let places = along().flat_map(|s| along().map(move |t| (s, t)));
            places.map(|(s, t)| cell.at(s, t)).collect::<Vec<_>>()
        };
        let directions: Vec<Vector3<f64>> = worst.into_iter().flat_map(lattice).collect();
        let exact = target.radii(&directions).into_iter();
        let found = surface.radii_and_gradients(&directions).into_iter();
        let apart = exact.zip(found).zip(&directions);
        apart
            .map(|((exact, (radius, _)), n)| (radius - exact).abs() * target.length(n))
            .fold(most, f64::max)
    }
}
