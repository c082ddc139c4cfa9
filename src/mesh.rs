//! A triangle mesh: what a scan may bring, what a fitted grain is exported as.

use nalgebra::Point3;

/// Triangles over shared vertices, wound counter-clockwise when seen from outside.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Mesh {
    /// Corner positions, in the scan's unit and frame.
    pub vertices: Vec<Point3<f64>>,
    /// Three indices into `vertices` per triangle.
    pub triangles: Vec<[u32; 3]>,
}
