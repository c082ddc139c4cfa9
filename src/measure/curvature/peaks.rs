//! Where on a surface something that is made of its curvatures is largest.
//!
//! Nodes of a quadrature miss a peak by up to half their spacing: on the tip of an ellipsoid 5 : 1 : 1 that takes 3 % of the
//! curvature, on one of 20 : 1 : 1 a fifth. So the highest of them that are apart climb, along the principal directions, to
//! where no small step leads higher.

use crate::measure::Curvature;
use crate::measure::integrals::nodes::CurvedNode;
use crate::model::Surface;
use nalgebra::Vector3;

/// Nodes that climb, and how many spacings of nodes they are apart at least.
const STARTS: usize = 8;
const APART: f64 = 4.0;

/// Nodes among which starts are looked for at first, and how many times as many in each round after.
const LOOKED_AT: usize = 256;
const MORE: usize = 8;

/// A climb ends where all steps change the value by at most this share of it, or of [`LOW`] times the largest there is.
const TOLERANCE: f64 = 1e-5;
const LOW: f64 = 1e-4;

/// A climb is given up where a peak is known that is so many times as much higher as the largest of the changes by one step:
/// nodes are a few steps from their peaks.
const LEAPS: f64 = 4.0;

/// Factor by which steps along a principal direction shrink where neither of them leads higher, and by which they grow, to the
/// spacing at most, where one does or both change the value by less than this share of the tolerance.
const SHRINK: f64 = 0.25;
const GROW: f64 = 2.0;
const NARROW: f64 = 0.1;

/// Share of the spacing below which steps that still change the value tell that it comes to a cusp or has no bound: on tips
/// steps of a hundredth change it by less.
const LEAST: f64 = 1e-9;

/// Steps so many times as long tell which: no longer than a thousandth of the
/// spacing, nor so short that it matters how near the climb has come.
const WIDER: [f64; 3] = [1e3, 3e4, 9e5];

/// A climb that ends so near a plane between octants ends on it.
const NEXT: f64 = 1e-6;

/// Rounds of steps of one climb at most, and after how many it ends where these have led no higher than by the tolerance, with
/// steps of no less than such a share of the spacing: along a ridge that is bent sharply steps are short, on one that comes to
/// an edge far shorter.
const MAX_ROUNDS: usize = 120;
const SLOW: usize = 8;
const SHORT: f64 = 1e-5;

/// A place from which no small step leads higher.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Peak {
    /// Its direction; a zero without any node, and where none is needed.
    pub n: Vector3<f64>,
    pub place: Vector3<f64>,
    /// Infinite where it grows without bound.
    pub value: f64,
}

impl Peak {
    /// Of a value that is known to grow without bound.
    pub(super) const UNBOUNDED: Self = Self {
        n: Vector3::new(0.0, 0.0, 0.0),
        place: Vector3::new(0.0, 0.0, 0.0),
        value: f64::INFINITY,
    };
}

/// The highest peak of a value of the principal curvatures that is found from the highest of the nodes over a surface, to
/// 1e-5 of itself; at a cusp, to 1e-3 of the largest value. Surfaces that know which curvatures are [unbounded](Surface::unbounded_curvatures)
/// are asked for others only. Those [on planes](crate::measure::integrals::nodes::on_planes) may be peaks themselves.
pub(super) fn highest(
    surface: &(impl Surface + ?Sized),
    nodes: &[CurvedNode],
    on_planes: &[CurvedNode],
    value: impl Fn([f64; 2]) -> f64,
) -> Peak {
    let heights: Vec<f64> = nodes.iter().map(|node| value(node.principal)).collect();
    let sizes = heights.iter().map(|height| height.abs());
    let low = LOW * sizes.filter(|size| size.is_finite()).fold(0.0, f64::max);
    let of_node = |node: &CurvedNode| Peak {
        n: node.n,
        place: node.place,
        value: value(node.principal),
    };
    // What is higher than all nodes may have no bound there, unless that is known: climbs tell.
    let is_bounded = surface.unbounded_curvatures().is_some();
    let most = if is_bounded { f64::INFINITY } else { low / LOW };
    let on_planes = on_planes.iter().map(of_node);
    let on_planes = on_planes.filter(|peak| peak.value <= most);
    let best = on_planes.max_by(|one, other| one.value.total_cmp(&other.value));
    let mut peaks: Vec<Peak> = best.into_iter().collect();
    for start in starts(nodes, &heights) {
        let climb = Climb {
            surface,
            value: &value,
            low,
            is_bounded,
        };
        peaks.extend(climb.from(&nodes[start], &peaks));
    }
    let none = Peak {
        n: Vector3::zeros(),
        place: Vector3::zeros(),
        value: f64::NEG_INFINITY,
    };
    let higher = |best: Peak, peak: Peak| if peak.value > best.value { peak } else { best };
    peaks.into_iter().fold(none, higher)
}

