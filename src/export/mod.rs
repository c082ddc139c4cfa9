//! Writing meshes and point clouds, whole or not at all.

mod atomic;
mod error;
mod mesh;
mod points;

use std::path::Path;

use crate::mesh::Mesh;

pub use atomic::write_atomically;
pub use error::{SaveError, WriteError};
pub use mesh::{write_obj, write_ply, write_stl};
pub use points::{write_points_ply, write_points_xyz};

/// Saves a mesh in the format that the path's extension names: `stl`, `ply` or `obj`.
///
/// # Errors
///
/// [`SaveError`]; then nothing was written, and an older file of that name is as it was.
pub fn save_mesh(path: &Path, mesh: &Mesh) -> Result<(), SaveError> {
    let extension = path.extension().map(|e| e.to_ascii_lowercase());
    match extension.as_ref().and_then(|e| e.to_str()) {
        Some("stl") => write_atomically(path, |writer| write_stl(mesh, writer)),
        Some("ply") => write_atomically(path, |writer| write_ply(mesh, writer)),
        Some("obj") => write_atomically(path, |writer| write_obj(mesh, writer)),
        _ => Err(SaveError::UnknownExtension { path: path.into() }),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_extension_chooses_the_format() {
        let folder = tempfile::tempdir().unwrap();
        let save = |name: &str| {
            let path = folder.path().join(name);
            save_mesh(&path, &Mesh::default()).map(|()| std::fs::read(path).unwrap())
        };
        assert_eq!(save("a.STL").unwrap().len(), 84);
        assert!(save("a.ply").unwrap().starts_with(b"ply\n"));
        assert_eq!(save("a.obj").unwrap(), b"");
        for name in ["a.vtk", "stl"] {
            let error = save(name).unwrap_err().to_string();
            assert!(error.ends_with("must be stl, ply or obj"), "{error}");
        }
    }
}
