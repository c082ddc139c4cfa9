//! Nodes all over a surface, for means over it.

use super::rings::ring_nodes;
use crate::model::{Node, Parts, Surface};
use crate::sphere::GaussLegendre;

/// What is integrated.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Integrand {
    /// Places, their first derivatives, and what is made of them.
    Slopes,
    /// Second derivatives. They change faster where cells are blended: of the maize kernel the total
    /// curvature is off by 1e-2 on the pieces that do for the radius, by 1e-4 on quarters of them.
    Curvature,
}

impl Integrand {
    /// How often more than for slopes a piece is cut in four.
    fn cuts(self) -> usize {
        match self {
            Self::Slopes => 0,
            Self::Curvature => 1,
        }
    }

    /// Rings of nodes for a surface that is analytic on the whole sphere.
    fn rings(self, degree: usize) -> usize {
        match self {
            Self::Slopes => 40 + 3 * degree / 2,
            Self::Curvature => 40 + 2 * degree,
        }
    }
}

/// Nodes over the tiling of a surface.
pub(super) fn nodes(surface: &(impl Surface + ?Sized), integrand: Integrand) -> Vec<Node> {
    match surface.tiling().parts {
        Parts::Sphere { degree } => ring_nodes(integrand.rings(degree)).flatten().collect(),
        Parts::Pieces {
            mut pieces,
            orders,
            cuts,
        } => {
            for _ in 0..cuts + integrand.cuts() {
                pieces = pieces.iter().flat_map(|piece| piece.quarters()).collect();
            }
            let rule = GaussLegendre::new(orders[0]);
            pieces.iter().flat_map(|piece| piece.nodes(&rule)).collect()
        }
    }
}
