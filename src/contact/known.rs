//! What is known of a contact whose surfaces have errors: whether they tell a force, and how far figures of it are off.

use super::{ContactError, Correction, RelativeCurvature};
use crate::measure::Curvature;
use crate::model::LocalError;

/// The principal curvatures of a body where it is touched, in one over length.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Curved {
    /// Principal curvatures, positive where convex.
    pub principal: [f64; 2],
    /// Standard error of the curvature tensor, where it is known; zero of a plane.
    pub error: Option<f64>,
}

impl Curved {
    /// A plane.
    pub const PLANE: Self = Self {
        principal: [0.0; 2],
        error: Some(0.0),
    };
}

/// A contact by the theory of Hertz that the errors of its surfaces leave.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct KnownContact {
    bodies: [Curved; 2],
    angle_rad: f64,
    relative: RelativeCurvature,
}

/// What is less than so many of its standard errors is not told from nothing.
pub const TOLD: f64 = 2.0;

impl KnownContact {
    /// That of two bodies, their first principal directions at `angle_rad` to each other. Errors that are not known are
    /// not asked for.
    ///
    /// # Errors
    ///
    /// See [`RelativeCurvature::new`]; [`ContactError::Uncertain`] where the surfaces may be flat.
    pub fn new(one: Curved, other: Curved, angle_rad: f64) -> Result<Self, ContactError> {
        let relative = RelativeCurvature::new(one.principal, other.principal, angle_rad)?;
        let curvature = 2.0 * relative.smaller();
        let error = one
            .error
            .unwrap_or_default()
            .hypot(other.error.unwrap_or_default());
        if curvature < TOLD * error {
            return Err(ContactError::Uncertain { curvature, error });
        }
        Ok(Self {
            bodies: [one, other],
            angle_rad,
            relative,
        })
    }

    /// That of two surfaces at the points that lie deepest in each other.
    ///
    /// # Errors
    ///
    /// See [`Self::new`].
    pub fn at(
        [one, two]: &[Curvature; 2],
        errors: Option<&[LocalError; 2]>,
    ) -> Result<Self, ContactError> {
        let along = one.directions[0].dot(&two.directions[0]);
        let [first, second] = [(one, 0), (two, 1)].map(|(curvature, side)| Curved {
            principal: curvature.principal,
            error: errors.map(|errors| errors[side].curvature),
        });
        Self::new(first, second, along.clamp(-1.0, 1.0).acos())
    }

    /// The relative curvature.
    pub fn relative(&self) -> &RelativeCurvature {
        &self.relative
    }

    /// How many times the force of Hertz is that curvatures of both bodies tell, each along its own principal directions, but
    /// not in the middle of the contact: such as those over all of it.
    ///
    /// # Errors
    ///
    /// See [`RelativeCurvature::new`].
    pub fn times(&self, [one, other]: [[f64; 2]; 2]) -> Result<f64, ContactError> {
        let over = RelativeCurvature::new(one, other, self.angle_rad)?;
        Ok(force(&over) / force(&self.relative))
    }

    /// Standard error of a figure of the relative curvature, as a share of it, where those of both bodies are known: by how
    /// much it changes when each principal curvature is off by its error, up or down, whichever is more. Changes of
    /// different curvatures are added as squares: the error of a body's tensor holds those of both.
    pub fn share(&self, figure: impl Fn(&RelativeCurvature) -> f64) -> Option<f64> {
        let told = figure(&self.relative);
        let mut squares = 0.0;
        for (body, own) in self.bodies.iter().enumerate() {
            let error = own.error?;
            for i in 0..2 {
                let mut largest = 0.0_f64;
                for by in [error, -error] {
                    let mut principal = self.bodies.map(|body| body.principal);
                    principal[body][i] += by;
                    let [one, other] = principal;
                    let off = RelativeCurvature::new(one, other, self.angle_rad).ok()?;
                    largest = largest.max((figure(&off) / told - 1.0).abs());
                }
                squares += largest * largest;
            }
        }
        Some(squares.sqrt())
    }

    /// Standard error of the normal force by Hertz, as a share of it, at a depth with its own error, where all are known.
    pub fn force_share(&self, depth: f64, depth_error: Option<f64>) -> Option<f64> {
        Some(self.share(force)?.hypot(1.5 * depth_error? / depth))
    }
}

/// What forces of the same indentation are proportional to.
fn force(relative: &RelativeCurvature) -> f64 {
    relative.correction(Correction::Elliptic) * relative.effective_radius().sqrt()
}

/// Refuses a depth that its standard error does not tell from none.
///
/// # Errors
///
/// [`ContactError::Shallow`]
pub fn told_depth(depth: f64, error: Option<f64>) -> Result<(), ContactError> {
    match error {
        Some(error) if depth < TOLD * error => Err(ContactError::Shallow { depth, error }),
        _ => Ok(()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn sphere(error: f64) -> Curved {
        Curved {
            principal: [0.5; 2],
            error: Some(error),
        }
    }

    fn force_share(one: Curved, other: Curved, depth_error: f64) -> f64 {
        let known = KnownContact::new(one, other, 0.0).unwrap();
        known.force_share(0.1, Some(depth_error)).unwrap()
    }

    #[test]
    fn the_force_of_a_sphere_goes_with_the_root_of_its_radius() {
        // F ~ (k1 k2)^(-1/4): each curvature counts a quarter of its relative error.
        let found = force_share(sphere(0.005), Curved::PLANE, 0.0);
        let expected = 0.01 * 0.25 * 2.0_f64.sqrt();
        assert!((found / expected - 1.0).abs() < 0.02, "{found}");
        // Two of them: curvatures add, so each counts half as much, and there are twice as many.
        let pair = force_share(sphere(0.005), sphere(0.005), 0.0);
        assert!(
            (pair / (found / 2.0_f64.sqrt()) - 1.0).abs() < 0.02,
            "{pair}"
        );
        assert_eq!(force_share(sphere(0.0), Curved::PLANE, 0.0), 0.0);
    }

    #[test]
    fn the_force_goes_with_the_depth_to_the_power_of_a_half_and_one() {
        let found = force_share(sphere(0.0), sphere(0.0), 0.001);
        assert!((found - 0.015).abs() < 1e-12, "{found}");
        let both = force_share(sphere(0.005), Curved::PLANE, 0.001);
        let alone = force_share(sphere(0.005), Curved::PLANE, 0.0);
        assert!((both - alone.hypot(0.015)).abs() < 1e-12, "{both}");
    }

    #[test]
    fn an_error_that_is_not_known_gives_none() {
        let unknown = Curved {
            error: None,
            ..sphere(0.0)
        };
        let known = KnownContact::new(unknown, sphere(0.0), 0.0).unwrap();
        assert_eq!(known.force_share(0.1, Some(0.0)), None);
        let known = KnownContact::new(sphere(0.0), sphere(0.0), 0.0).unwrap();
        assert_eq!(known.force_share(0.1, None), None);
    }

    #[test]
    fn what_may_be_flat_or_apart_has_no_force() {
        let refused = |error: f64| KnownContact::new(sphere(error), Curved::PLANE, 0.0).is_err();
        assert!(!refused(0.24) && refused(0.26));
        // Two spheres are told apart from flat ones at errors that are larger by the root of two.
        let refused = |error: f64| KnownContact::new(sphere(error), sphere(error), 0.0).is_err();
        assert!(!refused(0.35) && refused(0.36));
        assert_eq!(told_depth(0.1, Some(0.049)), Ok(()));
        assert_eq!(told_depth(0.1, None), Ok(()));
        assert!(told_depth(0.1, Some(0.051)).is_err());
    }
}
