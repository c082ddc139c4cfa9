//! One grain in motion, and how it moves without and with forces.

use super::grain::GrainKind;
use super::record;
use nalgebra::{Matrix3, Point3, Quaternion, Unit, UnitQuaternion, Vector3};
use serde::{Deserialize, Serialize};

/// The order of turns about the principal axes, and their shares of a step: the same forwards and backwards.
const TURNS: [(usize, f64); 5] = [(0, 0.5), (1, 0.5), (2, 1.0), (1, 0.5), (0, 0.5)];

/// Where a grain is and how it moves, in SI units.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Body {
    /// Which of the kinds of the bed it is.
    pub kind: usize,
    /// Its centre of mass.
    #[serde(with = "record::point")]
    pub position: Point3<f64>,
    /// Velocity of that.
    #[serde(with = "record::vector")]
    pub velocity: Vector3<f64>,
    /// Turns vectors along the principal axes into those of the bed.
    #[serde(with = "record::turn")]
    pub orientation: UnitQuaternion<f64>,
    /// Angular momentum about the centre of mass, along the axes of the bed, in kg m²/s.
    #[serde(with = "record::vector")]
    pub momentum: Vector3<f64>,
}

/// What acts on a body.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(super) struct Load {
    pub(super) force: Vector3<f64>,
    /// About the centre of mass.
    pub(super) moment: Vector3<f64>,
}

impl Body {
    /// The principal axes in the columns.
    pub(super) fn axes(&self) -> Matrix3<f64> {
        self.orientation.to_rotation_matrix().into_inner()
    }

    /// Angular velocity along the axes of the bed, in rad/s.
    pub(super) fn spin(&self, kind: &GrainKind, axes: &Matrix3<f64>) -> Vector3<f64> {
        axes * axes.tr_mul(&self.momentum).component_div(&kind.inertia)
    }

    /// Kinetic energy, in joules.
    pub(super) fn kinetic_energy(&self, kind: &GrainKind) -> f64 {
        let own = self.orientation.inverse_transform_vector(&self.momentum);
        let turning = own.dot(&own.component_div(&kind.inertia));
        0.5 * (kind.mass * self.velocity.norm_squared() + turning)
    }

    /// Lets a load act for some seconds.
    pub(super) fn kick(&mut self, kind: &GrainKind, load: &Load, seconds: f64) {
        self.velocity += load.force * (seconds / kind.mass);
        self.momentum += load.moment * seconds;
    }

    /// Moves freely for some seconds.
    pub(super) fn drift(&mut self, kind: &GrainKind, seconds: f64) {
        self.position += self.velocity * seconds;
        self.turn(kind, seconds);
    }

    /// Turns freely for some seconds: the no-squish split (Miller and others 2002), exact turns about one principal
    /// axis after the other. The angular momentum in the axes of the bed stays as it is, and the energy within a bound.
    fn turn(&mut self, kind: &GrainKind, seconds: f64) {
        let mut own = self.orientation.inverse_transform_vector(&self.momentum);
        let mut turned = *self.orientation.quaternion();
        for (axis, share) in TURNS {
            let half = 0.5 * share * seconds * own[axis] / kind.inertia[axis];
            let (sin, cos) = half.sin_cos();
            turned *= Quaternion::from_parts(cos, Vector3::ith(axis, sin));
            let (next, last) = ((axis + 1) % 3, (axis + 2) % 3);
            let (sin, cos) = (2.0 * sin * cos, (cos - sin) * (cos + sin));
            (own[next], own[last]) = (
                cos * own[next] + sin * own[last],
                cos * own[last] - sin * own[next],
            );
        }
        self.orientation = Unit::new_normalize(turned);
    }

    /// How far a point at a distance from the centre may have come since the body was where `before` was.
    pub(super) fn moved(&self, before: &Self, distance: f64) -> f64 {
        let cosine = self.orientation.coords.dot(&before.orientation.coords);
        let chord = 2.0 * (1.0 - cosine * cosine).max(0.0).sqrt() * distance;
        (self.position - before.position).norm() + chord
    }
}
