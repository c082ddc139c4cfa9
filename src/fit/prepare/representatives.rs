//! The triangulation of a large cloud by representatives of its points, and which points stand apart.
//!
//! A bin of directions with a few points does not tell which of them stands apart; neighbours of its representative do.

use super::by_direction::one_surface;
use super::middle::middle;
use super::strays::LEAST_STRAY;
use super::thin::{Thinned, select, thin};
use crate::fit::error::FitError;
use crate::mesh::Mesh;
use nalgebra::{Matrix3, Point3};

/// Representatives of a cloud.
pub(super) struct Representatives {
    pub(super) mesh: Mesh,
    pub(super) points: Vec<Point3<f64>>,
    /// Indices of those that stand apart from their neighbours and that few points of their bin are near, and of these; sorted.
    pub(super) apart: Vec<usize>,
    /// Indices of points that stand apart from the representative of their bin, sorted.
    pub(super) strays: Vec<usize>,
}

impl Representatives {
    /// Finds those of `cloud`, which is binned after a linear `map`.
    ///
    /// # Errors
    /// [`FitError`] if they form no surface round a centre.
    pub(super) fn new(cloud: &[Point3<f64>], map: &Matrix3<f64>) -> Result<Self, FitError> {
        let centre = middle(cloud);
        let Thinned {
            representatives,
            may_be_strays,
            strays,
        } = thin(cloud, &centre, map, LEAST_STRAY);
        let points = select(cloud, &representatives);
        let (mesh, apart) = one_surface(&points, &centre)?;
        let strays_too = apart.into_iter().flat_map(|at| &may_be_strays[at as usize]);
        let mut apart: Vec<usize> = strays_too.map(|&at| at as usize).collect();
        apart.sort_unstable();
        Ok(Self {
            mesh,
            points,
            apart,
            strays: strays.into_iter().map(|at| at as usize).collect(),
        })
    }
}
