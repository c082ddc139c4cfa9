//! Pairs of fitted grains beside pairs of the bodies that they were fitted to, placed alike.

use grainform::contact::{
    ContactBody, ContactRegion, KnownContact, VolumeLaw, contact_regions, reach, told_depth,
};
use grainform::model::{Grain, Surface};
use grainform::shapes::Sampling;
use nalgebra::{Isometry3, Translation3, Unit, UnitQuaternion, Vector3};
use std::error::Error;
use std::f64::consts::TAU;

/// How deep the bodies lie in each other, as a share of the mean radius.
const DEPTHS: [f64; 2] = [0.005, 0.03];

/// A body, and two fits of it.
pub(crate) struct Fits<'a> {
    pub(crate) truth: &'a dyn Surface,
    pub(crate) mean_radius: f64,
    pub(crate) grains: [Grain; 2],
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

/// What was found of some pairs.
#[derive(Default)]
pub(crate) struct Found {
    placed: usize,
    pressed: usize,
    depth: Figure,
    volume: Figure,
    curvature: Figure,
    force: Figure,
    force_of_volume: Figure,
}

impl Found {
    /// Adds so many poses of a pair.
    pub(crate) fn add(&mut self, fits: &Fits<'_>, poses: usize) -> Result<(), Box<dyn Error>> {
        let exact = ContactBody::new(fits.truth);
        let bodies = fits.grains.each_ref().map(|grain| ContactBody::new(grain));
        let axes = Sampling::Random.directions(poses, 1)?;
        for (at, n) in Sampling::Random.directions(poses, 2)?.iter().enumerate() {
            let axis = Unit::new_normalize(axes[at]);
            let turn =
                UnitQuaternion::from_axis_angle(&axis, TAU * (at as f64 + 0.5) / poses as f64);
            let [least, most] = DEPTHS;
            let depth = (least + (most - least) * at as f64 / poses as f64) * fits.mean_radius;
            let Some((pose, known)) = placed(&exact, n, turn, depth, reach(fits.truth)) else {
                continue;
            };
            self.placed += 1;
            let found = contact_regions(&bodies[0], &bodies[1], &pose)?.regions;
            if let Some(region) = found.first() {
                self.compare(region, &known);
            }
        }
        Ok(())
    }

    fn compare(&mut self, region: &ContactRegion, known: &ContactRegion) {
        let depth_error = region.depth_error();
        self.depth.add(region.depth, known.depth, depth_error);
        let volume_error = region.volume_standard_error();
        self.volume.add(region.volume, known.volume, volume_error);
        if let (Some(own), Some(exact), Some(errors)) =
            (&region.curvatures, &known.curvatures, &region.errors)
        {
            for side in 0..2 {
                for i in 0..2 {
                    let error = Some(errors[side].curvature);
                    let [own, exact] = [own, exact].map(|pair| pair[side].principal[i]);
                    self.curvature.add(own, exact, error);
                }
            }
        }
        if told_depth(region.depth, depth_error).is_ok() {
            let law = VolumeLaw::new([1.0; 2], 1.0, 1.0);
            let [own, exact] = [region, known].map(|region| law.force_n(region).norm());
            let error = VolumeLaw::force_share(region).map(|share| share * own);
            self.force_of_volume.add(own, exact, error);
        }
        if let (Some(own), Some(exact)) = (pressed(region), pressed(known)) {
            self.pressed += 1;
            self.force.add(own.0, exact.0, own.1);
        }
    }

    /// Columns of the table.
    pub(crate) fn columns(&self) -> String {
        format!(
            "{} of {} | {} | {} | {} | {} | {} |",
            self.pressed,
            self.placed,
            self.depth.told(),
            self.volume.told(),
            self.curvature.told(),
            self.force.told(),
            self.force_of_volume.told(),
        )
    }
}

/// The pose along a direction in which two bodies overlap by a depth, at one place, and the region there.
fn placed(
    body: &ContactBody<'_>,
    n: &Vector3<f64>,
    turn: UnitQuaternion<f64>,
    depth: f64,
    reach: f64,
) -> Option<(Isometry3<f64>, ContactRegion)> {
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
