//! The parts of a report of measures.

use crate::measure::{
    Ball, BoxErrors, CurvatureErrors, CurvatureStatistics, Distribution, EquivalentEllipsoid,
    OrientedBox, PrincipalInertia,
};
use nalgebra::{Matrix3, Vector3};
use serde::Serialize;

/// Principal moments of inertia about the centroid.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[non_exhaustive]
pub struct Principal {
    /// Ascending: the first belongs to the long axis.
    pub moments: [f64; 3],
    /// A unit axis for each moment, in the scan's frame.
    pub axes: [[f64; 3]; 3],
}

impl Principal {
    pub(in crate::report) fn new(principal: &PrincipalInertia) -> Self {
        Self {
            moments: principal.moments.into(),
            axes: rows(&principal.axes.transpose()),
        }
    }
}

/// Extents along the principal axes of inertia, in the order of the moments.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[non_exhaustive]
pub struct Dimensions {
    /// Along the axis of the least moment.
    pub length: f64,
    /// Along the axis of the middle moment.
    pub width: f64,
    /// Along the axis of the largest moment.
    pub thickness: f64,
}

impl Dimensions {
    /// Length, width and thickness, in this order.
    pub(in crate::report) fn new(extents: Vector3<f64>) -> Self {
        let [length, width, thickness] = extents.into();
        Self {
            length,
            width,
            thickness,
        }
    }
}

/// Figures, and how well they are known.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[non_exhaustive]
pub struct WithErrors<T> {
    /// The figures.
    #[serde(flatten)]
    pub figures: T,
    /// Their standard errors, at most; `null` where they are not known.
    pub standard_errors: Option<T>,
}

impl<T> WithErrors<T> {
    pub(in crate::report) fn new(figures: T, standard_errors: Option<T>) -> Self {
        Self {
            figures,
            standard_errors,
        }
    }
}

/// A box in any orientation.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[non_exhaustive]
pub struct BoxRecord {
    /// Its sides and its volume.
    #[serde(flatten)]
    pub sides: WithErrors<BoxSides>,
    /// Centre.
    pub centre: [f64; 3],
    /// A unit axis for each side.
    pub axes: [[f64; 3]; 3],
}

/// The sides of a box.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[non_exhaustive]
pub struct BoxSides {
    /// Longest side.
    pub length: f64,
    /// Middle side.
    pub width: f64,
    /// Shortest side.
    pub thickness: f64,
    /// Volume.
    pub volume: f64,
}

impl BoxRecord {
    pub(super) fn new(found: OrientedBox, errors: Option<BoxErrors>) -> Self {
        let sides = |sides: Vector3<f64>, volume: f64| {
            let [length, width, thickness] = sides.into();
            BoxSides {
                length,
                width,
                thickness,
                volume,
            }
        };
        let errors = errors.map(|off| sides(off.extents, off.volume));
        Self {
            sides: WithErrors::new(sides(found.extents, found.volume()), errors),
            centre: found.centre.coords.into(),
            axes: rows(&found.axes.transpose()),
        }
    }
}

/// The spheres within and around a body.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[non_exhaustive]
pub struct Spheres {
    /// The largest sphere inside; `null` where none was found.
    pub inscribed: Option<SphereRecord>,
    /// The smallest sphere outside.
    pub enclosing: SphereRecord,
}

/// A sphere.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[non_exhaustive]
pub struct SphereRecord {
    /// Centre.
    pub centre: [f64; 3],
    /// Radius.
    pub radius: f64,
    /// Its standard error; `null` where it is not known how well the surface is.
    pub radius_standard_error: Option<f64>,
}

impl SphereRecord {
    pub(super) fn new(ball: Ball, radius_standard_error: Option<f64>) -> Self {
        Self {
            centre: ball.centre.coords.into(),
            radius: ball.radius,
            radius_standard_error,
        }
    }
}

/// The ellipsoid of equal moments.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[non_exhaustive]
pub struct EllipsoidRecord {
    /// Semi-axes, descending.
    pub semi_axes: [f64; 3],
    /// Their standard errors, at most; `null` where they are not known.
    pub semi_axes_standard_errors: Option<[f64; 3]>,
    /// A unit axis for each semi-axis.
    pub axes: [[f64; 3]; 3],
}

impl EllipsoidRecord {
    pub(super) fn new(ellipsoid: EquivalentEllipsoid, errors: Option<Vector3<f64>>) -> Self {
        Self {
            semi_axes: ellipsoid.semi_axes.into(),
            semi_axes_standard_errors: errors.map(Into::into),
            axes: rows(&ellipsoid.axes.transpose()),
        }
    }
}

/// Curvature over a surface, positive where convex.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[non_exhaustive]
pub struct CurvatureRecord {
    /// Mean curvature H.
    pub mean: Distribution,
    /// Gaussian curvature K.
    pub gaussian: Distribution,
    /// The larger principal curvature.
    pub larger: Distribution,
    /// The smaller principal curvature.
    pub smaller: Distribution,
    /// Share of the area where both are positive.
    pub convex_share: f64,
    /// The integral of K over 4 pi, less one.
    pub gauss_bonnet_error: f64,
    /// Standard errors of the others; `null` where the model tells none.
    pub standard_errors: Option<CurvatureErrors>,
}

impl CurvatureRecord {
    pub(super) fn new(statistics: &CurvatureStatistics, errors: Option<CurvatureErrors>) -> Self {
        Self {
            standard_errors: errors,
            mean: statistics.mean(),
            gaussian: statistics.gaussian(),
            larger: statistics.larger(),
            smaller: statistics.smaller(),
            convex_share: statistics.convex_share(),
            gauss_bonnet_error: statistics.gauss_bonnet_error(),
        }
    }
}

/// The rows of a matrix.
pub(in crate::report) fn rows(matrix: &Matrix3<f64>) -> [[f64; 3]; 3] {
    [0, 1, 2].map(|i| matrix.row(i).transpose().into())
}
