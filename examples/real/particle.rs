//! Particles whose radius is known as an expansion in spherical harmonics.

use grainform::scan::Scan;
use grainform::sphere::{HarmonicBasis, harmonic_index};
use nalgebra::{Point3, Vector3};
use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, StandardNormal};
use std::error::Error;
use std::fs;
use std::path::Path;

/// A particle with its exact figures.
pub(crate) struct Particle {
    pub(crate) mean_radius: f64,
    pub(crate) area: f64,
    pub(crate) volume: f64,
    basis: HarmonicBasis,
    pub(crate) coefficients: Vec<f64>,
}

impl Particle {
    /// The particles of a folder, as its `truth.csv` lists them: files of lines `n m Re Im` of complex harmonics with the
    /// Condon-Shortley phase.
    pub(crate) fn all(folder: &Path) -> Result<Vec<Self>, Box<dyn Error>> {
        let table = fs::read_to_string(folder.join("truth.csv"))?;
        table
            .lines()
            .skip(1)
            .map(|line| {
                let fields: Vec<&str> = line.split(',').collect();
                let degree: usize = fields[2].parse()?;
                let text = fs::read_to_string(folder.join(fields[0]))?;
                Ok(Self {
                    volume: fields[3].parse()?,
                    area: fields[4].parse()?,
                    mean_radius: fields[6].parse()?,
                    basis: HarmonicBasis::new(degree),
                    coefficients: real_coefficients(&text, degree)?,
                })
            })
            .collect()
    }

    /// The radius in a direction.
    pub(crate) fn radius(&self, n: &Vector3<f64>) -> f64 {
        self.basis.value(&self.coefficients, n)
    }

    /// A scan of it, with normal radial noise of the given standard deviation, as a share of the mean radius.
    pub(crate) fn scan(&self, directions: &[Vector3<f64>], noise: f64, seed: u64) -> Scan {
        let mut random = ChaCha8Rng::seed_from_u64(seed);
        let points = directions.iter().map(|n| {
            let error: f64 = StandardNormal.sample(&mut random);
            Point3::from(n * (self.radius(n) + noise * self.mean_radius * error))
        });
        Scan::from_points(points.collect())
    }
}

/// a_l^m of the real harmonics from complex ones: for m > 0, sqrt(2) (-1)^m Re a and -sqrt(2) (-1)^m Im a.
fn real_coefficients(text: &str, degree: usize) -> Result<Vec<f64>, Box<dyn Error>> {
    let mut real = vec![0.0; (degree + 1) * (degree + 1)];
    for line in text.lines() {
        let numbers: Result<Vec<f64>, _> = line.split_whitespace().map(str::parse).collect();
        let [n, m, re, im] = numbers?[..] else {
            continue;
        };
        let (n, m) = (n as usize, m as isize);
        if n > degree || m < 0 {
            continue;
        }
        let sign = if m % 2 == 0 { 1.0 } else { -1.0 };
        let scale = if m == 0 { 1.0 } else { 2.0_f64.sqrt() * sign };
        real[harmonic_index(n, m)] = scale * re;
        if m > 0 {
            real[harmonic_index(n, -m)] = -scale * im;
        }
    }
    Ok(real)
}
