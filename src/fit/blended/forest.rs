//! The cheapest cover for a price per coefficient.
//!
//! Six or more cells that may each be cut in four, and those again, are a forest. If every cell has an
//! error at each degree and errors add up, the cover and the degrees with the least sum of errors plus
//! price times coefficients follow from the leaves upwards: a cell is left whole, at its best degree, or
//! cut where its quarters come cheaper (Breiman, Friedman, Olshen and Stone 1984, section 3.3, prune
//! trees so). No step is taken that a later one regrets, and one look ahead suffices: a cell's quarters
//! are only asked for where they might come cheaper.

use super::Target;
use super::local_fit::LocalFits;
use crate::sphere::{CubeCell, MAX_FACE_PARTS, coefficient_count};
use std::ops::RangeInclusive;

/// Steps in which the price is halved.
const STEPS_PER_OCTAVE: i32 = 16;

/// Prices below 2^-80 of the first are rounding, and above 2^80 of it nothing is cut.
const MOST_STEPS: i32 = 80 * STEPS_PER_OCTAVE;

/// Cells are looked into up to so many parts of a face whatever their error: a bump of a few degrees
/// lies between the nodes of larger ones.
const LEAST_EXPLORED: u16 = 4;

/// Cells, their quarters, and the errors of their own fits.
pub(super) struct Forest {
    nodes: Vec<Node>,
    roots: usize,
    degrees: RangeInclusive<usize>,
    finest: u16,
}

struct Node {
    cell: CubeCell,
    /// By degree.
    errors: Vec<f64>,
    /// The first of the four quarters, if they are known.
    quarters: Option<usize>,
}

/// What a cover must not exceed.
pub(super) struct Bounds {
    pub(super) cells: usize,
    pub(super) coefficients: usize,
}

/// A cover with degrees.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Plan {
    pub(super) cells: Vec<CubeCell>,
    pub(super) degrees: Vec<usize>,
    /// Sum of the errors of the cells' own fits.
    pub(super) error: f64,
    pub(super) coefficients: usize,
    /// Whether the error is as small as was asked.
    pub(super) is_enough: bool,
    /// Nodes of the cells.
    nodes: Vec<usize>,
}

/// The cheapest way to cover a node.
#[derive(Clone, Copy)]
struct Best {
    cost: f64,
    /// `None`: by its quarters.
    degree: Option<usize>,
}

impl Forest {
    /// The 6 `parts`^2 cells, each to be given one of the degrees, and cut again unless `is_fixed`.
    pub(super) fn new(
        target: &dyn Target,
        fits: &mut LocalFits,
        parts: u16,
        is_fixed: bool,
        degrees: RangeInclusive<usize>,
    ) -> Self {
        let cells = CubeCell::uniform(parts);
        let finest = if is_fixed { parts } else { MAX_FACE_PARTS };
        let mut forest = Self {
            nodes: Vec::new(),
            roots: cells.len(),
            degrees,
            finest,
        };
        forest.add(target, fits, &cells);
        forest
    }

    /// The degrees that cells may have.
    pub(super) fn degrees(&self) -> RangeInclusive<usize> {
        self.degrees.clone()
    }

    fn add(&mut self, target: &dyn Target, fits: &mut LocalFits, cells: &[CubeCell]) {
        let errors = fits.errors(target, cells);
        let nodes = cells.iter().zip(errors).map(|(&cell, errors)| Node {
            cell,
            errors,
            quarters: None,
        });
        self.nodes.extend(nodes);
    }

