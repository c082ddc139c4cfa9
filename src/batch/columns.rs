//! The columns of results, in their order; `docs/results.md` describes them.

use crate::report::Measure;

/// What the cells of a column hold. An empty cell is one that is not known.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Kind {
    /// Text.
    Text,
    /// A whole number.
    Count,
    /// A number.
    Real,
}

/// A column of results.
#[derive(Debug, Clone, PartialEq, Eq)]
#[non_exhaustive]
pub(crate) struct Column {
    /// Its name.
    pub name: String,
    /// What its cells hold.
    pub kind: Kind,
}

/// A number of a record, by where it stands there.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Figure {
    /// Name of its column.
    pub(super) name: String,
    /// JSON pointer into the report of measures.
    pub(super) measured: String,
    /// JSON pointer to its standard error, likewise.
    pub(super) error: Option<String>,
}

/// Columns that every table begins with.
pub(super) const FIRST: [(&str, Kind); 21] = [
    ("path", Kind::Text),
    ("status", Kind::Text),
    ("reason", Kind::Text),
    ("hash", Kind::Text),
    ("version", Kind::Text),
    ("settings", Kind::Text),
    ("unit", Kind::Text),
    ("points", Kind::Count),
    ("degree", Kind::Count),
    ("segments", Kind::Count),
    ("coefficients", Kind::Count),
    ("mean_radius", Kind::Real),
    ("noise", Kind::Real),
    ("noise_is_bound", Kind::Count),
    ("rms", Kind::Real),
    ("heldout_rms", Kind::Real),
    ("area_error", Kind::Real),
    ("volume_error", Kind::Real),
    ("no_standard_errors", Kind::Text),
    ("not_measured", Kind::Text),
    ("warnings", Kind::Text),
];

/// The measures by which grains are compared, as far as they are there, and whether they have a unit.
pub(super) const MAIN: [(&str, bool); 11] = [
    ("area", true),
    ("volume", true),
    ("dimensions.length", true),
    ("dimensions.width", true),
    ("dimensions.thickness", true),
    ("form.elongation", false),
    ("form.flatness", false),
    ("sphericity.wadell", false),
    ("roundness", false),
    ("convexity.volume", false),
    ("heldout_rms", true),
];

/// Whether a table with such columns may be one of `batch`.
pub(super) fn are_results<'a>(names: impl Iterator<Item = &'a str> + Clone) -> bool {
    let [(scan, _), (status, _), ..] = FIRST;
    [scan, status]
        .iter()
        .all(|own| names.clone().any(|name| name == *own))
}

/// Where the standard errors stand in the report of measures.
const ERRORS: &str = "/standard_errors";

/// Outlines, and what is measured of each.
const ALONG: [&str; 3] = ["length", "width", "thickness"];
const OUTLINE: [&str; 17] = [
    "area",
    "perimeter",
    "equivalent_diameter",
    "largest_feret",
    "smallest_feret",
    "enclosing_diameter",
    "inscribed_diameter",
    "area_sphericity",
    "diameter_sphericity",
    "circle_ratio",
    "riley_sphericity",
    "perimeter_sphericity",
    "circularity",
    "width_to_length",
    "solidity",
    "convexity",
    "roundness",
];

/// Degrees of the spectrum that are told: degree 0 is 1, and 1 is nearly nothing.
const SPECTRUM: std::ops::RangeInclusive<usize> = 2..=12;

/// The columns of results of these measures.
pub(crate) fn columns(measures: &[Measure]) -> Vec<Column> {
    let first = FIRST.iter().map(|&(name, kind)| Column {
        name: name.into(),
        kind,
    });
    let figures = figures(measures).into_iter().flat_map(|figure| {
        let error = figure.error.map(|_| format!("{}_se", figure.name));
        [Some(figure.name), error]
    });
    let figures = figures.flatten().map(|name| Column {
        name,
        kind: Kind::Real,
    });
    first.chain(figures).collect()
}

/// The columns of measures among those of a table, without their standard errors.
pub(crate) fn measures(columns: &[String]) -> Vec<String> {
    let is_measure = |name: &&String| {
        !name.ends_with("_se") && FIRST.iter().all(|(first, _)| *first != name.as_str())
    };
    columns.iter().filter(is_measure).cloned().collect()
}

/// Whether a column has the name of a figure.
pub(super) fn is_figure(name: &str) -> bool {
    figures(&Measure::ALL)
        .iter()
        .any(|figure| figure.name == name)
}

/// The figures of some measures, in their order.
pub(super) fn figures(measures: &[Measure]) -> Vec<Figure> {
    measures
        .iter()
        .flat_map(|measure| of_measure(*measure))
        .collect()
}

