//! Why a candidate was chosen, in one sentence.

use super::number::short;
use crate::fit::{FitOptions, Fitted, Seams, Tolerance};
use crate::sphere::Symmetry;

/// The rule of [`crate::fit`] as it decided here.
pub(super) fn rule(fitted: &Fitted, options: &FitOptions) -> String {
    let search = &fitted.search;
    let choice = search.choice();
    if search.candidates.len() == 1 {
        return "the only candidate asked for".into();
    }
    let is_refined = options.seams == Seams::Blended && options.symmetry == Symmetry::NONE;
    if choice.rejected.is_some() && !is_refined {
        return "every candidate was rejected; this one has the least held-out RMS".into();
    }
    let tolerance = options.tolerance.length(fitted.mean_radius);
    let source = match options.tolerance {
        Tolerance::Length(_) => "the tolerance".into(),
        Tolerance::Auto | Tolerance::OfMeanRadius(_) => {
            let share = round(100.0 * tolerance / fitted.mean_radius);
            format!("{share} % of the mean radius")
        }
    };
    let source = match options.seams {
        _ if search.limit <= tolerance => source,
        Seams::Blended => format!("{source} and the scan's noise of {}", short(search.noise)),
        Seams::None => "what the scan's noise allows".into(),
    };
    let limit = format!("the limit of {} ({source})", short(search.limit));
    match choice.heldout_rms {
        Some(rms) if rms <= search.limit => {
            format!("the fewest coefficients whose held-out RMS is within {limit}")
        }
        _ if is_refined => {
            format!(
                "splitting segments further does not lower the held-out RMS; {limit} is not met"
            )
        }
        _ => format!("no candidate is within {limit}; this one has the least held-out RMS"),
    }
}

/// Without the last digits of a product: 0.3 and not 0.30000000000000004.
fn round(value: f64) -> f64 {
    (value * 1e9).round() / 1e9
}
