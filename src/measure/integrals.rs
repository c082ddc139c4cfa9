//! Area, volume and inertia of a surface, to a tolerance.
//!
//! Adaptive product Gauss quadrature over the pieces of the sphere on which the surface is smooth. Each piece is
//! integrated by two rules, and their difference is taken as the error of the finer one: a pessimistic
//! estimate on a smooth surface. A piece is done when its error is within its share, by solid angle, of the
//! tolerance, so the errors add up to at most the tolerance; else it is cut in four.

pub(super) mod elements;
pub(super) mod four_triangles;
pub(super) mod mass;
pub(super) mod mesh;
pub(super) mod nodes;
pub(super) mod rings;
pub(super) mod sums;

use super::MassProperties;
use crate::model::{Node, Parts, Piece, Radial, StarSurface, Surface, Tiling};
use crate::sphere::{GaussLegendre, Symmetry};
use rings::integrate_rings;
use std::f64::consts::PI;
use sums::{Integrals, MAX_EVALUATIONS, Sums};

/// What rounding lets be reached.
const LEAST_TOLERANCE: f64 = 1e-14;

/// Integrates a star-shaped surface, in its own frame, to a relative tolerance, see [`Integrals::relative_error`].
///
/// Rounding limits what can be reached to some 1e-14, which is taken for all below it and for NaN. A surface that is not smooth within the octants costs more and
/// may end above the tolerance; the result says so.
pub fn integrate(surface: &(impl StarSurface + ?Sized), tolerance: f64) -> Integrals {
    // The larger of NaN and a number is the number.
    let tolerance = tolerance.max(LEAST_TOLERANCE);
    integrals(&Radial(surface), &Tiling::octants(), tolerance)
}

/// Area, volume, centroid and inertia of a grain, in the scan's frame, on the pieces on which it is smooth.
///
/// Of a blended surface: of the joined surface itself, to 3e-6 at worst and 1e-7 as a rule.
///
/// Of independent segments: segment by segment, so the steps between them do no harm; volume and
/// moments are those of the solid below the expansions, and the area is that of the expansions, without
/// the walls of the steps. There the radius cubed and to the fifth power are polynomials in the
/// direction, so volume, centroid and inertia are exact to rounding (1e-13); the area is adaptive, to
/// 1e-9.
///
/// Of a mirrored surface: octant by octant, so its edges lie between them, to 1e-9. What vanishes by symmetry is
/// zero, so that axes normal to the mirrors are principal axes even where moments are equal.
///
/// Of one expansion of the whole sphere: ring by ring, volume and moments likewise exact to rounding, the
/// area to 1e-9.
///
/// All of them are taken in the stretched space of a grain that is
/// [stretched](crate::model::StarGrain::stretched), where its volume and moments are polynomials too.
pub fn grain_properties(surface: &(impl Surface + ?Sized)) -> Integrals {
    let tiling = surface.tiling();
    let local = integrals(surface, &tiling, tiling.tolerance);
    let frame = surface.frame();
    Integrals {
        properties: MassProperties {
            centroid: frame.to_scan(&local.properties.centroid.coords),
            inertia: frame.axes * local.properties.inertia * frame.axes.transpose(),
            ..local.properties
        },
        ..local
    }
}

/// The integrals over the parts of a tiling, along the surface's own axes.
fn integrals(surface: &(impl Surface + ?Sized), tiling: &Tiling, tolerance: f64) -> Integrals {
    let found = match &tiling.parts {
        Parts::Sphere { degree } => integrate_rings(surface, *degree, tolerance),
        Parts::Pieces { pieces, orders, .. } => {
            integrate_pieces(surface, pieces.clone(), *orders, tolerance)
        }
    };
    found.with_mirrors(&tiling.mirrors)
}

/// Integrates over pieces that tile the sphere, with Gauss rules of the given two orders.
fn integrate_pieces(
    surface: &(impl Surface + ?Sized),
    pieces: Vec<Piece>,
    orders: [usize; 2],
    tolerance: f64,
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
        let sums = sums(surface, &generation, &rules);
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
fn sums(
    surface: &(impl Surface + ?Sized),
    pieces: &[Piece],
    rules: &[GaussLegendre; 2],
) -> Vec<[Sums; 2]> {
    let by_rules = |piece: &Piece| rules.each_ref().map(|rule| piece.nodes(rule));
    let nodes: Vec<Node> = pieces.iter().flat_map(by_rules).flatten().collect();
    let mut elements = surface.elements(&nodes).into_iter();
    let orders = rules.each_ref().map(|rule| rule.len());
    let mut of_rule = |order: usize| Sums::of(elements.by_ref().take(order * order));
    pieces.iter().map(|_| orders.map(&mut of_rule)).collect()
}

impl Integrals {
    /// Those of a body that is mirrored in these planes.
    fn with_mirrors(mut self, mirrors: &Symmetry) -> Self {
        let MassProperties {
            centroid, inertia, ..
        } = &mut self.properties;
        for axis in mirrors.normals() {
            centroid[axis] = 0.0;
            for other in (0..3).filter(|&other| other != axis) {
                inertia[(axis, other)] = 0.0;
                inertia[(other, axis)] = 0.0;
            }
        }
        self
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::Derivatives;
    use crate::shapes::{Body, Ellipsoid, Sphere};
    use approx::{assert_abs_diff_eq, assert_relative_eq};
    use nalgebra::Point3;
    use nalgebra::{Matrix3, Vector3};
    use proptest::prelude::*;

    fn ellipsoid(a: f64, b: f64, c: f64) -> Ellipsoid {
        Ellipsoid {
            semi_axes: Vector3::new(a, b, c),
        }
    }

    #[test]
    fn no_tolerance_is_the_least_that_can_be_reached() {
        let body = ellipsoid(3.0, 2.0, 1.0);
        let least = integrate(&body, LEAST_TOLERANCE);
        for none in [0.0, -1.0, f64::NAN] {
            assert_eq!(integrate(&body, none), least);
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
