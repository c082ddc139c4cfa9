//! Makes corners at the same place one point again, as formats without shared points need.

use std::collections::HashMap;

use nalgebra::Point3;

use super::topology::each_edge;
use super::{ParseError, Scan};
use crate::digits::plural;
use crate::mesh::Mesh;

/// Corners of an open rim this near, relative to the longest side of the scan, are one corner.
///
/// The value stands between two measured ones: corners that were computed twice and rounded to
/// 32 bits differ by some 2e-7 of the scan, and the shortest edges of sound meshes, of a million
/// triangles too, are above 2e-4.
const NEAR: f64 = 1e-6;

/// Numbers distinct points in the order in which they come.
#[derive(Default)]
pub(super) struct Welder {
    numbers: HashMap<[u64; 3], u32>,
    points: Vec<Point3<f64>>,
}

impl Welder {
    /// The number of the point equal to this one, with 0 and -0 equal. Past 2^32 points the
    /// number is meaningless, and `into_points` fails.
    pub(super) fn add(&mut self, point: Point3<f64>) -> u32 {
        let key = [point.x, point.y, point.z].map(|c| (c + 0.0).to_bits());
        *self.numbers.entry(key).or_insert_with(|| {
            self.points.push(point);
            (self.points.len() - 1) as u32
        })
    }

    pub(super) fn into_points(self) -> Result<Vec<Point3<f64>>, ParseError> {
        let points = self.points.len();
        match u32::try_from(points) {
            Ok(_) => Ok(self.points),
            Err(_) => Err(ParseError::TooManyPoints { points }),
        }
    }
}

/// Merges the corners along open rims that nearly coincide, and says so in a warning.
pub(super) fn close_gaps(scan: &mut Scan, extent: f64) {
    let mut on_rim = vec![false; scan.points.len()];
    each_edge(scan.points.len(), &scan.triangles, |edge| {
        if edge.triangles().len() == 1 {
            for end in edge.ends {
                on_rim[end as usize] = true;
            }
        }
    });
    let mut first_in_cell = HashMap::new();
    let mut kept = Vec::with_capacity(scan.points.len());
    let mut numbers = Vec::with_capacity(scan.points.len());
    for (&point, on_rim) in scan.points.iter().zip(on_rim) {
        let own = kept.len() as u32;
        let near = on_rim.then(|| nearby(&mut first_in_cell, point, own, NEAR * extent));
        numbers.push(near.flatten().unwrap_or(own));
        if near.flatten().is_none() {
            kept.push(point);
        }
    }
    let merged = scan.points.len() - kept.len();
    if merged > 0 {
        let corners = plural(merged, "corner");
        scan.warnings.push(format!(
            "Merged {corners} along open rims with another within {:.1e}.",
            NEAR * extent
        ));
        scan.points = kept;
        for corner in scan.triangles.as_flattened_mut() {
            *corner = numbers[*corner as usize];
        }
    }
}

/// The earlier point within `reach` along every axis, or none, and then `own` takes the cell.
/// Cells are `reach` wide, so that one point per cell is enough.
fn nearby(
    first_in_cell: &mut HashMap<[i64; 3], (Point3<f64>, u32)>,
    point: Point3<f64>,
    own: u32,
    reach: f64,
) -> Option<u32> {
    let cell = [point.x, point.y, point.z].map(|c| (c / reach).floor() as i64);
    for neighbour in 0..27_i64 {
        let step = [neighbour % 3 - 1, neighbour / 3 % 3 - 1, neighbour / 9 - 1];
        let key = [0, 1, 2].map(|axis| cell[axis].saturating_add(step[axis]));
        if let Some(&(other, number)) = first_in_cell.get(&key)
            && (other - point).amax() <= reach
        {
            return Some(number);
        }
    }
    first_in_cell.insert(cell, (point, own));
    None
}

/// For each point the number of its place; places are numbered in the order in which they come.
pub(super) fn first_at_same_place(points: &[Point3<f64>]) -> Vec<u32> {
    let mut welder = Welder::default();
    points.iter().map(|&point| welder.add(point)).collect()
}

impl Scan {
    /// The faces over points that are all in use, and distinct unless the faces close without that: then bodies that
    /// touch stay apart, as [`Topology::bodies`](super::Topology::bodies) counts them.
    pub(crate) fn welded(&self) -> Mesh {
        let mut is_closed = true;
        each_edge(self.points.len(), &self.triangles, |edge| {
            is_closed &= (edge.forward, edge.backward) == (1, 1);
        });
        let same = match is_closed {
            true => (0..self.points.len() as u32).collect(),
            false => first_at_same_place(&self.points),
        };
        let mut numbers = vec![None; self.points.len()];
        let mut vertices: Vec<Point3<f64>> = Vec::new();
        let mut triangles = Vec::with_capacity(self.triangles.len());
        // The number given first to a place names the point that stands for it.
        let mut firsts = vec![u32::MAX; self.points.len()];
        for (index, &number) in same.iter().enumerate() {
            let first = &mut firsts[number as usize];
            *first = (*first).min(index as u32);
        }
        for corners in &self.triangles {
            let [a, b, c] = corners.map(|corner| same[corner as usize]);
            if a == b || b == c || c == a {
                continue;
            }
            triangles.push([a, b, c].map(|corner| {
                *numbers[corner as usize].get_or_insert_with(|| {
                    vertices.push(self.points[firsts[corner as usize] as usize]);
                    vertices.len() as u32 - 1
                })
            }));
        }
        Mesh {
            vertices,
            triangles,
        }
    }
}

#[cfg(test)]
mod tests {
    use nalgebra::Vector3;

    use super::*;

    /// A tetrahedron whose faces share no corners, each corner moved by `step` per face.
    fn loose(step: f64) -> Scan {
        let corners = [Vector3::zeros(), Vector3::x(), Vector3::y(), Vector3::z()];
        let faces = [[0, 2, 1], [0, 1, 3], [1, 2, 3], [0, 3, 2]];
        let mut scan = Scan::default();
        for (face, ends) in faces.into_iter().enumerate() {
            let shift = Vector3::repeat(step * face as f64);
            scan.points
                .extend(ends.map(|end: usize| Point3::from(corners[end] + shift)));
            let first = 3 * face as u32;
            scan.triangles.push([first, first + 1, first + 2]);
        }
        scan
    }

    #[test]
    fn corners_within_reach_are_merged_and_reported() {
        let mut scan = loose(1e-7);
        close_gaps(&mut scan, 1.0);
        assert_eq!(scan.points.len(), 4);
        assert!(
            scan.warnings[0].starts_with("Merged 8 corners "),
            "{:?}",
            scan.warnings
        );
        let mut open = 0;
        each_edge(4, &scan.triangles, |edge| {
            open += usize::from(edge.triangles().len() != 2)
        });
        assert_eq!(open, 0);
    }

    #[test]
    fn corners_farther_apart_stay() {
        let mut scan = loose(1e-4);
        close_gaps(&mut scan, 1.0);
        assert_eq!(scan, loose(1e-4));
    }
}
