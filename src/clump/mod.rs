//! Clumps: grains made of overlapping spheres, for engines that know no other shape.
//!
//! Balls that touch the grain's surface from within in two places, those of its medial axis, are candidates. The fewest
//! that come near enough to all of the surface are taken one after the other, each is fitted to the part of the surface
//! that is nearest to it, not much larger than the body holds, and at last all radii grow or shrink by the same length
//! until the clump has the volume of the grain. Mass, centre and inertia of a clump are those of the *grain*, never sums
//! over spheres, whose overlaps would count twice.

mod check;
mod cover;
mod error;
mod gap;
mod refine;
mod search;
#[cfg(test)]
mod tests;
mod union_volume;

use crate::Mesh;
use crate::measure::{Ball, MassProperties, equivalent_radius};
use check::check;
pub use error::{ClumpError, MOST_SPHERES};
use search::{Search, at_unit_size, told_excess};
pub use union_volume::union_volume;

/// How far the volume of a clump may be off the grain's, as a share of it; usually it is within 1e-4.
const MOST_EXCESS: f64 = 0.01;

/// What ends the search.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum ClumpTarget {
    /// A number of spheres. Fewer are taken where some lie in others, and half as many as long as more come nearer to the
    /// surface by less than a twentieth.
    Spheres(usize),
    /// The fewest spheres found whose [`Clump::rms`] is at most this share of the [`Clump::equivalent_radius`].
    Error(f64),
}

/// A grain made of spheres.
#[derive(Debug, Clone, PartialEq)]
pub struct Clump {
    /// The spheres, the one with the largest part of the surface first, in the unit and frame of the grain.
    pub spheres: Vec<Ball>,
    /// Area, volume, centroid and inertia of the grain, of density one.
    pub grain: MassProperties,
    /// Root mean square over the grain's surface of the distance to the clump's along the grain's normal, in the
    /// grain's unit: over places that the spheres were not fitted to.
    pub rms: f64,
    /// Volume of the clump over that of the grain, less one. The volume is good to 1e-4 of itself, see
    /// [`union_volume`](union_volume()).
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

/// The clump of a grain, given by a closed mesh of it, wound counter-clockwise from outside, and its own volume,
/// centroid and inertia, which may be better known than the mesh's: a volume inside it that is off by more than a quarter is
/// not that of the grain.
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
    let mesh = at_unit_size(mesh, &grain.centroid, radius);
    check(&mesh)?;
    let search = Search::new(&mesh)?;
    let (spheres, rms) = match target {
        ClumpTarget::Spheres(count) => search.of_count(count),
        ClumpTarget::Error(share) => search.of_error(share)?,
    };
    let excess = told_excess(&spheres);
    // No range holds NaN.
    if !(-MOST_EXCESS..=MOST_EXCESS).contains(&excess) {
        return Err(ClumpError::Volume { excess });
    }
    Ok(Clump {
        volume_error: excess,
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
