//! The unit sphere: directions, bases, partitions, quadrature, triangulation. Knows nothing of
//! grains.

mod cap;
mod cap_basis;
mod cube_grid;
mod harmonics;
mod partition;
mod quadrature;
mod triangulation;

pub use cap::{Cap, Places};
pub use cap_basis::{CapBasis, coefficient_count};
pub use cube_grid::cube_grid;
pub use harmonics::{harmonic_index, harmonics};
pub use partition::{AngleRectangle, AngularPartition};
pub(crate) use partition::{azimuth_fraction, polar_fraction};
pub use quadrature::GaussLegendre;
pub use triangulation::{TriangulationError, triangulate_directions};
