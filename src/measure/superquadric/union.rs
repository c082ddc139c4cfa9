//! Mass properties of a union, from what is bare of the surface of each part.
//!
//! Patches of the parts' surfaces are cut in four, those of the largest errors first, until the errors add up to no
//! more than what is asked for.

use super::bare::bare;
use super::patch::Patch;
use super::single::{SolidProperties, superquadric_properties};
use crate::measure::Moments;
use crate::model::{MultiSuperquadric, Part};
use crate::sphere::GaussLegendre;
use nalgebra::Point3;
use std::cmp::Ordering;
use std::collections::BinaryHeap;

/// Gauss nodes along a side of a patch: of the rule, and of the one that it is checked with.
const ORDERS: [usize; 2] = [6, 5];

/// How often patches are cut before any errors are looked at: two rules may agree on a patch of which a corner that
/// neither has a node in is covered.
const FIRST_CUTS: usize = 3;

/// What no difference of two rules tells, as a share: covered places so small that neither has a line through them.
const UNSEEN: f64 = 1e-5;

/// Evaluations of a gauge after which patches are not cut any more.
const MAX_EVALUATIONS: usize = 4_000_000;

/// A patch of a part with its integrals.
struct Piece {
    part: usize,
    patch: Patch,
    sums: Moments,
    /// Differences of area, and of volume or moments, between two rules, as shares of the whole.
    errors: [f64; 2],
}

impl Piece {
    fn largest_error(&self) -> f64 {
        self.errors[0].max(self.errors[1])
    }
}

impl PartialEq for Piece {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other) == Ordering::Equal
    }
}

impl Eq for Piece {}

