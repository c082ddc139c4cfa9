//! The triangles of a mesh in a tree, to find those near a place.

use crate::Mesh;
use crate::mesh::{Bounds, BoundsTree};
use nalgebra::{Point3, Vector3};
use std::f64::consts::PI;

/// Share by which squared distances to the same corner of several triangles may differ.
const SAME_PLACE: f64 = 1e-9;

/// Triangles, in the order of a tree of their boxes.
pub(crate) struct TriangleTree {
    triangles: Vec<[Vector3<f64>; 3]>,
    tree: BoundsTree,
}

impl TriangleTree {
    /// The tree of a mesh whose triangles all name vertices that exist.
    pub(crate) fn new(mesh: &Mesh) -> Self {
        let corners = |t: &[u32; 3]| t.map(|corner| mesh.vertices[corner as usize]);
        let tree = BoundsTree::of_triangles(mesh);
        let in_order = tree.order().iter().map(|&at| &mesh.triangles[at as usize]);
        Self {
            triangles: in_order
                .map(|t| corners(t).map(|corner| corner.coords))
                .collect(),
            tree,
        }
    }

    /// The diagonal of the box of the mesh.
    pub(super) fn size(&self) -> f64 {
        self.tree.bounds().map_or(0.0, Bounds::size)
    }

    /// The point of the mesh nearest to a place, if it is nearer than `limit`: the search keeps to that ball.
    pub(crate) fn nearest(&self, place: &Vector3<f64>, limit: f64) -> Option<Vector3<f64>> {
        let mut best = (limit * limit, None);
        self.tree.near(&Point3::from(*place), best.0, |span| {
            for triangle in &self.triangles[span] {
                let nearest = nearest_in_triangle(triangle, place);
                let squared = (place - nearest).norm_squared();
                if squared < best.0 {
                    best = (squared, Some(nearest));
                }
            }
            best.0
        });
        best.1
    }

    /// Corners of the box of the mesh.
    pub(super) fn corners(&self) -> [Vector3<f64>; 2] {
        self.tree
            .bounds()
            .map_or([Vector3::zeros(); 2], Bounds::corners)
    }

    /// Whether a place off a closed mesh that is wound counter-clockwise from outside is outside: by the normal where it is
    /// nearest, on edges and at corners the sum of those of the triangles there, weighed by their angles (Bærentzen and
    /// Aanæs 2005). One of a mesh that goes through itself may be told wrong.
    pub(crate) fn is_outside(&self, place: &Vector3<f64>) -> bool {
        let Some(nearest) = self.nearest(place, f64::INFINITY) else {
            return true;
        };
        let limit = (place - nearest).norm_squared() * (1.0 + SAME_PLACE);
        let mut normal = Vector3::zeros();
        self.tree.near(&Point3::from(*place), limit, |span| {
            for triangle in &self.triangles[span] {
                let point = nearest_in_triangle(triangle, place);
                if (place - point).norm_squared() <= limit {
                    normal += weighed_normal(triangle, &point);
                }
            }
            limit
        });
        normal.dot(&(place - nearest)) > 0.0
    }
}

/// The unit normal of a triangle times the angle of its part of a small disc round a point of it.
fn weighed_normal(triangle: &[Vector3<f64>; 3], point: &Vector3<f64>) -> Vector3<f64> {
    let [a, b, c] = triangle;
    let normal = (b - a).cross(&(c - a)).try_normalize(0.0);
    let angle = match triangle.iter().position(|corner| corner == point) {
        Some(at) => {
            let [ahead, behind] = [1, 2].map(|step| triangle[(at + step) % 3] - point);
            ahead.angle(&behind)
        }
        None => PI,
    };
    normal.unwrap_or_default() * angle
}

