//! Measures of shape: how often their intervals hold the truth, and how wide they are.

use crate::particle::Particle;
use grainform::measure::{CurvatureErrors, Distribution, Scheme, Survey, SurveyError};
use grainform::model::{Frame, StarGrain};
use grainform::shapes::Sampling;
use grainform::{FitOptions, fit};
use std::collections::BTreeMap;
use std::error::Error;

/// Standard errors within which 95 % of the truths should lie.
const QUANTILE: f64 = 1.96;

/// Points and noise of the scans, as a share of the mean radius.
pub(crate) const SCANS: [(usize, f64); 4] =
    [(1538, 0.0), (1538, 0.005), (1538, 0.02), (6146, 0.005)];

/// What is measured, and what is told of its error.
type Told = BTreeMap<String, (f64, Option<f64>)>;

/// Fits a scan of each body, and prints a row for each measure.
pub(crate) fn print(
    particles: &[Particle],
    points: usize,
    noise: f64,
) -> Result<(), Box<dyn Error>> {
    let mut deviations: BTreeMap<String, Vec<[f64; 3]>> = BTreeMap::new();
    let directions = Sampling::Cube.directions(points, 0)?;
    for (seed, particle) in (0..).zip(particles) {
        let scan = particle.scan(&directions, noise, seed);
        let truth = StarGrain::expansion(Frame::SCAN, particle.coefficients.clone())?.into();
        let Ok(fitted) = fit(&scan, &FitOptions::default()) else {
            continue;
        };
        let grain = fitted.grain_with_errors();
        let told = measured(&Survey::of_grain(&grain, Scheme::Exact));
        let (Ok(told), Ok(exact)) = (told, measured(&Survey::of_grain(&truth, Scheme::Exact)))
        else {
            continue;
        };
        for (name, (value, error)) in told {
            if let (Some(error), Some((exact, _))) = (error, exact.get(&name)) {
                let own = [
                    if value == *exact {
                        0.0
                    } else {
                        (value - exact) / error
                    },
                    error / exact.abs(),
                    (value / exact - 1.0).abs(),
                ];
                deviations.entry(name).or_default().push(own);
            }
        }
    }
    let percent = 100.0 * noise;
    println!("\n{points} points, noise {percent} %\n");
    println!("| measure | told of | held | mean | error told, median | off, median |");
    println!("|---|---|---|---|---|---|");
    for (name, own) in deviations {
        let of = own.len();
        let held = own.iter().filter(|own| own[0].abs() <= QUANTILE).count();
        let mean = own.iter().map(|own| own[0]).sum::<f64>() / of as f64;
        let [told, off] = [1, 2].map(|at| {
            let mut values: Vec<f64> = own.iter().map(|own| own[at]).collect();
            values.sort_unstable_by(f64::total_cmp);
            100.0 * values[of / 2]
        });
        let held = 100.0 * held as f64 / of as f64;
        println!("| {name} | {of} | {held:.0} % | {mean:+.1} | {told:.2} % | {off:.2} % |");
    }
    Ok(())
}

fn measured(survey: &Survey<'_>) -> Result<Told, SurveyError> {
    let mut told = Told::new();
    let mut tell = |name: &str, value: f64, error: Option<f64>| {
        told.insert(name.into(), (value, error));
    };
    tell("roundness", survey.roundness()?, survey.roundness_error()?);
    tell(
        "regularity",
        survey.regularity()?,
        survey.regularity_error()?,
    );
    tell(
        "angularity",
        survey.angularity()?,
        survey.angularity_error()?,
    );
    let curvature = survey.curvature()?;
    let errors = survey.curvature_errors()?;
    let mut tell_all =
        |name: &str, own: Distribution, off: fn(&CurvatureErrors) -> Distribution| {
            let off = errors.as_ref().map(off);
            for (part, of) in [
                ("mean", (|own| own.mean) as fn(&Distribution) -> f64),
                ("SD", |own| own.standard_deviation),
                ("least", |own| own.least),
                ("largest", |own| own.largest),
            ] {
                tell(
                    &format!("curvature: {name}, {part}"),
                    of(&own),
                    off.as_ref().map(of),
                );
            }
        };
    tell_all("mean", curvature.mean(), |off| off.mean);
    tell_all("Gaussian", curvature.gaussian(), |off| off.gaussian);
    tell_all("larger", curvature.larger(), |off| off.larger);
    tell_all("smaller", curvature.smaller(), |off| off.smaller);
    tell(
        "curvature: convex share",
        curvature.convex_share(),
        errors.map(|off| off.convex_share),
    );
    let (spectrum, errors) = (survey.spectrum()?, survey.spectrum_errors()?);
    for degree in [2, 4, 8, 16] {
        let off = errors.as_ref().map(|off| off.relative_amplitude[degree]);
        tell(
            &format!("spectrum, degree {degree}"),
            spectrum.relative_amplitude[degree],
            off,
        );
    }
    let outlines = survey.projections()?;
    let errors = survey.projection_errors(&outlines)?;
    for (i, along) in ["length", "width", "thickness"].into_iter().enumerate() {
        let off = errors.as_ref().map(|off| off[i].roundness);
        tell(
            &format!("outline, roundness along the {along}"),
            outlines[i].roundness,
            off,
        );
    }
    Ok(told)
}
