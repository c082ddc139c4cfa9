//! Nodes all over a surface, for means over it.

use super::rings::ring_nodes;
use crate::model::{Node, Parts, Surface};
use crate::sphere::GaussLegendre;

/// How often more than for places a piece is cut in four: second derivatives change faster where cells are blended. Of the maize
/// kernel the total curvature is off by 1e-2 on the pieces that do for the radius, by 1e-4 on quarters of them.
const CUTS: usize = 1;

/// Rings of nodes for a surface that is analytic on the whole sphere.
fn rings(degree: usize) -> usize {
    40 + 2 * degree
}

/// Nodes over the tiling of a surface, for what is made of second derivatives.
pub(super) fn nodes(surface: &(impl Surface + ?Sized)) -> Vec<Node> {
    match surface.tiling().parts {
        Parts::Sphere { degree } => ring_nodes(rings(degree)).flatten().collect(),
        Parts::Pieces {
            mut pieces,
            orders,
            cuts,
        } => {
            for _ in 0..cuts + CUTS {
                pieces = pieces.iter().flat_map(|piece| piece.quarters()).collect();
            }
            let rule = GaussLegendre::new(orders[0]);
            pieces.iter().flat_map(|piece| piece.nodes(&rule)).collect()
        }
    }
}
