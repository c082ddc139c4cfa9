//! Where the surface of one body goes through itself, and what that makes of its figures.
//!
//! A closed mesh winds round every place a number of times: once inside of a body, and not at all outside. Where it goes
//! through itself it winds round places twice, or the wrong way: sums over its triangles then count these so many times,
//! and add up area that is not on the outside.
//!
//! 1. [Triangles that may cross](mod@candidates), from how the surface is seen from its middle.
//! 2. The pairs that do, by exact predicates.
//! 3. The [patches] between them, and how often the surface winds round the places on both sides of each.

mod candidates;
mod patches;

use super::Scale;
use super::crossings::{all_crossings, is_clear};
use crate::Mesh;
use candidates::candidates;
use nalgebra::{Point3, Vector3};
use patches::Patches;
use std::fmt;

/// Shares of the area, or of the volume, beyond which figures are not told: it would be anyone's guess how far off they are.
const LARGEST: f64 = 0.01;

/// Where a surface goes through itself, and how far its area and its volume may be off for that.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct SelfCrossing {
    /// The middle of the place that moves the figures most, in the scan's unit.
    pub place: Point3<f64>,
    /// Number of such places.
    pub places: usize,
    /// The sum over the triangles is larger than the area of the outside by at most this share of it.
    pub area: f64,
    /// The sum over the triangles differs from the volume by at most this share of the sum.
    pub volume: f64,
}

impl SelfCrossing {
    /// Whether the area is so far off that it is not to be told.
    pub(crate) fn hides_area(&self) -> bool {
        self.area.is_nan() || self.area > LARGEST
    }

    /// The same of the volume, and of what is integrated over it.
    pub(crate) fn hides_volume(&self) -> bool {
        self.volume.is_nan() || self.volume > LARGEST
    }
}

impl fmt::Display for SelfCrossing {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let largest = self.place.coords.amax();
        let [x, y, z] = self.place.coords.map(|x| digits(x, largest)).into();
        write!(f, "the surface goes through itself near ({x}, {y}, {z})")?;
        match self.places {
            0 | 1 => {}
            2 => write!(f, " and at another place")?,
            places => write!(f, " and at {} other places", places - 1)?,
        }
        write!(
            f,
            ": its triangles have up to {} too much area, and their volume is up to {} off",
            share(self.area),
            share(self.volume)
        )
    }
}

/// Six digits of the largest of some numbers, and as many decimals of the others.
fn digits(value: f64, largest: f64) -> String {
    if !(1e-4..1e7).contains(&largest) {
        return format!("{value:.5e}");
    }
    let decimals = (5 - largest.log10().floor() as i32).clamp(0, 9) as usize;
    // Not as -0.
    let value = if value.abs() < 1e-6 * largest {
        0.0
    } else {
        value
    };
    format!("{value:.decimals$}")
}

fn share(of_one: f64) -> String {
    match 100.0 * of_one {
        percent if percent < 1e-3 => format!("{percent:.1e} %"),
        percent if percent < 1.0 => format!("{percent:.3} %"),
        percent if percent < 100.0 => format!("{percent:.0} %"),
        _ => "100 % and more".into(),
    }
}

/// Where the surface of one body goes through itself; `None` if it does not, though it may touch itself. The mesh must be
/// closed and of one part.
pub(crate) fn self_crossing(mesh: &Mesh) -> Option<SelfCrossing> {
    let scale = Scale::of(mesh);
    let (mesh, volume, middle) = outwards(scale.mesh(mesh));
    let candidates = candidates(&mesh, &middle)?;
    let near = Mesh {
        vertices: mesh.vertices.clone(),
        triangles: candidates.iter().map(|&at| mesh.triangles[at]).collect(),
    };
    let pairs: Vec<[usize; 2]> = all_crossings(&near)
        .into_iter()
        .map(|pair| pair.map(|at| candidates[at]))
        .collect();
    let corners = |at: usize| mesh.triangles[at].map(|corner| mesh.vertices[corner as usize]);
    let is_crossed = |&[one, two]: &[usize; 2]| is_clear(corners(one), corners(two));
    let (crossed, touching): (Vec<_>, Vec<_>) = pairs.into_iter().partition(is_crossed);
    let found = Patches::new(&mesh, &crossed, &touching).off(volume)?;
    Some(SelfCrossing {
        place: scale.point(&found.place),
        ..found
    })
}

/// The mesh, wound so that the volume that it encloses is not below zero; this volume, and its centroid.
fn outwards(mut mesh: Mesh) -> (Mesh, f64, Point3<f64>) {
    let (mut sum, mut volume) = (Vector3::zeros(), 0.0);
    for corners in &mesh.triangles {
        let [a, b, c] = corners.map(|corner| mesh.vertices[corner as usize].coords);
        let own = cone(a, b, c);
        sum += (a + b + c) * (own / 4.0);
        volume += own;
    }
    if volume < 0.0 {
        let wound = mesh.triangles.iter_mut();
        wound.for_each(|corners| corners.reverse());
    }
    (mesh, volume.abs(), Point3::from(sum / volume))
}

/// Volume between the origin and a triangle.
fn cone(a: Vector3<f64>, b: Vector3<f64>, c: Vector3<f64>) -> f64 {
    a.dot(&b.cross(&c)) / 6.0
}

#[cfg(test)]
mod tests;
