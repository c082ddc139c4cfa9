//! What a scan did not see of a grain.

use serde::{Deserialize, Serialize};
use std::f64::consts::PI;

/// A part of the surface that is too large to be told from what is round it.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase", deny_unknown_fields)]
#[non_exhaustive]
pub enum Unseen {
    /// A cap without points.
    Hole {
        /// Its half-angle, in radians.
        half_angle: f64,
    },
    /// Holes between the faces.
    Open {
        /// Their number.
        holes: usize,
        /// Area of the triangles that would close them, as a share of that of the faces.
        share: f64,
    },
}

impl Unseen {
    /// Its share of the sphere of directions, about.
    pub(crate) fn share(&self) -> f64 {
        match *self {
            Self::Hole { half_angle } => 0.5 * (1.0 - half_angle.cos()),
            Self::Open { share, .. } => share / (1.0 + share),
        }
    }

    /// Whether its numbers can be those of a surface.
    pub(super) fn is_sound(&self) -> bool {
        match *self {
            Self::Hole { half_angle } => (0.0..=PI).contains(&half_angle),
            Self::Open { share, .. } => share.is_finite() && share >= 0.0,
        }
    }
}
