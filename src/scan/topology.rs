//! How the triangles of a scan hang together, in near-linear time.

use crate::disjoint_sets::DisjointSets;
use nalgebra::Point3;

/// What the triangles of a scan bound.
#[derive(Debug, Clone, PartialEq)]
pub struct Topology {
    /// Every edge borders exactly two triangles, wound alike: the mesh has an inside.
    pub closed: bool,
    /// Parts that share no point.
    pub bodies: usize,
    /// Edges that border one triangle only: the rims of holes.
    pub boundary_edges: usize,
    /// Edges that border more than two triangles.
    pub branching_edges: usize,
    /// Edges whose two triangles are wound in opposite senses.
    pub twisted_edges: usize,
    /// Volume inside, in the cubed unit of the scan; of an open mesh, that of the cone from the
    /// mean of the points.
    pub volume: f64,
    /// Indices of points that belong to no triangle, in order.
    pub unreferenced: Vec<u32>,
}

impl Topology {
    /// Reads the topology off triangles that share their corners by number.
    pub(super) fn of_own(points: &[Point3<f64>], triangles: &[[u32; 3]]) -> Self {
        let own: Vec<u32> = (0..points.len() as u32).collect();
        Self::new(points, triangles, &own)
    }

    /// Reads the topology off triangles that all have three distinct corners. `same` names for
    /// each point the one to take for it, so that meshes that repeat their points hang together.
    pub(super) fn new(points: &[Point3<f64>], triangles: &[[u32; 3]], same: &[u32]) -> Self {
        let joined = joined(triangles, same);
        let [mut boundary, mut branching, mut twisted] = [0; 3];
        each_edge(points.len(), &joined, |edge| match edge.triangles().len() {
            1 => boundary += 1,
            2 => twisted += usize::from(edge.forward != 1),
            _ => branching += 1,
        });
        Self {
            closed: boundary + branching + twisted == 0,
            bodies: count_bodies(points.len(), &joined),
            boundary_edges: boundary,
            branching_edges: branching,
            twisted_edges: twisted,
            volume: volume(points, triangles),
            unreferenced: unreferenced(points.len(), triangles),
        }
    }
}

/// An undirected edge and how often triangles run along it.
pub(crate) struct Edge<'a> {
    /// The lower end first.
    pub(crate) ends: [u32; 2],
    /// Triangles that run from the lower to the higher end.
    pub(crate) forward: usize,
    pub(crate) backward: usize,
    /// Numbers of the sides of triangles that lie along it, in order: three to a triangle.
    pub(super) sides: &'a [usize],
}

impl Edge<'_> {
    /// Numbers of the triangles along it, in order.
    pub(crate) fn triangles(&self) -> impl ExactSizeIterator<Item = usize> {
        self.sides.iter().map(|side| side / 3)
    }

    /// The two triangles along it, if they are two.
    pub(crate) fn pair(&self) -> Option<[usize; 2]> {
        match self.sides {
            [one, other] => Some([one / 3, other / 3]),
            _ => None,
        }
    }
}

/// The corner that a side of a triangle ends in, of the one it begins in.
pub(super) fn after(side: usize) -> usize {
    if side % 3 == 2 { side - 2 } else { side + 1 }
}

