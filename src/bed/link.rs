//! Parts that may touch: what is kept of each two from step to step, and the forces of a pair of bodies.

use super::record;
use crate::contact::SAME_NORMAL;
use crate::contact::law::{Contact, Law};
use nalgebra::{Point3, Vector3};
use serde::{Deserialize, Serialize};

/// A part of a grain, and a part of another or a wall, that may touch.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(super) struct Link {
    pub(super) key: Key,
    /// Where the last contact was, and its normal.
    pub(super) last: Option<Last>,
    /// Tangential displacement since they touch.
    #[serde(with = "record::vector")]
    pub(super) slip: Vector3<f64>,
    /// How much nearer both bodies must have come, as [`Encounter::nearer`](super::encounter::Encounter) counts, before
    /// the parts can touch.
    pub(super) until: f64,
    /// The touch when it was last looked for.
    pub(super) touch: Option<Touch>,
}

/// What of two bodies touches what.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
pub(super) struct Key {
    /// The part of the first grain.
    pub(super) part: u16,
    /// The part of the other grain, or the wall.
    pub(super) other: u32,
    /// Of a wall, where its contact is looked for.
    pub(super) place: u16,
}

/// A contact, from the position of the first body.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub(super) struct Last {
    #[serde(with = "record::vector")]
    pub(super) aside: Vector3<f64>,
    #[serde(with = "record::vector")]
    pub(super) normal: Vector3<f64>,
}

/// Where bodies touch, and what that does to the first.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub(super) struct Touch {
    #[serde(with = "record::point")]
    pub(super) point: Point3<f64>,
    /// From the first to the other.
    #[serde(with = "record::vector")]
    pub(super) normal: Vector3<f64>,
    pub(super) overlap: f64,
    #[serde(with = "record::vector")]
    pub(super) force: Vector3<f64>,
    /// Beside that of the force.
    #[serde(with = "record::vector")]
    pub(super) moment: Vector3<f64>,
}

impl Touch {
    pub(super) fn new(point: Point3<f64>, normal: Vector3<f64>, overlap: f64) -> Self {
        Self {
            point,
            normal,
            overlap,
            force: Vector3::zeros(),
            moment: Vector3::zeros(),
        }
    }
}

/// How one of two bodies moves.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Motion {
    pub(super) centre: Point3<f64>,
    pub(super) velocity: Vector3<f64>,
    pub(super) spin: Vector3<f64>,
}

impl Motion {
    fn at(&self, point: &Point3<f64>) -> Vector3<f64> {
        self.velocity + self.spin.cross(&(point - self.centre))
    }
}

/// A pair of bodies as its law sees it.
pub(super) struct Pair<'a> {
    pub(super) law: &'a Law,
    /// R* and m*.
    pub(super) radius: f64,
    pub(super) mass: f64,
    pub(super) motions: [Motion; 2],
    pub(super) step: f64,
}

impl Link {
    pub(super) fn new(key: Key) -> Self {
        Self {
            key,
            last: None,
            slip: Vector3::zeros(),
            until: 0.0,
            touch: None,
        }
    }

    /// The forces of all links of two bodies, whose touches have been found. Parts that touch at one place share it.
    pub(super) fn act(links: &mut [Self], pair: &Pair<'_>) {
        for link in links.iter_mut().filter(|link| link.touch.is_none()) {
            link.slip = Vector3::zeros();
        }
        if let [link] = links {
            if let Some(touch) = &mut link.touch {
                pair.act(touch, &mut link.slip);
            }
            return;
        }
        let touches: Vec<(Touch, Vector3<f64>)> = links
            .iter()
            .filter_map(|link| Some((link.touch?, link.slip)))
            .collect();
        let touching = links.iter_mut().filter_map(|link| {
            let touch = link.touch.as_mut()?;
            Some((touch, &mut link.slip))
        });
        for (touch, slip) in touching {
            let share = touch.share(&touches, pair.radius);
            if *slip == Vector3::zeros() {
                *slip = touch.first_slip(&touches, pair.radius);
            }
            pair.act(touch, slip);
            touch.force *= share;
            touch.moment *= share;
        }
    }

