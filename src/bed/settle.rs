//! A bed: grains, walls, and what moves them.

use super::body::{Body, Load};
use super::field::{Field, Placed};
use super::grain::GrainKind;
use super::link::{Link, Motion};
use super::neighbours::{Neighbourhood, skin};
use super::settings::{BedError, BedSettings, Container};
use super::start::loose_column;
use super::wall::Wall;
use crate::contact::law::Law;
use crate::mesh::Mesh;
use nalgebra::{Point3, Vector3};
use rayon::prelude::*;
use serde::{Deserialize, Serialize};

/// Bodies that a thread takes at least.
const LEAST_BODIES: usize = 128;

/// How much farther than its spin says a grain is taken to have turned in a step, for the spin of a free body changes.
const TURNED: f64 = 1.1;

/// Grains that fall, and lie.
///
/// Each step moves all grains by velocity Verlet with half kicks, finds the touches of all pairs of the neighbour list,
/// and adds up the forces of each grain in the order of the list: threads share the work and do not change a bit of it.
#[derive(Debug, Clone)]
pub struct Bed {
    pub(super) settings: BedSettings,
    pub(super) kinds: Vec<GrainKind>,
    pub(super) walls: Vec<Wall>,
    law: Law,
    /// Seconds of a step.
    pub(super) step: f64,
    /// Metres by which pairs are listed before they touch.
    skin: f64,
    pub(super) state: State,
    placed: Vec<Placed>,
    shares: Vec<Vec<Share>>,
    loads: Vec<Load>,
}

/// What a bed must keep to go on as if it had never been stopped.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(super) struct State {
    pub(super) steps: u64,
    /// Looks in a row at which the bed was at rest.
    pub(super) quiet: u32,
    pub(super) bodies: Vec<Body>,
    /// The bodies when the links were listed.
    listed: Vec<Body>,
    pub(super) links: Vec<Link>,
    pub(super) wall_links: Vec<Link>,
}

/// A link of a body, and which side of it the body is.
#[derive(Debug, Clone, Copy)]
enum Share {
    First(usize),
    Other(usize),
    Wall(usize),
}

impl Bed {
    /// A loose column of grains, as many of each kind as its share says, above the floor and above a mesh, in metres,
    /// which is a wall too.
    ///
    /// # Errors
    /// [`BedError`].
    pub fn new(
        settings: BedSettings,
        kinds: Vec<GrainKind>,
        shares: &[f64],
        mesh: Option<&Mesh>,
    ) -> Result<Self, BedError> {
        Ok(Self::loose(settings, kinds, shares, mesh)?.begun())
    }

    /// The same for another engine: no touches are looked for, and no memory is taken for them.
    ///
    /// # Errors
    /// [`BedError`].
    pub fn loose(
        settings: BedSettings,
        kinds: Vec<GrainKind>,
        shares: &[f64],
        mesh: Option<&Mesh>,
    ) -> Result<Self, BedError> {
        settings.check()?;
        let top = mesh.into_iter().flat_map(|mesh| &mesh.vertices);
        let floor = top.map(|vertex| vertex.z).fold(0.0, f64::max);
        let bodies = loose_column(&settings, &kinds, shares, floor)?;
        let walls = settings.walls(mesh)?;
        Self::of(settings, kinds, walls, bodies)
    }

    /// A bed of bodies that are where they are, at rest or moving.
    pub(super) fn of(
        settings: BedSettings,
        kinds: Vec<GrainKind>,
        walls: Vec<Wall>,
        bodies: Vec<Body>,
    ) -> Result<Self, BedError> {
        let state = State {
            steps: 0,
            quiet: 0,
            listed: bodies.clone(),
            bodies,
            links: Vec::new(),
            wall_links: Vec::new(),
        };
        Self::with_state(settings, kinds, walls, state)
    }

    /// The bed with what touches and acts at its first step.
    pub(super) fn begun(mut self) -> Self {
        self.list();
        self.place();
        self.touch();
        self.sum();
        self
    }

