//! Where grains touch each other and walls in one step, and what that does.

use super::body::Body;
use super::encounter::Encounter;
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
    /// Finds the touches of an encounter, and lets them act.
    pub(super) fn act(&self, encounter: &mut Encounter) {
        match encounter.other {
            Some(other) => self.act_between([encounter.first, other], encounter),
            None => self.act_on_walls(encounter),
        }
    }

    fn act_between(&self, numbers: [u32; 2], encounter: &mut Encounter) {
        let grains = numbers.map(|number| number as usize);
        encounter.nearer += self.nearer(grains);
        if !encounter.is_close() {
            return;
        }
        let nearer = encounter.nearer;
        let links = &mut encounter.links;
        for link in links.iter_mut().filter(|link| nearer >= link.until) {
            link.touch = self.between(grains, nearer, link);
        }
        let [one, two] = grains.map(|number| &self.kinds[self.bodies[number].kind]);
        let pair = Pair {
            law: self.law,
            radius: one.radius * two.radius / (one.radius + two.radius),
            mass: one.mass * two.mass / (one.mass + two.mass),
            motions: grains.map(|number| self.placed[number].motion),
            step: self.step,
        };
        let is_known = |link: &Link| link.touch.is_some() || link.slip != Vector3::zeros();
        if links.iter().any(is_known) {
            Link::act(links, &pair);
        }
        encounter.look_again();
    }

    /// Triangles beside each other may be touched at one place: all walls act together.
    fn act_on_walls(&self, encounter: &mut Encounter) {
        let number = encounter.first as usize;
        let kind = &self.kinds[self.bodies[number].kind];
        let placed = &self.placed[number];
        for link in &mut encounter.links {
            let part = usize::from(link.key.part);
            let wall = &self.walls[link.key.other as usize];
            let (shape, frame) = (&kind.parts[part], &placed.frames[part]);
            let is_near = wall.is_near(&frame.centre, shape.reach);
            link.touch = match is_near {
                true => wall.touch(link.key.place, &shape.part.shape, frame),
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
        Link::act(&mut encounter.links, &pair);
    }

    /// How far points of two grains may have come nearer to each other in this step.
    fn nearer(&self, numbers: [usize; 2]) -> f64 {
        let [one, two] = numbers.map(|number| &self.placed[number]);
        let moved = (one.motion.velocity - two.motion.velocity).norm() * self.step;
        moved + one.turned + two.turned
    }

    /// The touch of two parts of grains that have come so much nearer; how much more it takes if they do not touch.
    fn between(&self, grains: [usize; 2], nearer: f64, link: &mut Link) -> Option<Touch> {
        let parts = [usize::from(link.key.part), link.key.other as usize];
        let [(one, here), (two, there)] = [0, 1].map(|side| {
            let kind = &self.kinds[self.bodies[grains[side]].kind];
            let frames = &self.placed[grains[side]].frames;
            (&kind.parts[parts[side]], &frames[parts[side]])
        });
        link.until = nearer;
        let between = there.centre - here.centre;
        let (squared, reach) = (between.norm_squared(), one.reach + two.reach);
        if squared >= reach * reach {
            link.until += squared.sqrt() - reach;
            return None;
        }
        if one.is_sphere && two.is_sphere {
            let distance = squared.sqrt();
            let normal = between.try_normalize(0.0).unwrap_or(Vector3::x());
            let overlap = reach - distance;
            let point = here.centre + normal * (one.reach - 0.5 * overlap);
            return Some(Touch::new(point, normal, overlap));
        }
        let centre = self.bodies[grains[0]].position;
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
                link.until -= pair.overlap(&contact);
            }
            return None;
        }
        let overlap = pair.overlap(&contact);
        (overlap > 0.0).then(|| Touch::new(contact.point, contact.normal, overlap))
    }
}
