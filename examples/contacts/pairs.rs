//! Contacts of two fitted grains beside those of the bodies that they were fitted to, placed alike.

use grainform::contact::{
    ContactBody, ContactRegion, KnownContact, contact_regions, reach, told_depth,
};
use grainform::model::{Grain, Radial, Surface};
use grainform::scan::Scan;
use grainform::shapes::{Body, Sampling, SynthOptions, synthesize};
use grainform::{FitOptions, fit};
use nalgebra::{Isometry3, Translation3, Unit, UnitQuaternion, Vector3};
use std::error::Error;
use std::f64::consts::TAU;

/// Poses of each pair.
const POSES: usize = 20;

/// How deep the bodies lie in each other, as a share of the mean radius.
const DEPTHS: [f64; 2] = [0.005, 0.03];

pub(crate) fn print() -> Result<(), Box<dyn Error>> {
    println!("| bodies | points | noise | forces told | depth | volume | curvature | force |");
    println!("|---|---|---|---|---|---|---|---|");
    let bodies = [
        (Body::Ellipsoid, Some(Vector3::new(2.0, 2.0, 1.0))),
        (Body::Ellipsoid, Some(Vector3::new(5.0, 4.0, 2.0))),
        (Body::Ellipsoid, Some(Vector3::new(10.0, 1.0, 1.0))),
        (Body::Bean, None),
        (Body::Chickpea, None),
        (Body::Maize, None),
    ];
    for (body, axes) in bodies {
        for (points, noise) in [(1538, 0.0), (1538, 0.005), (6146, 0.0), (6146, 0.005)] {
            println!("{}", row(body, axes, points, noise)?);
        }
    }
    Ok(())
}

/// How far a figure is off, in its standard errors.
#[derive(Default)]
struct Figure(Vec<f64>);

impl Figure {
    fn add(&mut self, told: f64, exact: f64, error: Option<f64>) {
        self.0
            .extend(error.map(|error| (told - exact).abs() / error));
    }

    /// The share within two of them, and the largest.
    fn told(&self) -> String {
        let within = self.0.iter().filter(|z| **z <= 2.0).count();
        let most = self.0.iter().copied().fold(0.0, f64::max);
        format!("{within} of {} ({most:.1})", self.0.len())
    }
}

fn row(
    body: Body,
    axes: Option<Vector3<f64>>,
    points: usize,
    noise: f64,
) -> Result<String, Box<dyn Error>> {
    let truth = axes.map_or_else(|| Ok(body.surface()), |axes| body.with_axes(axes))?;
    let truth = Radial(truth.as_ref());
    let mut mean_radius = 0.0;
    let mut fitted = |seed: u64| -> Result<Grain, Box<dyn Error>> {
        let options = SynthOptions::clean(body)
            .with_axes(axes)
            .with_points(points)
            .with_noise(noise)
            .with_seed(seed);
        let synthetic = synthesize(&options)?;
        mean_radius = synthetic.truth.mean_radius;
        Ok(fit(&Scan::from_points(synthetic.points), &FitOptions::default())?.grain_with_errors())
    };
    let grains = [fitted(1)?, fitted(2)?];
    let exact = ContactBody::new(&truth);
    let bodies = grains.each_ref().map(|grain| ContactBody::new(grain));
    let [mut depth, mut volume, mut curvature, mut force] = [0; 4].map(|_| Figure::default());
    let mut told = 0;
    let axes_of_turns = Sampling::Random.directions(POSES, 1)?;
    for (at, n) in Sampling::Random.directions(POSES, 2)?.iter().enumerate() {
        let axis = Unit::new_normalize(axes_of_turns[at]);
        let turn = UnitQuaternion::from_axis_angle(&axis, TAU * (at as f64 + 0.5) / POSES as f64);
        let [least, most] = DEPTHS;
        let share = least + (most - least) * at as f64 / POSES as f64;
        let Some((pose, known)) = placed(&exact, n, turn, share * mean_radius, &truth) else {
            continue;
        };
        let found = contact_regions(&bodies[0], &bodies[1], &pose)?.regions;
        let Some(region) = found.first() else {
            continue;
        };
        depth.add(region.depth, known.depth, region.depth_error());
        volume.add(region.volume, known.volume, region.volume_standard_error());
        if let (Some(own), Some(exact), Some(errors)) =
            (&region.curvatures, &known.curvatures, &region.errors)
        {
            for side in 0..2 {
                for i in 0..2 {
                    let error = Some(errors[side].curvature);
                    curvature.add(own[side].principal[i], exact[side].principal[i], error);
                }
            }
        }
        if let (Some(own), Some(exact)) = (pressed(region), pressed(&known)) {
            told += 1;
            force.add(own.0, exact.0, own.1);
        }
    }
    let name = axes.map_or(body.to_string(), |a| {
        format!("{body} {}:{}:{}", a.x, a.y, a.z)
    });
    Ok(format!(
        "| {name} | {points} | {} % | {told} of {POSES} | {} | {} | {} | {} |",
        100.0 * noise,
        depth.told(),
        volume.told(),
        curvature.told(),
        force.told(),
    ))
}

/// The pose along a direction in which two bodies overlap by a depth, at one place, and the region there.
fn placed(
    body: &ContactBody<'_>,
    n: &Vector3<f64>,
    turn: UnitQuaternion<f64>,
    depth: f64,
    surface: &dyn Surface,
) -> Option<(Isometry3<f64>, ContactRegion)> {
    let reach = reach(surface);
    let (mut near, mut far) = (0.2 * reach, 2.0 * reach);
    let at = |away: f64| {
        let pose = Isometry3::from_parts(Translation3::from(n * away), turn);
        let found = contact_regions(body, body, &pose);
        let deepest = found.map_or(f64::INFINITY, |found| {
            found
                .regions
                .iter()
                .map(|region| region.depth)
                .fold(0.0, f64::max)
        });
        (pose, deepest)
    };
    for _ in 0..30 {
        let middle = 0.5 * (near + far);
        match at(middle).1 > depth {
            true => near = middle,
            false => far = middle,
        }
    }
    let pose = at(near).0;
    let mut regions = contact_regions(body, body, &pose).ok()?.regions;
    (regions.len() == 1 && regions[0].curvatures.is_some()).then(|| (pose, regions.remove(0)))
}

/// The force by Hertz but for the modulus, and its standard error, where one is vouched for.
fn pressed(region: &ContactRegion) -> Option<(f64, Option<f64>)> {
    told_depth(region.depth, region.depth_error()).ok()?;
    let known = KnownContact::at(region.curvatures.as_ref()?, region.errors.as_ref()).ok()?;
    let force = known.relative().normal_force_n(1.0, region.depth, 1.0);
    let share = known.force_share(region.depth, region.depth_error());
    Some((force, share.map(|share| share * force)))
}
