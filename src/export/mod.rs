//! Writing grains, meshes and point clouds, whole or not at all.
//!
//! ```
//! use grainform::{Mesh, export::write_stl};
//!
//! let ball = Mesh::radial(8, |_| 1.0);
//! let mut bytes = Vec::new();
//! write_stl(&ball, &mut bytes)?;
//! assert_eq!(bytes.len(), 84 + 50 * ball.triangles.len());
//! # Ok::<(), grainform::export::WriteError>(())
//! ```

mod atomic;
mod detail;
mod error;
mod format;
mod glb;
mod grain;
mod mesh;
mod points;
mod temporary;
mod vtp;

use std::path::Path;

use crate::mesh::Mesh;

pub use atomic::write_atomically;
pub use detail::Detail;
pub use error::{SaveError, WriteError};
pub use format::MeshFormat;
pub use grain::save_grain;
pub use mesh::{write_obj, write_ply, write_stl};
pub use points::{write_points_ply, write_points_xyz, write_split_grain};
#[cfg(feature = "cli")]
pub(crate) use temporary::remove_temporaries;
pub use temporary::sweep;

/// Saves a mesh in the format that the path's extension names: `stl`, `ply`, `obj`, `vtp` or `glb`.
///
/// # Errors
///
/// [`SaveError`]; then nothing was written, and an older file of that name is as it was.
pub fn save_mesh(path: &Path, mesh: &Mesh) -> Result<(), SaveError> {
    let format =
        MeshFormat::of(path).ok_or_else(|| SaveError::UnknownExtension { path: path.into() })?;
    write_atomically(path, |writer| format.write(mesh, writer))
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
            assert!(
                error.ends_with("must be stl, ply, obj, vtp or glb"),
                "{error}"
            );
        }
    }
}
