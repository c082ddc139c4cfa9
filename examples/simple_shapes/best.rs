//! Our best model for each figure of a table, and for all of them at once.

use crate::chapter_3::reference::{Printed, Row};
use crate::chapter_3::search::{Found, Goal, search};
use crate::chapter_3::study::{Figures, Study};
use crate::refine::refine;
use crate::tables::threshold;
use grainform::fit::MirroredFitError;

/// Exponents of the sine that are searched.
const SINES: [f64; 5] = [0.0, 0.25, 0.5, 1.0, 1.5];

/// Exponents of the cosine between ray and normal that are searched.
const SLOPES: [f64; 9] = [-3.5, -3.0, -2.5, -2.0, -1.5, -1.0, -0.5, 0.0, 0.5];

/// Models from which a refinement starts.
const STARTS: usize = 24;

/// A printed row as something to be beaten.
pub(crate) struct Rival {
    pub(crate) name: String,
    points: f64,
    pub(crate) goal: Goal,
}

/// The printed rows. Where no threshold is printed, ours takes its place.
pub(crate) fn rivals(printed: &Printed, study: &Study) -> Vec<Rival> {
    let off = |row: &Row, column: &str, exact: f64| Some((row.get(column)? / exact - 1.0).abs());
    let rival = |row: &Row| {
        let (q, polar, azimuth) = (row.text("strategy"), row.text("n_theta"), row.text("n_phi"));
        Some(Rival {
            name: format!("q = {q}, {polar} x {azimuth}"),
            points: row.get("points")?,
            goal: Goal {
                ls_ratio: threshold(printed)
                    .map_or(Some(1.0), |t| Some(row.get("ls_error")? / t))?,
                area: off(row, "area", study.exact.area)?,
                volume: off(row, "volume", study.exact.volume)?,
            },
        })
    };
    printed.rows.iter().filter_map(rival).collect()
}

/// The best printed figures of a table, column by column.
pub(crate) fn goal(rivals: &[Rival]) -> Option<Goal> {
    let least = |figure: &dyn Fn(&Goal) -> f64| {
        let figures = rivals.iter().map(|rival| figure(&rival.goal));
        figures.min_by(f64::total_cmp)
    };
    Some(Goal {
        ls_ratio: least(&|goal| goal.ls_ratio)?,
        area: least(&|goal| goal.area)?,
        volume: least(&|goal| goal.volume)?,
    })
}

/// Prints the best for each figure, for all of them at once, and which printed rows one of ours beats in all
/// three; gives the rows that none beats.
pub(crate) fn print(
    study: &Study,
    rivals: Vec<Rival>,
    samples: [usize; 2],
) -> Result<Vec<Rival>, MirroredFitError> {
    let goal = goal(&rivals);
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
    row(study, "LS", least(&|_| true, &ls), goal.as_ref());
    let Some(goal) = &goal else {
        row(
            study,
            "V",
            least(&|f| f.volume_error.abs() < 1e-5, &ls),
            None,
        );
        return Ok(rivals);
    };
    let area = least(&|f| f.area_error.abs() < goal.area / 2.0, &ls);
    let volume = least(&|f| f.volume_error.abs() < goal.volume / 2.0, &ls);
    let both = |f: &Figures| f.area_error.abs() < goal.area && f.volume_error.abs() < goal.volume;
    row(study, "S", area, Some(goal));
    row(study, "V", volume, Some(goal));
    row(study, "S and V", least(&both, &ls), Some(goal));
    let all = beating(study, samples, &found, goal)?;
    row(study, "all", all.as_ref(), Some(goal));

    println!(
        "\nRow by row, of those with as many points or more, one of ours that is better in LS, S and V:\n"
    );
    let mut unbeaten = Vec::new();
    for rival in rivals
        .into_iter()
        .filter(|rival| rival.points >= points as f64)
    {
        match beating(study, samples, &found, &rival.goal)? {
            Some(best) => println!("- {}: {}", rival.name, told(&best)),
            None => {
                println!("- {}: none in the search", rival.name);
                unbeaten.push(rival);
            }
        }
    }
    Ok(unbeaten)
}

/// A model that is better in all figures, from the nearest of those found, if a refinement of one of them
/// leads there.
fn beating(
    study: &Study,
    samples: [usize; 2],
    found: &[Found],
    goal: &Goal,
) -> Result<Option<Found>, MirroredFitError> {
    let mut nearest: Vec<&Found> = found.iter().collect();
    nearest.sort_by(|a, b| goal.worst(&a.figures).total_cmp(&goal.worst(&b.figures)));
    for start in nearest.into_iter().take(STARTS) {
        let best = refine(study, samples, start, goal)?;
        if goal.worst(&best.figures) < 1.0 {
            return Ok(Some(best));
        }
    }
    Ok(None)
}

/// A model in short.
fn told(Found { density, figures }: &Found) -> String {
    format!(
        "a, b, c = {:.3}, {:.3}, {:.3}; LS {:.4} of the threshold, S {:+.3} %, V {:+.4} %",
        density.sine,
        density.radius,
        density.slope,
        figures.ls_ratio,
        100.0 * figures.area_error,
        100.0 * figures.volume_error,
    )
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
