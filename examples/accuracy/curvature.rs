//! Curvatures of fits, and the force of a plane that presses on them, against the closed forms.

use grainform::contact::{Correction, RelativeCurvature};
use grainform::measure::Curvature;
use grainform::model::Radial;
use grainform::scan::Scan;
use grainform::shapes::{Body, Sampling, SynthOptions, synthesize};
use grainform::{FitOptions, Surface, fit};
use nalgebra::Vector3;
use std::error::Error;

/// Directions in which curvatures are compared.
const PLACES: usize = 5000;

/// Normal quantile of a two-sided interval of 95 %.
const QUANTILE: f64 = 1.96;

/// Bodies with their semi-axes: three ellipsoids, and three grains, which have one size.
const BODIES: [(Body, Option<[f64; 3]>); 6] = [
    (Body::Ellipsoid, Some([2.0, 2.0, 1.0])),
    (Body::Ellipsoid, Some([4.0, 2.0, 2.0])),
    (Body::Ellipsoid, Some([5.0, 4.0, 2.0])),
    (Body::Bean, None),
    (Body::Chickpea, None),
    (Body::Maize, None),
];

pub(crate) fn print() -> Result<(), Box<dyn Error>> {
    println!("| body | points | noise | largest curvature | radii of curvature | force | within |");
    println!("|---|---|---|---|---|---|---|");
    for (body, axes) in BODIES {
        let axes = axes.map(Vector3::from);
        for (points, noise) in [(1538, 0.0), (6146, 0.0), (1538, 0.005), (6146, 0.005)] {
            let options = SynthOptions::clean(body)
                .with_axes(axes)
                .with_points(points)
                .with_noise(noise);
            println!("{}", row(body, axes, &options)?);
        }
    }
    Ok(())
}

fn row(
    body: Body,
    axes: Option<Vector3<f64>>,
    options: &SynthOptions,
) -> Result<String, Box<dyn Error>> {
    let scan = Scan::from_points(synthesize(options)?.points);
    let grain = fit(&scan, &FitOptions::default())?.grain_with_errors();
    let truth = axes.map_or_else(|| Ok(body.surface()), |axes| body.with_axes(axes))?;
    let (mut sharpest, mut sharpest_told) = (0.0_f64, 0.0_f64);
    let (mut radii, mut force) = (0.0_f64, Some(0.0_f64));
    let mut within = 0;
    for n in Sampling::Fibonacci.directions(PLACES, 0)? {
        let told = Curvature::new(&n, &grain.jet(&n)).principal;
        // The closed form at the same place, whose direction from its own origin is another.
        let place = grain.point(&n).coords.normalize();
        let exact = Curvature::new(&place, &Radial(truth.as_ref()).jet(&place)).principal;
        let error = grain.local_error(&n).ok_or("an estimate")?.curvature;
        sharpest = sharpest.max(exact[0].max(exact[1]));
        sharpest_told = sharpest_told.max(told[0].max(told[1]));
        for (told, exact) in told.into_iter().zip(exact) {
            within += usize::from((told - exact).abs() <= QUANTILE * error);
            radii = radii.max((exact / told - 1.0).abs());
        }
        let off = pressed(told)
            .zip(pressed(exact))
            .map(|(told, exact)| (told / exact - 1.0).abs());
        force = force.zip(off).map(|(most, off)| most.max(off));
    }
    let name = axes.map_or(body.to_string(), |a| {
        format!("{body} {}:{}:{}", a.x, a.y, a.z)
    });
    let of_convex = |share: f64| match force {
        Some(_) => format!("{:.3} %", 100.0 * share),
        None => "-".into(),
    };
    Ok(format!(
        "| {name} | {} | {} % | {:+.2} % | {} | {} | {:.1} % |",
        options.points,
        100.0 * options.noise,
        100.0 * (sharpest_told / sharpest - 1.0),
        of_convex(radii),
        of_convex(force.unwrap_or_default()),
        50.0 * within as f64 / PLACES as f64,
    ))
}

/// The force of a plane but for a factor that is the same everywhere; none where the surface is not convex.
fn pressed(principal: [f64; 2]) -> Option<f64> {
    let relative = RelativeCurvature::new(principal, [0.0; 2], 0.0).ok()?;
    Some(relative.correction(Correction::Elliptic) * relative.effective_radius().sqrt())
}