fn of_measure(measure: Measure) -> Vec<Figure> {
    let name = measure.name();
    match measure {
        Measure::Area | Measure::Volume => {
            vec![with_error(figure(name, "", ""), format!("{ERRORS}/{name}"))]
        }
        Measure::Centroid => numbered(name, ["x", "y", "z"], ""),
        Measure::Inertia => [
            ("xx", "0/0"),
            ("yy", "1/1"),
            ("zz", "2/2"),
            ("xy", "0/1"),
            ("xz", "0/2"),
            ("yz", "1/2"),
        ]
        .map(|(axes, at)| figure(name, axes, at))
        .into(),
        Measure::Principal => (0..3)
            .map(|i| {
                let moment = figure(name, &format!("moment_{}", i + 1), &format!("moments/{i}"));
                with_error(moment, format!("{ERRORS}/moments/{i}"))
            })
            .collect(),
        Measure::Dimensions => ALONG
            .map(|side| {
                let error = format!("{ERRORS}/dimensions/{side}");
                with_error(figure(name, side, side), error)
            })
            .into(),
        Measure::MinimumBox => known(name, &["length", "width", "thickness", "volume"]),
        Measure::Ratios => known(
            name,
            &[
                "short_to_long",
                "intermediate_to_long",
                "short_to_intermediate",
            ],
        ),
        Measure::Form => known(name, &["aspect_ratio", "elongation", "flatness"]),
        Measure::Spheres => ["inscribed", "enclosing"]
            .map(|ball| {
                let radius = figure(name, &format!("{ball}_radius"), &format!("{ball}/radius"));
                with_error(radius, format!("/{name}/{ball}/radius_standard_error"))
            })
            .into(),
        Measure::Sphericity => known(
            name,
            &[
                "wadell",
                "operational",
                "inscribed_enclosing",
                "inscribed_enclosing_root",
                "krumbein",
                "maximum_projection",
            ],
        ),
        Measure::Convexity => known(name, &["volume", "area"]),
        Measure::Ellipsoid => numbered(name, ["a", "b", "c"], "semi_axes")
            .into_iter()
            .enumerate()
            .map(|(i, axis)| with_error(axis, format!("/{name}/semi_axes_standard_errors/{i}")))
            .collect(),
        Measure::Projections => (0..3)
            .flat_map(|i| {
                OUTLINE.map(|part| {
                    let at = format!("{i}/{part}");
                    let found = figure(name, &format!("{}.{part}", ALONG[i]), &at);
                    with_error(found, format!("/{name}/{i}{ERRORS}/{part}"))
                })
            })
            .collect(),
        Measure::Curvature => {
            let kinds = ["mean", "gaussian", "larger", "smaller"].into_iter();
            let of_kind = |kind, part| {
                let at = format!("{kind}/{part}");
                let found = figure(name, &format!("{kind}.{part}"), &at);
                with_error(found, format!("/{name}{ERRORS}/{at}"))
            };
            let mut all: Vec<Figure> = kinds
                .flat_map(|kind| {
                    ["mean", "standard_deviation", "least", "largest"]
                        .map(|part| of_kind(kind, part))
                })
                .collect();
            all.extend(known(name, &["convex_share"]));
            all.push(figure(name, "gauss_bonnet_error", "gauss_bonnet_error"));
            all
        }
        Measure::Spectrum => SPECTRUM
            .map(|l| {
                let at = format!("relative_amplitude/{l}");
                let found = figure(name, &format!("relative_amplitude_{l}"), &at);
                with_error(found, format!("/{name}{ERRORS}/{at}"))
            })
            .collect(),
        Measure::Roundness | Measure::Regularity | Measure::Angularity => {
            vec![with_error(
                figure(name, "", ""),
                format!("/{name}_standard_error"),
            )]
        }
    }
}

/// Parts of a measure of which the record holds standard errors, too.
fn known(name: &str, parts: &[&str]) -> Vec<Figure> {
    let part = |part: &&str| {
        let error = format!("/{name}{ERRORS}/{part}");
        with_error(figure(name, part, part), error)
    };
    parts.iter().map(part).collect()
}

fn numbered(name: &str, parts: [&str; 3], list: &str) -> Vec<Figure> {
    let list = if list.is_empty() {
        String::new()
    } else {
        format!("{list}/")
    };
    (0..3)
        .map(|i| figure(name, parts[i], &format!("{list}{i}")))
        .collect()
}

/// A part of a measure, where it stands in its record; empty is the measure itself.
fn figure(measure: &str, part: &str, at: &str) -> Figure {
    let join = |separator: &str, part: &str| match part {
        "" => measure.to_owned(),
        part => format!("{measure}{separator}{part}"),
    };
    Figure {
        name: join(".", part),
        measured: format!("/{}", join("/", at)),
        error: None,
    }
}

fn with_error(figure: Figure, error: String) -> Figure {
    Figure {
        error: Some(error),
        ..figure
    }
}
