//! By how much a largest value is too large where many places are nearly as high.
//!
//! Of a flat side the highest ripple is taken, and ripples are there by noise alone. By how much the highest place rises with one
//! more of them, in the mean over [draws](super::draws) from the posterior, tells by how much the first one has raised it: of
//! values that scatter alike, those of two ripples reach √2 times as far as those of one. Without it, sides of boxes with
//! round edges came out two of their errors long in the mean.

use super::dimensions::End;
use super::draws::Draws;
use super::functionals::RingSurface;
use super::outcome::{Estimate, learnt};
use super::posterior::Conditioned;
use nalgebra::Vector3;
use std::cell::OnceCell;
use std::f64::consts::{PI, SQRT_2};

/// Standard deviations below the highest of the places that may be it.
const DEEP: f64 = 4.0;

/// So many independent places make a plateau.
const MANY: f64 = 2.0;

/// Number of draws, by which a rise is good to a fifth.
const DRAWS: usize = 12;

/// A surface with flat sides.
pub(super) struct Plateau<'a> {
    given: &'a Conditioned<'a>,
    surface: &'a RingSurface,
    /// Independent places per solid angle.
    density: f64,
    draws: OnceCell<Draws>,
}

impl<'a> Plateau<'a> {
    pub(super) fn new(
        estimate: &Estimate,
        given: &'a Conditioned<'a>,
        surface: &'a RingSurface,
    ) -> Self {
        Self {
            given,
            surface,
            density: learnt(&estimate.unlearnt) / (4.0 * PI),
            draws: OnceCell::new(),
        }
    }

    /// By how much ripples have raised an end, as far as they raise its extent, where its radius has this variance; zero where
    /// few places are as high.
    pub(super) fn rise(&self, end: &End, variance: f64) -> f64 {
        let towards = end.towards();
        let RingSurface { nodes, radii, .. } = self.surface;
        let heights = || {
            let places = nodes.iter().zip(radii);
            places.map(|((n, weight), (radius, _))| (n, weight, radius * n.dot(&towards)))
        };
        let top = heights().fold(0.0, |top: f64, (.., height)| top.max(height));
        let least = top - DEEP * variance.sqrt() * end.along();
        let high: Vec<_> = heights().filter(|(.., height)| *height > least).collect();
        let places = self.density * high.iter().map(|(_, weight, _)| *weight).sum::<f64>();
        if places < MANY {
            return 0.0;
        }
        let directions: Vec<Vector3<f64>> = high.iter().map(|(n, ..)| **n).collect();
        let draws = self.draws.get_or_init(|| Draws::new(self.given, DRAWS));
        let raised = draws.radii(&directions).map(|ripples| {
            let high = high.iter().zip(ripples);
            let heights = high.map(|((n, _, height), ripple)| height + ripple * n.dot(&towards));
            heights.fold(0.0, f64::max) - top
        });
        let rise = raised.sum::<f64>() / DRAWS as f64;
        end.by_radius / end.along() * rise.max(0.0) / (SQRT_2 - 1.0)
    }
}

#[cfg(test)]
mod tests {
    use super::super::dimensions::Reach;
    use super::super::trial::{estimated, fibonacci, samples, tablet};
    use super::*;

    /// The thickness of a body, and what both of its ends have risen by.
    fn thickness(estimate: &Estimate) -> (f64, f64) {
        let posterior = estimate.posterior();
        let given = estimate.given(&posterior);
        let surface = RingSurface::new(estimate);
        let nodes = surface.nodes.iter().zip(&surface.radii);
        let starts: Vec<_> = nodes.map(|((n, _), (r, _))| (*n, *r)).collect();
        let reach = Reach::new(estimate, &starts).unwrap();
        let plateau = Plateau::new(estimate, &given, &surface);
        let extent = reach.along(&Vector3::z());
        let variance = super::super::outcome::variance(&estimate.spectrum, &estimate.unlearnt);
        let risen = extent.ends.iter().map(|end| plateau.rise(end, variance));
        (extent.length, risen.sum())
    }

    #[test]
    fn flat_sides_are_raised_by_their_ripples() {
        let excess_and_risen = [1800, 2000, 2200, 2400].map(|points| {
            let points = samples(&fibonacci(points), tablet, 0.002);
            let (length, risen) = thickness(&estimated(&points, Vector3::repeat(1.0)));
            [length - 0.9, risen]
        });
        let [excess, risen] = [0, 1].map(|at| excess_and_risen.iter().map(|p| p[at]).sum::<f64>());
        assert!(
            excess > 0.0 && (0.5..2.0).contains(&(risen / excess)),
            "{excess_and_risen:?}"
        );
    }

    #[test]
    fn an_end_alone_is_not_raised() {
        let axes = Vector3::new(1.4, 1.2, 0.8);
        let radius = |n: &Vector3<f64>| 1.0 / n.component_div(&axes).norm();
        let estimate = estimated(&samples(&fibonacci(2000), radius, 0.002), axes);
        assert_eq!(thickness(&estimate).1, 0.0);
    }
}