    /// The touches of two bodies, those at one place as the deepest of them, with the force of all.
    pub(super) fn told(links: &[Self], radius: f64) -> Vec<Touch> {
        let mut touches: Vec<Touch> = links.iter().filter_map(|link| link.touch).collect();
        touches.sort_by(|one, other| other.overlap.total_cmp(&one.overlap));
        let mut told: Vec<Touch> = Vec::new();
        for touch in touches {
            let same = |deeper: &&mut Touch| deeper.likeness(&touch, radius) >= 0.5;
            match told.iter_mut().find(same) {
                Some(deeper) => deeper.force += touch.force,
                None => told.push(touch),
            }
        }
        told
    }
}

impl Touch {
    /// How far two touches of the same bodies are at one place: 1 where points and normals are the same, less the
    /// farther apart they are, a half at a cosine of [`SAME_NORMAL`] or at the radius sqrt(R* overlap) of the patch.
    fn likeness(&self, other: &Self, radius: f64) -> f64 {
        let turned = (1.0 - self.normal.dot(&other.normal)) / (1.0 - SAME_NORMAL);
        let patch = radius * self.overlap.max(other.overlap);
        let apart = (self.point - other.point).norm_squared() / patch;
        fading(0.5 * turned) * fading(0.5 * apart)
    }

    /// The share of the law's force that acts, so that parts that touch at one place do not act several times:
    /// overlap³ over the sum of that of all touches, each times its likeness. It goes to 1 or 0 as other touches begin
    /// and end and come near or part, without a step.
    fn share(&self, touches: &[(Self, Vector3<f64>)], radius: f64) -> f64 {
        let weights = touches.iter().filter_map(|(other, _)| {
            let likeness = self.likeness(other, radius);
            (likeness > 0.0).then(|| likeness * (other.overlap / self.overlap).powi(3))
        });
        1.0 / weights.sum::<f64>()
    }

    /// The displacement of a touch that begins: that of the one most like it.
    fn first_slip(&self, touches: &[(Self, Vector3<f64>)], radius: f64) -> Vector3<f64> {
        let known = touches
            .iter()
            .map(|(other, slip)| (self.likeness(other, radius), slip));
        let known = known.filter(|(_, slip)| **slip != Vector3::zeros());
        let most = known.max_by(|(one, _), (other, _)| one.total_cmp(other));
        most.map_or(Vector3::zeros(), |(likeness, slip)| slip * likeness)
    }
}

/// From 1 at zero to 0 at one, level at both.
fn fading(x: f64) -> f64 {
    let x = x.clamp(0.0, 1.0);
    1.0 - x * x * (3.0 - 2.0 * x)
}

impl Pair<'_> {
    fn act(&self, touch: &mut Touch, slip: &mut Vector3<f64>) {
        let [first, other] = &self.motions;
        let contact = Contact {
            radius: self.radius,
            mass: self.mass,
            overlap: touch.overlap,
            normal: touch.normal,
            velocity: first.at(&touch.point) - other.at(&touch.point),
            spin: first.spin - other.spin,
        };
        let acting = self.law.action(&contact, slip, self.step);
        (touch.force, touch.moment) = (acting.force, acting.moment);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_shares_of_touches_that_meet_and_part_have_no_step() {
        let still = Touch::new(Point3::origin(), Vector3::z(), 1e-5);
        // Another sinks in beside it, comes to the same place, leaves at an angle and ends.
        let other = |way: f64| {
            let normal = Vector3::new(0.6 * (way - 1.0).max(0.0), 0.0, 1.0).normalize();
            let aside = 3e-4 * (1.0 - way);
            Touch::new(
                Point3::new(aside, 0.0, 0.0),
                normal,
                2e-5 * way * (2.0 - way),
            )
        };
        let shares = (1..20_000).map(|at| {
            let other = other(f64::from(at) * 1e-4);
            let both = [still, other].map(|touch| (touch, Vector3::zeros()));
            both.map(|(touch, _)| touch.share(&both, 2.5e-3))
        });
        let shares: Vec<[f64; 2]> = shares.collect();
        for pair in shares.windows(2) {
            for (before, after) in pair[0].iter().zip(pair[1]) {
                assert!((before - after).abs() < 1e-3, "{pair:?}");
            }
        }
        let [first, other] = shares[9_999];
        assert!(first < 0.2 && other > 0.8 && (first + other - 1.0).abs() < 1e-12);
        assert!(shares[0][0] > 0.999 && shares[19_998][0] > 0.999);
    }
}
