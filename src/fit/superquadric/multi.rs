//! A union of superquadrics, with as many parts as held-out points ask for.

use super::bodies::Body;
use super::cloud::Cloud;
use super::clusters::{Begin, SEEDINGS, ellipsoids};
use super::error::SuperquadricFitError;
use super::form::Form;
use super::least_squares::{
    End, Minimum, OTHER_MINIMUM, descended, distinct, least, losses, ranked, weighed,
};
use super::normal_equations::distances;
use super::search::best;
use super::standard_errors::{ParameterErrors, covariance, standard_errors};
use super::starts::turned;
use super::weighing::Weighing;
use crate::fit::Residuals;
use crate::fit::context::{Cancelled, Context};
use crate::model::{
    Frame, Grain, InvalidGrain, MultiSuperquadric, NoStandardErrors, Part, SuperquadricGrain,
};
use crate::scan::VoxelLattice;
use nalgebra::{Point3, Vector3};

#[cfg(test)]
mod tests;

/// The most parts that can be asked for.
pub const MAX_UNION_PARTS: usize = 12;

/// How sharply the least distance is taken, in one over mean radii, stage by stage.
const SHARPNESS: [f64; 3] = [8.0, 30.0, 120.0];

/// How long each stage goes on, and the last with all points.
const STAGE: End = End {
    steps: 25,
    gain: 1e-5,
};
const LAST: End = End { steps: 60, ..STAGE };

/// How long turned parts are tried.
const TURNED: End = End {
    steps: 12,
    gain: 1e-3,
};

/// How many times as far as the farthest point a part may reach.
const BEYOND: f64 = 1.5;

/// How many times the least loss of a stage that of a fit may be which goes on.
const PROMISING: f64 = 4.0;

/// Times that the parts of the best are turned.
const MAX_TURNS: usize = 3;

/// Starts that are gone on from, those of the least losses.
const MAX_STARTS: usize = 10;

/// How many times the loss of a start that of another one is.
const OTHER_START: f64 = 1.0 + 1e-9;

/// Cells of directions along an edge of the cube, of which every fifth is held out.
const HELD_OUT_CELLS: usize = 24;

/// What another part must take off the held-out error, and a turned one off the loss.
const WORTH: f64 = 0.95;

/// RMS distance, in mean radii, below which no part is turned and no more are tried.
const EXACT: f64 = 1e-4;

/// A union of superquadrics fitted to points.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct MultiFit {
    /// The union, about its centre.
    pub union: MultiSuperquadric,
    /// Where its centre and axes are in the scan.
    pub frame: Frame,
    /// Distances of the points from the part that is nearest, along rays from its centre.
    pub residuals: Residuals,
    /// Mean distance of the points from their mean, in the scan's unit.
    pub mean_radius: f64,
    /// Standard errors, part by part.
    pub errors: Vec<ParameterErrors>,
    /// RMS distances of points held out of the fit, in the scan's unit, of one part, of two and so on: as many as were tried.
    pub held_out: Vec<f64>,
}

impl MultiFit {
    /// The union as a grain, without standard errors of its area, volume and so on.
    ///
    /// # Errors
    /// [`InvalidGrain`] if the frame was changed and is none.
    pub fn grain(&self) -> Result<Grain, InvalidGrain> {
        let grain: Grain = SuperquadricGrain::multi(self.frame, self.union.clone())?.into();
        Ok(grain.with_standard_errors(Err(NoStandardErrors::NotEstimated)))
    }
}

