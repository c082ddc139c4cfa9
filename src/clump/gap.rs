//! How far a clump is from the surface that it stands for.

use crate::measure::{Ball, EvenPlace};
use rayon::prelude::*;

/// The distance from a place of the grain's surface along its normal to that of the clump, positive where the clump
/// stands out. Where the normal meets no sphere on its way in, the nearest distance.
pub(super) fn gap(at: &EvenPlace, spheres: &[Ball]) -> f64 {
    let spans: Vec<[f64; 2]> = spheres.iter().filter_map(|ball| span(at, ball)).collect();
    let holds = |span: &&[f64; 2], t: f64| span[0] <= t && t < span[1];
    let mut out = 0.0;
    // Through spheres that overlap, from one to the next.
    while let Some(span) = spans.iter().find(|span| holds(span, out)) {
        out = span[1];
    }
    if out > 0.0 {
        return out;
    }
    let entries = spans.iter().map(|span| span[1]).filter(|t| *t <= 0.0);
    let entry = entries.fold(f64::NEG_INFINITY, f64::max);
    match entry.is_finite() {
        true => entry,
        false => -spheres
            .iter()
            .map(|ball| (at.place - ball.centre.coords).norm() - ball.radius)
            .fold(f64::INFINITY, f64::min),
    }
}

/// Where the normal enters and leaves a ball.
fn span(at: &EvenPlace, ball: &Ball) -> Option<[f64; 2]> {
    let from = at.place - ball.centre.coords;
    let along = from.dot(&at.outward);
    let square = along * along - from.norm_squared() + ball.radius * ball.radius;
    let half = (square > 0.0).then(|| square.sqrt())?;
    Some([-along - half, -along + half])
}

/// Root mean square of the [`gap`]s.
pub(super) fn root_mean_square(places: &[EvenPlace], spheres: &[Ball]) -> f64 {
    let gaps: Vec<f64> = places.par_iter().map(|at| gap(at, spheres)).collect();
    let squares: f64 = gaps.iter().map(|gap| gap * gap).sum();
    (squares / places.len() as f64).sqrt()
}
