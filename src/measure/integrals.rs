//! Area, volume and inertia of a star-shaped surface, to a tolerance.
//!
//! Adaptive product Gauss quadrature over rectangles in (polar angle, azimuth). The sphere starts
//! as eight octants, or as the pieces a surface is made of. Each rectangle is integrated by two
//! rules, and their difference is taken as the error of the finer one: a pessimistic estimate on a
//! smooth surface. A rectangle is done when its error is within its share, by solid angle, of the
//! tolerance, so the errors add up to at most the tolerance; else it is cut in four.

use super::{MassProperties, Moments};
use crate::model::{Ray, StarSurface, Stretch};
use crate::sphere::{AngleRectangle, GaussLegendre};
use nalgebra::{Point3, Vector3};
use std::f64::consts::{FRAC_PI_2, PI};

/// Surface evaluations after which [`integrate`] stops and returns what it has.
pub const MAX_EVALUATIONS: usize = 4_000_000;

/// Gauss nodes per side of a rectangle: of the rule, and of the one that it is checked with.
pub(super) const ORDERS: [usize; 2] = [12, 10];

/// What [`integrate`] found, and how well.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Integrals {
    /// Area, volume, centroid and inertia, in the surface's own frame.
    pub properties: MassProperties,
    /// Mean radius over all directions, (1/4 pi) ∫ r dΩ.
    pub mean_radius: f64,
    /// Estimated error, an upper bound on smooth surfaces: the largest of those of the mean radius
    /// R, the area and the volume V, each relative to itself, of the first moments relative to V R
    /// and of the second moments relative to V R². Above the tolerance when [`MAX_EVALUATIONS`] did
    /// not suffice, not finite when the surface is not.
    pub relative_error: f64,
    /// Evaluations of the surface.
    pub evaluations: usize,
}

/// Integrates a surface to a relative tolerance, see [`Integrals::relative_error`].
///
/// Rounding limits what can be reached to some 1e-14. A surface that is not smooth costs more and
/// may end above the tolerance; the result says so.
pub fn integrate(surface: &(impl StarSurface + ?Sized), tolerance: f64) -> Integrals {
    integrate_octants(surface, &Stretch::NONE, tolerance)
}

/// The same of the body that is this one once stretched.
pub(super) fn integrate_octants(
    surface: &(impl StarSurface + ?Sized),
    stretch: &Stretch,
    tolerance: f64,
) -> Integrals {
    integrate_pieces(octants(), stretch, ORDERS, tolerance, |_, directions| {
        directions
            .iter()
            .map(|n| surface.radius_and_gradient(n))
            .collect()
    })
}

/// The eight octants.
pub(super) fn octants() -> Vec<AngleRectangle> {
    (0..8)
        .map(|i| {
            let (polar, azimuth) = ((i / 4) as f64 * FRAC_PI_2, (i % 4) as f64 * FRAC_PI_2);
            AngleRectangle {
                theta: [polar, polar + FRAC_PI_2],
                phi: [azimuth, azimuth + FRAC_PI_2],
            }
        })
        .collect()
}

/// A part of the sphere that can be integrated over and cut in four.
pub(crate) trait Piece: Sized {
    /// The nodes of a product of two Gauss rules: unit vectors, and their weights in solid angle.
    fn nodes(&self, rule: &GaussLegendre) -> Vec<(Vector3<f64>, f64)>;
    /// Solid angle.
    fn solid_angle(&self) -> f64;
    /// Four pieces that make it.
    fn quarters(&self) -> [Self; 4];
}

impl Piece for AngleRectangle {
    fn nodes(&self, rule: &GaussLegendre) -> Vec<(Vector3<f64>, f64)> {
        self.nodes(rule, rule)
    }

    fn solid_angle(&self) -> f64 {
        self.solid_angle()
    }

    fn quarters(&self) -> [Self; 4] {
        self.quarters()
    }
}

