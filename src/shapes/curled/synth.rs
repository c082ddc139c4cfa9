//! Scans of bodies that no centre sees whole: a mesh over the sphere, or points all over the surface.

use super::{Curled, CurledTruth, OverSphere};
use crate::measure::{MassProperties, equivalent_radius};
use crate::mesh::Mesh;
use crate::shapes::random::{Stream, random};
use crate::shapes::{MAX_NOISE, MAX_POINTS, MIN_POINTS};
use crate::sphere::cube_grid;
use nalgebra::{Point3, Vector3};
use rand_distr::{Distribution, StandardNormal, StandardUniform, UnitSphere};
use thiserror::Error;

/// Cells along an edge of the cube of directions of the mesh: 13 826 vertices.
const RESOLUTION: usize = 48;

/// The largest area per solid angle is taken so many times that of the mesh's vertices.
const MARGIN: f64 = 1.2;

/// What to scan and how badly.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct CurledOptions {
    /// The body.
    pub body: Curled,
    /// Number of points, laid at random, as many per area everywhere; `None` for a mesh of 13 826 vertices.
    pub points: Option<usize>,
    /// Standard deviation of the noise along normals, as a share of the radius of the ball of equal volume: 0 to
    /// [`MAX_NOISE`].
    pub noise: f64,
    /// Where the body's origin lies in the scan.
    pub offset: Vector3<f64>,
    /// Seed of everything random, the shape of [`Curled::Random`] included.
    pub seed: u64,
}

impl CurledOptions {
    /// A clean mesh.
    pub fn clean(body: Curled) -> Self {
        Self {
            body,
            points: None,
            noise: 0.0,
            offset: Vector3::zeros(),
            seed: 0,
        }
    }

    /// So many [`points`](Self::points) instead of the mesh.
    pub fn with_points(self, points: impl Into<Option<usize>>) -> Self {
        let points = points.into();
        Self { points, ..self }
    }

    /// The same with this [`noise`](Self::noise).
    pub fn with_noise(self, noise: f64) -> Self {
        Self { noise, ..self }
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

/// Why there is no scan.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum CurledError {
    /// Ask for a number of points within the range.
    #[error("a body takes {MIN_POINTS} to {MAX_POINTS} points, not {points}")]
    Points {
        /// The number asked for.
        points: usize,
    },
    /// Give the noise as a share of the radius.
    #[error("the noise must lie between 0 and {MAX_NOISE} of the radius, not at {noise}")]
    Noise {
        /// The noise asked for.
        noise: f64,
    },
    /// The offset must be finite.
    #[error("the offset is not finite")]
    Offset,
}

/// A synthetic scan and the truth behind it.
#[derive(Debug, Clone, PartialEq)]
pub struct CurledScan {
    /// Points and, unless a number of points was asked for, the triangles between them.
    pub mesh: Mesh,
    /// Integrals of the body without noise.
    pub truth: CurledTruth,
}

/// Scans a body: the same points, bit for bit, for the same options. Noise moves points along normals.
///
/// # Errors
/// [`CurledError`] when an option is out of its range.
pub fn synthesize_curled(options: &CurledOptions) -> Result<CurledScan, CurledError> {
    check(options)?;
    let surface = options.body.surface(options.seed);
    let truth = surface.integrals();
    let (directions, triangles) = cube_grid(RESOLUTION);
    let (places, triangles) = match options.points {
        None => {
            let places = directions.iter().map(|n| surface.place_and_area(n));
            (places.collect(), triangles)
        }
        Some(points) => {
            let area = |n: &Vector3<f64>| surface.place_and_area(n).1.norm();
            let most = MARGIN * directions.iter().map(area).fold(0.0, f64::max);
            (
                laid_at_random(surface.as_ref(), points, most, options.seed),
                Vec::new(),
            )
        }
    };
    let radius = equivalent_radius(truth.properties.volume);
    let mut noise = random(options.seed, Stream::Noise);
    let vertex = |(place, area): (Vector3<f64>, Vector3<f64>)| {
        let error: f64 = StandardNormal.sample(&mut noise);
        let normal = area.try_normalize(0.0).unwrap_or_default();
        Point3::from(place + normal * (error * options.noise * radius) + options.offset)
    };
    Ok(CurledScan {
        mesh: Mesh {
            vertices: places.into_iter().map(vertex).collect(),
            triangles,
        },
        truth: CurledTruth {
            properties: MassProperties {
                centroid: truth.properties.centroid + options.offset,
                ..truth.properties
            },
            ..truth
        },
    })
}

/// Places, with the areas per solid angle there, as many per area everywhere: directions are kept as often as the area
/// they stand for is large.
fn laid_at_random(
    surface: &dyn OverSphere,
    points: usize,
    most: f64,
    seed: u64,
) -> Vec<(Vector3<f64>, Vector3<f64>)> {
    let mut generator = random(seed, Stream::Places);
    let mut found = Vec::with_capacity(points);
    while found.len() < points {
        let n = Vector3::from(UnitSphere.sample(&mut generator));
        let lot: f64 = StandardUniform.sample(&mut generator);
        let (place, area) = surface.place_and_area(&n);
        if lot * most < area.norm() {
            found.push((place, area));
        }
    }
    found
}

fn check(options: &CurledOptions) -> Result<(), CurledError> {
    let &CurledOptions { points, noise, .. } = options;
    if let Some(points) = points.filter(|points| !(MIN_POINTS..=MAX_POINTS).contains(points)) {
        return Err(CurledError::Points { points });
    }
    if !(0.0..=MAX_NOISE).contains(&noise) {
        return Err(CurledError::Noise { noise });
    }
    match options.offset.iter().all(|length| length.is_finite()) {
        true => Ok(()),
        false => Err(CurledError::Offset),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;
    use std::f64::consts::PI;

    #[test]
    fn points_are_laid_by_area() {
        let scan = synthesize_curled(&CurledOptions::clean(Curled::Cup).with_points(40_000));
        let points = scan.unwrap().mesh.vertices;
        // The outer wall between its rounded ends.
        let on_wall = points
            .iter()
            .filter(|p| p.x.hypot(p.y) > 1.0 - 1e-9)
            .count();
        let area = synthesize_curled(&CurledOptions::clean(Curled::Cup));
        let area = area.unwrap().truth.properties.area;
        let share = 2.0 * PI * 1.7 / area;
        assert_relative_eq!(on_wall as f64 / 40_000.0, share, max_relative = 0.02);
    }

    #[test]
    fn random_bodies_depend_on_the_seed_alone() {
        let scan = |seed| {
            let options = CurledOptions::clean(Curled::Random).with_points(50);
            synthesize_curled(&options.with_seed(seed)).unwrap()
        };
        assert_eq!(scan(1), scan(1));
        assert_ne!(scan(1).truth.properties.area, scan(2).truth.properties.area);
    }
}
