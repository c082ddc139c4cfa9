//! Grains as engines take superquadrics, which LAMMPS calls superellipsoids: with exponents of two at least.

use super::deck::Deck;
use super::kind::Kind;
use crate::measure::superquadric_properties;
use crate::model::Superquadric;
use nalgebra::{Rotation3, UnitQuaternion};

/// Exponents below this are refused by LAMMPS and by LIGGGHTS.
const LEAST_EXPONENT: f64 = 2.0;

/// Least share of the volume that is told.
const LEAST_TOLD: f64 = 5e-5;

/// A body of the mass of a grain, whose exponents are two at least.
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

/// The kinds, where each is one superquadric of equal octants.
pub(super) fn superellipsoids(deck: &Deck) -> Option<Vec<Superellipsoid>> {
    deck.kinds.iter().map(Superellipsoid::of).collect()
}

/// Whose exponents are raised, in sentences, for bodies that the engine calls so.
pub(super) fn raised(deck: &Deck, bodies: &[Superellipsoid], called: &str) -> Vec<String> {
    let told = |(kind, body): (&Kind, &Superellipsoid)| {
        (body.swelling >= LEAST_TOLD).then(|| {
            format!(
                "Exponents of {} below 2 are raised to 2 for {called}: {:.2} % more volume, the same mass, the inertia of that \
                 shape.",
                kind.name,
                100.0 * body.swelling
            )
        })
    };
    deck.kinds.iter().zip(bodies).filter_map(told).collect()
}
