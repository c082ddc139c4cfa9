//! The figures of beds over all seeds.

use super::BedRunRecord;
use crate::bed::{Fabric, Forces, Fraction, Order};
use crate::report::number::with_error;
use serde::Serialize;
use std::fmt;

/// A figure over all beds: its mean and the standard error of that, or, of one bed, that of its own sampling.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[non_exhaustive]
pub struct BedMean {
    /// The mean.
    pub value: f64,
    /// Its standard error, where it is known.
    pub error: Option<f64>,
}

/// The figures over all beds; `None` where a bed does not have it.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[non_exhaustive]
pub struct BedMeans {
    /// Packing fraction in the core.
    pub core: Option<BedMean>,
    /// Packing fraction from wall to wall.
    pub whole: Option<BedMean>,
    /// Contacts with other grains per grain.
    pub contacts: Option<BedMean>,
    /// Grains that a grain touches.
    pub neighbours: Option<BedMean>,
    /// The mean normal force between grains, in newtons.
    pub force: Option<BedMean>,
    /// Its 5, 25, 50, 75 and 95 % quantiles, as shares of the mean.
    pub force_quantiles: Option<[BedMean; 5]>,
    /// The largest, as a share of the mean.
    pub largest_force: Option<BedMean>,
    /// The largest eigenvalue of the order of long axes.
    pub order: Option<BedMean>,
    /// Its component along the vertical.
    pub vertical_order: Option<BedMean>,
}

impl BedMeans {
    /// Those of these beds.
    pub(super) fn of(runs: &[BedRunRecord]) -> Self {
        let fraction = |figure: &dyn Fn(&BedRunRecord) -> Option<Fraction>| {
            mean(runs, |run| {
                figure(run).map(|fraction| (fraction.value, Some(fraction.error)))
            })
        };
        let fabric =
            |figure: &dyn Fn(&Fabric) -> f64| mean(runs, |run| Some((figure(&run.fabric), None)));
        let forces = |figure: &dyn Fn(&Forces) -> f64| {
            mean(runs, |run| {
                run.fabric.forces.as_ref().map(|all| (figure(all), None))
            })
        };
        let order = |figure: &dyn Fn(&Order) -> f64| {
            mean(runs, |run| {
                run.fabric.order.as_ref().map(|all| (figure(all), None))
            })
        };
        let [a, b, c, d, e] = [0, 1, 2, 3, 4].map(|at| forces(&|forces| forces.quantiles[at]));
        let quantiles = || Some([a?, b?, c?, d?, e?]);
        Self {
            core: fraction(&|run| run.packing.core),
            whole: fraction(&|run| run.packing.whole),
            contacts: fabric(&|fabric| fabric.contacts),
            neighbours: fabric(&|fabric| fabric.neighbours),
            force: forces(&|forces| forces.mean),
            force_quantiles: quantiles(),
            largest_force: forces(&|forces| forces.largest),
            order: order(&|order| order.eigenvalues[0]),
            vertical_order: order(&|order| order.vertical),
        }
    }
}

/// The mean of a figure: its error over several beds is from their spread, that of one its own. Beds that are alike, as counts of few
/// grains may be by chance, tell none.
fn mean(
    runs: &[BedRunRecord],
    figure: impl Fn(&BedRunRecord) -> Option<(f64, Option<f64>)>,
) -> Option<BedMean> {
    let found: Vec<_> = runs.iter().map(figure).collect::<Option<_>>()?;
    let count = found.len() as f64;
    match found[..] {
        [] => None,
        [(value, error)] => Some(BedMean { value, error }),
        _ => {
            let value = found.iter().map(|(value, _)| value).sum::<f64>() / count;
            let spread = found.iter().map(|(one, _)| (one - value).powi(2));
            let variance = spread.sum::<f64>() / (count - 1.0);
            let error = (variance > 0.0).then(|| (variance / count).sqrt());
            Some(BedMean { value, error })
        }
    }
}

impl fmt::Display for BedMean {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&with_error(self.value, self.error))
    }
}
