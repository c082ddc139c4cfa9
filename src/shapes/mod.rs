//! Grains and simple shapes in closed form, and synthetic scans of them: surfaces whose truth is
//! known.
//!
//! All lengths are in millimetres. But for [`Curled`] ones, every body is star-shaped about the origin of its own frame. That
//! of a grain is near its centroid but not at it, with the grain's length along x, its width along y
//! and its thickness along z. That of a shape is its centroid, with the shape's axes along x, y and z.

mod axes;
mod bean;
mod bicone;
mod body;
mod bump;
mod chickpea;
mod cuboid;
mod curled;
mod cylinder;
mod ellipsoid;
mod gauge;
mod lying;
mod maize;
mod octahedron;
mod profile;
mod random;
mod sampling;
mod sampling_density;
mod section;
mod solid;
mod sphere;
mod strategy;
mod subject;
mod synth;
mod tray;

pub use axes::{AxesError, MAX_AXIS, MIN_AXIS};
pub use bean::bean;
pub use bicone::Bicone;
pub use body::{Body, UnknownBody};
pub use bump::{Bump, Bumpy};
pub use chickpea::chickpea;
pub use cuboid::Cuboid;
pub use curled::{Curled, CurledError, CurledOptions, CurledScan, CurledTruth, synthesize_curled};
pub use cylinder::Cylinder;
pub use ellipsoid::Ellipsoid;
pub use maize::{Wedge, maize};
pub use octahedron::Octahedron;
pub use sampling::{MAX_POINTS, MIN_POINTS, Sampling, SamplingError, UnknownSampling};
pub use sampling_density::SamplingDensity;
pub use solid::Solid;
pub use sphere::Sphere;
pub use strategy::{Spacing, Strategy};
pub use subject::Subject;
pub use synth::{MAX_NOISE, SynthError, SynthOptions, SyntheticScan, Truth, synthesize};
pub use tray::{Origin, SyntheticTray, TRAY_GRAINS, TrayError, TrayOptions, synthesize_tray};
