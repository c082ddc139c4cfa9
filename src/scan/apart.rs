//! Bodies that touch at a point, along an edge or with a face, apart: in formats without shared points they are one.
//!
//! Corners of triangles at one vertex belong together where an edge leads from one triangle to the other. Along an edge with more than
//! two triangles each is joined to the one behind which the body ends first, turning from it into the body; what is wound so that
//! there are no such pairs stays together.

use super::topology::{Edge, after, each_edge};
use crate::disjoint_sets::DisjointSets;
use crate::mesh::Mesh;
use nalgebra::Point3;
use std::collections::HashMap;
use std::f64::consts::TAU;

/// An edge with more pairs of triangles is left as it is.
const MOST_PAIRS: usize = 16;

/// Triangles at a smaller angle lie on each other, back to back, in radians.
const FLAT: f64 = 1e-9;

/// The mesh with a vertex for each part of the surface that meets there.
pub(crate) fn apart(mesh: Mesh) -> Mesh {
    let Mesh {
        mut vertices,
        mut triangles,
    } = mesh;
    let mut fans = DisjointSets::new(3 * triangles.len());
    each_edge(vertices.len(), &triangles, |edge| {
        let corners = triangles.as_flattened();
        let mut join = |pair: [usize; 2]| {
            for end in edge.ends {
                let [one, other] = pair.map(|side| match corners[side] == end {
                    true => side,
                    false => after(side),
                });
                fans.join(one as u32, other as u32);
            }
        };
        let is_balanced = edge.forward == edge.backward;
        match is_balanced && (2..=MOST_PAIRS).contains(&edge.forward) {
            true => pairs(&edge, &vertices, corners).into_iter().for_each(join),
            false => edge.sides.windows(2).for_each(|two| join([two[0], two[1]])),
        }
    });
    let mut first_fans = vec![None; vertices.len()];
    let mut copies = HashMap::new();
    for (corner, vertex) in triangles.as_flattened_mut().iter_mut().enumerate() {
        let fan = fans.of(corner as u32);
        if *first_fans[*vertex as usize].get_or_insert(fan) != fan {
            let own = *vertex;
            *vertex = *copies.entry(fan).or_insert_with(|| {
                vertices.push(vertices[own as usize]);
                vertices.len() as u32 - 1
            });
        }
    }
    Mesh {
        vertices,
        triangles,
    }
}

/// The sides along an edge, one of each sense, with the least angles between their triangles within the body.
fn pairs(edge: &Edge<'_>, vertices: &[Point3<f64>], corners: &[u32]) -> Vec<[usize; 2]> {
    let place = |corner: usize| vertices[corners[corner] as usize];
    let [low, high] = edge.ends.map(|end| vertices[end as usize]);
    let along = (high - low).try_normalize(0.0).unwrap_or_default();
    let across = |side: usize| {
        let tip = place(after(after(side))) - low;
        tip - along * tip.dot(&along)
    };
    let is_forward = |side: &&usize| corners[**side] == edge.ends[0];
    let (forward, backward): (Vec<usize>, Vec<usize>) = edge.sides.iter().partition(is_forward);
    let angle = |one: usize, other: usize| {
        let (one, other) = (across(one), across(other));
        match one.cross(&along).dot(&other).atan2(one.dot(&other)) {
            angle if angle > FLAT => angle,
            angle => angle + TAU,
        }
    };
    let all = forward
        .iter()
        .flat_map(|&one| backward.iter().map(move |&other| [one, other]));
    let mut all: Vec<_> = all.map(|pair| (angle(pair[0], pair[1]), pair)).collect();
    all.sort_by(|one, other| one.0.total_cmp(&other.0));
    let mut found: Vec<[usize; 2]> = Vec::with_capacity(forward.len());
    for (_, pair) in all {
        let is_taken = |taken: &[usize; 2]| taken[0] == pair[0] || taken[1] == pair[1];
        if !found.iter().any(is_taken) {
            found.push(pair);
        }
    }
    found
}

#[cfg(test)]
mod tests {
    use super::super::weld::Welder;
    use super::*;
    use nalgebra::Vector3;

    /// Unit cubes at these places, whose corners are one where they meet.
    fn cubes(places: &[[f64; 3]]) -> Mesh {
        let cube = Mesh::radial(1, |n| 0.5 / n.amax());
        let (mut welder, mut numbers, mut triangles) = (Welder::default(), Vec::new(), Vec::new());
        for place in places {
            let start = numbers.len() as u32;
            let offset = Vector3::from(*place);
            let corners = cube.vertices.iter();
            let corners = corners.map(|p| (p + offset).map(|x| (2.0 * x).round() / 2.0));
            numbers.extend(corners.map(|corner| welder.add(corner)));
            triangles.extend(cube.triangles.iter().map(|t| t.map(|i| i + start)));
        }
        for corner in triangles.as_flattened_mut() {
            *corner = numbers[*corner as usize];
        }
        Mesh {
            vertices: welder.into_points().unwrap(),
            triangles,
        }
    }

    fn bodies(mesh: &Mesh) -> usize {
        let mut sets = DisjointSets::new(mesh.vertices.len());
        for &[a, b, c] in &mesh.triangles {
            sets.join(a, b);
            sets.join(b, c);
        }
        sets.members().len()
    }

    #[test]
    fn cubes_that_touch_are_two_bodies() {
        for (place, shared) in [
            ([1.0, 0.0, 0.0], 4),
            ([1.0, 1.0, 0.0], 2),
            ([1.0, 1.0, 1.0], 1),
        ] {
            let touching = cubes(&[[0.0; 3], place]);
            assert_eq!(
                (bodies(&touching), touching.vertices.len()),
                (1, 16 - shared)
            );
            let found = apart(touching);
            assert_eq!((bodies(&found), found.vertices.len()), (2, 16), "{place:?}");
        }
    }

    #[test]
    fn a_row_round_a_corner_is_three_bodies_and_one_body_stays_as_it_is() {
        let found = apart(cubes(&[[0.0; 3], [1.0, 1.0, 0.0], [2.0, 0.0, 0.0]]));
        assert_eq!(bodies(&found), 3);
        let ball = Mesh::radial(6, |_| 1.0);
        assert_eq!(apart(ball.clone()), ball);
    }
}
