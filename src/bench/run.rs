//! Fits every setting to a scan and takes the time.

use super::{BenchRow, BenchScan, Family, Setting, Subject, Truth, options};
use crate::fit::{Context, FitError, FitOptions, Fitted, PreparedScan, Reference};
use crate::measure::{Deviation, grain_properties};
use crate::model::StarGrain;
use std::time::Instant;

/// A fit that takes longer, in seconds, is timed once: the noise of the clock is far below.
const LONG: f64 = 0.5;

/// Fits all settings of all families that the scan's points can bear. `progress` is told each
/// setting before it is fitted, and how many are done of how many.
///
/// # Errors
/// [`FitError`] if the scan is not one closed surface round a centre.
pub fn run(
    subject: &Subject,
    progress: &dyn Fn(&Setting, usize, usize),
) -> Result<BenchScan, FitError> {
    let points = subject.scan.points.len();
    let mut settings: Vec<Setting> = Family::ALL.into_iter().flat_map(Family::settings).collect();
    let all = settings.len();
    settings.retain(|setting| setting.is_supported_by(points));

    let mut reference = "truth";
    let mut refused = 0;
    let mut rows = Vec::with_capacity(settings.len());
    for (done, setting) in settings.iter().enumerate() {
        progress(setting, done, settings.len());
        let (row, found) = match measure(subject, setting) {
            Err(error) if error.is_of_fit() => {
                refused += 1;
                continue;
            }
            measured => measured?,
        };
        if subject.truth.is_none() {
            reference = found.kind.name();
        }
        rows.push(row);
    }
    Ok(BenchScan {
        scan: subject.name.clone(),
        points,
        noise: subject.truth.as_ref().map(|truth| truth.noise),
        reference,
        skipped: all - settings.len(),
        refused,
        rows,
    })
}

/// Fits one setting to a scan. Area and volume are compared with the truth, where it is known, else
/// with the reference given back.
///
/// # Errors
/// [`FitError`] if the scan is not one closed surface round a centre.
pub fn measure(subject: &Subject, setting: &Setting) -> Result<(BenchRow, Reference), FitError> {
    let options = options(setting);
    let (prepared, seconds_prepare) = timed(|| PreparedScan::new(&subject.scan, options.symmetry));
    let (fitted, seconds) = fit(&prepared?, &options)?;
    let truth = subject.truth.as_ref();
    let row = row(setting, &fitted, truth, seconds, seconds_prepare);
    Ok((row, fitted.reference))
}

/// Fits, and gives the median seconds of three fits.
fn fit(prepared: &PreparedScan<'_>, options: &FitOptions) -> Result<(Fitted, f64), FitError> {
    let fit = || timed(|| prepared.fit(options, &Context::default()));
    let (fitted, first) = fit();
    let mut seconds = [first; 3];
    if first <= LONG {
        seconds = [first, fit().1, fit().1];
        seconds.sort_by(f64::total_cmp);
    }
    Ok((fitted?, seconds[1]))
}

fn timed<T>(work: impl FnOnce() -> T) -> (T, f64) {
    let started = Instant::now();
    let result = work();
    (result, started.elapsed().as_secs_f64())
}

fn row(
    setting: &Setting,
    fitted: &Fitted,
    truth: Option<&Truth>,
    seconds: f64,
    seconds_prepare: f64,
) -> BenchRow {
    let choice = fitted.search.choice();
    let grain = &fitted.grain;
    let found = grain_properties(grain).properties;
    let (area, volume) = truth.map_or((fitted.reference.area, fitted.reference.volume), |truth| {
        (truth.area, truth.volume)
    });
    BenchRow {
        family: setting.family(),
        degree: setting.degree(),
        segments: choice.segments,
        tolerance: setting.tolerance(),
        coefficients: grain.coefficient_count(),
        touched: grain.coefficients_touched(),
        seconds,
        seconds_prepare,
        heldout_rms: choice.heldout_rms,
        heldout_share: choice.heldout_rms.map(|rms| rms / fitted.mean_radius),
        area_error: found.area / area - 1.0,
        volume_error: found.volume / volume - 1.0,
        rms_error: truth
            .map(|truth| Deviation::from_places(grain, &truth.places).rms() / truth.mean_radius),
        seam_jump: grain.star().map_or(0.0, StarGrain::seam_jump) / fitted.mean_radius,
        rejected: choice.rejected.map(|reason| reason.to_string()),
    }
}
