//! The centre from which a closed mesh is star-shaped, and how far it is from being so.
//!
//! A point c sees the whole surface if and only if it lies on the inner side of every facet's plane:
//! n.(p - c) > 0. All such c form a convex set, the kernel, and the c that is deepest inside it
//! solves a linear programme in four unknowns: maximise t subject to n_i.(p_i - c) >= t. Of the
//! thousands of facets a few dozen matter, so the programme is solved on a growing subset (cutting
//! planes) until no facet is violated.

use crate::mesh::Mesh;
use microlp::{ComparisonOp, OptimizationDirection, Problem};
use nalgebra::{Point3, Vector3};

/// Facets added to the programme per round.
const FACETS_PER_ROUND: usize = 24;

/// Rounds before the search for a centre is given up; 5 to 10 are usual.
const ROUNDS: usize = 60;

/// A facet's plane: unit outward normal, and distance from the starting point in units of the size
/// of the mesh.
struct Plane {
    normal: Vector3<f64>,
    distance: f64,
    area: f64,
}

/// Share of the surface's area whose outer side faces `centre`.
pub(crate) fn facing_away_share(mesh: &Mesh, centre: &Point3<f64>) -> f64 {
    let (mut away, mut total) = (0.0, 0.0);
    for plane in planes(mesh, centre, 1.0) {
        total += plane.area;
        if plane.distance <= 0.0 {
            away += plane.area;
        }
    }
    if total > 0.0 { away / total } else { 1.0 }
}

/// The centre deepest inside the kernel of the mesh, or the one that violates its facets least where
/// the kernel is empty. `None` if the linear programme fails.
pub(crate) fn deepest_centre(mesh: &Mesh, start: &Point3<f64>) -> Option<Point3<f64>> {
    let size = mesh
        .vertices
        .iter()
        .map(|p| (p - start).norm())
        .fold(0.0, f64::max);
    let planes: Vec<Plane> = planes(mesh, start, 1.0 / size).collect();
    let mut used = vec![false; planes.len()];
    let mut subset: Vec<usize> = Vec::new();
    let (mut centre, mut depth) = (Vector3::zeros(), 1.0);
    for _ in 0..ROUNDS {
        let mut violated: Vec<(f64, usize)> = planes
            .iter()
            .enumerate()
            .map(|(i, plane)| (plane.distance - plane.normal.dot(&centre), i))
            .filter(|&(slack, i)| !used[i] && slack < depth - TOLERANCE)
            .collect();
        if violated.is_empty() {
            break;
        }
        let kept = violated.len().min(FACETS_PER_ROUND);
        violated.select_nth_unstable_by(kept - 1, |a, b| a.0.total_cmp(&b.0));
        for &(_, i) in &violated[..kept] {
            used[i] = true;
            subset.push(i);
        }
        (centre, depth) = solve(subset.iter().map(|&i| &planes[i]))?;
    }
    Some(start + centre * size)
}

/// Slack below which a facet counts as satisfied, relative to the size of the mesh; the solver
/// itself holds 1e-7.
const TOLERANCE: f64 = 1e-6;

/// The deepest point with respect to the given planes, within the cube of the mesh's size.
fn solve<'a>(planes: impl Iterator<Item = &'a Plane>) -> Option<(Vector3<f64>, f64)> {
    let mut problem = Problem::new(OptimizationDirection::Maximize);
    let c = [(); 3].map(|()| problem.add_var(0.0, (-1.0, 1.0)));
    let t = problem.add_var(1.0, (-2.0, 1.0));
    for Plane {
        normal, distance, ..
    } in planes
    {
        problem.add_constraint(
            [
                (c[0], normal.x),
                (c[1], normal.y),
                (c[2], normal.z),
                (t, 1.0),
            ],
            ComparisonOp::Le,
            *distance,
        );
    }
    let solution = problem.solve().ok()?.into_solution().ok()?;
    let value = c.map(|c| solution.var_value(c));
    Some((Vector3::from(value), solution.var_value(t)))
}

fn planes(mesh: &Mesh, from: &Point3<f64>, scale: f64) -> impl Iterator<Item = Plane> {
    mesh.triangles.iter().filter_map(move |corners| {
        let [a, b, c] = corners.map(|i| (mesh.vertices[i as usize] - from) * scale);
        let cross = (b - a).cross(&(c - a));
        let twice_area = cross.norm();
        (twice_area > 0.0).then(|| Plane {
            normal: cross / twice_area,
            distance: cross.dot(&a) / twice_area,
            area: 0.5 * twice_area,
        })
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shapes::Sampling;
    use crate::sphere::triangulate_directions;

    /// A ball of unit radius whose triangulation is pushed out on one side, seen from far off centre.
    fn cup(dent: f64) -> Mesh {
        let directions = Sampling::Fibonacci
            .directions(400, 0)
            .expect("enough directions");
        Mesh {
            triangles: triangulate_directions(&directions).expect("400 directions"),
            vertices: directions
                .iter()
                .map(|d| Point3::from(d * (1.0 - dent * (8.0 * (d.z - 1.0)).exp())))
                .collect(),
        }
    }

    #[test]
    fn a_ball_is_seen_whole_from_inside_and_its_centre_is_deepest() {
        let ball = cup(0.0);
        assert_eq!(facing_away_share(&ball, &Point3::new(0.5, 0.0, 0.0)), 0.0);
        assert!(facing_away_share(&ball, &Point3::new(0.0, 1.5, 0.0)) > 0.1);
        let centre = deepest_centre(&ball, &Point3::new(0.6, 0.1, 0.0)).expect("solved");
        assert!(centre.coords.norm() < 0.05, "{centre}");
    }

    #[test]
    fn a_dented_ball_is_star_shaped_from_below_the_dent_only() {
        let dented = cup(0.6);
        let above = Point3::new(0.0, 0.0, 0.5);
        assert!(facing_away_share(&dented, &above) > 0.0);
        let centre = deepest_centre(&dented, &above).expect("solved");
        assert_eq!(facing_away_share(&dented, &centre), 0.0);
    }
}
