//! Sums over the harmonics in the directions of a cloud, each way of summing made when it is first asked for.

use super::cloud::Cloud;
use crate::sphere::{AccurateHarmonics, HarmonicGram, ScatteredHarmonics, coefficient_count};
use std::fmt;
use std::sync::OnceLock;

/// The harmonics up to a degree in the directions of one cloud, which every call must be given.
pub(crate) struct Sums {
    degree: usize,
    radii: OnceLock<ScatteredHarmonics>,
    /// Of twice the degree.
    moments: OnceLock<AccurateHarmonics>,
    gram: OnceLock<HarmonicGram>,
}

impl Sums {
    pub(super) fn new(degree: usize) -> Self {
        Self {
            degree,
            radii: OnceLock::new(),
            moments: OnceLock::new(),
            gram: OnceLock::new(),
        }
    }

    /// The largest degree.
    pub(super) fn degree(&self) -> usize {
        self.degree
    }

    /// Y as an operator, good to 5e-9.
    pub(super) fn harmonics(&self, cloud: &Cloud) -> &ScatteredHarmonics {
        self.radii
            .get_or_init(|| ScatteredHarmonics::new(self.degree, &cloud.directions))
    }

    /// Y'W times a value per point, good to 1e-13: of a clean cloud with a hole the error of a coefficient is
    /// that many times larger that the prior's variance is above the noise's.
    pub(super) fn weighted(&self, cloud: &Cloud, values: &[f64]) -> Vec<f64> {
        let weighted = values.iter().zip(&cloud.weights).map(|(y, w)| y * w);
        let mut sums = self.moments(cloud, &weighted.collect::<Vec<_>>());
        sums.truncate(coefficient_count(self.degree));
        sums
    }

    /// Y'WY as an operator.
    pub(super) fn gram(&self, cloud: &Cloud) -> &HarmonicGram {
        self.gram
            .get_or_init(|| HarmonicGram::new(self.degree, &self.moments(cloud, &cloud.weights)))
    }

    fn moments(&self, cloud: &Cloud, values: &[f64]) -> Vec<f64> {
        let twice = 2 * self.degree;
        let harmonics = self
            .moments
            .get_or_init(|| AccurateHarmonics::new(twice, &cloud.directions));
        let mut moments = vec![0.0; coefficient_count(twice)];
        harmonics.adjoint(values, &mut moments);
        moments
    }
}

impl fmt::Debug for Sums {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Sums")
            .field("degree", &self.degree)
            .finish_non_exhaustive()
    }
}
