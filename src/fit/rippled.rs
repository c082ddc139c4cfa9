//! Keeps the estimate of a mesh from rippling between the corners of its faces.
//!
//! Where few large faces lie among small ones, what the small ones ask for, as beside a crease, are degrees that nothing holds over the
//! large ones. Over holes that were closed with faces three times as large as the others the surface was so rippled that the whole area
//! was .5 to 2 % too large, 7 to 30 standard errors. A smooth surface lies no farther off the middle of a face than the normals at its
//! corners tell. Where an estimate does, the middles are points too.

use super::context::{Cancelled, Context};
use super::estimate::{Estimate, estimate};
use super::prepare::{Middle, PreparedScan, Samples};
use nalgebra::{Point3, Vector3};
use std::f64::consts::PI;

/// A surface that is so many times as far off the middle of a face as a smooth one would be, ...
const TIMES: f64 = 4.0;

/// ... and more by this share of the mean radius and so many times the noise, ripples. On meshes of smooth bodies the first is 1.05 and
/// hardly more; what no radius follows is noise of the estimate, and no middles mend it.
const AND_MORE: f64 = 3e-4;
const NOISES: f64 = 3.0;

/// Ripples over faces that have no more of the area than this do not matter, or are the detail of a textured scan.
const LEAST_SHARE: f64 = 0.01;

/// How often the estimate is made again.
const ROUNDS: usize = 2;

/// The estimate of a prepared scan, and the samples that it is made from.
pub(super) fn without_ripples(
    prepared: &PreparedScan<'_>,
    context: &Context<'_>,
) -> Result<(Samples, Estimate), Cancelled> {
    let made_from = |samples: &Samples| {
        estimate(
            samples.rows(),
            prepared.semi_axes,
            prepared.origin(),
            context,
        )
    };
    let mut samples = prepared.sorted_samples();
    let mut found = made_from(&samples)?;
    let mut points = Vec::new();
    for _ in 0..ROUNDS {
        let rippled = rippled(prepared, &found);
        if rippled.is_empty() {
            break;
        }
        points.extend(rippled);
        samples = prepared.samples_and(&points);
        found = made_from(&samples)?;
    }
    Ok((samples, found))
}

/// The middles of faces over which an estimate ripples.
fn rippled(prepared: &PreparedScan<'_>, estimate: &Estimate) -> Vec<Point3<f64>> {
    if prepared.middles.is_empty() {
        return Vec::new();
    }
    let half_wave = PI / estimate.degree as f64;
    let is_wide = |middle: &&Middle| middle.width > half_wave;
    let middles: Vec<&Middle> = prepared.middles.iter().filter(is_wide).collect();
    let local = middles
        .iter()
        .map(|middle| prepared.frame().to_local(&middle.place));
    let local: Vec<Vector3<f64>> = local.collect();
    let beyond = estimate.beyond(&local);
    let least = AND_MORE * prepared.mean_radius + NOISES * estimate.noise();
    let is_rippled = |((middle, place), beyond): &((&Middle, Vector3<f64>), f64)| {
        let off = beyond * place.normalize().dot(&middle.normal);
        off.abs() > TIMES * middle.bulge + least
    };
    let all = middles.into_iter().zip(local).zip(beyond);
    let rippled: Vec<&Middle> = all
        .filter(is_rippled)
        .map(|((middle, _), _)| middle)
        .collect();
    match rippled.iter().map(|middle| middle.share).sum::<f64>() > LEAST_SHARE {
        true => rippled.iter().map(|middle| middle.place).collect(),
        false => Vec::new(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fit::prepare::Origin;
    use crate::mesh::Mesh;
    use crate::scan::Scan;
    use crate::sphere::Symmetry;
    use std::f64::consts::TAU;

    /// Triangles between two rings of vertices, which are numbered from `below` and `above` on.
    fn row([below, lower]: [u32; 2], [above, upper]: [u32; 2]) -> Vec<[u32; 3]> {
        let (mut i, mut j, mut row) = (0, 0, Vec::new());
        while i < lower || j < upper {
            let is_lower_next = j == upper || i < lower && (i + 1) * upper <= (j + 1) * lower;
            let (a, b) = (below + i % lower, above + j % upper);
            match is_lower_next {
                true => {
                    i += 1;
                    row.push([a, below + i % lower, b]);
                }
                false => {
                    j += 1;
                    row.push([a, above + j % upper, b]);
                }
            }
        }
        row
    }

    /// An ellipsoid of fine faces, with a level hole of 30 degrees that is closed with large ones.
    fn with_closed_hole() -> Mesh {
        let hole = 30_f64.to_radians();
        let fine = (0..76).map(|ring| {
            let angle = PI - (PI - hole) * (f64::from(ring) + 0.5) / 75.5;
            let around = (130.0 * angle.sin()).max(6.0) as u32;
            (around, angle.sin(), angle.cos())
        });
        let large = [16, 10, 5].into_iter().enumerate();
        let large = large.map(|(ring, around)| {
            let out = hole.sin() * (0.8 - 0.27 * ring as f64);
            (around, out, hole.cos() + 0.01 * ring as f64)
        });
        let mut mesh = Mesh::default();
        let mut last: Option<[u32; 2]> = None;
        for (around, out, up) in fine.chain(large) {
            let ring = [mesh.vertices.len() as u32, around];
            mesh.vertices.extend((0..around).map(|at| {
                let (v, u) = (TAU * f64::from(at) / f64::from(around)).sin_cos();
                Point3::new(2.0 * out * u, 1.5 * out * v, 1.2 * up)
            }));
            match last {
                Some(last) => mesh.triangles.extend(row(last, ring)),
                None => (2..around).for_each(|at| mesh.triangles.push([0, at, at - 1])),
            }
            last = Some(ring);
        }
        let [first, around] = last.unwrap();
        let end = (2..around).map(|at| [first, first + at - 1, first + at]);
        mesh.triangles.extend(end);
        mesh
    }

    #[test]
    fn the_estimate_does_not_ripple_over_a_hole_that_was_closed_with_large_faces() {
        let scan = Scan::from_mesh(with_closed_hole()).unwrap();
        let prepared = PreparedScan::new(&scan, Symmetry::NONE).unwrap();
        let context = Context::default();
        let samples = prepared.sorted_samples();
        let alone = estimate(samples.rows(), prepared.semi_axes, Origin::Faces, &context).unwrap();
        let (with_middles, found) = without_ripples(&prepared, &context).unwrap();
        assert!(rippled(&prepared, &alone).len() > 10);
        assert!(rippled(&prepared, &found).is_empty());
        assert!(with_middles.rows().len() > samples.rows().len() + 10);
    }
}