/// The point of a triangle nearest to p (Ericson 2005, section 5.1.5).
pub(super) fn nearest_in_triangle([a, b, c]: &[Vector3<f64>; 3], p: &Vector3<f64>) -> Vector3<f64> {
    let (ab, ac, ap) = (b - a, c - a, p - a);
    let (d1, d2) = (ab.dot(&ap), ac.dot(&ap));
    if d1 <= 0.0 && d2 <= 0.0 {
        return *a;
    }
    let bp = p - b;
    let (d3, d4) = (ab.dot(&bp), ac.dot(&bp));
    if d3 >= 0.0 && d4 <= d3 {
        return *b;
    }
    let vc = d1 * d4 - d3 * d2;
    if vc <= 0.0 && d1 >= 0.0 && d3 <= 0.0 {
        return a + ab * (d1 / (d1 - d3));
    }
    let cp = p - c;
    let (d5, d6) = (ab.dot(&cp), ac.dot(&cp));
    if d6 >= 0.0 && d5 <= d6 {
        return *c;
    }
    let vb = d5 * d2 - d1 * d6;
    if vb <= 0.0 && d2 >= 0.0 && d6 <= 0.0 {
        return a + ac * (d2 / (d2 - d6));
    }
    let va = d3 * d6 - d5 * d4;
    if va <= 0.0 && d4 >= d3 && d5 >= d6 {
        return b + (c - b) * ((d4 - d3) / ((d4 - d3) + (d5 - d6)));
    }
    // In the interior: along the normal, which loses fewer digits than the barycentric weights.
    let normal = ab.cross(&ac);
    p - normal * (normal.dot(&ap) / normal.norm_squared())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::winding_number;
    use crate::shapes::{Body, Sampling};
    use approx::assert_relative_eq;

    #[test]
    fn the_point_nearest_in_a_triangle_is_that_of_a_dense_sample() {
        let corners = [[0.0, 0.0, 0.0], [2.0, 0.0, 0.0], [0.5, 1.0, 0.0]].map(Vector3::from);
        let [a, b, c] = corners;
        for n in Sampling::Fibonacci.directions(200, 0).unwrap() {
            let p = Vector3::new(0.8, 0.3, 0.0) + n * 1.5;
            let found = (nearest_in_triangle(&corners, &p) - p).norm();
            let weights = (0..=60).flat_map(|i| (0..=60 - i).map(move |j| (i, j)));
            let sampled = weights
                .map(|(i, j)| a + (b - a) * (f64::from(i) / 60.0) + (c - a) * (f64::from(j) / 60.0))
                .map(|q| (q - p).norm())
                .fold(f64::MAX, f64::min);
            assert!(found <= sampled + 1e-12 && found > sampled - 0.01);
        }
    }

    #[test]
    fn the_tree_finds_what_a_search_of_all_triangles_finds() {
        let maize = Body::Maize.surface();
        let mesh = Mesh::radial(8, |n| maize.radius(n));
        let tree = TriangleTree::new(&mesh);
        for (i, n) in Sampling::Fibonacci
            .directions(300, 0)
            .unwrap()
            .iter()
            .enumerate()
        {
            let place = n * (0.03 * i as f64);
            let found = tree.nearest(&place, f64::INFINITY).unwrap();
            let found = (found - place).norm();
            let all = mesh.triangles.iter().map(|t| {
                let corners = t.map(|corner| mesh.vertices[corner as usize].coords);
                (nearest_in_triangle(&corners, &place) - place).norm()
            });
            assert_relative_eq!(found, all.fold(f64::MAX, f64::min), epsilon = 1e-14);
            assert_eq!(tree.nearest(&place, 0.999 * found), None);
        }
    }

    #[test]
    fn places_are_outside_where_rays_leave_nothing_behind() {
        // Beside edges and corners of a cube with a pit, from within and from without.
        let pit = |n: &Vector3<f64>| if n.z > 0.95 { 0.3 } else { 1.0 / n.amax() };
        let mesh = Mesh::radial(6, pit);
        let tree = TriangleTree::new(&mesh);
        for (i, n) in Sampling::Fibonacci
            .directions(2000, 0)
            .unwrap()
            .iter()
            .enumerate()
        {
            let place = n * (1.8 * (i as f64 * 0.618_034).fract());
            let is_inside = winding_number(&mesh, &place.into()) > 0.5;
            assert_eq!(tree.is_outside(&place), !is_inside, "{place:?}");
        }
    }

    #[test]
    fn without_triangles_nothing_is_near() {
        let tree = TriangleTree::new(&Mesh::default());
        assert_eq!(tree.nearest(&Vector3::zeros(), f64::INFINITY), None);
    }
}
