//! A search for a model that is better in all figures, from one that nearly is.

use crate::chapter_3::search::{Found, Goal, found};
use crate::chapter_3::study::Study;
use grainform::fit::MirroredFitError;
use grainform::shapes::SamplingDensity;
use nalgebra::Vector3;

/// Size of the first simplex of a refinement of the exponents, and its most steps.
const FIRST_STEP: f64 = 0.5;
const MOST_STEPS: usize = 60;

/// The model that a simplex search (Nelder and Mead 1965) over the exponents of the density finds from a
/// start, for the least of the largest share of the goal; it ends where all figures are better.
pub(crate) fn refine(
    study: &Study,
    samples: [usize; 2],
    start: &Found,
    goal: &Goal,
) -> Result<Found, MirroredFitError> {
    let at = |place: Vector3<f64>| {
        let [sine, radius, slope] = place.into();
        let density = SamplingDensity {
            sine,
            radius,
            slope,
        };
        found(study, samples, density)
    };
    let place = |found: &Found| {
        let density = &found.density;
        Vector3::new(density.sine, density.radius, density.slope)
    };
    let worst = |found: &Found| goal.worst(&found.figures);
    let mut simplex = vec![*start];
    for axis in 0..3 {
        simplex.push(at(place(start) + Vector3::ith(axis, FIRST_STEP))?);
    }
    for _ in 0..MOST_STEPS {
        simplex.sort_by(|a, b| worst(a).total_cmp(&worst(b)));
        if worst(&simplex[0]) < 1.0 {
            break;
        }
        let middle = simplex[..3].iter().map(place).sum::<Vector3<f64>>() / 3.0;
        let away = middle - place(&simplex[3]);
        let mut next = at(middle + away)?;
        if worst(&next) < worst(&simplex[0]) {
            let farther = at(middle + away * 2.0)?;
            if worst(&farther) < worst(&next) {
                next = farther;
            }
        } else if worst(&next) >= worst(&simplex[2]) {
            let inwards = match worst(&next) < worst(&simplex[3]) {
                true => 0.5,
                false => -0.5,
            };
            next = at(middle + away * inwards)?;
        }
        if worst(&next) < worst(&simplex[3]) {
            simplex[3] = next;
            continue;
        }
        for i in 1..4 {
            simplex[i] = at((place(&simplex[0]) + place(&simplex[i])) / 2.0)?;
        }
    }
    Ok(simplex[0])
}
