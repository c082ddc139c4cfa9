//! A body under measurement.

mod body;
mod curved;
mod error;
mod errors;
mod from_centroid;
mod unit_size;

use super::boxes::extents::Extents;
use super::boxes::minimum_box::LeastBoxes;
use super::curvature::corners::Corners;
use super::integrals::elements::Element;
use super::scale::Scale;
use super::{
    Ball, Convexity, CurvatureStatistics, EquivalentEllipsoid, Form, MassProperties, OrientedBox,
    Outline, PrincipalInertia, ScannedBody, SideRatios, SolidProperties, Spectrum, Sphericity,
    equivalent_radius, mesh_properties, project,
};
use crate::Mesh;
use crate::mesh::parts;
use crate::model::{Grain, NoStandardErrors, Radial, StandardErrors, StarSurface};
pub(crate) use body::Measured;
use body::{Body, Inside};
pub use error::SurveyError;
use errors::KnownPlace;
pub use errors::{BoxErrors, CurvatureErrors, OutlineErrors};
use nalgebra::{Matrix3, Vector3};
use std::cell::OnceCell;
use std::fmt;

/// A body, and what has been measured of it: each figure is computed when it is first asked for, and
/// what others need is shared.
///
/// Area, volume and moments of a grain are those of its formulas ([`grain_properties`]); its dimensions and
/// the sides of its box are where its surface reaches to ([`support`](super::support())); convexity, spheres
/// and outlines are those of a mesh of it, good to 1e-4 where it is smooth. Of a mesh, everything is that of
/// the polyhedron. Of unions of superquadrics area, volume and moments are those of [`solid_properties`]; of such that no
/// centre sees whole all else is that of a mesh, good to 1e-3, and curvature is an error.
///
/// ```
/// use grainform::Mesh;
/// use grainform::measure::Survey;
///
/// let ball = Mesh::radial(8, |_| 2.0);
/// let survey = Survey::of_mesh(&ball)?;
/// assert!((survey.enclosing()?.radius - 2.0).abs() < 1e-9);
/// assert!(survey.sphericity()?.wadell > 0.99);
/// # Ok::<(), grainform::measure::SurveyError>(())
/// ```
///
/// Threads take a clone each: what is found when it is first asked for takes threads of its own, and others would wait
/// for these.
///
/// Everything is computed at unit size, so any unit of length will do. A ratio that is outside of its range
/// is an error, never a figure.
///
/// [`grain_properties`]: super::grain_properties
/// [`solid_properties`]: super::solid_properties
#[derive(Clone)]
pub struct Survey<'a> {
    body: Body<'a>,
    scale: Scale,
    standard_errors: Result<StandardErrors, NoStandardErrors>,
    union: OnceCell<Option<SolidProperties>>,
    measured: OnceCell<Result<Measured, SurveyError>>,
    extents: OnceCell<Result<Extents, SurveyError>>,
    mesh: OnceCell<Mesh>,
    finer_mesh: OnceCell<Option<Mesh>>,
    hull: OnceCell<Result<Mesh, SurveyError>>,
    least_boxes: OnceCell<Result<LeastBoxes, SurveyError>>,
    box_errors: OnceCell<Result<Option<BoxErrors>, SurveyError>>,
    elements: OnceCell<Vec<Element>>,
    spectrum: OnceCell<Spectrum>,
    inscribed: OnceCell<Result<Ball, SurveyError>>,
    enclosing: OnceCell<Result<Ball, SurveyError>>,
    curvature: OnceCell<CurvatureStatistics>,
    corners: OnceCell<Corners>,
    known_places: OnceCell<Option<Vec<KnownPlace>>>,
}

/// How area, volume and moments of a grain are integrated.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub enum Scheme {
    /// Gauss quadrature of the formulas, see [`grain_properties`](super::grain_properties).
    #[default]
    Exact,
    /// The source's polyhedron on a 128 x 128 grid of angles, see
    /// [`four_triangles`](super::four_triangles()): to reproduce published figures.
    FourTriangles,
}

impl<'a> Survey<'a> {
    /// Of a fitted grain.
    pub fn of_grain(grain: &'a Grain, scheme: Scheme) -> Self {
        let standard_errors = match scheme {
            Scheme::Exact => grain.standard_errors(),
            Scheme::FourTriangles => Err(NoStandardErrors::Scheme),
        };
        Self::new(Body::grain(grain, scheme), standard_errors)
    }

    /// The same of a grain that was [measured](Self::measured) before.
    pub(crate) fn of_known(grain: &'a Grain, measured: Measured) -> Self {
        Self {
            measured: OnceCell::from(Ok(measured)),
            ..Self::of_grain(grain, Scheme::Exact)
        }
    }

