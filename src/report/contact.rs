//! What `grainform contact` tells.

use super::escape::escaped;
use super::number::{PLACED_TO, place, short, with_error};
use crate::contact::{
    ContactError, Correction, Curved, KnownContact, RelativeCurvature, Touch, reach,
};
use crate::digits::significant;
use crate::model::{Grain, PositionGrain, StarGrain, Surface};
use crate::unit::Unit;
use nalgebra::{Vector2, Vector3};
use serde::Serialize;
use std::fmt;

/// The contact of a grain with a plane, or with another grain.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[non_exhaustive]
pub struct ContactReport {
    /// Unit of the scans' lengths.
    pub unit: Unit,
    /// The body that is touched.
    pub first: TouchRecord,
    /// The other body; absent where it is a plane.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub second: Option<TouchRecord>,
    /// A, the larger of the coefficients of the gap A x² + B y² between the surfaces, in one over the unit: half of its larger
    /// curvature.
    pub larger_curvature: f64,
    /// B, the smaller of them.
    pub smaller_curvature: f64,
    /// Effective radius 1 / (2 sqrt(A B)).
    pub effective_radius: f64,
    /// Its standard error; `null`, as those of force and stiffness, where that of a curvature is not known.
    pub effective_radius_error: Option<f64>,
    /// Correction for a patch that is not round.
    pub correction: f64,
    /// Effective modulus, in pascals.
    pub effective_modulus_pa: f64,
    /// Indentation, in micrometres.
    pub indentation_um: f64,
    /// Normal force, in newtons.
    pub normal_force_n: f64,
    /// Its standard error, from those of the curvatures.
    pub normal_force_error_n: Option<f64>,
    /// Stiffness, in newtons per metre.
    pub normal_stiffness_n_per_m: f64,
    /// Its standard error.
    pub normal_stiffness_error_n_per_m: Option<f64>,
    /// What to know of these figures.
    pub warnings: Vec<String>,
}

/// Where and how curved a body is touched.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[non_exhaustive]
pub struct TouchRecord {
    /// The model.
    pub input: String,
    /// The point, in the scan's frame.
    pub point: [f64; 3],
    /// Standard error of where the surface is there, along its normal; `null` where it is not known.
    pub point_error: Option<f64>,
    /// The direction in which it is touched: the outward normal.
    pub normal: [f64; 3],
    /// Principal curvatures, the larger first, in one over the unit.
    pub principal_curvatures: [f64; 2],
    /// Their standard error; `null` where it is not known: of fits to the points themselves, and of rounded edges.
    pub curvature_error: Option<f64>,
    /// Radius of the cap by which an edge was rounded.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub edge_radius: Option<f64>,
    /// How far the body reaches from its centre.
    #[serde(skip)]
    pub reach: f64,
    /// Whether its model is one expansion of the whole sphere.
    #[serde(skip)]
    pub is_whole: bool,
}

/// What a contact is loaded with.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct Load {
    /// The unit of the scans' lengths.
    pub unit: Unit,
    /// Effective modulus, in pascals.
    pub effective_modulus_pa: f64,
    /// Indentation, in micrometres.
    pub indentation_um: f64,
}

/// Share of the smaller radius up to which Hertz's theory holds.
const HERTZIAN: f64 = 0.1;

/// A force that is known less well than to this share is told of.
const UNCERTAIN: f64 = 0.1;

/// What a depth is compared with where both bodies' curvatures are known.
const CURVED: &str = "smaller radius of curvature of the gap between the bodies";

/// The share of a body up to which a contact is small beside it: that of a ball that is pressed in by [`HERTZIAN`].
const SMALL: f64 = 0.45;

/// What to know of an indentation by Hertz, in the unit of the surfaces, of bodies of which the smaller reaches `body`.
///
/// # Errors
///
/// [`ContactError::Flat`], see [`RelativeCurvature::reach`].
pub(super) fn beside_hertz(
    what: &str,
    relative: &RelativeCurvature,
    indentation: f64,
    body: f64,
) -> Result<Vec<String>, ContactError> {
    let share = relative.reach(indentation, body)? / body;
    let deep = beyond_hertz(what, indentation / relative.smaller_radius(), CURVED);
    let wide = (share > SMALL).then(|| {
        format!(
            "The contact reaches {:.0} % as far as the smaller body; Hertz's theory is for a contact that is small beside it.",
            100.0 * share
        )
    });
    Ok(deep.into_iter().chain(wide).collect())
}

/// Where the force by the gap over a contact is so many times that by its middle, or less than that by as much, the middle tells none.
const EDGE: f64 = 1.5;

/// What to know of a force that is so many `times` as large by what the contact is over all of it.
///
/// # Errors
///
/// [`ContactError::Edge`] where curvature is that of its middle alone.
pub(super) fn beside_middle(times: f64) -> Result<Option<String>, ContactError> {
    if !(1.0 / EDGE..=EDGE).contains(&times) {
        return Err(ContactError::Edge { times });
    }
    Ok(((times - 1.0).abs() > UNCERTAIN).then(|| {
        format!(
            "The surfaces are not curved over the whole contact as in its middle: by how the gap opens over all of it the force is about \
             {times:.2} times as large."
        )
    }))
}

/// What to know of a depth that is such a share of a radius, if it is too deep for Hertz.
pub(super) fn beyond_hertz(depth: &str, share: f64, radius: &str) -> Option<String> {
    (share > HERTZIAN).then(|| {
        format!(
            "{depth} is {:.0} % of the {radius}; Hertz's theory is for less than {:.0} %.",
            100.0 * share,
            100.0 * HERTZIAN
        )
    })
}

