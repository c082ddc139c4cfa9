//! What an engine is to do: grains in a column above a box, which fall and come to rest.

use super::error::InvalidDeck;
use super::kind::Kind;
use super::material::GrainMaterial;
use crate::bed::{Bed, Container, check_pace};
use crate::measure::equivalent_radius;
use nalgebra::{Quaternion, UnitQuaternion, Vector3};
use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, StandardNormal};
use std::f64::consts::PI;

/// The acceleration of gravity, in m/s².
pub const GRAVITY: f64 = 9.81;

/// Share of the box's volume that settled grains are taken to fill, for its size only.
const FILLED: f64 = 0.55;

/// Least distance of grains at the start beside the balls that hold them.
const APART: f64 = 1.02;

/// Least width of a box, in balls that hold a grain.
const LEAST_WIDTH: f64 = 3.0;

/// Share of the time that a Rayleigh wave takes through the smallest sphere.
const TIME_STEP: f64 = 0.2;

/// So many times the time of the fall are run at most.
const MOST_FALLS: f64 = 40.0;

/// Simulated seconds between two frames; a run has so many at least.
const FRAME: f64 = 0.05;
const LEAST_FRAMES: f64 = 10.0;

/// Grains are at rest when their kinetic energy is below this share of what they lose in falling their own diameter.
const AT_REST: f64 = 1e-8;

/// A grain at the start.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Placed {
    /// Which of the kinds it is.
    pub kind: usize,
    /// Its centre of mass, in metres.
    pub centre: Vector3<f64>,
    /// What its principal axes are turned by from x, y, z.
    pub turn: UnitQuaternion<f64>,
    /// How fast it moves, in m/s.
    pub velocity: Vector3<f64>,
}

/// Grains in a column above a floor, z up, between upright walls.
#[derive(Debug, Clone, PartialEq)]
pub struct Deck {
    /// The kinds of grains.
    pub kinds: Vec<Kind>,
    /// The grains, the lowest first.
    pub grains: Vec<Placed>,
    /// Sides of the floor along x and y, in metres: from the origin on, or about it in a cylinder.
    pub floor: [f64; 2],
    /// Radius of an upright cylinder about the z axis that holds the grains in place of a box, in metres; for LAMMPS
    /// alone.
    pub cylinder: Option<f64>,
    /// Height of the column, in metres.
    pub height: f64,
    /// What they are made of.
    pub material: GrainMaterial,
    /// Kinetic energy of all grains below which they are at rest, as a share of what they lose in falling their own
    /// diameter.
    pub rest: f64,
    /// Simulated time after which the run ends in any case, in s.
    pub seconds: f64,
}

impl Deck {
    /// The most spheres of all grains.
    pub const MOST_SPHERES: usize = 20_000_000;

    /// So many grains, the kinds taken in turn, on a lattice above a square floor, as wide as they will lie high, each
    /// turned at random; the same for the same seed.
    ///
    /// # Errors
    ///
    /// [`InvalidDeck`].
    pub fn column(
        kinds: Vec<Kind>,
        count: usize,
        material: GrainMaterial,
        seed: u64,
    ) -> Result<Self, InvalidDeck> {
        check(&kinds, count, &material)?;
        let mass: f64 = (0..count).map(|i| kinds[i % kinds.len()].mass).sum();
        let radii = kinds.iter().map(Kind::bounding_radius);
        let cell = 2.0 * APART * radii.fold(0.0, f64::max);
        let side = (mass / material.density / FILLED)
            .cbrt()
            .max(LEAST_WIDTH * cell);
        let per_row = (side / cell) as usize;
        let mut random = ChaCha8Rng::seed_from_u64(seed);
        let placed = |index: usize| {
            let [i, j, k] = [
                index % per_row,
                index / per_row % per_row,
                index / per_row.saturating_mul(per_row),
            ];
            let across = |i: usize| (i as f64 + 0.5) * side / per_row as f64;
            // Four normal deviates point everywhere alike.
            let [w, x, y, z] = std::array::from_fn(|_| StandardNormal.sample(&mut random));
            Placed {
                kind: index % kinds.len(),
                centre: Vector3::new(across(i), across(j), (k as f64 + 0.5) * cell),
                turn: UnitQuaternion::new_normalize(Quaternion::new(w, x, y, z)),
                velocity: Vector3::zeros(),
            }
        };
        let grains: Vec<Placed> = (0..count).map(placed).collect();
        let height = grains[count - 1].centre.z + cell;
        let deck = Self {
            kinds,
            grains,
            floor: [side; 2],
            cylinder: None,
            height,
            material,
            rest: AT_REST,
            seconds: MOST_FALLS * (2.0 * height / GRAVITY).sqrt(),
        };
        deck.paced()
    }