/// The highest nodes that are apart, by their positions.
fn starts(nodes: &[CurvedNode], heights: &[f64]) -> Vec<usize> {
    let mut left: Vec<usize> = (0..nodes.len())
        .filter(|&at| heights[at].is_finite())
        .collect();
    let higher_first = |one: &usize, other: &usize| {
        let by_height = heights[*other].total_cmp(&heights[*one]);
        by_height.then(one.cmp(other))
    };
    let is_apart = |start: &usize, at: &usize| {
        let near = APART * APART * nodes[*start].area;
        (nodes[*at].place - nodes[*start].place).norm_squared() > near
    };
    let mut starts: Vec<usize> = Vec::with_capacity(STARTS);
    let mut looked_at = LOOKED_AT;
    while starts.len() < STARTS && !left.is_empty() {
        let rest = match looked_at < left.len() {
            true => {
                left.select_nth_unstable_by(looked_at, higher_first);
                left.split_off(looked_at)
            }
            false => Vec::new(),
        };
        left.sort_unstable_by(higher_first);
        for at in left {
            if starts.len() < STARTS && starts.iter().all(|start| is_apart(start, &at)) {
                starts.push(at);
            }
        }
        left = rest;
        looked_at *= MORE;
    }
    starts
}

struct Climb<'a, S: ?Sized, V> {
    surface: &'a S,
    value: &'a V,
    low: f64,
    /// Whether the value is known to be bounded.
    is_bounded: bool,
}

/// A place on the way.
#[derive(Clone, Copy)]
struct Stand {
    n: Vector3<f64>,
    place: Vector3<f64>,
    curvature: Curvature,
    value: f64,
}

