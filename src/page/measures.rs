//! Measures as rows of a table.

use super::definitions::definition;
use crate::report::{StandardErrorsRecord, Unit, short};
use serde::Serialize;
use serde_json::Value;

/// A row of the table of measures.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub(crate) struct MeasureRow {
    /// Its key in the record of measures, such as `sphericity.wadell`.
    pub name: String,
    /// Its value, or values.
    pub value: String,
    /// Its standard error, where it is known.
    pub error: Option<String>,
    /// Its unit; empty of plain numbers.
    pub unit: String,
    /// What it means.
    pub definition: String,
}

/// Where the errors of a record's figures stand, and how the name of one beside a figure goes on: they are told with their figures and
/// are no rows of their own.
const ERRORS: &str = "standard_errors";
const ERROR: &str = "_standard_error";

/// Entries of a list that are shown.
const MOST_ENTRIES: usize = 12;

impl MeasureRow {
    /// The rows of a record of measures. A record's own parts come in the order of their names.
    pub(crate) fn of(
        measures: &impl Serialize,
        errors: Option<&StandardErrorsRecord>,
        unit: Option<Unit>,
    ) -> Vec<Self> {
        let record = |record: Result<Value, _>| record.unwrap_or(Value::Null);
        let measures = record(serde_json::to_value(measures));
        let errors = record(serde_json::to_value(errors));
        let mut rows = Vec::new();
        collect("", (&measures, None), unit, &mut rows);
        for row in &mut rows {
            let own = row.error.take();
            row.error = own.or_else(|| error(&row.name, &errors));
        }
        rows
    }
}

/// Adds the rows of a value, which may have an error.
fn collect(
    name: &str,
    (value, error): (&Value, Option<&Value>),
    unit: Option<Unit>,
    rows: &mut Vec<MeasureRow>,
) {
    let below = |part: &str| match name {
        "" => part.to_owned(),
        name => format!("{name}.{part}"),
    };
    match value {
        Value::Object(parts) => {
            let figures = parts
                .iter()
                .filter(|(part, _)| *part != ERRORS && !part.contains(ERROR));
            for (part, value) in figures {
                let of_record = parts
                    .get(ERRORS)
                    .or(error)
                    .and_then(|errors| errors.get(part));
                let beside = ["", "s"].map(|end| parts.get(&format!("{part}{ERROR}{end}")));
                let error = beside.into_iter().flatten().next().or(of_record);
                collect(&below(part), (value, error), unit, rows);
            }
        }
        Value::Array(parts) if parts.iter().any(Value::is_object) => {
            for (at, part) in parts.iter().enumerate() {
                let along = part.get("along").and_then(Value::as_str);
                let part_name = along.map_or(at.to_string(), str::to_owned);
                collect(&below(&part_name), (part, None), unit, rows);
            }
        }
        _ => rows.extend(text(value).map(|value| MeasureRow {
            name: name.to_owned(),
            value,
            error: error.and_then(text),
            unit: unit_of(name, unit),
            definition: definition(&plain(name)).unwrap_or_default(),
        })),
    }
}

/// The key without the axis that an outline is seen along.
fn plain(name: &str) -> String {
    let axes = [".length.", ".width.", ".thickness."];
    let found = axes
        .iter()
        .find(|axis| name.starts_with("projections") && name.contains(**axis));
    found.map_or(name.to_owned(), |axis| name.replacen(axis, ".", 1))
}

/// Numbers and lists of numbers; nothing of what is not measured, nor of names.
fn text(value: &Value) -> Option<String> {
    text_beside(value, 1e-12 * largest(value))
}

/// The largest number in lists, however deep, but for its sign; zero of a number alone.
fn largest(value: &Value) -> f64 {
    let parts = value.as_array().into_iter().flatten();
    let sizes = parts.map(|part| part.as_f64().map_or_else(|| largest(part), f64::abs));
    sizes.fold(0.0, f64::max)
}

/// The same, with what is below `rounding` as zero.
fn text_beside(value: &Value, rounding: f64) -> Option<String> {
    match value {
        Value::Number(number) => {
            let told = |x: f64| short(if x.abs() < rounding { 0.0 } else { x });
            number.as_f64().map(told)
        }
        Value::Array(parts) => {
            let told = parts.iter().take(MOST_ENTRIES);
            let told = told.map(|part| text_beside(part, rounding));
            let told = told.collect::<Option<Vec<_>>>()?;
            let more = if parts.len() > MOST_ENTRIES {
                ", ..."
            } else {
                ""
            };
            let separator = if parts.iter().any(Value::is_array) {
                "; "
            } else {
                ", "
            };
            Some(told.join(separator) + more)
        }
        _ => None,
    }
}

/// The standard error of a measure that stands apart from it, where it is known.
fn error(name: &str, errors: &Value) -> Option<String> {
    let at = |name: &str| format!("/{}", name.replace('.', "/"));
    let found = match name {
        "principal.moments" => errors.pointer("/moments"),
        "area" | "volume" => errors.pointer(&at(name)),
        name if name.starts_with("dimensions.") => errors.pointer(&at(name)),
        // Those of centroid and inertia are along the grain's axes, not the scan's.
        _ => None,
    };
    found.and_then(text)
}

