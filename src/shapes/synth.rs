//! Synthetic scans: a closed-form body seen with the faults of a real scanner.

use super::random::{Stream, random};
use super::{AxesError, MIN_POINTS, Sampling, SamplingError, Subject};
use crate::digits::plural;
use crate::measure::{Integrals, MassProperties};
use nalgebra::{Point3, Vector3};
use rand_distr::{Distribution, StandardNormal, StandardUniform};
use thiserror::Error;

/// Largest noise, as a share of the mean radius; beyond it a radius could turn negative.
pub const MAX_NOISE: f64 = 0.1;

/// Rounding of the points where they lie, as a share of the mean radius, at most.
const ROUNDED: f64 = 1e-7;

/// How far an outlier is moved, as a share of its radius.
const OUTLIER_STEP: f64 = 0.2;

/// What to scan and how badly.
///
/// ```
/// use grainform::shapes::{Body, SynthOptions, synthesize};
///
/// let options = SynthOptions::clean(Body::Bean).with_points(386).with_noise(0.005);
/// assert_eq!(synthesize(&options)?.points.len(), 386);
/// # Ok::<(), grainform::shapes::SynthError>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct SynthOptions {
    /// The body.
    pub body: Subject,
    /// Semi-axes of a shape, see [`Body::with_axes`](super::Body::with_axes); `None` for the native ones, of a grain,
    /// and of a superquadric, which has its own.
    pub axes: Option<Vector3<f64>>,
    /// Number of directions, see [`Sampling::directions`] for how far it is met.
    pub points: usize,
    /// Layout of the directions.
    pub sampling: Sampling,
    /// Standard deviation of the Gaussian, radial noise, as a share of the body's mean radius: 0 to
    /// [`MAX_NOISE`].
    pub noise: f64,
    /// Probability, 0 to 1, that a point is an outlier: moved by 20 % of its radius, inwards or
    /// outwards at even odds.
    pub outliers: f64,
    /// Half-opening angle in degrees, 0 to 180, of the cap around -z that the scan did not see.
    pub missing_cap: f64,
    /// Where the body's origin lies in the scan, in millimetres.
    pub offset: Vector3<f64>,
    /// Seed of everything random.
    pub seed: u64,
}

impl SynthOptions {
    /// A clean scan of a whole body at its native number of points, with the cube's layout.
    pub fn clean(body: impl Into<Subject>) -> Self {
        let body = body.into();
        Self {
            body,
            axes: None,
            points: body.native_points(),
            sampling: Sampling::Cube,
            noise: 0.0,
            outliers: 0.0,
            missing_cap: 0.0,
            offset: Vector3::zeros(),
            seed: 0,
        }
    }

    /// The same with these [`axes`](Self::axes).
    pub fn with_axes(self, axes: impl Into<Option<Vector3<f64>>>) -> Self {
        let axes = axes.into();
        Self { axes, ..self }
    }

    /// The same with another number of [`points`](Self::points).
    pub fn with_points(self, points: usize) -> Self {
        Self { points, ..self }
    }

    /// The same with another [`sampling`](Self::sampling).
    pub fn with_sampling(self, sampling: Sampling) -> Self {
        Self { sampling, ..self }
    }

    /// The same with this [`noise`](Self::noise).
    pub fn with_noise(self, noise: f64) -> Self {
        Self { noise, ..self }
    }

    /// The same with this share of [`outliers`](Self::outliers).
    pub fn with_outliers(self, outliers: f64) -> Self {
        Self { outliers, ..self }
    }

    /// The same with this [`missing_cap`](Self::missing_cap).
    pub fn with_missing_cap(self, missing_cap: f64) -> Self {
        Self {
            missing_cap,
            ..self
        }
    }

    /// The same at another [`offset`](Self::offset).
    pub fn with_offset(self, offset: Vector3<f64>) -> Self {
        Self { offset, ..self }
    }

    /// The same with another [`seed`](Self::seed).
    pub fn with_seed(self, seed: u64) -> Self {
        Self { seed, ..self }
    }
}

/// Why there is no synthetic scan.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum SynthError {
    /// The directions could not be laid out.
    #[error(transparent)]
    Sampling(#[from] SamplingError),
    /// The body cannot have the semi-axes.
    #[error(transparent)]
    Axes(#[from] AxesError),
    /// Give the noise as a share of the mean radius.
    #[error("the noise must lie between 0 and {MAX_NOISE} of the mean radius, not at {noise}")]
    Noise {
        /// The noise asked for.
        noise: f64,
    },
    /// Give the outliers as a share of the points.
    #[error("the share of outliers must lie between 0 and 1, not at {outliers}")]
    Outliers {
        /// The share asked for.
        outliers: f64,
    },
    /// Give the cap's half-opening angle in degrees.
    #[error("the missing cap must open by 0 to 180 degrees, not by {missing_cap}")]
    MissingCap {
        /// The angle asked for.
        missing_cap: f64,
    },
    /// Give a smaller offset.
    #[error(
        "the offset must be finite, and not so far that the points lose their digits: some 1e8 times the body's size"
    )]
    Offset,
    /// Make the missing cap smaller or take more points.
    #[error("the missing cap leaves {}, fewer than {MIN_POINTS}", plural(*left, "point"))]
    NothingLeft {
        /// Points outside the cap.
        left: usize,
    },
}

