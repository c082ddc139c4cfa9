//! The parts of a report of measures.

use crate::measure::{
    Ball, CurvatureStatistics, Distribution, EquivalentEllipsoid, OrientedBox, Outline,
    PrincipalInertia,
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

/// Pure numbers, and how well they are known.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[non_exhaustive]
pub struct WithErrors<T> {
    /// The numbers.
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
    /// Longest side.
    pub length: f64,
    /// Middle side.
    pub width: f64,
    /// Shortest side.
    pub thickness: f64,
    /// Volume.
    pub volume: f64,
    /// Centre.
    pub centre: [f64; 3],
    /// A unit axis for each side.
    pub axes: [[f64; 3]; 3],
}

impl From<OrientedBox> for BoxRecord {
    fn from(found: OrientedBox) -> Self {
        let [length, width, thickness] = found.extents.into();
        Self {
            length,
            width,
            thickness,
            volume: found.volume(),
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
    /// A unit axis for each semi-axis.
    pub axes: [[f64; 3]; 3],
}

impl From<EquivalentEllipsoid> for EllipsoidRecord {
    fn from(ellipsoid: EquivalentEllipsoid) -> Self {
        Self {
            semi_axes: ellipsoid.semi_axes.into(),
            axes: rows(&ellipsoid.axes.transpose()),
        }
    }
}

/// The outline of a body seen along an axis, see [`Outline`].
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[non_exhaustive]
pub struct ProjectionRecord {
    /// "length", "width" or "thickness".
    pub along: &'static str,
    /// Area.
    pub area: f64,
    /// Perimeter.
    pub perimeter: f64,
    /// Diameter of the circle of equal area.
    pub equivalent_diameter: f64,
    /// Largest distance between parallel tangents.
    pub largest_feret: f64,
    /// Smallest distance between parallel tangents.
    pub smallest_feret: f64,
    /// Diameter of the smallest enclosing circle.
    pub enclosing_diameter: f64,
    /// Diameter of the largest inscribed circle.
    pub inscribed_diameter: f64,
    /// Area over that of the enclosing circle.
    pub area_sphericity: f64,
    /// Equivalent over enclosing diameter.
    pub diameter_sphericity: f64,
    /// Inscribed over enclosing diameter.
    pub circle_ratio: f64,
    /// Square root of the circle ratio.
    pub riley_sphericity: f64,
    /// Perimeter of the circle of equal area over the perimeter.
    pub perimeter_sphericity: f64,
    /// 4 pi area over the perimeter squared.
    pub circularity: f64,
    /// Smallest over largest Feret diameter.
    pub width_to_length: f64,
    /// Area over that of the convex hull.
    pub solidity: f64,
    /// Perimeter of the convex hull over the perimeter.
    pub convexity: f64,
    /// Mean radius of the corners over the inscribed radius.
    pub roundness: f64,
}

impl ProjectionRecord {
    pub(super) fn new(along: &'static str, outline: &Outline) -> Self {
        Self {
            along,
            area: outline.area,
            perimeter: outline.perimeter,
            equivalent_diameter: outline.equivalent_diameter(),
            largest_feret: outline.largest_feret,
            smallest_feret: outline.smallest_feret,
            enclosing_diameter: outline.enclosing_diameter,
            inscribed_diameter: outline.inscribed_diameter,
            area_sphericity: outline.area_sphericity().min(1.0),
            diameter_sphericity: outline.diameter_sphericity().min(1.0),
            circle_ratio: outline.circle_ratio().min(1.0),
            riley_sphericity: outline.riley_sphericity().min(1.0),
            perimeter_sphericity: outline.perimeter_sphericity().min(1.0),
            circularity: outline.circularity().min(1.0),
            width_to_length: outline.width_to_length().min(1.0),
            solidity: outline.solidity().min(1.0),
            convexity: outline.convexity().min(1.0),
            roundness: outline.roundness.min(1.0),
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
    /// Standard error of its largest value; `None` where the model does not tell it.
    pub largest_error: Option<f64>,
    /// The smaller principal curvature.
    pub smaller: Distribution,
    /// Share of the area where both are positive.
    pub convex_share: f64,
    /// The integral of K over 4 pi, less one.
    pub gauss_bonnet_error: f64,
}

impl CurvatureRecord {
    pub(super) fn new(statistics: &CurvatureStatistics, largest_error: Option<f64>) -> Self {
        Self {
            largest_error,
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
