//! Twenty bodies at degrees 1 and 3: area, volume, LS error, sphericity and principal moments.

use crate::chapter_3::study::Study;
use grainform::measure::{MassProperties, integrate};
use grainform::shapes::{Body, SamplingDensity, Spacing, edge_gauss};
use nalgebra::Vector3;
use std::error::Error;
use std::f64::consts::PI;

/// Polar and azimuthal samples in the octant.
const SAMPLES: [usize; 2] = [16, 8];

/// Semi-axis in x and y.
const SEMI_AXIS: f64 = 2.0;

/// Prints the table.
pub(crate) fn print() -> Result<(), Box<dyn Error>> {
    println!(
        "| body | c/a | L | S | V | LS | sphericity | exact | I1 | I2 | I3 |\n\
         |---|---|---|---|---|---|---|---|---|---|---|"
    );
    for body in [
        Body::Ellipsoid,
        Body::Cylinder,
        Body::Bicone,
        Body::Octahedron,
        Body::Cuboid,
    ] {
        for elongation in [0.4, 0.5, 0.75, 1.0] {
            for degree in [1, 3] {
                println!("{}", row(body, elongation, degree)?);
            }
        }
    }
    Ok(())
}

fn row(body: Body, elongation: f64, degree: usize) -> Result<String, Box<dyn Error>> {
    let axes = Vector3::new(1.0, 1.0, elongation) * SEMI_AXIS;
    let study = Study::new(body.with_axes(axes)?, degree, Spacing::Equiangular)?;
    let [polar, azimuth] = SAMPLES;
    let samples = edge_gauss(study.shape.as_ref(), polar, azimuth, SamplingDensity::AREA);
    let model = study.model(&samples)?;
    let found = integrate(&model, 1e-8).properties;
    let figures = study.figures_with(&model, &found);
    let moments = |properties: &MassProperties| properties.principal().map(|p| p.moments);
    let (Some(ours), Some(exact)) = (moments(&found), moments(&study.exact)) else {
        return Err("a model without principal axes".into());
    };
    let off = ours.component_div(&exact).add_scalar(-1.0) * 100.0;
    Ok(format!(
        "| {body} | {elongation} | {degree} | {:+.2} % | {:+.2} % | {:.4} | {:.4} | {:.4} | {:+.2} % | \
         {:+.2} % | {:+.2} % |",
        100.0 * figures.area_error,
        100.0 * figures.volume_error,
        figures.ls_ratio * study.threshold,
        sphericity(&found),
        sphericity(&study.exact),
        off.x,
        off.y,
        off.z,
    ))
}

/// Wadell's: the area of the sphere of equal volume over the area.
fn sphericity(solid: &MassProperties) -> f64 {
    (PI * (6.0 * solid.volume).powi(2)).cbrt() / solid.area
}
