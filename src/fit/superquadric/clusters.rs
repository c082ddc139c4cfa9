//! Where the parts of a union begin: clusters of points inside of the body (k-means), an ellipsoid for each or, for parts that
//! cross each other near the middle, round the two that lie opposite each other.

use super::bodies::Body;
use super::cloud::{Cloud, principal_axes};
use crate::spread::covariance;
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

/// What a part of a union begins with.
#[derive(Debug, Clone, Copy)]
pub(super) enum Begin {
    /// One cluster.
    Beside,
    /// Two that lie opposite each other.
    Across,
}

/// Ellipsoids for so many parts, of clusters of which the first begins where a seeding has it; `None` where one is flat.
pub(super) fn ellipsoids(
    cloud: &Cloud,
    points: &[Vector3<f64>],
    parts: usize,
    begin: Begin,
    seeding: [f64; 3],
) -> Option<Vec<Body>> {
    let clusters = match begin {
        Begin::Beside => clusters(cloud, points, parts, seeding),
        Begin::Across => opposite(&clusters(cloud, points, 2 * parts, seeding)),
    };
    let ellipsoid = |cluster: &Vec<Vector3<f64>>| {
        let (axes, deviations) = principal_axes(cluster)?;
        let (centre, _) = covariance(cluster.iter().copied());
        Some(Body::start(centre, axes, deviations * PER_DEVIATION))
    };
    clusters.iter().map(ellipsoid).collect()
}

/// Clusters in pairs, those first that lie most nearly opposite each other as seen from the middle of the cloud.
fn opposite(clusters: &[Vec<Vector3<f64>>]) -> Vec<Vec<Vector3<f64>>> {
    let towards: Vec<Vector3<f64>> = clusters
        .iter()
        .map(|cluster| cluster.iter().sum::<Vector3<f64>>().normalize())
        .collect();
    let pairs = (0..clusters.len()).flat_map(|j| (0..j).map(move |i| [i, j]));
    let mut pairs: Vec<[usize; 2]> = pairs.collect();
    pairs.sort_by(|p, q| {
        let [p, q] = [p, q].map(|[i, j]| towards[*i].dot(&towards[*j]));
        p.total_cmp(&q)
    });
    let mut is_taken = vec![false; clusters.len()];
    pairs.retain(|pair| {
        let is_free = pair.iter().all(|&i| !is_taken[i]);
        pair.iter().for_each(|&i| is_taken[i] |= is_free);
        is_free
    });
    let joined = |[i, j]: [usize; 2]| [clusters[i].as_slice(), &clusters[j]].concat();
    pairs.into_iter().map(joined).collect()
}

/// So many clusters of points inside of the body.
fn clusters(
    cloud: &Cloud,
    points: &[Vector3<f64>],
    count: usize,
    seeding: [f64; 3],
) -> Vec<Vec<Vector3<f64>>> {
    let shell = |i: usize| ((i as f64 + 0.5) / SHELLS as f64).cbrt();
    let inside: Vec<Vector3<f64>> = (0..SHELLS)
        .flat_map(|i| points.iter().map(move |point| point * shell(i)))
        .collect();
    let mut centres = seeds(cloud, &inside, count, seeding);
    let nearest = |centres: &[Vector3<f64>], point: &Vector3<f64>| {
        let distance = |i: &usize| (centres[*i] - point).norm_squared();
        let order = |i: &usize, j: &usize| distance(i).total_cmp(&distance(j));
        (0..count).min_by(order).unwrap_or(0)
    };
    for _ in 0..ROUNDS {
        let mut sums = vec![(Vector3::zeros(), 0.0); count];
        for point in &inside {
            let (sum, count) = &mut sums[nearest(&centres, point)];
            *sum += point;
            *count += 1.0;
        }
        centres = sums.iter().map(|(sum, count)| sum / *count).collect();
    }
    let mut clusters = vec![Vec::new(); count];
    for point in &inside {
        clusters[nearest(&centres, point)].push(*point);
    }
    clusters
}

/// Points that are far from each other, the first outermost towards where the seeding has it.
fn seeds(
    cloud: &Cloud,
    inside: &[Vector3<f64>],
    count: usize,
    seeding: [f64; 3],
) -> Vec<Vector3<f64>> {
    let towards = cloud.axes * Vector3::from(seeding).component_div(&cloud.deviations);
    let outwardness = |point: &Vector3<f64>| point.dot(&towards);
    let farthest = |far: &dyn Fn(&Vector3<f64>) -> f64| {
        let order = |p: &&Vector3<f64>, q: &&Vector3<f64>| far(p).total_cmp(&far(q));
        inside.iter().max_by(order).copied().unwrap_or_default()
    };
    let mut seeds = vec![farthest(&outwardness)];
    while seeds.len() < count {
        let apart = |point: &Vector3<f64>| {
            let distances = seeds.iter().map(|seed| (seed - point).norm_squared());
            distances.fold(f64::INFINITY, f64::min)
        };
        let next = farthest(&apart);
        seeds.push(next);
    }
    seeds
}
