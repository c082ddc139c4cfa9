//! Clumps: grains made of overlapping spheres, for engines that know no other shape.
//!
//! Balls that touch the grain's surface from within in two places, those of its medial axis, are candidates. The fewest
//! that come near enough to all of the surface are taken one after the other, each is fitted to the part of the surface
//! that is nearest to it, and at last all radii grow or shrink by the same length until the clump has the volume of the
//! grain. Mass, centre and inertia of a clump are those of the *grain*, never sums over spheres, whose overlaps would
//! count twice.

mod cover;
mod gap;
mod refine;
#[cfg(test)]
mod tests;
mod union_volume;

use crate::Mesh;
use crate::measure::{Ball, EvenPlace, MassProperties, even_places, medial_balls};
use cover::Cover;
use gap::root_mean_square;
use nalgebra::{Point3, Vector3};
use refine::refine;
use std::f64::consts::PI;
pub use union_volume::union_volume;

/// The most spheres of a clump.
pub const MOST_SPHERES: usize = 500;

/// Places of the surface that the clump is compared with.
const PLACES: usize = 4000;

/// So many times fewer places have a candidate.
const PLACES_PER_CANDIDATE: usize = 4;

/// Rows along each side of the box in which volumes are found.
const ROWS: usize = 300;

/// How near to the grain's the volume of the clump is made, relative to it.
const VOLUME_TOLERANCE: f64 = 1e-5;

/// Steps allowed to that, and the longest of them.
const VOLUME_STEPS: usize = 20;
const LONGEST_OFFSET: f64 = 0.2;

/// What ends the search.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum ClumpTarget {
    /// A number of spheres. Fewer are taken where more bring nothing: a ball takes one.
    Spheres(usize),
    /// The fewest spheres found whose [`Clump::rms`] is at most this share of the [`Clump::equivalent_radius`].
    Error(f64),
}

/// Why there is no clump.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum ClumpError {
    /// A triangle names a vertex that does not exist.
    #[error("triangle {triangle} names a vertex that does not exist")]
    MissingVertex {
        /// Position of the triangle in the mesh.
        triangle: usize,
    },
    /// The number of spheres is out of range.
    #[error("a clump has 1 to {MOST_SPHERES} spheres, not {found}")]
    Count {
        /// The number asked for.
        found: usize,
    },
    /// The error asked for is no share above zero.
    #[error("the error of a clump must be a share above zero, not {found}")]
    Share {
        /// The share asked for.
        found: f64,
    },
    /// The error asked for is not reached.
    #[error(
        "{MOST_SPHERES} spheres come within {:.2} % of the equivalent radius (RMS), not within {:.2} %",
        100.0 * reached,
        100.0 * asked
    )]
    NotReached {
        /// The share asked for.
        asked: f64,
        /// What the most spheres reach.
        reached: f64,
    },
    /// No ball was found inside: the mesh encloses nothing, is wound inwards, or has a coordinate that is not finite.
    #[error("no sphere was found inside the surface")]
    NoInside,
}

/// A grain made of spheres.
#[derive(Debug, Clone, PartialEq)]
pub struct Clump {
    /// The spheres, the one with the largest part of the surface first, in the unit and frame of the grain.
    pub spheres: Vec<Ball>,
    /// Area, volume, centroid and inertia of the grain, of density one.
    pub grain: MassProperties,
    /// Root mean square over the grain's surface of the distance to the clump's along the grain's normal, in the
    /// grain's unit.
    pub rms: f64,
    /// Volume of the clump over that of the grain, less one. The volume is good to 1e-4 of itself, see
    /// [`union_volume`].
    pub volume_error: f64,
}

impl Clump {
    /// The radius of the sphere of the grain's volume, (3V / 4 pi)^(1/3), in the grain's unit.
    pub fn equivalent_radius(&self) -> f64 {
        equivalent_radius(self.grain.volume)
    }

    /// The radius of the ball about the grain's centroid that holds all spheres, in the grain's unit.
    pub fn bounding_radius(&self) -> f64 {
        let reach = |ball: &Ball| (ball.centre - self.grain.centroid).norm() + ball.radius;
        self.spheres.iter().map(reach).fold(0.0, f64::max)
    }
}

fn equivalent_radius(volume: f64) -> f64 {
    (3.0 * volume / (4.0 * PI)).cbrt()
}

/// The clump of a grain, given by a closed mesh of it, wound counter-clockwise from outside, and its own volume,
/// centroid and inertia, which may be better known than the mesh's.
///
/// Found at unit size about the centroid, so that neither unit nor place matter.
///
/// # Errors
///
/// [`ClumpError`].
pub fn clump(
    mesh: &Mesh,
    grain: &MassProperties,
    target: ClumpTarget,
) -> Result<Clump, ClumpError> {
    let vertex = |corner: &u32| mesh.vertices.get(*corner as usize);
    let is_broken = |corners: &[u32; 3]| corners.iter().any(|corner| vertex(corner).is_none());
    if let Some(triangle) = mesh.triangles.iter().position(is_broken) {
        return Err(ClumpError::MissingVertex { triangle });
    }
    match target {
        ClumpTarget::Spheres(found) if !(1..=MOST_SPHERES).contains(&found) => {
            return Err(ClumpError::Count { found });
        }
        // Written so that NaN fails.
        ClumpTarget::Error(found) if !(found > 0.0 && found < 1.0) => {
            return Err(ClumpError::Share { found });
        }
        _ => {}
    }
    let radius = equivalent_radius(grain.volume);
    // Written so that NaN fails.
    if !(radius > 0.0 && radius.is_finite()) {
        return Err(ClumpError::NoInside);
    }
    let search = Search::new(&at_unit_size(mesh, &grain.centroid, radius))?;
    let (spheres, rms) = match target {
        ClumpTarget::Spheres(count) => search.of_count(count),
        ClumpTarget::Error(share) => search.of_error(share)?,
    };
    Ok(Clump {
        volume_error: union_volume(&spheres, ROWS) / UNIT_VOLUME - 1.0,
        spheres: spheres
            .into_iter()
            .map(|ball| Ball {
                centre: grain.centroid + ball.centre.coords * radius,
                radius: ball.radius * radius,
            })
            .collect(),
        grain: *grain,
        rms: rms * radius,
    })
}

