//! The formats of meshes by name.

use std::io::Write;
use std::path::Path;
use std::str::FromStr;

use super::{WriteError, write_obj, write_ply, write_stl};
use crate::mesh::Mesh;

/// A format that meshes are written in.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum MeshFormat {
    /// Binary STL: 32-bit coordinates.
    Stl,
    /// Binary little-endian PLY: 64-bit coordinates.
    Ply,
    /// Wavefront OBJ: decimals that read back as the same numbers.
    Obj,
}

impl MeshFormat {
    /// The format that a path's extension names, in letters of either case.
    pub fn of(path: &Path) -> Option<Self> {
        let extension = path.extension()?.to_str()?;
        extension.to_ascii_lowercase().parse().ok()
    }

    /// Writes a mesh in this format.
    ///
    /// # Errors
    ///
    /// Those of [`write_stl`], [`write_ply`] and [`write_obj`].
    pub fn write(self, mesh: &Mesh, mut writer: &mut dyn Write) -> Result<(), WriteError> {
        match self {
            Self::Stl => write_stl(mesh, &mut writer),
            Self::Ply => write_ply(mesh, &mut writer),
            Self::Obj => write_obj(mesh, &mut writer),
        }
    }
}

impl FromStr for MeshFormat {
    type Err = &'static str;

    fn from_str(name: &str) -> Result<Self, Self::Err> {
        match name {
            "stl" => Ok(Self::Stl),
            "ply" => Ok(Self::Ply),
            "obj" => Ok(Self::Obj),
            _ => Err("expected stl, ply or obj"),
        }
    }
}
