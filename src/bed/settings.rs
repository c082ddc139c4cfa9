//! What a bed is asked for.

use super::grain::{GrainError, GrainKind};
use super::pace::{PaceError, check_pace};
use super::wall::Wall;
use crate::contact::law::{Friction, Law, LawError};
use crate::contact::{Material, MaterialError};
use crate::digits::{given, significant};
use crate::mesh::Mesh;
use nalgebra::{Point3, Vector3};
use serde::{Deserialize, Serialize};
use std::f64::consts::PI;
use std::ops::RangeInclusive;

/// Numbers of grains that a bed can have.
pub const BED_GRAINS: RangeInclusive<usize> = 1..=1_000_000;

/// A step as a share of the time that a Rayleigh wave takes through the smallest grain.
const STEP: f64 = 0.2;

/// Most damping along the normal, three times what is critical: with 3 beds settle, with 10 each step of [`STEP`] sends grains
/// back faster than they came.
const MOST_DAMPING: f64 = 3.0;

/// Most triangles of a wall.
const MOST_TRIANGLES: usize = 100_000;

/// What grains are dropped into: upright walls without end on a floor at z = 0.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Container {
    /// x from 0 to the first length, y from 0 to the second, in metres.
    Box([f64; 2]),
    /// About the z axis, of this radius in metres.
    Cylinder(f64),
}

/// All but the shapes of the grains, in SI units. The defaults of the material are assumed: the letter's table of them
/// is lost.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct BedSettings {
    /// How many, within [`BED_GRAINS`].
    pub grains: usize,
    /// What they are dropped into.
    pub container: Container,
    /// Density of the grains, in kg/m³.
    pub density: f64,
    /// Young's modulus of grains and walls, in pascals.
    pub youngs_modulus_pa: f64,
    /// Poisson's ratio of both.
    pub poissons_ratio: f64,
    /// mu, of grains and walls.
    pub friction: f64,
    /// mu_r, likewise.
    pub rolling_friction: f64,
    /// c_n, at most 3, and c_t, likewise.
    pub damping: [f64; 2],
    /// Downwards, in m/s².
    pub gravity: f64,
    /// Kinetic energy per grain below which the bed is at rest, as a share of m g d.
    pub rest: f64,
    /// Simulated time after which the bed ends in any case, in seconds.
    pub most_seconds: f64,
    /// Seed of places, headings and order of the grains.
    pub seed: u64,
}

impl Default for BedSettings {
    fn default() -> Self {
        Self {
            grains: 1500,
            container: Container::Box([0.06; 2]),
            density: 2500.0,
            youngs_modulus_pa: 1e7,
            poissons_ratio: 0.3,
            friction: 0.3,
            rolling_friction: 0.0,
            damping: [0.2; 2],
            gravity: 9.81,
            rest: 1e-5,
            most_seconds: 5.0,
            seed: 0,
        }
    }
}