/// A synthetic scan and what it is a scan of.
#[derive(Debug, Clone, PartialEq)]
pub struct SyntheticScan {
    /// The points, in millimetres, in the scan's frame.
    pub points: Vec<Point3<f64>>,
    /// The body they were taken from, without noise, outliers or gaps.
    pub truth: Truth,
}

/// What a body truly measures, in millimetres.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Truth {
    /// The body.
    pub body: Subject,
    /// Mean radius over all directions from the body's origin.
    pub mean_radius: f64,
    /// Area, volume, centroid and inertia, in the scan's frame.
    pub properties: MassProperties,
    /// Relative error of these figures: 1e-14 of a shape's closed forms; else the estimate of
    /// the quadrature, of a grain below 1e-10, see
    /// [`Integrals::relative_error`](crate::measure::Integrals::relative_error).
    pub relative_error: f64,
}

/// Scans a body: the same points, bit for bit, for the same options.
///
/// A point lies at r(n) (1 ± 0.2 if it is an outlier) + noise along its direction n, plus the
/// offset. Noise and outliers are drawn independently for all directions before the missing cap is
/// cut out, so changing one of the options changes nothing in the others' effect.
///
/// # Errors
///
/// When an option is out of its range, see [`SynthError`].
pub fn synthesize(options: &SynthOptions) -> Result<SyntheticScan, SynthError> {
    check(options)?;
    let directions = options.sampling.directions(options.points, options.seed)?;
    let surface = options.body.surface(options.axes)?;
    let truth = truth(options, surface.integrals());
    let farthest = truth.mean_radius * ROUNDED / f64::EPSILON;
    // Written so that NaN fails.
    if !options.offset.iter().all(|length| length.abs() <= farthest) {
        return Err(SynthError::Offset);
    }

    let sigma = options.noise * truth.mean_radius;
    let mut noise = random(options.seed, Stream::Noise);
    let mut outliers = random(options.seed, Stream::Outliers);
    let lowest = -options.missing_cap.to_radians().cos();
    let mut points = Vec::with_capacity(directions.len());
    for n in &directions {
        let error: f64 = StandardNormal.sample(&mut noise);
        let [lot, side]: [f64; 2] = StandardUniform.sample(&mut outliers);
        let factor = match lot < options.outliers {
            true => 1.0 + OUTLIER_STEP * (side - 0.5).signum(),
            false => 1.0,
        };
        if options.missing_cap == 0.0 || n.z > lowest {
            let r = surface.radius(n) * factor + sigma * error;
            points.push(Point3::from(n * r + options.offset));
        }
    }
    match points.len() {
        left @ 0..MIN_POINTS => Err(SynthError::NothingLeft { left }),
        _ => Ok(SyntheticScan { points, truth }),
    }
}

/// The ranges of the options; the number of points is checked with the directions.
fn check(options: &SynthOptions) -> Result<(), SynthError> {
    let &SynthOptions {
        noise,
        outliers,
        missing_cap,
        ..
    } = options;
    if !(0.0..=MAX_NOISE).contains(&noise) {
        return Err(SynthError::Noise { noise });
    }
    if !(0.0..=1.0).contains(&outliers) {
        return Err(SynthError::Outliers { outliers });
    }
    if !(0.0..=180.0).contains(&missing_cap) {
        return Err(SynthError::MissingCap { missing_cap });
    }
    Ok(())
}

