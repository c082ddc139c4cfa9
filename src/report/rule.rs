//! Why a candidate was chosen, in one sentence.

use super::labels::Labels;
use super::number::{round, short};
use crate::digits::plural;
use crate::fit::{FitOptions, Fitted, KindChoice, Rival, Tolerance};
use crate::sphere::Symmetry;
use crate::unit::Unit;

/// The rule of [`crate::fit`](crate::fit()) as it decided here.
pub(super) fn rule(fitted: &Fitted, options: &FitOptions, unit: Option<Unit>) -> String {
    let labels = Labels(unit);
    let length = |length: f64| format!("{}{}", short(length), labels.length());
    let search = &fitted.search;
    let choice = search.choice();
    if fitted.grain.position().is_some() {
        let limit = length(search.limit);
        let is_met = choice.heldout_rms.is_some_and(|rms| rms <= search.limit);
        return match is_met {
            _ if options.segments.is_some() => "the only candidate asked for".into(),
            true => format!("the first cover tried whose held-out distance is within {limit}"),
            false => format!(
                "no cover tried is within {limit}: cells were split as long as that brought held-out points nearer"
            ),
        };
    }
    let is_only = match fitted.estimate {
        Some(_) => options.degree.is_some() && options.segments.is_some(),
        None => search.candidates.len() == 1,
    };
    if is_only {
        return "the only candidate asked for".into();
    }
    if choice.rejected.is_some() {
        return "every candidate was rejected; this one has the least held-out RMS".into();
    }
    let asked_for = match options.tolerance.share() {
        Some(share) => format!("{} % of the mean radius", round(100.0 * share)),
        None => "the tolerance".into(),
    };
    if let (Some(estimate), Some(rms)) = (&fitted.estimate, choice.estimate_rms) {
        let source = match search.limit > search.tolerance {
            true => format!(
                "{:.0} % of the estimate's standard deviation of {}",
                100.0 * search.limit / estimate.deviation,
                length(estimate.deviation)
            ),
            false => asked_for,
        };
        let limit = format!("{} ({source})", length(search.limit));
        let is_all = options.segments == Some(1) && options.tolerance == Tolerance::Auto;
        return match search.work.candidates {
            _ if rms > search.limit && choice.segments == 1 => format!(
                "no degree allowed is within {limit} of the estimate; allow more (--max-degree) or a larger error \
                 (--tolerance)"
            ),
            _ if rms > search.limit => format!(
                "none of the covers tried is within {limit} of the estimate; this one is nearest"
            ),
            _ if is_all => format!(
                "the lowest degree that leaves out no more than {} of the estimate",
                length(search.limit)
            ),
            covers if choice.segments == 1 => {
                let no_cover = match covers {
                    0 => "",
                    _ => ", which no cover of fewer coefficients comes near",
                };
                format!("the lowest degree within {limit} of the estimate{no_cover}")
            }
            1 => format!("the only cover tried, within {limit} of the estimate"),
            covers => format!(
                "the fewest coefficients of the {covers} covers tried that are within {limit} of the estimate"
            ),
        };
    }
    let source = match search.limit > search.tolerance {
        true => "the noise as these fits tell it".into(),
        false => asked_for,
    };
    let limit = format!("the limit of {} ({source})", length(search.limit));
    match choice.heldout_rms {
        Some(rms) if rms <= search.limit => {
            format!("the fewest coefficients whose held-out RMS is within {limit}")
        }
        _ => format!(
            "no candidate is within {limit}; this one has the least held-out RMS (try a larger --max-degree{}, or \
             --tolerance)",
            match fitted.grain.symmetry() {
                Symmetry::NONE => " or --max-segments",
                _ => "",
            }
        ),
    }
}

/// Why the surface is of its kind; nothing where a radius follows the scan.
pub(super) fn kind_rule(fitted: &Fitted, unit: Option<Unit>) -> Option<String> {
    let labels = Labels(unit);
    let told = |rival: &Rival| {
        let coefficients = plural(rival.coefficients, "coefficient");
        format!(
            "{coefficients} at a distance of {}{}",
            short(rival.rms),
            labels.length()
        )
    };
    match &fitted.kind {
        KindChoice::Asked => Some("as asked for".into()),
        KindChoice::Hidden { share } => Some(format!(
            "for {:.1} % of the area faces away from the best centre",
            100.0 * share
        )),
        KindChoice::Voxels => {
            Some("for the steps between voxels are no texture of the grain".into())
        }
        KindChoice::NoRadius => Some("for no radius follows the points".into()),
        KindChoice::Compared { kept, rival } => {
            let is_nearer = rival.rms < kept.rms && kept.rms > fitted.search.limit;
            let other = match is_nearer {
                true => "a radius, which does not see all of it, takes",
                false => "a radius takes",
            };
            Some(format!(
                "for it takes {}, where {other} {}",
                told(kept),
                told(rival)
            ))
        }
        KindChoice::Outdoes { kept, forecast } => {
            let nearer = match forecast.rms < kept.rms {
                true => "may come as near as",
                false => "come no nearer than",
            };
            Some(format!(
                "for it takes {}, where {} of the position of points {nearer} {}{}",
                told(kept),
                plural(forecast.coefficients, "coefficient"),
                short(forecast.rms),
                labels.length()
            ))
        }
        KindChoice::NoPositions(error) => {
            Some(format!("for positions were tried in vain: {error}"))
        }
        _ => None,
    }
}
