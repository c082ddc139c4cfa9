//! A body under measurement.

use super::angularity::angularity;
use super::elements::{Element, mesh_elements, surface_elements};
use super::nodes::{Integrand, grain_nodes, octant_nodes};
use super::{
    Ball, Convexity, CurvatureStatistics, EnclosingBallError, EquivalentEllipsoid, Form, HullError,
    InscribedBallError, MassProperties, MeshIntegralError, OrientedBox, Outline, PrincipalInertia,
    ProjectionError, Spectrum, Sphericity, convex_hull, enclosing_ball, extents, four_triangles,
    grain_properties, inscribed_ball, mesh_properties, minimum_box, project, support,
};
use crate::Mesh;
use crate::model::{Grain, StarSurface};
use crate::shapes::Solid;
use nalgebra::{Matrix3, Vector3};
use std::cell::OnceCell;
use thiserror::Error;

/// Cells per edge of the cube of directions on which a grain's hull, spheres and outlines are found:
/// 24 578 vertices. They lie on the surface, and what is between them is cut off by at most 1e-4 of
/// the radius of curvature.
const RESOLUTION: usize = 64;

/// A body, and what has been measured of it: each figure is computed when it is first asked for, and
/// what others need is shared.
///
/// Area, volume and moments of a grain are those of its formulas ([`grain_properties`]), its dimensions
/// are found to rounding; convexity, the minimum box, spheres and outlines are those of a mesh of it,
/// good to 1e-4. Of a mesh, everything is that of the polyhedron.
pub struct Survey<'a> {
    body: Body<'a>,
    properties: OnceCell<MassProperties>,
    dimensions: OnceCell<Result<Vector3<f64>, SurveyError>>,
    mesh: OnceCell<Mesh>,
    hull: OnceCell<Result<Mesh, SurveyError>>,
    elements: OnceCell<Vec<Element>>,
    inscribed: OnceCell<Result<Ball, SurveyError>>,
    enclosing: OnceCell<Result<Ball, SurveyError>>,
    curvature: OnceCell<CurvatureStatistics>,
}

