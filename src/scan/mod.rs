//! Reading scans: one reader per format into one [`Scan`].

use nalgebra::Point3;

/// The points of a scan, in f64, in the file's own frame and unit.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Scan {
    /// All points in file order, duplicates included.
    pub points: Vec<Point3<f64>>,
    /// Three indices into `points` per triangle; empty when the file holds points only.
    pub triangles: Vec<[u32; 3]>,
    /// What was odd in the file, but did not stop the reader: whole sentences.
    pub warnings: Vec<String>,
    pub topology: Option<Topology>,
}
#[derive(Debug, Clone, PartialEq)]
pub struct Topology {
    pub closed: bool,
    pub bodies: usize,
}
