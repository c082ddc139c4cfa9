//! The field across the crust.

use super::voxels::{State, Voxels};

/// Squared distance at the points themselves, in spacings, which keeps the field from jumping there.
const AT_POINTS: f64 = 0.15 * 0.15;

/// Sweeps over the crust, which is some four voxels thick, and how far beyond balance each goes.
const SWEEPS: usize = 60;
const BEYOND: f64 = 1.5;

/// The harmonic field that is -1 outside and 1 inside: every voxel of the crust balances its neighbours. It is led by
/// the squared distance from the points, and so falls off near these.
pub(super) fn harmonic(voxels: &Voxels, spacing: f64) -> Vec<f64> {
    let mut field: Vec<f64> = voxels
        .states
        .iter()
        .map(|state| match state {
            State::Outside => -1.0,
            State::Crust => 0.0,
            State::Inside => 1.0,
        })
        .collect();
    let steps = voxels.steps();
    let conductance = |at: usize| {
        let distance = voxels.distances[at] / spacing;
        distance * distance + AT_POINTS
    };
    // The crust stays away from the rim of the box, so that every voxel has all its neighbours.
    let is_crust = |at: &usize| voxels.states[*at] == State::Crust;
    let crust: Vec<usize> = (0..field.len()).filter(is_crust).collect();
    let led: Vec<[(usize, f64); 6]> = crust
        .iter()
        .map(|&at| {
            let own = conductance(at);
            let [x, y, z] = steps;
            [at - x, at + x, at - y, at + y, at - z, at + z].map(|other| {
                let its = conductance(other);
                (other, 2.0 * own * its / (own + its))
            })
        })
        .collect();
    for _ in 0..SWEEPS {
        for (&at, led) in crust.iter().zip(&led) {
            let sum: f64 = led.iter().map(|(_, share)| share).sum();
            let flow: f64 = led.iter().map(|(other, share)| share * field[*other]).sum();
            field[at] += BEYOND * (flow / sum - field[at]);
        }
    }
    field
}
