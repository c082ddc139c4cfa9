//! A quarter of a section of a body as a curve, parted by length.

use super::Solid;
use nalgebra::Vector3;
use std::f64::consts::FRAC_PI_2;

/// Chords of a curve without kinks. Their length is short by 1/24 of the square of the turn of each, some
/// 1e-9.
const CHORDS: usize = 8192;

/// The section of a body by the half-plane of azimuth 0 or by the plane z = 0, for angles from 0 to
/// pi/2 in it.
pub(super) struct Profile<'a> {
    body: &'a dyn Solid,
    direction: fn(f64) -> Vector3<f64>,
    /// Angles of kinks that are not at the ends, ascending.
    kinks: Vec<f64>,
    /// Whether the section has a kink at its start.
    starts_at_kink: bool,
    /// Whether it has one at its end, or none at all: there a mirrored model has its own.
    ends_at_kink: bool,
}

impl<'a> Profile<'a> {
    /// By the polar angle, at azimuth 0.
    pub(super) fn polar(body: &'a dyn Solid) -> Self {
        let direction = |angle: f64| Vector3::new(angle.sin(), 0.0, angle.cos());
        Self::new(body, direction, &body.singular_polar_angles(0.0))
    }

    /// By the azimuth, at z = 0.
    pub(super) fn azimuthal(body: &'a dyn Solid) -> Self {
        let direction = |angle: f64| Vector3::new(angle.cos(), angle.sin(), 0.0);
        Self::new(body, direction, &body.singular_azimuths())
    }

    fn new(body: &'a dyn Solid, direction: fn(f64) -> Vector3<f64>, singular: &[f64]) -> Self {
        let inner = singular.iter().copied();
        Self {
            body,
            direction,
            kinks: inner.filter(|&a| a > 0.0 && a < FRAC_PI_2).collect(),
            starts_at_kink: singular.contains(&0.0),
            ends_at_kink: singular.is_empty() || singular.contains(&FRAC_PI_2),
        }
    }

    /// `steps` + 1 angles from 0 to pi/2, equidistant along the curve.
    pub(super) fn equidistant(&self, steps: usize) -> Vec<f64> {
        self.parted(steps, |step| step.norm())
    }

    /// `steps` + 1 angles from 0 to pi/2, equidistant along z.
    pub(super) fn equally_high(&self, steps: usize) -> Vec<f64> {
        self.parted(steps, |step| step.z.abs())
    }

    /// `steps` + 1 angles from 0 to pi/2 with one at each kink: equidistant along the curve between
    /// kinks but for the two steps next to each kink, which are halves of one.
    pub(super) fn refined(&self, steps: usize) -> Vec<f64> {
        let ends = self.piece_ends();
        let arcs: Vec<Arc> = ends
            .windows(2)
            .map(|ends| self.arc(ends[0], ends[1], |step| step.norm()))
            .collect();
        let shares = shares(steps, &arcs.iter().map(Arc::length).collect::<Vec<_>>());
        let mut angles = vec![0.0];
        for (i, (arc, share)) in arcs.iter().zip(shares).enumerate() {
            let at_start = i > 0 || self.starts_at_kink;
            let at_end = i + 1 < arcs.len() || self.ends_at_kink;
            angles.extend(places(share, at_start, at_end).map(|place| arc.angle(place)));
        }
        angles
    }

    fn parted(&self, steps: usize, measure: fn(Vector3<f64>) -> f64) -> Vec<f64> {
        let ends = self.piece_ends();
        let arcs: Vec<Arc> = ends
            .windows(2)
            .map(|ends| self.arc(ends[0], ends[1], measure))
            .collect();
        let whole: f64 = arcs.iter().map(Arc::length).sum();
        let angle = |i: usize| {
            let mut left = whole * i as f64 / steps as f64;
            for arc in &arcs {
                if left <= arc.length() {
                    return arc.angle(left / arc.length());
                }
                left -= arc.length();
            }
            FRAC_PI_2
        };
        let between = (1..steps).map(angle);
        [0.0]
            .into_iter()
            .chain(between)
            .chain([FRAC_PI_2])
            .collect()
    }

    fn piece_ends(&self) -> Vec<f64> {
        let kinks = self.kinks.iter().copied();
        [0.0].into_iter().chain(kinks).chain([FRAC_PI_2]).collect()
    }

    fn arc(&self, start: f64, end: f64, measure: fn(Vector3<f64>) -> f64) -> Arc {
        let angle = |i: usize| start + (end - start) * i as f64 / CHORDS as f64;
        let point = |i: usize| {
            let n = (self.direction)(angle(i));
            n * self.body.radius(&n)
        };
        let mut lengths = vec![0.0];
        let mut last = point(0);
        for i in 1..=CHORDS {
            let next = point(i);
            lengths.push(lengths[i - 1] + measure(next - last));
            last = next;
        }
        Arc {
            start,
            end,
            lengths,
        }
    }
}

/// A piece of a curve and its length up to each of equal steps of the angle.
struct Arc {
    start: f64,
    end: f64,
    lengths: Vec<f64>,
}

impl Arc {
    fn length(&self) -> f64 {
        self.lengths[CHORDS]
    }

    /// The angle at a share of the length.
    fn angle(&self, share: f64) -> f64 {
        let length = share * self.length();
        let above = self.lengths.partition_point(|&known| known < length);
        if above == 0 || share >= 1.0 {
            return if above == 0 { self.start } else { self.end };
        }
        let below = self.lengths[above - 1];
        let along = (length - below) / (self.lengths[above] - below);
        let steps = (above as f64 - 1.0 + along) / CHORDS as f64;
        self.start + (self.end - self.start) * steps
    }
}

/// Steps shared out in proportion to lengths, one at least to each.
fn shares(steps: usize, lengths: &[f64]) -> Vec<usize> {
    let whole: f64 = lengths.iter().sum();
    let (mut sum, mut given) = (0.0, 0);
    let mut shares = Vec::with_capacity(lengths.len());
    for (i, length) in lengths.iter().enumerate() {
        sum += length;
        let to_come = lengths.len() - 1 - i;
        let up_to = (steps as f64 * sum / whole).round() as usize;
        let up_to = up_to.clamp(given + 1, (given + 1).max(steps.saturating_sub(to_come)));
        shares.push(up_to - given);
        given = up_to;
    }
    shares
}

/// The ends of `steps` steps of a length of one, of which those next to a kink are half as long.
fn places(steps: usize, at_start: bool, at_end: bool) -> impl Iterator<Item = f64> {
    let half = move |i: usize| (i < 2 && at_start) || (i + 2 >= steps && at_end);
    let width = move |i: usize| if half(i) { 0.5 } else { 1.0 };
    let whole: f64 = (0..steps).map(width).sum();
    let mut sum = 0.0;
    (0..steps).map(move |i| {
        sum += width(i);
        sum / whole
    })
}
