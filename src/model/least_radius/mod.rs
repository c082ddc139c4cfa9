//! The least radius of a grain, proved: no direction is missed between samples.
//!
//! Each expansion is bounded on a part of the sphere by its value in one direction and by how fast it can
//! change, which follows from its degree and its size (see [`bound`]), by expanding it anew about that direction
//! ([`recentred`]), or of the whole sphere from values on a grid ([`gridded`]).
//! Where that is not enough, the part is cut in four. A blend is at least the mean of the bounds of its cells with the weights they can have there.
//! Most expansions of grains need no direction at all: the mean is larger than all other terms together.

mod blend;
mod bound;
mod gridded;
mod part;
mod recentred;

use super::{Family, InvalidGrain, StarGrain, StarSurface, Surface};
use crate::sphere::{AngleRectangle, Symmetry, cube_grid};
use blend::BlendPart;
use bound::{Bound, CapBound};
use nalgebra::Vector3;
use part::Patch;
use recentred::Recentring;

/// A bound is enough that is this share of the least radius met. A model with a narrow dent in which one more
/// digit were asked for takes ten times as long, or is given up.
const SHARE: f64 = 0.01;

/// Cells per cube edge of the directions tried first.
const FIRST: usize = 4;

/// Multiply-adds spent before a surface is given up: a second or two, a hundred times what fits of rough scans took.
const MAX_WORK: usize = 200_000_000;

/// Radii beyond which, or beyond the inverse of which, volumes are not numbers.
const LARGEST_RADIUS: f64 = 1e100;

/// What is known of the least radius of a grain, in the scan's unit.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LeastRadius {
    /// No radius is less: above zero.
    pub proved: f64,
    /// Some radius is not greater: the least one that was met, or a bound on it where the grain is
    /// [stretched](super::Stretch).
    pub found: f64,
}

/// Why no bound above zero was proved.
enum Failure {
    NotPositive(Vector3<f64>, f64),
    Unproved(f64),
}

/// A part of the sphere on which a surface is judged.
trait Part: Sized {
    /// A bound from below, without evaluations if that is `enough`, else with the radius in the middle.
    fn judge(&self, enough: f64) -> Judged;
    /// The parts it is cut in.
    fn quarters(&self) -> Vec<Self>;
    /// The direction of its middle.
    fn middle(&self) -> Vector3<f64>;
}

/// What is known of a part.
struct Judged {
    /// The radius is not less.
    least: f64,
    /// The radius in the middle, if it was asked for.
    value: Option<f64>,
    /// Multiply-adds.
    work: usize,
}

