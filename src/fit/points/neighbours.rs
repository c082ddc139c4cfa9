//! The nearest points of each point of a cloud, by direction or by place.

use kiddo::{ImmutableKdTree, SquaredEuclidean};
use nalgebra::Vector3;
use std::num::NonZero;

/// The directions, or the places, of a cloud, ready to be asked for the nearest ones.
pub(crate) struct Neighbours {
    tree: Option<ImmutableKdTree<f64, 3>>,
}

impl Neighbours {
    /// Sorts vectors.
    pub(crate) fn new(directions: &[Vector3<f64>]) -> Self {
        let points: Vec<[f64; 3]> = directions.iter().map(|&n| n.into()).collect();
        Self {
            // An empty tree is refused, and has no neighbours.
            tree: ImmutableKdTree::new_from_slice(&points)
                .ok()
                .filter(|_| !points.is_empty()),
        }
    }

    /// Positions of the `count` vectors nearest to `n`, nearest first.
    pub(crate) fn nearest(&self, n: &Vector3<f64>, count: usize) -> Vec<usize> {
        let (Some(tree), Some(count)) = (&self.tree, NonZero::new(count)) else {
            return Vec::new();
        };
        let query: [f64; 3] = (*n).into();
        let mut found: Vec<(f64, usize)> = tree
            .query(&query)
            .nearest_n::<SquaredEuclidean<f64>>(count)
            .execute()
            .into_iter()
            .map(|hit| (hit.distance, hit.item as usize))
            .collect();
        // Ties in distance are broken by the points' order, which is that of their values.
        found.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        found.into_iter().map(|(_, item)| item).collect()
    }
}
