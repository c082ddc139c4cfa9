//! The figures of a body at unit size, each of which is computed once.

use super::Survey;
use super::body::{Body, Measured};
use super::error::SurveyError;
use crate::Mesh;
use crate::measure::boxes::extents::Extents;
use crate::measure::boxes::minimum_box::{LeastBoxes, least_boxes};
use crate::measure::boxes::reach::{RESOLUTION, Reach};
use crate::measure::boxes::sag::finer_resolution;
use crate::measure::{
    Ball, EquivalentEllipsoid, MassProperties, OrientedBox, PrincipalInertia, SolidProperties,
    convex_hull, enclosing_ball, extents, inscribed_ball,
};
use crate::model::Surface;
use nalgebra::{Matrix3, Vector3};

/// Second moments along two axes that differ by less than this share of the larger are equal: their axes are rounding's.
const EQUAL: f64 = 1e-6;

/// So are those of moments of inertia that differ by less than this share of the largest.
const ROUNDED: f64 = 1e-12;

impl Survey<'_> {
    /// Area, volume and moments at unit size.
    pub(super) fn unit_properties(&self) -> Result<&MassProperties, SurveyError> {
        Ok(&self.measured()?.properties)
    }

    /// The same, and the mean radius, at unit size.
    pub(crate) fn measured(&self) -> Result<&Measured, SurveyError> {
        let found = self
            .measured
            .get_or_init(|| self.body.measured(self.unit_union()));
        found.as_ref().map_err(Clone::clone)
    }

    /// Those of a union of superquadrics, and how well they are known.
    pub(super) fn unit_union(&self) -> Option<&SolidProperties> {
        self.union.get_or_init(|| self.body.union()).as_ref()
    }

    pub(super) fn unit_principal(&self) -> Result<PrincipalInertia, SurveyError> {
        self.unit_properties()?
            .principal()
            .ok_or(SurveyError::NotSolid)
    }

    pub(super) fn unit_ellipsoid(&self) -> Result<EquivalentEllipsoid, SurveyError> {
        self.one_body()?;
        EquivalentEllipsoid::new(self.unit_properties()?).ok_or(SurveyError::NotSolid)
    }

    pub(super) fn unit_dimensions(&self) -> Result<Vector3<f64>, SurveyError> {
        Ok(self.unit_extents()?.dimensions)
    }

    /// The axes of length, width and thickness, in the columns.
    pub(super) fn unit_axes(&self) -> Result<Matrix3<f64>, SurveyError> {
        Ok(self.unit_extents()?.axes)
    }

    fn unit_extents(&self) -> Result<&Extents, SurveyError> {
        let found = || {
            self.one_body()?;
            let axes = self.own_axes()?;
            let along = match self.reach() {
                Some(reach) => reach.extents(&axes),
                None => extents(self.mesh(), &axes),
            };
            Ok(Extents::descending(&along, &axes))
        };
        self.extents
            .get_or_init(found)
            .as_ref()
            .map_err(Clone::clone)
    }

    /// The principal axes, and of equal moments, whose axes may be any, those along the sides of the least box.
    fn own_axes(&self) -> Result<Matrix3<f64>, SurveyError> {
        let principal = self.unit_principal()?;
        let moments = principal.moments;
        // Of a needle moments of inertia differ little though it is twice as wide as thick.
        let along = |i: usize| 0.5 * moments.sum() - moments[i];
        let are_equal = |i: usize, j: usize| {
            let least = (EQUAL * along(i).max(along(j))).max(ROUNDED * moments.max());
            moments[j] - moments[i] <= least
        };
        let single = match [are_equal(0, 1), are_equal(1, 2)] {
            [false, false] => return Ok(principal.axes),
            [true, true] => return Ok(self.unit_minimum_box()?.axes),
            [true, false] => principal.axes.column(2).into_owned(),
            [false, true] => principal.axes.column(0).into_owned(),
        };
        let sides = self.unit_minimum_box()?.axes;
        let across = (0..3).map(|i| {
            let side = sides.column(i).into_owned();
            side - single * single.dot(&side)
        });
        let longest = across.max_by(|a, b| a.norm_squared().total_cmp(&b.norm_squared()));
        let first = longest.unwrap_or_default().normalize();
        Ok(Matrix3::from_columns(&[
            first,
            single.cross(&first),
            single,
        ]))
    }

    pub(super) fn unit_minimum_box(&self) -> Result<OrientedBox, SurveyError> {
        Ok(self.unit_least_boxes()?.least)
    }

    /// The box of least volume, and others that may be hardly larger.
    pub(super) fn unit_least_boxes(&self) -> Result<&LeastBoxes, SurveyError> {
        let least = || {
            let found = least_boxes(self.hull()?)?;
            Ok(match self.reach() {
                Some(reach) => LeastBoxes {
                    least: reach.hold(&found.least.axes),
                    ..found
                },
                None => found,
            })
        };
        let found = self.least_boxes.get_or_init(least);
        found.as_ref().map_err(Clone::clone)
    }

    pub(super) fn unit_inscribed(&self) -> Result<Ball, SurveyError> {
        let ball = || {
            self.one_body()?;
            Ok(inscribed_ball(self.mesh())?)
        };
        self.inscribed.get_or_init(ball).clone()
    }

    pub(super) fn unit_enclosing(&self) -> Result<Ball, SurveyError> {
        let ball = || {
            let hull = &self.hull()?.vertices;
            Ok(match self.reach() {
                Some(reach) => reach.enclosing_ball(hull)?,
                None => enclosing_ball(hull)?,
            })
        };
        self.enclosing.get_or_init(ball).clone()
    }

    pub(super) fn one_body(&self) -> Result<(), SurveyError> {
        match self.body.count()? {
            1 => Ok(()),
            bodies => Err(SurveyError::Several { bodies }),
        }
    }

    /// The mesh, or one of the surface that is as fine as this is rough.
    pub(super) fn mesh(&self) -> &Mesh {
        let coarse = self.coarse_mesh();
        let Ok(surface) = self.body.surface() else {
            return coarse;
        };
        let finer = || Some(surface.mesh(finer_resolution(coarse, RESOLUTION)?));
        self.finer_mesh
            .get_or_init(finer)
            .as_ref()
            .unwrap_or(coarse)
    }

    /// The mesh, or one of the surface of the resolution [`RESOLUTION`].
    fn coarse_mesh(&self) -> &Mesh {
        match &self.body {
            Body::Mesh(mesh, _) => mesh,
            Body::Grain(grain, _) => self.mesh.get_or_init(|| grain.mesh(RESOLUTION)),
            Body::Known(surface, _) => self.mesh.get_or_init(|| surface.mesh(RESOLUTION)),
        }
    }

    /// The surface, if it has a formula, and where it reaches to.
    fn reach(&self) -> Option<Reach<'_>> {
        let surface = self.body.surface().ok()?;
        Some(Reach::new(surface, self.coarse_mesh()))
    }

    pub(super) fn hull(&self) -> Result<&Mesh, SurveyError> {
        let hull = || Ok(convex_hull(&self.mesh().vertices)?);
        self.hull.get_or_init(hull).as_ref().map_err(Clone::clone)
    }
}