/// Visits every edge once: sides of triangles are sorted into one bucket per lower end, then within it.
pub(crate) fn each_edge(points: usize, triangles: &[[u32; 3]], mut visit: impl FnMut(Edge<'_>)) {
    let corners = triangles.as_flattened();
    let ends_of = |side: usize| (corners[side], corners[after(side)]);
    let low = |side: usize| {
        let (from, to) = ends_of(side);
        from.min(to) as usize
    };
    let high = |side: usize| {
        let (from, to) = ends_of(side);
        from.max(to)
    };
    let mut ends = vec![0_usize; points + 1];
    for side in 0..corners.len() {
        ends[low(side) + 1] += 1;
    }
    for point in 0..points {
        ends[point + 1] += ends[point];
    }
    // Each bucket is filled from its start onwards.
    let mut sorted = vec![0_usize; corners.len()];
    for side in 0..corners.len() {
        let next = &mut ends[low(side)];
        sorted[*next] = side;
        *next += 1;
    }
    let mut start = 0;
    for (low, &end) in ends[..points].iter().enumerate() {
        let bucket = &mut sorted[start..end];
        start = end;
        bucket.sort_unstable_by_key(|&side| (high(side), side));
        for sides in bucket.chunk_by(|&one, &other| high(one) == high(other)) {
            let ends = [low as u32, high(sides[0])];
            let forward = sides.iter().filter(|&&side| ends_of(side).0 == ends[0]);
            let forward = forward.count();
            visit(Edge {
                ends,
                forward,
                backward: sides.len() - forward,
                sides,
            });
        }
    }
}

/// Triangles between the points that stand for those at the same place.
pub(super) fn joined(triangles: &[[u32; 3]], same: &[u32]) -> Vec<[u32; 3]> {
    let joined = triangles.iter();
    joined
        .map(|corners| corners.map(|corner| same[corner as usize]))
        .collect()
}

/// The sides that no other triangle lies along: those of the rims of holes.
pub(super) fn open_sides(points: usize, triangles: &[[u32; 3]]) -> Vec<usize> {
    let mut open = Vec::new();
    each_edge(points, triangles, |edge| {
        if let [side] = edge.sides {
            open.push(*side);
        }
    });
    open
}

/// Counts the parts that share no point, by union-find over the points.
fn count_bodies(points: usize, triangles: &[[u32; 3]]) -> usize {
    let mut sets = DisjointSets::new(points);
    let mut used = vec![false; points];
    for &[a, b, c] in triangles {
        for corner in [a, b, c] {
            used[corner as usize] = true;
            sets.join(a, corner);
        }
    }
    let is_least = |&point: &u32| used[point as usize] && sets.of(point) == point;
    (0..points as u32).filter(is_least).count()
}

fn volume(points: &[Point3<f64>], triangles: &[[u32; 3]]) -> f64 {
    let weight = 1.0 / points.len() as f64;
    let centre = points
        .iter()
        .fold(nalgebra::Vector3::zeros(), |sum, p| sum + p.coords * weight);
    let cone = |corners: &[u32; 3]| {
        let [a, b, c] = corners.map(|corner| points[corner as usize].coords - centre);
        a.dot(&b.cross(&c)) / 6.0
    };
    triangles.iter().map(cone).sum()
}

fn unreferenced(points: usize, triangles: &[[u32; 3]]) -> Vec<u32> {
    let mut used = vec![false; points];
    for &corner in triangles.as_flattened() {
        used[corner as usize] = true;
    }
    let number = |(number, used): (usize, bool)| (!used).then_some(number as u32);
    used.into_iter().enumerate().filter_map(number).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    const CORNERS: [[f64; 3]; 4] = [[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    const FACES: [[u32; 3]; 4] = [[0, 2, 1], [0, 1, 3], [1, 2, 3], [0, 3, 2]];

    fn topology(corners: &[[f64; 3]], faces: &[[u32; 3]]) -> Topology {
        let points: Vec<_> = corners.iter().copied().map(Point3::from).collect();
        let same: Vec<u32> = (0..points.len() as u32).collect();
        Topology::new(&points, faces, &same)
    }

    #[test]
    fn a_tetrahedron_is_closed_and_has_its_volume() {
        let whole = topology(&CORNERS, &FACES);
        assert!(whole.closed);
        assert_eq!((whole.bodies, whole.boundary_edges), (1, 0));
        assert!((whole.volume - 1.0 / 6.0).abs() < 1e-15);
    }

    #[test]
    fn a_missing_face_leaves_three_boundary_edges() {
        let open = topology(&CORNERS, &FACES[..3]);
        assert!(!open.closed);
        assert_eq!(open.boundary_edges, 3);
    }

    #[test]
    fn a_turned_face_twists_three_edges_and_a_third_one_branches_them() {
        let turned = [FACES[0], FACES[1], FACES[2], [0, 2, 3]];
        assert_eq!(topology(&CORNERS, &turned).twisted_edges, 3);
        let doubled = [FACES[0], FACES[1], FACES[2], FACES[3], FACES[3]];
        assert_eq!(topology(&CORNERS, &doubled).branching_edges, 3);
    }

    #[test]
    fn bodies_and_strays_are_counted() {
        let corners = [CORNERS, CORNERS, CORNERS].concat();
        let moved = FACES.map(|face| face.map(|corner| corner + 4));
        let two = topology(&corners, &[FACES, moved].concat());
        assert_eq!(two.bodies, 2);
        assert_eq!(two.unreferenced, [8, 9, 10, 11]);
    }
}
