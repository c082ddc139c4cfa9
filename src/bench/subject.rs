//! What is fitted: scans, and the truth behind those that are synthetic.

use crate::scan::Scan;
use crate::shapes::{Body, Sampling, SynthError, SynthOptions, synthesize};
use nalgebra::Point3;
use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;

/// Noise of the noisy synthetic scans: its standard deviation as a share of the mean radius.
pub const NOISE: f64 = 0.005;

/// Places in which the fitted radius is compared with the true one.
const PLACES: usize = 2000;

/// One point in so many is hidden where fits are judged by hidden points.
const ONE_IN_HIDDEN: u32 = 10;

/// A scan, and what is known of it.
#[derive(Debug, Clone)]
pub struct Subject {
    /// Name of the body, or the scan's file.
    pub name: String,
    /// The scan.
    pub scan: Scan,
    /// The closed form that it was taken from, if any.
    pub truth: Option<Truth>,
    /// Points that were taken out of the scan, to judge its fits.
    pub hidden: Vec<Point3<f64>>,
}

/// A closed form and how it was scanned. Lengths are in the scan's unit.
#[derive(Debug, Clone)]
pub struct Truth {
    /// Standard deviation of the radial noise, as a share of the mean radius.
    pub noise: f64,
    /// Area.
    pub area: f64,
    /// Volume.
    pub volume: f64,
    /// Mean radius over all directions from the body's origin.
    pub mean_radius: f64,
    /// Points of the surface, evenly distributed in direction.
    pub places: Vec<Point3<f64>>,
}

impl Subject {
    /// A body in its native size, scanned at about so many points with the cube's layout, with
    /// noise of a standard deviation given as a share of the mean radius.
    ///
    /// # Errors
    /// Those of [`synthesize`].
    pub fn synthetic(body: Body, points: usize, noise: f64) -> Result<Self, SynthError> {
        let synthetic = synthesize(&SynthOptions {
            points,
            noise,
            ..SynthOptions::clean(body)
        })?;
        let surface = body.surface();
        let directions = Sampling::Fibonacci.directions(PLACES, 0)?;
        let truth = synthetic.truth;
        Ok(Self {
            name: body.name().into(),
            scan: Scan {
                points: synthetic.points,
                ..Scan::default()
            },
            truth: Some(Truth {
                noise,
                area: truth.properties.area,
                volume: truth.properties.volume,
                mean_radius: truth.mean_radius,
                places: directions
                    .iter()
                    .map(|n| Point3::from(n * surface.radius(n)))
                    .collect(),
            }),
            hidden: Vec::new(),
        })
    }

    /// A scan of which nothing else is known.
    pub fn unknown(name: String, scan: Scan) -> Self {
        Self {
            name,
            scan,
            truth: None,
            hidden: Vec::new(),
        }
    }

    /// The subject with one point in ten, at random, hidden. Triangles are lost with them.
    #[must_use]
    pub fn with_hidden_points(self) -> Self {
        let mut random = ChaCha8Rng::seed_from_u64(0);
        let points = self.scan.points.iter().copied();
        let (hidden, seen) = points.partition(|_| random.next_u32() % ONE_IN_HIDDEN == 0);
        Self {
            scan: Scan::from_points(seen),
            hidden,
            ..self
        }
    }
}

/// The bean, the chickpea and the maize kernel of [`crate::shapes`], clean and with noise of
/// [`NOISE`].
///
/// # Errors
/// None in practice: those of [`synthesize`], whose options are in range here.
pub fn synthetic() -> Result<Vec<Subject>, SynthError> {
    let bodies = [Body::Bean, Body::Chickpea, Body::Maize];
    let scans = bodies.map(|body| {
        [0.0, NOISE].map(|noise| Subject::synthetic(body, body.native_points(), noise))
    });
    scans.into_iter().flatten().collect()
}
