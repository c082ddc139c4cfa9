//! Superquadrics and unions of them, fitted to points: few numbers, at the price of a rougher surface.
//!
//! The radial distances of the points are made small by the method of Levenberg and Marquardt, with derivatives in
//! closed form, bounds, and a loss that large distances do not dominate (Cauchy's, or Welsch's where many points are
//! astray).

mod between_voxels;
mod bodies;
mod cloud;
mod clusters;
mod distance;
mod error;
mod form;
mod least_squares;
mod loss;
mod multi;
mod normal_equations;
mod search;
mod single;
mod soft_minimum;
mod solid_errors;
mod standard_errors;
mod starts;
mod strays;
mod sums;
#[cfg(test)]
mod tests;
mod weighing;

pub use error::SuperquadricFitError;
pub use form::Form;
pub use multi::{MAX_UNION_PARTS, MultiFit, fit_multi_superquadric};
pub use single::{SuperquadricFit, fit_superquadric};
pub use solid_errors::SolidErrors;
pub use standard_errors::{AtBound, ParameterErrors};