impl PartialOrd for Piece {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl Ord for Piece {
    fn cmp(&self, other: &Self) -> Ordering {
        self.largest_error().total_cmp(&other.largest_error())
    }
}

/// Mass properties of a union to a relative tolerance, and to 1e-5 at best; the errors found are told, and are above it where
/// that would take too long. Those of one part are closed forms.
pub fn union_properties(union: &MultiSuperquadric, tolerance: f64) -> SolidProperties {
    if let [Part { shape, frame }] = union.parts() {
        return superquadric_properties(shape).placed(frame);
    }
    let rules = ORDERS.map(GaussLegendre::new);
    let per_piece = (ORDERS[0].pow(2) + ORDERS[1].pow(2)) * union.parts().len();
    let size = union
        .parts()
        .iter()
        .map(|part| part.frame.centre.coords.norm() + part.shape.bounding_radius());
    let size = size.fold(0.0, f64::max);
    let measured = |part: usize, patch: Patch| {
        let [sums, check] = rules.each_ref().map(|rule| bare(union, part, &patch, rule));
        let difference = sums - check;
        let volume = [
            difference.volume.abs(),
            difference.first.amax() / size,
            difference.second.amax() / (size * size),
        ];
        Piece {
            part,
            patch,
            sums,
            errors: [
                difference.area.abs() / (size * size),
                volume.into_iter().fold(0.0, f64::max) / size.powi(3),
            ],
        }
    };
    let start = union.parts().iter().enumerate().flat_map(|(index, part)| {
        let patches = Patch::all(&part.shape).into_iter();
        patches.map(move |patch| (index, patch))
    });
    let mut start: Vec<(usize, Patch)> = start.collect();
    for _ in 0..FIRST_CUTS {
        let quarters =
            |(part, patch): &(usize, Patch)| patch.quarters().map(|quarter| (*part, quarter));
        start = start.iter().flat_map(quarters).collect();
    }
    let start = start.into_iter();
    let mut pieces: BinaryHeap<Piece> = start.map(|(part, patch)| measured(part, patch)).collect();
    let mut evaluations = per_piece * pieces.len();
    loop {
        // Rounding must not gather over many steps, so the sum is made anew now and then.
        let (sums, errors) = total(&pieces);
        let found = SolidProperties {
            properties: sums.about_centroid(&Point3::origin()),
            area_error: errors[0] * size * size / sums.area + UNSEEN,
            volume_error: errors[1] * size.powi(3) / sums.volume + UNSEEN,
        };
        let is_done = found.area_error.max(found.volume_error) <= tolerance + UNSEEN;
        // Written so that NaN ends.
        if is_done || !(found.volume_error.is_finite() && evaluations <= MAX_EVALUATIONS) {
            return found;
        }
        let worst = worst(&mut pieces, 0.5 * (errors[0] + errors[1]));
        evaluations += 4 * worst.len() * per_piece;
        for piece in worst {
            let quarters = piece.patch.quarters();
            pieces.extend(quarters.map(|quarter| measured(piece.part, quarter)));
        }
    }
}

/// Takes the pieces of the largest errors out that make so much of both errors.
fn worst(pieces: &mut BinaryHeap<Piece>, enough: f64) -> Vec<Piece> {
    let mut worst = Vec::new();
    let mut sum = 0.0;
    while sum < enough
        && let Some(piece) = pieces.pop()
    {
        sum += piece.errors[0] + piece.errors[1];
        worst.push(piece);
    }
    worst
}

/// The sums of all pieces, and of their errors.
fn total(pieces: &BinaryHeap<Piece>) -> (Moments, [f64; 2]) {
    let start = (Moments::default(), [0.0; 2]);
    pieces.iter().fold(start, |(sums, errors), piece| {
        let errors = [0, 1].map(|i| errors[i] + piece.errors[i]);
        (sums + piece.sums, errors)
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::measure::{grain_properties, superquadric_properties};
    use crate::model::{Frame, Part, Superquadric, SuperquadricGrain};
    use approx::assert_relative_eq;
    use nalgebra::{Matrix3, Rotation3};
    use std::f64::consts::PI;

    fn sphere_at(x: f64) -> Part {
        Part {
            shape: Superquadric::single([1.0; 3], 2.0, 2.0).unwrap(),
            frame: Frame {
                centre: Point3::new(x, 0.0, 0.0),
                axes: Rotation3::from_euler_angles(0.4, 1.0, -0.3).into_inner(),
            },
        }
    }

    #[test]
    fn two_spheres_make_a_lens_less_than_twice_one() {
        // Centres 2 d apart: either loses a cap of height h = 1 - d.
        let d = 0.4;
        let union = MultiSuperquadric::new(vec![sphere_at(-d), sphere_at(d)]).unwrap();
        let found = union_properties(&union, 1e-3);
        let h = 1.0 - d;
        let volume = 2.0 * (4.0 / 3.0 * PI - PI * h * h * (3.0 - h) / 3.0);
        let area = 2.0 * (4.0 * PI - 2.0 * PI * h);
        assert!(found.area_error.max(found.volume_error) <= 1e-3 + UNSEEN);
        assert_relative_eq!(
            found.properties.volume,
            volume,
            max_relative = found.volume_error
        );
        assert_relative_eq!(found.properties.area, area, max_relative = found.area_error);
        assert!(found.properties.centroid.coords.norm() < 1e-3);
        // About the line of centres: twice the whole sphere's 8 pi/15 less the cap's, ∫ pi/2 (1 - x²)² dx.
        let cap = |x: f64| x - 2.0 / 3.0 * x.powi(3) + x.powi(5) / 5.0;
        let spin = 2.0 * (8.0 / 15.0 * PI - 0.5 * PI * (cap(1.0) - cap(d)));
        assert_relative_eq!(found.properties.inertia[(0, 0)], spin, max_relative = 3e-3);
    }

    #[test]
    fn few_evaluations_tell_a_union_to_a_hundred_thousandth() {
        let d = 0.4;
        let union = MultiSuperquadric::new(vec![sphere_at(-d), sphere_at(d)]).unwrap();
        let found = union_properties(&union, 1e-5);
        let h = 1.0 - d;
        let volume = 2.0 * (4.0 / 3.0 * PI - PI * h * h * (3.0 - h) / 3.0);
        assert!(found.area_error.max(found.volume_error) <= 1e-5 + UNSEEN);
        assert_relative_eq!(found.properties.volume, volume, max_relative = 1e-5);
    }

    #[test]
    fn a_union_about_a_common_point_is_what_its_radius_has() {
        let part = |x: f64, angle: f64| Part {
            shape: Superquadric::single([3.0, 1.5, 1.8], 2.1, 2.4).unwrap(),
            frame: Frame {
                centre: Point3::new(x, 0.2, 0.0),
                axes: Rotation3::from_euler_angles(0.0, 0.0, angle).into_inner(),
            },
        };
        let union = MultiSuperquadric::new(vec![part(-0.5, 0.2), part(0.4, -0.15)]).unwrap();
        let found = union_properties(&union, 1e-3);
        let grain = SuperquadricGrain::multi(Frame::SCAN, union).unwrap();
        let expected = grain_properties(&grain).properties;
        let [area, volume] = [
            (found.properties.area, expected.area, found.area_error),
            (found.properties.volume, expected.volume, found.volume_error),
        ]
        .map(|(found, expected, told)| ((found / expected - 1.0).abs(), told));
        for (error, told) in [area, volume] {
            // Surfaces that nearly coincide take more than is allowed; what is told says so.
            assert!(told <= 3e-3 && error <= told, "{error:e} {told:e}");
        }
    }

    #[test]
    fn one_part_and_the_same_part_twice_are_that_part() {
        let part = Part {
            shape: Superquadric::single([2.0, 1.5, 1.0], 3.0, 4.0).unwrap(),
            frame: Frame {
                centre: Point3::origin(),
                axes: Matrix3::identity(),
            },
        };
        let expected = superquadric_properties(&part.shape).properties;
        for parts in [vec![part], vec![part, part]] {
            let union = MultiSuperquadric::new(parts).unwrap();
            let found = union_properties(&union, 1e-6).properties;
            assert_relative_eq!(found.volume, expected.volume, max_relative = 1e-6);
            assert_relative_eq!(found.area, expected.area, max_relative = 1e-6);
            assert_relative_eq!(found.inertia, expected.inertia, epsilon = 1e-4);
        }
    }
}