    /// The bed as it is, of grains made of spheres, at the gravity of the Earth. What damps along the normal
    /// becomes the restitution that it leaves.
    ///
    /// # Errors
    ///
    /// [`InvalidDeck`].
    pub fn of_bed(bed: &Bed) -> Result<Self, InvalidDeck> {
        let settings = bed.settings();
        let (floor, cylinder) = match settings.container {
            Container::Box(sides) => (sides, None),
            Container::Cylinder(radius) => ([2.0 * radius; 2], Some(radius)),
        };
        let kinds = bed.kinds().iter().enumerate().map(|(index, kind)| {
            Ok(Kind {
                name: format!("kind_{index}"),
                spheres: kind.spheres().ok_or(InvalidDeck::NoSpheres)?,
                mass: kind.mass(),
                moments: kind.moments(),
                superquadric: None,
                doubts: Vec::new(),
            })
        });
        let kinds = kinds.collect::<Result<Vec<_>, InvalidDeck>>()?;
        let material = GrainMaterial {
            youngs_modulus: settings.youngs_modulus_pa,
            poissons_ratio: settings.poissons_ratio,
            friction: settings.friction,
            rolling_friction: settings.rolling_friction,
            restitution: settings.restitution()?,
            density: settings.density,
        };
        check(&kinds, bed.bodies().len(), &material)?;
        let grains = bed.bodies().iter().map(|body| Placed {
            kind: body.kind,
            centre: body.position.coords,
            turn: body.orientation,
            velocity: body.velocity,
        });
        let grains: Vec<Placed> = grains.collect();
        let reach = kinds.iter().map(Kind::bounding_radius);
        let reach = reach.fold(0.0, f64::max);
        let top = grains.iter().map(|grain| grain.centre.z);
        let deck = Self {
            height: top.fold(0.0, f64::max) + 2.0 * reach,
            kinds,
            grains,
            floor,
            cylinder,
            material,
            rest: settings.rest,
            seconds: settings.most_seconds,
        };
        deck.paced()
    }

    /// The deck, if its steps are neither too many nor too long.
    fn paced(self) -> Result<Self, InvalidDeck> {
        let (step, radius) = (self.time_step(), self.least_radius());
        check_pace(step, radius, GRAVITY, self.seconds)?;
        Ok(self)
    }

    /// The time step, in s: a fifth of the time that a Rayleigh wave takes across the smallest sphere,
    /// pi r sqrt(rho / G) / (0.1631 nu + 0.8766) with G the shear modulus.
    pub fn time_step(&self) -> f64 {
        let GrainMaterial {
            youngs_modulus,
            poissons_ratio,
            density,
            ..
        } = self.material;
        let shear = youngs_modulus / (2.0 * (1.0 + poissons_ratio));
        let wave = (shear / density).sqrt() * (0.1631 * poissons_ratio + 0.8766);
        TIME_STEP * PI * self.least_radius() / wave
    }

    /// The most steps that are run.
    pub fn most_steps(&self) -> u64 {
        (self.seconds / self.time_step()).ceil() as u64
    }

    /// Simulated seconds between two frames of a run.
    pub(super) fn frame(&self) -> f64 {
        FRAME.min(self.seconds / LEAST_FRAMES)
    }

    /// How many spheres there are.
    pub fn spheres(&self) -> usize {
        let grains = self.grains.iter();
        grains
            .map(|grain| self.kinds[grain.kind].spheres.len())
            .sum()
    }

    /// How many spheres there are before those of each grain, and in all.
    pub fn first_spheres(&self) -> Vec<usize> {
        let spheres = |grain: &Placed| self.kinds[grain.kind].spheres.len();
        let mut sum = 0;
        let ends = self.grains.iter().map(|grain| {
            sum += spheres(grain);
            sum
        });
        [0].into_iter().chain(ends).collect()
    }

    /// The time in which the topmost grain has fallen, in s.
    pub fn fall(&self) -> f64 {
        (2.0 * self.height / GRAVITY).sqrt()
    }

    /// The kinetic energy, in J, below which all grains together are at rest: a share of what they lose in falling
    /// their own diameter.
    pub fn rest_energy(&self) -> f64 {
        let lost = |grain: &Placed| {
            let mass = self.kinds[grain.kind].mass;
            mass * GRAVITY * self.equal_diameter(mass)
        };
        self.rest * self.grains.iter().map(lost).sum::<f64>()
    }

    /// The diameter of the ball of a mass in kilograms, in metres.
    pub fn equal_diameter(&self, mass: f64) -> f64 {
        2.0 * equivalent_radius(mass / self.material.density)
    }

    /// How often a step goes into that of the smallest grain as one ball, which is larger than its spheres.
    pub fn steps_of_a_grain(&self) -> f64 {
        let masses = self.kinds.iter().map(|kind| kind.mass);
        let least = masses.fold(f64::INFINITY, f64::min);
        0.5 * self.equal_diameter(least) / self.least_radius()
    }

    /// The radius of the smallest sphere, in metres.
    pub fn least_radius(&self) -> f64 {
        let radii = self.kinds.iter().map(Kind::least_radius);
        radii.fold(f64::INFINITY, f64::min)
    }

    /// The diameter of the largest ball that holds a grain, in metres.
    pub fn largest_diameter(&self) -> f64 {
        let radii = self.kinds.iter().map(Kind::bounding_radius);
        2.0 * radii.fold(0.0, f64::max)
    }
}

/// Refuses what no deck can be made of.
fn check(kinds: &[Kind], count: usize, material: &GrainMaterial) -> Result<(), InvalidDeck> {
    material.check()?;
    if count == 0 || kinds.is_empty() {
        return Err(InvalidDeck::NoGrains);
    }
    kinds.iter().try_for_each(Kind::check)?;
    let most = kinds.iter().map(|kind| kind.spheres.len()).max();
    if count.saturating_mul(most.unwrap_or(0)) > Deck::MOST_SPHERES {
        return Err(InvalidDeck::TooMany {
            grains: count,
            most: Deck::MOST_SPHERES,
        });
    }
    let is_twin =
        |(index, kind): (usize, &Kind)| kinds[..index].iter().any(|other| other.name == kind.name);
    match kinds.iter().enumerate().any(is_twin) {
        true => Err(InvalidDeck::SameName),
        false => Ok(()),
    }
}
