//! Pairs that may touch: what is kept of each from step to step, and the forces of a pair of bodies.

use super::record;
use crate::contact::law::{Contact, Law};
use crate::contact::same_touch;
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
    /// The touch of this step, which is found anew in each.
    pub(super) touch: Option<Touch>,
}

/// What touches what. Of two grains the first has the smaller number.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
pub(super) struct Key {
    /// The grain.
    pub(super) first: u32,
    /// The other grain, or the wall.
    pub(super) other: u32,
    /// The part of the first.
    pub(super) part: u16,
    /// The part of the other; of a wall, the place where its contact is looked for.
    pub(super) other_part: u16,
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
            touch: None,
        }
    }

    /// The forces of all links of two bodies, whose touches have been found. Of parts that touch at one place the
    /// deepest acts; the others keep its displacement, for the case that one of them is deepest next.
    pub(super) fn act(links: &mut [Self], pair: &Pair<'_>) {
        for link in links.iter_mut().filter(|link| link.touch.is_none()) {
            link.slip = Vector3::zeros();
        }
        let mut left: Vec<usize> = match links {
            [link] => {
                if let Some(touch) = &mut link.touch {
                    pair.act(touch, &mut link.slip);
                }
                return;
            }
            _ => (0..links.len())
                .filter(|&at| links[at].touch.is_some())
                .collect(),
        };
        let overlap = |link: &Self| link.touch.map_or(0.0, |touch| touch.overlap);
        left.sort_by(|&a, &b| overlap(&links[b]).total_cmp(&overlap(&links[a])));
        while let [deepest, rest @ ..] = left.as_slice() {
            let link = &mut links[*deepest];
            let Some(touch) = &mut link.touch else { break };
            pair.act(touch, &mut link.slip);
            let (slip, touch) = (link.slip, *touch);
            let mut others = Vec::new();
            for &at in rest {
                let found = links[at].touch;
                let is_same = found.is_some_and(|other| {
                    let places = [(touch.point, touch.normal), (other.point, other.normal)];
                    same_touch(places, pair.radius, touch.overlap)
                });
                match is_same {
                    true => (links[at].touch, links[at].slip) = (None, slip),
                    false => others.push(at),
                }
            }
            left = others;
        }
    }
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
