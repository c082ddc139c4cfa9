//! One superquadric.

use super::bodies::Body;
use super::cloud::Cloud;
use super::error::SuperquadricFitError;
use super::form::Form;
use super::least_squares::{End, Minimum, descended, deviation, least, minimised, ranked, weighed};
use super::normal_equations::{Reach, Weighing, distances};
use super::standard_errors::{ParameterErrors, standard_errors};
use crate::fit::Residuals;
use crate::fit::context::{Cancelled, Context};
use crate::model::{Frame, Grain, InvalidGrain, Superquadric, SuperquadricGrain};
use nalgebra::{Matrix3, Point3, Vector3};

/// How long fits go on from a first guess, and after that.
const ROUGH: End = End {
    steps: 20,
    gain: 1e-4,
};
const FINE: End = End {
    steps: 60,
    gain: 1e-6,
};

/// The logarithm by which a body that leans is longer to one side, and shorter to the other.
const LEAN: f64 = 0.3;

/// How many times the least loss of few points may be the least of all points, and by how much more it is another minimum.
const NEARLY_BEST: f64 = 1.03;
const SAME_MINIMUM: f64 = 1.0 + 1e-3;

/// Half the points this near, in mean radii, are of the body.
const NEAR: f64 = 0.01;

/// How much nearer half the points come where others are astray.
const MUCH_NEARER: f64 = 0.35;

/// The semi-axis over the standard deviation of points on a sphere.
const PER_DEVIATION: f64 = 1.732_050_807_568_877_2;

/// A superquadric fitted to points.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct SuperquadricFit {
    /// The body.
    pub shape: Superquadric,
    /// Its centre and axes in the scan.
    pub frame: Frame,
    /// Radial distances of all points.
    pub residuals: Residuals,
    /// Mean distance of the points from their mean, in the scan's unit.
    pub mean_radius: f64,
    /// Standard errors.
    pub errors: ParameterErrors,
    /// Steps of all starts.
    pub iterations: usize,
}

impl SuperquadricFit {
    /// The body as a grain.
    ///
    /// # Errors
    /// [`InvalidGrain`] if the frame was changed and is none.
    pub fn grain(&self) -> Result<Grain, InvalidGrain> {
        Ok(SuperquadricGrain::single(self.frame, self.shape)?.into())
    }
}

/// Fits a superquadric to points of its surface, some of which may be astray.
///
/// The fit begins with the second moments of the points, in the three orders of axes that make different bodies, and, of
/// octants that differ, with the best of these leaning to all sides; it keeps the best. The result does not depend on where
/// the points lie, how they are turned or scaled.
///
/// # Errors
/// [`SuperquadricFitError`] if there are too few points, or they enclose no volume.
pub fn fit_superquadric(
    points: &[Point3<f64>],
    form: Form,
    context: &Context<'_>,
) -> Result<SuperquadricFit, SuperquadricFitError> {
    let cloud = Cloud::new(points, form.parameters())?;
    let found = context.run(|| best(&cloud, form, context))?;
    let distances = distances(&found.bodies, &cloud.points);
    let (shape, frame) = found.bodies[0].told(cloud.size, &cloud.centre)?;
    Ok(SuperquadricFit {
        shape,
        frame,
        residuals: Residuals::of(distances.iter().map(|d| d * cloud.size)),
        mean_radius: cloud.size,
        errors: standard_errors(&cloud, &found)[0],
        iterations: found.iterations,
    })
}

