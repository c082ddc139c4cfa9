//! What is drawn.

use super::Colour;
use crate::mesh::Mesh;
use nalgebra::{Point3, Vector3};

/// Surfaces, points and lines. Lengths are those of the scene; widths are in pixels.
#[derive(Debug, Clone, Default, PartialEq)]
pub(crate) struct Scene {
    /// Corners of the triangles.
    pub corners: Vec<Corner>,
    /// Three indices into `corners` per triangle, either way round.
    pub triangles: Vec<[u32; 3]>,
    /// Points.
    pub dots: Vec<Dot>,
    /// Lines.
    pub lines: Vec<Line>,
}

/// A corner of triangles, between which normal and colour are interpolated.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Corner {
    /// Where it is.
    pub place: Point3<f64>,
    /// The surface's own unit normal, by which it is lit.
    pub normal: Vector3<f64>,
    /// Its colour in full light.
    pub colour: Colour,
}

/// A round point.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Dot {
    /// Where it is.
    pub place: Point3<f64>,
    /// Its colour, not lit.
    pub colour: Colour,
    /// Its diameter, in pixels.
    pub width: f64,
}

/// A line through some places.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Line {
    /// The places.
    pub places: Vec<Point3<f64>>,
    /// Its colour, not lit.
    pub colour: Colour,
    /// Its width, in pixels.
    pub width: f64,
}

impl Scene {
    /// Adds a surface: a mesh, with a unit normal and a colour for every vertex. What has no partner is left out.
    pub(crate) fn add_mesh(&mut self, mesh: &Mesh, normals: &[Vector3<f64>], colours: &[Colour]) {
        let first = self.corners.len();
        let parts = mesh.vertices.iter().zip(normals).zip(colours);
        self.corners
            .extend(parts.map(|((place, normal), colour)| Corner {
                place: *place,
                normal: *normal,
                colour: *colour,
            }));
        let last = self.corners.len();
        let moved = mesh
            .triangles
            .iter()
            .map(|corners| corners.map(|corner| first as u32 + corner));
        let is_there = |corners: &[u32; 3]| corners.iter().all(|corner| (*corner as usize) < last);
        self.triangles.extend(moved.filter(is_there));
    }
}
