//! A closed mesh that is asked of many places whether they are inside.

use super::{Bounds, BoundsTree, Mesh};
use crate::predicates::{orient2d, orient3d};
use nalgebra::{Point3, Vector2};

/// A closed mesh and a tree of its triangles' boxes.
pub(crate) struct Enclosing<'a> {
    mesh: &'a Mesh,
    tree: BoundsTree,
}

impl<'a> Enclosing<'a> {
    /// Of a mesh whose triangles name vertices that exist.
    pub(crate) fn new(mesh: &'a Mesh) -> Self {
        Self {
            tree: BoundsTree::of_triangles(mesh),
            mesh,
        }
    }

    /// The triangles whose boxes meet a box, in order.
    pub(crate) fn triangles_near(&self, bounds: &Bounds) -> Vec<usize> {
        let mut near: Vec<usize> = self.tree.meeting(bounds).map(|at| at as usize).collect();
        near.sort_unstable();
        near
    }

    /// How often the mesh goes round a place off it: through so many more triangles a ray from there goes out than in. Which
    /// triangles it goes through is told by signs that rounding does not change, and each edge belongs to one of its
    /// triangles only (Shimrat 1962), so that the number is exact.
    pub(crate) fn winding_number(&self, place: &Point3<f64>) -> i32 {
        let Some(bounds) = self.tree.bounds() else {
            return 0;
        };
        let end = Point3::new(bounds.corners()[1].x.max(place.x), place.y, place.z);
        let ray = Bounds::new([*place, end], 0.0);
        let met = self.tree.meeting(&ray).map(|at| {
            let corners = self.mesh.triangles[at as usize];
            let corners = corners.map(|corner| self.mesh.vertices[corner as usize]);
            let turns = turns(corners, place);
            let is_ahead = turns != 0 && f64::from(turns) * orient3d(corners, *place) > 0.0;
            if is_ahead { turns } else { 0 }
        });
        met.sum()
    }
}

/// How often a triangle, seen along the first axis, goes round a place counter-clockwise: -1, 0 or 1.
fn turns(corners: [Point3<f64>; 3], place: &Point3<f64>) -> i32 {
    let seen = |point: &Point3<f64>| Vector2::new(point.y, point.z);
    let (places, from) = (corners.map(|corner| seen(&corner)), seen(place));
    let edges = [0, 1, 2].map(|i| [places[i], places[(i + 1) % 3]]);
    let turns = edges.map(|[a, b]| match [a.y <= from.y, b.y <= from.y] {
        [true, false] => i32::from(orient2d([a, b, from]) > 0.0),
        [false, true] => -i32::from(orient2d([a, b, from]) < 0.0),
        _ => 0,
    });
    turns.iter().sum()
}

#[cfg(test)]
mod tests {
    use super::super::winding_number;
    use super::*;
    use proptest::prelude::*;

    proptest! {
        /// Places on a grid, so that rays meet corners and edges.
        #[test]
        fn it_is_the_sum_of_the_solid_angles(place in prop::array::uniform3(-9..=9), is_inward: bool) {
            let place = Point3::from(place.map(|c: i32| f64::from(c) / 7.0));
            let mut mesh = Mesh::radial(3, |n| 1.0 / n.amax());
            let hollow = Mesh::radial(2, |n| 0.5 / n.amax());
            let from = mesh.vertices.len() as u32;
            mesh.vertices.extend(hollow.vertices);
            mesh.triangles.extend(hollow.triangles.iter().map(|&[a, b, c]| [a + from, c + from, b + from]));
            if is_inward {
                mesh.triangles.iter_mut().for_each(|corners| corners.reverse());
            }
            prop_assume!(![0.5, 1.0].contains(&place.coords.amax()));
            let found = Enclosing::new(&mesh).winding_number(&place);
            prop_assert!((winding_number(&mesh, &place) - f64::from(found)).abs() < 1e-9);
        }
    }

    #[test]
    fn a_mesh_without_triangles_goes_round_nothing() {
        let mesh = Mesh::default();
        assert_eq!(Enclosing::new(&mesh).winding_number(&Point3::origin()), 0);
    }
}
