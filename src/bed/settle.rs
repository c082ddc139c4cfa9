//! A bed: grains, walls, and how both are now.

use super::body::{Body, Load};
use super::encounter::Encounter;
use super::field::Placed;
use super::grain::GrainKind;
use super::link::Motion;
use super::neighbours::skin;
use super::settings::{BedError, BedSettings, Container};
use super::start::loose_column;
use super::wall::Wall;
use crate::contact::law::Law;
use crate::mesh::Mesh;
use nalgebra::{Point3, Vector3};
use serde::{Deserialize, Serialize};

/// Grains that fall, and lie.
#[derive(Debug, Clone)]
pub struct Bed {
    pub(super) settings: BedSettings,
    pub(super) kinds: Vec<GrainKind>,
    pub(super) walls: Vec<Wall>,
    pub(super) law: Law,
    /// Seconds of a step.
    pub(super) step: f64,
    /// Joules of motion and height at the start.
    pub(super) began_with: f64,
    /// Metres by which pairs are listed before they touch.
    pub(super) skin: f64,
    pub(super) state: State,
    pub(super) placed: Vec<Placed>,
    pub(super) shares: Vec<Vec<Share>>,
    pub(super) loads: Vec<Load>,
}

/// What a bed must keep to go on as if it had never been stopped.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(super) struct State {
    pub(super) steps: u64,
    /// Looks in a row at which the bed was at rest.
    pub(super) quiet: u32,
    pub(super) bodies: Vec<Body>,
    /// The bodies when the encounters were listed.
    pub(super) listed: Vec<Body>,
    pub(super) encounters: Vec<Encounter>,
}

/// An encounter of a body, by its number.
#[derive(Debug, Clone, Copy)]
pub(super) struct Share {
    pub(super) encounter: usize,
    pub(super) is_first: bool,
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
        settings.check_pace(&kinds)?;
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
            encounters: Vec::new(),
        };
        Self::with_state(settings, kinds, walls, state)
    }

    /// The bed with its grains, in their order, where another engine left them.
    ///
    /// # Errors
    /// [`BedError::OtherGrains`] unless they are as many and each of its kind.
    pub fn moved(mut self, bodies: Vec<Body>) -> Result<Self, BedError> {
        let own = self.state.bodies.iter().map(|body| body.kind);
        if !own.eq(bodies.iter().map(|body| body.kind)) {
            return Err(BedError::OtherGrains);
        }
        self.state.bodies = bodies;
        Ok(self)
    }

    /// A bed that goes on from a state.
    pub(super) fn with_state(
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
            began_with: 0.0,
            settings,
            kinds,
            walls,
            state,
        };
        bed.began_with = bed.energy_of(bed.bodies());
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

    /// Whether the faces of a mesh are walls too.
    pub fn has_mesh(&self) -> bool {
        let mut walls = self.walls.iter();
        walls.any(|wall| matches!(wall, Wall::Triangle { .. }))
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

    /// Energy of motion and height, as a share of that at the start: above one only where forces do not keep energy.
    pub fn energy_left(&self) -> f64 {
        self.energy_of(self.bodies()) / self.began_with
    }

    /// Kinetic energy and that of height of these grains, in joules.
    pub(super) fn energy_of(&self, bodies: &[Body]) -> f64 {
        let energies = bodies.iter().map(|body| {
            let kind = &self.kinds[body.kind];
            body.kinetic_energy(kind) + kind.mass * self.settings.gravity * body.position.z
        });
        energies.sum()
    }

    /// The same of the bed, and that of touches without friction and damping.
    #[cfg(test)]
    pub(super) fn energy(&self) -> f64 {
        let encounters = self.state.encounters.iter();
        let links = encounters.flat_map(|encounter| &encounter.links);
        // The work of Hertz's force is 2/5 of force times overlap.
        let touches = links.filter_map(|link| link.touch);
        let stored = touches.map(|touch| 0.4 * touch.force.norm() * touch.overlap);
        self.energy_of(self.bodies()) + stored.sum::<f64>()
    }
}
