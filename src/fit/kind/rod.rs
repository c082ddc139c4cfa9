//! A thin rod, where neither a radius nor positions can be fitted: rays graze its sides, so that along them noise is many times as
//! large as across. It is looked at in a space in which it is as wide as long.

use crate::fit::context::Context;
use crate::fit::error::FitError;
use crate::fit::options::FitOptions;
use crate::fit::outcome::Fitted;
use crate::fit::points::scatter::{FAR, scatter};
use crate::fit::prepare::PreparedScan;
use crate::measure::{Deviation, feet};
use crate::model::Surface;
use crate::scan::{Scan, drawn};
use nalgebra::Vector3;

/// Most points whose distances are compared with their scatter.
const MOST_COMPARED: usize = 20_000;

/// The radius of a rod; `None` of scans of all else.
///
/// # Errors
/// [`FitError::Cancelled`].
pub(super) fn rod(
    scan: &Scan,
    options: &FitOptions,
    context: &Context<'_>,
) -> Option<Result<Fitted, FitError>> {
    let rod = PreparedScan::of_rod(scan, options.symmetry).ok()??;
    match rod.fit(options, context) {
        Err(FitError::Cancelled) => Some(Err(FitError::Cancelled)),
        Ok(fitted) if is_followed(&fitted, scan, options) => Some(Ok(fitted)),
        _ => None,
    }
}

/// Whether the points of a rod, but as many of the farthest as were left out, lie no farther from it than they scatter about their
/// neighbours: what has a stalk or a ball at its side is no rod.
fn is_followed(rod: &Fitted, scan: &Scan, options: &FitOptions) -> bool {
    let points = scan.points();
    let some = drawn(points, MOST_COMPARED);
    let feet = feet(&rod.grain, &some).into_iter();
    let mut places: Vec<(f64, Vector3<f64>)> = feet
        .zip(&some)
        .map(|(foot, point)| (foot.distance.abs(), point - rod.grain.frame().centre))
        .collect();
    places.sort_by(|one, other| one.0.total_cmp(&other.0));
    places.truncate(places.len() * rod.points.min(points.len()) / points.len());
    let (distances, places): (Vec<f64>, Vec<Vector3<f64>>) = places.into_iter().unzip();
    let rms = Deviation::of(distances.into_iter().map(|distance| (distance, 1.0))).rms();
    let good = options.tolerance.length(rod.mean_radius);
    scatter(&places).is_some_and(|scatter| rms <= FAR * scatter.max(good))
}
