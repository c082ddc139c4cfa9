//! What of each of two triangulated surfaces lies inside the other.
//!
//! Where an edge of one surface goes through a triangle of the other is decided by exact signs, the same for every
//! triangle that has the edge, so that the parts close. The part of a triangle that lies inside is never built: its area
//! and its moments are sums over the oriented segments of its rim, which are spans of its edges, and the lines in which
//! it crosses triangles of the other surface.

use crate::mesh::undirected;
use crate::predicates::orient3d;
use nalgebra::{Point3, Vector3};
use std::collections::HashMap;

/// A closed surface, or a part of one whose rim lies outside the other.
pub(super) struct Side<'a> {
    pub(super) vertices: &'a [Point3<f64>],
    pub(super) triangles: &'a [[u32; 3]],
    /// Whether a vertex lies in the other surface, of those of which that is known.
    pub(super) known: &'a [Option<bool>],
}

/// Where an edge goes through a triangle.
#[derive(Clone, Copy)]
struct Piercing {
    triangle: u32,
    /// Share of the edge before it, from its end of lower number.
    share: f64,
    point: Point3<f64>,
}

/// Of an edge, in the order of its ends' numbers.
type Pierced = HashMap<[u32; 2], Vec<Piercing>>;

/// A segment of the rim of what lies inside, the inside on its left as seen from outside the surface.
pub(super) type Segment = [Point3<f64>; 2];

/// Two surfaces, and where they cross.
pub(super) struct Crossing {
    /// Whether each vertex lies inside the other surface.
    pub(super) inside: [Vec<bool>; 2],
    /// Pairs of triangles that cross.
    pub(super) crossed: Vec<[u32; 2]>,
    /// Rims of what lies inside, of every triangle.
    rims: [Vec<Vec<Segment>>; 2],
    /// Whether every edge goes in and out in turn.
    pub(super) is_sound: bool,
}

impl Crossing {
    /// Of two surfaces, and the pairs of their triangles that may cross.
    pub(super) fn new(sides: [&Side<'_>; 2], pairs: &[[u32; 2]]) -> Self {
        let [one, two] = sides;
        let own = pierced(one, two, pairs.iter().copied());
        let others = pierced(two, one, pairs.iter().map(|&[i, j]| [j, i]));
        let (inside_two, is_first_sound) = flooded(one, &own);
        let (inside_one, is_second_sound) = flooded(two, &others);
        let mut rims = [
            vec![Vec::new(); one.triangles.len()],
            vec![Vec::new(); two.triangles.len()],
        ];
        let mut crossed = Vec::new();
        for &[i, j] in pairs {
            let line = line(one, i, j, &own).chain(line(two, j, i, &others));
            let line: Vec<Point3<f64>> = line.collect();
            let [p, q] = line[..] else { continue };
            let along = normal(one, i).cross(&normal(two, j));
            // The inside is on the left of N_1 x N_2 on the first surface, and on its right on the second.
            let [p, q] = match along.dot(&(q - p)) >= 0.0 {
                true => [p, q],
                false => [q, p],
            };
            rims[0][i as usize].push([p, q]);
            rims[1][j as usize].push([q, p]);
            crossed.push([i, j]);
        }
        let spans = [(one, &own, &inside_two), (two, &others, &inside_one)];
        for ((side, pierced, inside), rims) in spans.into_iter().zip(&mut rims) {
            for (triangle, rim) in side.triangles.iter().zip(rims) {
                add_spans(side, triangle, pierced, inside, rim);
            }
        }
        Self {
            inside: [inside_two, inside_one],
            crossed,
            rims,
            is_sound: is_first_sound && is_second_sound,
        }
    }

    /// The rim of what of a triangle lies inside: segments that close.
    pub(super) fn rim(&self, side: usize, triangle: u32) -> &[Segment] {
        &self.rims[side][triangle as usize]
    }
}

/// Edges of one side that go through triangles of the other.
fn pierced(one: &Side<'_>, two: &Side<'_>, pairs: impl Iterator<Item = [u32; 2]>) -> Pierced {
    let mut found = Pierced::new();
    for [own, other] in pairs {
        let [a, b, c] = one.triangles[own as usize];
        for edge in [[a, b], [b, c], [c, a]].map(undirected) {
            let Some(piercing) = piercing(one, edge, two, other) else {
                continue;
            };
            let all = found.entry(edge).or_default();
            if all.iter().all(|known| known.triangle != other) {
                all.push(piercing);
            }
        }
    }
    for all in found.values_mut() {
        all.sort_by(|p, q| {
            p.share
                .total_cmp(&q.share)
                .then(p.triangle.cmp(&q.triangle))
        });
    }
    found
}

/// Where an edge goes through a triangle, if it does.
fn piercing(one: &Side<'_>, edge: [u32; 2], two: &Side<'_>, triangle: u32) -> Option<Piercing> {
    let [p, q] = edge.map(|end| one.vertices[end as usize]);
    let corners = two.triangles[triangle as usize];
    let [a, b, c] = corners.map(|i| two.vertices[i as usize]);
    let (before, after) = (orient3d([a, b, c], p), orient3d([a, b, c], q));
    if (before > 0.0) == (after > 0.0) {
        return None;
    }
    // An edge of triangles is seen from its end of lower number, so that both its triangles see the same.
    let passes = |from: usize, to: usize| {
        let ends = [corners[from], corners[to]];
        let [low, high] = undirected(ends).map(|i| two.vertices[i as usize]);
        let is_left = orient3d([p, q, low], high) > 0.0;
        is_left == (ends[0] < ends[1])
    };
    let side = passes(0, 1);
    if side != passes(1, 2) || side != passes(2, 0) {
        return None;
    }
    let share = before / (before - after);
    Some(Piercing {
        triangle,
        share,
        point: p + (q - p) * share,
    })
}

/// Whether each vertex lies inside, and whether that is the same by every way.
fn flooded(side: &Side<'_>, pierced: &Pierced) -> (Vec<bool>, bool) {
    let mut beside = vec![Vec::new(); side.vertices.len()];
    for &[a, b, c] in side.triangles {
        for [from, to] in [[a, b], [b, c], [c, a]] {
            beside[from as usize].push(to);
            beside[to as usize].push(from);
        }
    }
    let mut inside: Vec<Option<bool>> = vec![None; side.vertices.len()];
    let mut is_sound = true;
    // What is known comes first; what nobody knows is outside.
    let known = (0..side.vertices.len()).filter(|&i| side.known[i].is_some());
    for start in known.chain(0..side.vertices.len()) {
        if inside[start].is_some() {
            continue;
        }
        inside[start] = Some(side.known[start].unwrap_or(false));
        let mut left = vec![start as u32];
        while let Some(from) = left.pop() {
            for &to in &beside[from as usize] {
                let edge = undirected([from, to]);
                let times = pierced.get(&edge).map_or(0, Vec::len);
                let there = inside[from as usize].map(|is_inside| is_inside != (times % 2 == 1));
                match inside[to as usize] {
                    None => {
                        inside[to as usize] = there;
                        left.push(to);
                    }
                    found => is_sound &= found == there,
                }
            }
        }
    }
    let inside = inside.into_iter().map(|found| found == Some(true));
    (inside.collect(), is_sound)
}

/// Where the edges of a triangle go through one of the other side.
fn line<'a>(
    side: &'a Side<'_>,
    triangle: u32,
    other: u32,
    pierced: &'a Pierced,
) -> impl Iterator<Item = Point3<f64>> + 'a {
    let [a, b, c] = side.triangles[triangle as usize];
    let edges = [[a, b], [b, c], [c, a]].map(undirected);
    edges.into_iter().filter_map(move |edge| {
        let all = pierced.get(&edge)?;
        let found = all.iter().find(|piercing| piercing.triangle == other)?;
        Some(found.point)
    })
}

