//! Standard errors of a fitted grain's measures.
//!
//! Given the samples, the coefficients of a joint fit are normally distributed round the fitted ones
//! with covariance s^2 G^-1: s^2 the variance of the samples round the surface, G the matrix of the
//! least-squares problem with its prior. Surfaces are drawn from that distribution and measured on a
//! mesh; the standard error of a measure is the root mean square of its difference from the measure of
//! the fitted surface, so that it holds the bias that noise brings (ripples add area) beside the
//! scatter.
//!
//! Extents are largest values: of a flat side with ripples, that of the highest one. This bias can be
//! larger than the scatter, so it is told apart. It grows with the size of the ripples, which the
//! draws, ripples on a rippled surface, have sqrt(2) times: they show sqrt(2) - 1 of it. An extent
//! also feels the error that the model is allowed (the tolerance) at its two ends, which integrals
//! average out. What the model cannot express, whatever its coefficients, is in s^2 as far
//! as the samples show it.

use super::joint::{BlockFactor, Coefficients};
use crate::measure::{extents, mesh_properties};
use crate::mesh::Mesh;
use crate::model::Blended;
use crate::sphere::cube_grid;
use faer::Mat;
use nalgebra::{Matrix3, Point3, Vector3};
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::SeedableRng;
use rand_distr::{Distribution, StandardNormal};
use rayon::prelude::*;

/// Draws, each with its mirror image: the standard errors are themselves good to 10 %.
const DRAWS: usize = 48;

/// Cells along the edges of the cube whose directions are measured: 866 directions.
const RESOLUTION: usize = 12;

/// How a fitted grain's coefficients are distributed.
#[derive(Debug, Clone)]
pub(crate) struct Spread {
    pub(crate) factor: BlockFactor,
    pub(crate) variance: f64,
    /// Error of the surface, as RMS, that the fit was allowed beside noise.
    pub(crate) model_error: f64,
}

/// Standard errors (one standard deviation) of a grain's measures, in the powers of the scan's unit
/// of these.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct StandardErrors {
    /// Of the area.
    pub area: f64,
    /// Of the volume.
    pub volume: f64,
    /// Of the centroid's coordinates along the grain's axes.
    pub centroid: Vector3<f64>,
    /// Of the entries of the inertia tensor about the centroid, along the grain's axes.
    pub inertia: Matrix3<f64>,
    /// Of the principal moments of inertia, ascending.
    pub moments: Vector3<f64>,
    /// Of the length, width and thickness: extents along the principal axes.
    pub dimensions: Vector3<f64>,
    /// By what noise makes these extents too large.
    pub dimensions_excess: Vector3<f64>,
}

/// What is measured of a draw.
#[derive(Clone, Copy)]
struct Measures {
    area: f64,
    volume: f64,
    centroid: Vector3<f64>,
    inertia: Matrix3<f64>,
    moments: Vector3<f64>,
    dimensions: Vector3<f64>,
}

impl Spread {
    /// Standard errors of the measures of a surface; `None` if they cannot be measured.
    pub(crate) fn standard_errors(&self, surface: &Blended) -> Option<StandardErrors> {
        let (directions, triangles) = cube_grid(RESOLUTION);
        let radii = radii(surface, &directions);
        let draws = self.draws(surface.coefficients());
        let mesh = |radii: &mut dyn Iterator<Item = f64>| Mesh {
            vertices: directions
                .iter()
                .zip(radii)
                .map(|(n, r)| Point3::from(n * r))
                .collect(),
            triangles: triangles.clone(),
        };
        let middle = measure(&mesh(&mut radii.iter().copied()))?;
        let differences: Option<Vec<[Measures; 2]>> = draws
            .par_iter()
            .map(|draw| {
                let moved = Blended::new(surface.cover().clone(), draw.clone()).ok()?;
                let shifts = self::radii(&moved, &directions);
                let at = |sign: f64| {
                    let moved = radii.iter().zip(&shifts).map(|(r, shift)| r + sign * shift);
                    measure(&mesh(&mut { moved }))
                };
                Some([at(1.0)?.less(&middle), at(-1.0)?.less(&middle)])
            })
            .collect();
        Some(root_mean_squares(&differences?.concat(), self.model_error))
    }

    /// Random changes of the coefficients.
    fn draws(&self, coefficients: &[Vec<f64>]) -> Vec<Coefficients> {
        let mut random = ChaCha8Rng::seed_from_u64(0);
        let scale = self.variance.sqrt();
        let mut columns: Vec<Mat<f64>> = coefficients
            .iter()
            .map(|own| {
                Mat::from_fn(own.len(), DRAWS, |_, _| {
                    let normal: f64 = StandardNormal.sample(&mut random);
                    scale * normal
                })
            })
            .collect();
        self.factor.backward(&mut columns);
        (0..DRAWS)
            .map(|draw| {
                let of = |column: &Mat<f64>| column.col_as_slice(draw).to_vec();
                columns.iter().map(of).collect()
            })
            .collect()
    }
}

fn radii(surface: &Blended, directions: &[Vector3<f64>]) -> Vec<f64> {
    let values = surface.radii_and_gradients(directions);
    values.into_iter().map(|(radius, _)| radius).collect()
}

fn measure(mesh: &Mesh) -> Option<Measures> {
    let solid = mesh_properties(mesh).ok()?;
    let principal = solid.principal()?;
    Some(Measures {
        area: solid.area,
        volume: solid.volume,
        centroid: solid.centroid.coords,
        inertia: solid.inertia,
        moments: principal.moments,
        dimensions: extents(mesh, &principal.axes),
    })
}

impl Measures {
    fn less(&self, other: &Self) -> Self {
        Self {
            area: self.area - other.area,
            volume: self.volume - other.volume,
            centroid: self.centroid - other.centroid,
            inertia: self.inertia - other.inertia,
            moments: self.moments - other.moments,
            dimensions: self.dimensions - other.dimensions,
        }
    }
}

fn root_mean_squares(differences: &[Measures], model_error: f64) -> StandardErrors {
    let count = differences.len() as f64;
    let number = |of: fn(&Measures) -> f64| {
        (differences.iter().map(|d| of(d).powi(2)).sum::<f64>() / count).sqrt()
    };
    let vector = |of: fn(&Measures) -> Vector3<f64>| {
        let squares: Vector3<f64> = differences.iter().map(|d| of(d).map(|x| x * x)).sum();
        (squares / count).map(f64::sqrt)
    };
    let squares: Matrix3<f64> = differences
        .iter()
        .map(|d| d.inertia.component_mul(&d.inertia))
        .sum();
    let excess: Vector3<f64> = differences
        .iter()
        .map(|d| d.dimensions)
        .sum::<Vector3<f64>>()
        / count;
    StandardErrors {
        area: number(|d| d.area),
        volume: number(|d| d.volume),
        centroid: vector(|d| d.centroid),
        inertia: (squares / count).map(f64::sqrt),
        moments: vector(|d| d.moments),
        dimensions: vector(|d| d.dimensions).zip_map(&excess, |all, excess| {
            (all * all - excess * excess + 2.0 * model_error * model_error)
                .max(0.0)
                .sqrt()
        }),
        dimensions_excess: excess / (std::f64::consts::SQRT_2 - 1.0),
    }
}
