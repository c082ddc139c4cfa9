//! A surface as it is seen from a point within: elements so small that harmonics over the directions are resolved.

use super::integrals::elements::{Element, surface_elements};
use crate::model::{Parts, Piece, Surface};
use crate::sphere::GaussLegendre;
use nalgebra::Vector3;
use std::f64::consts::FRAC_PI_2;

/// Nodes along the sides of a piece of a surface that is analytic on the whole sphere.
const ORDER: usize = 12;

/// Angle, in radians, across an octant.
const OCTANT: f64 = FRAC_PI_2;

/// Rounds of cutting pieces in four: a body that is 100 times as long as wide takes five more than a ball.
const ROUNDS: usize = 9;

/// The elements of a surface, seen from a point `shift` before its centre. Pieces of the tiling are cut in four until, over the
/// directions in which each is seen, harmonics of a degree turn by no more radians than it has nodes along a side: of a
/// long body these directions turn much faster than those of the tiling.
pub(super) fn seen_elements(
    surface: &(impl Surface + ?Sized),
    shift: &Vector3<f64>,
    degree: usize,
) -> Vec<Element> {
    let (mut pieces, order) = first_pieces(surface.tiling().parts);
    let rule = GaussLegendre::new(order);
    let mut found = Vec::new();
    for round in 1..=ROUNDS {
        let nodes: Vec<_> = pieces.iter().flat_map(|piece| piece.nodes(&rule)).collect();
        let elements = surface_elements(surface, &nodes, shift);
        let mut coarse = Vec::new();
        for (piece, own) in pieces.iter().zip(elements.chunks_exact(order * order)) {
            match round < ROUNDS && degree as f64 * span(own, order) > order as f64 {
                true => coarse.extend(piece.quarters()),
                false => found.extend_from_slice(own),
            }
        }
        pieces = coarse;
    }
    found
}

/// Pieces that resolve the surface itself, and nodes along their sides.
fn first_pieces(parts: Parts) -> (Vec<Piece>, usize) {
    let (pieces, order, cuts) = match parts {
        Parts::Pieces {
            pieces,
            orders: [order, _],
            cuts,
        } => (pieces, order, cuts),
        Parts::Sphere { degree } => {
            let turns = (degree as f64 * OCTANT / ORDER as f64).max(1.0);
            (
                Piece::octants().to_vec(),
                ORDER,
                turns.log2().ceil() as usize,
            )
        }
    };
    let quarters = |pieces: Vec<Piece>, _| pieces.iter().flat_map(Piece::quarters).collect();
    ((0..cuts).fold(pieces, quarters), order)
}

/// Largest angle, in radians, between directions in which a piece is seen: those of its outermost nodes.
fn span(elements: &[Element], order: usize) -> f64 {
    let [a, b, c, d] =
        [0, order - 1, order * (order - 1), order * order - 1].map(|corner| elements[corner].place);
    a.angle(&d).max(b.angle(&c))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::measure::descriptors::spectrum::{SPECTRUM_DEGREE, Spectrum};
    use crate::measure::integrals::rings::ring_nodes;
    use crate::model::{Family, Frame, Radial, StarGrain, Stretch, Whole};
    use crate::shapes::Ellipsoid;
    use std::f64::consts::PI;

    /// Of long and of flat ellipsoids, which are a ball in the directions of their tiling.
    #[test]
    fn harmonics_are_resolved_over_the_directions_in_which_a_body_is_seen() {
        for axes in [[5.0, 1.6, 1.4], [1.0, 4.0, 4.0], [1.0, 1.0, 1.0]] {
            let semi_axes = Vector3::from(axes);
            let ball = Whole::new(vec![(4.0 * PI).sqrt()]).unwrap();
            let stretch = Stretch::new(semi_axes.map(|a| 1.0 / a)).unwrap();
            let grain = StarGrain::stretched(Frame::SCAN, stretch, Family::Whole(ball)).unwrap();
            let found = seen_elements(&grain, &Vector3::zeros(), SPECTRUM_DEGREE);
            let nodes: Vec<_> = ring_nodes(200).flatten().collect();
            let ellipsoid = Ellipsoid { semi_axes };
            let exact = surface_elements(&Radial(&ellipsoid), &nodes, &Vector3::zeros());
            let [found, exact] = [found, exact].map(|elements| Spectrum::new(&elements));
            for (one, other) in found.power.iter().zip(&exact.power) {
                assert!(
                    (one - other).abs() < 1e-9 * (exact.power[0] * other).sqrt() + 1e-24,
                    "{axes:?} {one} {other}"
                );
            }
        }
    }

    #[test]
    fn a_round_surface_is_cut_as_fine_as_its_own_harmonics_are() {
        let count = |degree: usize| {
            let mut coefficients = vec![0.0; (degree + 1).pow(2)];
            coefficients[0] = 3.0;
            let whole = Whole::new(coefficients).unwrap();
            let grain = StarGrain::new(Frame::SCAN, Family::Whole(whole)).unwrap();
            seen_elements(&grain, &Vector3::zeros(), 1).len()
        };
        let octants = 8 * ORDER * ORDER;
        assert_eq!([4, 12, 24].map(count), [octants, 4 * octants, 16 * octants]);
    }
}
