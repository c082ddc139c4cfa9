//! All places where two surfaces of any kind, concave ones too, lie in one another.
//!
//! Both are triangulated coarsely; triangles that may be near the other body (by a tree of boxes, each as much larger as
//! the surface may be off its triangle) or inside it are cut in four, again and again, and the others are left out. So
//! only the parts that face each other are evaluated. What the polyhedra share is known to rounding, and by how much it
//! changes with the last cut, extrapolated, is the error of what the surfaces share. Where that is a lens between smooth
//! surfaces, it is summed as such, far closer, as soon as the polyhedra agree. No centre and no star shape is made use of:
//! a body's centre may lie inside the other.
//!
//! Of bodies that move, a [`ContactPair`] follows the deepest points from pose to pose.

mod clip;
mod cluster;
mod deepest;
mod farthest;
mod kept;
mod lens;
mod near;
mod pair;
mod patch;
mod sums;

use super::{KnownContact, RelativeCurvature};
use crate::measure::Curvature;
use crate::model::{LocalError, Surface};
use cluster::{Cluster, Found};
use deepest::Placed;
use nalgebra::{Isometry3, Point3, Translation3, Vector3};
use near::near_places;
pub use pair::{ContactPair, ContactPlace};
use patch::Patch;
use std::f64::consts::PI;
use std::fmt;
use thiserror::Error;

/// Share of the smaller body from which on two bodies are no bodies that touch.
const LARGEST_SHARE: f64 = 0.9;

/// A surface made ready for contacts: the work that does not depend on where it lies.
#[derive(Clone)]
pub struct ContactBody<'a> {
    surface: &'a dyn Surface,
    whole: Patch,
    /// Of a sphere about the centre that the body lies in.
    radius: f64,
    /// Of the triangles.
    volume: f64,
}

impl<'a> ContactBody<'a> {
    /// Triangulates a surface. One whose places are not finite is refused where its contacts are looked for.
    pub fn new(surface: &'a dyn Surface) -> Self {
        let whole = Patch::whole(surface);
        Self {
            radius: whole.radius(&surface.frame().centre),
            volume: whole.volume(&surface.frame().centre),
            surface,
            whole,
        }
    }

    /// The most by which a point of the body moves between two poses.
    fn motion(&self, from: &Isometry3<f64>, to: &Isometry3<f64>) -> f64 {
        let centre = self.surface.frame().centre;
        let turn = from.rotation.rotation_to(&to.rotation).angle();
        (to * centre - from * centre).norm() + 2.0 * self.radius * (0.5 * turn).sin()
    }
}

impl fmt::Debug for ContactBody<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("ContactBody")
            .field("frame", &self.surface.frame())
            .field("radius", &self.radius)
            .field("volume", &self.volume)
            .finish_non_exhaustive()
    }
}

/// A place where two bodies overlap.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct ContactRegion {
    /// The middle of what they share.
    pub point: Point3<f64>,
    /// The unit normal, from the first body to the second: that along which what they share grows fastest.
    pub normal: Vector3<f64>,
    /// How far they overlap: that of the deepest of the pairs of points whose line is normal to both surfaces, and from
    /// which these part in all directions: [`Self::deepest`]. Where none is as deep as the triangles tell, as where a point
    /// of one surface is as far from two places of the other, it is the largest distance that these tell, to some ten
    /// percent.
    pub depth: f64,
    /// The volume they share.
    pub volume: f64,
    /// By how much that may be off.
    pub volume_error: f64,
    /// Area of the first body's surface in the second, along its outward normal: how fast the volume grows as the first
    /// body moves.
    pub area: Vector3<f64>,
    /// Integral of (x - `point`) x n over that surface, n its outward unit normal: how fast the volume grows as the first
    /// body turns round `point`.
    pub moment: Vector3<f64>,
    /// The two points of the depth, on the first surface and on the second; none where these were not found. The line
    /// between them need not be along `normal`.
    pub deepest: Option<[Point3<f64>; 2]>,
    /// Curvature of both surfaces at the two points of the depth; none where these were not found.
    pub curvatures: Option<[Curvature; 2]>,
    /// Standard errors of both surfaces there, where both tell them.
    pub errors: Option<[LocalError; 2]>,
}

