//! The segments of a cloud, each fitted to its own samples in every way.

use crate::extended::{self, Sample, largest_radius};
use crate::solvers::{Basis, Solver, design, fitted_radii};
use faer::Mat;
use grainform::sphere::{AngularPartition, Cap, coefficient_count};
use rayon::prelude::*;
use std::fmt;

/// The bases and solvers compared, in the order of the table.
const WAYS: [(Basis, Solver); 4] = [
    (Basis::Harmonics, Solver::NormalEquations),
    (Basis::Harmonics, Solver::Reflections),
    (Basis::Cap, Solver::NormalEquations),
    (Basis::Cap, Solver::Reflections),
];

/// Condition beyond which samples count as leaving the answer open, the limit of the library's fit
/// too. Samples spread over a segment stay far below, rounding makes 1e15.
const OPEN: f64 = 1e9;

/// The worst of all segments.
#[derive(Clone, Copy)]
pub(crate) struct Study {
    segments: usize,
    determined: usize,
    coefficients: usize,
    /// Of the cap basis and of the harmonics: the least rank in any segment.
    ranks: [usize; 2],
    /// The largest condition in any segment that is determined.
    conditions: [f64; 2],
    /// The largest errors there, relative to the segment's largest radius; infinite where a
    /// factorization breaks down.
    errors: [f64; 4],
}

impl Study {
    /// Fits every segment to its own samples.
    pub(crate) fn of(partition: AngularPartition, degree: usize, segments: &[Vec<Sample>]) -> Self {
        let coefficients = coefficient_count(degree);
        let nothing = Self {
            segments: 0,
            determined: 0,
            coefficients,
            ranks: [coefficients; 2],
            conditions: [0.0; 2],
            errors: [0.0; 4],
        };
        let study = |(segment, samples): (usize, &Vec<Sample>)| {
            nothing.of_segment(degree, &partition.cap(segment), samples)
        };
        segments
            .par_iter()
            .enumerate()
            .map(study)
            .reduce(|| nothing, Self::and)
    }

    fn of_segment(self, degree: usize, cap: &Cap, samples: &[Sample]) -> Self {
        let designs = [Basis::Cap, Basis::Harmonics].map(|b| design(b, degree, cap, samples));
        let spectra = designs.each_ref().map(Spectrum::of);
        let mut study = Self {
            segments: 1,
            ranks: spectra.each_ref().map(|spectrum| spectrum.rank),
            ..self
        };
        if spectra[0].condition > OPEN {
            return study;
        }
        study.determined = 1;
        study.conditions = spectra.map(|spectrum| spectrum.condition);
        let exact = extended::fitted_radii(degree, cap, samples);
        study.errors = WAYS.map(|(basis, solver)| {
            let design = &designs[usize::from(basis == Basis::Harmonics)];
            fitted_radii(solver, design, samples).map_or(f64::INFINITY, |fitted| {
                let distances = fitted.iter().zip(&exact).map(|(a, b)| (a - b).abs());
                distances.fold(0.0, f64::max) / largest_radius(samples)
            })
        });
        study
    }

    fn and(self, other: Self) -> Self {
        Self {
            segments: self.segments + other.segments,
            determined: self.determined + other.determined,
            coefficients: self.coefficients,
            ranks: std::array::from_fn(|i| self.ranks[i].min(other.ranks[i])),
            conditions: std::array::from_fn(|i| self.conditions[i].max(other.conditions[i])),
            errors: std::array::from_fn(|i| self.errors[i].max(other.errors[i])),
        }
    }
}

impl fmt::Display for Study {
    /// The columns of the table from "determined" to "cap, QR".
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self {
            segments,
            determined,
            coefficients,
            ranks,
            ..
        } = self;
        write!(
            f,
            "{determined} of {segments} | {coefficients} | {} | {}",
            ranks[0], ranks[1]
        )?;
        let figures = self.conditions.iter().chain(&self.errors).enumerate();
        for (column, figure) in figures {
            match column {
                _ if *determined == 0 => write!(f, " | -")?,
                2.. if figure.is_infinite() => write!(f, " | fails")?,
                _ => write!(f, " | {figure:.0e}")?,
            }
        }
        Ok(())
    }
}

/// What the singular values of a design tell, its columns scaled to unit length.
struct Spectrum {
    rank: usize,
    /// Largest over least singular value; infinite with fewer samples than coefficients.
    condition: f64,
}

impl Spectrum {
    fn of(design: &Mat<f64>) -> Self {
        let (rows, columns) = (design.nrows(), design.ncols());
        let lengths: Vec<f64> = design.col_iter().map(|column| column.norm_l2()).collect();
        // A column of zeros stays one.
        let scaled = Mat::from_fn(rows, columns, |i, j| {
            design[(i, j)] / lengths[j].max(f64::MIN_POSITIVE)
        });
        let values = scaled.singular_values().expect("finite columns");
        let largest = values.first().copied().unwrap_or(0.0);
        let rounding = f64::EPSILON * rows.max(columns) as f64 * largest;
        let rank = values.iter().filter(|&&value| value > rounding).count();
        let condition = match values.last() {
            Some(&least) if rows >= columns => largest / least,
            _ => f64::INFINITY,
        };
        Self { rank, condition }
    }
}
