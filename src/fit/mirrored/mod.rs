//! Weighted least squares of one expansion and its mirror images.
//!
//! Directions are folded into the region that the mirrors leave (dissertation, Chapter 3: into one
//! octant), and the cap basis of that region is fitted there. Rows are reduced to a triangle by
//! Householder reflections, and the triangle is solved by its singular values: never the normal
//! equations. Where the samples do not determine all coefficients, those of least norm are taken, as
//! with the source's Moore-Penrose inverse (2.17-2.19).

mod search;

pub(crate) use search::search;

use super::linear::{Factorization, Triangle};
use super::options::MAX_DEGREE;
use crate::model::{InvalidGrain, Mirrored, StarSurface};
use crate::sphere::{CapBasis, Places, Symmetry, coefficient_count};
use faer::{Col, Mat};
use nalgebra::Vector3;

/// A radius seen in a direction.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DirectedSample {
    /// A vector in this direction, of any length but zero.
    pub direction: Vector3<f64>,
    /// Radius.
    pub radius: f64,
    /// What the squared residual counts, relative to those of others; not negative.
    pub weight: f64,
}

impl DirectedSample {
    /// What is seen of a surface in the direction of the unit vector `direction`.
    pub fn on(surface: &(impl StarSurface + ?Sized), direction: Vector3<f64>, weight: f64) -> Self {
        Self {
            direction,
            radius: surface.radius(&direction),
            weight,
        }
    }
}

/// Why an expansion cannot be fitted.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum MirroredFitError {
    /// There are no samples of positive weight.
    #[error("there are no samples of positive weight to fit to")]
    NoSamples,
    /// A number of a sample is not finite, or its direction is zero.
    #[error("sample {index} is not finite, or has no direction")]
    Sample {
        /// Index of the sample.
        index: usize,
    },
    /// A weight is negative or not finite.
    #[error("sample {index} has the weight {weight}; it must be zero or a positive number")]
    Weight {
        /// Index of the sample.
        index: usize,
        /// Its weight.
        weight: f64,
    },
    /// The degree is out of range.
    #[error("the degree is {degree}; it must be from 0 to {MAX_DEGREE}")]
    Degree {
        /// The degree asked for.
        degree: usize,
    },
    /// The radii are too large to compute with.
    #[error("the radii are too large to compute with: {0}")]
    Overflow(#[from] InvalidGrain),
}

/// Rows that are weighted together.
const BLOCK_ROWS: usize = 128;

/// A combination of the functions whose singular value is smaller than this, relative to the largest,
/// is not determined by the samples. Rounding makes 1e-15.
const RANK_TOLERANCE: f64 = 1e-12;

/// The expansion of the given degree that, mirrored, has the least weighted sum of squared residuals to
/// the samples; of several such, the one with the least norm of its coefficients.
///
/// A surface of degree 3 is met to 1e-12 of its radius at every degree. The order of the samples changes
/// rounding only.
///
/// # Errors
/// [`MirroredFitError`] if there is nothing to fit to, a sample is not sound, or the degree is above
/// [`MAX_DEGREE`].
pub fn fit_mirrored(
    samples: &[DirectedSample],
    symmetry: Symmetry,
    degree: usize,
) -> Result<Mirrored, MirroredFitError> {
    if degree > MAX_DEGREE {
        return Err(MirroredFitError::Degree { degree });
    }
    let (mut largest, mut heaviest) = (0.0_f64, 0.0_f64);
    for (index, sample) in samples.iter().enumerate() {
        let mut numbers = sample.direction.iter().chain([&sample.radius]);
        if !(numbers.all(|x| x.is_finite()) && sample.direction.amax() > 0.0) {
            return Err(MirroredFitError::Sample { index });
        }
        if !(sample.weight >= 0.0 && sample.weight.is_finite()) {
            let weight = sample.weight;
            return Err(MirroredFitError::Weight { index, weight });
        }
        largest = largest.max(sample.radius.abs());
        heaviest = heaviest.max(sample.weight);
    }
    if heaviest == 0.0 {
        return Err(MirroredFitError::NoSamples);
    }

    // In units of the largest radius and weight, so that no square overflows.
    let unit = if largest > 0.0 { largest } else { 1.0 };
    let (basis, cap) = (CapBasis::new(degree), symmetry.cap());
    let functions = coefficient_count(degree);
    let mut factorization = Factorization::new(degree);
    let mut places = Places::default();
    for block in samples.chunks(BLOCK_ROWS) {
        let folded: Vec<[f64; 4]> = block
            .iter()
            .map(|sample| {
                let direction = sample.direction / sample.direction.amax();
                let [x, y, z] = symmetry.fold(&direction.normalize()).into();
                [x, y, z, sample.radius / unit]
            })
            .collect();
        cap.locate(&folded, &mut places);
        let (rows, stride) = factorization.append(block.len());
        basis.evaluate(&places, rows, stride);
        for (i, sample) in block.iter().enumerate() {
            rows[functions * stride + i] = folded[i][3];
            let factor = (sample.weight / heaviest).sqrt();
            for column in 0..=functions {
                rows[column * stride + i] *= factor;
            }
        }
    }
    let mut coefficients = minimum_norm(&factorization.triangle(), degree);
    for coefficient in &mut coefficients {
        *coefficient *= unit;
    }
    Ok(Mirrored::new(symmetry, coefficients)?)
}

/// Coefficients of least norm among those of the fit of the given degree.
fn minimum_norm(triangle: &Triangle<'_>, degree: usize) -> Vec<f64> {
    let count = coefficient_count(degree);
    let rows = triangle.rows().min(count);
    let matrix = Mat::from_fn(
        rows,
        count,
        |i, j| if i <= j { triangle.at(i, j) } else { 0.0 },
    );
    let projected = Col::from_fn(rows, |i| triangle.projection(i));
    let Ok(svd) = matrix.thin_svd() else {
        return vec![f64::NAN; count];
    };
    let values = svd.S().column_vector();
    let mut along = svd.U().transpose() * projected;
    for i in 0..rows {
        let is_determined = values[i] > RANK_TOLERANCE * values[0];
        along[i] = if is_determined {
            along[i] / values[i]
        } else {
            0.0
        };
    }
    let solution = svd.V() * along;
    solution.iter().copied().collect()
}

#[cfg(test)]
mod tests;
