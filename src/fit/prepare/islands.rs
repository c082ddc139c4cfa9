//! Groups of few points that stand apart together: their neighbours are of their own kind, and do not tell.
//!
//! A tip of a grain stands out as far, but its points lead down to it. An island has nothing between it and the surface: it is much
//! farther from it than the surface's own points are from each other.

use crate::spread::upper_median;
use nalgebra::Vector3;

/// Points of the largest island.
pub(super) const LARGEST: usize = 8;

/// An island is farther from the points round it than so many times what is typical of these among each other.
const FARTHER: f64 = 4.0;

/// The least step in radius to an island over the usual one: to the tip of a spike one leads from the points below it.
const ALONE: f64 = 0.5;

/// Points as seen from a centre, with the neighbours of each in a triangulation of their directions.
pub(super) struct Seen<'a> {
    pub(super) rays: &'a [Vector3<f64>],
    pub(super) radii: &'a [f64],
    pub(super) neighbours: &'a [Vec<usize>],
}

impl Seen<'_> {
    /// The points of all islands; between neighbours of one surface radii differ by less than a limit, which grows with the angle
    /// between them beyond `near`.
    pub(super) fn islands(&self, limit: f64, near: f64) -> Vec<usize> {
        let jumps = |from: usize, to: usize| {
            let [a, b] = [from, to].map(|at| self.radii[at]);
            let least = limit * a.min(b);
            let step = (a - b).abs();
            step > least && step > least * self.rays[from].angle(&self.rays[to]) / near
        };
        let mut found = vec![false; self.radii.len()];
        for own in 0..found.len() {
            let is_beside_step = || self.neighbours[own].iter().any(|&to| jumps(own, to));
            if found[own] || !is_beside_step() {
                continue;
            }
            let island = self.hanging_together(own, jumps);
            if island.len() <= LARGEST && self.is_far(&island, jumps) {
                island.into_iter().for_each(|at| found[at] = true);
            }
        }
        (0..found.len()).filter(|&at| found[at]).collect()
    }

    /// What can be reached without a jump, as far as it is no more than an island and one.
    fn hanging_together(&self, own: usize, jumps: impl Fn(usize, usize) -> bool) -> Vec<usize> {
        let (mut members, mut at) = (vec![own], 0);
        while at < members.len() && members.len() <= LARGEST {
            let from = members[at];
            for &to in &self.neighbours[from] {
                if !members.contains(&to) && !jumps(from, to) {
                    members.push(to);
                }
            }
            at += 1;
        }
        members
    }

    /// Whether nothing leads from what lies round an island to it, neither in space nor in radius.
    fn is_far(&self, island: &[usize], jumps: impl Fn(usize, usize) -> bool) -> bool {
        let around = island.iter().flat_map(|&from| {
            let out = self.neighbours[from].iter().map(move |&to| (from, to));
            out.filter(|(_, to)| !island.contains(to))
        });
        let (mut nearest, mut spacings) = (f64::INFINITY, Vec::new());
        let (mut step, mut steps) = (f64::INFINITY, Vec::new());
        for (from, beside) in around {
            nearest = nearest.min(self.distance(from, beside));
            let up = (self.radii[from] - self.radii[beside]).abs();
            step = step.min(up);
            steps.push(up);
            let others = self.neighbours[beside].iter().copied();
            let on_surface = others.filter(|&to| !island.contains(&to) && !jumps(beside, to));
            spacings.extend(on_surface.map(|to| self.distance(beside, to)));
        }
        let is_on_nothing = upper_median(&mut steps).is_some_and(|usual| step > ALONE * usual);
        is_on_nothing
            && upper_median(&mut spacings).is_some_and(|typical| nearest > FARTHER * typical)
    }

    fn distance(&self, from: usize, to: usize) -> f64 {
        (self.rays[from] - self.rays[to]).norm()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fit::points::neighbours::Neighbours;
    use crate::shapes::Sampling;
    use crate::sphere::triangulate_directions;

    fn islands(directions: &[Vector3<f64>], radii: &[f64]) -> Vec<usize> {
        let mut neighbours = vec![Vec::new(); radii.len()];
        for [a, b, c] in triangulate_directions(directions).unwrap() {
            for (from, to) in [(a, b), (b, c), (c, a)] {
                neighbours[from as usize].push(to as usize);
            }
        }
        let rays: Vec<_> = directions.iter().zip(radii).map(|(n, r)| n * *r).collect();
        let seen = Seen {
            rays: &rays,
            radii,
            neighbours: &neighbours,
        };
        seen.islands(0.1, 0.15)
    }

    #[test]
    fn groups_of_few_points_are_islands_and_larger_ones_are_none() {
        let directions = Sampling::Fibonacci.directions(3000, 0).unwrap();
        let near = |count: usize| {
            Neighbours::new(&directions).nearest(&Vector3::new(0.6, 0.0, 0.8), count)
        };
        for out in [0.6, 1.4] {
            for count in [1, 2, 5, LARGEST, LARGEST + 1, 40] {
                let mut radii: Vec<f64> = directions.iter().map(|n| 1.0 + 0.1 * n.x).collect();
                let mut group = near(count);
                for &at in &group {
                    radii[at] *= out;
                }
                group.sort_unstable();
                group.truncate(if count > LARGEST { 0 } else { count });
                assert_eq!(islands(&directions, &radii), group, "{count} {out}");
            }
        }
    }

    /// Radii of neighbours differ by up to a third along a spike, and at the tip of a needle of few points.
    #[test]
    fn tips_that_points_lead_to_are_no_islands() {
        let directions = Sampling::Fibonacci.directions(3000, 0).unwrap();
        let spike = |n: &Vector3<f64>| 1.0 + 2.0 * (-(n.angle(&Vector3::z()) / 0.2).powi(2)).exp();
        let radii: Vec<f64> = directions.iter().map(spike).collect();
        assert_eq!(islands(&directions, &radii), [0_usize; 0]);
        let neighbours = Neighbours::new(&directions);
        let mut radii = vec![1.0; directions.len()];
        for (&at, out) in neighbours
            .nearest(&directions[700], 2)
            .iter()
            .zip([2.4, 2.0])
        {
            radii[at] = out;
        }
        assert_eq!(islands(&directions, &radii), [0_usize; 0]);
        let places = Sampling::Fibonacci.directions(200, 0).unwrap();
        let needle = places
            .iter()
            .map(|n| n.component_mul(&Vector3::new(1.0, 1.0, 8.0)));
        let (directions, radii): (Vec<_>, Vec<f64>) =
            needle.map(|ray| (ray.normalize(), ray.norm())).unzip();
        assert_eq!(islands(&directions, &radii), [0_usize; 0]);
    }
}