/// Why a bed cannot be made or does not go on.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum BedError {
    /// The number of grains.
    #[error("a bed has from {} to {} grains, not {grains}", BED_GRAINS.start(), BED_GRAINS.end())]
    Grains {
        /// The number given.
        grains: usize,
    },
    /// A number that is out of its range.
    #[error("{what} must be {range}, not {}", given(*value))]
    Number {
        /// What it is.
        what: &'static str,
        /// What it may be.
        range: &'static str,
        /// The value given.
        value: f64,
    },
    /// No grain fits.
    #[error("the container is too narrow: a grain is up to {} m wide", significant(*widest, 4))]
    Narrow {
        /// Twice the largest reach of a grain, in metres.
        widest: f64,
    },
    /// A wall of too many triangles.
    #[error("the wall has {found} triangles; at most {most} are taken")]
    Triangles {
        /// Triangles given.
        found: usize,
        /// The most allowed.
        most: usize,
    },
    /// A wall that names a vertex that does not exist.
    #[error("a triangle of the wall names vertex {vertex}, which it does not have")]
    NoSuchVertex {
        /// The number of the vertex, from zero.
        vertex: u32,
    },
    /// No shapes, or none that has a share.
    #[error("a bed needs a grain whose share is above zero")]
    NoKinds,
    /// Shapes without a share, or shares without a shape.
    #[error("a bed takes one share per shape, and there are {shares} for {kinds}")]
    Shares {
        /// Shapes given.
        kinds: usize,
        /// Shares given.
        shares: usize,
    },
    /// Grains of another bed.
    #[error("the grains that were moved are not those of the bed")]
    OtherGrains,
    /// A grain.
    #[error(transparent)]
    Grain(#[from] GrainError),
    /// The material.
    #[error(transparent)]
    Material(#[from] MaterialError),
    /// The surface.
    #[error(transparent)]
    Law(#[from] LawError),
    /// Steps that are too many or too long.
    #[error(transparent)]
    Pace(#[from] PaceError),
    /// Positions that are not finite.
    #[error(
        "the motion ran away after {} s: the step is too long for these grains",
        significant(*seconds, 3)
    )]
    Unstable {
        /// Simulated time, in seconds.
        seconds: f64,
    },
}

impl BedSettings {
    /// Refuses what no bed can be made of.
    pub(super) fn check(&self) -> Result<(), BedError> {
        if !BED_GRAINS.contains(&self.grains) {
            let grains = self.grains;
            return Err(BedError::Grains { grains });
        }
        let sides = match self.container {
            Container::Box(sides) => sides,
            Container::Cylinder(radius) => [radius; 2],
        };
        let above_zero = |what, value: f64| {
            // Written so that NaN fails.
            let is_fit = value > 0.0 && value.is_finite();
            (what, "a finite number above zero", value, is_fit)
        };
        let [nu, mu, mu_r] = [self.poissons_ratio, self.friction, self.rolling_friction];
        let zero_or_above = |what, value: f64| {
            let is_fit = value >= 0.0 && value.is_finite();
            (what, "a finite number, zero or above", value, is_fit)
        };
        let checks = [
            above_zero("the width of the container", sides[0]),
            above_zero("the depth of the container", sides[1]),
            above_zero("the density", self.density),
            above_zero("Young's modulus", self.youngs_modulus_pa),
            // At -1 a body gives no way at all.
            (
                "Poisson's ratio",
                "above -1 and at most 0.5",
                nu,
                nu > -1.0 && nu <= 0.5,
            ),
            zero_or_above("the coefficient of friction", mu),
            zero_or_above("the coefficient of rolling friction", mu_r),
            (
                "the damping along the normal",
                "from 0 to 3",
                self.damping[0],
                (0.0..=MOST_DAMPING).contains(&self.damping[0]),
            ),
            zero_or_above("the damping across the normal", self.damping[1]),
            above_zero("the gravity", self.gravity),
            // More is a bed that moves.
            (
                "the share of energy at rest",
                "above 0 and at most 0.01",
                self.rest,
                self.rest > 0.0 && self.rest <= 0.01,
            ),
            above_zero("the longest time", self.most_seconds),
        ];
        match checks.into_iter().find(|check| !check.3) {
            Some((what, range, value, _)) => Err(BedError::Number { what, range, value }),
            None => Ok(()),
        }
    }

    /// Refuses steps that are too many or too long for these grains.
    pub(super) fn check_pace(&self, kinds: &[GrainKind]) -> Result<(), BedError> {
        let (step, radius) = (self.step(kinds), smallest(kinds));
        Ok(check_pace(step, radius, self.gravity, self.most_seconds)?)
    }

    /// The share of its velocity that a grain keeps in a head-on impact without friction.
    ///
    /// # Errors
    /// [`BedError`] if there is no law of such a material.
    pub fn restitution(&self) -> Result<f64, BedError> {
        Ok(self.law()?.restitution())
    }

    /// The law of all contacts: walls are of the grains' material.
    pub(super) fn law(&self) -> Result<Law, BedError> {
        let material = Material::new(self.youngs_modulus_pa, self.poissons_ratio)?;
        let surface = Friction {
            sliding: self.friction,
            rolling: self.rolling_friction,
            normal_damping: self.damping[0],
            tangential_damping: self.damping[1],
        };
        Ok(Law::new(&material, &material, surface)?)
    }

    /// The length of a step: a fifth of the time pi R sqrt(rho/G) / (0.1631 nu + 0.8766) that a Rayleigh wave takes
    /// through the smallest grain (Li and others 2005), in seconds.
    pub(super) fn step(&self, kinds: &[GrainKind]) -> f64 {
        let shear_modulus = self.youngs_modulus_pa / (2.0 * (1.0 + self.poissons_ratio));
        let wave = PI * smallest(kinds) * (self.density / shear_modulus).sqrt();
        STEP * wave / (0.1631 * self.poissons_ratio + 0.8766)
    }

    /// The walls of the container, its floor, and the triangles of a mesh in metres.
    pub(super) fn walls(&self, mesh: Option<&Mesh>) -> Result<Vec<Wall>, BedError> {
        let plane = |x: f64, y: f64, normal| Wall::Plane {
            point: Point3::new(x, y, 0.0),
            normal,
        };
        let mut walls = vec![plane(0.0, 0.0, Vector3::z_axis())];
        match self.container {
            Container::Box([width, depth]) => walls.extend([
                plane(0.0, 0.0, Vector3::x_axis()),
                plane(width, 0.0, -Vector3::x_axis()),
                plane(0.0, 0.0, Vector3::y_axis()),
                plane(0.0, depth, -Vector3::y_axis()),
            ]),
            Container::Cylinder(radius) => walls.push(Wall::Cylinder { radius }),
        }
        if let Some(mesh) = mesh {
            let found = mesh.triangles.len();
            if found > MOST_TRIANGLES {
                return Err(BedError::Triangles {
                    found,
                    most: MOST_TRIANGLES,
                });
            }
            for corners in &mesh.triangles {
                let vertex = |vertex: u32| {
                    let found = mesh.vertices.get(vertex as usize);
                    found.copied().ok_or(BedError::NoSuchVertex { vertex })
                };
                let [a, b, c] = *corners;
                walls.push(Wall::Triangle {
                    corners: [vertex(a)?, vertex(b)?, vertex(c)?],
                });
            }
        }
        Ok(walls)
    }
}

/// The radius of the smallest grain, in metres.
fn smallest(kinds: &[GrainKind]) -> f64 {
    let radii = kinds.iter().map(GrainKind::radius);
    radii.fold(f64::INFINITY, f64::min)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::bed::Bed;
    use crate::bed::tests::few;

    #[test]
    fn damping_that_makes_beds_run_away_is_refused() {
        let refused = |damping: f64| {
            let (settings, kinds) = few(BedSettings {
                damping: [damping, 0.2],
                ..BedSettings::default()
            });
            Bed::new(settings, kinds, &[1.0, 1.0], None).is_err()
        };
        assert!(!refused(3.0));
        assert!([10.0, 1e17, f64::NAN].into_iter().all(refused));
    }
}
