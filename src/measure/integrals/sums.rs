//! What is integrated over a surface, part by part.

use crate::measure::{MassProperties, Moments};
use crate::model::SurfaceElement;
use nalgebra::Point3;
use std::f64::consts::PI;

/// Surface evaluations after which [`integrate`](crate::measure::integrate) stops and returns what it has.
pub const MAX_EVALUATIONS: usize = 4_000_000;

/// What [`integrate`](crate::measure::integrate) found, and how well.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Integrals {
    /// Area, volume, centroid and inertia.
    pub properties: MassProperties,
    /// (1/4 pi) ∫ X · dA / |X|²: of a star-shaped surface the mean of its radius over all directions, whatever space it is
    /// expanded in.
    pub mean_radius: f64,
    /// Estimated error, an upper bound on smooth surfaces: the largest of those of the mean radius
    /// R, the area and the volume V, each relative to itself, of the first moments relative to V R
    /// and of the second moments relative to V R². Above the tolerance when [`MAX_EVALUATIONS`] did
    /// not suffice, not finite when the surface is not.
    pub relative_error: f64,
    /// Evaluations of the surface.
    pub evaluations: usize,
}

/// The integrals over a part of the sphere.
#[derive(Clone, Copy, Default)]
pub(super) struct Sums {
    /// ∫ |X| dΩ over the directions of the surface's own space.
    length: f64,
    /// ∫ X · dA / |X|².
    radius: f64,
    moments: Moments,
}

impl Sums {
    /// Those over parts of a surface.
    pub(super) fn of(elements: impl IntoIterator<Item = SurfaceElement>) -> Self {
        let mut sums = Self::default();
        for element in elements {
            sums.length += element.place.norm() * element.solid_angle;
            sums.radius += element.place.dot(&element.area) / element.place.norm_squared();
            sums.moments.add_element(&element.place, &element.area);
        }
        sums
    }

    /// What they make over all directions.
    pub(super) fn integrals(&self, relative_error: f64, evaluations: usize) -> Integrals {
        Integrals {
            properties: self.moments.about_centroid(&Point3::origin()),
            mean_radius: self.radius / (4.0 * PI),
            relative_error,
            evaluations,
        }
    }

    /// Largest difference to `other`, relative to `scale`; NaN when any difference is.
    pub(super) fn difference(&self, other: &Self, scale: &Self) -> f64 {
        let length = scale.length / (4.0 * PI);
        let volume = scale.moments.volume;
        let difference = self.moments - other.moments;
        [
            (self.length - other.length) / scale.length,
            difference.area / scale.moments.area,
            difference.volume / volume,
        ]
        .into_iter()
        .chain(difference.first.iter().map(|d| d / (volume * length)))
        .chain(
            difference
                .second
                .iter()
                .map(|d| d / (volume * length * length)),
        )
        .map(f64::abs)
        .fold(
            0.0,
            |worst, d| if d > worst || d.is_nan() { d } else { worst },
        )
    }
}

impl std::ops::Add for Sums {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        Self {
            length: self.length + other.length,
            radius: self.radius + other.radius,
            moments: self.moments + other.moments,
        }
    }
}
