//! What goes with the vertices of a mesh.

use crate::annotate::Field;
use crate::mesh::Mesh;
use nalgebra::Vector3;

/// What is known at the vertices of a mesh. What has not a part for each vertex is not written.
#[derive(Debug, Clone, Copy, Default)]
pub struct Detail<'a> {
    /// Outward unit normals.
    pub normals: &'a [Vector3<f64>],
    /// Numbers.
    pub fields: &'a [Field],
    /// Colours in sRGB.
    pub colours: &'a [[u8; 3]],
}

impl<'a> Detail<'a> {
    pub(super) fn has_normals(&self, mesh: &Mesh) -> bool {
        !self.normals.is_empty() && self.normals.len() == mesh.vertices.len()
    }

    pub(super) fn has_colours(&self, mesh: &Mesh) -> bool {
        !self.colours.is_empty() && self.colours.len() == mesh.vertices.len()
    }

    pub(super) fn fields(&self, mesh: &Mesh) -> impl Iterator<Item = &'a Field> {
        let vertices = mesh.vertices.len();
        let fields = self.fields.iter();
        fields.filter(move |field| field.values.len() == vertices)
    }
}
