//! Area, volume and inertia of a fitted grain.

use super::integrals::integrate_pieces;
use super::{Integrals, MassProperties};
use crate::model::Grain;

/// Relative tolerance of the integrals of a fitted grain.
const TOLERANCE: f64 = 1e-9;

/// Area, volume, centroid and inertia of a fitted grain, in the scan's frame.
///
/// Segment by segment, so the steps between segments do no harm: volume and moments are those of
/// the solid below the expansions, and the area is that of the expansions, without the walls of the
/// steps. The radius cubed and to the fifth power are polynomials in the direction, so volume,
/// centroid and inertia are exact to rounding (1e-13); the area is adaptive, to 1e-9.
pub fn grain_properties(grain: &Grain) -> Integrals {
    let pieces = (0..grain.partition().segments()).flat_map(|segment| {
        let rectangle = grain.partition().rectangle(segment);
        let pieces = match grain.partition().per_angle() {
            1 => rectangle.quarters().to_vec(),
            _ => vec![rectangle],
        };
        let surface = move |n: &_| grain.segment_radius_and_gradient(segment, n);
        pieces.into_iter().map(move |piece| (piece, surface))
    });
    let local = integrate_pieces(pieces, TOLERANCE);
    let frame = grain.frame();
    Integrals {
        properties: MassProperties {
            centroid: frame.to_scan(&local.properties.centroid.coords),
            inertia: frame.axes * local.properties.inertia * frame.axes.transpose(),
            ..local.properties
        },
        ..local
    }
}
