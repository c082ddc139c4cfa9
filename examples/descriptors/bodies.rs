//! The twenty bodies at degrees 1 and 3: area, volume, LS error, sphericity and principal moments, and what the
//! text of the source says of them.

use crate::reference::{ABSENT, Printed, Row};
use crate::study::{Figures, Study};
use grainform::fit::MirroredFitError;
use grainform::measure::{MassProperties, integrate, wadell};
use grainform::model::Mirrored;
use grainform::shapes::{Body, SamplingDensity, Spacing};
use nalgebra::Vector3;
use std::error::Error;

/// Polar and azimuthal samples in the octant.
const SAMPLES: [usize; 2] = [16, 8];

/// Semi-axis in x.
const SEMI_AXIS: f64 = 2.0;

const DEGREES: [usize; 2] = [1, 3];

const INTRODUCTION: &str = "\
Those of tables 3.8 and 3.9: a = 2 in x, b in y, c in z. Errors are against the exact figures, principal moments\n\
ascending; LS is the sum of squared relative deviations in 16258 directions. Not reproduced are the figures of\n\
tables C.1 and C.2, which are not at hand. How the source places its points is not said: here they are 128 in an octant,\n\
of the density of the area, or all directions that LS is told of, equiangular. How long b of the tri-axial ellipsoids\n\
is is not said either: here (a + c) / 2.\n";

const CONCLUSION: &str = "\
The percents of the text are not reproduced. Of which figure they are is not said, only that the area is the most\n\
sensitive. Ellipsoids are within 2 % at L = 1 as it says; most cylinders and bicones are not. Octahedra fall to less than\n\
0.4 % at L = 3 with either placing. Parallelepipeds come near to what it says with all directions only.";

/// What the text says of groups of the bodies.
const SAYINGS: [Saying; 3] = [
    Saying {
        text: "equal-sized and extended bodies without flat faces: L = 1 is enough, below 2 %",
        holds: |body, elongation| is_round(body) && elongation >= 1.0,
    },
    Saying {
        text: "octahedra: 1.8 % at L = 1, 0.30 % at L = 3",
        holds: |body, _| body == Body::Octahedron,
    },
    Saying {
        text: "parallelepipeds: 15 to 24 % at L = 1, 5 % at L = 3",
        holds: |body, _| body == Body::Cuboid,
    },
];

/// A sentence of the source on some of the bodies.
struct Saying {
    text: &'static str,
    /// Whether it is about a body of this c/a.
    holds: fn(Body, f64) -> bool,
}

/// Where the points of a body are.
#[derive(Clone, Copy, PartialEq)]
enum Placing {
    OfTheArea,
    Equiangular,
}

const PLACINGS: [Placing; 2] = [Placing::OfTheArea, Placing::Equiangular];

impl Placing {
    fn name(self) -> &'static str {
        match self {
            Self::OfTheArea => "128 in an octant",
            Self::Equiangular => "16258",
        }
    }

    fn model(self, study: &Study) -> Result<Mirrored, MirroredFitError> {
        let [polar, azimuth] = SAMPLES;
        match self {
            Self::OfTheArea => {
                study.model(&SamplingDensity::AREA.sample(study.shape.as_ref(), polar, azimuth))
            }
            Self::Equiangular => study.model(&study.directions),
        }
    }
}

/// A body of the list at one degree, fitted to points so placed.
struct Entry {
    body: Body,
    elongation: f64,
    degree: usize,
    placing: Placing,
    area_error: f64,
    volume_error: f64,
}

/// Prints the bodies, and what is said of them; where the list is absent, that it is.
pub(crate) fn print() -> Result<(), Box<dyn Error>> {
    let Some(list) = Printed::read("shapes_3_8_3_9.csv") else {
        println!("{ABSENT}");
        return Ok(());
    };
    println!(
        "{}\n{INTRODUCTION}\n\
         | no | body | b/a | c/a | L | points | S | off | V | off | LS | sphericity | exact | I1 | I2 | I3 |\n\
         |---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|",
        list.head
    );
    let mut entries = Vec::new();
    for row in &list.rows {
        for degree in DEGREES {
            entries.extend(entries_of(row, degree)?);
        }
    }
    println!(
        "\n| what the text says | L | points | area off | volume off |\n|---|---|---|---|---|"
    );
    for saying in SAYINGS {
        for degree in DEGREES {
            for placing in PLACINGS {
                saying.print(&entries, degree, placing);
            }
        }
    }
    println!("\n{CONCLUSION}");
    Ok(())
}