/// Integrates a surface over pieces that tile the sphere, with Gauss rules of the given two orders; as
/// [`integrate`]. Pieces and evaluations are those of the surface once stretched, integrals those of the
/// surface itself. `evaluate` gives radius and surface gradient in many directions at once: as many,
/// piece by piece, for each of the pieces given to it.
pub(crate) fn integrate_pieces<P: Piece>(
    pieces: Vec<P>,
    stretch: &Stretch,
    orders: [usize; 2],
    tolerance: f64,
    evaluate: impl Fn(&[P], &[Vector3<f64>]) -> Vec<(f64, Vector3<f64>)>,
) -> Integrals {
    let rules = orders.map(GaussLegendre::new);
    let per_piece = orders[0] * orders[0] + orders[1] * orders[1];
    let mut total = Sums::default();
    let mut scale = None;
    let mut relative_error = 0.0;
    let mut evaluations = 0;
    let mut generation = pieces;
    while !generation.is_empty() {
        evaluations += generation.len() * per_piece;
        let sums = sums(&generation, stretch, &rules, &evaluate);
        let scale = scale.get_or_insert_with(|| {
            let all = |all, [sums, _]: &[Sums; 2]| all + *sums;
            sums.iter().fold(Sums::default(), all)
        });
        let mut next = Vec::new();
        for (piece, [sums, check]) in generation.into_iter().zip(sums) {
            let error = sums.difference(&check, scale);
            let share = piece.solid_angle() / (4.0 * PI);
            let is_settled = error <= tolerance * share || error.is_nan();
            if is_settled || evaluations + (next.len() + 4) * per_piece > MAX_EVALUATIONS {
                total = total + sums;
                relative_error += error;
            } else {
                next.extend(piece.quarters());
            }
        }
        generation = next;
    }
    total.integrals(relative_error, evaluations)
}

/// The integrals over each piece by both rules.
fn sums<P: Piece>(
    pieces: &[P],
    stretch: &Stretch,
    rules: &[GaussLegendre; 2],
    evaluate: impl Fn(&[P], &[Vector3<f64>]) -> Vec<(f64, Vector3<f64>)>,
) -> Vec<[Sums; 2]> {
    let (mut directions, mut weights) = (Vec::new(), Vec::new());
    for piece in pieces {
        for rule in rules {
            for (direction, weight) in piece.nodes(rule) {
                directions.push(direction);
                weights.push(weight);
            }
        }
    }
    let values = evaluate(pieces, &directions);
    let mut nodes = directions.iter().zip(weights).zip(values);
    let orders = [0, 1].map(|i| rules[i].nodes().len());
    pieces
        .iter()
        .map(|_| {
            orders.map(|order| {
                let mut sums = Sums::default();
                for ((n, solid_angle), (r, g)) in nodes.by_ref().take(order * order) {
                    sums.add_ray(&stretch.ray(Ray {
                        direction: *n,
                        solid_angle,
                        radius: r,
                        gradient: g,
                    }));
                }
                sums
            })
        })
        .collect()
}

/// The integrals over a part of the sphere.
#[derive(Clone, Copy, Default)]
pub(super) struct Sums {
    /// ∫ r dΩ.
    radius: f64,
    moments: Moments,
}

