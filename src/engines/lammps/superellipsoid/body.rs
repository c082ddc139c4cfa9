//! A grain as LAMMPS takes superellipsoids.

use crate::engines::kind::Kind;
use crate::measure::superquadric_properties;
use crate::model::Superquadric;
use nalgebra::{Rotation3, UnitQuaternion};

/// Exponents below this are refused by LAMMPS.
const LEAST_EXPONENT: f64 = 2.0;

/// A body as a superellipsoid of LAMMPS, whose exponents are two at least.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Superellipsoid {
    /// Along its own axes, in metres.
    pub(super) semi_axes: [f64; 3],
    /// n1 and n2, as a [`Superquadric`] has them.
    pub(super) exponents: [f64; 2],
    /// What turns its own axes to those of the kind.
    pub(super) turn: UnitQuaternion<f64>,
    /// In kg/m³.
    pub(super) density: f64,
    /// By which share of the grain's volume raised exponents make it larger; zero where none was raised.
    pub(super) swelling: f64,
}

impl Superellipsoid {
    /// A kind of grain, of its mass, with exponents below two raised to two; `None` where it is not one superquadric of
    /// equal octants.
    pub(super) fn of(kind: &Kind) -> Option<Self> {
        let own = kind.superquadric?;
        let semi_axes = own.semi_axes().map(|sides| sides[0]);
        let exponents = [own.n1()[0], own.n2()[0][0]].map(|n| n.max(LEAST_EXPONENT));
        let raised = Superquadric::single(semi_axes, exponents[0], exponents[1]).ok()?;
        let [own, raised] = [own, raised].map(|body| superquadric_properties(&body).properties);
        let axes = own.principal()?.axes;
        Some(Self {
            semi_axes,
            exponents,
            turn: Rotation3::from_matrix_unchecked(axes.transpose()).into(),
            density: kind.mass / raised.volume,
            swelling: raised.volume / own.volume - 1.0,
        })
    }
}
