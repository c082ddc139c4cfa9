//! Nodes all over a surface, with its curvatures there, for means over it.
//!
//! The total curvature, ∫ K dS, lies on tips and rims. So pieces of the tiling are cut in four where the four tell another
//! total than the piece does: with nodes that are laid evenly in the stretched space of a fit it is off by 3e-3 of an ellipsoid
//! 10 : 1 : 0.8, and by 2e-2 of a disc 20 : 20 : 1.

use super::rings::ring_nodes;
use crate::measure::Curvature;
use crate::model::{Node, Parts, Piece, Surface};
use crate::sphere::GaussLegendre;
use nalgebra::Vector3;
use rayon::prelude::*;
use std::f64::consts::{FRAC_PI_2, PI};

/// Nodes at which the surface is evaluated together.
const CHUNK: usize = 1024;

/// How far the total curvature of four quarters may be from that of their piece, as a share of 4 pi: the error of the quarters is a
/// small part of it. Of many pieces, whose errors have nothing to do with each other, ten times as much does where all of 4 pi is
/// found.
const SETTLED: f64 = 3e-5;
const OF_MANY: f64 = 10.0 * SETTLED;
const MANY: usize = 64;

/// Gauss nodes per side of an octant that is cut so often, where rings do not do.
const OCTANT_ORDER: usize = 12;
const OCTANT_CUTS: usize = 1;

/// Share of the 4 pi of a closed surface that may be missing on rings of nodes, and on pieces.
const MISSED_ON_RINGS: f64 = 5e-5;
const MISSED_ON_PIECES: f64 = 2e-4;

/// Nodes of pieces that are cut a second time and more: on creases the total never settles.
const MAX_NODES: usize = 60_000;

/// Places on a quarter of a plane between octants.
const PER_QUARTER: usize = 128;

/// A node of a quadrature over a surface.
#[derive(Debug, Clone, Copy)]
pub(in crate::measure) struct CurvedNode {
    pub n: Vector3<f64>,
    pub place: Vector3<f64>,
    /// Principal curvatures, the larger first.
    pub principal: [f64; 2],
    /// The area it stands for.
    pub area: f64,
}

/// Nodes over the tiling of a surface, for what is made of second derivatives.
pub(in crate::measure) fn curved_nodes(surface: &(impl Surface + ?Sized)) -> Vec<CurvedNode> {
    match surface.tiling().parts {
        Parts::Sphere { degree } => {
            let nodes: Vec<Node> = ring_nodes(rings(degree)).flatten().collect();
            let found = curved(surface, &nodes);
            match missed(&found) <= MISSED_ON_RINGS {
                true => found,
                false => on_pieces(surface, &Piece::octants(), OCTANT_CUTS, OCTANT_ORDER),
            }
        }
        Parts::Pieces {
            pieces,
            orders,
            cuts,
        } => on_pieces(surface, &pieces, cuts, orders[0]),
    }
}

/// Places on the planes between the octants of a surface that is tiled by angles, where curvatures of some superquadrics end in
/// cusps: they stand for no area.
pub(in crate::measure) fn on_planes(surface: &(impl Surface + ?Sized)) -> Vec<CurvedNode> {
    let is_of_angles = match surface.tiling().parts {
        Parts::Sphere { .. } => false,
        Parts::Pieces { pieces, .. } => matches!(pieces.first(), Some(Piece::Angles(_))),
    };
    if !is_of_angles {
        return Vec::new();
    }
    let on_circle = |at: usize| {
        let (sin, cos) = (FRAC_PI_2 * at as f64 / PER_QUARTER as f64).sin_cos();
        // At the tips to the last bit.
        let [along, across] = [cos, sin].map(|c| if c.abs() < f64::EPSILON { 0.0 } else { c });
        [0, 1, 2].map(|axis| {
            let mut n = Vector3::zeros();
            (n[(axis + 1) % 3], n[(axis + 2) % 3]) = (along, across);
            (n, 0.0)
        })
    };
    let nodes: Vec<Node> = (0..4 * PER_QUARTER).flat_map(on_circle).collect();
    curved(surface, &nodes)
}

/// Rings of nodes for a surface that is analytic on the whole sphere.
fn rings(degree: usize) -> usize {
    40 + 2 * degree
}

/// The nodes of a Gauss rule on pieces that are cut in four so often, and from there on as often as it takes.
fn on_pieces(
    surface: &(impl Surface + ?Sized),
    pieces: &[Piece],
    cuts: usize,
    order: usize,
) -> Vec<CurvedNode> {
    let until = |settled: f64| cut(surface, pieces.to_vec(), cuts, order, settled * 4.0 * PI);
    let of_many = (pieces.len() >= MANY).then(|| until(OF_MANY));
    of_many
        .filter(|found| missed(found) <= MISSED_ON_PIECES)
        .unwrap_or_else(|| until(SETTLED))
}

