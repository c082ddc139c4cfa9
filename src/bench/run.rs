//! Fits every setting to a scan and takes the time.

use super::{Asked, BenchRow, BenchScan, Family, Setting, Subject, Truth, asked};
use crate::fit::{
    Context, FitError, Fitted, Form, PreparedScan, Reference, SuperquadricFit, fit_superquadric,
};
use crate::measure::{Deviation, grain_properties};
use crate::model::{Grain, StarGrain};
use crate::sphere::Symmetry;
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
    let (prepared, seconds_prepare) = timed(|| PreparedScan::new(&subject.scan, Symmetry::NONE));
    let prepared = prepared?;
    let context = Context::default();
    let (found, seconds) = match asked(setting) {
        Asked::Harmonics(options) => {
            let (fitted, seconds) = often(|| prepared.fit(&options, &context));
            (Found::harmonics(&fitted?), seconds)
        }
        Asked::Superquadric(form) => {
            let points = prepared.points();
            let (fitted, seconds) = often(|| fit_superquadric(points, form, &context));
            // What else it refuses was refused when the scan was prepared.
            let found = fitted
                .ok()
                .and_then(|fitted| Found::superquadric(form, &fitted, points.len()));
            let none = FitError::NoVolume {
                points: points.len(),
            };
            (found.ok_or(none)?, seconds)
        }
    };
    let row = found.row(
        setting,
        subject.truth.as_ref(),
        &prepared.reference,
        [seconds, seconds_prepare],
    );
    Ok((row, prepared.reference))
}

/// What is fitted, and the median seconds of three fits.
fn often<T>(fit: impl Fn() -> T) -> (T, f64) {
    let (fitted, first) = timed(&fit);
    let mut seconds = [first; 3];
    if first <= LONG {
        seconds = [first, timed(&fit).1, timed(&fit).1];
        seconds.sort_by(f64::total_cmp);
    }
    (fitted, seconds[1])
}

fn timed<T>(work: impl FnOnce() -> T) -> (T, f64) {
    let started = Instant::now();
    let result = work();
    (result, started.elapsed().as_secs_f64())
}

/// What a fit found.
struct Found {
    grain: Grain,
    segments: usize,
    heldout_rms: Option<f64>,
    mean_radius: f64,
    rejected: Option<String>,
}

impl Found {
    fn harmonics(fitted: &Fitted) -> Self {
        let choice = fitted.search.choice();
        Self {
            grain: fitted.grain.clone(),
            segments: choice.segments,
            heldout_rms: choice.heldout_rms,
            mean_radius: fitted.mean_radius,
            rejected: choice.rejected.map(|reason| reason.to_string()),
        }
    }

    /// Nothing if the frame is none. The held-out error is that of generalised cross-validation: of each of n points by
    /// p numbers, on the mean n / (n - p) times that of the fit.
    fn superquadric(form: Form, fitted: &SuperquadricFit, points: usize) -> Option<Self> {
        let share = form.parameters() as f64 / points as f64;
        Some(Self {
            grain: fitted.grain().ok()?,
            segments: 1,
            heldout_rms: Some(fitted.residuals.rms / (1.0 - share)),
            mean_radius: fitted.mean_radius,
            rejected: None,
        })
    }

    fn row(
        self,
        setting: &Setting,
        truth: Option<&Truth>,
        reference: &Reference,
        [seconds, seconds_prepare]: [f64; 2],
    ) -> BenchRow {
        let Self {
            grain, mean_radius, ..
        } = self;
        let found = grain_properties(&grain).properties;
        let (area, volume) = truth.map_or((reference.area, reference.volume), |truth| {
            (truth.area, truth.volume)
        });
        BenchRow {
            family: setting.family(),
            degree: setting.degree(),
            segments: self.segments,
            tolerance: setting.tolerance(),
            coefficients: grain.coefficient_count(),
            touched: grain.coefficients_touched(),
            seconds,
            seconds_prepare,
            heldout_rms: self.heldout_rms,
            heldout_share: self.heldout_rms.map(|rms| rms / mean_radius),
            area_error: found.area / area - 1.0,
            volume_error: found.volume / volume - 1.0,
            rms_error: truth.map(|truth| {
                Deviation::from_places(&grain, &truth.places).rms() / truth.mean_radius
            }),
            seam_jump: grain.star().map_or(0.0, StarGrain::seam_jump) / mean_radius,
            rejected: self.rejected,
        }
    }
}
