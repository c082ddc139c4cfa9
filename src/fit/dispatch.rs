//! The only place that knows all families of models: which one the options ask for, and how what it
//! gives becomes a fitted grain.

use super::candidate::Search;
use super::context::Context;
use super::error::FitError;
use super::estimated::estimated;
use super::kind::choice::KindChoice;
use super::mirrored;
use super::options::{FitOptions, Seams};
use super::outcome::sound;
use super::outcome::{Fitted, Residuals};
use super::prepare::PreparedScan;
use super::segments;
use super::warning::FitWarning;
use crate::model::{Family, Grain, StarGrain};
use crate::sphere::Symmetry;

impl PreparedScan<'_> {
    /// Fits the model that the options ask for.
    ///
    /// # Errors
    /// [`FitError`] if the options are out of range or ask for other mirror planes than the scan was
    /// prepared for, if the fit was cancelled, or if what was fitted is no body or far from the points.
    pub fn fit(&self, options: &FitOptions, context: &Context<'_>) -> Result<Fitted, FitError> {
        options.check()?;
        options.tolerance.check(self.mean_radius)?;
        if options.symmetry != self.symmetry {
            return Err(FitError::OtherSymmetry);
        }
        let mut fitted = context.run(|| match options.seams {
            _ if options.symmetry != Symmetry::NONE => mirrored(self, options, context),
            Seams::None => independent(self, options, context),
            Seams::Blended => estimated(self, options, context),
        })?;
        fitted
            .warnings
            .extend(sound::check(&fitted, options, self.is_rod)?);
        if self.may_be_known {
            fitted = fitted.between_points();
        }
        Ok(fitted.measured().beside_polyhedron())
    }

    /// A grain that is not stretched.
    fn grain(&self, family: Family) -> StarGrain {
        StarGrain::new(*self.frame(), family).expect("the axes are orthonormal")
    }

    /// A fitted grain with what the prepared scan tells of it; its family adds the rest.
    pub(super) fn fitted(
        &self,
        grain: StarGrain,
        search: Search,
        residuals: Residuals,
        points: usize,
    ) -> Fitted {
        Fitted {
            grain: Grain::from(grain).with_unseen(self.unseen),
            kind: KindChoice::Star,
            search,
            reference: self.reference,
            points,
            mean_radius: self.mean_radius,
            residuals,
            asymmetry: None,
            estimate: None,
            whole: None,
            warnings: self.warnings.clone(),
            measured: None,
            posterior: None,
            samples: None,
            edged: None,
            errors: None,
            step: self.step,
        }
    }
}

/// Difference of mirror images, as a share of the mean radius, above which a scan is not symmetric.
const LARGEST_ASYMMETRY: f64 = 0.01;

fn mirrored(
    prepared: &PreparedScan<'_>,
    options: &FitOptions,
    context: &Context<'_>,
) -> Result<Fitted, FitError> {
    let fit = mirrored::search(prepared, options, context)?;
    let grain = prepared.grain(Family::Mirrored(fit.surface));
    let mut fitted = prepared.fitted(grain, fit.search, fit.residuals, fit.points);
    fitted.warnings.extend(rejected(&fitted.search));
    let share = fit.asymmetry / fitted.mean_radius;
    if share > LARGEST_ASYMMETRY {
        fitted.warnings.push(FitWarning::Asymmetric { share });
    }
    fitted.asymmetry = Some(fit.asymmetry);
    Ok(fitted)
}

fn independent(
    prepared: &PreparedScan<'_>,
    options: &FitOptions,
    context: &Context<'_>,
) -> Result<Fitted, FitError> {
    let fit = segments::search(prepared, options, context)?;
    let grain = prepared.grain(Family::Segmented(fit.surface));
    let mut fitted = prepared.fitted(grain, fit.search, fit.residuals, fit.points);
    fitted.warnings.extend(rejected(&fitted.search));
    Ok(fitted)
}

fn rejected(search: &Search) -> Option<FitWarning> {
    let choice = search.choice();
    Some(FitWarning::Rejected {
        reason: choice.rejected?,
        segments: choice.segments,
        is_only: search.candidates.len() == 1,
    })
}
