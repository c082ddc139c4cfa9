//! Semi-axes that a body can have.

use super::Body;
use nalgebra::Vector3;
use thiserror::Error;

/// Shortest semi-axis, in millimetres.
pub const MIN_AXIS: f64 = 1e-6;

/// Longest semi-axis, in millimetres. The fifth powers of both are far from the ends of f64.
pub const MAX_AXIS: f64 = 1e6;

/// Why a body cannot have these semi-axes.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum AxesError {
    /// Leave the semi-axes out, or take another body.
    #[error("the {body} has one size: it takes no semi-axes")]
    Grain {
        /// The body.
        body: Body,
    },
    /// A superquadric is made with its semi-axes.
    #[error("a superquadric has its own semi-axes")]
    Superquadric,
    /// Give every semi-axis as a length in millimetres, within [`MIN_AXIS`] and [`MAX_AXIS`].
    #[error("a semi-axis must be {MIN_AXIS} to {MAX_AXIS} long, not {length}")]
    Length {
        /// The length asked for.
        length: f64,
    },
    /// Make the semi-axes in x and y equal.
    #[error("a {body} is round: its semi-axes in x and y must be equal, not {x} and {y}")]
    NotRound {
        /// The body.
        body: Body,
        /// The semi-axis asked for in x.
        x: f64,
        /// The semi-axis asked for in y.
        y: f64,
    },
    /// Make all semi-axes equal; a body of other proportions is an ellipsoid or a cuboid.
    #[error("the semi-axes of a {body} must all be equal, not {x}, {y} and {z}")]
    NotEqual {
        /// The body.
        body: Body,
        /// The semi-axis asked for in x.
        x: f64,
        /// The semi-axis asked for in y.
        y: f64,
        /// The semi-axis asked for in z.
        z: f64,
    },
}

/// Refuses semi-axes that the body cannot have.
pub(super) fn check(body: Body, axes: &Vector3<f64>) -> Result<(), AxesError> {
    let [x, y, z]: [f64; 3] = (*axes).into();
    if body.native_axes().is_none() {
        return Err(AxesError::Grain { body });
    }
    let is_length = |length: f64| (MIN_AXIS..=MAX_AXIS).contains(&length);
    if let Some(length) = [x, y, z].into_iter().find(|&length| !is_length(length)) {
        return Err(AxesError::Length { length });
    }
    match body {
        Body::Cylinder | Body::Bicone if x != y => Err(AxesError::NotRound { body, x, y }),
        Body::Sphere | Body::Cube if x != y || y != z => Err(AxesError::NotEqual { body, x, y, z }),
        _ => Ok(()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn native_axes_are_their_own() {
        for body in Body::ALL {
            if let Some(axes) = body.native_axes() {
                assert_eq!(check(body, &axes), Ok(()));
            }
        }
    }

    #[test]
    fn impossible_axes_are_refused_in_a_sentence() {
        let refused = |body, x, y, z| {
            let error = check(body, &Vector3::new(x, y, z)).unwrap_err();
            error.to_string()
        };
        assert_eq!(
            refused(Body::Bean, 2.0, 2.0, 1.0),
            "the bean has one size: it takes no semi-axes"
        );
        for length in [0.0, -1.0, 2e6, f64::INFINITY, f64::NAN] {
            assert_eq!(
                refused(Body::Octahedron, 2.0, 1.0, length),
                format!("a semi-axis must be 0.000001 to 1000000 long, not {length}")
            );
        }
        assert_eq!(
            refused(Body::Bicone, 2.0, 1.5, 1.0),
            "a bicone is round: its semi-axes in x and y must be equal, not 2 and 1.5"
        );
        assert_eq!(
            refused(Body::Cube, 2.0, 2.0, 1.0),
            "the semi-axes of a cube must all be equal, not 2, 2 and 1"
        );
    }
}
