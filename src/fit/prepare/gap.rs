//! The largest gap between the directions of a scan's points.

use crate::fit::gaps::largest_cap;
use crate::fit::warning::FitWarning;
use crate::measure::Unit;
use crate::mesh::Mesh;
use nalgebra::{Point3, Vector3};

/// A gap in the scan is told of when no point lies within this angle (radians) and three times the
/// spacing of the points.
const WIDE: f64 = 0.2;

/// The largest cap of directions without points.
pub(super) struct Gap {
    /// Angular radius.
    pub(super) half_angle: f64,
    direction: Vector3<f64>,
    /// Angle between neighbours where the points are neither very dense nor very sparse.
    spacing: f64,
}

impl Gap {
    /// That of the vertices of a closed mesh, as seen from the middle of its area.
    pub(super) fn new(mesh: &Mesh) -> Self {
        let mesh = &Unit::of(mesh).mesh(mesh);
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
        Self {
            half_angle,
            direction,
            spacing: middle(angles).sqrt(),
        }
    }

    /// What is to be told, if it is wide.
    pub(super) fn warning(&self) -> Option<FitWarning> {
        let is_wide = self.half_angle > WIDE.max(3.0 * self.spacing);
        is_wide.then_some(FitWarning::Gap {
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

/// The value of which those that are less have half of the sum: many points at one place have no part in it.
fn middle(mut values: Vec<f64>) -> f64 {
    values.sort_unstable_by(f64::total_cmp);
    let half = 0.5 * values.iter().sum::<f64>();
    let mut sum = 0.0;
    let reached = values.iter().find(|value| {
        sum += **value;
        sum >= half
    });
    reached.copied().unwrap_or(0.0)
}
