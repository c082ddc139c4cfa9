//! A tree of boxes over the triangles of a mesh, to find the point nearest to a place.

use super::clearance::Obstacles;
use crate::Mesh;
use nalgebra::Vector3;

/// Triangles per leaf.
const LEAF: usize = 4;

/// A bounding volume hierarchy: each node holds the box of its triangles and two halves of them.
pub(super) struct TriangleTree {
    triangles: Vec<[Vector3<f64>; 3]>,
    /// Depth first: the first child of a node follows it.
    nodes: Vec<Node>,
}

struct Node {
    low: Vector3<f64>,
    high: Vector3<f64>,
    /// Of a leaf, its triangles; of others, empty.
    triangles: std::ops::Range<usize>,
    /// The second child.
    second: usize,
}

impl TriangleTree {
    /// The tree of a mesh whose triangles all name vertices that exist.
    pub(super) fn new(mesh: &Mesh) -> Self {
        let corners = |t: &[u32; 3]| t.map(|corner| mesh.vertices[corner as usize].coords);
        let mut tree = Self {
            triangles: mesh.triangles.iter().map(corners).collect(),
            nodes: Vec::new(),
        };
        let count = tree.triangles.len();
        if count > 0 {
            tree.build(0..count);
        }
        tree
    }

    fn build(&mut self, range: std::ops::Range<usize>) {
        let own = &mut self.triangles[range.clone()];
        let mut low = Vector3::repeat(f64::INFINITY);
        let mut high = -low;
        for corner in own.iter().flatten() {
            (low, high) = (low.inf(corner), high.sup(corner));
        }
        let node = self.nodes.len();
        let is_leaf = range.len() <= LEAF;
        self.nodes.push(Node {
            low,
            high,
            triangles: if is_leaf { range.clone() } else { 0..0 },
            second: 0,
        });
        if is_leaf {
            return;
        }
        let axis = (high - low).imax();
        let half = range.len() / 2;
        let place = |t: &[Vector3<f64>; 3]| t[0][axis] + t[1][axis] + t[2][axis];
        own.select_nth_unstable_by(half, |one, other| place(one).total_cmp(&place(other)));
        let middle = range.start + half;
        self.build(range.start..middle);
        self.nodes[node].second = self.nodes.len();
        self.build(middle..range.end);
    }

    /// Triangles whose boxes are not farther than `radius` from a place.
    fn in_reach(&self, place: &Vector3<f64>, radius: f64) -> Vec<usize> {
        let mut found = Vec::new();
        let mut open: Vec<usize> = (0..self.nodes.len().min(1)).collect();
        while let Some(index) = open.pop() {
            let node = &self.nodes[index];
            if node.squared_distance(place) <= radius * radius {
                found.extend(node.triangles.clone());
                if node.second > 0 {
                    open.extend([index + 1, node.second]);
                }
            }
        }
        found
    }

    /// The diagonal of the box of the mesh.
    pub(super) fn size(&self) -> f64 {
        self.nodes
            .first()
            .map_or(0.0, |root| (root.high - root.low).norm())
    }

    /// The point of the mesh nearest to a place, if it is nearer than `limit`: the search keeps to that ball.
    pub(super) fn nearest(&self, place: &Vector3<f64>, limit: f64) -> Option<Vector3<f64>> {
        let mut best = (limit * limit, None);
        let mut open: Vec<(f64, usize)> = Vec::with_capacity(64);
        if let Some(root) = self.nodes.first() {
            open.push((root.squared_distance(place), 0));
        }
        while let Some((bound, index)) = open.pop() {
            if bound >= best.0 {
                continue;
            }
            let node = &self.nodes[index];
            for triangle in &self.triangles[node.triangles.clone()] {
                let nearest = nearest_in_triangle(triangle, place);
                let squared = (place - nearest).norm_squared();
                if squared < best.0 {
                    best = (squared, Some(nearest));
                }
            }
            if node.second > 0 {
                let mut children = [index + 1, node.second]
                    .map(|child| (self.nodes[child].squared_distance(place), child));
                if children[0].0 < children[1].0 {
                    children.swap(0, 1);
                }
                open.extend(children);
            }
        }
        best.1
    }
}

/// Numbered in an order of the tree's own.
impl Obstacles for TriangleTree {
    fn count(&self) -> usize {
        self.triangles.len()
    }

    fn nearest(&self, index: usize, place: &Vector3<f64>) -> Vector3<f64> {
        nearest_in_triangle(&self.triangles[index], place)
    }

    fn normal(&self, index: usize) -> Vector3<f64> {
        normal(&self.triangles[index])
    }

    fn within(&self, place: &Vector3<f64>, radius: f64) -> Vec<usize> {
        self.in_reach(place, radius)
    }
}

/// The normal of a triangle, twice as long as its area is large.
pub(super) fn normal([a, b, c]: &[Vector3<f64>; 3]) -> Vector3<f64> {
    (b - a).cross(&(c - a))
}

impl Node {
    fn squared_distance(&self, place: &Vector3<f64>) -> f64 {
        let outside = (self.low - place).sup(&(place - self.high));
        outside.sup(&Vector3::zeros()).norm_squared()
    }
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
    fn without_triangles_nothing_is_near() {
        let tree = TriangleTree::new(&Mesh::default());
        assert_eq!(tree.nearest(&Vector3::zeros(), f64::INFINITY), None);
    }
}
