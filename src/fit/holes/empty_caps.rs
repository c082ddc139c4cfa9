//! The largest gap of a cloud: how much of the sphere no point tells of.

use crate::fit::points::neighbours::Neighbours;
use crate::sphere::{compass, cube_grid};
use nalgebra::Vector3;
use std::f64::consts::PI;

/// Cells along an edge of the cube whose directions are tried first: 6 degrees apart.
const START: usize = 16;

/// Directions from which the centre of the gap is looked for.
const BEST: usize = 4;

/// The first step of the search for it, in radians.
const FIRST_STEP: f64 = 0.1;

/// Angle, in radians, to which the centre is found.
const LEAST_STEP: f64 = 1e-3;

/// Half-angle of the largest cap without any of these unit vectors, in radians; pi if there are none.
pub(in crate::fit) fn largest_gap(directions: &[Vector3<f64>]) -> f64 {
    largest_cap(directions).0
}

/// Half-angle and middle of the largest cap without any of these unit vectors.
pub(super) fn largest_cap(directions: &[Vector3<f64>]) -> (f64, Vector3<f64>) {
    let cap = Gaps::new(directions).largest(1).pop();
    cap.unwrap_or((0.0, Vector3::z()))
}

/// How far places all over the sphere are from the nearest of some unit vectors.
pub(super) struct Gaps<'a> {
    directions: &'a [Vector3<f64>],
    neighbours: Neighbours,
    /// Angles, the largest first, and the places.
    clearances: Vec<(f64, Vector3<f64>)>,
}

impl<'a> Gaps<'a> {
    pub(super) fn new(directions: &'a [Vector3<f64>]) -> Self {
        let mut gaps = Self {
            directions,
            neighbours: Neighbours::new(directions),
            clearances: Vec::new(),
        };
        let places = cube_grid(START).0.into_iter();
        gaps.clearances = places.map(|n| (gaps.clearance(&n), n)).collect();
        gaps.clearances.sort_by(|a, b| b.0.total_cmp(&a.0));
        gaps
    }

    /// The angle from a place to the nearest direction.
    fn clearance(&self, n: &Vector3<f64>) -> f64 {
        let nearest = self.neighbours.nearest(n, 1);
        let nearest = nearest.first().map(|&i| self.directions[i]);
        nearest.map_or(PI, |m| n.cross(&m).norm().atan2(n.dot(&m)))
    }

    /// Half-angle and middle of the largest cap without a direction, of the largest one elsewhere, and so on, so many at most.
    pub(super) fn largest(&self, most: usize) -> Vec<(f64, Vector3<f64>)> {
        let mut caps: Vec<(f64, Vector3<f64>)> = Vec::new();
        for _ in 0..most {
            let is_elsewhere = |(_, n): &(f64, Vector3<f64>)| {
                caps.iter()
                    .all(|(half_angle, middle)| n.angle(middle) > *half_angle)
            };
            let starts = self.clearances.iter().copied().filter(is_elsewhere);
            // Along a slit the search leads back to the cap that is known.
            let found = starts.take(BEST).map(|start| {
                let (n, largest) = compass(start.1, FIRST_STEP, LEAST_STEP, |n| self.clearance(n));
                Some((largest, n)).filter(is_elsewhere).unwrap_or(start)
            });
            match found.max_by(|a, b| a.0.total_cmp(&b.0)) {
                Some(cap) => caps.push(cap),
                None => break,
            }
        }
        caps
    }

    /// How much less of the sphere the largest gap is expected to take than that of random directions, at most 1.
    ///
    /// Of n random directions the share of those places round which a cap of the share s of the sphere is empty is exp(-n s). It is
    /// taken to be exp(-(n s / a)^k), with k and a by the half and by the quarter of places that lie farthest from all directions;
    /// of a lattice k is about 2.
    pub(super) fn evenness(&self) -> f64 {
        let n = self.directions.len() as f64;
        let share_at = |part: usize| {
            let clearance = self.clearances[self.clearances.len() / part].0;
            (0.5 * clearance).sin().powi(2)
        };
        let (half, quarter) = (2.0_f64.ln(), 4.0_f64.ln());
        let power = ((quarter / half).ln() / (share_at(4) / share_at(2)).ln()).max(1.0);
        let largest = n * share_at(4) * (logarithm(n) / quarter).powf(1.0 / power);
        (largest / logarithm(n)).min(1.0)
    }
}

