//! Bodies of revolution whose axis is bent in its plane.
//!
//! A section normal to the axis stays one, and stays a circle about the axis. So by the theorem of Pappus the volume is
//! that of the straight body, as long as no radius is longer than that of the bend.

use super::profile::Profile;
use super::{CurledTruth, OverSphere};
use crate::measure::Moments;
use crate::sphere::GaussLegendre;
use nalgebra::{Point3, Vector3};
use std::f64::consts::{PI, TAU};

/// Gauss nodes along a piece of the profile, of the rule and of the one that it is checked with. Elliptical arcs with
/// semi-axes of 1 to 5 need as many.
const ORDERS: [usize; 2] = [96, 72];

/// Places along a circle, evenly spaced: exact for all moments, and for areas of pieces that are bent.
const PLACES: usize = 48;

/// Relative error of sums of so many terms.
const ROUNDING: f64 = 1e-14;

/// Sine of the polar angle that poles are taken at.
const POLE: f64 = 1e-9;

/// A body of revolution about z, its axis bent towards +x.
#[derive(Debug, Clone)]
pub(super) struct Bent {
    profile: Profile,
    /// The part of the axis that becomes an arc; what is beyond it stays straight.
    bend: [f64; 2],
    /// Radius of the arc.
    radius: f64,
}

impl Bent {
    /// See [`super::Curled::Banana`].
    pub(super) fn banana() -> Self {
        Self {
            profile: Profile::ellipsoid([0.48, 2.65]),
            bend: [-2.65, 2.65],
            radius: 2.0,
        }
    }

    /// See [`super::Curled::Hook`].
    pub(super) fn hook() -> Self {
        Self {
            profile: Profile::rod(0.45, [-1.2, PI + 0.6]),
            bend: [0.0, PI],
            radius: 1.0,
        }
    }

    /// See [`super::Curled::Cup`].
    pub(super) fn cup() -> Self {
        Self::straight(Profile::cup())
    }

    /// See [`super::Curled::Mushroom`].
    pub(super) fn mushroom() -> Self {
        Self::straight(Profile::mushroom())
    }

    fn straight(profile: Profile) -> Self {
        Self {
            profile,
            bend: [0.0; 2],
            radius: 1.0,
        }
    }

    /// The axis at a place along it, the unit vector across it, away from the centre of the bend, and along it.
    fn axis(&self, along: f64) -> [Vector3<f64>; 3] {
        let [low, high] = self.bend;
        let bent = along.clamp(low, high);
        let (sin, cos) = ((bent - low) / self.radius).sin_cos();
        let (across, tangent) = (Vector3::new(-cos, 0.0, sin), Vector3::new(sin, 0.0, cos));
        let place = Vector3::new(self.radius * (1.0 - cos), 0.0, low + self.radius * sin);
        [place + tangent * (along - bent), across, tangent]
    }

    /// The place on a circle about the axis, and the vector area per unit of a parameter of the profile, whose `slope`
    /// is by it, and per radian round the axis.
    fn element(
        &self,
        ([r, along], slope): ([f64; 2], [f64; 2]),
        azimuth: f64,
    ) -> (Vector3<f64>, Vector3<f64>) {
        let [axis, across, tangent] = self.axis(along);
        let (sin, cos) = azimuth.sin_cos();
        let outward = Vector3::y() * sin - across * cos;
        // Round the bend, what is farther out is longer.
        let is_bent = self.bend[0] <= along && along <= self.bend[1];
        let longer = match is_bent && self.bend[0] < self.bend[1] {
            true => 1.0 - r * cos / self.radius,
            false => 1.0,
        };
        let area = (outward * (slope[1] * longer) - tangent * slope[0]) * r;
        (axis + outward * r, area)
    }

    /// Parameters between which a piece is smooth: it is cut where it comes to the bend and where it leaves it.
    fn cuts(&self, from: f64, to: f64) -> Vec<f64> {
        let mut cuts = vec![0.0];
        for end in self.bend {
            let t = (end - from) / (to - from);
            if t > 0.0 && t < 1.0 {
                cuts.push(t);
            }
        }
        cuts.push(1.0);
        cuts.sort_by(f64::total_cmp);
        cuts
    }

    fn moments(&self, order: usize) -> Moments {
        let rule = GaussLegendre::new(order);
        let step = TAU / PLACES as f64;
        let mut sum = Moments::default();
        for piece in self.profile.pieces() {
            let cuts = self.cuts(piece.at(0.0).0[1], piece.at(1.0).0[1]);
            for ends in cuts.windows(2) {
                for (t, weight) in rule.on(ends[0], ends[1]) {
                    for i in 0..PLACES {
                        let (place, area) = self.element(piece.at(t), step * i as f64);
                        sum.add_element(&place, &(area * (weight * step)));
                    }
                }
            }
        }
        sum
    }
}

impl OverSphere for Bent {
    fn place_and_area(&self, n: &Vector3<f64>) -> (Vector3<f64>, Vector3<f64>) {
        let sin = n.x.hypot(n.y).max(POLE);
        let ([r, along], slope) = self.profile.at(sin.atan2(n.z));
        let azimuth = n.y.atan2(n.x);
        // The profile runs against the polar angle.
        let (place, area) = self.element(([r, along], slope.map(|slope| -slope)), azimuth);
        (place, area / sin)
    }

    fn integrals(&self) -> CurledTruth {
        let [sum, check] = ORDERS.map(|order| self.moments(order));
        let off = |one: f64, other: f64| (one / other - 1.0).abs();
        let error = off(sum.area, check.area).max(off(sum.volume, check.volume));
        CurledTruth {
            properties: sum.about_centroid(&Point3::origin()),
            relative_error: error.max(ROUNDING),
        }
    }
}