/// Fits a union of as many superquadrics as held-out points ask for, `most` at most. `lattice`: as of [`fit_superquadric`](super::fit_superquadric).
///
/// # Errors
/// [`SuperquadricFitError`] if there are too few points for so many parts, or they enclose no volume.
pub fn fit_multi_superquadric(
    points: &[Point3<f64>],
    lattice: Option<&VoxelLattice>,
    most: usize,
    context: &Context<'_>,
) -> Result<MultiFit, SuperquadricFitError> {
    if !(1..=MAX_UNION_PARTS).contains(&most) {
        return Err(SuperquadricFitError::Parts {
            parts: most,
            most: MAX_UNION_PARTS,
        });
    }
    let cloud = Cloud::new(points, lattice, most * Form::Single.parameters())?;
    context.run(|| {
        let (mut chosen, held_out) = chosen(&cloud, most, context)?;
        let farthest = farthest(&cloud.points);
        loop {
            let best = chosen.pop().ok_or(SuperquadricFitError::NoVolume)?;
            let weighing = weighed(&best.bodies, &cloud.points, &best.weighing);
            let mut found = descended(best.bodies, &cloud.points, weighing, LAST, context)?;
            found.bodies = found.bodies.into_iter().map(Body::in_order).collect();
            let told = told(&cloud, &found, held_out.clone());
            if told.is_ok() && is_within(&found.bodies, farthest) || chosen.is_empty() {
                return told;
            }
        }
    })
}

/// The best fits to the points that are not held out, of fewer and of more parts as long as more are worth it, and the held-out
/// errors of all numbers of parts.
fn chosen(
    cloud: &Cloud,
    most: usize,
    context: &Context<'_>,
) -> Result<(Vec<Minimum>, Vec<f64>), SuperquadricFitError> {
    let is_held_out = |point: &Vector3<f64>| {
        let [_, row, column] = cloud.cell(point, HELD_OUT_CELLS);
        (row + 2 * column) % 5 == 0
    };
    let (out, kept): (Vec<Vector3<f64>>, _) =
        cloud.points.iter().partition(|point| is_held_out(point));
    let cloud = Cloud {
        points: kept,
        ..cloud.clone()
    };
    let error = |found: &Minimum| Residuals::of(distances(&found.bodies, &out)).rms * cloud.size;
    let single = best(&cloud, Form::Single, context)?;
    let mut errors = vec![error(&single)];
    let (mut chosen, mut least) = (vec![single.clone()], errors[0]);
    let farthest = farthest(&cloud.points);
    for parts in 2..=most {
        if least < EXACT * cloud.size {
            break;
        }
        let found = with_parts(&cloud, parts, &single.weighing, context)?;
        let error = error(&found);
        errors.push(error);
        if error < WORTH * least && is_within(&found.bodies, farthest) {
            least = error;
            chosen.push(found);
        }
    }
    Ok((chosen, errors))
}

/// Whether no body reaches far beyond the points, the farthest of which is so far off: a thin one may lie between them, edge
/// on.
fn is_within(bodies: &[Body], farthest: f64) -> bool {
    bodies.iter().all(|body| {
        let numbers = body.numbers();
        (0..6).all(|side| {
            let sign = if side % 2 == 0 { 1.0 } else { -1.0 };
            let end = body.centre + body.axes.column(side / 2) * (sign * numbers[side]);
            end.norm() <= BEYOND * farthest
        })
    })
}

fn farthest(points: &[Vector3<f64>]) -> f64 {
    points.iter().map(Vector3::norm).fold(0.0, f64::max)
}

/// The best fit of so many parts, two at least: all parts at once, from all starts, to minima of distances that get
/// sharper.
fn with_parts(
    cloud: &Cloud,
    parts: usize,
    like: &Weighing,
    context: &Context<'_>,
) -> Result<Minimum, SuperquadricFitError> {
    let few = cloud.thinned();
    let [first, second, last] = SHARPNESS.map(|sharpness| Weighing { sharpness, ..*like });
    let starts = [Begin::Beside, Begin::Across]
        .into_iter()
        .flat_map(|begin| SEEDINGS.map(|seeding| (begin, seeding)))
        .filter_map(|(begin, seeding)| ellipsoids(cloud, &few, parts, begin, seeding))
        .map(|bodies| Minimum {
            weighing: weighed(&bodies, &few, &first),
            iterations: 0,
            bodies,
        });
    let mut found = distinct(ranked(starts.collect(), &few), f64::INFINITY, OTHER_START);
    found.truncate(MAX_STARTS);
    for stage in [first, second, last] {
        let sharper = found.into_iter().map(|found| {
            let weighing = weighed(&found.bodies, &few, &stage);
            descended(found.bodies, &few, weighing, STAGE, context)
        });
        let sharper = ranked(sharper.collect::<Result<Vec<_>, _>>()?, &few);
        found = distinct(sharper, PROMISING, OTHER_MINIMUM);
    }
    let farthest = farthest(&cloud.points);
    found.sort_by_key(|found| !is_within(&found.bodies, farthest));
    let best = found.into_iter().next();
    let best = best.ok_or(SuperquadricFitError::NoVolume)?;
    let best = turned_parts(best, &few, farthest, context)?;
    let weighing = weighed(&best.bodies, &cloud.points, &best.weighing);
    Ok(descended(
        best.bodies,
        &cloud.points,
        weighing,
        STAGE,
        context,
    )?)
}

