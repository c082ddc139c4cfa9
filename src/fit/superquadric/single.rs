//! One superquadric.

use super::bodies::Body;
use super::cloud::Cloud;
use super::error::SuperquadricFitError;
use super::form::Form;
use super::least_squares::{End, Minimum, descended, deviation, least, minimised, weighed};
use super::normal_equations::{Reach, Weighing, distances};
use super::standard_errors::{ParameterErrors, standard_errors};
use crate::fit::Residuals;
use crate::fit::context::Context;
use crate::model::{Frame, Grain, InvalidGrain, Superquadric, SuperquadricGrain};
use nalgebra::{Matrix3, Point3, Vector3};

/// How long fits go on with few points, and with all of them.
const ROUGH: End = End {
    steps: 20,
    gain: 1e-4,
};
const FINE: End = End {
    steps: 40,
    gain: 1e-5,
};

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
/// The fit begins with the second moments of the points, in the three orders of axes that make different bodies, and
/// keeps the best. The result does not depend on where the points lie, how they are turned or scaled.
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
    let wide = best_within(cloud, few, form, Reach::Wide, context)?;
    let nearness = deviation(&wide.bodies, few);
    let start = match nearness < NEAR {
        true => wide,
        false => {
            let narrow = best_within(cloud, few, form, Reach::Narrow, context)?;
            match deviation(&narrow.bodies, few) < MUCH_NEARER * nearness {
                true => narrow,
                false => wide,
            }
        }
    };
    let weighing = weighed(&start.bodies, &cloud.points, &start.weighing);
    let mut found = descended(start.bodies, &cloud.points, weighing, FINE, context)?;
    found.iterations += start.iterations;
    Ok(found)
}

/// The best of all starts with one reach of the loss.
fn best_within(
    cloud: &Cloud,
    points: &[Vector3<f64>],
    form: Form,
    reach: Reach,
    context: &Context<'_>,
) -> Result<Minimum, SuperquadricFitError> {
    let like = Weighing {
        form,
        reach,
        scale: 1.0,
        prior: 0.0,
        sharpness: 1.0,
    };
    let tried = starts(cloud)
        .map(|start| minimised(vec![start], points, &like, ROUGH, context))
        .collect::<Result<Vec<_>, _>>()?;
    let iterations = tried.iter().map(|found| found.iterations).sum();
    let best = least(tried, points).ok_or(SuperquadricFitError::NoVolume)?;
    Ok(Minimum { iterations, ..best })
}

/// The ellipsoid of equal second moments in three orders of axes.
fn starts(cloud: &Cloud) -> impl Iterator<Item = Body> {
    [[0, 1, 2], [1, 2, 0], [2, 0, 1]].into_iter().map(|order| {
        let axes = order.map(|i| cloud.axes.column(i).into_owned());
        let semi_axes = Vector3::from(order.map(|i| cloud.deviations[i] * PER_DEVIATION));
        Body::start(Vector3::zeros(), Matrix3::from_columns(&axes), semi_axes)
    })
}