    /// Of a surface whose area, volume and moments are known, in its own frame.
    pub fn of_surface(surface: &'a dyn StarSurface, properties: MassProperties) -> Self {
        let body = Body::Known(Radial(surface), properties);
        Self::new((body, Scale::OWN), Err(NoStandardErrors::NotTold))
    }

    /// Of a closed mesh of one body, wound counter-clockwise from outside.
    ///
    /// # Errors
    ///
    /// When it is broken or not closed, when these are several bodies, and when it encloses no volume.
    pub fn of_mesh(mesh: &Mesh) -> Result<Self, SurveyError> {
        mesh.check_edges()?;
        let bodies = parts(mesh).len();
        if bodies > 1 {
            return Err(SurveyError::Several { bodies });
        }
        let body = Body::mesh(mesh, Inside::Bodies(1));
        let survey = Self::new(body, Err(NoStandardErrors::Polyhedron));
        survey.properties()?;
        Ok(survey)
    }

    /// Of what the faces of a scan enclose.
    pub fn of_scanned(scanned: &ScannedBody) -> Self {
        Self::new(Body::scanned(scanned), Err(NoStandardErrors::Polyhedron))
    }

    fn new(
        (body, scale): (Body<'a>, Scale),
        standard_errors: Result<StandardErrors, NoStandardErrors>,
    ) -> Self {
        Self {
            body,
            scale,
            standard_errors,
            union: OnceCell::new(),
            measured: OnceCell::new(),
            extents: OnceCell::new(),
            mesh: OnceCell::new(),
            finer_mesh: OnceCell::new(),
            hull: OnceCell::new(),
            least_boxes: OnceCell::new(),
            box_errors: OnceCell::new(),
            elements: OnceCell::new(),
            spectrum: OnceCell::new(),
            inscribed: OnceCell::new(),
            enclosing: OnceCell::new(),
            curvature: OnceCell::new(),
            corners: OnceCell::new(),
            known_places: OnceCell::new(),
        }
    }

    /// Area, volume, centroid and inertia; of several bodies, of all of them. The inertia may be beyond the
    /// range of numbers.
    ///
    /// # Errors
    ///
    /// When what is inside cannot be told, or nothing is.
    pub fn properties(&self) -> Result<MassProperties, SurveyError> {
        Ok(self.scale.properties(self.unit_properties()?))
    }

    /// Surface area.
    ///
    /// # Errors
    ///
    /// As [`Self::properties`], and [`SurveyError::OutOfRange`].
    pub fn area(&self) -> Result<f64, SurveyError> {
        let area = self.properties()?.area;
        in_range(area, &[area])
    }

    /// Volume.
    ///
    /// # Errors
    ///
    /// As [`Self::area`].
    pub fn volume(&self) -> Result<f64, SurveyError> {
        let volume = self.properties()?.volume;
        in_range(volume, &[volume])
    }

    /// Mean of the radius over all directions from the grain's centre; of a body without one, the radius of the ball of equal
    /// volume.
    ///
    /// # Errors
    ///
    /// As [`Self::properties`].
    pub fn mean_radius(&self) -> Result<f64, SurveyError> {
        let found = self.measured()?;
        let of_volume = || equivalent_radius(found.properties.volume);
        Ok(self.scale.length * found.mean_radius.unwrap_or_else(of_volume))
    }

    /// Standard errors of area, volume, moments and dimensions, as the grain tells them.
    ///
    /// # Errors
    ///
    /// [`NoStandardErrors`] where it tells none, and of all but grains.
    pub fn standard_errors(&self) -> Result<StandardErrors, NoStandardErrors> {
        self.standard_errors
    }

    /// The grain's own axes, in columns, along which errors of the centroid and of the inertia are told; of all but grains the
    /// scan's.
    pub fn axes(&self) -> Matrix3<f64> {
        let surface = self.body.surface();
        surface.map_or(Matrix3::identity(), |surface| surface.frame().axes)
    }

    /// Errors by quadrature of area and volume, as shares of them: of unions of superquadrics, whose moments are as well
    /// known as the volume. `None` of all else.
    pub fn quadrature_errors(&self) -> Option<[f64; 2]> {
        let solid = self.unit_union()?;
        Some([solid.area_error, solid.volume_error])
    }

    /// Inertia about the centroid.
    ///
    /// # Errors
    ///
    /// As [`Self::properties`], and [`SurveyError::OutOfRange`].
    pub fn inertia(&self) -> Result<Matrix3<f64>, SurveyError> {
        let inertia = self.properties()?.inertia;
        in_range(inertia, inertia.diagonal().as_slice())
    }

    /// Principal moments and axes of inertia.
    ///
    /// # Errors
    ///
    /// As [`Self::inertia`].
    pub fn principal(&self) -> Result<PrincipalInertia, SurveyError> {
        let principal = self.scale.principal(self.unit_principal()?);
        in_range(principal, principal.moments.as_slice())
    }

    /// Extents along the principal axes, descending: length, width, thickness.
    ///
    /// # Errors
    ///
    /// As [`Self::properties`], or when there are several bodies.
    pub fn dimensions(&self) -> Result<Vector3<f64>, SurveyError> {
        Ok(self.scale.vector(&self.unit_dimensions()?))
    }

    /// The axes of length, width and thickness, in the columns.
    pub(crate) fn dimension_axes(&self) -> Result<Matrix3<f64>, SurveyError> {
        self.unit_axes()
    }

    /// The box of least volume.
    ///
    /// # Errors
    ///
    /// When there is no convex hull.
    pub fn minimum_box(&self) -> Result<OrientedBox, SurveyError> {
        Ok(self.scale.oriented_box(self.unit_minimum_box()?))
    }

    /// Ratios of the sides of the box of least volume.
    ///
    /// # Errors
    ///
    /// As [`Self::minimum_box`].
    pub fn side_ratios(&self) -> Result<SideRatios, SurveyError> {
        Ok(SideRatios::new(&self.unit_minimum_box()?.extents).checked()?)
    }

    /// Ratios of the dimensions along the principal axes.
    ///
    /// # Errors
    ///
    /// As [`Self::dimensions`].
    pub fn form(&self) -> Result<Form, SurveyError> {
        Ok(Form::new(&self.unit_dimensions()?).checked()?)
    }

    /// The largest inscribed sphere.
    ///
    /// # Errors
    ///
    /// When nothing is inside, or there are several bodies.
    pub fn inscribed(&self) -> Result<Ball, SurveyError> {
        Ok(self.scale.ball(self.unit_inscribed()?))
    }

    /// The smallest enclosing sphere.
    ///
    /// # Errors
    ///
    /// When there is no convex hull.
    pub fn enclosing(&self) -> Result<Ball, SurveyError> {
        Ok(self.scale.ball(self.unit_enclosing()?))
    }

    /// Sphericity in its forms.
    ///
    /// # Errors
    ///
    /// As [`Self::dimensions`] and [`Self::enclosing`].
    pub fn sphericity(&self) -> Result<Sphericity, SurveyError> {
        let found = Sphericity::new(
            self.unit_properties()?,
            &self.unit_dimensions()?,
            self.unit_inscribed()?.radius,
            self.unit_enclosing()?.radius,
        );
        Ok(found.checked()?)
    }

    /// The body against its convex hull.
    ///
    /// # Errors
    ///
    /// When there is no convex hull, or nothing is inside, or there are several bodies.
    pub fn convexity(&self) -> Result<Convexity, SurveyError> {
        self.one_body()?;
        let mut found = Convexity::new(self.mesh(), self.hull()?)?;
        // The mesh of a union closes clefts between its parts; of all others mesh and hull are short of the body alike.
        if let Some(union) = self.unit_union().filter(|_| self.body.has_hidden()) {
            found.area = mesh_properties(self.hull()?)?.area / union.properties.area;
        }
        Ok(found.checked()?)
    }

    /// The ellipsoid of equal moments.
    ///
    /// # Errors
    ///
    /// As [`Self::dimensions`].
    pub fn ellipsoid(&self) -> Result<EquivalentEllipsoid, SurveyError> {
        Ok(self.scale.ellipsoid(self.unit_ellipsoid()?))
    }

    /// Outlines seen along the axes of the [dimensions](Self::dimensions): along the length, the width and the thickness. The
    /// last is that of a body that lies on its flat side, seen from above.
    ///
    /// # Errors
    ///
    /// As [`Self::dimensions`], and [`SurveyError::Projection`].
    pub fn projections(&self) -> Result<[Outline; 3], SurveyError> {
        self.one_body()?;
        let axes = self.unit_axes()?;
        let centre = self.unit_properties()?.centroid;
        let along = |i: usize, along: &'static str| {
            let found = project(self.mesh(), &axes.column(i).into_owned(), &centre);
            let outline = found.map_err(|source| SurveyError::Projection { along, source })?;
            Ok(self.scale.outline(outline.checked()?))
        };
        let seen = [along(0, "length"), along(1, "width"), along(2, "thickness")];
        let [length, width, thickness]: [Result<Outline, SurveyError>; 3] = seen;
        Ok([length?, width?, thickness?])
    }
}

impl fmt::Debug for Survey<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Survey")
            .field("scale", &self.scale)
            .field("measured", &self.measured)
            .finish_non_exhaustive()
    }
}

/// A figure, if these numbers of it are told without loss.
fn in_range<T>(found: T, numbers: &[f64]) -> Result<T, SurveyError> {
    match numbers.iter().all(|number| number.is_normal()) {
        true => Ok(found),
        false => Err(SurveyError::OutOfRange),
    }
}
