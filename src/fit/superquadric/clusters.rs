//! Where the parts of a union begin: clusters of points inside of the body (k-means), an ellipsoid for each.

use super::bodies::Body;
use super::cloud::{Cloud, principal_axes};
use nalgebra::Vector3;

/// Shells of points inside, of equal volume.
const SHELLS: usize = 4;

/// Rounds of k-means.
const ROUNDS: usize = 30;

/// Semi-axes over standard deviations of a filled ellipsoid, and a tenth more: parts overlap.
const PER_DEVIATION: f64 = 1.1 * 2.236_067_977_499_79;

/// Where the first cluster begins: outermost towards a face or a corner of a box along the axes of the cloud, whose
/// edges are as its standard deviations.
#[rustfmt::skip]
pub(super) const SEEDINGS: [[f64; 3]; 14] = [
    [1.0, 0.0, 0.0], [-1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, -1.0, 0.0], [0.0, 0.0, 1.0], [0.0, 0.0, -1.0],
    [1.0, 1.0, 1.0], [-1.0, 1.0, 1.0], [1.0, -1.0, 1.0], [-1.0, -1.0, 1.0],
    [1.0, 1.0, -1.0], [-1.0, 1.0, -1.0], [1.0, -1.0, -1.0], [-1.0, -1.0, -1.0],
];

/// Ellipsoids for so many clusters, of which the first begins where a seeding has it; `None` where a cluster is flat.
pub(super) fn ellipsoids(
    cloud: &Cloud,
    points: &[Vector3<f64>],
    parts: usize,
    seeding: [f64; 3],
) -> Option<Vec<Body>> {
    let shell = |i: usize| ((i as f64 + 0.5) / SHELLS as f64).cbrt();
    let inside: Vec<Vector3<f64>> = (0..SHELLS)
        .flat_map(|i| points.iter().map(move |point| point * shell(i)))
        .collect();
    let mut centres = seeds(cloud, &inside, parts, seeding);
    let nearest = |centres: &[Vector3<f64>], point: &Vector3<f64>| {
        let distance = |i: &usize| (centres[*i] - point).norm_squared();
        let order = |i: &usize, j: &usize| distance(i).total_cmp(&distance(j));
        (0..parts).min_by(order).unwrap_or(0)
    };
    for _ in 0..ROUNDS {
        let mut sums = vec![(Vector3::zeros(), 0.0); parts];
        for point in &inside {
            let (sum, count) = &mut sums[nearest(&centres, point)];
            *sum += point;
            *count += 1.0;
        }
        centres = sums.iter().map(|(sum, count)| sum / *count).collect();
    }
    let mut clusters = vec![Vec::new(); parts];
    for point in &inside {
        clusters[nearest(&centres, point)].push(*point);
    }
    let ellipsoid = |(cluster, centre): (&Vec<Vector3<f64>>, &Vector3<f64>)| {
        let (axes, deviations) = principal_axes(cluster)?;
        Some(Body::start(*centre, axes, deviations * PER_DEVIATION))
    };
    clusters.iter().zip(&centres).map(ellipsoid).collect()
}

/// Points that are far from each other, the first outermost towards where the seeding has it.
fn seeds(
    cloud: &Cloud,
    inside: &[Vector3<f64>],
    parts: usize,
    seeding: [f64; 3],
) -> Vec<Vector3<f64>> {
    let towards = cloud.axes * Vector3::from(seeding).component_div(&cloud.deviations);
    let outwardness = |point: &Vector3<f64>| point.dot(&towards);
    let farthest = |far: &dyn Fn(&Vector3<f64>) -> f64| {
        let order = |p: &&Vector3<f64>, q: &&Vector3<f64>| far(p).total_cmp(&far(q));
        inside.iter().max_by(order).copied().unwrap_or_default()
    };
    let mut seeds = vec![farthest(&outwardness)];
    while seeds.len() < parts {
        let apart = |point: &Vector3<f64>| {
            let distances = seeds.iter().map(|seed| (seed - point).norm_squared());
            distances.fold(f64::INFINITY, f64::min)
        };
        let next = farthest(&apart);
        seeds.push(next);
    }
    seeds
}
