//! Balls of the medial axis: those inside a surface that touch it in two places.

use crate::Mesh;
use crate::measure::Ball;
use crate::measure::even_places::EvenPlace;
use crate::measure::triangle_tree::TriangleTree;
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
    let tree = TriangleTree::new(mesh);
    let nearest = |place: &Vector3<f64>, limit| tree.nearest(place, limit);
    let ball = |foot: Foot| foot.ball(nearest);
    feet(places, tree.size())
        .into_par_iter()
        .map(ball)
        .collect()
}

/// Where a ball may touch a surface.
pub(in crate::measure) struct Foot {
    place: Vector3<f64>,
    /// The unit vector to the side where the ball is.
    inward: Vector3<f64>,
    /// The ball is not larger.
    most: f64,
}

/// Places of a surface as feet of balls no larger than `largest`.
pub(super) fn feet(places: &[EvenPlace], largest: f64) -> Vec<Foot> {
    let foot = |at: &EvenPlace| {
        let others = places.iter().map(|other| &other.place);
        Foot::new(at.place, -at.outward, largest, others)
    };
    places.par_iter().map(foot).collect()
}

impl Foot {
    /// The foot of a ball that holds none of some other points of the surface, and is at most of the radius `largest`.
    pub(in crate::measure) fn new<'a>(
        place: Vector3<f64>,
        inward: Vector3<f64>,
        largest: f64,
        others: impl Iterator<Item = &'a Vector3<f64>>,
    ) -> Self {
        let radii = others.map(|other| {
            let across = other - place;
            let along = across.dot(&inward);
            match along > 0.0 {
                true => across.norm_squared() / (2.0 * along),
                false => f64::INFINITY,
            }
        });
        Self {
            place,
            inward,
            most: radii.fold(largest, f64::min),
        }
    }

    /// The ball that touches the surface here and somewhere else, by the shrinking of a ball (Ma, Bae and Choi 2012).
    /// `nearest` finds the nearest point of the surface, if it is nearer than a limit.
    ///
    /// The ball through the foot and the nearest point, with its centre on the normal, is smaller; it is taken
    /// until no point is nearer than the foot.
    fn ball(&self, nearest: impl Fn(&Vector3<f64>, f64) -> Option<Vector3<f64>>) -> Ball {
        let mut radius = self.most;
        for _ in 0..MAX_SHRINKS {
            let centre = self.centre(radius);
            let Some(other) = nearest(&centre, radius * (1.0 - TOUCHES)) else {
                break;
            };
            let across = other - self.place;
            let smaller = across.norm_squared() / (2.0 * across.dot(&self.inward));
            // Written so that NaN ends the search.
            if !(smaller < radius && smaller > 0.0) {
                break;
            }
            radius = smaller;
        }
        let centre = self.centre(radius);
        let nearer = nearest(&centre, radius);
        Ball {
            centre: centre.into(),
            radius: nearer.map_or(radius, |other| (other - centre).norm()),
        }
    }

    fn centre(&self, radius: f64) -> Vector3<f64> {
        self.place + self.inward * radius
    }

    /// Whether every ball from here of at least a radius is too near to a start to be another one.
    fn is_beside(&self, start: &Ball, least: f64) -> bool {
        let ends = [least, self.most].map(|radius| self.centre(radius));
        ends.iter()
            .all(|end| (end - start.centre.coords).norm() <= APART * start.radius)
    }
}

/// The deepest of the balls that touch a surface at some feet, so many of them that are apart and `inside`: where to look
/// for the largest. A ball is found when no other can be deeper.
pub(in crate::measure) fn deepest(
    mut feet: Vec<Foot>,
    nearest: impl Fn(&Vector3<f64>, f64) -> Option<Vector3<f64>>,
    inside: impl Fn(&Ball) -> bool,
) -> Vec<Ball> {
    feet.sort_by(|one, other| one.most.total_cmp(&other.most));
    let mut starts: Vec<Ball> = Vec::new();
    let mut outside: Vec<Ball> = Vec::new();
    // Ascending.
    let mut balls: Vec<Ball> = Vec::new();
    while starts.len() < STARTS {
        let least = starts.first().map_or(0.0, |first| SHALLOW * first.radius);
        let known = balls.last().map_or(least, |ball| ball.radius.max(least));
        if let Some(foot) = feet.pop_if(|foot| foot.most > known) {
            if starts.iter().any(|start| foot.is_beside(start, least)) {
                continue;
            }
            let ball = foot.ball(&nearest);
            if ball.radius.is_finite() && ball.radius > 0.0 {
                balls.insert(
                    balls.partition_point(|other| other.radius < ball.radius),
                    ball,
                );
            }
            continue;
        }
        let Some(ball) = balls.pop_if(|ball| ball.radius >= least) else {
            break;
        };
        let is_apart = |other: &Ball| {
            (ball.centre - other.centre).norm() > APART * other.radius.max(ball.radius)
        };
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::measure::even_places;

    #[test]
    fn the_deepest_balls_are_those_that_all_of_them_would_give() {
        // Three lobes of different sizes.
        let lobe =
            |n: &Vector3<f64>, along: [f64; 3]| (6.0 * (n.dot(&Vector3::from(along)) - 1.0)).exp();
        let mesh = Mesh::radial(16, |n| {
            0.3 + lobe(n, [1.0, 0.0, 0.0])
                + 1.1 * lobe(n, [0.0, 0.96, 0.28])
                + 1.05 * lobe(n, [-0.6, 0.0, -0.8])
        });
        let places = even_places(&mesh, 300);
        let all = medial_balls(&mesh, &places);
        let tree = TriangleTree::new(&mesh);
        let nearest = |place: &Vector3<f64>, limit| tree.nearest(place, limit);
        let starts = deepest(feet(&places, tree.size()), nearest, |_| true);
        assert!(starts.len() > 1 && starts.is_sorted_by(|one, other| one.radius >= other.radius));
        let beside = |ball: &Ball, start: &Ball| {
            (ball.centre - start.centre).norm() <= APART * start.radius.max(ball.radius)
        };
        for ball in all {
            let deeper = starts.iter().filter(|start| start.radius >= ball.radius);
            let is_start = starts.contains(&ball);
            let is_shallow = ball.radius < SHALLOW * starts[0].radius;
            let is_known = deeper.clone().any(|start| beside(&ball, start));
            assert!(is_start || is_shallow || is_known || deeper.count() == STARTS);
        }
    }
}
