//! Whether the parts of a union hang together.

use super::Part;
use crate::disjoint_sets::DisjointSets;
use nalgebra::Vector3;

/// Steps until two parts that were found neither to overlap nor to be apart are taken to touch.
const MAX_STEPS: usize = 2000;

/// A part that does not hang together with the first; `None` if all do.
pub(super) fn apart(parts: &[Part]) -> Option<usize> {
    let mut sets = DisjointSets::new(parts.len());
    for (i, one) in parts.iter().enumerate() {
        for (j, two) in parts.iter().enumerate().skip(i + 1) {
            if sets.of(i as u32) != sets.of(j as u32) && do_overlap(one, two) {
                sets.join(i as u32, j as u32);
            }
        }
    }
    let first = sets.of(0);
    (0..parts.len()).find(|&part| sets.of(part as u32) != first)
}

/// Whether two parts have a point in common: the shortest way between two of their points is sought (Gilbert 1966) until
/// a plane is found between them, or a point in both.
fn do_overlap(one: &Part, two: &Part) -> bool {
    let [mut p, mut q] = [one, two].map(|part| part.frame.centre.coords);
    let reach = one.shape.bounding_radius() + two.shape.bounding_radius();
    if (p - q).norm() > reach {
        return false;
    }
    for _ in 0..MAX_STEPS {
        let middle = (p + q) * 0.5;
        if one.gauge(&middle) <= 1.0 && two.gauge(&middle) <= 1.0 {
            return true;
        }
        let way = q - p;
        let (near, far) = (one.farthest(&way), two.farthest(&-way));
        if (far - near).dot(&way) > 0.0 {
            return false;
        }
        let turn = (far - near) - way;
        let share = (-way.dot(&turn) / turn.norm_squared()).clamp(0.0, 1.0);
        p += (near - p) * share;
        q += (far - q) * share;
    }
    true
}

impl Part {
    /// The point farthest along a direction.
    pub(super) fn farthest(&self, along: &Vector3<f64>) -> Vector3<f64> {
        let (_, place) = self.shape.support(&self.frame.axes.tr_mul(along));
        self.frame.to_scan(&place).coords
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::{Frame, Superquadric};
    use nalgebra::{Point3, Rotation3};

    fn part(x: f64, angle: f64) -> Part {
        Part {
            shape: Superquadric::single([2.0, 1.0, 0.7], 4.0, 3.0).unwrap(),
            frame: Frame {
                centre: Point3::new(x, 0.0, 0.0),
                axes: Rotation3::from_euler_angles(0.0, 0.0, angle).into_inner(),
            },
        }
    }

    #[test]
    fn parts_are_apart_where_a_plane_lies_between_them() {
        // End to end they reach 2 to either side.
        for (aside, expected) in [(0.0, true), (3.999, true), (4.001, false), (50.0, false)] {
            assert_eq!(
                do_overlap(&part(0.0, 0.0), &part(aside, 0.0)),
                expected,
                "{aside}"
            );
        }
        assert!(do_overlap(
            &part(0.0, 0.0),
            &part(2.9, std::f64::consts::FRAC_PI_2)
        ));
        assert!(!do_overlap(
            &part(0.0, 0.0),
            &part(3.1, std::f64::consts::FRAC_PI_2)
        ));
    }

    #[test]
    fn a_chain_hangs_together_in_any_order() {
        let chain = [0.0, 7.0, 3.5].map(|x| part(x, 0.1));
        assert_eq!(apart(&chain), None);
        assert_eq!(apart(&chain[..2]), Some(1));
    }
}
