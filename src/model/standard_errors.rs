//! Standard errors of a grain's figures, or why there are none.

use nalgebra::{Matrix3, Vector3};
use serde::{Deserialize, Serialize};
use std::f64::consts::PI;

/// Standard errors (one standard deviation) of a grain's measures, in the powers of the scan's unit
/// of these.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct StandardErrors {
    /// Of the area.
    pub area: f64,
    /// Of the volume.
    pub volume: f64,
    /// Of the centroid's coordinates along the grain's axes.
    pub centroid: Vector3<f64>,
    /// Of the entries of the inertia tensor about the centroid, along the grain's axes.
    pub inertia: Matrix3<f64>,
    /// Of the principal moments of inertia, ascending.
    pub moments: Vector3<f64>,
    /// Of the length, width and thickness: extents along the principal axes.
    pub dimensions: Vector3<f64>,
    /// By what the extents of the scanned grain exceed these in the mean: the fitted surface lacks the ripples that
    /// the points do not tell, and a largest value is larger with them. Zero of positions, which keep their ripples.
    pub dimensions_excess: Vector3<f64>,
}

impl StandardErrors {
    /// Of figures that are exact.
    pub(crate) const ZERO: Self = Self {
        area: 0.0,
        volume: 0.0,
        centroid: Vector3::new(0.0, 0.0, 0.0),
        inertia: Matrix3::new(0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0),
        moments: Vector3::new(0.0, 0.0, 0.0),
        dimensions: Vector3::new(0.0, 0.0, 0.0),
        dimensions_excess: Vector3::new(0.0, 0.0, 0.0),
    };

    /// Those of a grain so many times as large.
    pub(crate) fn times(self, factor: f64) -> Self {
        let [square, cube, fifth] = [2, 3, 5].map(|power| factor.powi(power));
        Self {
            area: self.area * square,
            volume: self.volume * cube,
            centroid: self.centroid * factor,
            inertia: self.inertia * fifth,
            moments: self.moments * fifth,
            dimensions: self.dimensions * factor,
            dimensions_excess: self.dimensions_excess * factor,
        }
    }

    /// Whether its numbers can be standard errors.
    pub(crate) fn is_sound(&self) -> bool {
        let [centroid, moments] = [&self.centroid, &self.moments].map(Vector3::iter);
        let dimensions = self.dimensions.iter().chain(&self.dimensions_excess);
        let numbers = [&self.area, &self.volume].into_iter();
        numbers
            .chain(centroid)
            .chain(moments)
            .chain(dimensions)
            .chain(&self.inertia)
            .all(|error| error.is_finite() && *error >= 0.0)
    }
}

/// Why there are no standard errors that could be trusted.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
#[non_exhaustive]
pub enum NoStandardErrors {
    /// No point lies in a cap of directions of this half-angle, in radians.
    Hole {
        /// Half-angle in radians, in the stretched space.
        half_angle: f64,
    },
    /// Residuals are not those of noise, but of edges, or the points are too few to tell, and the body is alike on both
    /// sides of its centre or has flat sides: what edges hide may be all of one sign.
    Unresolved {
        /// Kurtosis of the residuals: 3 of normal noise.
        kurtosis: f64,
    },
    /// There are fewer points than coefficients of positions.
    FewPoints,
    /// The scan has a neck: if these are two grains that touch, a radius rounds off what lies between them.
    Neck,
    /// The figures, or their errors, are not finite.
    NotFinite,
    /// Squares of the figures are beyond the range of numbers.
    OutOfRange,
    /// Area or volume are more off those of the polyhedron through the points than any error allows.
    Contradicted,
    /// The surface turns over or crosses itself.
    Crossing,
    /// The surface does not follow the scan everywhere.
    NotFollowed,
    /// The model is fitted to the points themselves, not to an estimate.
    NotEstimated,
    /// The surface is not the one that the errors in its file were those of.
    Edited,
    /// Nothing is told of them with the model.
    #[serde(skip)]
    NotTold,
    /// The figures are those of a polyhedron, and exact.
    #[serde(skip)]
    Polyhedron,
    /// The figures are those of [`Scheme::FourTriangles`](crate::measure::Scheme::FourTriangles), which has errors of its own.
    #[serde(skip)]
    Scheme,
}

impl NoStandardErrors {
    /// Whether its numbers can be those of a surface.
    pub(super) fn is_sound(&self) -> bool {
        match *self {
            Self::Hole { half_angle } => (0.0..=PI).contains(&half_angle),
            Self::Unresolved { kurtosis } => kurtosis.is_finite() && kurtosis >= 0.0,
            _ => true,
        }
    }
}
