//! The search for the spheres of a grain of unit size.

use super::cover::Cover;
use super::error::{ClumpError, MOST_SPHERES};
use super::gap::root_mean_square;
use super::refine::refine;
use super::union_volume::union_volume;
use crate::Mesh;
use crate::measure::{Ball, EvenPlace, TriangleTree, even_places, medial_balls};
use nalgebra::{Point3, Vector3};
use std::f64::consts::PI;

/// Places of the surface that are covered, and so many times fewer that have a candidate.
const COVERED: usize = 4000;
const COVERED_PER_CANDIDATE: usize = 4;

/// Places that spheres are fitted to.
const FITTED: usize = 12_000;

/// Places that the error is found from. They lie between those of the fit, where it is no better than anywhere: an even
/// multiple of their number has none in common with them.
const JUDGED: usize = 4 * FITTED;

/// Rows across the shortest side of a clump in which its volume is made, and told.
const ROWS: usize = 300;
const ROWS_TOLD: usize = 600;

/// More spheres that come nearer by less than so many times bring nothing.
const NEARER: f64 = 1.05;

/// A sphere may have left the body if its centre is outside by more than this share of its radius, ...
const OUTSIDE: f64 = 0.25;

/// ... and has by more than this one.
const ASTRAY: f64 = 0.75;

/// How near to the grain's the volume of the clump is made, relative to it.
const VOLUME_TOLERANCE: f64 = 1e-5;

/// Steps allowed to that, and the longest of them.
const VOLUME_STEPS: usize = 20;
const LONGEST_OFFSET: f64 = 0.2;

/// Of a grain of equivalent radius one.
pub(super) const UNIT_VOLUME: f64 = 4.0 * PI / 3.0;

/// The mesh so many times smaller about a centre, its triangles in the order of their distances from there: whatever
/// order they came in.
pub(super) fn at_unit_size(mesh: &Mesh, centre: &Point3<f64>, radius: f64) -> Mesh {
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

/// A grain of unit size, and what its clumps are made from.
pub(super) struct Search {
    cover: Cover,
    body: TriangleTree,
    fitted: Vec<EvenPlace>,
    judged: Vec<EvenPlace>,
}

/// Spheres and their error.
type Judged = (Vec<Ball>, f64);

impl Search {
    pub(super) fn new(mesh: &Mesh) -> Result<Self, ClumpError> {
        let covered = even_places(mesh, COVERED);
        let feet: Vec<EvenPlace> = covered
            .iter()
            .step_by(COVERED_PER_CANDIDATE)
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
                cover: Cover::new(&covered, candidates),
                body: TriangleTree::new(mesh),
                fitted: even_places(mesh, FITTED),
                judged: even_places(mesh, JUDGED),
            }),
        }
    }

    /// At most so many spheres: half as many as long as more bring nothing.
    pub(super) fn of_count(&self, count: usize) -> Judged {
        let mut found = self.fit(count);
        while found.0.len() > 1 {
            let fewer = self.fit(found.0.len() / 2);
            if fewer.1 > NEARER * found.1 {
                break;
            }
            found = fewer;
        }
        found
    }

    /// So many spheres, or fewer where some lie in others. Through a tip one may leave the body with nothing in its way: then
    /// all centres are kept inside, unless it has not gone far and that comes less near to the surface.
    fn fit(&self, count: usize) -> Judged {
        let begin = self.cover.of_count(count);
        let free = self.judged(&begin, |_| true);
        if !self.has_left(&free.0, OUTSIDE) {
            return free;
        }
        let inside = self.judged(&begin, |centre| !self.body.is_outside(&centre.coords));
        match inside.1 <= free.1 || self.has_left(&free.0, ASTRAY) {
            true => inside,
            false => free,
        }
    }

    fn judged(&self, begin: &[Ball], may_be: impl Fn(&Point3<f64>) -> bool + Sync) -> Judged {
        let spheres = refine(&self.fitted, begin, self.cover.largest(), may_be);
        let spheres = without_swallowed(with_volume(spheres));
        let rms = root_mean_square(&self.judged, &spheres);
        (spheres, rms)
    }

    /// Whether the centre of a sphere is outside of the body by more than a share of its radius.
    fn has_left(&self, spheres: &[Ball], share: f64) -> bool {
        spheres.iter().any(|ball| {
            let centre = &ball.centre.coords;
            self.body.is_outside(centre) && self.body.nearest(centre, share * ball.radius).is_none()
        })
    }

    /// The fewest spheres found whose error is at most a share of the radius.
    pub(super) fn of_error(&self, share: f64) -> Result<Judged, ClumpError> {
        let (mut low, mut high) = (0, 1);
        let mut best = self.fit(high);
        let (mut reached, mut spheres) = (best.1, best.0.len());
        while best.1 > share {
            if high == MOST_SPHERES {
                return Err(ClumpError::NotReached {
                    asked: share,
                    reached,
                    spheres,
                });
            }
            (low, high) = (high, (2 * high).min(MOST_SPHERES));
            best = self.fit(high);
            if best.1 < reached {
                (reached, spheres) = (best.1, best.0.len());
            }
        }
        while high - low > 1 {
            let middle = (low + high) / 2;
            let found = self.fit(middle);
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
    let excess = |offset: f64| excess_volume(&wider(offset), ROWS);
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

/// The volume of a clump beside that of the grain of unit size, as it is told.
pub(super) fn told_excess(spheres: &[Ball]) -> f64 {
    excess_volume(spheres, ROWS_TOLD)
}

fn excess_volume(spheres: &[Ball], rows: usize) -> f64 {
    union_volume(spheres, rows) / UNIT_VOLUME - 1.0
}
