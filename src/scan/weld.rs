//! Makes corners at the same place one point again, as formats without shared points need.

use std::collections::HashMap;

use nalgebra::Point3;

use super::topology::each_edge;
use super::{ParseError, Scan};
use crate::mesh::Mesh;

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

/// For each point the first one at the same place.
pub(super) fn first_at_same_place(points: &[Point3<f64>]) -> Vec<u32> {
    let mut welder = Welder::default();
    let mut firsts = Vec::new();
    let first = |(&point, index)| {
        let place = welder.add(point) as usize;
        if place == firsts.len() {
            firsts.push(index);
        }
        firsts[place]
    };
    points.iter().zip(0..).map(first).collect()
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
        for corners in &self.triangles {
            let [a, b, c] = corners.map(|corner| same[corner as usize]);
            if a == b || b == c || c == a {
                continue;
            }
            triangles.push([a, b, c].map(|corner| {
                *numbers[corner as usize].get_or_insert_with(|| {
                    vertices.push(self.points[corner as usize]);
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
