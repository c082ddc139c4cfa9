//! Of dense faces functions are chosen, and places on the sphere found, by some of the vertices; then they are fitted to all.

use super::cloud::Cloud;
use super::functions::Functions;
use super::local_faces::LocalFaces;
use super::map::{Coarse, MapError, SphericalMap};
use super::rounds::{Fitted, Problem};
use super::voxels::Hidden;
use crate::fit::context::Context;
use crate::fit::error::FitError;
use crate::sphere::CubeCell;
use nalgebra::Vector3;
use std::f64::consts::PI;

/// By how much farther off than all vertices those may be that a mesh is reduced to, for what stands out stays: of a barley kernel
/// of 219 519 noisy vertices by 1.26.
const MOST_STANDING_OUT: f64 = 1.5;

/// Samples per function: places inside large triangles are added until there are as many. With three, surfaces bulge
/// between the 1538 points of a kernel by up to 11 % of the radius.
const SAMPLES_PER_FUNCTION: f64 = 8.0;

/// Whether so many coefficients that may come so near are worth more work.
pub(super) type IsWorth<'a> = &'a (dyn Fn(usize, f64) -> bool + Sync);

/// The faces of a scan, with few of their vertices or with all.
pub(super) struct Levels<'a> {
    local: &'a LocalFaces,
    map: SphericalMap<'a>,
}

/// Some of the vertices, and the mesh of them, or all; with places on the sphere.
pub(super) enum Level {
    Part(Coarse),
    All(Vec<Vector3<f64>>),
}

impl Level {
    /// How many times nearer all vertices may be than those of this level.
    pub(super) fn most_standing_out(&self) -> f64 {
        match self {
            Self::Part(_) => MOST_STANDING_OUT,
            Self::All(_) => 1.0,
        }
    }
}

/// A surface and what it was fitted to.
pub(super) struct Found {
    pub(super) fitted: Fitted,
    /// Samples of the scan.
    pub(super) scanned: usize,
    pub(super) points: Vec<Vector3<f64>>,
    pub(super) normals: Vec<Vector3<f64>>,
    /// Mean squares of the move of the surface at these that voxels hide.
    pub(super) hidden: Vec<f64>,
}

impl<'a> Levels<'a> {
    /// # Errors
    /// As [`SphericalMap::new`].
    pub(super) fn new(local: &'a LocalFaces, context: &Context<'_>) -> Result<Self, MapError> {
        let map = SphericalMap::new(&local.mesh, context)?;
        Ok(Self { local, map })
    }

    /// So many of the vertices of faces that have more than twice as many, else all. No fewer than before.
    ///
    /// # Errors
    /// As [`SphericalMap::whole`].
    pub(super) fn level(
        &mut self,
        vertices: usize,
        context: &Context<'_>,
    ) -> Result<Level, MapError> {
        Ok(
            match self.local.mesh.vertices.len() > 2 * vertices && !self.local.are_of_points() {
                true => Level::Part(self.map.coarse(vertices, context)?),
                false => Level::All(self.map.whole(context)?),
            },
        )
    }

    /// The samples at a level.
    pub(super) fn cloud<'b>(&self, level: &'b Level) -> Cloud<'b>
    where
        'a: 'b,
    {
        match level {
            Level::Part(coarse) => self.local.coarse_cloud(coarse),
            Level::All(places) => self.local.cloud(places.clone()),
        }
    }

    /// Fits functions to the samples of a level from where they are on the sphere, and then to all. `None` if they do not determine a
    /// surface, or if it `is_worth` nothing.
    ///
    /// # Errors
    /// [`FitError`] if there is no map, or if the work is cancelled.
    pub(super) fn fit(
        &self,
        level: &Level,
        cloud: &mut Cloud<'_>,
        functions: &Functions,
        is_worth: IsWorth<'_>,
        context: &Context<'_>,
    ) -> Result<Option<Found>, FitError> {
        let problem = Problem::new(functions);
        let is_worth = |rms: f64| is_worth(3 * functions.count(), rms);
        if let Level::All(_) = level {
            let fitted = problem.run(cloud, &is_worth, context)?;
            return Ok(fitted.map(|fitted| Found::new(fitted, cloud)));
        }
        let may_be_worth = |rms: f64| is_worth(rms / level.most_standing_out());
        let Some(fitted) = problem.run(cloud, &may_be_worth, context)? else {
            return Ok(None);
        };
        if fitted.is_hopeless {
            return Ok(Some(Found::new(fitted, cloud)));
        }
        let places = match self.map.between(cloud.vertex_directions(), context) {
            // Faces that became all but flat when directions moved leave no place for what is between them.
            Err(MapError::NoKernel { .. } | MapError::NotOneToOne { .. }) => {
                self.map.clone().whole(context)?
            }
            places => places?,
        };
        let mut all = self.local.cloud(places);
        restart(&mut all, functions);
        let fitted = problem.run(&mut all, &is_worth, context)?;
        Ok(fitted.map(|fitted| Found::new(fitted, &all)))
    }
}

impl Found {
    fn new(fitted: Fitted, cloud: &Cloud<'_>) -> Self {
        let samples = cloud.points.iter().zip(&cloud.normals);
        let square = |(point, normal)| {
            let hidden: Option<&Hidden> = fitted.hidden.as_ref();
            hidden.map_or(0.0, |hidden| hidden.square(point, normal))
        };
        Self {
            hidden: samples.map(square).collect(),
            fitted,
            scanned: cloud.scanned(),
            points: cloud.points.clone(),
            normals: cloud.normals.clone(),
        }
    }
}

/// Starts from the map, with enough samples in every cell.
pub(super) fn restart(cloud: &mut Cloud<'_>, functions: &Functions) {
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
pub(super) fn home(functions: &Functions, n: &Vector3<f64>) -> usize {
    let Some(cover) = functions.cover() else {
        return 0;
    };
    let mut shares = Vec::new();
    cover.shares(n, &mut shares);
    let most = shares.iter().max_by(|one, other| one.1.total_cmp(&other.1));
    most.map_or(0, |&(cell, _)| cell.into())
}
