//! How a bed carries: contacts, their forces, and how grains lie.

use super::link::Link;
use super::settle::Bed;
use crate::spread::{principal, quantile};
use nalgebra::Matrix3;
use serde::Serialize;
use std::collections::BTreeSet;

/// Shares of the contacts whose forces are told.
const QUANTILES: [f64; 5] = [0.05, 0.25, 0.5, 0.75, 0.95];

/// Contacts between grains, and how grains lie.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[non_exhaustive]
pub struct Fabric {
    /// Contacts with other grains per grain.
    pub contacts: f64,
    /// Grains that a grain touches.
    pub neighbours: f64,
    /// Grains that touch no other and no wall.
    pub loose: usize,
    /// The largest overlap, as a share of the mean radius of the grains.
    pub largest_overlap: f64,
    /// The normal forces between grains; `None` if none touch.
    pub forces: Option<Forces>,
    /// How the long axes lie; `None` if there are none.
    pub order: Option<Order>,
}

/// Normal forces of contacts between grains.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[non_exhaustive]
pub struct Forces {
    /// Their mean, in newtons.
    pub mean: f64,
    /// 5, 25, 50, 75 and 95 % quantiles, as shares of the mean.
    pub quantiles: [f64; 5],
    /// The largest, as a share of the mean.
    pub largest: f64,
}

/// The order of long axes u, those of the least moment of inertia: of the mean of (3 u uᵀ - 1)/2.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[non_exhaustive]
pub struct Order {
    /// Grains that have a long axis.
    pub grains: usize,
    /// Its components, row by row.
    pub tensor: [[f64; 3]; 3],
    /// Eigenvalues, the largest first: 1, -1/2, -1/2 if all lie alike, zero if in all directions.
    pub eigenvalues: [f64; 3],
    /// The component along the vertical: -1/2 if all lie flat.
    pub vertical: f64,
}

/// Where two grains touch.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct GrainContact {
    /// Which grains, the one of the smaller number first.
    pub grains: [u32; 2],
    /// How far they overlap, in metres.
    pub overlap: f64,
    /// The normal force, in newtons.
    pub force: f64,
}

/// How a bed carries.
pub fn fabric(bed: &Bed) -> Fabric {
    let contacts = bed.state.encounters.iter().flat_map(|encounter| {
        let touches = encounter.other.map(|other| {
            let grains = [encounter.first, other];
            let [one, other] = grains.map(|grain| {
                let body = &bed.bodies()[grain as usize];
                bed.kinds()[body.kind].radius
            });
            let touches = Link::told(&encounter.links, one * other / (one + other));
            touches.into_iter().map(move |touch| GrainContact {
                grains,
                overlap: touch.overlap,
                force: -touch.force.dot(&touch.normal),
            })
        });
        touches.into_iter().flatten()
    });
    Fabric::of(bed, &contacts.collect::<Vec<_>>())
}

impl Fabric {
    /// How a bed carries whose grains touch so.
    pub fn of(bed: &Bed, contacts: &[GrainContact]) -> Self {
        let grains = bed.bodies().len();
        let pairs: BTreeSet<[u32; 2]> = contacts.iter().map(|contact| contact.grains).collect();
        let mut is_loose = vec![true; grains];
        for grain in pairs.iter().flatten() {
            is_loose[*grain as usize] = false;
        }
        let mut largest = contacts
            .iter()
            .map(|contact| contact.overlap)
            .fold(0.0, f64::max);
        for (grain, overlap) in on_walls(bed) {
            is_loose[grain] = false;
            largest = overlap.max(largest);
        }
        let radii = bed
            .bodies()
            .iter()
            .map(|body| bed.kinds()[body.kind].radius);
        let mut forces: Vec<f64> = contacts.iter().map(|contact| contact.force).collect();
        forces.sort_by(f64::total_cmp);
        Self {
            contacts: 2.0 * forces.len() as f64 / grains as f64,
            neighbours: 2.0 * pairs.len() as f64 / grains as f64,
            loose: is_loose.iter().filter(|loose| **loose).count(),
            largest_overlap: largest * grains as f64 / radii.sum::<f64>(),
            forces: Forces::of(&forces),
            order: order(bed),
        }
    }
}

/// The grains that touch walls, each with the overlap there.
fn on_walls(bed: &Bed) -> impl Iterator<Item = (usize, f64)> {
    let bodies = bed.bodies().iter().enumerate();
    bodies.flat_map(|(number, body)| {
        let kind = &bed.kinds()[body.kind];
        let near = bed.walls.iter();
        let near = near.filter(move |wall| wall.is_near(&body.position, kind.reach));
        near.flat_map(move |wall| {
            let parts = kind.placed(body.position, body.axes()).zip(&kind.parts);
            parts.flat_map(move |(frame, part)| {
                let touch = move |place| wall.touch(place, &part.part.shape, &frame);
                (0..wall.places()).filter_map(touch)
            })
        })
        .map(move |touch| (number, touch.overlap))
    })
}

impl Forces {
    /// Those of forces in order.
    fn of(forces: &[f64]) -> Option<Self> {
        let last = *forces.last()?;
        let mean = forces.iter().sum::<f64>() / forces.len() as f64;
        (mean > 0.0).then(|| Self {
            mean,
            quantiles: QUANTILES.map(|share| quantile(forces, share) / mean),
            largest: last / mean,
        })
    }
}

fn order(bed: &Bed) -> Option<Order> {
    let long = bed.bodies().iter();
    let long = long.filter(|body| bed.kinds()[body.kind].has_long_axis());
    let axes: Vec<_> = long
        .map(|body| body.axes().column(0).into_owned())
        .collect();
    if axes.is_empty() {
        return None;
    }
    let sum: Matrix3<f64> = axes.iter().map(|u| u * u.transpose()).sum();
    let tensor = sum * (1.5 / axes.len() as f64) - Matrix3::identity() * 0.5;
    let (ascending, _) = principal(&tensor)?;
    Some(Order {
        grains: axes.len(),
        tensor: [0, 1, 2].map(|i| [0, 1, 2].map(|j| tensor[(i, j)])),
        eigenvalues: [2, 1, 0].map(|i| ascending[i]),
        vertical: tensor[(2, 2)],
    })
}
