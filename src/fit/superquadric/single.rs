//! One superquadric.

use super::cloud::Cloud;
use super::error::SuperquadricFitError;
use super::form::Form;
use super::normal_equations::distances;
use super::search::best;
use super::solid_errors::{SolidErrors, solid_errors};
use super::standard_errors::{ParameterErrors, covariance, standard_errors};
use crate::fit::Residuals;
use crate::fit::context::Context;
use crate::model::{Frame, Grain, InvalidGrain, NoInterval, Superquadric, SuperquadricGrain};
use crate::scan::VoxelLattice;
use nalgebra::Point3;

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
    /// Standard errors of area and volume, where the points determine the numbers.
    pub solid_errors: Option<SolidErrors>,
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
        Ok(grain.with_standard_errors(Err(NoInterval::NotEstimated)))
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
        let distances = distances(&found.bodies, &cloud.points);
        let covariance = covariance(&cloud, &found);
        let solid = |covariance| solid_errors(&found.bodies[0], form, cloud.size, covariance);
        let (shape, frame) = found.bodies[0].told(cloud.size, &cloud.centre)?;
        Ok(SuperquadricFit {
            shape,
            frame,
            residuals: Residuals::of(distances.iter().map(|d| d * cloud.size)),
            mean_radius: cloud.size,
            errors: standard_errors(&cloud, &found, covariance.as_ref())[0],
            solid_errors: covariance.as_ref().and_then(solid),
            iterations: found.iterations,
        })
    })
}