impl Sums {
    /// Adds one node of a quadrature.
    pub(super) fn add_ray(&mut self, ray: &Ray) {
        self.radius += ray.radius * ray.solid_angle;
        let Ray {
            direction, radius, ..
        } = ray;
        self.moments
            .add_ray(direction, *radius, &ray.gradient, ray.solid_angle);
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
        let length = scale.radius / (4.0 * PI);
        let volume = scale.moments.volume;
        let difference = self.moments - other.moments;
        [
            (self.radius - other.radius) / scale.radius,
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
            radius: self.radius + other.radius,
            moments: self.moments + other.moments,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::Derivatives;
    use crate::shapes::{Body, Ellipsoid, Sphere};
    use approx::{assert_abs_diff_eq, assert_relative_eq};
    use nalgebra::Matrix3;
    use proptest::prelude::*;

    fn ellipsoid(a: f64, b: f64, c: f64) -> Ellipsoid {
        Ellipsoid {
            semi_axes: Vector3::new(a, b, c),
        }
    }

    #[test]
    fn a_sphere_has_its_closed_form() {
        let found = integrate(&Sphere { radius: 5.0 }, 1e-12);
        let solid = found.properties;
        let volume = 4.0 / 3.0 * PI * 125.0;
        assert_relative_eq!(solid.area, 100.0 * PI, max_relative = 1e-13);
        assert_relative_eq!(solid.volume, volume, max_relative = 1e-13);
        assert_relative_eq!(found.mean_radius, 5.0, max_relative = 1e-13);
        assert_abs_diff_eq!(solid.centroid, Point3::origin(), epsilon = 1e-13);
        let inertia = Matrix3::identity() * (0.4 * volume * 25.0);
        assert_relative_eq!(solid.inertia, inertia, epsilon = 1e-9);
        assert!(found.relative_error < 1e-12);
    }

    #[test]
    fn the_oblate_ellipsoid_has_its_area() {
        // 2 pi a² (1 + (1 - e²)/e artanh(e)) with e² = 1 - c²/a².
        let e = 0.75_f64.sqrt();
        let area = 8.0 * PI * (1.0 + (1.0 - e * e) / e * e.atanh());
        assert_abs_diff_eq!(area, 34.68753, epsilon = 5e-6);
        let found = integrate(&ellipsoid(2.0, 2.0, 1.0), 1e-10);
        assert_relative_eq!(found.properties.area, area, max_relative = 1e-10);
        assert!(found.relative_error < 1e-10);
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(20))]
        #[test]
        fn ellipsoids_have_their_volume_and_inertia(
            a in 1.0..2.5_f64, b in 1.0..2.5_f64, c in 1.0..2.5_f64,
        ) {
            let found = integrate(&ellipsoid(a, b, c), 1e-10);
            let volume = 4.0 / 3.0 * PI * a * b * c;
            prop_assert!((found.properties.volume / volume - 1.0).abs() < 1e-10);
            let (x, y, z) = (a * a, b * b, c * c);
            let inertia = Matrix3::from_diagonal(&Vector3::new(y + z, z + x, x + y)) * (volume / 5.0);
            prop_assert!((found.properties.inertia - inertia).amax() < 1e-10 * inertia.amax());
        }
    }

    #[test]
    fn tightening_the_tolerance_moves_the_result_by_less_than_the_error() {
        for body in Body::SMOOTH {
            let surface = body.surface();
            let exact = integrate(surface.as_ref(), 1e-12).properties;
            for tolerance in [1e-3, 1e-6, 1e-9] {
                let found = integrate(surface.as_ref(), tolerance);
                assert!(found.relative_error <= tolerance);
                let error = (found.properties.area / exact.area - 1.0).abs();
                assert!(error <= found.relative_error + 1e-13, "{body}: {error:e}");
                let error = (found.properties.volume / exact.volume - 1.0).abs();
                assert!(error <= found.relative_error + 1e-13, "{body}: {error:e}");
            }
        }
    }

    /// A sphere with a step of the radius along a great circle that no cell follows.
    struct Step;

    impl StarSurface for Step {
        fn radius(&self, n: &Vector3<f64>) -> f64 {
            match n.dot(&Vector3::new(0.5, 0.3, 0.7)) > 0.0 {
                true => 2.0,
                false => 1.0,
            }
        }

        fn radius_and_gradient(&self, n: &Vector3<f64>) -> (f64, Vector3<f64>) {
            (self.radius(n), Vector3::zeros())
        }

        fn derivatives(&self, n: &Vector3<f64>) -> Derivatives {
            Sphere {
                radius: self.radius(n),
            }
            .derivatives(n)
        }
    }

    #[test]
    fn evaluations_are_bounded_and_the_shortfall_is_told() {
        let found = integrate(&Step, 1e-10);
        assert!(found.evaluations <= MAX_EVALUATIONS);
        assert!(found.relative_error > 1e-10);
        let volume = 2.0 * PI / 3.0 * (1.0 + 8.0);
        let error = (found.properties.volume / volume - 1.0).abs();
        assert!(error < found.relative_error.min(1e-3));
    }

    #[test]
    fn a_surface_that_is_not_finite_ends_at_once() {
        let found = integrate(&Sphere { radius: f64::NAN }, 1e-10);
        assert!(found.relative_error.is_nan());
        assert!(found.evaluations < 10_000);
    }
}
