//! A tree of boxes, by which most pairs of triangles of two bodies are never looked at.

use nalgebra::Point3;

/// Boxes in one leaf, at most.
const LEAF: usize = 4;

/// A box along the axes.
#[derive(Debug, Clone, Copy)]
pub(super) struct Bounds {
    low: Point3<f64>,
    high: Point3<f64>,
}

impl Bounds {
    /// Round points, and so far beyond them.
    pub(super) fn new(points: impl IntoIterator<Item = Point3<f64>>, beyond: f64) -> Self {
        let none = Self {
            low: Point3::new(f64::INFINITY, f64::INFINITY, f64::INFINITY),
            high: Point3::new(f64::NEG_INFINITY, f64::NEG_INFINITY, f64::NEG_INFINITY),
        };
        let round = points.into_iter().fold(none, |round, point| Self {
            low: round.low.inf(&point),
            high: round.high.sup(&point),
        });
        Self {
            low: round.low.map(|x| x - beyond),
            high: round.high.map(|x| x + beyond),
        }
    }

    pub(super) fn meets(&self, other: &Self) -> bool {
        (0..3).all(|axis| self.low[axis] <= other.high[axis] && other.low[axis] <= self.high[axis])
    }

    pub(super) fn holds(&self, point: &Point3<f64>) -> bool {
        (0..3).all(|axis| (self.low[axis]..=self.high[axis]).contains(&point[axis]))
    }

    fn with(&self, other: &Self) -> Self {
        Self {
            low: self.low.inf(&other.low),
            high: self.high.sup(&other.high),
        }
    }

    /// Twice the middle.
    fn middle(&self, axis: usize) -> f64 {
        self.low[axis] + self.high[axis]
    }

    fn longest_axis(&self) -> usize {
        (self.high - self.low).imax()
    }

    fn size(&self) -> f64 {
        (self.high - self.low).norm()
    }
}

/// Boxes, in a tree.
pub(super) struct BoundsTree {
    boxes: Vec<Bounds>,
    order: Vec<u32>,
    nodes: Vec<Node>,
}

/// What lies in a span of the order; of a node that is no leaf, its two halves.
struct Node {
    bounds: Bounds,
    span: [usize; 2],
    halves: Option<[usize; 2]>,
}

impl BoundsTree {
    pub(super) fn new(boxes: Vec<Bounds>) -> Self {
        let mut tree = Self {
            order: (0..boxes.len() as u32).collect(),
            boxes,
            nodes: Vec::new(),
        };
        if !tree.boxes.is_empty() {
            tree.grow(0, tree.boxes.len());
        }
        tree
    }

    /// Adds the node of a span, and returns its place.
    fn grow(&mut self, from: usize, to: usize) -> usize {
        let boxes = &self.boxes;
        let span = &mut self.order[from..to];
        let first = boxes[span[0] as usize];
        let bounds = span
            .iter()
            .fold(first, |round, &i| round.with(&boxes[i as usize]));
        let own = self.nodes.len();
        if span.len() > LEAF {
            let axis = bounds.longest_axis();
            let half = span.len() / 2;
            span.select_nth_unstable_by(half, |&a, &b| {
                let [a_at, b_at] = [a, b].map(|i| boxes[i as usize].middle(axis));
                a_at.total_cmp(&b_at).then(a.cmp(&b))
            });
            self.nodes.push(Node {
                bounds,
                span: [from, to],
                halves: None,
            });
            let halves = [self.grow(from, from + half), self.grow(from + half, to)];
            self.nodes[own].halves = Some(halves);
        } else {
            self.nodes.push(Node {
                bounds,
                span: [from, to],
                halves: None,
            });
        }
        own
    }

    /// All pairs of boxes of two trees that meet, and how many boxes were compared.
    pub(super) fn pairs(&self, other: &Self) -> (Vec<[u32; 2]>, usize) {
        let (mut found, mut compared) = (Vec::new(), 0);
        let mut left = match self.nodes.is_empty() || other.nodes.is_empty() {
            true => Vec::new(),
            false => vec![[0, 0]],
        };
        while let Some([one, two]) = left.pop() {
            let (near, far) = (&self.nodes[one], &other.nodes[two]);
            compared += 1;
            if !near.bounds.meets(&far.bounds) {
                continue;
            }
            let is_larger = near.bounds.size() >= far.bounds.size();
            match (near.halves, far.halves) {
                (Some(halves), None) => left.extend(halves.map(|half| [half, two])),
                (Some(halves), Some(_)) if is_larger => {
                    left.extend(halves.map(|half| [half, two]));
                }
                (_, Some(halves)) => left.extend(halves.map(|half| [one, half])),
                (None, None) => {
                    for &i in &self.order[near.span[0]..near.span[1]] {
                        for &j in &other.order[far.span[0]..far.span[1]] {
                            compared += 1;
                            if self.boxes[i as usize].meets(&other.boxes[j as usize]) {
                                found.push([i, j]);
                            }
                        }
                    }
                }
            }
        }
        found.sort_unstable();
        (found, compared)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn boxes(most: usize) -> impl Strategy<Value = Vec<Bounds>> {
        let place = || prop::array::uniform3(-1.0..1.0_f64);
        let any = (place(), 0.01..0.3_f64)
            .prop_map(|(place, beyond)| Bounds::new([Point3::from(place)], beyond));
        prop::collection::vec(any, 0..most)
    }

    proptest! {
        #[test]
        fn the_pairs_are_those_of_all_boxes_against_all(some in boxes(60), others in boxes(60)) {
            let mut all = Vec::new();
            for (i, one) in (0..).zip(&some) {
                all.extend((0..).zip(&others).filter(|(_, other)| one.meets(other)).map(|(j, _)| [i, j]));
            }
            let (found, _) = BoundsTree::new(some).pairs(&BoundsTree::new(others));
            prop_assert_eq!(found, all);
        }
    }
}
