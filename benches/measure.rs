//! Time of each measure alone, as `grainform measure --only` computes it, of a fitted maize kernel and of
//! a scan of it, on one thread; as a ratio to area and volume, so that it shows what is saved by not
//! asking: `cargo bench --bench measure`.

mod timing;

use grainform::contact::{RelativeCurvature, touch};
use grainform::fit::scanned_surface;
use grainform::measure::{Scheme, Survey};
use grainform::report::{Measure, MeasureReport, Measured};
use grainform::scan::Scan;
use grainform::shapes::{Body, SynthOptions, synthesize};
use grainform::{FitOptions, StarSurface, fit};
use nalgebra::Vector3;
use timing::median;

const RUNS: usize = 9;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    rayon::ThreadPoolBuilder::new()
        .num_threads(1)
        .build_global()?;
    let scan = Scan::from_points(synthesize(&SynthOptions::clean(Body::Maize))?.points);
    let grain = fit(&scan, &FitOptions::default())?.grain;
    let surface = scanned_surface(&scan)?;
    let time = |of_model: bool, only: &[Measure]| {
        median(RUNS, || {
            let survey = match of_model {
                true => Survey::of_grain(&grain, Scheme::Exact),
                false => Survey::of_mesh(&surface.mesh).ok()?,
            };
            let (name, of) = (String::new(), Measured::Model);
            Some(MeasureReport::new(name, of, &survey, only, Vec::new()))
        })
    };
    let least = [Measure::Area, Measure::Volume];
    let base = [true, false].map(|of_model| time(of_model, &least));
    println!("| measure | model, ms | / area and volume | scan, ms | / area and volume |");
    println!("|---|---|---|---|---|");
    let row = |name: &str, only: &[Measure]| {
        let [model, scan] = [true, false].map(|of_model| time(of_model, only));
        println!(
            "| {name} | {:.1} | {:.1} | {:.1} | {:.1} |",
            1e3 * model,
            model / base[0],
            1e3 * scan,
            scan / base[1]
        );
    };
    row("area and volume", &least);
    for measure in Measure::ALL {
        row(measure.name(), &[measure]);
    }
    row("everything", &Measure::ALL);

    let direction = Vector3::new(0.3, -0.2, -0.9).normalize();
    let star = grain.star().expect("a radius");
    let evaluation = median(RUNS, || {
        (0..1000).map(|_| star.radius(&direction)).sum::<f64>()
    });
    let contact = median(RUNS, || {
        let touch = touch(&grain, &direction, None).ok()?;
        let relative = RelativeCurvature::new(touch.principal, [0.0; 2], 0.0).ok()?;
        Some(relative.normal_force_n(1e-3, 1e-5, 1e8))
    });
    println!(
        "\nA contact with a plane, found from nothing: {:.2} ms, {:.0} evaluations of the radius.",
        1e3 * contact,
        contact / (evaluation / 1000.0)
    );
    Ok(())
}
