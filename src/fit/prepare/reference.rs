//! The reference surface of a scan: its own faces, or the triangulation of its directions.

/// What a fit is compared with. It is a polyhedron through the points, and itself off: low by
/// 0.4 % in area and 0.7 % in volume on 1538 points of a smooth bean, high by 2 % in area with noise
/// of 0.5 % of the radius on 6146 points.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Reference {
    /// Where it comes from.
    pub kind: ReferenceKind,
    /// Area, in the square of the scan's unit.
    pub area: f64,
    /// Volume, in the cube of the scan's unit.
    pub volume: f64,
    /// Volume that a smooth surface through the corners of large faces holds beyond them, likewise; zero where faces are
    /// small, for then the fit is such a surface.
    pub bulge: f64,
}

/// Where a reference surface comes from.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ReferenceKind {
    /// The scan's own faces, which are closed and of one piece.
    Faces,
    /// The same of a segmented volume: they part its voxels, and have their steps.
    Voxels,
    /// The spherical Delaunay triangulation of the points' directions.
    Directions,
    /// The middle of a crust of voxels around the points.
    Crust,
}

impl ReferenceKind {
    /// Whether faces are the scan's own, not made between its points.
    pub(crate) fn has_faces(self) -> bool {
        matches!(self, Self::Faces | Self::Voxels)
    }

    /// The name used in reports: "faces", "voxels", "directions" or "crust".
    pub fn name(&self) -> &'static str {
        match self {
            Self::Faces => "faces",
            Self::Voxels => "voxels",
            Self::Directions => "directions",
            Self::Crust => "crust",
        }
    }
}
