//! What is known of a contact whose surfaces have errors: whether they tell a force, and how far figures of it are off.

use super::{ContactError, Correction, RelativeCurvature};
use crate::measure::Curvature;
use crate::model::LocalError;
use nalgebra::{Matrix2, Rotation2, Vector2};
use std::f64::consts::TAU;

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
        let [cos, sin] = one.directions.map(|along| along.dot(&two.directions[0]));
        let [first, second] = [(one, 0), (two, 1)].map(|(curvature, side)| Curved {
            principal: curvature.principal,
            error: errors.map(|errors| errors[side].curvature),
        });
        Self::new(first, second, sin.atan2(cos))
    }

    /// The relative curvature.
    pub fn relative(&self) -> &RelativeCurvature {
        &self.relative
    }

    /// How many times the force of Hertz is that of an indentation by the gap over all of the contact, and not by its curvature
    /// in the middle: that of an elliptic paraboloid. At the size of the patch the gap and the paraboloid are as far open round
    /// areas of the same second moments.
    ///
    /// `gap`: curvature of the gap, from the contact to so far aside of it along the principal directions of the first body. The
    /// force is known to 5 % of gaps that open as a power from 1.5 to 8 of the distance, and to 3 % of ones that are curved up to a
    /// hundred times as much on one side as on the other.
    ///
    /// # Errors
    ///
    /// [`ContactError`] where the gap does not open to all sides.
    pub fn times(
        &self,
        indentation: f64,
        gap: impl Fn(&Vector2<f64>) -> f64,
    ) -> Result<f64, ContactError> {
        let mut form = self.form();
        let mut least = f64::INFINITY;
        for _ in 0..ROUNDS {
            let root = of_eigenvalues(&form, f64::sqrt);
            let Some(inverse) = root.try_inverse() else {
                break;
            };
            // Where the gap is as far open as the form has it one away from the contact, in the plane that makes it round.
            let mut rim = Rim::default();
            least = f64::INFINITY;
            for i in 0..AROUND {
                let angle = TAU * f64::from(i) / f64::from(AROUND);
                let towards = Vector2::new(angle.cos(), angle.sin());
                let aside = inverse * towards;
                let bent = 0.5 * gap(&(aside * (PATCH * indentation.sqrt())));
                least = least.min(bent);
                rim.add(towards, bent * aside.norm_squared());
            }
            let Some(open) = rim.form() else { break };
            if (open - Matrix2::identity()).amax() < NEAR {
                break;
            }
            form = root * of_eigenvalues(&open, |open| open.powf(DAMPED)) * root;
        }
        let [one, other] = form.symmetric_eigenvalues().into();
        if least <= 0.0 {
            return Err(ContactError::NotConvex {
                larger: one.max(other),
                smaller: least,
            });
        }
        let over = RelativeCurvature::new([2.0 * one, 2.0 * other], [0.0; 2], 0.0)?;
        Ok(force(&over) / force(&self.relative))
    }

    /// The gap between the surfaces as a quadratic form of the way aside, along the principal directions of the first.
    fn form(&self) -> Matrix2<f64> {
        let [one, other] = self
            .bodies
            .map(|body| Matrix2::from_diagonal(&body.principal.into()));
        let turn = Rotation2::new(self.angle_rad);
        0.5 * (one + turn.matrix() * other * turn.matrix().transpose())
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

/// The share of how far an overlap reaches at which the gap is looked at: a little inside the patch of Hertz, which ends at .71.
/// That of gaps that open as the distance to the power of 1.5, 4 and 6 it would take .64, .57 and .55 to tell the force.
const PATCH: f64 = 0.57;

/// Ways round at which it is looked at.
const AROUND: u32 = 16;

/// Rounds at most, and by what share the gap may differ when they end.
const ROUNDS: usize = 40;
const NEAR: f64 = 1e-3;

/// A round changes the form by this power of how far the gap is open, so that steep gaps do not go to and fro.
const DAMPED: f64 = 0.3;

/// How far open a gap counts as at least: a sixteenth of what is expected.
const LEAST_OPEN: f64 = 1.0 / 16.0;

/// What lies within a closed line, seen from a point in it at evenly spaced angles: a contact moves to where the gap is less open.
#[derive(Default)]
struct Rim {
    area: f64,
    /// Its first and second moments.
    first: Vector2<f64>,
    second: Matrix2<f64>,
}

impl Rim {
    /// Adds where a gap of a parabola is one open that is `open` at a distance of one.
    fn add(&mut self, towards: Vector2<f64>, open: f64) {
        let distance = open.max(LEAST_OPEN).sqrt().recip();
        self.area += distance.powi(2) / 2.0;
        self.first += towards * (distance.powi(3) / 3.0);
        self.second += towards * towards.transpose() * (distance.powi(4) / 4.0);
    }

    /// The form that is one on the ellipse of the same second moments about the middle.
    fn form(&self) -> Option<Matrix2<f64>> {
        let middle = self.first / self.area;
        (4.0 * (self.second / self.area - middle * middle.transpose())).try_inverse()
    }
}

/// A symmetric matrix with a function of its eigenvalues in their places.
fn of_eigenvalues(matrix: &Matrix2<f64>, function: impl Fn(f64) -> f64) -> Matrix2<f64> {
    let eigen = matrix.symmetric_eigen();
    let values = eigen.eigenvalues.map(function);
    eigen.eigenvectors * Matrix2::from_diagonal(&values) * eigen.eigenvectors.transpose()
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
    use crate::model::{Radial, Surface};
    use crate::shapes::Ellipsoid;
    use nalgebra::{Rotation3, Vector3};
    use std::f64::consts::PI;

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
    fn surfaces_that_are_turned_to_each_other_are_known_as_such() {
        let ellipsoid = Ellipsoid {
            semi_axes: Vector3::new(3.0, 2.0, 1.0),
        };
        let up = Vector3::z();
        let one = Curvature::new(&up, &Radial(&ellipsoid).jet(&up));
        for angle in [0.4, -0.4, 1.3] {
            let turn = Rotation3::from_axis_angle(&Vector3::z_axis(), angle);
            let mut two = one;
            two.directions = one.directions.map(|along| turn * along);
            let known = KnownContact::at(&[one, two], None).unwrap();
            let expected = RelativeCurvature::new(one.principal, one.principal, angle).unwrap();
            let off = known.relative().larger() / expected.larger() - 1.0;
            assert!(off.abs() < 1e-12, "{angle}: {off}");
        }
    }

    /// The force of a gap c r^n about an axis at an indentation, over E* (Sneddon 1965).
    fn of_power(c: f64, n: f64, indentation: f64) -> f64 {
        let gamma = |x: f64| libm::tgamma(x);
        let by_radius = c * n * 0.5 * PI.sqrt() * gamma(0.5 * n) / gamma(0.5 * (n + 1.0));
        let radius = (indentation / by_radius).powf(1.0 / n);
        2.0 * indentation * radius * n / (n + 1.0)
    }

    #[test]
    fn gaps_that_open_as_a_power_have_the_force_of_sneddon() {
        let known = KnownContact::new(sphere(0.0), Curved::PLANE, 0.0).unwrap();
        for n in [1.5, 2.0, 3.0, 4.0, 6.0, 8.0] {
            for (c, indentation) in [(0.1, 1e-3), (30.0, 1e-4)] {
                let gap = |aside: &Vector2<f64>| 2.0 * c * aside.norm().powf(n - 2.0);
                let hertz = known
                    .relative()
                    .force_factor(Correction::Elliptic, indentation, 1.0);
                let found = hertz * known.times(indentation, gap).unwrap();
                let off = found / of_power(c, n, indentation) - 1.0;
                let bound = if n == 2.0 { 1e-3 } else { 0.05 };
                assert!(off.abs() < bound, "{n} {c}: {off}");
            }
        }
    }

    /// Of two cylinders that cross at an angle the gap is that of their middle all over.
    #[test]
    fn a_gap_that_is_curved_alike_all_over_changes_nothing() {
        let cylinder = |k: f64| Curved {
            principal: [k, 0.01],
            error: None,
        };
        for angle in [0.0, 0.4, -1.1] {
            let known = KnownContact::new(cylinder(0.5), cylinder(2.0), angle).unwrap();
            let gap = |aside: &Vector2<f64>| {
                2.0 * aside.dot(&(known.form() * aside)) / aside.norm_squared()
            };
            let times = known.times(0.01, gap).unwrap();
            assert!((times - 1.0).abs() < 1e-12, "{angle}: {times}");
            let [larger, smaller] = known.form().symmetric_eigenvalues().into();
            let relative = known.relative();
            assert!((larger.max(smaller) / relative.larger() - 1.0).abs() < 1e-12);
        }
    }

    /// Forces of gaps x² / 2 of one side and k x² / 2 of the other, with m y² / 2, by boundary elements.
    #[test]
    fn a_gap_may_be_curved_more_on_one_side_than_on_the_other() {
        let known = KnownContact::new(sphere(0.0), Curved::PLANE, 0.0).unwrap();
        for (k, m, expected) in [
            (4.0, 1.0, 1.1690e-3),
            (100.0, 1.0, 1.0539e-3),
            (16.0, 0.25, 1.6819e-3),
            (16.0, 4.0, 7.628e-4),
        ] {
            let gap = |aside: &Vector2<f64>| {
                let along = if aside.x > 0.0 { k } else { 1.0 };
                aside.dot(&Vector2::new(along * aside.x, m * aside.y)) / aside.norm_squared()
            };
            let hertz = known
                .relative()
                .force_factor(Correction::Elliptic, 0.01, 1.0);
            let found = hertz * known.times(0.01, gap).unwrap();
            assert!((found / expected - 1.0).abs() < 0.03, "{k} {m}: {found}");
        }
    }

    #[test]
    fn a_gap_that_closes_beside_its_middle_has_no_force() {
        let known = KnownContact::new(sphere(0.0), Curved::PLANE, 0.0).unwrap();
        let gap = |aside: &Vector2<f64>| aside.x / aside.norm() - 0.5;
        assert!(known.times(0.01, gap).is_err());
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
