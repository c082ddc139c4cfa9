//! Bodies that no centre sees whole.

use crate::tally::Figures;
use crate::truth::figures;
use grainform::scan::Scan;
use grainform::shapes::{Curled, CurledOptions, synthesize_curled};
use nalgebra::Vector3;
use std::error::Error;

/// Points, noise as a share of the radius of the ball of equal volume, and scans; no number of points is that of the
/// mesh.
pub(crate) const CURLED: [(Option<usize>, f64, u64); 6] = [
    (None, 0.0, 1),
    (None, 0.005, 10),
    (Some(6146), 0.0, 10),
    (Some(6146), 0.005, 20),
    (Some(6146), 0.02, 20),
    (Some(1538), 0.005, 20),
];

/// Clean points that tell the sizes of a body.
const MANY_POINTS: usize = 300_000;

/// The figures of a body; its sizes are those of a dense clean cloud.
pub(crate) fn truth(body: Curled) -> Result<Figures, Box<dyn Error>> {
    let dense = CurledOptions::clean(body).with_points(MANY_POINTS);
    let dense = synthesize_curled(&dense)?;
    let solid = dense.truth.properties;
    let axes = solid.principal().ok_or("a finite inertia")?.axes;
    let lengths = Vector3::from_fn(|axis, _| {
        let towards = axes.column(axis);
        let heights = dense.mesh.vertices.iter().map(|v| v.coords.dot(&towards));
        let (low, high) = heights.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), h| {
            (low.min(h), high.max(h))
        });
        high - low
    });
    figures(&solid, &lengths)
}

/// A scan of a body.
pub(crate) fn scan(
    body: Curled,
    points: Option<usize>,
    noise: f64,
    seed: u64,
) -> Result<Scan, Box<dyn Error>> {
    let options = CurledOptions::clean(body).with_noise(noise).with_seed(seed);
    let mesh = synthesize_curled(&options.with_points(points))?.mesh;
    Ok(match points {
        None => Scan::from_mesh(mesh)?,
        Some(_) => Scan::from_points(mesh.vertices),
    })
}
