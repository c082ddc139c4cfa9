//! What `grainform measure` tells of a solid.

use super::number::{short, triple};
use crate::Mesh;
use crate::fit::ReferenceKind;
use crate::measure::{MassProperties, PrincipalInertia, extents};
use nalgebra::{Matrix3, Vector3};
use serde::Serialize;
use std::fmt;

/// What was measured.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Measured {
    /// The scan's own faces.
    Faces,
    /// The triangulation of the points' directions.
    Directions,
    /// A fitted model.
    Model,
}

impl From<ReferenceKind> for Measured {
    fn from(kind: ReferenceKind) -> Self {
        match kind {
            ReferenceKind::Faces => Self::Faces,
            ReferenceKind::Directions => Self::Directions,
        }
    }
}

/// Area, volume, centroid, inertia and size of a solid of density one.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct MeasureReport {
    /// The scan or model.
    pub input: String,
    /// What was measured.
    pub of: Measured,
    /// Area.
    pub area: f64,
    /// Volume.
    pub volume: f64,
    /// Centroid.
    pub centroid: [f64; 3],
    /// Inertia about the centroid, along the axes of the scan.
    pub inertia: [[f64; 3]; 3],
    /// Principal moments and axes; `null` where the inertia is not finite.
    pub principal: Option<Principal>,
    /// Extents along the principal axes; `null` without these.
    pub dimensions: Option<Dimensions>,
    /// What is odd about the input: whole sentences.
    pub warnings: Vec<String>,
}

/// Principal moments of inertia about the centroid.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Principal {
    /// Ascending: the first belongs to the long axis.
    pub moments: [f64; 3],
    /// A unit axis for each moment, in the scan's frame.
    pub axes: [[f64; 3]; 3],
}

/// Extents along the principal axes of inertia, in the order of the moments.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Dimensions {
    /// Along the axis of the least moment.
    pub length: f64,
    /// Along the axis of the middle moment.
    pub width: f64,
    /// Along the axis of the largest moment.
    pub thickness: f64,
}

impl MeasureReport {
    /// The report of a solid with these properties, and with the extents of `mesh`.
    pub fn new(
        input: String,
        of: Measured,
        properties: &MassProperties,
        mesh: &Mesh,
        warnings: Vec<String>,
    ) -> Self {
        let principal = properties.principal();
        Self {
            input,
            of,
            area: properties.area,
            volume: properties.volume,
            centroid: properties.centroid.coords.into(),
            inertia: rows(&properties.inertia),
            principal: principal.map(|principal| Principal::new(&principal)),
            dimensions: principal.map(|principal| Dimensions::new(extents(mesh, &principal.axes))),
            warnings,
        }
    }
}

impl Dimensions {
    /// Length, width and thickness, in this order.
    pub(super) fn new(extents: Vector3<f64>) -> Self {
        let [length, width, thickness] = extents.into();
        Self {
            length,
            width,
            thickness,
        }
    }
}

impl Principal {
    pub(super) fn new(principal: &PrincipalInertia) -> Self {
        Self {
            moments: principal.moments.into(),
            axes: rows(&principal.axes.transpose()),
        }
    }
}

/// The rows of a matrix.
pub(super) fn rows(matrix: &Matrix3<f64>) -> [[f64; 3]; 3] {
    [0, 1, 2].map(|i| matrix.row(i).transpose().into())
}

impl fmt::Display for MeasureReport {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let of = match self.of {
            Measured::Faces => "the scan's own faces",
            Measured::Directions => "the points, triangulated by direction",
            Measured::Model => "the fitted model",
        };
        writeln!(f, "input       {}", self.input)?;
        writeln!(f, "measured    {of}")?;
        writeln!(f, "area        {}", short(self.area))?;
        writeln!(f, "volume      {}", short(self.volume))?;
        writeln!(f, "centroid    {}", triple(self.centroid))?;
        if let Some(Dimensions {
            length,
            width,
            thickness,
        }) = self.dimensions
        {
            writeln!(
                f,
                "dimensions  length {}, width {}, thickness {}",
                short(length),
                short(width),
                short(thickness)
            )?;
        }
        if let Some(Principal { moments, axes }) = self.principal {
            writeln!(f, "principal moments of inertia and their axes")?;
            for (moment, axis) in moments.into_iter().zip(axes) {
                writeln!(f, "            {}  along  {}", short(moment), triple(axis))?;
            }
        }
        write!(f, "Lengths are in the scan's unit, the density is 1.")
    }
}
