//! What `grainform contact` tells.

use super::escape::escaped;
use super::number::{short, triple};
use super::unit::Unit;
use crate::contact::{Correction, RelativeCurvature, Touch};
use nalgebra::{Point3, Vector3};
use serde::Serialize;
use std::fmt;

/// The contact of a grain with a plane, or with another grain.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct ContactReport {
    /// Unit of the scans' lengths.
    pub unit: Unit,
    /// The body that is touched.
    pub first: TouchRecord,
    /// The other body; absent where it is a plane.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub second: Option<TouchRecord>,
    /// The larger relative curvature A, in one over the unit.
    pub larger_curvature: f64,
    /// The smaller relative curvature B.
    pub smaller_curvature: f64,
    /// Effective radius 1 / (2 sqrt(A B)).
    pub effective_radius: f64,
    /// Correction for a patch that is not round.
    pub correction: f64,
    /// Effective modulus, in pascals.
    pub effective_modulus_pa: f64,
    /// Indentation, in micrometres.
    pub indentation_um: f64,
    /// Normal force, in newtons.
    pub normal_force_n: f64,
    /// Stiffness, in newtons per metre.
    pub normal_stiffness_n_per_m: f64,
}

/// Where and how curved a body is touched.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct TouchRecord {
    /// The model.
    pub input: String,
    /// The point, in the scan's frame.
    pub point: [f64; 3],
    /// The direction in which it is touched: the outward normal.
    pub normal: [f64; 3],
    /// Principal curvatures, the larger first, in one over the unit.
    pub principal_curvatures: [f64; 2],
    /// Radius of the cap by which an edge was rounded.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub edge_radius: Option<f64>,
}

/// What a contact is loaded with.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Load {
    /// The unit of the scans' lengths.
    pub unit: Unit,
    /// Effective modulus, in pascals.
    pub effective_modulus_pa: f64,
    /// Indentation, in micrometres.
    pub indentation_um: f64,
}

impl TouchRecord {
    /// The record of a body whose origin lies at `centre` of the scan.
    pub fn new(input: String, centre: &Point3<f64>, normal: &Vector3<f64>, touch: &Touch) -> Self {
        Self {
            input,
            point: (centre + touch.point).coords.into(),
            normal: (*normal).into(),
            principal_curvatures: touch.principal,
            edge_radius: touch.cap.map(|cap| cap.radius),
        }
    }
}

impl ContactReport {
    /// The report of a contact under a load.
    pub fn new(
        first: TouchRecord,
        second: Option<TouchRecord>,
        relative: &RelativeCurvature,
        load: &Load,
    ) -> Self {
        let indentation_m = 1e-6 * load.indentation_um;
        let (metres, modulus) = (load.unit.metres(), load.effective_modulus_pa);
        Self {
            unit: load.unit,
            first,
            second,
            larger_curvature: relative.larger(),
            smaller_curvature: relative.smaller(),
            effective_radius: relative.effective_radius(),
            correction: relative.correction(Correction::Elliptic),
            effective_modulus_pa: modulus,
            indentation_um: load.indentation_um,
            normal_force_n: relative.normal_force_n(metres, indentation_m, modulus),
            normal_stiffness_n_per_m: relative.normal_stiffness_n_per_m(
                metres,
                indentation_m,
                modulus,
            ),
        }
    }
}

impl TouchRecord {
    fn write(&self, f: &mut fmt::Formatter<'_>, unit: Unit) -> fmt::Result {
        writeln!(f, "body          {}", escaped(&self.input))?;
        writeln!(f, "touched at    {} {unit}", triple(self.point))?;
        let radii = self.principal_curvatures.map(|k| short(1.0 / k));
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
            short(self.effective_radius),
            short(self.correction)
        )?;
        writeln!(
            f,
            "loaded by     an indentation of {} um, effective modulus {} MPa",
            short(self.indentation_um),
            short(1e-6 * self.effective_modulus_pa)
        )?;
        writeln!(f, "normal force  {} N", short(self.normal_force_n))?;
        write!(
            f,
            "stiffness     {} N/m",
            short(self.normal_stiffness_n_per_m)
        )
    }
}
