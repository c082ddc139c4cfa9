//! Where grains touch each other and walls in one step, and what that does.

use super::body::Body;
use super::grain::GrainKind;
use super::link::{Last, Link, Motion, Pair, Touch};
use super::wall::Wall;
use crate::contact::law::Law;
use crate::contact::{ConvexPair, ConvexStatus, Warm};
use crate::model::Frame;
use nalgebra::Vector3;

/// A body with what is computed once per step.
#[derive(Debug, Clone)]
pub(super) struct Placed {
    pub(super) motion: Motion,
    /// How far its points may have turned about its centre in this step, in metres.
    pub(super) turned: f64,
    pub(super) frames: Vec<Frame>,
}

/// What touches are found in.
pub(super) struct Field<'a> {
    pub(super) kinds: &'a [GrainKind],
    pub(super) walls: &'a [Wall],
    pub(super) bodies: &'a [Body],
    pub(super) placed: &'a [Placed],
    pub(super) law: &'a Law,
    pub(super) step: f64,
}

impl Field<'_> {
    /// Finds the touches of two grains, and lets them act.
    pub(super) fn act_between(&self, links: &mut [Link]) {
        let numbers = [links[0].key.first as usize, links[0].key.other as usize];
        let nearer = self.nearer(numbers);
        let mut is_touching = false;
        for link in links.iter_mut() {
            link.gap -= nearer;
            link.touch = match link.gap > 0.0 {
                true => None,
                false => self.between(link),
            };
            is_touching |= link.touch.is_some();
        }
        let [one, two] = numbers.map(|number| &self.kinds[self.bodies[number].kind]);
        let pair = Pair {
            law: self.law,
            radius: one.radius * two.radius / (one.radius + two.radius),
            mass: one.mass * two.mass / (one.mass + two.mass),
            motions: numbers.map(|number| self.placed[number].motion),
            step: self.step,
        };
        if is_touching || links.iter().any(|link| link.slip != Vector3::zeros()) {
            Link::act(links, &pair);
        }
    }

    /// Finds the touches of a grain and all walls, and lets them act.
    pub(super) fn act_on_walls(&self, links: &mut [Link]) {
        let number = links[0].key.first as usize;
        let kind = &self.kinds[self.bodies[number].kind];
        let placed = &self.placed[number];
        for link in links.iter_mut() {
            let (wall, part) = (
                &self.walls[link.key.other as usize],
                usize::from(link.key.part),
            );
            let (shape, frame) = (&kind.parts[part], &placed.frames[part]);
            let is_near = wall.is_near(&frame.centre, shape.reach);
            link.touch = match is_near {
                true => wall.touch(link.key.other_part, &shape.part.shape, frame),
                false => None,
            };
        }
        let still = Motion {
            velocity: Vector3::zeros(),
            spin: Vector3::zeros(),
            ..placed.motion
        };
        let pair = Pair {
            law: self.law,
            radius: kind.radius,
            mass: kind.mass,
            motions: [placed.motion, still],
            step: self.step,
        };
        Link::act(links, &pair);
    }

    /// How far points of two grains may have come nearer to each other in this step.
    fn nearer(&self, numbers: [usize; 2]) -> f64 {
        let [one, two] = numbers.map(|number| &self.placed[number]);
        let moved = (one.motion.velocity - two.motion.velocity).norm() * self.step;
        moved + one.turned + two.turned
    }

    /// The touch of two parts of grains; how far they are apart if they do not touch.
    fn between(&self, link: &mut Link) -> Option<Touch> {
        let sides = [
            (link.key.first, link.key.part),
            (link.key.other, link.key.other_part),
        ];
        let [(one, here), (two, there)] = sides.map(|(number, part)| {
            let kind = &self.kinds[self.bodies[number as usize].kind];
            let frames = &self.placed[number as usize].frames;
            (&kind.parts[usize::from(part)], &frames[usize::from(part)])
        });
        let between = there.centre - here.centre;
        let (squared, reach) = (between.norm_squared(), one.reach + two.reach);
        if squared >= reach * reach {
            link.gap = squared.sqrt() - reach;
            return None;
        }
        if one.is_sphere && two.is_sphere {
            let distance = squared.sqrt();
            let normal = between.try_normalize(0.0).unwrap_or(Vector3::x());
            let overlap = reach - distance;
            let point = here.centre + normal * (one.reach - 0.5 * overlap);
            return Some(Touch::new(point, normal, overlap));
        }
        let centre = self.bodies[link.key.first as usize].position;
        let pair = ConvexPair::new((&one.part.shape, here), (&two.part.shape, there));
        let warm = link.last.map(|last| Warm {
            point: centre + last.aside,
            normal: last.normal,
        });
        let contact = pair.contact(warm.as_ref());
        link.last = Some(Last {
            aside: contact.point - centre,
            normal: contact.normal,
        });
        if contact.ratio >= 1.0 {
            if contact.status == ConvexStatus::Apart {
                link.gap = -pair.overlap(&contact);
            }
            return None;
        }
        let overlap = pair.overlap(&contact);
        (overlap > 0.0).then(|| Touch::new(contact.point, contact.normal, overlap))
    }
}
