//! Points that stand apart from their neighbours: outliers of the scan.

use super::islands::Seen;
use crate::fit::points::slope::on_slope;
use crate::mesh::Mesh;
use crate::spread::{lower_quartile, robust_deviation, upper_median};
use nalgebra::{Point3, Vector3};

/// A point is a stray when its radius differs from the median of its neighbours' by more than this
/// fraction, whatever the scatter. Real shape between neighbours of a scan of 1500 points differs by
/// 2 % at the sharpest tip of the test grains. ...
pub(crate) const LEAST_STRAY: f64 = 0.1;

/// ... Neighbours farther apart than this, in radians, may differ by as much more.
const NEAR: f64 = 0.15;

/// ... and by more than this many times the scatter of the cloud (standard deviation estimated by
/// the median, so that the strays themselves do not hide it).
const SCATTERS: f64 = 8.0;

/// ... and by more than this many times the spread of the neighbours' own radii: where the surface
/// runs steeply across the rays, neighbours differ by nature. So do they beside a rim, from which the surface falls off on both
/// sides: there it counts how much it goes on falling beyond three neighbours of four.
const SPREADS: f64 = 3.0;

/// Nor is one of few that stand apart a stray if it lies as near the plane through its neighbours: where a cloud is denser on one
/// side than on the other, most of them are on one side of it. More of them than this share may be of another surface, as of a
/// table, which is a plane of its own.
const FEW: f64 = 0.01;

/// Points of a rim that stand out one beside the other, at least.
const ROW: usize = 6;

/// How the radii of neighbours differ.
pub(crate) struct Strays {
    /// Indices of the strays, in order.
    pub(crate) indices: Vec<u32>,
    /// Standard deviation of a radius against the median of its neighbours, relative to the latter.
    pub(crate) scatter: f64,
}

/// A vertex against its neighbours, relative to their median radius.
struct Comparison {
    deviation: f64,
    spread: f64,
    /// How far they are, at least 1, in units of [`NEAR`].
    distance: f64,
}

/// Compares every vertex's distance from `centre` with those of the vertices it shares a triangle
/// with.
pub(crate) fn find_strays(mesh: &Mesh, centre: &Point3<f64>) -> Strays {
    let rays: Vec<Vector3<f64>> = mesh.vertices.iter().map(|p| p - centre).collect();
    let radii: Vec<f64> = rays.iter().map(Vector3::norm).collect();
    let mut neighbours = vec![Vec::new(); radii.len()];
    for &[a, b, c] in &mesh.triangles {
        for (from, to) in [(a, b), (b, c), (c, a)] {
            neighbours[from as usize].push(to as usize);
        }
    }
    let comparisons: Vec<Comparison> = neighbours
        .iter()
        .enumerate()
        .map(|(own, around)| {
            let mut others: Vec<f64> = around.iter().map(|&i| radii[i]).collect();
            let mut angles: Vec<f64> = around.iter().map(|&i| rays[own].angle(&rays[i])).collect();
            Comparison {
                distance: (upper_median(&mut angles).unwrap_or(0.0) / NEAR).max(1.0),
                ..compare(&mut others, radii[own])
            }
        })
        .collect();
    let scatter = robust_deviation(comparisons.iter().map(|c| c.deviation));
    let limit = |c: &Comparison| {
        let least = LEAST_STRAY * c.distance;
        least.max(SCATTERS * scatter).max(SPREADS * c.spread)
    };
    let mut cloud = Cloud {
        stands_apart: comparisons.iter().map(|c| c.deviation > limit(c)).collect(),
        rays,
        radii,
        neighbours,
        comparisons,
    };
    let all = 0..cloud.radii.len();
    let apart: Vec<usize> = all.clone().filter(|&own| cloud.stands_apart[own]).collect();
    if apart.len() as f64 <= FEW * all.len() as f64 {
        let is_on_slope = |&own: &usize| cloud.off_slope(own) <= limit(&cloud.comparisons[own]);
        for own in apart.into_iter().filter(is_on_slope).collect::<Vec<_>>() {
            cloud.stands_apart[own] = false;
        }
    }
    let mut indices: Vec<u32> = all
        .filter(|&own| cloud.stands_apart[own] && !cloud.is_of_rim(own))
        .map(|own| own as u32)
        .collect();
    let seen = Seen {
        rays: &cloud.rays,
        radii: &cloud.radii,
        neighbours: &cloud.neighbours,
    };
    let islands = seen.islands(LEAST_STRAY.max(SCATTERS * scatter), NEAR);
    indices.extend(islands.into_iter().map(|own| own as u32));
    indices.sort_unstable();
    indices.dedup();
    Strays { indices, scatter }
}

/// What is known of the points.
struct Cloud {
    rays: Vec<Vector3<f64>>,
    radii: Vec<f64>,
    neighbours: Vec<Vec<usize>>,
    comparisons: Vec<Comparison>,
    stands_apart: Vec<bool>,
}

impl Cloud {
    /// Whether a point is one of a row that stands out from what falls off on both sides of it. Of a tip, which has nothing
    /// beside it, nobody can tell.
    fn is_of_rim(&self, own: usize) -> bool {
        self.is_of_row(own) && self.comparisons[own].deviation <= SPREADS * self.flank(own)
    }