impl Saying {
    /// Prints the range of errors of the bodies that the sentence is about.
    fn print(&self, entries: &[Entry], degree: usize, placing: Placing) {
        let about = |entry: &&Entry| {
            entry.degree == degree
                && entry.placing == placing
                && (self.holds)(entry.body, entry.elongation)
        };
        let about: Vec<&Entry> = entries.iter().filter(about).collect();
        println!(
            "| {} | {degree} | {} | {} | {} |",
            self.text,
            placing.name(),
            range(about.iter().map(|entry| entry.area_error)),
            range(about.iter().map(|entry| entry.volume_error)),
        );
    }
}

/// Least and largest of absolute errors, in percent.
fn range(errors: impl Iterator<Item = f64>) -> String {
    let percents = errors.map(|error| 100.0 * error.abs());
    let (least, largest) = percents.fold((f64::INFINITY, 0.0_f64), |(least, largest), error| {
        (least.min(error), largest.max(error))
    });
    format!("{least:.2} to {largest:.2} %")
}

/// Without flat faces.
fn is_round(body: Body) -> bool {
    body == Body::Ellipsoid || body == Body::Bicone || body == Body::Cylinder
}

/// The body of a row of the list, and its semi-axes.
fn body(row: &Row) -> Result<(Body, Vector3<f64>), Box<dyn Error>> {
    let elongation = row.get("elongation").ok_or("a body without elongation")?;
    let (body, width) = match row.text("body") {
        "axisymmetric ellipsoid" => (Body::Ellipsoid, 1.0),
        "tri-axial ellipsoid" => (Body::Ellipsoid, 0.5 * (1.0 + elongation)),
        "circular cylinder" => (Body::Cylinder, 1.0),
        "bicone" => (Body::Bicone, 1.0),
        "octahedron" => (Body::Octahedron, 1.0),
        "square parallelepiped" => (Body::Cuboid, 1.0),
        // c / b = 2/3.
        "rectangular parallelepiped" => (Body::Cuboid, 1.5 * elongation),
        other => return Err(format!("there is no body named {other:?}").into()),
    };
    Ok((body, Vector3::new(1.0, width, elongation) * SEMI_AXIS))
}

/// Prints a body at a degree, a row per placing.
fn entries_of(row: &Row, degree: usize) -> Result<Vec<Entry>, Box<dyn Error>> {
    let (body, axes) = body(row)?;
    let study = Study::new(body.with_axes(axes)?, degree, Spacing::Equiangular)?;
    let elongation = axes.z / axes.x;
    let start = format!(
        "| {} | {} | {:.3} | {elongation} | {degree}",
        row.text("no"),
        row.text("body"),
        axes.y / axes.x
    );
    let mut entries = Vec::new();
    for placing in PLACINGS {
        let model = placing.model(&study)?;
        let figures = study.figures(&model);
        println!(
            "{start} | {} {}",
            placing.name(),
            cells(&study, &model, &figures)?
        );
        entries.push(Entry {
            body,
            elongation,
            degree,
            placing,
            area_error: figures.area_error,
            volume_error: figures.volume_error,
        });
    }
    Ok(entries)
}

/// The figures of a model as the end of a row.
fn cells(study: &Study, model: &Mirrored, figures: &Figures) -> Result<String, Box<dyn Error>> {
    let found = integrate(model, 1e-8).properties;
    let moments = |properties: &MassProperties| properties.principal().map(|p| p.moments);
    let (Some(ours), Some(exact)) = (moments(&found), moments(&study.exact)) else {
        return Err("a model without principal axes".into());
    };
    let off = ours.component_div(&exact).add_scalar(-1.0) * 100.0;
    Ok(format!(
        "| {:.3} | {:+.2} % | {:.3} | {:+.2} % | {:.4} | {:.4} | {:.4} | {:+.2} % | {:+.2} % | {:+.2} % |",
        found.area,
        100.0 * figures.area_error,
        found.volume,
        100.0 * figures.volume_error,
        figures.ls_ratio * study.threshold,
        wadell(found.area, found.volume),
        wadell(study.exact.area, study.exact.volume),
        off.x,
        off.y,
        off.z,
    ))
}
