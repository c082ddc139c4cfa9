//! Fits every setting to a scan and takes the time.

use super::rivals::{Rival, RivalError, rivals};
use super::timing::{Directions, timed};
use super::{Asked, BenchRow, BenchScan, Family, Setting, Subject, asked};
use crate::fit::{
    Context, FitError, Fitted, Form, PreparedScan, Reference, SuperquadricFit, fit_superquadric,
};
use crate::measure::{Deviation, grain_properties};
use crate::model::{Grain, StarGrain};
use crate::shapes::SynthError;
use crate::sphere::Symmetry;

/// Why a scan cannot be benched.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum BenchError {
    /// It cannot be fitted.
    #[error(transparent)]
    Fit(#[from] FitError),
    /// Its rivals failed.
    #[error(transparent)]
    Rival(#[from] RivalError),
    /// There are no directions to evaluate surfaces in.
    #[error(transparent)]
    Directions(#[from] SynthError),
}

/// Fits all settings of all families that the scan's points can bear. `progress` is told each
/// setting before it is fitted, and how many are done of how many. If the subject has [hidden
/// points](Subject::with_hidden_points), they judge the fits, and ducc0 fits the others too.
///
/// # Errors
/// [`BenchError`] if the scan is not one closed surface round a centre, or ducc0 does not work.
pub fn run(
    subject: &Subject,
    progress: &dyn Fn(&dyn std::fmt::Display, usize, usize),
) -> Result<BenchScan, BenchError> {
    let points = subject.scan.points.len();
    let mut settings: Vec<Setting> = Family::ALL.into_iter().flat_map(Family::settings).collect();
    let all = settings.len();
    settings.retain(|setting| setting.is_supported_by(points));

    let bench = Bench::new(subject)?;
    let mut refused = 0;
    let mut rows = Vec::with_capacity(settings.len());
    for (done, setting) in settings.iter().enumerate() {
        progress(setting, done, settings.len());
        match bench.measure(setting) {
            Err(error) if error.is_of_fit() => refused += 1,
            measured => rows.push(measured?),
        }
    }
    if !subject.hidden.is_empty() {
        let told = |degree| progress(&format_args!("ducc0, degree {degree}"), all, all);
        let found = rivals(subject, *bench.prepared.frame(), &told)?;
        rows.extend(found.into_iter().map(|rival| bench.rival(rival)));
    }
    Ok(BenchScan {
        scan: subject.name.clone(),
        points,
        hidden: subject.hidden.len(),
        noise: subject.truth.as_ref().map(|truth| truth.noise),
        reference: match subject.truth {
            Some(_) => "truth",
            None => bench.prepared.reference.kind.name(),
        },
        skipped: all - settings.len(),
        refused,
        rows,
    })
}

/// Fits one setting to a scan. Area and volume are compared with the truth, where it is known, else
/// with the reference given back.
///
/// # Errors
/// [`BenchError`] if the scan is not one closed surface round a centre.
pub fn measure(subject: &Subject, setting: &Setting) -> Result<(BenchRow, Reference), BenchError> {
    let bench = Bench::new(subject)?;
    Ok((bench.measure(setting)?, bench.prepared.reference))
}

/// A scan that fits are made to.
struct Bench<'a> {
    subject: &'a Subject,
    prepared: PreparedScan<'a>,
    seconds_prepare: f64,
    directions: Directions,
}

impl<'a> Bench<'a> {
    fn new(subject: &'a Subject) -> Result<Self, BenchError> {
        let prepare = || PreparedScan::new(&subject.scan, Symmetry::NONE);
        let (prepared, [seconds_prepare, _]) = timed(prepare);
        Ok(Self {
            subject,
            prepared: prepared?,
            seconds_prepare,
            directions: Directions::random()?,
        })
    }

    fn measure(&self, setting: &Setting) -> Result<BenchRow, FitError> {
        let context = Context::default();
        let (found, seconds) = match asked(setting) {
            Asked::Harmonics(options) => {
                let (fitted, seconds) = timed(|| self.prepared.fit(&options, &context));
                (Found::harmonics(&fitted?), seconds)
            }
            Asked::Superquadric(form) => {
                let points = self.prepared.points();
                let (fitted, seconds) = timed(|| fit_superquadric(points, None, form, &context));
                // What else it refuses was refused when the scan was prepared.
                let found = fitted
                    .ok()
                    .and_then(|fitted| Found::superquadric(form, &fitted, points.len()));
                let none = FitError::NoVolume;
                (found.ok_or(none)?, seconds)
            }
        };
        Ok(self.row(setting, found, seconds))
    }

    /// Its evaluations are its own or, of the same expansion, ours, whichever are faster.
    fn rival(&self, rival: Rival) -> BenchRow {
        let found = Found {
            grain: rival.grain.into(),
            segments: 1,
            heldout_rms: None,
            mean_radius: self.prepared.mean_radius,
            rejected: None,
        };
        let degree = rival.degree;
        let row = self.row(&Setting::Whole { degree }, found, rival.seconds);
        BenchRow {
            family: Family::Ducc0,
            seconds_prepare: 0.0,
            nanoseconds: row.nanoseconds.min(rival.nanoseconds),
            nanoseconds_bulk: row
                .nanoseconds_bulk
                .map(|own| own.min(rival.nanoseconds_bulk)),
            ..row
        }
    }

    fn row(&self, setting: &Setting, found: Found, [seconds, seconds_most]: [f64; 2]) -> BenchRow {
        let Found {
            grain, mean_radius, ..
        } = &found;
        let told = grain_properties(grain).properties;
        let (truth, hidden) = (self.subject.truth.as_ref(), &self.subject.hidden);
        let reference = &self.prepared.reference;
        let (area, volume) = truth.map_or((reference.area, reference.volume), |truth| {
            (truth.area, truth.volume)
        });
        let is_judged = !hidden.is_empty();
        BenchRow {
            family: setting.family(),
            degree: setting.degree(),
            segments: found.segments,
            tolerance: setting.tolerance(),
            coefficients: grain.coefficient_count(),
            touched: grain.coefficients_touched(),
            seconds,
            seconds_most,
            seconds_prepare: self.seconds_prepare,
            nanoseconds: self.directions.nanoseconds(grain),
            nanoseconds_bulk: is_judged.then(|| self.directions.nanoseconds_bulk(grain)),
            heldout_rms: found.heldout_rms,
            heldout_share: found.heldout_rms.map(|rms| rms / mean_radius),
            hidden_share: is_judged
                .then(|| Deviation::from_places(grain, hidden).rms() / mean_radius),
            area_error: told.area / area - 1.0,
            volume_error: told.volume / volume - 1.0,
            rms_error: truth.map(|truth| {
                Deviation::from_places(grain, &truth.places).rms() / truth.mean_radius
            }),
            seam_jump: grain.star().map_or(0.0, StarGrain::seam_jump) / mean_radius,
            rejected: found.rejected,
        }
    }
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
}
