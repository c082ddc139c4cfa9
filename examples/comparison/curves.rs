//! Error against cost of every family on one scan.

use crate::dense;
use crate::table::LEVELS;
use grainform::bench::{BenchError, BenchRow, Family, Setting, Subject, measure};

/// Steps per decade of the ladder of tolerances that fits to the estimate climb.
const STEPS: i32 = 10;

/// The ladder's ends, in decades of the mean radius: 2 % and 0.005 %.
const LADDER: [f64; 2] = [-1.7, -4.3];

/// Largest degree of k x k segments that touch few coefficients per evaluation.
pub(crate) const LOW_DEGREE: usize = 3;

/// All fits of one scan.
pub(crate) struct Curves {
    pub(crate) scan: String,
    /// Of the whole surface, by least squares.
    pub(crate) whole: Vec<BenchRow>,
    /// Independent segments of any degree.
    pub(crate) uniform: Vec<BenchRow>,
    /// The estimate, an expansion of the whole sphere cut at a lower degree.
    pub(crate) estimate: Vec<BenchRow>,
    /// Cells fitted to the estimate.
    pub(crate) adaptive: Vec<BenchRow>,
    /// Seconds of a plain least-squares fit of the whole surface, by degree less one.
    dense: Vec<f64>,
}

impl Curves {
    pub(crate) fn new(subject: &Subject) -> Result<Self, BenchError> {
        let rows = |settings: Vec<Setting>| -> Result<Vec<BenchRow>, BenchError> {
            let supported =
                |setting: &Setting| setting.is_supported_by(subject.scan.points().len());
            let settings = settings.into_iter().filter(supported);
            settings.map(|s| Ok(measure(subject, &s)?.0)).collect()
        };
        let whole = rows(Family::Whole.settings())?;
        let degrees = whole.iter().filter_map(|row| row.degree);
        let mut curves = Self {
            scan: subject.name.clone(),
            dense: degrees
                .map(|l| dense::seconds(subject.scan.points(), l))
                .collect(),
            whole,
            uniform: rows(Family::Uniform.settings())?,
            estimate: rows(ladder(|tolerance| Setting::Estimate { tolerance }))?,
            adaptive: rows(ladder(|tolerance| Setting::Adaptive { tolerance }))?,
        };
        if !curves.reach(LEVELS[0]) {
            curves.accept_all();
        }
        Ok(curves)
    }

    /// Forgives all fits what they were rejected for, and marks the scan.
    fn accept_all(&mut self) {
        self.scan.push('*');
        let families = [
            &mut self.whole,
            &mut self.uniform,
            &mut self.estimate,
            &mut self.adaptive,
        ];
        for row in families.into_iter().flatten() {
            row.rejected = None;
        }
    }

    /// Whether any fit is within the level.
    pub(crate) fn reach(&self, level: f64) -> bool {
        let families = [&self.whole, &self.uniform, &self.estimate, &self.adaptive];
        cheapest(families.into_iter().flatten(), level).is_some()
    }

    /// The fits of k x k segments of degree 3 or less.
    pub(crate) fn low(&self) -> impl Iterator<Item = &BenchRow> {
        let is_low = |row: &&BenchRow| row.degree.is_some_and(|degree| degree <= LOW_DEGREE);
        self.uniform.iter().filter(is_low)
    }

    /// Seconds of a plain least-squares fit of the whole surface at the level; of the largest degree
    /// where none reaches it, which are too few.
    pub(crate) fn dense_seconds(&self, level: f64) -> f64 {
        let degree = cheapest(&self.whole, level).and_then(|row| row.degree);
        self.dense[degree.unwrap_or(self.dense.len()) - 1]
    }
}

/// The row with the fewest coefficients whose held-out RMS, as a share of the mean radius, is within
/// the level; of several, the fastest.
pub(crate) fn cheapest<'a>(
    rows: impl IntoIterator<Item = &'a BenchRow>,
    level: f64,
) -> Option<&'a BenchRow> {
    rows.into_iter()
        .filter(|row| row.rejected.is_none() && row.heldout_share.is_some_and(|e| e <= level))
        .min_by(|a, b| {
            let fewest = a.coefficients.cmp(&b.coefficients);
            fewest.then(a.seconds.total_cmp(&b.seconds))
        })
}

fn ladder(setting: impl Fn(f64) -> Setting) -> Vec<Setting> {
    let steps = ((LADDER[0] - LADDER[1]) * f64::from(STEPS)).round() as i32;
    (0..=steps)
        .map(|step| setting(10_f64.powf(LADDER[0] - f64::from(step) / f64::from(STEPS))))
        .collect()
}
