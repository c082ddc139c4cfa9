//! Balls of the medial axis: those inside a surface that touch it in two places.

use super::Ball;
use super::even_places::EvenPlace;
use super::triangle_tree::TriangleTree;
use crate::Mesh;
use nalgebra::Vector3;
use rayon::prelude::*;

/// Shrinkings of a ball; five to ten are usual.
const MAX_SHRINKS: usize = 60;

/// Share of the radius by which a ball that touches the surface may seem to cross it.
const TOUCHES: f64 = 1e-6;

/// Share of the larger radius that the centres of two starts are apart at least, and the number of starts.
const APART: f64 = 0.5;
const STARTS: usize = 4;

/// Share of the deepest ball's radius below which a ball is no start: the search that follows makes a
/// medial ball larger by a few percent as a rule.
const SHALLOW: f64 = 0.8;

/// The ball inside a closed mesh that touches it at each of some places, and somewhere else. Every triangle must name
/// vertices that exist.
pub(crate) fn medial_balls(mesh: &Mesh, places: &[EvenPlace]) -> Vec<Ball> {
    medial_balls_of(&TriangleTree::new(mesh), places)
}

/// The same, of the triangles of a tree.
pub(super) fn medial_balls_of(tree: &TriangleTree, places: &[EvenPlace]) -> Vec<Ball> {
    let ball = |at: &EvenPlace| {
        let inward = -at.outward;
        let others = places.iter().map(|other| &other.place);
        let free = free_radius(&at.place, &inward, tree.size(), others);
        let nearest = |place: &Vector3<f64>, limit| tree.nearest(place, limit);
        medial_ball(&at.place, &inward, free, nearest)
    };
    places.par_iter().map(ball).collect()
}

/// The ball that touches a surface at `foot` from the side to which the unit vector `inward` points, and
/// touches it somewhere else, by the shrinking of a ball of the radius `largest` (Ma, Bae and Choi 2012).
/// `nearest` finds the nearest point of the surface, if it is nearer than a limit.
///
/// The ball through the foot and the nearest point, with its centre on the normal, is smaller; it is taken
/// until no point is nearer than the foot.
pub(super) fn medial_ball(
    foot: &Vector3<f64>,
    inward: &Vector3<f64>,
    largest: f64,
    nearest: impl Fn(&Vector3<f64>, f64) -> Option<Vector3<f64>>,
) -> Ball {
    let mut radius = largest;
    for _ in 0..MAX_SHRINKS {
        let centre = foot + inward * radius;
        let Some(other) = nearest(&centre, radius * (1.0 - TOUCHES)) else {
            break;
        };
        let across = other - foot;
        let smaller = across.norm_squared() / (2.0 * across.dot(inward));
        // Written so that NaN ends the search.
        if !(smaller < radius && smaller > 0.0) {
            break;
        }
        radius = smaller;
    }
    let centre = foot + inward * radius;
    let nearer = nearest(&centre, radius);
    Ball {
        centre: centre.into(),
        radius: nearer.map_or(radius, |other| (other - centre).norm()),
    }
}

/// The radius of the largest ball that touches a surface at `foot`, as in [`medial_ball`], and holds none of some other
/// points of the surface; at most `largest`.
pub(super) fn free_radius<'a>(
    foot: &Vector3<f64>,
    inward: &Vector3<f64>,
    largest: f64,
    others: impl Iterator<Item = &'a Vector3<f64>>,
) -> f64 {
    let radii = others.map(|other| {
        let across = other - foot;
        let along = across.dot(inward);
        match along > 0.0 {
            true => across.norm_squared() / (2.0 * along),
            false => f64::INFINITY,
        }
    });
    radii.fold(largest, f64::min)
}

/// The deepest of some balls, so many of them that are apart and `inside`: where to look for the largest.
pub(super) fn deepest(mut balls: Vec<Ball>, inside: impl Fn(&Ball) -> bool) -> Vec<Ball> {
    balls.retain(|ball| ball.radius.is_finite() && ball.radius > 0.0);
    balls.sort_by(|one, other| other.radius.total_cmp(&one.radius));
    let mut starts: Vec<Ball> = Vec::new();
    let mut outside: Vec<Ball> = Vec::new();
    for ball in balls {
        let is_apart = |other: &Ball| {
            (ball.centre - other.centre).norm() > APART * other.radius.max(ball.radius)
        };
        let is_shallow = starts
            .first()
            .is_some_and(|first| ball.radius < SHALLOW * first.radius);
        if starts.len() == STARTS || is_shallow {
            break;
        }
        // A ball whose centre another one holds is on the same side of the surface.
        let holds = |other: &Ball| (ball.centre - other.centre).norm() < other.radius;
        if !starts.iter().all(is_apart) || outside.iter().any(holds) {
            continue;
        }
        match inside(&ball) {
            true => starts.push(ball),
            false => outside.push(ball),
        }
    }
    starts
}
