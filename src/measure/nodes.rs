//! Gauss nodes all over a surface: unit vectors and their weights in solid angle.

use super::grain::{BLENDED_ORDERS, segment_parts};
use super::integrals::{ORDERS, Piece, octants};
use super::rings::ring_nodes;
use crate::model::{Grain, Surface};
use crate::sphere::GaussLegendre;
use nalgebra::Vector3;

/// What is integrated.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Integrand {
    /// The radius, its gradient, and what is made of them.
    Radius,
    /// Its second derivatives. They change faster where cells are blended: of the maize kernel the total
    /// curvature is off by 1e-2 on the pieces that do for the radius, by 1e-4 on quarters of them.
    Curvature,
}

impl Integrand {
    /// How often more than for the radius a piece is cut in four.
    fn cuts(self) -> usize {
        match self {
            Self::Radius => 0,
            Self::Curvature => 1,
        }
    }

    /// Rings of nodes for an expansion of the whole sphere.
    fn rings(self, degree: usize) -> usize {
        match self {
            Self::Radius => 40 + 3 * degree / 2,
            Self::Curvature => 40 + 2 * degree,
        }
    }
}

/// Nodes for a grain, in the scan's frame: on the pieces in which its surface is smooth, those of the
/// stretched space.
pub(super) fn grain_nodes(grain: &Grain, integrand: Integrand) -> Vec<(Vector3<f64>, f64)> {
    let axes = grain.frame().axes;
    let cuts = integrand.cuts();
    let local = match grain.surface() {
        Surface::Blended(surface) => nodes(surface.cover().zones(), cuts, BLENDED_ORDERS[0]),
        Surface::Segmented(surface) => nodes(segment_parts(surface), 1 + cuts, ORDERS[0]),
        Surface::Mirrored(_) => octant_nodes(integrand),
        Surface::Whole(surface) => ring_nodes(integrand.rings(surface.degree())),
    };
    let stretch = grain.stretch();
    let plain = local.into_iter().map(|node| stretch.node(node));
    let turned = plain.map(|(n, weight)| (axes * n, weight));
    turned.collect()
}

/// Nodes for a surface that is smooth within the octants.
pub(super) fn octant_nodes(integrand: Integrand) -> Vec<(Vector3<f64>, f64)> {
    nodes(octants(), 1 + integrand.cuts(), ORDERS[0])
}

/// Nodes of a product of Gauss rules on pieces that are cut so often in four.
fn nodes<P: Piece>(mut pieces: Vec<P>, cuts: usize, order: usize) -> Vec<(Vector3<f64>, f64)> {
    for _ in 0..cuts {
        pieces = pieces.iter().flat_map(Piece::quarters).collect();
    }
    let rule = GaussLegendre::new(order);
    pieces.iter().flat_map(|piece| piece.nodes(&rule)).collect()
}
