//! What a fit of superquadrics tells.

use super::ReferenceRecord;
use super::escape::escaped;
use super::labels::Labels;
use super::measure::{Measure, NotMeasured, Withheld, by_reason};
use super::number::{integrated, percent, short};
use super::superquadric_record::SuperquadricRecord;
use crate::digits::plural;
use crate::fit::{FitWarning, MultiFit, Reference, ReferenceKind, Residuals, SuperquadricFit};
use crate::measure::{SolidProperties, superquadric_properties, union_properties};
use crate::model::{Contradicted, Unseen};
use crate::unit::Unit;
use serde::Serialize;
use std::fmt;

/// A superquadric, or a union of several, fitted to a scan.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[non_exhaustive]
pub struct SuperquadricReport {
    /// The scan.
    pub input: String,
    /// Unit of the scan's lengths, if it was told.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub unit: Option<Unit>,
    /// Points of the scan that were fitted.
    pub points: usize,
    /// The superquadrics.
    pub parts: Vec<SuperquadricRecord>,
    /// Root mean square of the radial distances of the points.
    pub rms: f64,
    /// The largest of them.
    pub largest: f64,
    /// Mean distance of the points from their mean.
    pub mean_radius: f64,
    /// Area, of the union if there are several; `null`, as the next three, where it is in `not_measured`.
    pub area: Option<f64>,
    /// Its error by quadrature, as a share of it; the harmonics' `area_error` is another, beside the reference.
    pub area_error: Option<f64>,
    /// Volume.
    pub volume: Option<f64>,
    /// Its error by quadrature, likewise; zero of a single one, whose volume is a closed form.
    pub volume_error: Option<f64>,
    /// Standard error of the area, of one superquadric: of how well the points tell the nearest one, and not of how well it
    /// suits the grain. `null` where its numbers are not determined, and of unions.
    pub area_standard_error: Option<f64>,
    /// That of the volume, likewise.
    pub volume_standard_error: Option<f64>,
    /// What is not told, and why.
    pub not_measured: Vec<NotMeasured>,
    /// What the polyhedron through the points contradicts, for the model's file.
    #[serde(skip)]
    pub contradicted: Option<Contradicted>,
    /// Area and volume of the scan's own faces, or of the polyhedron through its points.
    pub reference: Option<ReferenceRecord>,
    /// RMS distances of points that were held out, of one part, of two and so on; absent of a single one.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub held_out: Option<Vec<f64>>,
    /// What to know of the scan.
    pub warnings: Vec<String>,
}

/// A scan that was fitted.
#[derive(Debug, Clone, PartialEq)]
pub struct FittedScan {
    /// Its name.
    pub input: String,
    /// Unit of its lengths, if it was told.
    pub unit: Option<Unit>,
    /// Points of it that were fitted.
    pub points: usize,
    /// Area and volume of its faces, or of the polyhedron through its points, where these are known.
    pub reference: Option<Reference>,
    /// What it did not see of the grain: area and volume are not told then.
    pub unseen: Option<Unseen>,
    /// What to know of it.
    pub warnings: Vec<String>,
}

/// What to know of area and volume where an exponent is at its bound.
const AT_BOUND: &str = "An exponent is at its bound, as of bodies with sharp edges or flat sides: no superquadric follows these to the last, \
     and area and volume may be off by some percent, which no error holds.";

impl SuperquadricReport {
    /// The report of one superquadric.
    pub fn of_single(scan: FittedScan, fitted: &SuperquadricFit) -> Self {
        let parts = vec![SuperquadricRecord::new(
            &fitted.shape,
            &fitted.frame,
            &fitted.errors,
        )];
        let solid = superquadric_properties(&fitted.shape);
        let mut report = Self::new(scan, parts, &solid, &fitted.residuals, fitted.mean_radius);
        let outliers = fitted.strays;
        report.points -= outliers;
        if outliers > 0 {
            let warning = FitWarning::Outliers { outliers };
            report.warnings.insert(0, warning.to_string());
        }
        let errors = fitted
            .solid_errors
            .filter(|_| report.not_measured.is_empty());
        Self {
            area_standard_error: errors.map(|errors| errors.area),
            volume_standard_error: errors.map(|errors| errors.volume),
            ..report
        }
    }

    /// The report of a union, whose area and volume are integrated to a relative tolerance.
    pub fn of_multi(scan: FittedScan, fitted: &MultiFit) -> Self {
        let parts = fitted.union.parts().iter().zip(&fitted.errors);
        let parts = parts.map(|(part, errors)| {
            let placed = part.placed(&fitted.frame);
            SuperquadricRecord::new(&placed.shape, &placed.frame, errors)
        });
        let solid = union_properties(&fitted.union, UNION_TOLERANCE);
        Self {
            held_out: Some(fitted.held_out.clone()),
            ..Self::new(
                scan,
                parts.collect(),
                &solid,
                &fitted.residuals,
                fitted.mean_radius,
            )
        }
    }