/// Adds the spans of a triangle's edges that lie inside.
fn add_spans(
    side: &Side<'_>,
    &[a, b, c]: &[u32; 3],
    pierced: &Pierced,
    inside: &[bool],
    rim: &mut Vec<Segment>,
) {
    for [from, to] in [[a, b], [b, c], [c, a]] {
        let edge = undirected([from, to]);
        let [low, high] = edge.map(|end| side.vertices[end as usize]);
        let mut since = inside[edge[0] as usize].then_some(low);
        let turned = |[p, q]: Segment| match from < to {
            true => [p, q],
            false => [q, p],
        };
        for piercing in pierced.get(&edge).into_iter().flatten() {
            match since.take() {
                Some(start) => rim.push(turned([start, piercing.point])),
                None => since = Some(piercing.point),
            }
        }
        if let Some(start) = since {
            rim.push(turned([start, high]));
        }
    }
}

fn normal(side: &Side<'_>, triangle: u32) -> Vector3<f64> {
    let corners = side.triangles[triangle as usize];
    let [a, b, c] = corners.map(|i| side.vertices[i as usize]);
    (b - a).cross(&(c - a))
}

/// Whether a point lies inside a closed surface.
pub(super) fn is_inside(
    point: &Point3<f64>,
    vertices: &[Point3<f64>],
    triangles: &[[u32; 3]],
) -> bool {
    let reach = vertices
        .iter()
        .map(|vertex| (vertex - point).norm())
        .fold(1.0, f64::max);
    // In a direction that no edge of a grid is likely to have.
    let far = point + Vector3::new(0.577_3, 0.211_9, -0.788_6) * (3.0 * reach);
    let ray = Side {
        vertices: &[*point, far],
        triangles: &[],
        known: &[],
    };
    let body = Side {
        vertices,
        triangles,
        known: &[],
    };
    let pierced =
        (0..triangles.len() as u32).filter(|&i| piercing(&ray, [0, 1], &body, i).is_some());
    pierced.count() % 2 == 1
}