impl TouchRecord {
    /// The record of a grain that is touched.
    pub fn new(input: String, grain: &Grain, normal: &Vector3<f64>, touch: &Touch) -> Self {
        Self {
            input,
            point: (grain.frame().centre + touch.point).coords.into(),
            normal: (*normal).into(),
            principal_curvatures: touch.principal,
            point_error: touch.error.map(|error| error.place),
            curvature_error: touch.error.map(|error| error.curvature),
            edge_radius: touch.cap.map(|cap| cap.radius),
            reach: reach(grain),
            is_whole: is_whole(grain),
        }
    }

    fn curved(&self) -> Curved {
        Curved {
            principal: self.principal_curvatures,
            error: self.curvature_error,
        }
    }
}

fn is_whole(grain: &Grain) -> bool {
    let is_one = |star: &StarGrain| star.segments() == 1;
    let has_no_cells = |position: &PositionGrain| position.position().cover().is_none();
    grain.star().is_some_and(is_one) || grain.position().is_some_and(has_no_cells)
}

impl ContactReport {
    /// The report of a contact under a load, the bodies' first principal directions at `angle_rad` to each other; `gap` tells
    /// how the gap between them is curved over the contact ([`KnownContact::times`]).
    ///
    /// # Errors
    ///
    /// See [`ContactError`].
    pub fn new(
        first: TouchRecord,
        second: Option<TouchRecord>,
        angle_rad: f64,
        load: &Load,
        gap: impl Fn(&Vector2<f64>) -> f64,
    ) -> Result<Self, ContactError> {
        let other = second.as_ref().map_or(Curved::PLANE, TouchRecord::curved);
        let known = KnownContact::new(first.curved(), other, angle_rad)?;
        let relative = known.relative();
        let indentation_m = 1e-6 * load.indentation_um;
        let (metres, modulus) = (load.unit.metres(), load.effective_modulus_pa);
        let force = relative.normal_force_n(metres, indentation_m, modulus);
        let stiffness = relative.normal_stiffness_n_per_m(metres, indentation_m, modulus);
        let share = known.force_share(indentation_m, Some(0.0));
        let mut warnings = Vec::new();
        let body = second
            .as_ref()
            .map_or(first.reach, |other| first.reach.min(other.reach));
        let indentation = indentation_m / metres;
        warnings.extend(beside_hertz(
            "The indentation",
            relative,
            indentation,
            body,
        )?);
        let times = known.times(indentation, gap)?;
        warnings.extend(beside_middle(times)?);
        match share {
            None => warnings.push(
                "How certain the curvature is there is not known, so the force has no standard error: superquadrics, fits \
                 with --seams none or --symmetry, scans with a hole, models of older versions, edited models and \
                 rounded edges have none."
                    .into(),
            ),
            Some(share) if share > UNCERTAIN => warnings.push(format!(
                "The curvature is so uncertain there that the force is known to {:.0} % only; fit {}.",
                100.0 * share,
                match first.is_whole && second.as_ref().is_none_or(|other| other.is_whole) {
                    true => "a finer scan",
                    false => "with --segments 1, or a finer scan",
                }
            )),
            Some(_) => (),
        }
        Ok(Self {
            unit: load.unit,
            first,
            second,
            larger_curvature: relative.larger(),
            smaller_curvature: relative.smaller(),
            effective_radius: relative.effective_radius(),
            effective_radius_error: known
                .share(RelativeCurvature::effective_radius)
                .map(|share| share * relative.effective_radius()),
            correction: relative.correction(Correction::Elliptic),
            effective_modulus_pa: modulus,
            indentation_um: load.indentation_um,
            normal_force_n: force,
            normal_force_error_n: share.map(|share| share * force),
            normal_stiffness_n_per_m: stiffness,
            normal_stiffness_error_n_per_m: share.map(|share| share * stiffness),
            warnings,
        })
    }
}

impl TouchRecord {
    fn write(&self, f: &mut fmt::Formatter<'_>, unit: Unit) -> fmt::Result {
        writeln!(f, "body          {}", escaped(&self.input))?;
        let least = self.principal_curvatures.map(|k| 1.0 / k.abs());
        let shown = PLACED_TO * least[0].min(least[1]);
        let point = place(self.point, self.point_error.unwrap_or(shown));
        write!(f, "touched at    {point} {unit}")?;
        if let Some(error) = self.point_error {
            write!(f, ", ± {} along the normal", significant(error, 2))?;
        }
        writeln!(f)?;
        let radii = self.principal_curvatures.map(|k| {
            let error = self.curvature_error.map(|error| error / (k * k));
            with_error(1.0 / k, error)
        });
        write!(
            f,
            "curved with   radii {} and {} {unit}",
            radii[0], radii[1]
        )?;
        if let Some(radius) = self.edge_radius {
            write!(f, " (an edge, rounded with {} {unit})", short(radius))?;
        }
        writeln!(f)
    }
}

impl fmt::Display for ContactReport {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let unit = self.unit;
        self.first.write(f, unit)?;
        match &self.second {
            Some(second) => second.write(f, unit)?,
            None => writeln!(f, "against       a plane")?,
        }
        writeln!(
            f,
            "relative      effective radius {} {unit}, correction {}",
            with_error(self.effective_radius, self.effective_radius_error),
            short(self.correction)
        )?;
        writeln!(
            f,
            "loaded by     an indentation of {} um, effective modulus {} MPa",
            short(self.indentation_um),
            short(1e-6 * self.effective_modulus_pa)
        )?;
        writeln!(
            f,
            "normal force  {} N",
            with_error(self.normal_force_n, self.normal_force_error_n)
        )?;
        write!(
            f,
            "stiffness     {} N/m",
            with_error(
                self.normal_stiffness_n_per_m,
                self.normal_stiffness_error_n_per_m
            )
        )
    }
}
