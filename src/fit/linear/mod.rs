//! Least squares of narrow matrices, and positive definite matrices of sparse blocks.

mod factor;
mod householder;
mod sparse;

pub(crate) use factor::{Factorization, Triangle};
pub(crate) use sparse::{BlockFactor, BlockMatrix};
