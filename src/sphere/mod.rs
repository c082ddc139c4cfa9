//! The unit sphere: directions, bases, partitions, quadrature, triangulation. Knows nothing of
//! grains.

mod azimuth_fft;
mod cap;
mod cap_basis;
mod cap_expansion;
mod cell_weight;
mod compass;
mod cover;
mod cube_cell;
mod cube_grid;
mod cube_place;
mod face_places;
mod face_rectangle;
mod harmonics;
mod jet;
mod jets;
mod partition;
mod quadrature;
mod ring_grid;
mod symmetry;
mod tangents;
mod transform;
mod triangulation;
mod unit;

pub(crate) use azimuth_fft::AzimuthFft;
pub(crate) use cap::{Cap, Places};
pub(crate) use cap_basis::CapBasis;
pub use cap_basis::coefficient_count;
pub(crate) use cap_expansion::CapExpansion;
pub use cell_weight::MARGIN;
pub(crate) use compass::compass;
pub use cover::{Cover, CoverError, MAX_FACE_PARTS};
pub use cube_cell::CubeCell;
pub use cube_grid::{FINEST_GRID, cube_grid};
pub(crate) use cube_place::{cube_place, part};
pub(crate) use face_places::FacePlaces;
pub(crate) use face_rectangle::FaceRectangle;
pub use harmonics::{HarmonicBasis, harmonic_index, harmonics};
pub(crate) use jet::Jet;
pub(crate) use jets::Jets;
pub use partition::{AngleRectangle, AngularPartition};
pub(crate) use partition::{azimuth_fraction, polar_fraction};
pub(crate) use quadrature::GaussLegendre;
pub(crate) use ring_grid::RingGrid;
pub use symmetry::{Symmetry, SymmetryError};
pub(crate) use tangents::{across, tangents};
pub(crate) use transform::{
    AccurateHarmonics, HarmonicGram, Interpolant, LowerTriangle, ScatteredHarmonics,
};
pub use triangulation::{TriangulationError, triangulate_directions};
pub(crate) use unit::unit;
