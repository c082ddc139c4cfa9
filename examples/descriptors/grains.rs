//! Descriptors of fits beside those of the closed form that the points were taken from: the three synthetic
//! grains at their native size, clean and with noise of 0.5 % of the mean radius.

use grainform::measure::{Scheme, Survey, SurveyError};
use grainform::scan::Scan;
use grainform::shapes::{Body, SynthOptions, synthesize};
use grainform::{FitOptions, fit};

const NAMES: [&str; 13] = [
    "length",
    "width",
    "thickness",
    "minimum box, volume",
    "inscribed radius",
    "enclosing radius",
    "sphericity (Wadell)",
    "roundness",
    "angularity",
    "convexity",
    "outline from above, area",
    "mean of mean curvature",
    "largest curvature",
];

/// Prints a table for each noise.
pub(crate) fn print() -> Result<(), Box<dyn std::error::Error>> {
    for noise in [0.0, 0.005] {
        println!("noise {} %\n", 100.0 * noise);
        let mut columns = Vec::new();
        for body in [Body::Bean, Body::Chickpea, Body::Maize] {
            let solid = body.surface();
            let known = solid.integrals().properties;
            let truth = figures(&Survey::of_surface(solid.as_ref(), known))?;
            let points =
                synthesize(&SynthOptions::clean(body).with_noise(noise).with_seed(1))?.points;
            let scan = Scan::from_points(points);
            let grain = fit(&scan, &FitOptions::default())?.grain;
            columns.push((truth, figures(&Survey::of_grain(&grain, Scheme::Exact))?));
        }
        println!("| measure | bean | fit | chickpea | fit | maize | fit |");
        println!("|---|---|---|---|---|---|---|");
        for (i, name) in NAMES.iter().enumerate() {
            let cells: String = columns
                .iter()
                .map(|(truth, found)| {
                    let error = 100.0 * (found[i] / truth[i] - 1.0);
                    format!(" {:.4} | {error:+.2} % |", truth[i])
                })
                .collect();
            println!("| {name} |{cells}");
        }
        println!();
    }
    Ok(())
}

fn figures(survey: &Survey<'_>) -> Result<[f64; 13], SurveyError> {
    let [length, width, thickness] = survey.dimensions()?.into();
    let curvature = survey.curvature()?;
    let [.., from_above] = survey.projections()?;
    Ok([
        length,
        width,
        thickness,
        survey.minimum_box()?.volume(),
        survey.inscribed()?.radius,
        survey.enclosing()?.radius,
        survey.sphericity()?.wadell,
        survey.roundness()?,
        survey.angularity()?,
        survey.convexity()?.volume,
        from_above.area,
        curvature.mean().mean,
        curvature.larger().largest,
    ])
}