/// The unit of a measure, by the power of length that it is.
fn unit_of(name: &str, unit: Option<Unit>) -> String {
    let last = name.rsplit('.').next().unwrap_or_default();
    let first = name.split('.').next().unwrap_or_default();
    let power = match (first, last) {
        ("curvature", "convex_share" | "gauss_bonnet_error") => 0,
        ("curvature", _) if name.contains(".gaussian.") => -2,
        ("curvature", _) => -1,
        (_, "axes") | ("convexity" | "sphericity" | "form" | "ratios", _) => 0,
        ("spectrum", "power") => 2,
        (_, "area") => 2,
        (_, "volume") => 3,
        ("inertia", _) | (_, "moments") => 5,
        ("projections", last) => {
            let lengths = ["perimeter", "feret", "diameter"];
            i32::from(lengths.iter().any(|end| last.ends_with(end)))
        }
        ("centroid" | "dimensions" | "minimum_box" | "spheres" | "ellipsoid", _) => 1,
        _ => 0,
    };
    let Some(unit) = unit.filter(|_| power != 0) else {
        return match power {
            0 => String::new(),
            1 => "unit".into(),
            power => format!("unit{}", raised(power)),
        };
    };
    match power {
        1 => unit.to_string(),
        power => format!("{unit}{}", raised(power)),
    }
}

fn raised(power: i32) -> &'static str {
    match power {
        -2 => "⁻²",
        -1 => "⁻¹",
        2 => "²",
        3 => "³",
        _ => "⁵",
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::StandardErrors;
    use nalgebra::{Matrix3, Vector3};
    use serde_json::json;

    #[test]
    fn errors_stand_beside_what_they_are_of() {
        let record = json!({
            "area": 2.5,
            "curvature": {"larger": {"largest": 7.0}, "standard_errors": {"larger": {"largest": 0.5}}},
            "dimensions": {"length": 3.0},
            "form": {"elongation": 0.5, "standard_errors": {"elongation": 0.25}},
            "principal": {"moments": [1.0, 2.0, 3.0]},
            "roundness": 0.5,
            "roundness_standard_error": 0.0625,
            "spheres": {"inscribed": {"radius": 2.0, "radius_standard_error": 0.125}},
        });
        let errors = StandardErrors {
            area: 0.25,
            dimensions: Vector3::new(0.75, 0.0, 0.0),
            ..StandardErrors::ZERO
        };
        let errors = StandardErrorsRecord::new(&errors, &Matrix3::identity());
        let rows = MeasureRow::of(&record, Some(&errors), None);
        let told: Vec<_> = rows
            .iter()
            .map(|row| (&*row.name, row.error.as_deref()))
            .collect();
        assert_eq!(
            told,
            [
                ("area", Some("0.250000")),
                ("curvature.larger.largest", Some("0.500000")),
                ("dimensions.length", Some("0.750000")),
                ("form.elongation", Some("0.250000")),
                ("principal.moments", Some("0, 0, 0")),
                ("roundness", Some("0.0625000")),
                ("spheres.inscribed.radius", Some("0.125000")),
            ]
        );
    }

    /// What is nothing beside the largest of all rows: beside the largest of its own row it would be told on one side only.
    #[test]
    fn a_symmetric_tensor_is_told_symmetrically() {
        let tensor = json!([[2.0, -3e-12, 0.5], [-3e-12, 4.0, 0.0], [0.5, 0.0, 5.0]]);
        let told = "2.00000, 0, 0.500000; 0, 4.00000, 0; 0.500000, 0, 5.00000";
        assert_eq!(text(&tensor).as_deref(), Some(told));
        assert_eq!(text(&json!(1e-20)).as_deref(), Some("1.00000e-20"));
    }

    #[test]
    fn rows_have_names_units_and_definitions() {
        let record = json!({
            "area": 2.5,
            "roundness": null,
            "principal": {"moments": [1.0, 2.0, 3.0]},
            "projections": [{"along": "length", "perimeter": 4.0, "solidity": 0.5}],
            "curvature": {"gaussian": {"mean": 7.0}},
        });
        let rows = MeasureRow::of(&record, None, Some(Unit::Millimetre));
        let told: Vec<_> = rows
            .iter()
            .map(|row| (&*row.name, &*row.value, &*row.unit))
            .collect();
        assert_eq!(
            told,
            [
                ("area", "2.50000", "mm²"),
                ("curvature.gaussian.mean", "7.00000", "mm⁻²"),
                ("principal.moments", "1.00000, 2.00000, 3.00000", "mm⁵"),
                ("projections.length.perimeter", "4.00000", "mm"),
                ("projections.length.solidity", "0.500000", ""),
            ]
        );
        assert!(
            rows.iter().all(|row| !row.definition.is_empty()),
            "{rows:?}"
        );
    }
}
