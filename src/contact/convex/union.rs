//! Contacts of unions: of all their parts, each touch told once.

use super::contact::ConvexStatus;
use super::pair::ConvexPair;
use crate::measure::Curvature;
use crate::model::{Frame, MultiSuperquadric, Part, StarSurface};
use crate::sphere::cube_grid;
use nalgebra::{Point3, Vector3};

/// Cosine of the largest angle between normals of one touch: 20 degrees.
pub(crate) const SAME_NORMAL: f64 = 0.939_692_620_785_908_4;

/// One touch of two bodies.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct UnionContact {
    /// Which part of the first body touches which of the second; of several that touch at the same place the deepest.
    pub parts: [usize; 2],
    /// The midway point.
    pub point: Point3<f64>,
    /// The unit normal from the first body to the second.
    pub normal: Vector3<f64>,
    /// The overlap along the normal.
    pub overlap: f64,
}

impl UnionContact {
    /// Curvatures of the surfaces of both unions there, of the parts that touch.
    pub fn curvatures(&self, bodies: [(&MultiSuperquadric, &Frame); 2]) -> [Curvature; 2] {
        [0, 1].map(|body| {
            let (part, end) = self.end(bodies, body);
            let (n, jet) = part.jet_at(&end);
            Curvature::new(&n, &jet)
        })
    }

    /// The part of one of the bodies that touches, where it is, and its point that lies deepest in the other.
    pub(in crate::contact) fn end(
        &self,
        bodies: [(&MultiSuperquadric, &Frame); 2],
        body: usize,
    ) -> (Part, Point3<f64>) {
        let (union, frame) = bodies[body];
        let half = [0.5, -0.5][body] * self.overlap;
        let part = union.parts()[self.parts[body]].placed(frame);
        (part, self.point + self.normal * half)
    }
}

/// All touches of two unions whose frames are of the same space, the deepest first.
///
/// Parts of a body overlap, and two of them may touch the other body at one place. Contacts count as one touch if
/// their normals are within 20 degrees and their points within the radius of the patch that a sphere as large as the
/// smallest part would have there, sqrt(R overlap), or if the way between their points lies in both bodies: then it is one
/// thing that these share. The deepest is kept.
pub fn union_contacts(
    first: (&MultiSuperquadric, &Frame),
    second: (&MultiSuperquadric, &Frame),
) -> Vec<UnionContact> {
    let mut touches = Vec::new();
    for (i, one) in placed(first).iter().enumerate() {
        for (j, other) in placed(second).iter().enumerate() {
            let [near, far] = [one, other].map(|part| part.shape.bounding_radius());
            if (one.frame.centre - other.frame.centre).norm() > near + far {
                continue;
            }
            let pair = ConvexPair::new((&one.shape, &one.frame), (&other.shape, &other.frame));
            let contact = pair.contact(None);
            if contact.status != ConvexStatus::Touching {
                continue;
            }
            let touch = UnionContact {
                parts: [i, j],
                point: contact.point,
                normal: contact.normal,
                overlap: pair.overlap(&contact),
            };
            touches.push((touch, near.min(far)));
        }
    }
    touches.sort_by(|(p, _), (q, _)| q.overlap.total_cmp(&p.overlap));
    let mut kept: Vec<UnionContact> = Vec::new();
    for (touch, radius) in touches {
        let is_same = |deeper: &UnionContact| {
            let places = [(deeper.point, deeper.normal), (touch.point, touch.normal)];
            same_touch(places, radius, deeper.overlap)
                || [first, second].iter().all(|(union, frame)| {
                    let [from, to] = places.map(|(point, _)| frame.to_local(&point));
                    union.holds_way(&from, &to)
                })
        };
        if !kept.iter().any(is_same) {
            kept.push(touch);
        }
    }
    kept
}

/// Whether one of two unions whose frames are of the same space lies wholly inside the other, for all that 1538 places of each
/// part's surface tell.
pub fn is_one_inside(
    first: (&MultiSuperquadric, &Frame),
    second: (&MultiSuperquadric, &Frame),
) -> bool {
    let is_inside = |inner: (&MultiSuperquadric, &Frame),
                     (outer, frame): (&MultiSuperquadric, &Frame)| {
        surface(inner).all(|point| outer.gauge(&frame.to_local(&point)) <= 1.0 + ROUNDED)
    };
    is_inside(first, second) || is_inside(second, first)
}

/// Cells along each edge of the cube of directions from each part in which its surface is looked at.
const GRID: usize = 16;

/// Rounding of a gauge.
const ROUNDED: f64 = 1e-9;

/// Places on the surface of a union.
fn surface<'a>(
    (union, frame): (&'a MultiSuperquadric, &'a Frame),
) -> impl Iterator<Item = Point3<f64>> + 'a {
    let (directions, _) = cube_grid(GRID);
    let places = union.parts().iter().flat_map(move |part| {
        let place = |n: &Vector3<f64>| part.frame.to_scan(&(n * part.shape.radius(n)));
        directions.iter().map(place).collect::<Vec<_>>()
    });
    let is_outside = |place: &Point3<f64>| union.gauge(&place.coords) >= 1.0 - ROUNDED;
    places
        .filter(is_outside)
        .map(|place| frame.to_scan(&place.coords))
}

