//! How often intervals hold the truth.

use grainform::report::{FitReport, ReportedScan};
use grainform::scan::Scan;
use grainform::{FitOptions, fit};
use std::error::Error;
use std::fmt;

pub(crate) const FIGURES: [&str; 8] = [
    "area",
    "volume",
    "I1",
    "I2",
    "I3",
    "length",
    "width",
    "thickness",
];

/// The figures of a body, in this order.
pub(crate) type Figures = [f64; FIGURES.len()];

/// Figures of which nothing is known.
pub(crate) fn unknown() -> Figures {
    [f64::NAN; FIGURES.len()]
}

/// Normal quantile of a two-sided interval of 95 %.
const QUANTILE: f64 = 1.96;

/// Of how many scans there are standard errors, how often the interval of each figure holds the truth, the sum of
/// errors over standard errors, and these as shares of the figure.
#[derive(Default)]
pub(crate) struct Tally {
    scans: usize,
    told: usize,
    covered: [usize; FIGURES.len()],
    bias: [f64; FIGURES.len()],
    shares: [Vec<f64>; FIGURES.len()],
}

impl Tally {
    /// Fits a scan with the default options; of one that is refused nothing is told.
    pub(crate) fn add(&mut self, truth: &Figures, scan: &Scan) -> Result<(), Box<dyn Error>> {
        self.scans += 1;
        let options = FitOptions::default();
        let Ok(fitted) = fit(scan, &options) else {
            return Ok(());
        };
        let told = FitReport::new(ReportedScan::default(), &fitted, &options);
        let Some(errors) = told.standard_errors else {
            return Ok(());
        };
        self.told += 1;
        let moments = told.principal.ok_or("a finite inertia")?.moments;
        let sizes = told.dimensions.ok_or("a finite inertia")?;
        let pairs = [
            (told.area.ok_or("an area")?, errors.area),
            (told.volume.ok_or("a volume")?, errors.volume),
            (moments[0], errors.moments[0]),
            (moments[1], errors.moments[1]),
            (moments[2], errors.moments[2]),
            (sizes.length, errors.dimensions.length),
            (sizes.width, errors.dimensions.width),
            (sizes.thickness, errors.dimensions.thickness),
        ];
        for (i, (found, error)) in pairs.into_iter().enumerate() {
            let deviation = (found - truth[i]) / error;
            self.covered[i] += usize::from(deviation.abs() <= QUANTILE);
            self.bias[i] += deviation;
            self.shares[i].push(error / found);
        }
        Ok(())
    }
}

impl Tally {
    /// Medians of the standard errors in % of their figures.
    pub(crate) fn medians(&mut self) -> [f64; FIGURES.len()] {
        self.shares.each_mut().map(|shares| {
            shares.sort_unstable_by(f64::total_cmp);
            100.0 * shares.get(shares.len() / 2).copied().unwrap_or(f64::NAN)
        })
    }
}

impl fmt::Display for Tally {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} of {}", self.told, self.scans)?;
        let of = self.told.max(1) as f64;
        for (covered, bias) in self.covered.iter().zip(self.bias) {
            if bias.is_nan() {
                write!(f, " | -")?;
                continue;
            }
            let share = 100.0 * *covered as f64 / of;
            write!(f, " | {share:.0} % ({:+.1})", bias / of)?;
        }
        Ok(())
    }
}
