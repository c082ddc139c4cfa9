//! Our best model for each figure of a table, and for all of them at once.

use crate::chapter_3::reference::{Printed, Row};
use crate::chapter_3::search::{Found, Goal, search};
use crate::chapter_3::study::{Figures, Study};
use crate::tables::threshold;
use grainform::fit::MirroredFitError;

/// Exponents of the sine that are searched.
const SINES: [f64; 5] = [0.0, 0.25, 0.5, 1.0, 1.5];

/// Exponents of the cosine between ray and normal that are searched.
const SLOPES: [f64; 9] = [-3.5, -3.0, -2.5, -2.0, -1.5, -1.0, -0.5, 0.0, 0.5];

/// The best printed figures of a table, column by column. Where no threshold is printed, ours takes its
/// place.
pub(crate) fn goal(printed: &Printed, study: &Study) -> Option<Goal> {
    let off = |row: &Row, column: &str, exact: f64| Some((row.get(column)? / exact - 1.0).abs());
    let least = |figure: &dyn Fn(&Row) -> Option<f64>| {
        let figures = printed.rows.iter().filter_map(figure);
        figures.min_by(f64::total_cmp)
    };
    let ls = least(&|row| row.get("ls_error"))?;
    Some(Goal {
        ls_ratio: threshold(printed).map_or(1.0, |threshold| ls / threshold),
        area: least(&|row| off(row, "area", study.exact.area))?,
        volume: least(&|row| off(row, "volume", study.exact.volume))?,
    })
}

/// Prints the best for each figure, and for all of them at once.
pub(crate) fn print(
    study: &Study,
    goal: Option<&Goal>,
    samples: [usize; 2],
) -> Result<(), MirroredFitError> {
    let found = search(study, samples, &SINES, &SLOPES)?;
    let points = samples[0] * samples[1];
    println!(
        "Ours, {points} points: samples weigh sin(theta)^a r^b cos(gamma)^c per step of the angles.\n\n\
         | best for | a, b, c | LS | of the threshold | S | off | V | off | better than the best printed |\n\
         |---|---|---|---|---|---|---|---|---|"
    );
    let least = |keep: &dyn Fn(&Figures) -> bool, by: &dyn Fn(&Figures) -> f64| {
        let kept = found.iter().filter(|found| keep(&found.figures));
        kept.min_by(|a, b| by(&a.figures).total_cmp(&by(&b.figures)))
    };
    let ls = |figures: &Figures| figures.ls_ratio;
    row(study, "LS", least(&|_| true, &ls), goal);
    let Some(goal) = goal else {
        row(
            study,
            "V",
            least(&|f| f.volume_error.abs() < 1e-5, &ls),
            None,
        );
        return Ok(());
    };
    let area = least(&|f| f.area_error.abs() < goal.area / 2.0, &ls);
    let volume = least(&|f| f.volume_error.abs() < goal.volume / 2.0, &ls);
    let both = |f: &Figures| f.area_error.abs() < goal.area && f.volume_error.abs() < goal.volume;
    row(study, "S", area, Some(goal));
    row(study, "V", volume, Some(goal));
    row(study, "S and V", least(&both, &ls), Some(goal));
    row(
        study,
        "all",
        least(&|f| goal.worst(f) < 1.0, &|f| goal.worst(f)),
        Some(goal),
    );
    Ok(())
}

fn row(study: &Study, name: &str, found: Option<&Found>, goal: Option<&Goal>) {
    let Some(Found { density, figures }) = found else {
        println!("| {name} | none in the search |");
        return;
    };
    let verdict = goal.map_or("-".into(), |goal| goal.better(figures).join(", "));
    println!(
        "| {name} | {}, {:.4}, {} | {:.4} | {:.4} | {:.3} | {:+.3} % | {:.3} | {:+.4} % | {verdict} |",
        density.sine,
        density.radius,
        density.slope,
        figures.ls_ratio * study.threshold,
        figures.ls_ratio,
        study.exact.area * (1.0 + figures.area_error),
        100.0 * figures.area_error,
        study.exact.volume * (1.0 + figures.volume_error),
        100.0 * figures.volume_error,
    );
}