/// The mesh so many times smaller about a centre, its triangles in the order of their distances from there: whatever
/// order they came in.
fn at_unit_size(mesh: &Mesh, centre: &Point3<f64>, radius: f64) -> Mesh {
    let vertices = mesh.vertices.iter();
    let vertices: Vec<Point3<f64>> = vertices
        .map(|vertex| ((vertex - centre) / radius).into())
        .collect();
    let square = |corner: u32| vertices[corner as usize].coords.norm_squared();
    let mut triangles: Vec<(f64, [u32; 3])> = mesh
        .triangles
        .iter()
        .map(|&[a, b, c]| {
            let turns = [[a, b, c], [b, c, a], [c, a, b]];
            let first = turns.map(|turn| square(turn[0]));
            let first = Vector3::from(first).imax();
            (square(a) + square(b) + square(c), turns[first])
        })
        .collect();
    triangles.sort_by(|one, other| one.0.total_cmp(&other.0));
    Mesh {
        triangles: triangles.into_iter().map(|(_, corners)| corners).collect(),
        vertices,
    }
}

/// Of a grain of equivalent radius one.
const UNIT_VOLUME: f64 = 4.0 * PI / 3.0;

/// A grain of unit size, and what its clumps are made from.
struct Search {
    places: Vec<EvenPlace>,
    cover: Cover,
}

impl Search {
    fn new(mesh: &Mesh) -> Result<Self, ClumpError> {
        let places = even_places(mesh, PLACES);
        let feet: Vec<EvenPlace> = places
            .iter()
            .step_by(PLACES_PER_CANDIDATE)
            .copied()
            .collect();
        let mut candidates = medial_balls(mesh, &feet);
        candidates.retain(|ball| {
            let numbers = [ball.radius, ball.centre.x, ball.centre.y, ball.centre.z];
            numbers.iter().all(|x| x.is_finite()) && ball.radius > 0.0
        });
        match candidates.is_empty() {
            true => Err(ClumpError::NoInside),
            false => Ok(Self {
                cover: Cover::new(&places, candidates),
                places,
            }),
        }
    }

    /// At most so many spheres, and their error.
    fn of_count(&self, count: usize) -> (Vec<Ball>, f64) {
        let spheres = with_volume(refine(&self.places, self.cover.of_count(count)));
        let spheres = without_swallowed(spheres);
        let rms = root_mean_square(&self.places, &spheres);
        (spheres, rms)
    }

    /// The fewest spheres found whose error is at most a share of the radius.
    fn of_error(&self, share: f64) -> Result<(Vec<Ball>, f64), ClumpError> {
        let (mut low, mut high) = (0, 1);
        let mut best = self.of_count(high);
        while best.1 > share {
            if high == MOST_SPHERES {
                let reached = best.1;
                return Err(ClumpError::NotReached {
                    asked: share,
                    reached,
                });
            }
            (low, high) = (high, (2 * high).min(MOST_SPHERES));
            best = self.of_count(high);
        }
        while high - low > 1 {
            let middle = (low + high) / 2;
            let found = self.of_count(middle);
            match found.1 <= share {
                true => (high, best) = (middle, found),
                false => low = middle,
            }
        }
        Ok(best)
    }
}

/// The spheres that no other one holds.
fn without_swallowed(spheres: Vec<Ball>) -> Vec<Ball> {
    let is_held = |(index, ball): (usize, &Ball)| {
        spheres.iter().enumerate().any(|(other, holder)| {
            let room = holder.radius - ball.radius - (holder.centre - ball.centre).norm();
            room > 0.0 || (room == 0.0 && other < index)
        })
    };
    let left = spheres.iter().enumerate();
    let left = left.filter(|(index, ball)| ball.radius > 0.0 && !is_held((*index, ball)));
    left.map(|(_, ball)| *ball).collect()
}

/// The spheres with radii that differ by one length, so that the clump has the volume of the grain of unit size.
fn with_volume(spheres: Vec<Ball>) -> Vec<Ball> {
    let wider = |offset: f64| -> Vec<Ball> {
        let radius = |ball: &Ball| (ball.radius + offset).max(0.0);
        let wider = spheres.iter().map(|ball| Ball {
            radius: radius(ball),
            ..*ball
        });
        wider.collect()
    };
    let excess = |offset: f64| union_volume(&wider(offset), ROWS) / UNIT_VOLUME - 1.0;
    // A secant through the last two, the first with the slope of a sphere of unit size.
    let (mut offset, mut found) = (0.0, excess(0.0));
    let mut slope = 3.0;
    for _ in 0..VOLUME_STEPS {
        if found.abs() <= VOLUME_TOLERANCE {
            break;
        }
        let next = offset - (found / slope).clamp(-LONGEST_OFFSET, LONGEST_OFFSET);
        let then = excess(next);
        if then != found {
            slope = ((then - found) / (next - offset)).max(1.0);
        }
        (offset, found) = (next, then);
    }
    wider(offset)
}