    fn new(
        scan: FittedScan,
        parts: Vec<SuperquadricRecord>,
        solid: &SolidProperties,
        residuals: &Residuals,
        mean_radius: f64,
    ) -> Self {
        let reference = scan.reference.filter(|_| scan.unseen.is_none());
        let contradicted = reference.and_then(|points| far_off(&points, solid));
        let withheld = Withheld::of_fit(scan.unseen, contradicted);
        let not_measured = [Measure::Area, Measure::Volume].into_iter();
        let not_measured = not_measured.filter_map(|measure| {
            let reason = withheld.reason(measure)?;
            Some(NotMeasured {
                measure: measure.name(),
                reason,
            })
        });
        let not_measured: Vec<NotMeasured> = not_measured.collect();
        let told = |figure: f64| not_measured.is_empty().then_some(figure);
        let off_faces = reference.and_then(|faces| off_faces(&faces, solid));
        let share = residuals.rms / mean_radius;
        let rough = (share > ROUGH).then(|| {
            format!(
                "The points are {:.0} % of the mean radius (RMS) off the superquadrics: area and volume are theirs, and may be \
                 far from the grain's.",
                100.0 * share
            )
        });
        let at_bound = parts.iter().any(SuperquadricRecord::has_exponent_at_bound);
        let at_bound = at_bound.then(|| AT_BOUND.into());
        Self {
            input: scan.input,
            unit: scan.unit,
            points: scan.points,
            parts,
            rms: residuals.rms,
            largest: residuals.max,
            mean_radius,
            area: told(solid.properties.area),
            area_error: told(solid.area_error),
            volume: told(solid.properties.volume),
            volume_error: told(solid.volume_error),
            area_standard_error: None,
            volume_standard_error: None,
            not_measured,
            contradicted,
            reference: reference.map(Into::into),
            held_out: None,
            warnings: scan
                .warnings
                .into_iter()
                .chain(rough)
                .chain(at_bound)
                .chain(off_faces)
                .collect(),
        }
    }
}

/// By how much area and volume are off those of a reference, as shares.
fn off(reference: &Reference, solid: &SolidProperties) -> [f64; 2] {
    [
        solid.properties.area / reference.area - 1.0,
        solid.properties.volume / reference.volume - 1.0,
    ]
}

/// By how much area and volume are off those of the scan's own closed faces, where that is much.
fn off_faces(faces: &Reference, solid: &SolidProperties) -> Option<String> {
    let [area, volume] = off(faces, solid);
    let is_much = area.abs() > OFF_FACES || volume.abs() > OFF_FACES;
    (faces.kind == ReferenceKind::Faces && is_much).then(|| {
        format!(
            "The area is {} and the volume {} off those of the scan's own faces: superquadrics do not have this grain's shape.",
            percent(area),
            percent(volume)
        )
    })
}

/// By how much area and volume are off those of the polyhedron through the points, where the volume is so by more than
/// [`FAR_OFF`].
fn far_off(points: &Reference, solid: &SolidProperties) -> Option<Contradicted> {
    let [area, volume] = off(points, solid);
    (volume.abs() > FAR_OFF).then_some(Contradicted {
        area: Some(area),
        volume: Some(volume),
    })
}

/// Share of its volume by which superquadrics may be off the polyhedron of their points: that of 50 points is a seventh smaller
/// than the grain.
const FAR_OFF: f64 = 0.5;

/// Share of the area and of the volume of a scan's own faces from which on a difference is told.
const OFF_FACES: f64 = 0.05;

/// Share of the mean radius from which on points are told to be far off a fit.
const ROUGH: f64 = 0.03;

/// Relative tolerance of the area and the volume of unions.
const UNION_TOLERANCE: f64 = 1e-5;

impl fmt::Display for SuperquadricReport {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let labels = Labels(self.unit);
        let length = labels.length();
        let share = |value: f64| {
            format!(
                "{:.2} % of the mean radius",
                100.0 * value / self.mean_radius
            )
        };
        let points = plural(self.points, "point");
        writeln!(f, "scan          {}, {points}", escaped(&self.input))?;
        writeln!(
            f,
            "model         {}",
            plural(self.parts.len(), "superquadric")
        )?;
        let rms = short(self.rms);
        writeln!(
            f,
            "residuals     RMS {rms}{length} ({}), along rays",
            share(self.rms)
        )?;
        let largest = short(self.largest);
        writeln!(
            f,
            "              largest {largest}{length} ({})",
            share(self.largest)
        )?;
        if let Some(held_out) = &self.held_out {
            let each: Vec<String> = held_out.iter().map(|rms| short(*rms)).collect();
            writeln!(
                f,
                "held-out RMS  {}{length}, of 1 part and more",
                each.join(", ")
            )?;
        }
        if let Some(area) = self.area {
            let error = self.area_standard_error;
            let area = integrated(area, error, self.area_error, &labels.area());
            writeln!(f, "area          {area}")?;
        }
        if let Some(volume) = self.volume {
            let error = self.volume_standard_error;
            let volume = integrated(volume, error, self.volume_error, &labels.volume());
            writeln!(f, "volume        {volume}")?;
        }
        for (names, reason) in by_reason(&self.not_measured) {
            writeln!(f, "not told      {names}: {reason}")?;
        }
        if let Some(reference) = &self.reference {
            reference.write(f, &labels)?;
        }
        for part in &self.parts {
            part.write(f, &length)?;
        }
        let of_solid = match (self.volume, self.volume_standard_error) {
            (Some(_), Some(_)) => {
                "; those of area and volume tell how well the points tell the nearest superquadric, not how well that suits the grain"
            }
            (Some(_), None) => "; area and volume have none",
            (None, _) => "",
        };
        write!(
            f,
            "Figures after ± are standard errors{of_solid}. Lengths are in {}.",
            labels.name()
        )
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::Superquadric;

    #[test]
    fn a_volume_far_off_that_of_the_polyhedron_is_contradicted_and_its_area_too() {
        let ball = superquadric_properties(&Superquadric::single([1.0; 3], 2.0, 2.0).unwrap());
        let told = |times: f64| {
            let points = Reference {
                kind: ReferenceKind::Directions,
                area: ball.properties.area,
                volume: ball.properties.volume / times,
                bulge: 0.0,
            };
            far_off(&points, &ball)
        };
        assert!(told(1.4).is_none() && told(0.7).is_none());
        let found = told(1.6).unwrap();
        assert!((found.volume.unwrap() - 0.6).abs() < 1e-9 && found.area.is_some());
        assert!(told(0.4).is_some());
    }
}
