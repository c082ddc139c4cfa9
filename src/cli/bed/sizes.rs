//! The sizes of a mixture: those of the grains in results of `batch`.

use crate::batch::read_lot;
use crate::digits::plural;
use crate::measure::equivalent_radius;
use crate::report::Unit;
use anyhow::{Result, bail};
use std::path::Path;

/// Most sizes of a mixture.
const MOST_SIZES: usize = 100;

/// The golden section, multiples of which fall everywhere between whole numbers alike.
const GOLDEN: f64 = 0.618_033_988_749_894_9;

/// The sizes of grains, and what is to be known of them.
pub(super) struct Sizes {
    /// Diameters of balls of their volumes, in metres.
    pub(super) diameters: Vec<f64>,
    /// The unit that they were taken to be in, as sentences where it was not that of the bed, or was not told.
    pub(super) remarks: Vec<String>,
}

impl Sizes {
    /// Those of results, in the unit that is told there, or in that of the bed; for so many grains at most: quantiles
    /// of them if they are more. Any first few are spread over all, for what is left over of a share goes to the first.
    pub(super) fn read(path: &Path, usual: Unit, grains: usize) -> Result<Self> {
        let shown = path.display();
        let lot = read_lot(path)?;
        let named = lot.names.iter().position(|name| name == "volume");
        let lacking = lot.gaps.lacking("volume");
        let mut volumes = match (named, &lacking) {
            (Some(at), _) => lot.known(at),
            (None, Some(lacking)) => bail!("{shown} tells no volumes: {lacking}"),
            (None, None) if lot.grains.is_empty() => {
                bail!("{shown} tells no volumes, for it has no grain with a result")
            }
            (None, None) => bail!("{shown} tells no volumes: run batch with --only volume"),
        };
        let lacking = lacking.map(|lacking| {
            format!("In {shown} {lacking}: sizes are those of the rest, which may be unlike these.")
        });
        if volumes.iter().any(|volume| *volume <= 0.0) {
            bail!("{shown} has a volume that is not above zero");
        }
        let units: Vec<&String> = lot.units.iter().collect();
        let (unit, remark) = match units[..] {
            [] => (
                usual,
                Some(format!(
                    "{shown} tells no unit: its volumes are taken to be in {usual}³."
                )),
            ),
            [name] => match name.parse::<Unit>() {
                Ok(unit) if unit == usual => (unit, None),
                Ok(unit) => (
                    unit,
                    Some(format!(
                        "The volumes in {shown} are in {unit}³, and are converted to {usual}³."
                    )),
                ),
                Err(expected) => bail!("{shown} tells lengths in {name}: {expected}"),
            },
            _ => bail!("{shown} tells lengths in more than one unit"),
        };
        volumes.sort_by(f64::total_cmp);
        let count = volumes.len().min(grains.clamp(1, MOST_SIZES));
        let quantile = |at: usize| volumes[(2 * at + 1) * volumes.len() / (2 * count)];
        let mut order: Vec<usize> = (0..count).collect();
        let place = |at: &usize| (*at as f64 * GOLDEN).fract();
        order.sort_by(|one, other| place(one).total_cmp(&place(other)));
        let diameter = |at| 2.0 * equivalent_radius(quantile(at)) * unit.metres();
        let unread = lot.unread.get("volume").map(|count| {
            let cells = plural(*count, "cell");
            format!("{shown} has {cells} of volume without a number, not counted here.")
        });
        let remarks = remark.into_iter().chain(lot.taken_unit(shown));
        Ok(Self {
            diameters: order.into_iter().map(diameter).collect(),
            remarks: remarks.chain(unread).chain(lacking).collect(),
        })
    }
}