/// The best of all starts, by nearly least squares unless a narrow loss brings half the points much nearer: then many
/// are astray.
pub(super) fn best(
    cloud: &Cloud,
    form: Form,
    context: &Context<'_>,
) -> Result<Minimum, SuperquadricFitError> {
    let few = cloud.thinned();
    let few = if few.len() < 3 * form.parameters() {
        &cloud.points
    } else {
        &few
    };
    let mut tried = starts_tried(cloud, few, form, Reach::Wide, context)?;
    let nearness = |tried: &[Minimum]| match least(tried.to_vec(), few) {
        Some(best) => Ok(deviation(&best.bodies, few)),
        None => Err(SuperquadricFitError::NoVolume),
    };
    let wide = nearness(&tried)?;
    if wide >= NEAR {
        let narrow = starts_tried(cloud, few, form, Reach::Narrow, context)?;
        if nearness(&narrow)? < MUCH_NEARER * wide {
            tried = narrow;
        }
    }
    for found in &mut tried {
        let before = found.iterations;
        *found = descended(found.bodies.clone(), few, found.weighing, FINE, context)?;
        found.iterations += before;
    }
    if form != Form::Single
        && let Some(best) = least(tried.clone(), few)
    {
        for start in leaning(&best.bodies[0]) {
            tried.push(minimised(vec![start], few, &best.weighing, FINE, context)?);
        }
    }
    let iterations: usize = tried.iter().map(|found| found.iterations).sum();
    let mut nearly_best = distinct(ranked(tried, few));
    if form == Form::Single {
        // Few points tell the best of three orders of axes.
        nearly_best.truncate(1);
    }
    let finer = nearly_best.into_iter().map(|start| {
        let weighing = weighed(&start.bodies, &cloud.points, &start.weighing);
        descended(start.bodies, &cloud.points, weighing, FINE, context)
    });
    let finer = finer.collect::<Result<Vec<_>, _>>()?;
    let found = least(finer, &cloud.points).ok_or(SuperquadricFitError::NoVolume)?;
    Ok(Minimum {
        iterations: iterations + found.iterations,
        ..found
    })
}

/// Of fits in the order of their losses those that may be the best with all points, each minimum once.
fn distinct(ranked: Vec<(f64, Minimum)>) -> Vec<Minimum> {
    let least = ranked.first().map_or(0.0, |(loss, _)| *loss);
    let mut before = f64::NEG_INFINITY;
    let mut found = Vec::new();
    for (loss, minimum) in ranked {
        if loss > NEARLY_BEST * least {
            break;
        }
        if loss > SAME_MINIMUM * before {
            found.push(minimum);
        }
        before = loss;
    }
    found
}

/// A body that leans to one side along each of its axes, in all ways: a body that is nearly alike on both sides may be a
/// saddle, which fits leave to whichever side rounding has it.
fn leaning(body: &Body) -> impl Iterator<Item = Body> {
    (0..8).map(|way| {
        let mut leaning = *body;
        for axis in 0..3 {
            let lean = if way >> axis & 1 == 0 { LEAN } else { -LEAN };
            let sides = [2 * axis, 2 * axis + 1];
            let width = |body: &Body| sides.map(|side| body.logs[side].exp());
            let [positive, negative] = width(body);
            let middle = (0.5 * (positive + negative)).ln();
            leaning.logs[sides[0]] = middle + lean;
            leaning.logs[sides[1]] = middle - lean;
            let [longer, shorter] = width(&leaning);
            let aside = 0.5 * ((positive - negative) - (longer - shorter));
            leaning.centre += body.axes.column(axis) * aside;
        }
        leaning
    })
}

/// The fits of all starts with one reach of the loss.
fn starts_tried(
    cloud: &Cloud,
    points: &[Vector3<f64>],
    form: Form,
    reach: Reach,
    context: &Context<'_>,
) -> Result<Vec<Minimum>, Cancelled> {
    let like = Weighing {
        form,
        reach,
        scale: 1.0,
        prior: 0.0,
        sharpness: 1.0,
    };
    starts(cloud)
        .map(|start| minimised(vec![start], points, &like, ROUGH, context))
        .collect()
}

/// The ellipsoid of equal second moments in three orders of axes.
fn starts(cloud: &Cloud) -> impl Iterator<Item = Body> {
    [[0, 1, 2], [1, 2, 0], [2, 0, 1]].into_iter().map(|order| {
        let axes = order.map(|i| cloud.axes.column(i).into_owned());
        let semi_axes = Vector3::from(order.map(|i| cloud.deviations[i] * PER_DEVIATION));
        Body::start(Vector3::zeros(), Matrix3::from_columns(&axes), semi_axes)
    })
}
