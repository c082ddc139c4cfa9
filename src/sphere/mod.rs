//! The unit sphere: directions and what is integrated over them. Knows nothing of grains.

mod quadrature;

pub use quadrature::GaussLegendre;