impl StarGrain {
    /// A bound on the radius in all directions, proved and not sampled: above zero, or an error.
    ///
    /// Takes some ten microseconds where the mean of each expansion is larger than its other terms together;
    /// 5 to 20 ms for rough scans of 800 to 9000 coefficients, whose cells are wild outside of themselves.
    ///
    /// # Errors
    /// [`InvalidGrain::NotPositive`] with a direction where the radius is not above zero,
    /// [`InvalidGrain::Unproved`] if bounds do not tell after a second or so, and
    /// [`InvalidGrain::OutOfRange`] if radii are beyond 1e100, or below its inverse.
    pub fn least_radius(&self) -> Result<LeastRadius, InvalidGrain> {
        let largest = match self.family() {
            Family::Blended(surface) => blend::bounds(surface)
                .iter()
                .map(CapBound::largest)
                .fold(0.0, f64::max),
            Family::Segmented(surface) => (0..surface.partition().segments())
                .map(|segment| surface.bound(segment).largest())
                .fold(0.0, f64::max),
            Family::Mirrored(surface) => surface.bound().largest(),
            Family::Whole(surface) => surface.bound().largest(),
        };
        let factors = self.stretch().factors();
        let size = largest / factors.min();
        if size.is_nan() || size > LARGEST_RADIUS {
            return Err(InvalidGrain::OutOfRange);
        }
        let (directions, _) = cube_grid(FIRST);
        let radii = self.local_radii(&directions);
        let met = radii.iter().copied().fold(f64::INFINITY, f64::min);
        // In the stretched space, as the surface is.
        let mut found = f64::INFINITY;
        for (n, radius) in directions.iter().zip(radii) {
            let (q, length) = self.stretch().direction(n);
            let radius = radius * length;
            if radius.is_nan() || radius <= 0.0 {
                return Err(self.failed(Failure::NotPositive(q, radius), met));
            }
            found = found.min(radius);
        }
        let least = match self.family() {
            Family::Blended(surface) => {
                let bounds = blend::bounds(surface);
                prove(
                    BlendPart::faces(surface, &bounds, &Recentring::default()),
                    found,
                )
            }
            Family::Segmented(surface) => {
                let partition = surface.partition();
                let patches = (0..partition.segments()).map(|segment| Patch {
                    rectangle: partition.rectangle(segment),
                    bound: surface.bound(segment),
                    value: move |n: &Vector3<f64>| surface.segment_radius(segment, n),
                });
                prove(patches.collect(), found)
            }
            Family::Mirrored(surface) => {
                let patch = Patch {
                    rectangle: surface.symmetry().rectangle(),
                    bound: surface.bound(),
                    value: |n: &Vector3<f64>| surface.radius(n),
                };
                prove(vec![patch], found)
            }
            Family::Whole(surface) => {
                let patch = Patch {
                    rectangle: Symmetry::NONE.rectangle(),
                    bound: surface.bound(),
                    value: |n: &Vector3<f64>| surface.radius(n),
                };
                let is_enough = patch.bound.everywhere() >= SHARE * found;
                match (!is_enough).then(|| gridded::least(surface, SHARE)) {
                    Some(Ok(Some(least))) => Ok(least),
                    Some(Err(failure)) => Err(failure),
                    Some(Ok(None)) | None => prove(vec![patch], found),
                }
            }
        };
        let (proved, found) = least.map_err(|failure| self.failed(failure, met))?;
        let least = LeastRadius {
            proved: proved / factors.max(),
            found: met.min(found / factors.min()),
        };
        match least.proved >= 1.0 / LARGEST_RADIUS {
            true => Ok(least),
            false => Err(InvalidGrain::OutOfRange),
        }
    }

    /// In the scan's frame, where `met` is the least of the radii tried first.
    fn failed(&self, failure: Failure, met: f64) -> InvalidGrain {
        match failure {
            Failure::Unproved(radius) => InvalidGrain::Unproved {
                found: met.min(radius / self.stretch().factors().min()),
            },
            Failure::NotPositive(q, radius) => {
                let local = q.component_div(self.stretch().factors()).normalize();
                InvalidGrain::NotPositive {
                    radius: radius / self.stretch().direction(&local).1,
                    direction: (self.frame().axes * local).into(),
                }
            }
        }
    }
}

/// The least bound of all parts, cut until it is at least the [`SHARE`] of the least radius met, and that
/// radius.
fn prove<P: Part>(mut parts: Vec<P>, mut found: f64) -> Result<(f64, f64), Failure> {
    let (mut work, mut proved) = (0, f64::INFINITY);
    while let Some(part) = parts.pop() {
        let judged = part.judge(SHARE * found);
        work += judged.work;
        if let Some(value) = judged.value {
            if value.is_nan() || value <= 0.0 {
                return Err(Failure::NotPositive(part.middle(), value));
            }
            found = found.min(value);
        }
        // Written so that NaN is not enough.
        if judged.least >= SHARE * found {
            proved = proved.min(judged.least);
            continue;
        }
        if work > MAX_WORK {
            return Err(Failure::Unproved(found));
        }
        parts.extend(part.quarters());
    }
    Ok((proved.min(found), found))
}

/// The middle of a rectangle of angles, and the angular radius of the cap round it that holds it.
fn round(rectangle: &AngleRectangle) -> (Vector3<f64>, f64) {
    let cap = rectangle.cap();
    (cap.centre, bound::angle(cap.height))
}

#[cfg(test)]
mod tests;
