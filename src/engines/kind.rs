//! A kind of grain as engines take it.

use crate::clump::Clump;
use crate::digits::given;
use crate::measure::{Ball, MassProperties};
use crate::model::Superquadric;
use nalgebra::{Matrix3, Point3, UnitQuaternion, Vector3};

/// A kind of grain in SI units: a clump about the grain's centre of mass, along its principal axes, so that the moments
/// of inertia say all of the inertia.
#[derive(Debug, Clone, PartialEq)]
pub struct Kind {
    /// What files and comments call it: letters, digits, `_` and `-`.
    pub name: String,
    /// Its spheres, in metres.
    pub spheres: Vec<Ball>,
    /// Mass of the grain, in kg.
    pub mass: f64,
    /// Principal moments of inertia of the grain about its centre of mass, ascending, in kg m².
    pub moments: Vector3<f64>,
    /// The grain as one superquadric of equal octants, if it is fitted as one, in metres along its own axes.
    pub superquadric: Option<Superquadric>,
    /// What is not to be relied on of it: whole sentences.
    pub doubts: Vec<String>,
}

/// Why a clump is no [`Kind`].
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum InvalidKind {
    /// The density is not above zero, or not finite.
    #[error("the density must be a finite number above zero, not {} kg/m³", given(*found))]
    Density {
        /// The density given.
        found: f64,
    },
    /// It has no spheres.
    #[error("it has no spheres")]
    NoSpheres,
    /// Mass, moments or radii are not finite numbers above zero at this unit of length, or a centre is not finite.
    #[error("its mass, moments of inertia or lengths are out of range in SI units")]
    OutOfRange,
}

impl Kind {
    /// A clump whose unit of length is so many `metres`, of a `density` in kg/m³.
    ///
    /// # Errors
    ///
    /// [`InvalidKind`].
    pub fn new(name: &str, clump: &Clump, metres: f64, density: f64) -> Result<Self, InvalidKind> {
        // Written so that NaN fails.
        if !(density > 0.0 && density.is_finite()) {
            return Err(InvalidKind::Density { found: density });
        }
        let MassProperties {
            volume, centroid, ..
        } = clump.grain;
        let principal = clump.grain.principal().ok_or(InvalidKind::OutOfRange)?;
        let own = |ball: &Ball| Ball {
            centre: Point3::from(principal.axes.tr_mul(&(ball.centre - centroid)) * metres),
            radius: ball.radius * metres,
        };
        let kind = Self {
            name: plain(name),
            spheres: clump.spheres.iter().map(own).collect(),
            mass: density * volume * metres.powi(3),
            moments: principal.moments * (density * metres.powi(5)),
            superquadric: None,
            doubts: Vec::new(),
        };
        kind.check()?;
        Ok(kind)
    }

    /// Refuses what no engine can take.
    pub(super) fn check(&self) -> Result<(), InvalidKind> {
        if self.spheres.is_empty() {
            return Err(InvalidKind::NoSpheres);
        }
        let spheres = self.spheres.iter().map(|ball| ball.radius);
        let superquadric = self.superquadric.iter().map(Superquadric::bounding_radius);
        // The box that grains fall into is made by their volume, and has one.
        let mut above_zero = [self.mass, self.bounding_radius().powi(3)]
            .into_iter()
            .chain(self.moments.iter().copied())
            .chain(spheres)
            .chain(superquadric);
        let mut distances = self.spheres.iter().map(|ball| ball.centre.coords.norm());
        let is_fit = above_zero.all(|x| x.is_normal() && x > 0.0) && distances.all(f64::is_finite);
        match is_fit {
            true => Ok(()),
            false => Err(InvalidKind::OutOfRange),
        }
    }

    /// The same grain, also as a superquadric in the unit of its clump; as it is where octants differ.
    #[must_use]
    pub fn with_superquadric(self, shape: &Superquadric, metres: f64) -> Self {
        let superquadric = shape.is_single().then(|| shape.times(metres));
        Self {
            superquadric,
            ..self
        }
    }

    /// The same grain with what is not to be relied on of it, which the folder's README tells.
    #[must_use]
    pub fn with_doubts(self, doubts: &[String]) -> Self {
        let doubts = doubts.to_vec();
        Self { doubts, ..self }
    }

    /// The radius of the ball about the centre of mass that holds all of it, as spheres and as a superquadric, in metres.
    pub fn bounding_radius(&self) -> f64 {
        let reach = |ball: &Ball| ball.centre.coords.norm() + ball.radius;
        let spheres = self.spheres.iter().map(reach);
        let superquadric = self.superquadric.iter().map(Superquadric::bounding_radius);
        spheres.chain(superquadric).fold(0.0, f64::max)
    }

    /// The radius of its smallest sphere, in metres.
    pub fn least_radius(&self) -> f64 {
        let radii = self.spheres.iter().map(|ball| ball.radius);
        radii.fold(f64::INFINITY, f64::min)
    }

    /// The inertia tensor about the centre of mass of the grain turned from its principal axes, in kg m².
    pub fn inertia(&self, turn: &UnitQuaternion<f64>) -> Matrix3<f64> {
        let turn = turn.to_rotation_matrix();
        turn * Matrix3::from_diagonal(&self.moments) * turn.transpose()
    }
}

/// A name of letters, digits, `_` and `-` only.
fn plain(name: &str) -> String {
    let plain = |letter: char| match letter.is_ascii_alphanumeric() || "_-".contains(letter) {
        true => letter,
        false => '_',
    };
    name.chars().map(plain).collect()
}
