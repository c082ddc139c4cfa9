//! What no other part of a union covers of a patch.
//!
//! Along each line of the patch the ends of what is covered are found, and along its rims where these ends come in; Gauss's
//! rule is laid between them, so that neither steps nor kinks are integrated over.

use super::patch::Patch;
use crate::measure::Moments;
use crate::model::{MultiSuperquadric, Part};
use crate::sphere::GaussLegendre;
use nalgebra::Vector3;

/// How near to the surface of another part a point is on it, of which the first has it.
const SAME_SURFACE: f64 = 1e-12;

/// Halvings of the distance in which an end is looked for.
const HALVINGS: usize = 36;

/// The integrals over what is bare of a patch.
pub(super) fn bare(
    union: &MultiSuperquadric,
    index: usize,
    patch: &Patch,
    rule: &GaussLegendre,
) -> Moments {
    let part = &union.parts()[index];
    let covers = covers(union, index);
    let is_covered = |place: [f64; 2]| {
        let place = patch.point(&part.shape, place);
        let x = part.frame.to_scan(&place).coords;
        covers.iter().any(|cover| cover.holds(&x))
    };
    let mut sum = Moments::default();
    let [along, across] = patch.sides();
    let rims = across.map(|v| turns(along, rule, |u| is_covered([u, v])));
    for [from, to] in between(along, rims.into_iter().flatten()) {
        for (u, wu) in rule.on(from, to) {
            let ends = turns(across, rule, |v| is_covered([u, v]));
            for [from, to] in between(across, ends.into_iter()) {
                if is_covered([u, 0.5 * (from + to)]) {
                    continue;
                }
                for (v, wv) in rule.on(from, to) {
                    let node = patch.node(&part.shape, [u, v]);
                    let place = part.frame.to_scan(&node.point).coords;
                    sum.add_element(&place, &(part.frame.axes * node.area * (wu * wv)));
                }
            }
        }
    }
    sum
}

/// Another part, and the gauge at which it ends.
struct Cover<'a> {
    part: &'a Part,
    edge: f64,
}

impl Cover<'_> {
    fn holds(&self, x: &Vector3<f64>) -> bool {
        let local = self.part.frame.to_local(&(*x).into());
        self.part.shape.is_gauge_below(&local, self.edge)
    }
}

/// What may cover a part.
fn covers(union: &MultiSuperquadric, index: usize) -> Vec<Cover<'_>> {
    let parts = union.parts().iter().enumerate();
    let others = parts.filter(|(other, _)| *other != index);
    others
        .map(|(other, part)| Cover {
            part,
            edge: match other < index {
                true => 1.0 + SAME_SURFACE,
                false => 1.0 - SAME_SURFACE,
            },
        })
        .collect()
}

/// Where something begins or ends along a side, as far as the nodes of a rule and the ends tell.
fn turns([start, end]: [f64; 2], rule: &GaussLegendre, holds: impl Fn(f64) -> bool) -> Vec<f64> {
    let mut turns = Vec::new();
    let (mut before, mut held) = (start, holds(start));
    for here in rule.on(start, end).map(|(place, _)| place).chain([end]) {
        let now = holds(here);
        if now != held {
            turns.push(turn([before, here], |place| holds(place) == now));
        }
        (before, held) = (here, now);
    }
    turns
}

/// The spans of a side between some places of it.
fn between([start, end]: [f64; 2], places: impl Iterator<Item = f64>) -> Vec<[f64; 2]> {
    let mut ends: Vec<f64> = places.chain([start, end]).collect();
    ends.sort_by(f64::total_cmp);
    ends.windows(2).map(|pair| [pair[0], pair[1]]).collect()
}

/// Where something begins to hold between a place where it does not and one where it does.
fn turn([mut before, mut after]: [f64; 2], holds: impl Fn(f64) -> bool) -> f64 {
    for _ in 0..HALVINGS {
        let middle = 0.5 * (before + after);
        match holds(middle) {
            true => after = middle,
            false => before = middle,
        }
    }
    0.5 * (before + after)
}
