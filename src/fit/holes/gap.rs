//! The largest gap between the directions of a scan's points.

use super::empty_caps::largest_cap;
use super::wide::{all_together, is_any_wide};
use crate::fit::warning::FitWarning;
use crate::mesh::Mesh;
use crate::model::Unseen;
use crate::spread::middle_of_sum;
use nalgebra::{Point3, Vector3};

/// A gap in the scan is told of when no point lies within this angle (radians) and three times the spacing of the points, and
/// where it is wide in space, too.
const WIDE: f64 = 0.2;

/// The largest cap of directions without points.
pub(in crate::fit) struct Gap {
    /// Angular radius.
    pub(in crate::fit) half_angle: f64,
    direction: Vector3<f64>,
    /// Whether it is to be told.
    is_wide: bool,
    /// What was not seen, if it is large.
    pub(in crate::fit) unseen: Option<Unseen>,
    /// Whether that is no wider in space than points as far apart as those round it leave by chance. On the flat sides of a
    /// thin plate few points are many degrees apart, as seen from its middle.
    pub(in crate::fit) is_sparse: bool,
    /// Whether these are holes none of which is large: a fit may know the surface over each of them.
    pub(in crate::fit) is_many: bool,
}

impl Gap {
    /// That of the vertices of a closed mesh of about unit size, as seen from the middle of its area.
    pub(in crate::fit) fn new(mesh: &Mesh) -> Self {
        let centre = middle_of_area(mesh);
        let seen = |vertex: &Point3<f64>| (vertex - centre).try_normalize(0.0).unwrap_or_default();
        let directions: Vec<Vector3<f64>> = mesh.vertices.iter().map(seen).collect();
        let mut angles = vec![0.0; directions.len()];
        for corners in &mesh.triangles {
            let [a, b, c] = corners.map(|i| directions[i as usize]);
            for corner in corners {
                // A third of the triangle, which is half of the cross product.
                angles[*corner as usize] += (b - a).cross(&(c - a)).norm() / 6.0;
            }
        }
        let (half_angle, direction) = largest_cap(&directions);
        let unseen_in = |half_angle| Unseen::hole(half_angle, directions.len());
        let is_large = |half_angle| unseen_in(half_angle).is_some();
        let unseen = unseen_in(half_angle);
        let together = match unseen {
            Some(_) => None,
            None => unseen_in(all_together(mesh, &centre, half_angle)),
        };
        let is_sparse = unseen.is_some() && !is_any_wide(mesh, &directions, is_large);
        // Angle between neighbours where the points are neither very dense nor very sparse.
        let spacing = middle_of_sum(angles).unwrap_or(0.0).sqrt();
        let least = WIDE.max(3.0 * spacing);
        let is_wide = |half_angle| half_angle > least;
        Self {
            half_angle,
            direction,
            is_wide: is_wide(half_angle) && is_any_wide(mesh, &directions, is_wide),
            unseen: unseen.or(together),
            is_sparse,
            is_many: together.is_some(),
        }
    }

    /// What is to be told, if it is wide.
    pub(in crate::fit) fn warning(&self) -> Option<FitWarning> {
        self.is_wide.then_some(FitWarning::Gap {
            half_angle: self.half_angle,
            direction: self.direction,
        })
    }
}

/// Unlike the mean of the points it does not lie where there are most of them.
fn middle_of_area(mesh: &Mesh) -> Point3<f64> {
    let first = mesh.vertices.first().copied().unwrap_or_default();
    let (mut sum, mut area) = (Vector3::zeros(), 0.0);
    for corners in &mesh.triangles {
        let [a, b, c] = corners.map(|i| mesh.vertices[i as usize] - first);
        let own = (b - a).cross(&(c - a)).norm();
        sum += (a + b + c) * (own / 3.0);
        area += own;
    }
    first + sum / area
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fit::prepare::scanned_surface;
    use crate::scan::Scan;
    use crate::shapes::Sampling;

    /// Points on an ellipsoid 8 : 8 : 1, at random and evenly by area.
    fn plate(points: usize, seed: u64) -> Vec<Point3<f64>> {
        let directions = Sampling::Random.directions(40 * points, seed).unwrap();
        let chances = (0..).map(|i| f64::from(i) * 0.618_033_988_75 % 1.0);
        let stretch = |n: &Vector3<f64>| n.x.hypot(n.y).hypot(8.0 * n.z) / 8.0;
        let is_kept = |(n, chance): &(Vector3<f64>, f64)| stretch(n) > *chance;
        let kept = directions.into_iter().zip(chances).filter(is_kept);
        let places = kept.map(|(n, _)| Point3::new(8.0 * n.x, 8.0 * n.y, n.z));
        places.take(points).collect()
    }

    fn seen(points: Vec<Point3<f64>>) -> (Option<Unseen>, bool) {
        let scan = Scan::from_points(points);
        let surface = scanned_surface(&scan).unwrap();
        (surface.unseen, surface.is_sparse)
    }

    #[test]
    fn few_points_on_the_sides_of_a_plate_are_sparse_and_a_hole_there_is_not() {
        let few: Vec<_> = (0..6).map(|seed| seen(plate(700, seed))).collect();
        assert!(few.iter().any(|(unseen, _)| unseen.is_some()));
        assert!(
            few.iter()
                .all(|(unseen, is_sparse)| unseen.is_some() == *is_sparse)
        );
        assert_eq!(seen(plate(8000, 0)), (None, false));
        for points in [1500, 6000] {
            let mut open = plate(points, 0);
            open.retain(|p| p.z > 0.0 || p.x.hypot(p.y) > 3.0);
            let (unseen, is_sparse) = seen(open);
            assert!(unseen.is_some() && !is_sparse, "{unseen:?}");
        }
    }

    #[test]
    fn a_gap_is_told_where_points_are_missing_and_not_where_they_are_seen_at_a_slant() {
        let is_told = |points: Vec<Point3<f64>>| {
            let scan = Scan::from_points(points);
            let warnings = scanned_surface(&scan).unwrap().warnings;
            let is_gap = |warning: &FitWarning| matches!(warning, FitWarning::Gap { .. });
            warnings.iter().any(is_gap)
        };
        // Seen from the middle, neighbours on the flat sides are 3.5 times as far apart as on the rim.
        assert!((0..4).all(|seed| !is_told(plate(4000, seed))));
        let mut open = plate(4000, 0);
        open.retain(|p| p.z > 0.0 || p.x.hypot(p.y) > 1.5);
        assert!(is_told(open));
    }

    #[test]
    fn a_cap_that_is_cut_out_of_a_ball_is_no_chance() {
        for degrees in [35.0_f64, 60.0, 85.0] {
            let mut directions = Sampling::Random.directions(600, 1).unwrap();
            directions.retain(|n| n.z > -degrees.to_radians().cos());
            let (unseen, is_sparse) = seen(directions.into_iter().map(Point3::from).collect());
            assert!(unseen.is_some() && !is_sparse, "{degrees}: {unseen:?}");
        }
    }
}