    /// Whether points stand out as far, one beside the other.
    fn is_of_row(&self, own: usize) -> bool {
        let like = 0.5 * self.comparisons[own].deviation;
        let (mut row, mut at) = (vec![own], 0);
        while at < row.len() && row.len() < ROW {
            let from = row[at];
            for &to in &self.neighbours[from] {
                let step = (self.radii[to] / self.radii[from] - 1.0).abs();
                let is_like = self.comparisons[to].deviation > like && step < like;
                if is_like && !row.contains(&to) {
                    row.push(to);
                }
            }
            at += 1;
        }
        row.len() >= ROW
    }

    /// How much the surface goes on falling beyond three neighbours of four.
    fn flank(&self, own: usize) -> f64 {
        let mut falls: Vec<f64> = self.near(own).map(|from| self.fall(own, from)).collect();
        lower_quartile(&mut falls).unwrap_or(0.0)
    }

    /// By how much it falls, relatively, from a neighbour on, away from the point.
    fn fall(&self, own: usize, from: usize) -> f64 {
        let beyond = self
            .near(from)
            .filter(|to| !self.neighbours[own].contains(to));
        let side = (self.radii[own] - self.radii[from]).signum();
        let falls = beyond.map(|to| side * (self.radii[from] - self.radii[to]));
        falls.fold(0.0, f64::max) / self.radii[from]
    }

    /// How far a point lies from the plane through its neighbours, along its ray, relative to that plane's distance.
    fn off_slope(&self, own: usize) -> f64 {
        let of = |at: usize| (self.rays[at] / self.radii[at], 1.0 / self.radii[at]);
        let near: Vec<_> = self.near(own).map(of).collect();
        let (n, _) = of(own);
        match on_slope(&n, &near) {
            Some(inverse) if inverse > 0.0 => (self.radii[own] * inverse - 1.0).abs(),
            _ => f64::INFINITY,
        }
    }

    /// Neighbours that do not stand apart.
    fn near(&self, of: usize) -> impl Iterator<Item = usize> {
        let around = self.neighbours[of].iter().copied();
        around.filter(|&i| !self.stands_apart[i])
    }
}

fn compare(around: &mut [f64], radius: f64) -> Comparison {
    let middle = upper_median(around).unwrap_or(0.0);
    if middle <= 0.0 {
        return Comparison {
            deviation: 0.0,
            spread: 0.0,
            distance: 1.0,
        };
    }
    for other in around.iter_mut() {
        *other = (*other - middle).abs() / middle;
    }
    Comparison {
        deviation: (radius - middle).abs() / middle,
        spread: upper_median(around).unwrap_or(0.0),
        distance: 1.0,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fit::points::neighbours::Neighbours;
    use crate::shapes::Sampling;
    use crate::sphere::triangulate_directions;

    fn strays(
        directions: &[Vector3<f64>],
        radius: impl Fn(usize, &Vector3<f64>) -> f64,
    ) -> Vec<u32> {
        let places = directions.iter().enumerate().map(|(i, n)| n * radius(i, n));
        let mesh = Mesh {
            triangles: triangulate_directions(directions).unwrap(),
            vertices: places.map(Point3::from).collect(),
        };
        find_strays(&mesh, &Point3::origin()).indices
    }

    /// Two flat cones on each other: all points of the rim stand out from those above and below. Single ones that stand out as
    /// far, two of them side by side, are strays.
    #[test]
    fn a_rim_is_no_row_of_strays() {
        for sampling in [Sampling::Cube, Sampling::Rings] {
            let directions = sampling.directions(1538, 0).unwrap();
            let bicone = |n: &Vector3<f64>| 1.0 / (n.xy().norm() / 2.0 + n.z.abs());
            let found = strays(&directions, |_, n| bicone(n));
            assert!(found.is_empty(), "{sampling:?} {found:?}");
            let lifted = [700, 701, 1200];
            let radius = |i: usize, n: &Vector3<f64>| match lifted.contains(&i) {
                true => 1.3,
                false => 1.0 + 0.01 * n.x,
            };
            assert_eq!(
                strays(&directions, radius),
                lifted.map(|i| i as u32),
                "{sampling:?}"
            );
        }
    }

    /// A long body, seen twelve times more densely from above: there most neighbours of a point on its flank lie on one side of it.
    #[test]
    fn a_point_on_the_slope_of_its_neighbours_is_no_stray() {
        let even = Sampling::Fibonacci.directions(2000, 0).unwrap();
        let is_seen = |(i, n): &(usize, Vector3<f64>)| n.z > 0.6 || i % 12 == 0;
        let seen = even.into_iter().enumerate().filter(is_seen);
        let directions: Vec<Vector3<f64>> = seen.map(|(_, n)| n).collect();
        let axes = Vector3::new(2.5, 1.0, 1.0);
        let radius = |n: &Vector3<f64>| 1.0 / n.component_div(&axes).norm();
        assert_eq!(strays(&directions, |_, n| radius(n)), [0; 0]);
        let flank = Vector3::new(-0.87, 0.06, 0.5).normalize();
        let lifted = Neighbours::new(&directions).nearest(&flank, 1)[0];
        let lift = |i: usize| if i == lifted { 1.4 } else { 1.0 };
        let found = strays(&directions, |i, n| radius(n) * lift(i));
        assert_eq!(found, [lifted as u32]);
    }
}