impl ContactRegion {
    /// Standard error of the depth, where both surfaces tell theirs.
    pub fn depth_error(&self) -> Option<f64> {
        self.errors.as_ref().map(apart_error)
    }

    /// Standard error of the volume, where both surfaces tell theirs: of the effective radius, and of the depth. The volume
    /// of a lens goes with the square of that, so an overlap by less than its error may be many times larger: half of what
    /// two errors of the depth add.
    pub fn volume_standard_error(&self) -> Option<f64> {
        let of_radius = self.radius_share(1.0)? * self.volume;
        let error = self.depth_error()?;
        let of_depth = self.area.norm() * error * (1.0 + error / self.depth);
        Some(of_radius.hypot(of_depth))
    }

    /// How many times the force of Hertz is that the volume of the region tells, and not the curvature in its middle: a gap
    /// A x² + B y² holds V = pi rho u² at the depth u, and the force goes with the root of rho.
    pub fn times(&self, relative: &RelativeCurvature) -> f64 {
        let radius = self.volume / (PI * self.depth * self.depth);
        (radius / relative.effective_radius()).sqrt()
    }

    /// Standard error, as a share, of the effective radius to a power, by which figures of a lens go. However little is known
    /// of the curvature in its middle, the rim of the lens lies no farther off, beside that, than two places of the surfaces
    /// may.
    pub(super) fn radius_share(&self, power: f64) -> Option<f64> {
        let of_rim = power * 2.0_f64.sqrt() * self.depth_error()? / self.depth;
        match KnownContact::at(self.curvatures.as_ref()?, self.errors.as_ref()) {
            Ok(known) => {
                let of_middle = known.share(|relative| relative.effective_radius().powf(power));
                Some(of_middle?.min(of_rim))
            }
            Err(_) => Some(of_rim),
        }
    }
}

/// Standard error of how far surfaces lie in each other along their common normal.
fn apart_error([one, two]: &[LocalError; 2]) -> f64 {
    one.place.hypot(two.place)
}

/// What was looked at, and what was not.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
#[non_exhaustive]
pub struct RegionWork {
    /// Triangles of both bodies to begin with.
    pub triangles: usize,
    /// Of these, triangles that were left out at once.
    pub skipped: usize,
    /// Pairs of boxes that were compared.
    pub compared: usize,
    /// Places of the surfaces that were evaluated.
    pub evaluated: usize,
}

/// All regions, the largest first.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct ContactRegions {
    /// Nothing if the bodies are apart.
    pub regions: Vec<ContactRegion>,
    /// What it took.
    pub work: RegionWork,
}

/// Why the contact of two bodies is not told.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Error)]
#[non_exhaustive]
pub enum RegionError {
    /// There is neither a normal nor a depth.
    #[error("one body lies wholly inside the other")]
    Inside,
    /// What they share is most of one of them, or is not told apart from it.
    #[error(
        "the bodies lie so deep in each other, or so nearly in the same place, that what they share has no depth and no normal"
    )]
    Deep,
    /// What is shared is a sliver, or the surfaces lie on each other over much of it.
    #[error(
        "the surfaces cross at so small an angle, or lie so near each other over so much of them, that what the bodies share is \
         not resolved"
    )]
    Unresolved,
    /// Its triangles have no inside.
    #[error("the surfaces share no inside there: one goes through itself, or both coincide")]
    Crossing,
    /// Where the bodies are is not known.
    #[error("a number of the pose, or of a surface, is not finite")]
    NotFinite,
}

/// Finds where two bodies overlap, of which the second is moved by `pose`.
///
/// Volumes shared by smooth bodies are known to 1e-6 of themselves or closer where they are lenses, less well of cells
/// that meet there and of deep overlaps, as the error of each tells. A depth below 1e-7 of the bodies' size may pass unseen.
///
/// Takes 4 to 20 ms of bodies that touch, and the longer the deeper they lie in each other: .05 to .12 s of smooth ones where
/// they share a tenth and more, up to 2 s of rough ones and of those that graze each other. Moving bodies are followed faster by a [`ContactPair`].
///
/// # Errors
///
/// [`RegionError`]
pub fn contact_regions(
    first: &ContactBody<'_>,
    second: &ContactBody<'_>,
    pose: &Isometry3<f64>,
) -> Result<ContactRegions, RegionError> {
    check([first, second], pose)?;
    let common = Common::new([first, second], pose);
    let (found, work) = found_regions([first, second], &common)?;
    let shared: f64 = found.iter().map(|found| found.sums.volume).sum();
    if shared > LARGEST_SHARE * first.volume.min(second.volume) {
        return Err(RegionError::Deep);
    }
    let mut regions: Vec<_> = found
        .iter()
        .map(|found| found.told(&common.centre))
        .collect();
    regions.sort_by(|one, other| other.volume.total_cmp(&one.volume));
    Ok(ContactRegions { regions, work })
}

