//! The fewest functions that are near enough: a few harmonics of the whole sphere, or cells, split where the surface
//! is far from its samples.

use super::cloud::Cloud;
use super::functions::Functions;
use super::levels::{Found, IsWorth, Level, Levels, home, restart};
use super::rounds::{Fitted, Problem, Used};
use crate::fit::context::{Cancelled, Context, Stage};
use crate::fit::error::FitError;
use crate::fit::options::FitOptions;
use crate::sphere::{CubeCell, MAX_FACE_PARTS};

/// Vertices by which expansions of the whole sphere are tried, and cells are split: some ten per function.
const FEW: usize = 3000;
const MORE: usize = 12_000;

/// Degrees of expansions of the whole sphere that are tried first: an ellipsoid, and up to as many functions as an
/// evaluation of cells touches.
const WHOLE_DEGREES: [usize; 3] = [1, 3, 7];

/// Functions of degree 1.
const OF_ELLIPSOIDS: usize = 4;

/// Degree of cells where none is asked for.
const DEGREE: usize = 3;

/// Points of the scan per function.
const POINTS_PER_FUNCTION: f64 = 3.0;

/// Most functions where nothing else is asked for, and the points are enough for them: some seconds of work.
const MOST_FUNCTIONS: usize = 1000;

/// So many coefficients they have.
pub(in crate::fit) const MOST_COEFFICIENTS: usize = 3 * MOST_FUNCTIONS;

/// Cells are split as long as held-out distances fall at least with this power of the number of functions.
const LEAST_GAIN: f64 = 0.12;

/// Distances of a fit without rounds over those after them: 1.2 to 3.5.
const GAIN_OF_ROUNDS: f64 = 1.3;
const MOST_GAIN_OF_ROUNDS: f64 = 5.0;

/// Share of the squared distances that the cells split at once hold.
const SPLIT_SHARE: f64 = 0.8;

/// Most rounds of expansions of the whole sphere before they are judged: a body is simple only over its own foot
/// points.
const ROUNDS_OF_WHOLE: usize = 50;

/// Fewest such rounds.
const LEAST_ROUNDS_OF_WHOLE: usize = 12;

/// They end where held-out distances fall by less than this share in a round.
const SETTLED: f64 = 0.01;

/// Where an expansion of the whole sphere is so many times farther off than it should be, higher degrees are not tried.
const FAR: f64 = 10.0;

/// Weight of the roughness, and of errors across the normal, while cells are split.
const ROUGHNESS: f64 = 1e-7;
const ACROSS: f64 = 0.3;

/// Fits what the options ask for to a body of about radius 1, within a `limit` of held-out distance. `None` if its
/// samples do not determine a surface, or if none `is_worth` more work, by the number of its coefficients and the least distance
/// that it may come to.
///
/// # Errors
/// As [`Levels::level`].
pub(super) fn search(
    levels: &mut Levels<'_>,
    options: &FitOptions,
    limit: f64,
    is_worth: IsWorth<'_>,
    context: &Context<'_>,
) -> Result<Option<Found>, FitError> {
    let (by_few, by_more);
    by_few = levels.level(FEW, context)?;
    let mut few = levels.cloud(&by_few);
    let asked = options.segments.or(options.is_without_cells().then_some(1));
    match asked {
        Some(1) => {
            let bound = options.max_degree.unwrap_or(usize::MAX);
            let degree = options.degree.unwrap_or(WHOLE_DEGREES[2].min(bound));
            let functions = Functions::whole(degree);
            settle(&functions, &mut few);
            return levels.fit(&by_few, &mut few, &functions, is_worth, context);
        }
        Some(_) => {}
        None => {
            for degree in whole_degrees(options) {
                context.check()?;
                let functions = Functions::whole(degree);
                let Some(held_out) = settle(&functions, &mut few) else {
                    break;
                };
                let held_out = held_out / by_few.most_standing_out();
                if held_out > FAR * limit {
                    break;
                }
                if held_out <= GAIN_OF_ROUNDS * limit
                    && let Some(found) =
                        levels.fit(&by_few, &mut few, &functions, is_worth, context)?
                    && is_enough(&found.fitted, limit)
                {
                    return Ok(Some(found));
                }
            }
        }
    }
    let (level, mut cloud) = match by_few {
        Level::All(_) => (&by_few, few),
        Level::Part(_) => {
            by_more = levels.level(MORE, context)?;
            (&by_more, levels.cloud(&by_more))
        }
    };
    let functions = match asked {
        Some(segments) => on_cells(CubeCell::uniform((segments / 6).isqrt() as u16), options),
        None => {
            let (functions, held_out) = split(&mut cloud, options, limit, context)?;
            if !is_worth(3 * functions.count(), held_out / MOST_GAIN_OF_ROUNDS) {
                return Ok(None);
            }
            functions
        }
    };
    restart(&mut cloud, &functions);
    levels.fit(level, &mut cloud, &functions, is_worth, context)
}

