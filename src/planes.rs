//! The place that is deepest below planes: a linear programme in four unknowns. The crate microlp took forty times as long
//! for a dozen of them.

use nalgebra::{Matrix4, Vector3, Vector4};

/// A plane: n.x = height, with the unit normal n to the side above it.
pub(crate) struct Plane {
    pub(crate) normal: Vector3<f64>,
    pub(crate) height: f64,
}

/// Exchanges of a constraint, at most; five to twenty are usual.
const EXCHANGES: usize = 500;

/// How far a constraint may be missed, relative to a depth of one.
const MET: f64 = 1e-12;

/// How much more a place farther along x, y and z is wanted, so that no two are equally good and the search never comes
/// back to where it was.
const LEAN: [f64; 3] = [1e-11, 2e-11, 3e-11];

/// The least share of a constraint in the one that takes its place.
const LEAST_SHARE: f64 = 1e-10;

/// The place c, with coordinates between -`reach` and `reach`, from which the depth t, at most one, below the planes is
/// largest, and this depth: of all c and t with n.c + t <= height. It is below zero where no place is below all planes.
///
/// By the dual simplex method: the place is where four constraints meet, at first three sides of the cube and t = 1; the
/// one that is missed most takes the place of one of these, and the depth falls, until none is missed.
pub(crate) fn deepest_below(planes: &[Plane], reach: f64) -> (Vector3<f64>, f64) {
    let [x, y, z, depth] = [0, 1, 2, 3].map(|i| Vector4::ith(i, 1.0));
    let limits = [x, y, z, -x, -y, -z].map(|side| (side, reach));
    let planes = planes
        .iter()
        .map(|plane| (plane.normal.push(1.0), plane.height));
    let constraints: Vec<_> = limits
        .into_iter()
        .chain([(depth, 1.0)])
        .chain(planes)
        .collect();
    let wanted = Vector3::from(LEAN).push(1.0);
    let mut met = [0, 1, 2, 6];
    let mut found = Vector4::zeros();
    for _ in 0..EXCHANGES {
        let rows = met.map(|i| constraints[i].0.transpose());
        let Some(inverse) = Matrix4::from_rows(&rows).try_inverse() else {
            break;
        };
        found = inverse * Vector4::from(met.map(|i| constraints[i].1));
        let others = constraints
            .iter()
            .enumerate()
            .filter(|(i, _)| !met.contains(i));
        let missed = others.map(|(i, (row, most))| (row.dot(&found) - most, i));
        let Some((_, next)) = missed
            .max_by(|one, other| one.0.total_cmp(&other.0))
            .filter(|(by, _)| *by > MET)
        else {
            break;
        };
        let (prices, shares) = (
            inverse.tr_mul(&wanted),
            inverse.tr_mul(&constraints[next].0),
        );
        let leaving = (0..4).filter(|&i| shares[i] > LEAST_SHARE);
        let price = |&i: &usize| prices[i] / shares[i];
        let Some(cheapest) = leaving.min_by(|one, other| price(one).total_cmp(&price(other)))
        else {
            break;
        };
        met[cheapest] = next;
    }
    (found.xyz(), found.w)
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;
    use proptest::prelude::*;

    fn plane(normal: [f64; 3], height: f64) -> Plane {
        let normal = Vector3::from(normal).normalize();
        Plane { normal, height }
    }

    #[test]
    fn the_deepest_place_of_a_tetrahedron_is_its_incentre() {
        let diagonal = 1.0 / 3.0_f64.sqrt();
        let sides = [[-1.0, 0.0, 0.0], [0.0, -1.0, 0.0], [0.0, 0.0, -1.0]];
        let mut planes: Vec<Plane> = sides.map(|side| plane(side, 0.0)).into();
        planes.push(plane([1.0; 3], diagonal));
        let (place, depth) = deepest_below(&planes, 1.0);
        // r = 3 V / S of the tetrahedron with three edges of one at right angles.
        let radius = 0.5 / (1.5 + 0.75_f64.sqrt());
        assert_relative_eq!(place, Vector3::repeat(radius), epsilon = 1e-12);
        assert_relative_eq!(depth, radius, epsilon = 1e-12);
    }

    #[test]
    fn limits_hold_where_planes_leave_room_and_without_planes() {
        assert_eq!(deepest_below(&[], 0.5).1, 1.0);
        let (place, depth) = deepest_below(&[plane([1.0, 0.0, 0.0], 0.1)], 0.5);
        assert_relative_eq!(place.x, -0.5, epsilon = 1e-12);
        assert_relative_eq!(depth, 0.6, epsilon = 1e-12);
        let apart = [plane([0.0, 0.0, 1.0], -0.2), plane([0.0, 0.0, -1.0], -0.4)];
        assert_relative_eq!(deepest_below(&apart, 1.0).1, -0.3, epsilon = 1e-10);
    }

    proptest! {
        #[test]
        fn the_place_is_below_all_planes_and_no_other_is_deeper(
            planes in prop::collection::vec((prop::array::uniform3(-1.0..1.0_f64), 0.0..1.0_f64), 1..60),
            others in prop::collection::vec(prop::array::uniform3(-0.6..0.6_f64), 200),
        ) {
            let planes: Vec<Plane> = planes
                .into_iter()
                .filter(|(normal, _)| Vector3::from(*normal).norm() > 0.1)
                .map(|(normal, height)| plane(normal, height))
                .collect();
            let depth = |place: &Vector3<f64>| {
                let depths = planes.iter().map(|plane| plane.height - plane.normal.dot(place));
                depths.fold(1.0, f64::min)
            };
            let (place, found) = deepest_below(&planes, 0.6);
            prop_assert!(place.amax() <= 0.6 + 1e-10);
            prop_assert!((depth(&place) - found).abs() < 1e-10);
            for step in 0..3 {
                let nearer = 10.0_f64.powi(-3 * step);
                for other in &others {
                    let other = place + (Vector3::from(*other) - place) * nearer;
                    prop_assert!(depth(&other) <= found + 1e-10);
                }
            }
        }
    }
}
