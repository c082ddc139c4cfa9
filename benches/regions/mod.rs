//! Contacts of grains of any shape as they move: from nothing, from the last pose, and the volume they share.

use crate::timing::median;
use grainform::contact::{ContactBody, ContactPair, contact_regions};
use grainform::model::Radial;
use grainform::nalgebra::{Isometry3, Vector3};
use grainform::shapes::{Body, Ellipsoid, SynthOptions, synthesize};
use grainform::{FitOptions, Scan, Surface, fit};

/// Runs of what takes milliseconds, and of what takes less.
const SLOW_RUNS: usize = 5;
const RUNS: usize = 25;

/// Poses of a path, and by how much of its size a body moves from one to the next.
const POSES: u32 = 100;
const STEP: f64 = 1e-4;

/// How deep the bodies are in each other, as a share of their size.
const DEPTH: f64 = 0.01;

/// Prints a table of times, each as a ratio to the floor too: evaluating both surfaces with their derivatives once.
pub(crate) fn print() -> Result<(), Box<dyn std::error::Error>> {
    println!(
        "\n| bodies | prepared, ms | from nothing, ms | / floor | warm, us | / floor | volume, us | / floor | floor, us |"
    );
    println!("|---|---|---|---|---|---|---|---|---|");
    let ellipsoid = Ellipsoid {
        semi_axes: Vector3::new(1.0, 0.8, 0.6),
    };
    println!("| ellipsoids | {} |", row(&Radial(&ellipsoid))?);
    for body in [Body::Bean, Body::Maize] {
        let scan = synthesize(&SynthOptions::clean(body).with_points(6146))?;
        let grain = fit(&Scan::from_points(scan.points), &FitOptions::default())?.grain;
        println!("| {body}, harmonics | {} |", row(&grain)?);
    }
    Ok(())
}

fn row(surface: &dyn Surface) -> Result<String, Box<dyn std::error::Error>> {
    let body = ContactBody::new(surface);
    let towards = Vector3::new(0.5, 0.3, 0.8).normalize();
    let size = surface.place(&towards).norm();
    let pose = |distance: f64, step: u32| {
        let turn = Vector3::new(0.1, 0.3, 0.2 + STEP * f64::from(step));
        Isometry3::new(towards * distance, turn)
    };
    // As near as the bodies touch.
    let [mut near, mut far] = [size, 4.0 * size];
    while far - near > 1e-6 * size {
        let middle = 0.5 * (near + far);
        match contact_regions(&body, &body, &pose(middle, 0))?
            .regions
            .is_empty()
        {
            true => far = middle,
            false => near = middle,
        }
    }
    let pose = |step: u32| pose(near - DEPTH * size, step);
    let floor = median(RUNS, || {
        let jets = (0..POSES).map(|_| [towards, -towards].map(|n| surface.jet(&n).place));
        jets.map(|[one, other]| one.x + other.x).sum::<f64>()
    }) / f64::from(POSES);
    let prepared = median(SLOW_RUNS, || ContactBody::new(surface));
    let cold = median(SLOW_RUNS, || contact_regions(&body, &body, &pose(0)));
    let mut pair = ContactPair::new(&body, &body);
    let mut places = 0;
    let warm = median(RUNS, || {
        places = 0;
        for step in (0..POSES).chain((0..POSES).rev()) {
            places += pair.update(&pose(step)).map_or(0, |()| pair.places().len());
        }
    }) / places as f64;
    let place = pair.places().first().ok_or("the bodies do not touch")?;
    let volume = median(RUNS, || pair.region(place));
    let micro = |seconds: f64| format!("{:.1} | {:.1}", 1e6 * seconds, seconds / floor);
    Ok(format!(
        "{:.1} | {:.1} | {:.0} | {} | {} | {:.2}",
        1e3 * prepared,
        1e3 * cold,
        cold / floor,
        micro(warm),
        micro(volume),
        1e6 * floor
    ))
}
