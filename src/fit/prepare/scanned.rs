//! What is known of the surface that a scan draws.

use super::reference::ReferenceKind;
use crate::fit::warning::FitWarning;
use crate::mesh::Mesh;
use crate::model::Unseen;
use nalgebra::Point3;
use std::borrow::Cow;

/// The surface that a scan draws, and the points that lie on it.
#[derive(Debug, Clone)]
pub struct ScannedSurface<'a> {
    /// A closed mesh through the points or, of large clouds, through representatives of them.
    pub mesh: Mesh,
    /// What the mesh is made of.
    pub kind: ReferenceKind,
    /// The faces that were seen, where they are not those of the mesh.
    pub(crate) faces: Option<Mesh>,
    /// The points to fit: without strays and without vertices that no face uses.
    pub(crate) points: Cow<'a, [Point3<f64>]>,
    /// One point per small patch of directions, where the cloud is large.
    pub(crate) representatives: Option<Vec<Point3<f64>>>,
    /// What was not seen, if it is large.
    pub(crate) unseen: Option<Unseen>,
    /// Whether that is only because the points are few for a body as thin.
    pub(crate) is_sparse: bool,
    /// Whether that are holes none of which is large.
    pub(crate) is_many: bool,
    /// What a user should know.
    pub warnings: Vec<FitWarning>,
}

impl ScannedSurface<'_> {
    /// The faces that were seen; none of a cloud.
    pub(crate) fn seen_faces(&self) -> Option<&Mesh> {
        match self.kind {
            ReferenceKind::Faces | ReferenceKind::Voxels => {
                self.faces.as_ref().or(Some(&self.mesh))
            }
            ReferenceKind::Directions | ReferenceKind::Crust => self.faces.as_ref(),
        }
    }
}