/// Whether contacts of parts of the same bodies, each a point and a unit normal, are one touch: the patch is that of a
/// sphere of this radius at the deeper one's overlap.
fn same_touch(
    [deeper, other]: [(Point3<f64>, Vector3<f64>); 2],
    radius: f64,
    overlap: f64,
) -> bool {
    let apart = (deeper.0 - other.0).norm_squared();
    deeper.1.dot(&other.1) > SAME_NORMAL && apart < radius * overlap
}

/// The parts where the body is.
fn placed((union, frame): (&MultiSuperquadric, &Frame)) -> Vec<Part> {
    union
        .parts()
        .iter()
        .map(|part| part.placed(frame))
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::Superquadric;
    use approx::assert_relative_eq;
    use nalgebra::Matrix3;

    fn at(x: f64, y: f64, z: f64) -> Frame {
        Frame {
            centre: Point3::new(x, y, z),
            axes: Matrix3::identity(),
        }
    }

    fn union(parts: &[([f64; 3], Frame)]) -> MultiSuperquadric {
        let parts = parts.iter().map(|(axes, frame)| Part {
            shape: Superquadric::single(*axes, 2.0, 2.0).unwrap(),
            frame: *frame,
        });
        MultiSuperquadric::new(parts.collect()).unwrap()
    }

    #[test]
    fn an_ellipsoid_of_overlapping_parts_touches_as_one() {
        let axes = [2.0, 1.5, 1.0];
        let one = union(&[(axes, at(0.0, 0.0, 0.0))]);
        // The same ellipsoid twice, and smaller ones inside that reach to just below its surface.
        let many = union(&[
            (axes, at(0.0, 0.0, 0.0)),
            (axes, at(0.0, 0.0, 0.0)),
            ([1.95, 1.46, 0.97], at(0.0, 0.0, 0.02)),
            ([1.6, 1.2, 0.8], at(0.1, 0.0, 0.19)),
        ]);
        let sphere = union(&[([1.0; 3], at(0.0, 0.0, 0.0))]);
        for place in [at(0.2, 0.1, 1.93), at(0.3, -0.2, 1.9), at(0.1, 0.2, 1.95)] {
            let expected = union_contacts((&one, &at(0.0, 0.0, 0.0)), (&sphere, &place));
            let found = union_contacts((&many, &at(0.0, 0.0, 0.0)), (&sphere, &place));
            assert_eq!((expected.len(), found.len()), (1, 1));
            assert_relative_eq!(found[0].overlap, expected[0].overlap, max_relative = 1e-5);
            assert_relative_eq!(found[0].normal, expected[0].normal, epsilon = 1e-5);
        }
    }

    #[test]
    fn parts_that_touch_in_what_is_shared_at_one_place_touch_once() {
        // Two balls side by side, so deep in a plate that what they share with it hangs together.
        let ball = |x: f64| ([1.0; 3], at(x, 0.0, 0.0));
        let dimer = union(&[ball(-0.3), ball(0.3)]);
        let plate = union(&[([9.0, 9.0, 0.5], at(0.0, 0.0, 0.0))]);
        for (height, expected) in [(1.3, 1), (1.49, 2)] {
            let above = at(0.0, 0.0, height);
            let found = union_contacts((&plate, &at(0.0, 0.0, 0.0)), (&dimer, &above));
            assert_eq!(found.len(), expected, "{height}");
        }
    }

    #[test]
    fn a_union_inside_another_is_known() {
        let at_origin = at(0.0, 0.0, 0.0);
        let dimer = union(&[
            ([1.0; 3], at(-0.7, 0.0, 0.0)),
            ([1.0; 3], at(0.7, 0.0, 0.0)),
        ]);
        let plate = union(&[([9.0, 9.0, 1.3], at_origin)]);
        let aside = at(20.0, 0.0, 0.0);
        for (height, expected) in [(0.0, true), (0.2, true), (0.4, false), (5.0, false)] {
            let placed = at(20.5, 0.0, height);
            let bodies = [(&dimer, &placed), (&plate, &aside)];
            assert_eq!(is_one_inside(bodies[0], bodies[1]), expected, "{height}");
            assert_eq!(is_one_inside(bodies[1], bodies[0]), expected, "{height}");
        }
        assert!(is_one_inside((&dimer, &at_origin), (&dimer, &at_origin)));
    }

    #[test]
    fn a_dimer_on_a_dimer_touches_twice() {
        let ball = |x: f64| ([1.0; 3], at(x, 0.0, 0.0));
        let dimer = union(&[ball(-0.7), ball(0.7)]);
        let above = at(0.0, 0.0, 1.98);
        let found = union_contacts((&dimer, &at(0.0, 0.0, 0.0)), (&dimer, &above));
        assert_eq!(found.len(), 2);
        for touch in found {
            assert_relative_eq!(touch.overlap, 0.02, epsilon = 1e-6);
            assert_relative_eq!(touch.normal, Vector3::z(), epsilon = 1e-6);
        }
        let far = at(0.0, 0.0, 9.0);
        assert!(union_contacts((&dimer, &at(0.0, 0.0, 0.0)), (&dimer, &far)).is_empty());
    }
}
