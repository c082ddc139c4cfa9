//! What an estimate is.

use super::cloud::Cloud;
use super::dense::Factor;
use super::known_errors::KnownErrors;
use super::posterior::{Conditioned, Posterior};
use super::spectrum::Spectrum;
use super::sums::Sums;
use crate::fit::holes::{Holes, random_gap};
use crate::model::NoStandardErrors;
use crate::sphere::HarmonicBasis;
use crate::vectorize::dot;
use nalgebra::Vector3;
use std::sync::{Arc, OnceLock};

/// The estimate of a grain's radius.
#[derive(Debug, Clone)]
pub(crate) struct Estimate {
    /// The points, after the map and without outliers.
    pub(crate) cloud: Cloud,
    /// The largest degree.
    pub(crate) degree: usize,
    /// The coefficients in the stretched space, in units of `cloud.mean`, at their harmonic index.
    pub(crate) coefficients: Vec<f64>,
    /// The spectrum: prior variances and noise.
    pub(crate) spectrum: Spectrum,
    /// Per degree, the share of the prior variance that the points leave.
    pub(crate) unlearnt: Vec<f64>,
    /// Points left out because they stand alone.
    pub(crate) outliers: usize,
    /// Points left out because many lay off the surface to one side.
    pub(crate) one_sided: usize,
    /// Sums over the harmonics in the directions of the cloud.
    pub(super) sums: Arc<Sums>,
    /// The factored matrix of the problem, where it is small enough: 15 MB at degree 36.
    pub(crate) factor: Option<Arc<Factor>>,
    /// The points of which the cloud is the patch means.
    pub(super) dense: Option<Dense>,
    /// What is known once it was asked for.
    pub(super) derived: Derived,
}

/// What follows from the rest: computed once, when it is first asked for.
#[derive(Debug, Clone, Default)]
pub(super) struct Derived {
    /// Residuals of its points along the rays, in the scan's unit.
    pub(super) along_rays: OnceLock<Vec<f64>>,
    /// 1 - the leverage of every point, by probes.
    pub(super) probed_spares: OnceLock<Vec<f64>>,
    /// The same, by probes only of detail.
    pub(super) steady_spares: OnceLock<Vec<f64>>,
    /// The largest holes between the points.
    pub(super) holes: OnceLock<Holes>,
    /// What is known of errors, or why nothing is.
    pub(super) errors: OnceLock<Result<KnownErrors, NoStandardErrors>>,
    /// The same with what holes hide only as far as the prior tells it.
    pub(super) errors_beside_holes: OnceLock<Result<KnownErrors, NoStandardErrors>>,
}

/// Points of which patches were made.
#[derive(Debug, Clone, Copy)]
pub(super) struct Dense {
    /// Their number.
    pub(super) points: f64,
    /// Mean square of their residuals, in units of the mean radius.
    pub(super) residuals: f64,
}

