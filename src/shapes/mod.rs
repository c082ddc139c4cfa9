//! Grains in closed form, and synthetic scans of them: surfaces whose truth is known.
//!
//! All lengths are in millimetres. Every body is star-shaped about the origin of its own frame,
//! which is near its centroid but not at it, with its length along x, its width along y and its
//! thickness along z.

mod bean;
mod body;
mod bump;
mod chickpea;
mod ellipsoid;
mod maize;
mod random;
mod sampling;
mod sphere;
mod synth;

pub use bean::bean;
pub use body::{Body, UnknownBody};
pub use bump::{Bump, Bumpy};
pub use chickpea::chickpea;
pub use ellipsoid::Ellipsoid;
pub use maize::{Wedge, maize};
pub use sampling::{MAX_POINTS, MIN_POINTS, Sampling, SamplingError, UnknownSampling};
pub use sphere::Sphere;
pub use synth::{MAX_NOISE, SynthError, SynthOptions, SyntheticScan, Truth, synthesize};
