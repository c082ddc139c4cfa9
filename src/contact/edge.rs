//! Rounding of an edge by a cap that is tangent to both its sides.
//!
//! An expansion of one octant, mirrored, meets its images at an angle that the body does not have. A
//! contact there has no curvature. Radvilaite 2016, section 3.4, puts a circular arc of small radius
//! in the edge's place, tangent to both sides.

use nalgebra::Vector3;
use std::f64::consts::PI;
use thiserror::Error;

/// A circular arc, seen along an edge, in the edge's place: tangent to both sides.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TangentCap {
    /// Radius of the arc.
    pub radius: f64,
    /// Angle between the normals of the two sides, in radians: 0 where there is no edge.
    pub turn_rad: f64,
    /// Distance along each side from the edge to where the arc begins: radius tan(turn/2).
    pub setback: f64,
    /// Distance from the edge to the top of the arc: radius (1 / cos(turn/2) - 1).
    pub recess: f64,
}

/// Why an edge cannot be rounded.
#[derive(Debug, Clone, Copy, PartialEq, Error)]
#[non_exhaustive]
pub enum EdgeError {
    /// The radius must be above zero and finite.
    #[error("the radius of the cap must be above zero and finite, not {radius}")]
    Radius {
        /// The radius given.
        radius: f64,
    },
    /// A normal is no unit vector.
    #[error("the normal of a side has the length {length}, not 1")]
    NotUnit {
        /// Its length.
        length: f64,
    },
    /// The normals point in opposite directions: a blade.
    #[error("the sides of the edge meet at an angle of {turn_rad} between their normals")]
    Blade {
        /// Angle between the normals.
        turn_rad: f64,
    },
}

/// Largest angle between the normals of two sides.
const LARGEST_TURN: f64 = 0.999 * PI;

/// How far the length of a normal may be from one.
const UNIT_TOLERANCE: f64 = 1e-6;

impl TangentCap {
    /// The cap of this radius on the edge between two sides with these outward unit normals.
    ///
    /// # Errors
    ///
    /// See [`EdgeError`].
    pub fn new(normals: [&Vector3<f64>; 2], radius: f64) -> Result<Self, EdgeError> {
        // Written so that NaN fails.
        if !(radius > 0.0 && radius < f64::INFINITY) {
            return Err(EdgeError::Radius { radius });
        }
        for length in normals.map(Vector3::norm) {
            let off = (length - 1.0).abs();
            if off.is_nan() || off > UNIT_TOLERANCE {
                return Err(EdgeError::NotUnit { length });
            }
        }
        let [one, other] = normals;
        let turn_rad = 2.0 * (one - other).norm().atan2((one + other).norm());
        if turn_rad >= LARGEST_TURN {
            return Err(EdgeError::Blade { turn_rad });
        }
        let half = 0.5 * turn_rad;
        Ok(Self {
            radius,
            turn_rad,
            setback: radius * half.tan(),
            recess: radius * 2.0 * (0.5 * half).sin().powi(2) / half.cos(),
        })
    }

    /// Principal curvatures at the top of the cap, where the edge bends with radius `along` in the
    /// plane of the cap's normal (infinite: a straight edge): 1/radius and 1/(along - recess).
    pub fn principal_curvatures(&self, along: f64) -> [f64; 2] {
        [1.0 / self.radius, 1.0 / (along - self.recess)]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;
    use proptest::prelude::*;

    #[test]
    fn normals_that_are_no_unit_vectors_are_refused() {
        for normal in [0.0, 2.0, f64::NAN].map(|length| Vector3::x() * length) {
            let refused = TangentCap::new([&Vector3::y(), &normal], 0.5);
            assert!(matches!(refused, Err(EdgeError::NotUnit { .. })));
        }
    }

    #[test]
    fn a_right_angle_is_rounded_as_one_does_with_compasses() {
        let cap = TangentCap::new([&Vector3::x(), &Vector3::y()], 0.5).unwrap();
        assert_relative_eq!(cap.turn_rad, PI / 2.0, max_relative = 1e-15);
        assert_relative_eq!(cap.setback, 0.5, max_relative = 1e-15);
        assert_relative_eq!(
            cap.recess,
            0.5 * (2.0_f64.sqrt() - 1.0),
            max_relative = 1e-14
        );
        let [across, along] = cap.principal_curvatures(2.0);
        assert_eq!(across, 2.0);
        assert_relative_eq!(along, 1.0 / (2.0 - cap.recess));
    }

    proptest! {
        /// The centre of the arc lies at its radius from both sides, and its top on the bisector.
        #[test]
        fn the_cap_touches_both_sides(turn in 1e-6..3.0_f64, radius in 0.01..10.0_f64) {
            let (sin, cos) = (0.5 * turn).sin_cos();
            let normals = [Vector3::new(sin, cos, 0.0), Vector3::new(-sin, cos, 0.0)];
            let cap = TangentCap::new([&normals[0], &normals[1]], radius).unwrap();
            let centre = Vector3::new(0.0, -(cap.recess + radius), 0.0);
            for normal in &normals {
                prop_assert!((normal.dot(&centre) + radius).abs() < 1e-9 * radius);
                let foot = centre + normal * radius;
                prop_assert!((foot.norm() - cap.setback).abs() < 1e-9 * radius);
            }
        }
    }

    #[test]
    fn what_is_no_edge_needs_no_room_and_what_is_a_blade_is_refused() {
        let flat = TangentCap::new([&Vector3::x(), &Vector3::x()], 1.0).unwrap();
        assert_eq!((flat.setback, flat.recess), (0.0, 0.0));
        let blade = TangentCap::new([&Vector3::x(), &-Vector3::x()], 1.0);
        assert!(matches!(blade, Err(EdgeError::Blade { .. })));
        for radius in [0.0, -1.0, f64::NAN, f64::INFINITY] {
            let refused = TangentCap::new([&Vector3::x(), &Vector3::y()], radius);
            assert!(matches!(refused, Err(EdgeError::Radius { .. })));
        }
    }
}
