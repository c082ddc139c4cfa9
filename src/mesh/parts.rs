//! The parts that a mesh falls into.

use super::Mesh;
use crate::disjoint_sets::DisjointSets;
use std::collections::HashMap;

/// The triangles of each part of a mesh that shares no vertex with the rest, in order.
pub(crate) fn parts(mesh: &Mesh) -> Vec<Vec<usize>> {
    let mut sets = DisjointSets::new(mesh.vertices.len());
    for &[a, b, c] in &mesh.triangles {
        sets.join(a, b);
        sets.join(a, c);
    }
    let mut numbers = vec![usize::MAX; mesh.vertices.len()];
    let mut parts: Vec<Vec<usize>> = Vec::new();
    for (triangle, corners) in mesh.triangles.iter().enumerate() {
        let number = &mut numbers[sets.of(corners[0]) as usize];
        if *number == usize::MAX {
            *number = parts.len();
            parts.push(Vec::new());
        }
        parts[*number].push(triangle);
    }
    parts
}

/// Some triangles of a mesh and their vertices.
pub(crate) fn part(mesh: &Mesh, triangles: &[usize]) -> Mesh {
    let mut numbers = HashMap::new();
    let mut own = Mesh::default();
    for &triangle in triangles {
        let named = mesh.triangles[triangle].map(|corner| {
            *numbers.entry(corner).or_insert_with(|| {
                own.vertices.push(mesh.vertices[corner as usize]);
                own.vertices.len() as u32 - 1
            })
        });
        own.triangles.push(named);
    }
    own
}