/// The best fit with its parts turned, one at a time, as long as that is better: like [one body](super::search) a part may lie
/// along another of its axes, or be seen along its diagonals.
fn turned_parts(
    best: Minimum,
    points: &[Vector3<f64>],
    farthest: f64,
    context: &Context<'_>,
) -> Result<Minimum, Cancelled> {
    let weighing = weighed(&best.bodies, points, &best.weighing);
    let mut best = descended(best.bodies, points, weighing, LAST, context)?;
    for _ in 0..MAX_TURNS {
        if Residuals::of(distances(&best.bodies, points)).rms < EXACT {
            break;
        }
        let mut tried = Vec::new();
        for part in 0..best.bodies.len() {
            for start in turned(&best.bodies[part]) {
                let mut bodies = best.bodies.clone();
                bodies[part] = start;
                let weighing = weighed(&bodies, points, &best.weighing);
                let found = descended(bodies, points, weighing, TURNED, context)?;
                tried.extend(Some(found).filter(|found| is_within(&found.bodies, farthest)));
            }
        }
        let Some(at) = least(&tried, points) else {
            break;
        };
        let both = [best, tried.swap_remove(at)];
        let losses = losses(&both, points);
        let [own, other] = both;
        // Points tell nothing of the ends of parts in one another: turned ones may fit as well.
        if losses[1] > WORTH * losses[0] {
            return Ok(own);
        }
        best = descended(other.bodies, points, other.weighing, STAGE, context)?;
    }
    Ok(best)
}

/// The union about the centre of the cloud, or where that is outside about that of the largest part.
fn told(
    cloud: &Cloud,
    found: &Minimum,
    held_out: Vec<f64>,
) -> Result<MultiFit, SuperquadricFitError> {
    let placed = found
        .bodies
        .iter()
        .map(|body| body.told(cloud.size, &cloud.centre));
    let placed = placed.collect::<Result<Vec<_>, _>>()?;
    let about = |centre: Point3<f64>| {
        let frame = Frame {
            centre,
            axes: cloud.axes,
        };
        let parts = placed.iter().map(|(shape, own)| Part {
            shape: *shape,
            frame: Frame {
                centre: frame.to_local(&own.centre).into(),
                axes: frame.axes.tr_mul(&own.axes),
            },
        });
        Ok((MultiSuperquadric::new(parts.collect())?, frame))
    };
    let product = |(shape, _): &&(crate::model::Superquadric, Frame)| {
        shape.semi_axes().as_flattened().iter().product::<f64>()
    };
    let largest_part = placed
        .iter()
        .max_by(|p, q| product(p).total_cmp(&product(q)));
    let (union, frame) = about(cloud.centre).or_else(|outside: SuperquadricFitError| {
        largest_part.map_or(Err(outside), |(_, own)| about(own.centre))
    })?;
    let distances = distances(&found.bodies, &cloud.points);
    let errors = standard_errors(cloud, found, covariance(cloud, found).as_ref());
    Ok(MultiFit {
        residuals: Residuals::of(distances.iter().map(|d| d * cloud.size)),
        mean_radius: cloud.size,
        union,
        frame,
        errors,
        held_out,
    })
}
