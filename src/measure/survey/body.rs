//! A body at unit size.

use super::{Scheme, SurveyError};
use crate::Mesh;
use crate::measure::scale::Scale;
use crate::measure::{
    MassProperties, ScannedBody, SolidProperties, four_triangles, grain_properties,
    mesh_properties, solid_properties,
};
use crate::model::{Grain, LocalError, Radial, StarSurface, Surface};
use crate::sphere::cube_grid;
use nalgebra::Vector3;

/// Parts per angle of the source's grid.
const PUBLISHED_GRID: usize = 128;

/// What is integrated over a body.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Measured {
    pub(super) properties: MassProperties,
    /// Of a grain with a radius, its mean over all directions from the grain's centre.
    pub(super) mean_radius: Option<f64>,
}

#[derive(Clone)]
pub(super) enum Body<'a> {
    Grain(Box<Grain>, Scheme),
    /// A surface whose area, volume and moments are known.
    Known(Radial<'a, dyn StarSurface + 'a>, MassProperties),
    Mesh(Mesh, Inside),
}

/// What a mesh encloses.
#[derive(Clone)]
pub(super) enum Inside {
    /// One body, or several.
    Bodies(usize),
    /// Nothing that can be told.
    Unknown(SurveyError),
}

impl<'a> Body<'a> {
    pub(super) fn grain(grain: &Grain, scheme: Scheme) -> (Self, Scale) {
        let (directions, _) = cube_grid(2);
        let places = grain.places(&directions).into_iter();
        let size = places.map(|place| place.norm()).fold(0.0, f64::max);
        let scale = Scale::new(size, grain.frame().centre);
        let resized = Box::new(grain.about_origin(1.0 / scale.length));
        (Self::Grain(resized, scheme), scale)
    }

    pub(super) fn mesh(mesh: &Mesh, inside: Inside) -> (Self, Scale) {
        let scale = Scale::of(mesh);
        (Self::Mesh(scale.mesh(mesh), inside), scale)
    }

    pub(super) fn scanned(scanned: &ScannedBody) -> (Self, Scale) {
        let inside = match scanned.defect {
            Some(defect) => Inside::Unknown(defect.into()),
            None => Inside::Bodies(scanned.bodies),
        };
        Self::mesh(&scanned.mesh, inside)
    }

    /// Area, volume and moments of a union of superquadrics, and how well they are known; `None` of all else.
    pub(super) fn union(&self) -> Option<SolidProperties> {
        match self {
            Self::Grain(grain, Scheme::Exact) => grain.superquadric().map(solid_properties),
            _ => None,
        }
    }

    /// Whether no centre sees all of it: a union of superquadrics.
    pub(super) fn has_hidden(&self) -> bool {
        matches!(self, Self::Grain(grain, _) if grain.hidden_share() > 0.0)
    }

    /// Area, volume, centroid and inertia; those of a union are known.
    pub(super) fn measured(
        &self,
        union: Option<&SolidProperties>,
    ) -> Result<Measured, SurveyError> {
        let mut mean_radius = None;
        let found = match (self, union) {
            (_, Some(solid)) => solid.properties,
            (Self::Grain(grain, Scheme::Exact), _) => {
                let found = grain_properties(grain.as_ref());
                mean_radius = grain.star().map(|_| found.mean_radius);
                found.properties
            }
            (Self::Grain(grain, Scheme::FourTriangles), _) => {
                let star = grain.star().ok_or(SurveyError::NoRadius)?;
                four_triangles(star, PUBLISHED_GRID, PUBLISHED_GRID)
            }
            (Self::Known(_, properties), _) => {
                return Ok(Measured {
                    properties: *properties,
                    mean_radius,
                });
            }
            (Self::Mesh(_, Inside::Unknown(error)), _) => return Err(error.clone()),
            (Self::Mesh(mesh, _), _) => mesh_properties(mesh)?,
        };
        let figures = found.inertia.iter().chain(found.centroid.iter());
        let is_finite = found.area.is_finite() && figures.copied().all(f64::is_finite);
        // Written so that NaN fails.
        if !(is_finite && found.area > 0.0 && found.volume > Scale::LEAST_VOLUME) {
            return Err(SurveyError::NotSolid);
        }
        Ok(Measured {
            properties: found,
            mean_radius,
        })
    }

    /// How many bodies there are; `None` where that cannot be told.
    pub(super) fn count(&self) -> Result<usize, SurveyError> {
        match self {
            Self::Grain(..) | Self::Known(..) => Ok(1),
            Self::Mesh(_, Inside::Bodies(bodies)) => Ok(*bodies),
            Self::Mesh(_, Inside::Unknown(error)) => Err(error.clone()),
        }
    }

    /// Standard errors of the surface in a direction, where they are known.
    pub(super) fn local_error(&self, n: &Vector3<f64>) -> Option<LocalError> {
        match self {
            Self::Grain(grain, _) => grain.local_error(n),
            Self::Known(..) | Self::Mesh(..) => None,
        }
    }

    /// The surface, if it has a formula over directions.
    ///
    /// # Errors
    /// Of a mesh, and of a union that no centre sees whole.
    pub(super) fn surface(&self) -> Result<&dyn Surface, SurveyError> {
        match self {
            Self::Grain(grain, _) => match grain.hidden_share() {
                0.0 => Ok(grain.as_ref()),
                share => Err(SurveyError::Hidden { share }),
            },
            Self::Known(surface, _) => Ok(surface),
            Self::Mesh(..) => Err(SurveyError::Flat),
        }
    }
}