/// Degrees of expansions of the whole sphere that the options leave.
fn whole_degrees(options: &FitOptions) -> Vec<usize> {
    match options.degree {
        Some(degree) => vec![degree],
        None => {
            let most = options.max_degree.unwrap_or(usize::MAX);
            let degrees = WHOLE_DEGREES.into_iter();
            degrees.filter(|&degree| degree <= most).collect()
        }
    }
}

fn is_enough(fitted: &Fitted, limit: f64) -> bool {
    fitted.held_out.rms <= limit && fitted.is_sound()
}

fn on_cells(cells: Vec<CubeCell>, options: &FitOptions) -> Functions {
    let searched = options.max_degree.unwrap_or(DEGREE).min(DEGREE);
    Functions::on_cells(cells, options.degree.unwrap_or(searched))
        .expect("cells that tile the sphere")
}

/// What one fit tells of functions.
struct Once {
    /// Root of the mean squared distance of samples not used.
    held_out: f64,
    /// Sums of weighted squared distances of all samples, by cell.
    errors: Vec<f64>,
}

/// Moves the samples of an expansion to their foot points until it comes no nearer. From the map that is far where a
/// body is slender, so that degree 1, of ellipsoids, starts from that of equal moments. Gives the root of the mean squared
/// distance of samples not used.
fn settle(functions: &Functions, cloud: &mut Cloud<'_>) -> Option<f64> {
    restart(cloud, functions);
    if functions.per_cell() == OF_ELLIPSOIDS {
        cloud.start_on_ellipsoid();
    }
    let problem = Problem::new(functions);
    let mut held_out = f64::INFINITY;
    for round in 0..ROUNDS_OF_WHOLE {
        let rows = problem.rows(cloud);
        let weights = [1.0, ACROSS];
        let surface = problem.fit(cloud, &rows, weights, ROUGHNESS, Used::NotLeftOut)?;
        let found = cloud.distances(&surface, |at| cloud.is_held_out(at));
        if round >= LEAST_ROUNDS_OF_WHOLE && found.rms > (1.0 - SETTLED) * held_out {
            break;
        }
        held_out = found.rms;
        cloud.project(&surface);
    }
    Some(held_out)
}

/// Fits once.
fn try_once(functions: &Functions, cloud: &mut Cloud<'_>) -> Option<Once> {
    restart(cloud, functions);
    let problem = Problem::new(functions);
    let rows = problem.rows(cloud);
    let weights = [1.0, ACROSS];
    let surface = problem.fit(cloud, &rows, weights, ROUGHNESS, Used::NotLeftOut)?;
    let all: Vec<usize> = (0..cloud.points.len()).collect();
    let squares = cloud.squared_distances(&surface, &all);
    let of_held_out = all.into_iter().filter(|&at| cloud.is_held_out(at));
    let held_out = cloud.mean_of(of_held_out.map(|at| (at, squares[at])));
    let mut errors = vec![0.0; functions.cell_count()];
    for (at, squared) in squares.iter().enumerate() {
        errors[home(functions, &cloud.directions[at])] += cloud.weights[at] * squared;
    }
    Some(Once {
        held_out: held_out.rms,
        errors,
    })
}