/// Half-angle, in radians, of a cap of which random directions leave one empty with a few percent: with the share
/// (ln n + 5) / n of the sphere.
pub(in crate::fit) fn random_gap(points: usize) -> f64 {
    gap(points, 1.0)
}

/// The same of directions that are spread more evenly, and leave so much less of the sphere.
pub(super) fn gap(points: usize, less: f64) -> f64 {
    let n = (points as f64).max(1.0);
    let share = (less * logarithm(n) / n).min(1.0);
    (1.0 - 2.0 * share).acos()
}

fn logarithm(n: f64) -> f64 {
    n.ln() + 5.0
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shapes::Sampling;

    #[test]
    fn even_directions_leave_smaller_gaps_than_random_ones() {
        for points in [300, 3000] {
            let less =
                |sampling: Sampling| Gaps::new(&sampling.directions(points, 2).unwrap()).evenness();
            assert!(less(Sampling::Random) > 0.8, "{}", less(Sampling::Random));
            let even = Sampling::Fibonacci.directions(points, 0).unwrap();
            let expected = gap(points, Gaps::new(&even).evenness());
            let largest = largest_gap(&even);
            assert!(
                (1.05..1.7).contains(&(expected / largest)),
                "{expected} {largest}"
            );
        }
    }

    #[test]
    fn a_cap_that_is_cut_out_is_found() {
        let centre = Vector3::new(0.3, -0.5, 0.8).normalize();
        for degrees in [10.0_f64, 20.0, 40.0, 90.0] {
            let mut directions = Sampling::Fibonacci.directions(20_000, 0).unwrap();
            directions.retain(|n| n.dot(&centre) < degrees.to_radians().cos());
            let found = largest_gap(&directions).to_degrees();
            assert!(
                (0.0..1.0).contains(&(found - degrees)),
                "{degrees}: {found}"
            );
        }
    }

    #[test]
    fn caps_that_are_cut_out_at_both_ends_are_found() {
        let axis = Vector3::new(0.3, -0.5, 0.8).normalize();
        let mut directions = Sampling::Fibonacci.directions(20_000, 0).unwrap();
        let [at, opposite] = [20.0_f64, 15.0].map(|degrees| degrees.to_radians().cos());
        directions.retain(|n| n.dot(&axis) < at && n.dot(&axis) > -opposite);
        let caps = Gaps::new(&directions).largest(2);
        for ((half_angle, middle), (degrees, towards)) in
            caps.iter().zip([(20.0, axis), (15.0, -axis)])
        {
            assert!((half_angle.to_degrees() - degrees).abs() < 1.0);
            assert!(middle.angle(&towards) < 0.02);
        }
        assert_eq!(caps.len(), 2);
    }

    #[test]
    fn few_directions_leave_known_gaps() {
        assert_eq!(largest_gap(&[]), PI);
        assert!((largest_gap(&[Vector3::x()]) - PI).abs() < 1e-2);
        let octahedron: Vec<_> = [1.0, -1.0]
            .into_iter()
            .flat_map(|sign| (0..3).map(move |axis| Vector3::ith(axis, sign)))
            .collect();
        let expected = (1.0 / 3.0_f64.sqrt()).acos();
        assert!((largest_gap(&octahedron) - expected).abs() < 2e-3);
    }

    #[test]
    fn random_directions_rarely_leave_more() {
        for points in [20, 300, 6000] {
            let larger = (0..40)
                .filter(|&seed| {
                    let directions = Sampling::Random.directions(points, seed).unwrap();
                    largest_gap(&directions) > random_gap(points)
                })
                .count();
            assert!(larger <= 6, "{points}: {larger}");
        }
    }
}