    /// The bed with its grains where another engine left them.
    pub fn moved(mut self, bodies: Vec<Body>) -> Self {
        self.state.bodies = bodies;
        self
    }

    /// The same bed at another time; `None` if the state is not one of its.
    pub(super) fn resumed(self, state: State) -> Option<Self> {
        let order = |bodies: &[Body]| bodies.iter().map(|body| body.kind).collect::<Vec<_>>();
        let own = order(&self.state.bodies);
        let has_part = |grain: u32, part: u16| {
            let kind = own.get(grain as usize).map(|&kind| &self.kinds[kind]);
            kind.is_some_and(|kind| usize::from(part) < kind.parts.len())
        };
        let grains = state.links.iter().all(|Link { key, .. }| {
            has_part(key.first, key.part) && has_part(key.other, key.other_part)
        });
        let walls = state.wall_links.iter().all(|Link { key, .. }| {
            has_part(key.first, key.part) && (key.other as usize) < self.walls.len()
        });
        let is_own = order(&state.bodies) == own && order(&state.listed) == own && grains && walls;
        match is_own {
            true => Self::with_state(self.settings, self.kinds, self.walls, state).ok(),
            false => None,
        }
    }

    /// A bed that goes on from a state.
    fn with_state(
        settings: BedSettings,
        kinds: Vec<GrainKind>,
        walls: Vec<Wall>,
        state: State,
    ) -> Result<Self, BedError> {
        let still = Motion {
            centre: Point3::origin(),
            velocity: Vector3::zeros(),
            spin: Vector3::zeros(),
        };
        let placed = state.bodies.iter().map(|_| Placed {
            motion: still,
            turned: 0.0,
            frames: Vec::new(),
        });
        let mut bed = Self {
            law: settings.law()?,
            step: settings.step(&kinds),
            skin: skin(&kinds, &state.bodies),
            placed: placed.collect(),
            shares: Vec::new(),
            loads: vec![Load::default(); state.bodies.len()],
            settings,
            kinds,
            walls,
            state,
        };
        bed.share();
        bed.sum();
        Ok(bed)
    }

    /// What was asked for.
    pub fn settings(&self) -> &BedSettings {
        &self.settings
    }

    /// The kinds of grains.
    pub fn kinds(&self) -> &[GrainKind] {
        &self.kinds
    }

    /// The grains.
    pub fn bodies(&self) -> &[Body] {
        &self.state.bodies
    }

    /// Two corners of the box that holds the container and all grains, in metres.
    pub(super) fn extent(&self) -> [Vector3<f64>; 2] {
        let top = self.state.bodies.iter().map(|body| {
            let reach = self.kinds[body.kind].reach;
            body.position.z + reach
        });
        let top = top.fold(0.0, f64::max);
        match self.settings.container {
            Container::Box([width, depth]) => [Vector3::zeros(), Vector3::new(width, depth, top)],
            Container::Cylinder(radius) => [
                Vector3::new(-radius, -radius, 0.0),
                Vector3::new(radius, radius, top),
            ],
        }
    }

    /// Steps so far.
    pub fn steps(&self) -> u64 {
        self.state.steps
    }

    /// Simulated time so far, in seconds.
    pub fn seconds(&self) -> f64 {
        self.state.steps as f64 * self.step
    }

    /// Seconds of a step.
    pub fn step_seconds(&self) -> f64 {
        self.step
    }

    /// Kinetic energy per grain, as a share of the mean m g d of its weight times its diameter.
    pub fn liveliness(&self) -> f64 {
        let (mut energy, mut scale) = (0.0, 0.0);
        for body in &self.state.bodies {
            let kind = &self.kinds[body.kind];
            energy += body.kinetic_energy(kind);
            scale += kind.mass * self.settings.gravity * 2.0 * kind.radius;
        }
        energy / scale
    }