/// Splits cells until held-out samples are met well enough, or hardly any better, or there are too many. Cells of one
/// size compete with what comes out. Told is how far held-out samples are from what was fitted once.
fn split(
    cloud: &mut Cloud<'_>,
    options: &FitOptions,
    limit: f64,
    context: &Context<'_>,
) -> Result<(Functions, f64), Cancelled> {
    let mut functions = on_cells(CubeCell::uniform(1), options);
    let most = match options.max_segments {
        Some(segments) => segments,
        None => {
            let told = (cloud.scan_points() as f64 / POINTS_PER_FUNCTION) as usize;
            MOST_FUNCTIONS.min(told) / functions.per_cell()
        }
    };
    let mut once = try_once(&functions, cloud);
    for done in 1.. {
        context.enter(Stage::Searching { done, all: None })?;
        let Some(found) = once
            .as_ref()
            .filter(|found| found.held_out > GAIN_OF_ROUNDS * limit)
        else {
            break;
        };
        let room = most.saturating_sub(functions.cell_count()) / 3;
        let Some(finer) = quartered(&functions, &found.errors, room) else {
            break;
        };
        let finer = on_cells(finer, options);
        let growth = finer.count() as f64 / functions.count() as f64;
        let Some(next) = try_once(&finer, cloud) else {
            break;
        };
        if next.held_out > found.held_out * growth.powf(-LEAST_GAIN) {
            break;
        }
        (functions, once) = (finer, Some(next));
    }
    let parts = (functions.cell_count() / 6).isqrt() as u16;
    let even = on_cells(CubeCell::uniform(parts), options);
    let held_out = once.map_or(f64::INFINITY, |once| once.held_out);
    if even.count() < functions.count()
        && let Some(once) = try_once(&even, cloud)
        && once.held_out < held_out
    {
        return Ok((even, once.held_out));
    }
    Ok((functions, held_out))
}

/// The cells with the largest errors in four, at most so many and a third of all, but none that are as fine as can be.
/// `None` if that is none.
fn quartered(functions: &Functions, errors: &[f64], room: usize) -> Option<Vec<CubeCell>> {
    let cells = functions.cover()?.cells();
    let may_split = |cell: &usize| cells[*cell].parts <= MAX_FACE_PARTS / 2;
    let mut order: Vec<usize> = (0..errors.len()).filter(may_split).collect();
    order.sort_by(|&one, &other| errors[other].total_cmp(&errors[one]).then(one.cmp(&other)));
    let goal = SPLIT_SHARE * errors.iter().sum::<f64>();
    let (mut held, mut is_split) = (0.0, vec![false; errors.len()]);
    for &cell in order.iter().take(room.min(cells.len().div_ceil(3))) {
        if held >= goal {
            break;
        }
        held += errors[cell];
        is_split[cell] = true;
    }
    let finer = cells
        .iter()
        .zip(&is_split)
        .flat_map(|(cell, is_split)| match is_split {
            true => cell.quarters().to_vec(),
            false => vec![*cell],
        });
    is_split.contains(&true).then(|| finer.collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cells_as_fine_as_can_be_are_not_cut() {
        let mut cells = CubeCell::uniform(1);
        while cells[0].parts < MAX_FACE_PARTS {
            let quarters = cells.remove(0).quarters();
            cells.splice(0..0, quarters);
        }
        let functions = on_cells(cells, &FitOptions::default());
        let mut errors = vec![0.0; functions.cell_count()];
        errors[..4].fill(1.0);
        errors[4] = 0.5;
        let finer = quartered(&functions, &errors, 100).unwrap();
        assert_eq!(
            on_cells(finer.clone(), &FitOptions::default()).cell_count(),
            finer.len()
        );
        assert!(finer.len() > functions.cell_count());
    }

    #[test]
    fn degrees_of_the_whole_sphere_are_those_asked_for() {
        let options = FitOptions::default();
        assert_eq!(whole_degrees(&options), [1, 3, 7]);
        assert_eq!(whole_degrees(&options.clone().with_degree(2)), [2]);
        assert_eq!(whole_degrees(&options.clone().with_max_degree(4)), [1, 3]);
        let cells = || CubeCell::uniform(1);
        let bounded = options.clone().with_max_degree(2);
        assert_eq!(on_cells(cells(), &bounded).per_cell(), 9);
        assert_eq!(
            on_cells(cells(), &options.with_max_degree(5)).per_cell(),
            16
        );
    }
}
