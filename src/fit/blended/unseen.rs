//! The error of a surface at directions that its fit has not used: the nodes of other Gauss rules.

use super::Target;
use super::nodes::{Sampler, Samples};
use crate::model::Blended;
use crate::sphere::CubeCell;
use std::f64::consts::PI;

/// That error.
pub(super) struct Unseen {
    pub(super) rms: f64,
    pub(super) max: f64,
    /// Integrals of its square over the cells.
    pub(super) squares: Vec<f64>,
}

impl Unseen {
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
        let mut max = 0.0_f64;
        let square = |samples: &Samples| {
            let weights = samples.weights.iter().zip(&samples.solid_angles);
            let known = samples.radii.iter().zip(weights);
            let squares = known.zip(&mut found);
            let squares = squares.map(|((exact, (weight, solid_angle)), (radius, _))| {
                let squared = weight * (radius - exact).powi(2);
                max = max.max(squared / solid_angle);
                squared
            });
            squares.sum::<f64>()
        };
        let squares: Vec<f64> = samples.map(square).collect();
        Self {
            rms: (squares.iter().sum::<f64>() / (4.0 * PI)).sqrt(),
            max: max.sqrt(),
            squares,
        }
    }
}
