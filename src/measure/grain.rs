//! Area, volume and inertia of a fitted grain.

use super::integrals::{ORDERS, Piece, integrate_octants, integrate_pieces};
use super::rings::integrate_rings;
use super::{Integrals, MassProperties};
use crate::model::{Blended, Grain, Mirrored, Segmented, Stretch, Surface};
use crate::sphere::{AngleRectangle, FaceRectangle, GaussLegendre};
use nalgebra::Vector3;

/// Relative tolerance of the integrals over independent segments, mirror images and the whole sphere,
/// which are smooth.
const SMOOTH_TOLERANCE: f64 = 1e-9;

/// Relative tolerance of the integrals over a blended surface, whose third derivatives jump where the
/// margins of cells end. The estimate is pessimistic: at 1e-5 the error is 5e-8 on the maize kernel.
const BLENDED_TOLERANCE: f64 = 3e-6;

/// Gauss nodes per side of a zone of a blended surface: a zone is a tenth of a cell.
pub(super) const BLENDED_ORDERS: [usize; 2] = [6, 5];

/// Area, volume, centroid and inertia of a fitted grain, in the scan's frame.
///
/// Of a blended surface: of the joined surface itself, to 3e-6 at worst and 1e-7 as a rule.
///
/// Of independent segments: segment by segment, so the steps between them do no harm; volume and
/// moments are those of the solid below the expansions, and the area is that of the expansions, without
/// the walls of the steps. There the radius cubed and to the fifth power are polynomials in the
/// direction, so volume, centroid and inertia are exact to rounding (1e-13); the area is adaptive, to
/// 1e-9.
///
/// Of a mirrored surface: octant by octant, so its edges lie between them, to 1e-9.
///
/// Of one expansion of the whole sphere: ring by ring, volume and moments likewise exact to rounding, the
/// area to 1e-9.
///
/// All of them are taken in the stretched space of a grain that is [stretched](Grain::stretched), where
/// its volume and moments are polynomials too.
pub fn grain_properties(grain: &Grain) -> Integrals {
    let stretch = grain.stretch();
    let local = match grain.surface() {
        Surface::Blended(surface) => blended(surface, stretch),
        Surface::Segmented(surface) => segmented(surface, stretch),
        Surface::Mirrored(surface) => mirrored(surface, stretch),
        Surface::Whole(surface) => integrate_rings(surface, stretch, SMOOTH_TOLERANCE),
    };
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

fn blended(surface: &Blended, stretch: &Stretch) -> Integrals {
    let zones = surface.cover().zones();
    let evaluate = |_: &[_], directions: &[_]| surface.radii_and_gradients(directions);
    integrate_pieces(zones, stretch, BLENDED_ORDERS, BLENDED_TOLERANCE, evaluate)
}

/// Those of a mirrored surface in the grain's own frame. What vanishes by symmetry is zero, so that axes
/// normal to the mirrors are principal axes even where moments are equal.
pub(crate) fn mirrored_properties(surface: &Mirrored) -> Integrals {
    mirrored(surface, &Stretch::NONE)
}

fn mirrored(surface: &Mirrored, stretch: &Stretch) -> Integrals {
    let mut found = integrate_octants(surface, stretch, SMOOTH_TOLERANCE);
    let MassProperties {
        centroid, inertia, ..
    } = &mut found.properties;
    for axis in surface.symmetry().normals() {
        centroid[axis] = 0.0;
        for other in (0..3).filter(|&other| other != axis) {
            inertia[(axis, other)] = 0.0;
            inertia[(other, axis)] = 0.0;
        }
    }
    found
}

impl Piece for FaceRectangle {
    fn nodes(&self, rule: &GaussLegendre) -> Vec<(Vector3<f64>, f64)> {
        self.nodes(rule)
    }

    fn solid_angle(&self) -> f64 {
        self.solid_angle()
    }

    fn quarters(&self) -> [Self; 4] {
        self.quarters()
    }
}

/// A part of a segment.
pub(super) struct SegmentPart {
    segment: usize,
    rectangle: AngleRectangle,
}

impl Piece for SegmentPart {
    fn nodes(&self, rule: &GaussLegendre) -> Vec<(Vector3<f64>, f64)> {
        self.rectangle.nodes(rule, rule)
    }

    fn solid_angle(&self) -> f64 {
        self.rectangle.solid_angle()
    }

    fn quarters(&self) -> [Self; 4] {
        self.rectangle.quarters().map(|rectangle| Self {
            segment: self.segment,
            rectangle,
        })
    }
}

/// The segments, or the quarters of the only one.
pub(super) fn segment_parts(surface: &Segmented) -> Vec<SegmentPart> {
    let partition = surface.partition();
    let whole = |segment: usize| SegmentPart {
        segment,
        rectangle: partition.rectangle(segment),
    };
    match partition.per_angle() {
        1 => whole(0).quarters().into(),
        _ => (0..partition.segments()).map(whole).collect(),
    }
}

fn segmented(surface: &Segmented, stretch: &Stretch) -> Integrals {
    let evaluate = |parts: &[SegmentPart], directions: &[Vector3<f64>]| {
        let per_part = directions.len() / parts.len();
        let nodes = parts.iter().zip(directions.chunks(per_part));
        nodes
            .flat_map(|(part, directions)| directions.iter().map(|n| (part.segment, n)))
            .map(|(segment, n)| surface.segment_radius_and_gradient(segment, n))
            .collect()
    };
    let parts = segment_parts(surface);
    integrate_pieces(parts, stretch, ORDERS, SMOOTH_TOLERANCE, evaluate)
}
