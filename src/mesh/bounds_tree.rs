//! A tree of boxes: which of them meet, and which are near a place, without a look at most of them.

use super::Mesh;
use nalgebra::{Point3, Vector3};
use std::ops::Range;

/// Boxes in one leaf, at most.
const LEAF: usize = 4;

/// Boxes below a node beyond which threads share the work on it.
const SHARED: usize = 4096;

/// A box along the axes.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Bounds {
    low: Point3<f64>,
    high: Point3<f64>,
}

impl Bounds {
    /// Round points, and so far beyond them.
    pub(crate) fn new(points: impl IntoIterator<Item = Point3<f64>>, beyond: f64) -> Self {
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

    pub(crate) fn meets(&self, other: &Self) -> bool {
        (0..3).all(|axis| self.low[axis] <= other.high[axis] && other.low[axis] <= self.high[axis])
    }

    pub(crate) fn holds(&self, point: &Point3<f64>) -> bool {
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

    /// Length of the diagonal.
    pub(crate) fn size(&self) -> f64 {
        (self.high - self.low).norm()
    }

    /// The lowest corner and the highest.
    pub(crate) fn corners(&self) -> [Vector3<f64>; 2] {
        [self.low, self.high].map(|corner| corner.coords)
    }

    fn squared_distance(&self, place: &Point3<f64>) -> f64 {
        let outside = (self.low - place).sup(&(place - self.high));
        outside.sup(&Vector3::zeros()).norm_squared()
    }
}

/// Boxes, in a tree.
pub(crate) struct BoundsTree {
    boxes: Vec<Bounds>,
    order: Vec<u32>,
    /// Depth first: the first half of a node follows it.
    nodes: Vec<Node>,
}

/// What lies in a span of the order; of a node that is no leaf, where its second half is.
struct Node {
    bounds: Bounds,
    span: [usize; 2],
    second: Option<usize>,
}

impl BoundsTree {
    pub(crate) fn new(boxes: Vec<Bounds>) -> Self {
        let mut tree = Self {
            order: (0..boxes.len() as u32).collect(),
            boxes,
            nodes: Vec::new(),
        };
        if !tree.boxes.is_empty() {
            tree.grow(0, tree.boxes.len(), &mut Vec::new());
        }
        tree
    }

    /// Of the boxes of a mesh's triangles, all of which name vertices that exist.
    pub(crate) fn of_triangles(mesh: &Mesh) -> Self {
        let corners = |t: &[u32; 3]| t.map(|corner| mesh.vertices[corner as usize]);
        let boxes = mesh.triangles.iter().map(|t| Bounds::new(corners(t), 0.0));
        Self::new(boxes.collect())
    }

    /// Adds the node of a span; `middles` is used anew by each.
    fn grow(&mut self, from: usize, to: usize, middles: &mut Vec<(f64, u32)>) {
        let boxes = &self.boxes;
        let span = &mut self.order[from..to];
        let first = boxes[span[0] as usize];
        let bounds = span
            .iter()
            .fold(first, |round, &i| round.with(&boxes[i as usize]));
        let half = (span.len() > LEAF).then(|| {
            let axis = (bounds.high - bounds.low).imax();
            let half = span.len() / 2;
            middles.clear();
            middles.extend(span.iter().map(|&i| (boxes[i as usize].middle(axis), i)));
            middles.select_nth_unstable_by(half, |(a_at, a), (b_at, b)| {
                a_at.total_cmp(b_at).then_with(|| a.cmp(b))
            });
            for (place, (_, i)) in span.iter_mut().zip(middles.iter()) {
                *place = *i;
            }
            from + half
        });
        let own = self.nodes.len();
        self.nodes.push(Node {
            bounds,
            span: [from, to],
            second: None,
        });
        if let Some(half) = half {
            self.grow(from, half, middles);
            self.nodes[own].second = Some(self.nodes.len());
            self.grow(half, to, middles);
        }
    }

    /// Round all boxes; `None` if there are none.
    pub(crate) fn bounds(&self) -> Option<&Bounds> {
        self.nodes.first().map(|root| &root.bounds)
    }

    /// The numbers of the boxes, in the order of the leaves.
    pub(crate) fn order(&self) -> &[u32] {
        &self.order
    }

    /// Looks at the boxes that are not farther from a place than the root of `limit`, leaf by leaf, near ones first.
    /// `look` is given their places in the order, and returns the squared distance up to which to look from then on.
    pub(crate) fn near(
        &self,
        place: &Point3<f64>,
        mut limit: f64,
        mut look: impl FnMut(Range<usize>) -> f64,
    ) {
        let mut open: Vec<(f64, usize)> = Vec::with_capacity(64);
        let distance = |node: usize| (self.nodes[node].bounds.squared_distance(place), node);
        open.extend(self.nodes.first().map(|_| distance(0)));
        while let Some((squared, index)) = open.pop() {
            let node = &self.nodes[index];
            match node.second {
                _ if squared > limit => {}
                None => limit = look(node.span[0]..node.span[1]),
                Some(second) => {
                    let mut halves = [index + 1, second].map(distance);
                    if halves[0].0 < halves[1].0 {
                        halves.swap(0, 1);
                    }
                    open.extend(halves);
                }
            }
        }
    }

    /// All pairs of boxes of two trees that meet, and how many boxes were compared.
    pub(crate) fn pairs(&self, other: &Self) -> (Vec<[u32; 2]>, usize) {
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
            match (near.second, far.second) {
                (Some(second), None) => left.extend([one + 1, second].map(|half| [half, two])),
                (Some(second), Some(_)) if is_larger => {
                    left.extend([one + 1, second].map(|half| [half, two]));
                }
                (_, Some(second)) => left.extend([two + 1, second].map(|half| [one, half])),
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

    /// The pairs of boxes of this tree that meet and are wanted, each once, the lower number first, in order.
    pub(crate) fn own_pairs(&self, is_wanted: impl Fn([u32; 2]) -> bool + Sync) -> Vec<[u32; 2]> {
        let mut found = match self.nodes.is_empty() {
            true => Vec::new(),
            false => self.pairs_within(0, &is_wanted),
        };
        found.sort_unstable();
        found
    }

    fn pairs_within(
        &self,
        node: usize,
        is_wanted: &(impl Fn([u32; 2]) -> bool + Sync),
    ) -> Vec<[u32; 2]> {
        let [from, to] = self.nodes[node].span;
        let Some(second) = self.nodes[node].second else {
            let mut found = Vec::new();
            for at in from..to {
                self.wanted(self.order[at], at + 1..to, is_wanted, &mut found);
            }
            return found;
        };
        let within = |half| move || self.pairs_within(half, is_wanted);
        let (mut found, others) = match to - from > SHARED {
            true => rayon::join(within(node + 1), within(second)),
            false => (within(node + 1)(), within(second)()),
        };
        found.extend(others);
        self.pairs_between(node + 1, second, is_wanted, &mut found);
        found
    }

    fn pairs_between(
        &self,
        one: usize,
        other: usize,
        is_wanted: &impl Fn([u32; 2]) -> bool,
        found: &mut Vec<[u32; 2]>,
    ) {
        let (near, far) = (&self.nodes[one], &self.nodes[other]);
        if !near.bounds.meets(&far.bounds) {
            return;
        }
        let is_longer = near.span[1] - near.span[0] >= far.span[1] - far.span[0];
        match (near.second, far.second) {
            (Some(second), far) if is_longer || far.is_none() => {
                self.pairs_between(one + 1, other, is_wanted, found);
                self.pairs_between(second, other, is_wanted, found);
            }
            (_, Some(second)) => {
                self.pairs_between(one, other + 1, is_wanted, found);
                self.pairs_between(one, second, is_wanted, found);
            }
            (_, None) => {
                for &number in &self.order[near.span[0]..near.span[1]] {
                    if self.boxes[number as usize].meets(&far.bounds) {
                        self.wanted(number, far.span[0]..far.span[1], is_wanted, found);
                    }
                }
            }
        }
    }

    /// The wanted pairs of one box with those in a span of the order.
    fn wanted(
        &self,
        one: u32,
        span: Range<usize>,
        is_wanted: &impl Fn([u32; 2]) -> bool,
        found: &mut Vec<[u32; 2]>,
    ) {
        let bounds = &self.boxes[one as usize];
        for &other in &self.order[span] {
            let pair = [one.min(other), one.max(other)];
            if bounds.meets(&self.boxes[other as usize]) && is_wanted(pair) {
                found.push(pair);
            }
        }
    }

    /// All boxes that meet a box.
    pub(crate) fn meeting(&self, bounds: &Bounds) -> impl Iterator<Item = u32> {
        let mut open: Vec<usize> = (0..self.nodes.len().min(1)).collect();
        let leaves = std::iter::from_fn(move || {
            while let Some(index) = open.pop() {
                let node = &self.nodes[index];
                match node.second {
                    _ if !node.bounds.meets(bounds) => {}
                    None => return Some(&self.order[node.span[0]..node.span[1]]),
                    Some(second) => open.extend([second, index + 1]),
                }
            }
            None
        });
        let numbers = leaves.flatten().copied();
        numbers.filter(|&i| self.boxes[i as usize].meets(bounds))
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
            let (one, two) = (BoundsTree::new(some.clone()), BoundsTree::new(others));
            let (found, _) = one.pairs(&two);
            let mut by_box: Vec<[u32; 2]> = Vec::new();
            for (i, bounds) in (0..).zip(&some) {
                by_box.extend(two.meeting(bounds).map(|j| [i, j]));
            }
            by_box.sort_unstable();
            prop_assert_eq!(by_box, &all[..]);
            prop_assert_eq!(found, all);
        }

        #[test]
        fn own_pairs_are_those_of_each_box_with_all_after_it(boxes in boxes(60)) {
            let mut all = Vec::new();
            for (i, one) in (0..).zip(&boxes) {
                let after = (i + 1..).zip(&boxes[i as usize + 1..]);
                all.extend(after.filter(|(_, other)| one.meets(other)).map(|(j, _)| [i, j]));
            }
            let tree = BoundsTree::new(boxes);
            prop_assert_eq!(&tree.own_pairs(|_| true), &all);
            all.retain(|[i, j]| (i + j) % 3 == 0);
            prop_assert_eq!(tree.own_pairs(|[i, j]| (i + j) % 3 == 0), all);
        }
    }
}