    /// Kinetic energy, that of height, and that of touches without friction and damping, in joules.
    #[cfg(test)]
    pub(super) fn energy(&self) -> f64 {
        let bodies = self.state.bodies.iter().map(|body| {
            let kind = &self.kinds[body.kind];
            body.kinetic_energy(kind) + kind.mass * self.settings.gravity * body.position.z
        });
        let links = self.state.links.iter().chain(&self.state.wall_links);
        // The work of Hertz's force is 2/5 of force times overlap.
        let touches = links.filter_map(|link| link.touch);
        let stored = touches.map(|touch| 0.4 * touch.force.norm() * touch.overlap);
        bodies.sum::<f64>() + stored.sum::<f64>()
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
        self.place();
        self.touch();
        self.sum();
        let kinds = &self.kinds;
        let bodies = self.state.bodies.par_iter_mut().zip(&self.loads);
        bodies.with_min_len(LEAST_BODIES).for_each(|(body, load)| {
            body.kick(&kinds[body.kind], load, 0.5 * step);
        });
        self.state.steps += 1;
    }

    /// Whether a part may have moved by half a skin since pairs were listed.
    fn is_outdated(&self) -> bool {
        let bodies = self.state.bodies.iter().zip(&self.state.listed);
        bodies
            .into_iter()
            .any(|(body, before)| body.moved(before, self.kinds[body.kind].arm) > 0.5 * self.skin)
    }

    /// Lists the pairs that may touch.
    fn list(&mut self) {
        let State {
            bodies,
            listed,
            links,
            wall_links,
            ..
        } = &mut self.state;
        let around = Neighbourhood {
            kinds: &self.kinds,
            walls: &self.walls,
            bodies,
            skin: self.skin,
        };
        *links = around.grain_links(links);
        *wall_links = around.wall_links(wall_links);
        listed.clone_from(bodies);
        self.share();
    }

    /// Tells each body its links.
    fn share(&mut self) {
        let mut shares = vec![Vec::new(); self.state.bodies.len()];
        for (at, link) in self.state.links.iter().enumerate() {
            shares[link.key.first as usize].push(Share::First(at));
            shares[link.key.other as usize].push(Share::Other(at));
        }
        for (at, link) in self.state.wall_links.iter().enumerate() {
            shares[link.key.first as usize].push(Share::Wall(at));
        }
        self.shares = shares;
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
        let State {
            bodies,
            links,
            wall_links,
            ..
        } = &mut self.state;
        let field = Field {
            kinds: &self.kinds,
            walls: &self.walls,
            bodies,
            placed: &self.placed,
            law: &self.law,
            step: self.step,
        };
        let pair = |one: &Link, other: &Link| {
            one.key.first == other.key.first && one.key.other == other.key.other
        };
        links
            .par_chunk_by_mut(pair)
            .for_each(|links| field.act_between(links));
        // Triangles beside each other may be touched at one place.
        wall_links
            .par_chunk_by_mut(|one, other| one.key.first == other.key.first)
            .for_each(|links| field.act_on_walls(links));
    }

    /// Adds up the loads of all bodies, of each in the order of its links.
    fn sum(&mut self) {
        let State {
            bodies,
            links,
            wall_links,
            ..
        } = &self.state;
        let weight = Vector3::new(0.0, 0.0, -self.settings.gravity);
        let loads = self.loads.par_iter_mut().zip(&self.shares).zip(bodies);
        let loads = loads.with_min_len(LEAST_BODIES);
        loads.for_each(|((load, shares), body)| {
            *load = Load {
                force: weight * self.kinds[body.kind].mass,
                moment: Vector3::zeros(),
            };
            for share in shares {
                let (link, sign) = match share {
                    Share::First(at) => (&links[*at], 1.0),
                    Share::Other(at) => (&links[*at], -1.0),
                    Share::Wall(at) => (&wall_links[*at], 1.0),
                };
                if let Some(touch) = &link.touch {
                    let force = touch.force * sign;
                    load.force += force;
                    load.moment += (touch.point - body.position).cross(&force);
                    load.moment += touch.moment * sign;
                }
            }
        });
    }
}