impl<S: Surface + ?Sized, V: Fn([f64; 2]) -> f64> Climb<'_, S, V> {
    /// The peak above a node; none where it is not higher than those that are known.
    fn from(&self, start: &CurvedNode, known: &[Peak]) -> Option<Peak> {
        let spacing = start.area.sqrt();
        let mut steps = [spacing; 2];
        let mut here = self.stands(&[start.n])[0];
        let mut before = f64::NEG_INFINITY;
        for round in 0..MAX_ROUNDS {
            let around = self.stands(&WAYS.map(|way| here.beside(steps, way)));
            let tolerance = TOLERANCE * here.value.abs().max(self.low);
            let change = |stands: &[Stand]| {
                let changes = stands.iter().map(|stand| (stand.value - here.value).abs());
                changes.fold(0.0, f64::max)
            };
            let most = change(&around);
            if most <= tolerance {
                break;
            }
            if round % SLOW == 0 {
                let is_edge = steps.iter().any(|&step| step < SHORT * spacing);
                if here.value - before <= tolerance && !is_edge {
                    break;
                }
                before = here.value;
            }
            let is_hopeless = |peak: &Peak| {
                let is_passed = (here.place - peak.place).norm() < spacing;
                let promised = if is_passed { 0.0 } else { LEAPS * most };
                here.value + promised <= peak.value
            };
            if known.iter().any(is_hopeless) {
                return None;
            }
            let changes = [0, 1].map(|axis| change(&around[2 * axis..2 * axis + 2]));
            let vertex = here.vertex(&around);
            let within = self.stands(&[here.beside(steps, vertex)])[0];
            let (mut best, mut way) = (here, [0.0; 2]);
            for (stand, towards) in around.iter().zip(WAYS).chain([(&within, vertex)]) {
                if stand.value > best.value {
                    (best, way) = (*stand, towards);
                }
            }
            let is_wide = changes.map(|change| change > tolerance);
            let is_least = [0, 1].map(|axis| steps[axis] < LEAST * spacing);
            let wide = (0..2).filter(|&axis| is_wide[axis]);
            let (ended, open): (Vec<usize>, Vec<usize>) = wide.partition(|&axis| is_least[axis]);
            let limit = |&axis: &usize| self.limit(&here, axis, steps[axis], tolerance);
            let highest = ended.iter().map(limit).fold(best.value, f64::max);
            if highest == f64::INFINITY || (open.is_empty() && !ended.is_empty()) {
                best.value = highest;
                return Some(best.peak());
            }
            for axis in [0, 1] {
                if way[axis].abs() == 1.0 || changes[axis] <= NARROW * tolerance {
                    steps[axis] = (GROW * steps[axis]).min(spacing);
                } else if is_wide[axis] && !is_least[axis] {
                    steps[axis] *= SHRINK;
                }
            }
            here = best;
        }
        Some(here.peak())
    }

    /// Where the value leads that still grows by steps along a principal direction that are this short.
    ///
    /// Beside a ridge it goes by a power of the distance. So it grows by the same factor more, or less, each time that the
    /// distance shrinks by the same factor: the sum of all that is to come is that of a geometric series, if it has one.
    fn limit(&self, here: &Stand, axis: usize, step: f64, tolerance: f64) -> f64 {
        let ways = [WAYS[2 * axis], WAYS[2 * axis + 1]];
        let [near, farther, far] = WIDER.map(|times| {
            let stands = self.stands(&ways.map(|way| here.beside([times * step; 2], way)));
            0.5 * (stands[0].value + stands[1].value)
        });
        let (last, before) = (near - farther, farther - far);
        let is_cusp = last < before;
        // Beyond all nodes: what is not has its peak on a ridge across.
        let is_high = here.value > self.low / LOW;
        match last > tolerance {
            true if is_cusp => {
                let end = || near + last * last / (before - last);
                here.value.max(self.on_planes(here).unwrap_or_else(end))
            }
            true if is_high && !self.is_bounded => f64::INFINITY,
            _ => here.value,
        }
    }

    /// The value on the planes between octants that a place lies next to.
    fn on_planes(&self, here: &Stand) -> Option<f64> {
        let axes = self.surface.frame().axes;
        let local = axes.tr_mul(&here.n);
        let on_planes = local.map(|c| if c.abs() < NEXT { 0.0 } else { c });
        let value = self.stands(&[axes * on_planes])[0].value;
        (on_planes != local && value.is_finite()).then_some(value)
    }

    fn stands(&self, directions: &[Vector3<f64>]) -> Vec<Stand> {
        let jets = self.surface.jets(directions);
        let stand = |(n, jet): (&Vector3<f64>, _)| {
            let curvature = Curvature::new(n, &jet);
            Stand {
                n: *n,
                place: jet.place,
                curvature,
                value: (self.value)(curvature.principal),
            }
        };
        directions.iter().zip(jets).map(stand).collect()
    }
}

/// Steps along the two principal directions: opposite ones follow each other.
const WAYS: [[f64; 2]; 8] = [
    [1.0, 0.0],
    [-1.0, 0.0],
    [0.0, 1.0],
    [0.0, -1.0],
    [1.0, 1.0],
    [-1.0, -1.0],
    [1.0, -1.0],
    [-1.0, 1.0],
];

impl Stand {
    fn peak(&self) -> Peak {
        Peak {
            n: self.n,
            place: self.place,
            value: self.value,
        }
    }

    /// The direction of the place that is so many steps away along the principal directions.
    fn beside(&self, steps: [f64; 2], way: [f64; 2]) -> Vector3<f64> {
        let [first, second] = self.curvature.directions;
        let step = first * (steps[0] * way[0]) + second * (steps[1] * way[1]);
        (self.n + self.curvature.turn(&step)).normalize()
    }

    /// Where the parabolas through the values one step away along each principal direction are highest, in steps.
    fn vertex(&self, around: &[Stand]) -> [f64; 2] {
        [0, 1].map(|at| {
            let [ahead, behind] = [&around[2 * at], &around[2 * at + 1]].map(|stand| stand.value);
            let slope = 0.5 * (ahead - behind);
            let bend = 2.0 * self.value - ahead - behind;
            match bend > slope.abs() {
                true => slope / bend,
                false => slope.signum(),
            }
        })
    }
}

#[cfg(test)]
mod tests;
