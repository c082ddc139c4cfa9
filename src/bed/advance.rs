//! A step of a bed: all grains move by velocity Verlet with half kicks, the touches of all encounters are found, and the
//! forces of each grain are added up in the order of these: threads share the work and do not change a bit of it.

use super::body::Load;
use super::field::Field;
use super::link::Motion;
use super::neighbours::Neighbourhood;
use super::settle::{Bed, Share};
use nalgebra::Vector3;
use rayon::prelude::*;

/// Bodies that a thread takes at least.
const LEAST_BODIES: usize = 128;

/// Encounters that a thread takes at least.
const LEAST_ENCOUNTERS: usize = 256;

/// How much farther than its spin says a grain is taken to have turned in a step, for the spin of a free body changes.
const TURNED: f64 = 1.1;

impl Bed {
    /// The bed with what touches and acts at its first step.
    pub(super) fn begun(mut self) -> Self {
        self.list();
        self.act();
        self
    }

    /// Goes on by one step.
    pub fn advance(&mut self) {
        let (kinds, step) = (&self.kinds, self.step);
        let bodies = self.state.bodies.par_iter_mut().zip(&self.loads);
        bodies.with_min_len(LEAST_BODIES).for_each(|(body, load)| {
            let kind = &kinds[body.kind];
            body.kick(kind, load, 0.5 * step);
            body.drift(kind, step);
        });
        if self.is_outdated() {
            self.list();
        }
        self.act();
        let kinds = &self.kinds;
        let bodies = self.state.bodies.par_iter_mut().zip(&self.loads);
        bodies.with_min_len(LEAST_BODIES).for_each(|(body, load)| {
            body.kick(&kinds[body.kind], load, 0.5 * step);
        });
        self.state.steps += 1;
    }

    /// Whether a part may have moved by half a skin since encounters were listed.
    fn is_outdated(&self) -> bool {
        let bodies = self.state.bodies.iter().zip(&self.state.listed);
        bodies
            .into_iter()
            .any(|(body, before)| body.moved(before, self.kinds[body.kind].arm) > 0.5 * self.skin)
    }

    /// Lists the encounters.
    fn list(&mut self) {
        let around = Neighbourhood {
            kinds: &self.kinds,
            walls: &self.walls,
            bodies: &self.state.bodies,
            skin: self.skin,
        };
        let earlier = std::mem::take(&mut self.state.encounters);
        self.state.encounters = around.encounters(earlier);
        self.state.listed.clone_from(&self.state.bodies);
        self.share();
    }

    /// Tells each body its encounters.
    pub(super) fn share(&mut self) {
        self.shares.iter_mut().for_each(Vec::clear);
        self.shares.resize_with(self.state.bodies.len(), Vec::new);
        for (at, encounter) in self.state.encounters.iter().enumerate() {
            let mut tell = |grain: u32, is_first| {
                self.shares[grain as usize].push(Share {
                    encounter: at,
                    is_first,
                });
            };
            tell(encounter.first, true);
            if let Some(other) = encounter.other {
                tell(other, false);
            }
        }
    }

    /// Finds what acts on the grains where they are.
    fn act(&mut self) {
        self.place();
        self.touch();
        self.sum();
    }

    /// Places all parts.
    fn place(&mut self) {
        let (kinds, step) = (&self.kinds, self.step);
        let bodies = self.placed.par_iter_mut().zip(&self.state.bodies);
        bodies
            .with_min_len(LEAST_BODIES)
            .for_each(|(placed, body)| {
                let (kind, axes) = (&kinds[body.kind], body.axes());
                placed.motion = Motion {
                    centre: body.position,
                    velocity: body.velocity,
                    spin: body.spin(kind, &axes),
                };
                placed.turned = TURNED * placed.motion.spin.norm() * kind.reach * step;
                placed.frames.clear();
                placed.frames.extend(kind.placed(body.position, axes));
            });
    }

    /// Finds all touches and their forces.
    fn touch(&mut self) {
        let field = Field {
            kinds: &self.kinds,
            walls: &self.walls,
            bodies: &self.state.bodies,
            placed: &self.placed,
            law: &self.law,
            step: self.step,
        };
        let encounters = self.state.encounters.par_iter_mut();
        encounters
            .with_min_len(LEAST_ENCOUNTERS)
            .for_each(|encounter| field.act(encounter));
    }

    /// Adds up the loads of all bodies.
    pub(super) fn sum(&mut self) {
        let weight = Vector3::new(0.0, 0.0, -self.settings.gravity);
        let encounters = &self.state.encounters;
        let bodies = self.shares.par_iter().zip(&self.state.bodies);
        let loads = self.loads.par_iter_mut().zip(bodies);
        let loads = loads.with_min_len(LEAST_BODIES);
        loads.for_each(|(load, (shares, body))| {
            *load = Load {
                force: weight * self.kinds[body.kind].mass,
                moment: Vector3::zeros(),
            };
            for share in shares {
                let encounter = &encounters[share.encounter];
                if !encounter.is_close() {
                    continue;
                }
                let sign = if share.is_first { 1.0 } else { -1.0 };
                for touch in encounter.links.iter().filter_map(|link| link.touch) {
                    let force = touch.force * sign;
                    load.force += force;
                    load.moment += (touch.point - body.position).cross(&force);
                    load.moment += touch.moment * sign;
                }
            }
        });
    }
}