/// Where two bodies, of which the second is moved by `pose`, come nearer to each other than `margin` and do not touch: each
/// has a depth below zero.
///
/// # Errors
///
/// [`RegionError::NotFinite`]
pub fn contact_gaps(
    first: &ContactBody<'_>,
    second: &ContactBody<'_>,
    pose: &Isometry3<f64>,
    margin: f64,
) -> Result<Vec<ContactPlace>, RegionError> {
    let bodies = [first, second];
    check(bodies, pose)?;
    if margin.is_nan() {
        return Err(RegionError::NotFinite);
    }
    let common = Common::new(bodies, pose);
    if common.clearance(bodies) > margin {
        return Ok(Vec::new());
    }
    let near = near_places(
        &common.placed(bodies),
        bodies.map(|body| &body.whole),
        margin,
    );
    let places = near.into_iter();
    Ok(places
        .map(|pair| ContactPlace::of_pair(pair, &common.centre))
        .collect())
}

/// Refuses what would be apart of everything, for nothing is near to NaN.
fn check(bodies: [&ContactBody<'_>; 2], pose: &Isometry3<f64>) -> Result<(), RegionError> {
    let [moved, turned] = [
        pose.translation.vector.as_slice(),
        pose.rotation.coords.as_slice(),
    ];
    let sizes = bodies.map(|body| body.volume);
    let all = moved.iter().chain(turned).chain(&sizes);
    match all.copied().all(f64::is_finite) {
        true => Ok(()),
        false => Err(RegionError::NotFinite),
    }
}

/// The frame in which two bodies are compared: that of the first body's scan seen from its centre, so that digits are
/// kept far from the origin.
struct Common {
    centre: Point3<f64>,
    poses: [Isometry3<f64>; 2],
}

impl Common {
    fn new([first, _]: [&ContactBody<'_>; 2], pose: &Isometry3<f64>) -> Self {
        let centre = first.surface.frame().centre;
        let local = Translation3::from(-centre.coords);
        Self {
            centre,
            poses: [Isometry3::from(local), local * pose],
        }
    }

    fn placed<'b>(&'b self, bodies: [&'b ContactBody<'_>; 2]) -> [Placed<'b>; 2] {
        [0, 1].map(|side| Placed {
            surface: bodies[side].surface,
            pose: &self.poses[side],
        })
    }

    /// How far apart the spheres are that the bodies lie in; below zero where they overlap.
    fn clearance(&self, bodies: [&ContactBody<'_>; 2]) -> f64 {
        let [one, two] = [0, 1].map(|side| self.poses[side] * bodies[side].surface.frame().centre);
        (two - one).norm() - bodies[0].radius - bodies[1].radius
    }
}

/// All regions, in no order.
fn found_regions(
    bodies: [&ContactBody<'_>; 2],
    common: &Common,
) -> Result<(Vec<Found>, RegionWork), RegionError> {
    let mut work = RegionWork {
        triangles: bodies.iter().map(|body| body.whole.triangles.len()).sum(),
        ..RegionWork::default()
    };
    if common.clearance(bodies) > 0.0 {
        work.skipped = work.triangles;
        return Ok((Vec::new(), work));
    }
    let placed = common.placed(bodies);
    let wholes = bodies.map(|body| &body.whole);
    let mut left = vec![Cluster::whole(wholes, &common.poses)];
    let mut regions = Vec::new();
    let mut is_mostly_inside = false;
    while let Some(cluster) = left.pop() {
        let cut = cluster.cut(&placed, &mut work)?;
        left.extend(cut.finer);
        regions.extend(cut.found);
        is_mostly_inside |= cut.is_mostly_inside;
    }
    match regions.is_empty() && is_mostly_inside {
        true => Err(RegionError::Inside),
        false => Ok((regions, work)),
    }
}

#[cfg(test)]
mod tests;
