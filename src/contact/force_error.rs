//! How much a normal force is off when curvatures are.

use super::{ContactError, Correction, RelativeCurvature};

/// The principal curvatures of a body where it is touched, with their standard error, in one over length.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Curved {
    /// Principal curvatures, positive where convex.
    pub principal: [f64; 2],
    /// Standard error of the curvature tensor; zero of a plane.
    pub error: f64,
}

impl Curved {
    /// A plane.
    pub const PLANE: Self = Self {
        principal: [0.0; 2],
        error: 0.0,
    };
}

/// Standard error of the normal force as a share of it: by how much it changes when each principal curvature is off by
/// its error, up or down, whichever is more. Changes of different curvatures are added as squares: the error of a
/// body's tensor holds those of both.
///
/// # Errors
///
/// See [`ContactError`]: with curvatures off by so much, the bodies would touch in no single place.
pub fn force_error(one: &Curved, other: &Curved, angle_rad: f64) -> Result<f64, ContactError> {
    let force = |one: [f64; 2], other: [f64; 2]| {
        let relative = RelativeCurvature::new(one, other, angle_rad)?;
        Ok(relative.correction(Correction::Elliptic) * relative.effective_radius().sqrt())
    };
    let told = force(one.principal, other.principal)?;
    let mut squares = 0.0;
    for (body, error) in [one.error, other.error].into_iter().enumerate() {
        for i in 0..2 {
            let mut largest = 0.0_f64;
            for by in [error, -error] {
                let mut bodies = [one.principal, other.principal];
                bodies[body][i] += by;
                largest = largest.max((force(bodies[0], bodies[1])? / told - 1.0).abs());
            }
            squares += largest * largest;
        }
    }
    Ok(squares.sqrt())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_force_of_a_sphere_goes_with_the_root_of_its_radius() {
        let sphere = |error: f64| Curved {
            principal: [0.5; 2],
            error,
        };
        // F ~ (k1 k2)^(-1/4): each curvature counts a quarter of its relative error.
        let found = force_error(&sphere(0.005), &Curved::PLANE, 0.0).unwrap();
        assert!(
            (found / (0.01 * 0.25 * 2.0_f64.sqrt()) - 1.0).abs() < 0.02,
            "{found}"
        );
        // Two of them: curvatures add, so each counts half as much, and there are twice as many.
        let pair = force_error(&sphere(0.005), &sphere(0.005), 0.0).unwrap();
        assert!(
            (pair / (found / 2.0_f64.sqrt()) - 1.0).abs() < 0.02,
            "{pair}"
        );
        assert_eq!(force_error(&sphere(0.0), &Curved::PLANE, 0.3), Ok(0.0));
        assert!(force_error(&sphere(0.6), &Curved::PLANE, 0.0).is_err());
    }
}
