//! A grain as LAMMPS takes superellipsoids.

use crate::engines::kind::Kind;
use crate::measure::superquadric_properties;
use crate::model::Superquadric;
use nalgebra::{Rotation3, UnitQuaternion};

/// Exponents below this are refused by LAMMPS.
const LEAST_EXPONENT: f64 = 2.0;

/// A kind of grain as a superellipsoid of LAMMPS, whose exponents are two at least.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Superellipsoid {
    /// The shape, in metres along its own axes: that of the grain, with exponents below two raised to two.
    pub(super) shape: Superquadric,
    /// What turns its own axes to those of the kind.
    pub(super) turn: UnitQuaternion<f64>,
    /// The density that gives it the mass of the grain, in kg/m³.
    pub(super) density: f64,
    /// By which share of the grain's volume raised exponents make it larger; zero where none was raised.
    pub(super) swelling: f64,
}

impl Superellipsoid {
    /// `None` of a kind that is not one superquadric of equal octants.
    pub(super) fn of(kind: &Kind) -> Option<Self> {
        let own = kind.superquadric?;
        let [n1, n2] = [own.n1()[0], own.n2()[0][0]].map(|n| n.max(LEAST_EXPONENT));
        let shape = Superquadric::single(own.semi_axes().map(|sides| sides[0]), n1, n2).ok()?;
        let properties = superquadric_properties(&own).properties;
        let axes = properties.principal()?.axes;
        let volume = superquadric_properties(&shape).properties.volume;
        Some(Self {
            shape,
            turn: Rotation3::from_matrix_unchecked(axes.transpose()).into(),
            density: kind.mass / volume,
            swelling: volume / properties.volume - 1.0,
        })
    }
}