/// The same, until four quarters tell the total curvature of their piece but for so much.
fn cut(
    surface: &(impl Surface + ?Sized),
    mut pieces: Vec<Piece>,
    cuts: usize,
    order: usize,
    settled_at: f64,
) -> Vec<CurvedNode> {
    let rule = GaussLegendre::new(order);
    let per_piece = order * order;
    let quarters = |pieces: &[Piece]| pieces.iter().flat_map(Piece::quarters).collect();
    let on = |pieces: &[Piece]| {
        let nodes: Vec<Node> = pieces.iter().flat_map(|piece| piece.nodes(&rule)).collect();
        curved(surface, &nodes)
    };
    for _ in 0..cuts {
        pieces = quarters(&pieces);
    }
    let mut totals: Vec<f64> = on(&pieces).chunks(per_piece).map(total).collect();
    let (mut settled, mut spent) = (Vec::new(), 0);
    while !pieces.is_empty() {
        let finer: Vec<Piece> = quarters(&pieces);
        let found = on(&finer);
        let parts: Vec<f64> = found.chunks(per_piece).map(total).collect();
        let (mut next, mut next_totals) = (Vec::new(), Vec::new());
        let families = totals.iter().zip(parts.chunks(4)).zip(finer.chunks(4));
        for (((whole, parts), finer), nodes) in families.zip(found.chunks(4 * per_piece)) {
            let difference = (parts.iter().sum::<f64>() - whole).abs();
            let cost = 16 * per_piece;
            if difference > settled_at && spent + cost <= MAX_NODES {
                spent += cost;
                next.extend_from_slice(finer);
                next_totals.extend_from_slice(parts);
            } else {
                settled.extend_from_slice(nodes);
            }
        }
        (pieces, totals) = (next, next_totals);
    }
    settled
}

/// Curvatures at nodes of the surface's own sphere.
pub(in crate::measure) fn curved(
    surface: &(impl Surface + ?Sized),
    nodes: &[Node],
) -> Vec<CurvedNode> {
    let of_chunk = |nodes: &[Node]| {
        let nodes: Vec<Node> = nodes.iter().map(|node| surface.node(*node)).collect();
        let directions: Vec<_> = nodes.iter().map(|(n, _)| *n).collect();
        let found = nodes.into_iter().zip(surface.jets(&directions));
        found.map(|((n, solid_angle), jet)| {
            let curvature = Curvature::new(&n, &jet);
            CurvedNode {
                n,
                place: jet.place,
                principal: curvature.principal,
                area: curvature.area() * solid_angle,
            }
        })
    };
    nodes.par_chunks(CHUNK).flat_map_iter(of_chunk).collect()
}

/// The share of the total curvature of a closed surface that is not found.
fn missed(nodes: &[CurvedNode]) -> f64 {
    (total(nodes) / (4.0 * PI) - 1.0).abs()
}

/// The integral of K over what the nodes stand for.
fn total(nodes: &[CurvedNode]) -> f64 {
    let of = |node: &CurvedNode| node.principal[0] * node.principal[1] * node.area;
    nodes.iter().map(of).sum()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::{Frame, Superquadric, SuperquadricGrain};

    /// An ellipsoid as the superquadric it is, whose directions are stretched as those of fits are.
    fn ellipsoid(semi_axes: [f64; 3]) -> Vec<CurvedNode> {
        let shape = Superquadric::single(semi_axes, 2.0, 2.0).unwrap();
        curved_nodes(&SuperquadricGrain::single(Frame::SCAN, shape).unwrap())
    }

    #[test]
    fn the_total_curvature_of_slender_and_of_flat_bodies_is_4_pi() {
        for axes in [
            [10.0, 1.0, 0.8],
            [20.0, 1.0, 1.0],
            [20.0, 20.0, 1.0],
            [1.0, 1.0, 30.0],
        ] {
            let missing = (total(&ellipsoid(axes)) / (4.0 * PI) - 1.0).abs();
            assert!(missing < 5e-5, "{axes:?}: {missing:e}");
        }
    }

    #[test]
    fn pieces_are_cut_where_the_curvature_is_and_have_their_area() {
        let slender = ellipsoid([1.0, 1.0, 30.0]);
        // 2 pi a² (1 + c / (a e) asin e), e² = 1 - a²/c².
        let e = (1.0 - 1.0 / 900.0_f64).sqrt();
        let area = 2.0 * PI * (1.0 + 30.0 / e * e.asin());
        let found: f64 = slender.iter().map(|node| node.area).sum();
        assert!((found / area - 1.0).abs() < 1e-6, "{found} {area}");
        assert!(slender.len() > ellipsoid([1.0; 3]).len());
    }
}
