//! The formats of meshes by name.

use std::io::Write;
use std::path::Path;
use std::str::FromStr;

use super::glb::write_glb;
use super::mesh::write_detailed_ply;
use super::vtp::write_vtp;
use super::{Detail, WriteError, write_obj, write_stl};
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
    /// VTK PolyData, which ParaView and PyVista open: 64-bit numbers.
    Vtp,
    /// Binary glTF 2.0, which viewers of many kinds open: 32-bit numbers, seen from the middle of the mesh.
    Glb,
}

impl MeshFormat {
    /// The format that a path's extension names, in letters of either case.
    pub fn of(path: &Path) -> Option<Self> {
        let extension = path.extension()?.to_str()?;
        extension.parse().ok()
    }

    /// Writes a mesh in this format.
    ///
    /// # Errors
    ///
    /// [`WriteError`]: a coordinate that the format cannot hold, a broken index, or a failing writer.
    pub fn write(self, mesh: &Mesh, writer: &mut dyn Write) -> Result<(), WriteError> {
        self.write_detailed(mesh, &Detail::default(), writer)
    }

    /// Writes a mesh and what is known at its vertices, as far as the format holds it: PLY and VTP hold normals and
    /// fields, GLB colours too, STL and OBJ nothing.
    ///
    /// # Errors
    ///
    /// Those of [`Self::write`].
    pub fn write_detailed(
        self,
        mesh: &Mesh,
        detail: &Detail,
        mut writer: &mut dyn Write,
    ) -> Result<(), WriteError> {
        match self {
            Self::Stl => write_stl(mesh, &mut writer),
            Self::Ply => write_detailed_ply(mesh, detail, &mut writer),
            Self::Obj => write_obj(mesh, &mut writer),
            Self::Vtp => write_vtp(mesh, detail, &mut writer),
            Self::Glb => write_glb(mesh, detail, &mut writer),
        }
    }
}

impl FromStr for MeshFormat {
    type Err = &'static str;

    fn from_str(name: &str) -> Result<Self, Self::Err> {
        match name.to_ascii_lowercase().as_str() {
            "stl" => Ok(Self::Stl),
            "ply" => Ok(Self::Ply),
            "obj" => Ok(Self::Obj),
            "vtp" => Ok(Self::Vtp),
            "glb" => Ok(Self::Glb),
            _ => Err("expected stl, ply, obj, vtp or glb"),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_name_may_have_letters_of_either_case() {
        for name in ["stl", "STL", "Stl"] {
            assert_eq!(name.parse(), Ok(MeshFormat::Stl));
            let path = Path::new("a").with_extension(name);
            assert_eq!(MeshFormat::of(&path), Some(MeshFormat::Stl));
        }
        assert!("xyz".parse::<MeshFormat>().is_err());
    }
}
