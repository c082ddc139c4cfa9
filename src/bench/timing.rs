//! The processor's time.

use crate::model::{Grain, Surface};
use crate::shapes::{Sampling, SynthError};
use cpu_time::ProcessTime;
use nalgebra::Vector3;
use std::hint::black_box;

/// Runs of a piece of work, unless it is short: then up to so many within so many seconds. Once is enough of what takes
/// longer than most.
const RUNS: [usize; 2] = [3, 7];
const SHORT: f64 = 0.1;
const LONG: f64 = 1.0;

/// Directions that are asked for one by one.
const ONE_BY_ONE: usize = 1000;

/// Directions that are asked for at once.
const AT_ONCE: usize = 1 << 17;

/// What a piece of work gives, and the least and the most seconds of a few runs.
pub(super) fn timed<T>(work: impl Fn() -> T) -> (T, [f64; 2]) {
    let (mut least, mut most, mut all) = (f64::INFINITY, 0.0_f64, 0.0);
    let mut run = || {
        let started = ProcessTime::now();
        let result = work();
        let seconds = started.elapsed().as_secs_f64();
        (least, most, all) = (least.min(seconds), most.max(seconds), all + seconds);
        (result, all)
    };
    let (mut result, mut all) = run();
    for done in 1..RUNS[1] {
        if all > LONG || (done >= RUNS[0] && all > SHORT) {
            break;
        }
        (result, all) = run();
    }
    (result, [least, most])
}

/// Directions in which surfaces are evaluated: the same for all.
#[derive(Debug, Clone)]
pub(super) struct Directions {
    one_by_one: Vec<Vector3<f64>>,
    at_once: Vec<Vector3<f64>>,
}

impl Directions {
    pub(super) fn random() -> Result<Self, SynthError> {
        Ok(Self {
            one_by_one: Sampling::Random.directions(ONE_BY_ONE, 0)?,
            at_once: Sampling::Random.directions(AT_ONCE, 0)?,
        })
    }

    /// Nanoseconds of one evaluation, each in another direction.
    pub(super) fn nanoseconds(&self, grain: &Grain) -> f64 {
        let (_, [least, _]) = timed(|| {
            for n in &self.one_by_one {
                black_box(grain.place(n));
            }
        });
        1e9 * least / ONE_BY_ONE as f64
    }

    /// Nanoseconds of one of many evaluations that are asked for at once.
    pub(super) fn nanoseconds_bulk(&self, grain: &Grain) -> f64 {
        let (_, [least, _]) = timed(|| grain.places(&self.at_once));
        1e9 * least / AT_ONCE as f64
    }
}
