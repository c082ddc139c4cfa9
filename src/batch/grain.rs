//! One grain of a batch: its scan is fitted, the fit is measured, and what is asked for is saved.

use super::columns::{Figure, figures};
use super::journal::Row;
use crate::export::{SaveError, save_grain, save_mesh};
use crate::fit::{Context, FitOptions, Fitted, fit_scan, whole_or_largest};
use crate::model::Surface;
use crate::report::{
    FitReport, Measure, MeasureReport, ReportedScan, Unit, Withheld, by_reason, sentences,
};
use crate::scan::Scan;
use crate::unit::asked_or_told;
use serde_json::Value;
use std::error::Error;
use std::path::PathBuf;

/// What is asked of every grain of a batch.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Settings {
    /// How scans are fitted.
    pub fit: FitOptions,
    /// Of several bodies in a scan, fit the largest.
    pub largest: bool,
    /// What is measured of the fits.
    pub measures: Vec<Measure>,
    /// Unit of the scans' lengths; without it that of each scan's own header, where that tells one.
    pub unit: Option<Unit>,
    /// The most bytes of a scan, packed or unpacked.
    pub max_bytes: u64,
    /// Save the models.
    pub models: bool,
    /// Save a mesh of each model, with so many cells along an edge of a cube of directions.
    pub meshes: Option<usize>,
}

impl Settings {
    /// All that a row depends on, as text.
    pub(super) fn text(&self) -> String {
        let FitOptions {
            tolerance,
            segments,
            ..
        } = &self.fit;
        let names: Vec<&str> = self.measures.iter().map(|measure| measure.name()).collect();
        let unit = self.unit.map_or("header".into(), |unit| unit.to_string());
        let segments = segments.map_or("adaptive".into(), |segments| segments.to_string());
        format!(
            "tolerance={tolerance:?} segments={segments} largest={} unit={unit} max_bytes={} only={}",
            self.largest,
            self.max_bytes,
            names.join(",")
        )
    }
}

/// Where models and meshes of one grain go; none where they are not asked for.
pub(super) struct Outputs {
    pub(super) model: Option<PathBuf>,
    pub(super) mesh: Option<PathBuf>,
}

impl Outputs {
    /// Whether all are there as they were saved with a row.
    pub(super) fn are_of(&self, row: &Row) -> bool {
        let is_same = |path: &Option<PathBuf>, saved: &Option<String>| {
            let is_saved = |path| saved.is_some() && hash(path) == *saved;
            path.as_ref().is_none_or(is_saved)
        };
        is_same(&self.model, &row.model_hash) && is_same(&self.mesh, &row.mesh_hash)
    }
}

/// The hash of a file that can be read.
pub(super) fn hash(path: &PathBuf) -> Option<String> {
    let bytes = std::fs::read(path).ok()?;
    Some(blake3::hash(&bytes).to_hex().to_string())
}

/// Fits and measures a scan; what is wrong with it is told in the row.
///
/// # Errors
/// Where an output cannot be saved.
pub(super) fn grain(
    scan: Result<Scan, String>,
    settings: &Settings,
    outputs: &Outputs,
) -> Result<Row, SaveError> {
    let (mut fitted, of_scan) = match scan.and_then(|scan| fit(scan, settings)) {
        Ok(found) => found,
        Err(reason) => {
            return Ok(Row {
                reason: Some(reason),
                ..Row::default()
            });
        }
    };
    let are_places_asked = settings
        .measures
        .iter()
        .any(|measure| !is_of_whole(*measure));
    fitted.grain = match outputs.model.is_some() || are_places_asked {
        true => fitted.grain_with_errors(),
        false => {
            let errors = fitted.standard_errors(&fitted.survey());
            fitted.grain.with_standard_errors(errors)
        }
    };
    fitted.grain = fitted.grain.with_unit(of_scan.unit.clone());
    if let Some(path) = &outputs.model {
        save_grain(path, &fitted.grain)?;
    }
    if let (Some(path), Some(cells)) = (&outputs.mesh, settings.meshes) {
        save_mesh(path, &fitted.grain.mesh(cells))?;
    }
    Ok(Row {
        model_hash: outputs.model.as_ref().and_then(hash),
        mesh_hash: outputs.mesh.as_ref().and_then(hash),
        ..row(&fitted, &of_scan, settings)
    })
}

/// Whether a measure and its errors follow from sums over the surface and from how far this reaches along its principal axes. The
/// errors of all others are those of the surface [from place to place](crate::model::LocalErrors).
const fn is_of_whole(measure: Measure) -> bool {
    matches!(
        measure,
        Measure::Area
            | Measure::Volume
            | Measure::Centroid
            | Measure::Inertia
            | Measure::Principal
            | Measure::Dimensions
            | Measure::Form
            | Measure::Ellipsoid
    )
}

/// What is told of a scan beside its fit.
struct OfScan {
    warnings: Vec<String>,
    unit: Option<String>,
}