/// The body's integrals, moved to the scan's frame.
fn truth(options: &SynthOptions, integrals: Integrals) -> Truth {
    Truth {
        body: options.body,
        mean_radius: integrals.mean_radius,
        properties: MassProperties {
            centroid: integrals.properties.centroid + options.offset,
            ..integrals.properties
        },
        relative_error: integrals.relative_error,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shapes::Body;
    use approx::{assert_abs_diff_eq, assert_relative_eq};

    /// Radii over the clean ones, one point per direction.
    fn ratios(options: &SynthOptions) -> Vec<f64> {
        let clean = SynthOptions {
            noise: 0.0,
            outliers: 0.0,
            ..options.clone()
        };
        let spoilt = synthesize(options).unwrap().points;
        let clean = synthesize(&clean).unwrap().points;
        let norms = spoilt.iter().zip(&clean);
        norms
            .map(|(a, b)| a.coords.norm() / b.coords.norm())
            .collect()
    }

    #[test]
    fn native_scans_have_their_count_and_lie_on_the_body() {
        for body in Body::ALL {
            let scan = synthesize(&SynthOptions::clean(body)).unwrap();
            assert_eq!(scan.points.len(), body.native_points());
            for point in &scan.points {
                let r = body.surface().radius(&point.coords.normalize());
                assert_relative_eq!(point.coords.norm(), r, max_relative = 1e-14);
            }
            assert!(scan.truth.relative_error <= 1e-10);
        }
    }

    #[test]
    fn scans_are_reproducible_and_depend_on_the_seed() {
        let options = SynthOptions {
            noise: 0.01,
            outliers: 0.05,
            sampling: Sampling::Random,
            ..SynthOptions::clean(Body::Bean)
        };
        assert_eq!(synthesize(&options), synthesize(&options));
        let other = SynthOptions {
            seed: 1,
            ..options.clone()
        };
        assert_ne!(synthesize(&options), synthesize(&other));
    }

    #[test]
    fn noise_is_gaussian_of_the_asked_width() {
        let ratios = ratios(&SynthOptions {
            points: 20_000,
            noise: 0.02,
            ..SynthOptions::clean(Body::Sphere)
        });
        let count = ratios.len() as f64;
        let mean = ratios.iter().sum::<f64>() / count;
        let moment = |k: i32| ratios.iter().map(|r| (r - mean).powi(k)).sum::<f64>() / count;
        assert_abs_diff_eq!(mean, 1.0, epsilon = 5e-4);
        assert_abs_diff_eq!(moment(2).sqrt(), 0.02, epsilon = 4e-4);
        assert_abs_diff_eq!(moment(4) / moment(2).powi(2), 3.0, epsilon = 0.15);
    }

    #[test]
    fn outliers_are_as_many_as_asked_and_on_both_sides() {
        let ratios = ratios(&SynthOptions {
            points: 20_000,
            outliers: 0.05,
            ..SynthOptions::clean(Body::Maize)
        });
        let share = |factor: f64| {
            let hits = ratios.iter().filter(|r| (*r - factor).abs() < 1e-12);
            hits.count() as f64 / ratios.len() as f64
        };
        assert_abs_diff_eq!(share(1.2), 0.025, epsilon = 0.004);
        assert_abs_diff_eq!(share(0.8), 0.025, epsilon = 0.004);
        assert_abs_diff_eq!(share(1.0), 0.95, epsilon = 0.006);
    }

    #[test]
    fn the_missing_cap_is_empty_and_the_rest_is_not() {
        let cap = |missing_cap| SynthOptions {
            missing_cap,
            ..SynthOptions::clean(Body::Chickpea)
        };
        let whole = synthesize(&cap(0.0)).unwrap().points;
        let rest = synthesize(&cap(50.0)).unwrap().points;
        let angle = |p: &Point3<f64>| (-p.z / p.coords.norm()).acos().to_degrees();
        let kept: Vec<_> = whole.into_iter().filter(|p| angle(p) > 50.0).collect();
        assert_eq!(rest, kept);
        assert_eq!(
            synthesize(&cap(180.0)),
            Err(SynthError::NothingLeft { left: 0 })
        );
    }

    #[test]
    fn an_offset_moves_points_and_centroid() {
        let offset = Vector3::new(100.0, -20.0, 3.0);
        let clean = SynthOptions::clean(Body::Bean);
        let there = synthesize(&SynthOptions {
            offset,
            ..clean.clone()
        })
        .unwrap();
        let here = synthesize(&clean).unwrap();
        assert_relative_eq!(there.points[7], here.points[7] + offset);
        let centroid = here.truth.properties.centroid + offset;
        assert_relative_eq!(there.truth.properties.centroid, centroid);
    }

    #[test]
    fn options_out_of_range_are_refused() {
        let clean = SynthOptions::clean(Body::Sphere);
        for spoil in [
            |o: &mut SynthOptions| o.noise = 0.11,
            |o: &mut SynthOptions| o.noise = f64::NAN,
            |o: &mut SynthOptions| o.outliers = -0.1,
            |o: &mut SynthOptions| o.missing_cap = 181.0,
            |o: &mut SynthOptions| o.offset.y = f64::INFINITY,
            |o: &mut SynthOptions| o.offset.x = 1e10,
            |o: &mut SynthOptions| o.points = 3,
            |o: &mut SynthOptions| o.axes = Some(Vector3::new(2.0, 1.0, 1.0)),
        ] {
            let mut options = clean.clone();
            spoil(&mut options);
            assert!(synthesize(&options).is_err(), "{options:?}");
        }
    }
}