    /// The cheapest cover with an error of at most `goal`; if there is none within the bounds, that
    /// with the least error within them.
    ///
    /// Prices fall by steps of a sixteenth of an octave, so that cells that are alike but for rounding
    /// (all but never on both sides of such a step) are treated alike.
    pub(super) fn within(
        &mut self,
        target: &dyn Target,
        fits: &mut LocalFits,
        goal: f64,
        bounds: &Bounds,
    ) -> Plan {
        let first = *self.degrees.start();
        let roots = self.nodes[..self.roots].iter();
        let coarsest: f64 = roots.map(|node| node.errors[first]).sum();
        let unit = coarsest / (self.roots * coefficient_count(first)) as f64;
        let mut at = |step: i32| {
            let price = unit * (-f64::from(step) / f64::from(STEPS_PER_OCTAVE)).exp2();
            let mut plan = self.cheapest(target, fits, price);
            plan.is_enough = plan.error <= goal;
            let is_within =
                plan.cells.len() <= bounds.cells && plan.coefficients <= bounds.coefficients;
            (plan, is_within)
        };
        let (mut low, mut high) = (0, 0);
        let (mut coarse, mut fine) = (None, at(0));
        while !fine.1 && high > -MOST_STEPS {
            high -= STEPS_PER_OCTAVE;
            fine = at(high);
        }
        while !fine.0.is_enough && fine.1 && high < MOST_STEPS {
            low = high;
            high += STEPS_PER_OCTAVE;
            coarse = Some(std::mem::replace(&mut fine, at(high)).0);
        }
        while high - low > 1 {
            let middle = low.midpoint(high);
            let found = at(middle);
            if found.0.is_enough || !found.1 {
                (high, fine) = (middle, found);
            } else {
                (low, coarse) = (middle, Some(found.0));
            }
        }
        match (fine, coarse) {
            ((_, false), Some(coarse)) => coarse,
            ((fine, _), _) => fine,
        }
    }

    /// The cheapest cover for a price, with all quarters known that might make it cheaper.
    fn cheapest(&mut self, target: &dyn Target, fits: &mut LocalFits, price: f64) -> Plan {
        loop {
            let best = self.best(price);
            let plan = self.plan(&best);
            let least = 4.0 * price * coefficient_count(*self.degrees.start()) as f64;
            let open: Vec<usize> = plan
                .nodes
                .iter()
                .copied()
                .filter(|&at| {
                    let node = &self.nodes[at];
                    node.quarters.is_none()
                        && 2 * node.cell.parts <= self.finest
                        && (best[at].cost > least || node.cell.parts < LEAST_EXPLORED)
                })
                .collect();
            if open.is_empty() {
                return plan;
            }
            let first = self.nodes.len();
            let cells: Vec<CubeCell> = open
                .iter()
                .flat_map(|&at| self.nodes[at].cell.quarters())
                .collect();
            self.add(target, fits, &cells);
            for (number, &at) in open.iter().enumerate() {
                self.nodes[at].quarters = Some(first + 4 * number);
            }
            // What quarters see, the cell that they make may have missed.
            for at in (0..self.nodes.len()).rev() {
                if let Some(first) = self.nodes[at].quarters {
                    for d in self.degrees.clone() {
                        let sum: f64 = (0..4).map(|i| self.nodes[first + i].errors[d]).sum();
                        let own = &mut self.nodes[at].errors[d];
                        *own = own.max(sum);
                    }
                }
            }
        }
    }

    /// Quarters come after the cell that they make, so the best of them is known first.
    fn best(&self, price: f64) -> Vec<Best> {
        let unknown = Best {
            cost: f64::INFINITY,
            degree: None,
        };
        let mut best = vec![unknown; self.nodes.len()];
        for (at, node) in self.nodes.iter().enumerate().rev() {
            for degree in self.degrees.clone() {
                let cost = node.errors[degree] + price * coefficient_count(degree) as f64;
                if cost < best[at].cost {
                    best[at] = Best {
                        cost,
                        degree: Some(degree),
                    };
                }
            }
            if let Some(first) = node.quarters {
                let cost: f64 = best[first..first + 4]
                    .iter()
                    .map(|quarter| quarter.cost)
                    .sum();
                if cost < best[at].cost {
                    best[at] = Best { cost, degree: None };
                }
            }
        }
        best
    }

    fn plan(&self, best: &[Best]) -> Plan {
        let mut plan = Plan {
            cells: Vec::new(),
            degrees: Vec::new(),
            error: 0.0,
            coefficients: 0,
            is_enough: false,
            nodes: Vec::new(),
        };
        let mut open: Vec<usize> = (0..self.roots).rev().collect();
        while let Some(at) = open.pop() {
            let node = &self.nodes[at];
            match (best[at].degree, node.quarters) {
                (None, Some(first)) => open.extend((first..first + 4).rev()),
                (degree, _) => {
                    let degree = degree.unwrap_or(*self.degrees.start());
                    plan.cells.push(node.cell);
                    plan.degrees.push(degree);
                    plan.error += node.errors[degree];
                    plan.coefficients += coefficient_count(degree);
                    plan.nodes.push(at);
                }
            }
        }
        plan
    }
}
