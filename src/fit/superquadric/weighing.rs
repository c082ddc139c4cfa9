//! What a fit weighs points, exponents and parts by.

use super::form::Form;
use super::loss::Loss;

/// What a fit weighs points by.
#[derive(Debug, Clone, Copy)]
pub(super) struct Weighing {
    pub(super) form: Form,
    pub(super) loss: Loss,
    /// What the square of a logarithm of an exponent off the usual one costs.
    pub(super) prior: f64,
    /// How sharply the least of the parts' distances is taken, in one over mean radii.
    pub(super) sharpness: f64,
}
