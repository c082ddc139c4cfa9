//! One superquadric.

use super::bodies::Body;
use super::cloud::Cloud;
use super::error::SuperquadricFitError;
use super::form::Form;
use super::least_squares::{Minimum, minimised};
use super::normal_equations::distances;
use super::search::{FINE, best};
use super::solid_errors::{SolidErrors, solid_errors};
use super::standard_errors::{ParameterErrors, covariance, standard_errors};
use super::strays::strays;
use crate::fit::Residuals;
use crate::fit::context::Context;
use crate::model::{Frame, Grain, InvalidGrain, NoStandardErrors, Superquadric, SuperquadricGrain};
use crate::scan::VoxelLattice;
use nalgebra::Point3;
use std::borrow::Cow;

/// Rounds of leaving out points that are astray.
const ROUNDS: usize = 5;

/// A superquadric fitted to points.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct SuperquadricFit {
    /// The body.
    pub shape: Superquadric,
    /// Its centre and axes in the scan.
    pub frame: Frame,
    /// Radial distances of the points that were not left out.
    pub residuals: Residuals,
    /// Mean distance of the points from their mean, in the scan's unit.
    pub mean_radius: f64,
    /// Standard errors.
    pub errors: ParameterErrors,
    /// Standard errors of area and volume, where the points determine the numbers.
    pub solid_errors: Option<SolidErrors>,
    /// Points that were left out, for they are far from the body and from what their neighbours are off it.
    pub strays: usize,
    /// Steps of all starts.
    pub iterations: usize,
}

impl SuperquadricFit {
    /// The body as a grain, without standard errors of its area, volume and so on.
    ///
    /// # Errors
    /// [`InvalidGrain`] if the frame was changed and is none.
    pub fn grain(&self) -> Result<Grain, InvalidGrain> {
        let grain: Grain = SuperquadricGrain::single(self.frame, self.shape)?.into();
        Ok(grain.with_standard_errors(Err(NoStandardErrors::NotEstimated)))
    }
}

/// Fits a superquadric to points of its surface, some of which may be astray.
///
/// The fit begins with the second moments of the points, in the three orders of axes that make different bodies, goes on
/// with the best of these turned and, of octants that differ, leaning to all sides, and keeps the best. The result does
/// not depend on where the points lie, how they are turned or scaled. `lattice`: of points between voxels, where these
/// lie ([`Scan::voxel_lattice`](crate::Scan::voxel_lattice)): standard errors then hold what their steps hide.
///
/// # Errors
/// [`SuperquadricFitError`] if there are too few points, or they enclose no volume.
pub fn fit_superquadric(
    points: &[Point3<f64>],
    lattice: Option<&VoxelLattice>,
    form: Form,
    context: &Context<'_>,
) -> Result<SuperquadricFit, SuperquadricFitError> {
    let cloud = Cloud::new(points, lattice, form.parameters())?;
    context.run(|| {
        let found = best(&cloud, form, context)?;
        let (kept, mut found) = without_strays(&cloud, found, context)?;
        if form == Form::Single {
            found.bodies = found.bodies.into_iter().map(Body::in_order).collect();
        }
        let distances = distances(&found.bodies, &kept.points);
        let covariance = covariance(&kept, &found);
        let solid = |covariance| solid_errors(&found.bodies[0], form, cloud.size, covariance);
        let (shape, frame) = found.bodies[0].told(cloud.size, &cloud.centre)?;
        Ok(SuperquadricFit {
            shape,
            frame,
            residuals: Residuals::of(distances.iter().map(|d| d * cloud.size)),
            mean_radius: cloud.size,
            errors: standard_errors(&kept, &found, covariance.as_ref())[0],
            solid_errors: covariance.as_ref().and_then(solid),
            strays: cloud.points.len() - kept.points.len(),
            iterations: found.iterations,
        })
    })
}

/// Leaves out points that are [astray](strays) and fits to the others, until there are none.
fn without_strays<'a>(
    cloud: &'a Cloud,
    mut found: Minimum,
    context: &Context<'_>,
) -> Result<(Cow<'a, Cloud>, Minimum), SuperquadricFitError> {
    let mut kept = Cow::Borrowed(cloud);
    for _ in 0..ROUNDS {
        let Some(astray) = strays(&kept, &found.bodies) else {
            break;
        };
        kept = Cow::Owned(kept.without(&astray));
        let again = minimised(found.bodies, &kept.points, &found.weighing, FINE, context)?;
        found = Minimum {
            iterations: found.iterations + again.iterations,
            ..again
        };
    }
    Ok((kept, found))
}