enum Body<'a> {
    Grain(&'a Grain, Scheme),
    Solid(&'a dyn Solid),
    Mesh(&'a Mesh, MassProperties),
}

/// How area, volume and moments of a grain are integrated.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub enum Scheme {
    /// Gauss quadrature of the formulas, see [`grain_properties`].
    #[default]
    Exact,
    /// The source's polyhedron on a 128 x 128 grid of angles, see [`four_triangles`]: to reproduce
    /// published figures.
    FourTriangles,
}

/// Parts per angle of the source's grid.
const PUBLISHED_GRID: usize = 128;

/// Why something cannot be measured.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum SurveyError {
    /// The points have no convex hull.
    #[error(transparent)]
    Hull(#[from] HullError),
    /// The mesh, or the hull, encloses nothing.
    #[error(transparent)]
    Mesh(#[from] MeshIntegralError),
    /// The points have no enclosing sphere.
    #[error(transparent)]
    Enclosing(#[from] EnclosingBallError),
    /// There is no inscribed sphere.
    #[error(transparent)]
    Inscribed(#[from] InscribedBallError),
    /// The body has no outline.
    #[error(transparent)]
    Projection(#[from] ProjectionError),
    /// The second moments are not those of a solid: an open or inside-out mesh.
    #[error("its moments are not those of a solid")]
    NotSolid,
    /// Triangles have no curvature.
    #[error("triangles have no curvature: fit the scan, and measure the model")]
    Flat,
}

impl<'a> Survey<'a> {
    /// Of a fitted grain.
    pub fn of_grain(grain: &'a Grain, scheme: Scheme) -> Self {
        Self::new(Body::Grain(grain, scheme))
    }

    /// Of a closed-form body, in its own frame; area, volume and moments are those that it knows.
    pub fn of_solid(solid: &'a dyn Solid) -> Self {
        Self::new(Body::Solid(solid))
    }

    /// Of a closed mesh, wound counter-clockwise from outside.
    ///
    /// # Errors
    ///
    /// When it is broken or encloses no volume.
    pub fn of_mesh(mesh: &'a Mesh) -> Result<Self, MeshIntegralError> {
        Ok(Self::new(Body::Mesh(mesh, mesh_properties(mesh)?)))
    }

    fn new(body: Body<'a>) -> Self {
        Self {
            body,
            properties: OnceCell::new(),
            dimensions: OnceCell::new(),
            mesh: OnceCell::new(),
            hull: OnceCell::new(),
            elements: OnceCell::new(),
            inscribed: OnceCell::new(),
            enclosing: OnceCell::new(),
            curvature: OnceCell::new(),
        }
    }

    /// Area, volume, centroid and inertia.
    pub fn properties(&self) -> &MassProperties {
        self.properties.get_or_init(|| match self.body {
            Body::Grain(grain, Scheme::Exact) => grain_properties(grain).properties,
            Body::Grain(grain, Scheme::FourTriangles) => {
                let from_centre = four_triangles(grain, PUBLISHED_GRID, PUBLISHED_GRID);
                MassProperties {
                    centroid: grain.frame().centre + from_centre.centroid.coords,
                    ..from_centre
                }
            }
            Body::Solid(solid) => solid.integrals().properties,
            Body::Mesh(_, properties) => properties,
        })
    }

    /// Principal moments and axes of inertia.
    ///
    /// # Errors
    ///
    /// [`SurveyError::NotSolid`].
    pub fn principal(&self) -> Result<PrincipalInertia, SurveyError> {
        self.properties().principal().ok_or(SurveyError::NotSolid)
    }

    /// Extents along the principal axes, in the order of the moments: as a rule length, width,
    /// thickness.
    ///
    /// # Errors
    ///
    /// [`SurveyError::NotSolid`].
    pub fn dimensions(&self) -> Result<Vector3<f64>, SurveyError> {
        let dimensions = || Ok(self.extents_along(&self.principal()?.axes));
        self.dimensions.get_or_init(dimensions).clone()
    }

    /// The box of least volume.
    ///
    /// # Errors
    ///
    /// When there is no convex hull.
    pub fn minimum_box(&self) -> Result<OrientedBox, SurveyError> {
        Ok(minimum_box(self.hull()?)?)
    }

    /// Ratios of the dimensions along the principal axes.
    ///
    /// # Errors
    ///
    /// As [`Self::dimensions`].
    pub fn form(&self) -> Result<Form, SurveyError> {
        Ok(Form::new(&self.dimensions()?))
    }

    /// The largest inscribed sphere.
    ///
    /// # Errors
    ///
    /// When there is no surface, or nothing is inside.
    pub fn inscribed(&self) -> Result<Ball, SurveyError> {
        let ball = || Ok(inscribed_ball(self.mesh())?);
        self.inscribed.get_or_init(ball).clone()
    }

    /// The smallest enclosing sphere.
    ///
    /// # Errors
    ///
    /// When there is no convex hull.
    pub fn enclosing(&self) -> Result<Ball, SurveyError> {
        let ball = || Ok(enclosing_ball(&self.hull()?.vertices)?);
        self.enclosing.get_or_init(ball).clone()
    }

    /// Sphericity in its forms.
    ///
    /// # Errors
    ///
    /// As [`Self::dimensions`] and [`Self::enclosing`].
    pub fn sphericity(&self) -> Result<Sphericity, SurveyError> {
        Ok(Sphericity::new(
            self.properties(),
            &self.dimensions()?,
            self.inscribed()?.radius,
            self.enclosing()?.radius,
        ))
    }

    /// Curvature over the whole surface of a grain.
    ///
    /// # Errors
    ///
    /// [`SurveyError::Flat`] of a mesh.
    pub fn curvature(&self) -> Result<&CurvatureStatistics, SurveyError> {
        let statistics = |surface: &(dyn StarSurface + Sync)| {
            self.curvature.get_or_init(|| {
                CurvatureStatistics::new(surface, &self.nodes(Integrand::Curvature))
            })
        };
        match self.body {
            Body::Grain(grain, _) => Ok(statistics(grain)),
            Body::Solid(solid) => Ok(statistics(solid)),
            Body::Mesh(..) => Err(SurveyError::Flat),
        }
    }

    /// Roundness of the corners, see [`CurvatureStatistics::roundness`].
    ///
    /// # Errors
    ///
    /// [`SurveyError::Flat`] of a mesh.
    pub fn roundness(&self) -> Result<f64, SurveyError> {
        Ok(self.curvature()?.roundness(self.inscribed()?.radius))
    }

    /// Regularity: the mean of roundness and of the sphericity inscribed over enclosing sphere, above 0
    /// to 1 (Cho, Dodds and Santamarina 2006).
    ///
    /// # Errors
    ///
    /// [`SurveyError::Flat`] of a mesh.
    pub fn regularity(&self) -> Result<f64, SurveyError> {
        let sphericity = self.inscribed()?.radius / self.enclosing()?.radius;
        Ok(0.5 * (self.roundness()? + sphericity))
    }

    /// The body against its convex hull.
    ///
    /// # Errors
    ///
    /// When there is no convex hull.
    pub fn convexity(&self) -> Result<Convexity, SurveyError> {
        Ok(Convexity::new(self.mesh(), self.hull()?)?)
    }

    /// The ellipsoid of equal moments.
    ///
    /// # Errors
    ///
    /// [`SurveyError::NotSolid`].
    pub fn ellipsoid(&self) -> Result<EquivalentEllipsoid, SurveyError> {
        EquivalentEllipsoid::new(self.properties()).ok_or(SurveyError::NotSolid)
    }

    /// Angularity index: the mean over all directions from the centroid of |r - r_E| / r_E, with r_E
    /// the radius of the ellipsoid of equal moments. Zero of an ellipsoid, without an upper bound.
    ///
    /// # Errors
    ///
    /// [`SurveyError::NotSolid`].
    pub fn angularity(&self) -> Result<f64, SurveyError> {
        Ok(angularity(self.elements(), &self.ellipsoid()?))
    }

    /// Power of the radius from the centroid per degree of spherical harmonics.
    pub fn spectrum(&self) -> Spectrum {
        Spectrum::new(self.elements())
    }

    /// Outlines seen along the principal axes: along the length, the width and the thickness. The last
    /// is that of a body that lies on its flat side, seen from above.
    ///
    /// # Errors
    ///
    /// [`SurveyError::NotSolid`] and [`SurveyError::Projection`].
    pub fn projections(&self) -> Result<[Outline; 3], SurveyError> {
        let axes = self.principal()?.axes;
        let centre = self.properties().centroid;
        let along = |i: usize| project(self.mesh(), &axes.column(i).into_owned(), &centre);
        Ok([along(0)?, along(1)?, along(2)?])
    }

    /// The mesh, or that of the grain.
    fn mesh(&self) -> &Mesh {
        match self.body {
            Body::Grain(grain, _) => self.mesh.get_or_init(|| grain.mesh(RESOLUTION)),
            Body::Solid(solid) => self
                .mesh
                .get_or_init(|| Mesh::radial(RESOLUTION, |n| solid.radius(n))),
            Body::Mesh(mesh, _) => mesh,
        }
    }

    /// Extents along three unit axes, the columns.
    fn extents_along(&self, axes: &Matrix3<f64>) -> Vector3<f64> {
        let along = |surface: &dyn StarSurface| {
            Vector3::from_fn(|i, _| {
                let axis = axes.column(i).into_owned();
                let reach = |towards: Vector3<f64>| support(surface, &towards).point.dot(&towards);
                reach(axis) + reach(-axis)
            })
        };
        match self.body {
            Body::Grain(grain, _) => along(grain),
            Body::Solid(solid) => along(solid),
            Body::Mesh(mesh, _) => extents(mesh, axes),
        }
    }

    fn hull(&self) -> Result<&Mesh, SurveyError> {
        let hull = || Ok(convex_hull(&self.mesh().vertices)?);
        self.hull.get_or_init(hull).as_ref().map_err(Clone::clone)
    }

    fn elements(&self) -> &[Element] {
        self.elements.get_or_init(|| {
            let centroid = &self.properties().centroid;
            let nodes = || self.nodes(Integrand::Radius);
            match self.body {
                Body::Grain(grain, _) => {
                    let shift = grain.frame().centre - centroid;
                    surface_elements(grain, &nodes(), &shift)
                }
                Body::Solid(solid) => surface_elements(solid, &nodes(), &-centroid.coords),
                Body::Mesh(mesh, _) => mesh_elements(mesh, centroid),
            }
        })
    }
    /// Gauss nodes of a surface with a formula; none of a mesh.
    fn nodes(&self, integrand: Integrand) -> Vec<(Vector3<f64>, f64)> {
        match self.body {
            Body::Grain(grain, _) => grain_nodes(grain, integrand),
            Body::Solid(_) => octant_nodes(integrand),
            Body::Mesh(..) => Vec::new(),
        }
    }
}
