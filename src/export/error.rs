//! Why a file was not written.

use std::io;
use std::path::PathBuf;

/// Why a mesh or cloud could not be written.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum WriteError {
    /// The writer failed: a full disk, a closed pipe.
    #[error("the output could not be written")]
    Io(#[from] io::Error),
    /// The format counts in 32 bits: make the mesh coarser.
    #[error("{count} {what} are more than the format can count (4294967295); use a coarser mesh")]
    TooMany {
        /// `triangles` or `vertices`.
        what: &'static str,
        /// How many there are.
        count: usize,
    },
    /// A triangle names a vertex that does not exist: the mesh is broken.
    #[error("triangle {triangle} names vertex {vertex}, but the mesh has {vertices} vertices")]
    NoSuchVertex {
        /// The triangle, counted from zero.
        triangle: usize,
        /// The index it holds.
        vertex: u32,
        /// How many vertices the mesh has.
        vertices: usize,
    },
    /// A coordinate is NaN or infinite, or too large for the 32 bits of STL: use PLY or OBJ.
    #[error("vertex {vertex} has a coordinate that the format cannot hold: {value}")]
    OutOfRange {
        /// The vertex, counted from zero.
        vertex: usize,
        /// The coordinate.
        value: f64,
    },
}

/// Why a file could not be saved; names the file.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum SaveError {
    /// The extension names no format that is written here.
    #[error("cannot save {}: its extension must be stl, ply, obj, vtp or glb", path.display())]
    UnknownExtension {
        /// The file asked for.
        path: PathBuf,
    },
    /// The folder is not there: create it first.
    #[error("cannot save {}: the folder {} does not exist", path.display(), folder.display())]
    NoFolder {
        /// The file asked for.
        path: PathBuf,
        /// The folder that is missing.
        folder: PathBuf,
    },
    /// The content could not be produced or written.
    #[error("cannot save {}", path.display())]
    Write {
        /// The file asked for.
        path: PathBuf,
        /// What failed.
        source: WriteError,
    },
}