impl Estimate {
    /// The cloud ready for [`Self::given`].
    pub(super) fn posterior(&self) -> Posterior<'_> {
        Posterior::with(&self.cloud, Arc::clone(&self.sums))
    }

    /// The posterior of the coefficients.
    pub(super) fn given<'a>(&self, posterior: &'a Posterior<'_>) -> Conditioned<'a> {
        posterior.given_factored(&self.spectrum, self.factor.clone())
    }

    /// The holes between its points, in the stretched space.
    pub(super) fn holes(&self) -> &Holes {
        let holes = || {
            let basis = HarmonicBasis::new(self.degree);
            let mut harmonics = vec![0.0; self.coefficients.len()];
            Holes::new(&self.cloud.directions, |n| {
                basis.evaluate(n, &mut harmonics);
                n * dot(&harmonics, &self.coefficients)
            })
        };
        self.derived.holes.get_or_init(holes)
    }

    /// T n, of a direction of the grain's own frame.
    pub(super) fn stretched(&self, n: &Vector3<f64>) -> Vector3<f64> {
        self.cloud.stretch.component_mul(n)
    }

    /// How far from the centre the farthest of its points is, in the scan's unit.
    pub(in crate::fit) fn farthest_point(&self) -> f64 {
        let away = self.plain_points().map(|point| point.norm());
        away.fold(0.0, f64::max)
    }

    /// The points that it rests on, in the grain's own frame; none where these are means of patches.
    pub(in crate::fit) fn points(&self) -> Option<Vec<Vector3<f64>>> {
        self.dense.is_none().then(|| self.plain_points().collect())
    }

    fn plain_points(&self) -> impl Iterator<Item = Vector3<f64>> {
        let points = self.cloud.points().into_iter();
        points.map(|point| point.component_div(&self.cloud.stretch) * self.cloud.mean)
    }

    /// Whether no more than a gap that chance leaves lies between a ray of the grain's own frame and a point.
    pub(in crate::fit) fn is_among_points(&self, ray: &Vector3<f64>) -> bool {
        let directions = self.cloud.directions.iter();
        let plain = directions.map(|n| n.component_div(&self.cloud.stretch).normalize());
        let nearest = plain.map(|n| n.angle(ray)).fold(f64::INFINITY, f64::min);
        nearest < random_gap(self.cloud.len())
    }
}

/// Floor of the share of the points that is not spent on coefficients.
const LEAST_SPARE: f64 = 0.3;

/// Number of coefficients that the points tell: the sum of their leverages.
pub(super) fn learnt(unlearnt: &[f64]) -> f64 {
    let orders = unlearnt.iter().enumerate();
    orders.map(|(l, q)| (2 * l + 1) as f64 * (1.0 - q)).sum()
}

/// Share of the points that is not spent on coefficients: 1 - the mean leverage.
pub(super) fn spare(unlearnt: &[f64], points: f64) -> f64 {
    (1.0 - learnt(unlearnt) / points).max(LEAST_SPARE)
}

/// Degrees that count as last.
pub(super) const LAST_DEGREES: usize = 4;

/// Mean square of what the last degrees of an expansion carry.
pub(super) fn last_power(coefficients: &[f64], degree: usize) -> f64 {
    let from = (degree + 1 - LAST_DEGREES).pow(2);
    let squares: f64 = coefficients[from..].iter().map(|x| x * x).sum();
    squares / (4.0 * std::f64::consts::PI)
}

/// Mean posterior variance of the radius: sum of (2l + 1) C_l / 4 pi.
pub(super) fn variance(spectrum: &Spectrum, unlearnt: &[f64]) -> f64 {
    moment(spectrum, unlearnt, 0)
}

/// Mean posterior variance of the surface gradient: sum of (2l + 1) l (l + 1) C_l / 4 pi.
pub(super) fn slope_variance(spectrum: &Spectrum, unlearnt: &[f64]) -> f64 {
    moment(spectrum, unlearnt, 1)
}

/// Mean posterior variance of the surface's second derivatives: sum of (2l + 1) (l (l + 1))^2 C_l / 4 pi.
pub(super) fn bending_variance(spectrum: &Spectrum, unlearnt: &[f64]) -> f64 {
    moment(spectrum, unlearnt, 2)
}

/// sum of (2l + 1) (l (l + 1))^power C_l / 4 pi.
fn moment(spectrum: &Spectrum, unlearnt: &[f64], power: i32) -> f64 {
    let variances = spectrum.variances(unlearnt.len() - 1);
    let terms = variances.iter().zip(unlearnt).enumerate();
    let sum: f64 = terms
        .map(|(l, (v, q))| {
            let left = spectrum.orders(l).zip(spectrum.left(l, *q));
            let left: f64 = left.map(|(share, q)| share * q).sum();
            ((l * (l + 1)) as f64).powi(power) * v * left
        })
        .sum();
    sum / (4.0 * std::f64::consts::PI)
}
