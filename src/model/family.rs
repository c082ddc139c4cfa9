//! The families of star-shaped models: how expansions in spherical harmonics make a radius.

use super::ray::Ray;
use super::{Blended, Derivatives, Mirrored, Node, Segmented, StarSurface, Surface, Tiling, Whole};
use nalgebra::Vector3;
use rayon::prelude::*;

/// How expansions make a surface.
#[derive(Debug, Clone)]
pub enum Family {
    /// Overlapping expansions, blended: continuous with two derivatives.
    Blended(Blended),
    /// Independent expansions, one per segment: the radius may jump where they meet
    /// ([`StarGrain::seam_jump`](super::StarGrain::seam_jump) says by how much).
    Segmented(Segmented),
    /// One expansion and its mirror images: continuous, with edges on the mirror planes.
    Mirrored(Mirrored),
    /// One expansion of the whole sphere: smooth.
    Whole(Whole),
}

impl Family {
    /// The blended surface, if it is one.
    pub fn blended(&self) -> Option<&Blended> {
        match self {
            Self::Blended(surface) => Some(surface),
            _ => None,
        }
    }

    /// The surface of independent segments, if it is one.
    pub fn segmented(&self) -> Option<&Segmented> {
        match self {
            Self::Segmented(surface) => Some(surface),
            _ => None,
        }
    }

    /// The expansion with mirror images, if it is one.
    pub fn mirrored(&self) -> Option<&Mirrored> {
        match self {
            Self::Mirrored(surface) => Some(surface),
            _ => None,
        }
    }

    /// The expansion of the whole sphere, if it is one.
    pub fn whole(&self) -> Option<&Whole> {
        match self {
            Self::Whole(surface) => Some(surface),
            _ => None,
        }
    }

    /// Radius in a direction of the stretched space.
    pub(super) fn radius(&self, n: &Vector3<f64>) -> f64 {
        match self {
            Self::Blended(surface) => surface.radius(n),
            Self::Segmented(surface) => surface.radius(n),
            Self::Mirrored(surface) => surface.radius(n),
            Self::Whole(surface) => surface.radius(n),
        }
    }

    /// Radius and surface gradient, likewise.
    pub(super) fn radius_and_gradient(&self, n: &Vector3<f64>) -> (f64, Vector3<f64>) {
        match self {
            Self::Blended(surface) => surface.radius_and_gradient(n),
            Self::Segmented(surface) => surface.radius_and_gradient(n),
            Self::Mirrored(surface) => surface.radius_and_gradient(n),
            Self::Whole(surface) => surface.radius_and_gradient(n),
        }
    }

    /// Radius and its derivatives on the sphere, likewise.
    pub(super) fn derivatives(&self, n: &Vector3<f64>) -> Derivatives {
        let jet = match self {
            Self::Blended(surface) => surface.jet(n),
            Self::Segmented(surface) => surface.jet(n),
            Self::Mirrored(surface) => surface.jet(n),
            Self::Whole(surface) => surface.jet(n),
        };
        Derivatives::on_sphere(n, &jet)
    }

    /// The derivatives in many directions, in their order.
    pub(super) fn many_derivatives(&self, directions: &[Vector3<f64>]) -> Vec<Derivatives> {
        let jets = match self {
            Self::Blended(surface) => surface.jets(directions),
            Self::Whole(surface) => surface.jets(directions),
            Self::Segmented(_) | Self::Mirrored(_) => {
                return directions.iter().map(|n| self.derivatives(n)).collect();
            }
        };
        let found = directions.iter().zip(&jets);
        found
            .map(|(n, jet)| Derivatives::on_sphere(n, jet))
            .collect()
    }

    /// Radii in many directions, likewise.
    pub(super) fn radii(&self, directions: &[Vector3<f64>]) -> Vec<f64> {
        match self {
            Self::Blended(surface) => surface.radii(directions),
            Self::Whole(surface) => surface.radii(directions),
            Self::Segmented(_) | Self::Mirrored(_) => {
                let tasks = directions.par_iter().with_min_len(1024);
                tasks.map(|n| self.radius(n)).collect()
            }
        }
    }

    /// Radii and surface gradients at the nodes of a quadrature, likewise.
    pub(super) fn rays(&self, nodes: &[Node]) -> Vec<Ray> {
        let directions = || nodes.iter().map(|(n, _)| *n).collect::<Vec<_>>();
        let values = match self {
            Self::Blended(surface) => surface.radii_and_gradients(&directions()),
            // Those of a ring share what depends on z.
            Self::Whole(surface) => nodes
                .chunk_by(|(one, _), (other, _)| one.z == other.z)
                .collect::<Vec<_>>()
                .into_par_iter()
                .flat_map_iter(|ring| {
                    let places: Vec<_> = ring.iter().map(|(n, _)| [n.x, n.y]).collect();
                    surface.radii_and_gradients_at(ring[0].0.z, &places)
                })
                .collect(),
            Self::Segmented(_) | Self::Mirrored(_) => {
                let tasks = nodes.par_iter().with_min_len(1024);
                tasks.map(|(n, _)| self.radius_and_gradient(n)).collect()
            }
        };
        let rays = nodes.iter().zip(values);
        rays.map(|(&(direction, solid_angle), (radius, gradient))| Ray {
            direction,
            solid_angle,
            radius,
            gradient,
        })
        .collect()
    }

    /// The parts of the sphere on which the radius is smooth, likewise.
    pub(super) fn tiling(&self) -> Tiling {
        match self {
            Self::Blended(surface) => Tiling::blended(surface.cover()),
            Self::Segmented(surface) => Tiling::segments(surface.partition()),
            Self::Mirrored(surface) => surface.tiling(),
            Self::Whole(surface) => Tiling::sphere(surface.degree()),
        }
    }

    /// The family so many times as large.
    pub(super) fn times(&self, factor: f64) -> Self {
        match self {
            Self::Blended(surface) => Self::Blended(surface.times(factor)),
            Self::Segmented(surface) => Self::Segmented(surface.times(factor)),
            Self::Mirrored(surface) => Self::Mirrored(surface.times(factor)),
            Self::Whole(surface) => Self::Whole(surface.times(factor)),
        }
    }

    /// Coefficients per expansion.
    pub(super) fn coefficients(&self) -> &[Vec<f64>] {
        match self {
            Self::Blended(surface) => surface.coefficients(),
            Self::Segmented(surface) => surface.coefficients(),
            Self::Mirrored(surface) => std::slice::from_ref(&surface.coefficients),
            Self::Whole(surface) => std::slice::from_ref(&surface.coefficients),
        }
    }

    /// The largest degree of any expansion.
    pub(super) fn degree(&self) -> usize {
        match self {
            Self::Blended(surface) => surface.degree(),
            Self::Segmented(surface) => surface.degree(),
            Self::Mirrored(surface) => surface.degree(),
            Self::Whole(surface) => surface.degree(),
        }
    }

    /// The number of coefficients that one evaluation touches, as a mean over all directions.
    pub(super) fn coefficients_touched(&self) -> f64 {
        match self {
            Self::Blended(surface) => surface.coefficients_touched(),
            Self::Segmented(surface) => {
                let partition = surface.partition();
                let counts = surface.coefficients().iter().enumerate();
                counts
                    .map(|(i, own)| partition.rectangle(i).solid_angle() * own.len() as f64)
                    .sum::<f64>()
                    / (4.0 * std::f64::consts::PI)
            }
            Self::Mirrored(surface) => surface.coefficients().len() as f64,
            Self::Whole(surface) => surface.coefficients().len() as f64,
        }
    }
}