fn fit(scan: Scan, settings: &Settings) -> Result<(Fitted, OfScan), String> {
    let unit = settings.unit.map_or(Ok(()), |unit| unit.check(scan.unit()));
    unit.map_err(|error| told(&error))?;
    let (scan, left_out) = whole_or_largest(scan, settings.largest);
    let context = Context::default();
    let mut fitted =
        fit_scan(&scan, &settings.fit, &context).map_err(|error| scan.explained(told(&error)))?;
    fitted.warnings.extend(left_out);
    let of_scan = OfScan {
        warnings: scan.warnings().to_vec(),
        unit: asked_or_told(settings.unit, scan.unit()),
    };
    Ok((fitted, of_scan))
}

/// An error and what caused it, in one sentence.
pub(super) fn told(error: &dyn Error) -> String {
    match error.source() {
        Some(cause) => format!("{error}: {}", told(cause)),
        None => error.to_string(),
    }
}

fn row(fitted: &Fitted, of_scan: &OfScan, settings: &Settings) -> Row {
    let OfScan { warnings, unit } = of_scan;
    let survey = fitted.survey();
    let reported = ReportedScan {
        warnings: warnings.clone(),
        ..ReportedScan::default()
    };
    let withheld = Withheld::of(&fitted.grain, false);
    let fit = FitReport::with_survey(reported, fitted, &survey, &settings.fit, &withheld);
    let measured = MeasureReport::of_model(String::new(), &survey, &settings.measures, &withheld);
    // A number that JSON has not is null.
    let told = serde_json::to_value(&measured).unwrap_or(Value::Null);
    let known = unit.as_ref().and_then(|unit| unit.parse().ok());
    let figures = figures(&settings.measures)
        .into_iter()
        .flat_map(|figure| cells(&figure, &told))
        .collect();
    Row {
        unit: unit.clone(),
        points: Some(fit.points as u64),
        degree: Some(fit.degree as u64),
        segments: Some(fit.segments as u64),
        coefficients: Some(fit.coefficients as u64),
        mean_radius: Some(fit.mean_radius),
        noise: fit.noise,
        noise_is_bound: fit.noise.map(|_| fit.noise_is_bound),
        rms: Some(fit.rms),
        heldout_rms: fit.heldout_rms,
        area_error: fit.area_error,
        volume_error: fit.volume_error,
        not_measured: by_reason(&measured.not_measured)
            .into_iter()
            .map(|(names, reason)| format!("{names}: {reason}"))
            .collect(),
        no_standard_errors: fit.no_standard_errors,
        warnings: sentences(warnings, &fitted.warnings, known),
        figures,
        ..Row::default()
    }
}

/// The figure, and its standard error where it can have one.
fn cells(figure: &Figure, told: &Value) -> Vec<Option<f64>> {
    let at = |at: &String| told.pointer(at).and_then(Value::as_f64);
    std::iter::once(at(&figure.measured))
        .chain(figure.error.as_ref().map(at))
        .collect()
}

#[cfg(test)]
mod tests {
    use super::super::columns::{FIRST, columns};
    use super::*;
    use crate::shapes::Sampling;
    use nalgebra::{Point3, Vector3};
    use rand::SeedableRng;
    use rand_chacha::ChaCha8Rng;
    use rand_distr::{Distribution, StandardNormal};

    fn asked(measures: Vec<Measure>) -> Settings {
        Settings {
            fit: FitOptions::default(),
            largest: false,
            measures,
            unit: None,
            max_bytes: u64::MAX,
            models: false,
            meshes: None,
        }
    }

    #[test]
    fn a_measure_alone_is_told_as_among_all() {
        let mut random = ChaCha8Rng::seed_from_u64(0);
        let directions = Sampling::Fibonacci.directions(600, 0).unwrap();
        let places = directions.iter().map(|n| {
            let error: f64 = StandardNormal.sample(&mut random);
            Point3::from(Vector3::new(3.0 * n.x, 2.0 * n.y, 1.5 * n.z) * (1.0 + 0.001 * error))
        });
        let scan = Scan::from_points(places.collect());
        let nowhere = Outputs {
            model: None,
            mesh: None,
        };
        let told = |measures: Vec<Measure>| {
            let row = grain(Ok(scan.clone()), &asked(measures), &nowhere).unwrap();
            assert_eq!(row.reason, None);
            row.figures
        };
        let all = told(Measure::ALL.to_vec());
        let mut rest = all.as_slice();
        for measure in Measure::ALL {
            let alone = told(vec![measure]);
            let among;
            (among, rest) = rest.split_at(alone.len());
            assert_eq!(alone, among, "{measure}");
        }
        // Each column stands in the record, but for the errors of what has none.
        let names = columns(&Measure::ALL).into_iter().skip(FIRST.len());
        let untold = names.zip(all).filter(|(_, figure)| figure.is_none());
        let untold: Vec<String> = untold.map(|(column, _)| column.name).collect();
        assert_eq!(untold, [""; 0]);
    }
}
