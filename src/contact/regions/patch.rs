//! A part of a surface as triangles that are made smaller where two bodies are near each other.

use crate::mesh::{Bounds, undirected};
use crate::model::Surface;
use nalgebra::{Isometry3, Point3, Vector3};
use std::collections::HashMap;

/// Cells along an edge of the cube of directions of the first triangles.
const CELLS: usize = 16;

/// Of a triangle whose edges' middles are off by some distance, the surface is nowhere farther off than so many times
/// that: 4 / 3 of a parabola.
const SAG: f64 = 2.0;

/// How much less the surface is off triangles of half the size, at least: 4 times of a parabola.
const FINER: f64 = 3.0;

/// Triangles between points of a surface.
#[derive(Debug, Clone, Default)]
pub(super) struct Patch {
    /// Of every vertex.
    pub(super) directions: Vec<Vector3<f64>>,
    /// In the frame of the body's scan.
    pub(super) vertices: Vec<Point3<f64>>,
    pub(super) triangles: Vec<[u32; 3]>,
    /// How far the surface may be from each triangle.
    sags: Vec<f64>,
    /// What is known of each vertex: whether it lies in the other body.
    pub(super) known: Vec<Option<bool>>,
}

impl Patch {
    /// The whole surface.
    pub(super) fn whole(surface: &(impl Surface + ?Sized)) -> Self {
        let (directions, triangles) = surface.grid(CELLS);
        let mut whole = Self {
            vertices: points(surface, &directions),
            known: vec![None; directions.len()],
            sags: vec![f64::INFINITY; triangles.len()],
            directions,
            triangles,
        };
        // By how much triangles of half and of a quarter the size are off what these are, together.
        let half = whole.finer(surface);
        let quarter = half.finer(surface);
        let off = |patch: &Self| -> Vec<f64> {
            let fours = patch.sags.chunks(4);
            fours
                .map(|four| FINER * four.iter().fold(0.0, |most: f64, sag| most.max(*sag)))
                .collect()
        };
        let beyond = off(&quarter);
        let most = |four: &[f64]| four.iter().fold(0.0, |most: f64, off| most.max(*off));
        whole.sags = off(&half)
            .iter()
            .zip(beyond.chunks(4))
            .map(|(off, four)| off + most(four))
            .collect();
        whole
    }

    /// The same surface by four triangles for each.
    pub(super) fn finer(&self, surface: &(impl Surface + ?Sized)) -> Self {
        let mut middles: HashMap<[u32; 2], u32> = HashMap::new();
        let mut directions = self.directions.clone();
        let mut ends = Vec::new();
        let mut triangles = Vec::with_capacity(4 * self.triangles.len());
        for &[a, b, c] in &self.triangles {
            let [d, e, f] = [[a, b], [b, c], [c, a]].map(|edge| {
                *middles.entry(undirected(edge)).or_insert_with(|| {
                    let [one, two] = edge.map(|end| directions[end as usize]);
                    directions.push((one + two).normalize());
                    ends.push(undirected(edge));
                    directions.len() as u32 - 1
                })
            });
            triangles.extend([[d, e, f], [a, d, f], [d, b, e], [f, e, c]]);
        }
        let old = self.vertices.len();
        let mut vertices = self.vertices.clone();
        vertices.extend(points(surface, &directions[old..]));
        let off: Vec<f64> = ends
            .iter()
            .zip(&vertices[old..])
            .map(|(ends, middle)| {
                let [one, two] = ends.map(|end| vertices[end as usize]);
                (middle - nalgebra::center(&one, &two)).norm()
            })
            .collect();
        let sags = triangles.chunks(4).flat_map(|four| {
            let most = four[0].iter().map(|&middle| off[middle as usize - old]);
            [SAG / FINER * most.fold(0.0, f64::max); 4]
        });
        let mut known = self.known.clone();
        known.resize(vertices.len(), None);
        Self {
            sags: sags.collect(),
            directions,
            vertices,
            triangles,
            known,
        }
    }

    /// Some of the triangles, by their numbers in ascending order, and the vertices that they have, of each of which it is
    /// `known` whether it lies in the other body.
    pub(super) fn part(&self, kept: &[u32], known: &[Option<bool>]) -> Self {
        let mut numbers = HashMap::new();
        let mut part = Self::default();
        for &triangle in kept {
            let corners = self.triangles[triangle as usize].map(|old| {
                *numbers.entry(old).or_insert_with(|| {
                    part.directions.push(self.directions[old as usize]);
                    part.vertices.push(self.vertices[old as usize]);
                    part.known.push(known[old as usize]);
                    part.vertices.len() as u32 - 1
                })
            });
            part.triangles.push(corners);
            part.sags.push(self.sags[triangle as usize]);
        }
        part
    }

    /// The area of all triangles along their normals.
    pub(super) fn area(&self) -> Vector3<f64> {
        let area = |corners: &[u32; 3]| {
            let [a, b, c] = corners.map(|i| self.vertices[i as usize]);
            0.5 * (b - a).cross(&(c - a))
        };
        self.triangles.iter().map(area).sum()
    }

    /// Moved.
    pub(super) fn placed(&self, pose: &Isometry3<f64>) -> Vec<Point3<f64>> {
        self.vertices.iter().map(|vertex| pose * vertex).collect()
    }

    /// Boxes round all that is within `margin` of the surface over each triangle, of vertices that were moved.
    pub(super) fn bounds(&self, placed: &[Point3<f64>], margin: f64) -> Vec<Bounds> {
        let corners = |triangle: &[u32; 3]| triangle.map(|i| placed[i as usize]);
        let all = self.triangles.iter().zip(&self.sags);
        all.map(|(triangle, sag)| Bounds::new(corners(triangle), sag + margin))
            .collect()
    }

    /// The direction of the middle of a triangle.
    pub(super) fn direction(&self, triangle: u32) -> Vector3<f64> {
        let corners = self.triangles[triangle as usize].iter();
        let sum: Vector3<f64> = corners.map(|&i| self.directions[i as usize]).sum();
        sum.normalize()
    }

    /// The radius of a sphere about a point that the surface lies in.
    pub(super) fn radius(&self, centre: &Point3<f64>) -> f64 {
        let away = self.vertices.iter().map(|vertex| (vertex - centre).norm());
        away.fold(0.0, f64::max) + self.largest_sag()
    }

    /// The volume of the triangles of a whole surface, seen from a point.
    pub(super) fn volume(&self, from: &Point3<f64>) -> f64 {
        let cone = |corners: &[u32; 3]| {
            let [a, b, c] = corners.map(|i| self.vertices[i as usize] - from);
            a.dot(&b.cross(&c)) / 6.0
        };
        self.triangles.iter().map(cone).sum()
    }

    /// The most by which the surface may be off a triangle.
    pub(super) fn largest_sag(&self) -> f64 {
        self.sags.iter().copied().fold(0.0, f64::max)
    }
}

fn points(surface: &(impl Surface + ?Sized), directions: &[Vector3<f64>]) -> Vec<Point3<f64>> {
    let centre = surface.frame().centre;
    let places = surface.places(directions).into_iter();
    places.map(|place| centre + place).collect()
}
