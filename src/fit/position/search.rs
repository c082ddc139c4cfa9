//! The fewest functions that are near enough: a few harmonics of the whole sphere, or cells, split where the surface
//! is far from its samples.

use super::cloud::Cloud;
use super::functions::Functions;
use super::rounds::{Fitted, Problem, Used};
use crate::fit::context::{Cancelled, Context, Stage};
use crate::fit::options::FitOptions;
use crate::sphere::CubeCell;
use nalgebra::Vector3;
use std::f64::consts::PI;

/// Degrees of expansions of the whole sphere that are tried first: an ellipsoid, and up to as many functions as an
/// evaluation of cells touches.
const WHOLE_DEGREES: [usize; 3] = [1, 3, 7];

/// Degree of cells where none is asked for.
const DEGREE: usize = 3;

/// Samples per function: places inside large triangles are added until there are as many. With three, surfaces bulge
/// between the 1538 points of a kernel by up to 11 % of the radius.
const SAMPLES_PER_FUNCTION: f64 = 8.0;

/// Points of the scan per function.
const POINTS_PER_FUNCTION: f64 = 3.0;

/// Most functions where nothing else is asked for, and the points are enough for them: some seconds of work.
const MOST_FUNCTIONS: usize = 1000;

/// Cells are split as long as held-out distances fall at least with this power of the number of functions.
const LEAST_GAIN: f64 = 0.12;

/// Distances of a fit without rounds over those after them: 1.2 to 3.5.
const GAIN_OF_ROUNDS: f64 = 1.3;
const MOST_GAIN_OF_ROUNDS: f64 = 5.0;

/// Share of the squared distances that the cells split at once hold.
const SPLIT_SHARE: f64 = 0.8;

/// Rounds of expansions of the whole sphere before they are judged: an ellipsoid is linear in n only over its own foot
/// points.
const ROUNDS_OF_WHOLE: usize = 12;

/// Where an expansion of the whole sphere is so many times farther off than it should be, higher degrees are not tried.
const FAR: f64 = 10.0;

/// Weight of the roughness, and of errors across the normal, while cells are split.
const ROUGHNESS: f64 = 1e-7;
const ACROSS: f64 = 0.3;

/// Fits what the options ask for to samples of a body of about radius 1, within a `limit` of held-out distance.
/// `None` if the samples do not determine a surface, or if that of cells `is_worth` no more work, by the number of its
/// coefficients and the least distance that it may come to.
pub(super) fn search(
    cloud: &mut Cloud<'_>,
    options: &FitOptions,
    limit: f64,
    is_worth: &(dyn Fn(usize, f64) -> bool + Sync),
    context: &Context<'_>,
) -> Result<Option<Fitted>, Cancelled> {
    match options.segments {
        Some(1) => {
            let degree = options.degree.unwrap_or(WHOLE_DEGREES[2]);
            return fit(&Functions::whole(degree), cloud, context);
        }
        Some(segments) => {
            let parts = (segments / 6).isqrt() as u16;
            return fit(&on_cells(CubeCell::uniform(parts), options), cloud, context);
        }
        None => {}
    }
    for degree in WHOLE_DEGREES {
        let functions = Functions::whole(degree);
        let Some(once) = try_once(&functions, cloud, ROUNDS_OF_WHOLE) else {
            break;
        };
        if once.held_out > FAR * limit {
            break;
        }
        if once.held_out <= GAIN_OF_ROUNDS * limit
            && let Some(fitted) = Problem::new(&functions).run(cloud, context)?
            && is_enough(&fitted, limit)
        {
            return Ok(Some(fitted));
        }
    }
    let (functions, held_out) = split(cloud, options, limit, context)?;
    match is_worth(3 * functions.count(), held_out / MOST_GAIN_OF_ROUNDS) {
        true => fit(&functions, cloud, context),
        false => Ok(None),
    }
}

fn is_enough(fitted: &Fitted, limit: f64) -> bool {
    fitted.held_out.rms <= limit && fitted.faults == [0, 0]
}

fn on_cells(cells: Vec<CubeCell>, options: &FitOptions) -> Functions {
    Functions::on_cells(cells, options.degree.unwrap_or(DEGREE))
        .expect("cells that tile the sphere")
}

fn fit(
    functions: &Functions,
    cloud: &mut Cloud<'_>,
    context: &Context<'_>,
) -> Result<Option<Fitted>, Cancelled> {
    restart(cloud, functions);
    Problem::new(functions).run(cloud, context)
}

/// What one fit tells of functions.
struct Once {
    /// Root of the mean squared distance of samples not used.
    held_out: f64,
    /// Sums of weighted squared distances of all samples, by cell.
    errors: Vec<f64>,
}

/// Fits once, after so many rounds of the same.
fn try_once(functions: &Functions, cloud: &mut Cloud<'_>, rounds: usize) -> Option<Once> {
    restart(cloud, functions);
    let problem = Problem::new(functions);
    let fit = |cloud: &Cloud<'_>| {
        let rows = problem.rows(cloud);
        problem.fit(cloud, &rows, [1.0, ACROSS], ROUGHNESS, Used::NotLeftOut)
    };
    for _ in 0..rounds {
        let surface = fit(cloud)?;
        cloud.project(&surface);
    }
    let surface = fit(cloud)?;
    let (held_out, squares) = cloud.distances(&surface, |at| cloud.is_held_out(at));
    let mut errors = vec![0.0; functions.cell_count()];
    for (at, squared) in squares.iter().enumerate() {
        errors[home(functions, &cloud.directions[at])] += cloud.weights[at] * squared;
    }
    Some(Once {
        held_out: held_out.rms,
        errors,
    })
}

/// Starts from the map, with enough samples in every cell.
fn restart(cloud: &mut Cloud<'_>, functions: &Functions) {
    let per_function =
        |solid_angle: f64| solid_angle / (SAMPLES_PER_FUNCTION * functions.per_cell() as f64);
    match functions.cover() {
        None => cloud.restart(|_| per_function(4.0 * PI)),
        Some(cover) => {
            let areas: Vec<f64> = cover.cells().iter().map(CubeCell::solid_angle).collect();
            cloud.restart(|n| per_function(areas[home(functions, n)]));
        }
    }
}

/// The cell that counts most in a direction.
fn home(functions: &Functions, n: &Vector3<f64>) -> usize {
    let Some(cover) = functions.cover() else {
        return 0;
    };
    let mut shares = Vec::new();
    cover.shares(n, &mut shares);
    let most = shares.iter().max_by(|one, other| one.1.total_cmp(&other.1));
    most.map_or(0, |&(cell, _)| cell.into())
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
    let mut once = try_once(&functions, cloud, 0);
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
        let Some(next) = try_once(&finer, cloud, 0) else {
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
        && let Some(once) = try_once(&even, cloud, 0)
        && once.held_out < held_out
    {
        return Ok((even, once.held_out));
    }
    Ok((functions, held_out))
}

/// The cells with the largest errors in four, at most so many and a third of all. `None` if that is none.
fn quartered(functions: &Functions, errors: &[f64], room: usize) -> Option<Vec<CubeCell>> {
    let cells = functions.cover()?.cells();
    let mut order: Vec<usize> = (0..errors.len()).collect();
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
