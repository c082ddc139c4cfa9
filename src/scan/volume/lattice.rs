//! Points that are the centres of the outermost voxels of a grain: whole numbers, and closed all round.

use super::voxel_scan;
use crate::mesh::Grid;
use crate::scan::Scan;
use nalgebra::{Matrix3, Point3};

/// Fewest points of a surface of voxels.
const LEAST_POINTS: usize = 200;

/// Voxels of the box around the points, over the power 3/2 of their number, at most: of a ball this is .1, of a plate
/// of a hundred times its thickness, askew, some 3.
const LARGEST_BOX: f64 = 4.0;

/// What the points enclose, over their own number, at least: a surface one voxel thick has something in it.
const LEAST_ENCLOSED: f64 = 0.25;

/// The grain whose outermost voxels have their centres at these points, with a warning that says so; `None` where they
/// are not such points.
pub(in crate::scan) fn filled(points: &[Point3<f64>]) -> Option<Scan> {
    let are_whole = points
        .iter()
        .flat_map(|p| p.iter())
        .all(|x| x.fract() == 0.0);
    if points.len() < LEAST_POINTS || !are_whole {
        return None;
    }
    let (mut low, mut high) = (points[0].coords, points[0].coords);
    for point in points {
        (low, high) = (low.inf(&point.coords), high.sup(&point.coords));
    }
    let sides = (high - low).map(|side| side + 1.0);
    let most = LARGEST_BOX * (points.len() as f64).powf(1.5);
    if sides.product() > most {
        return None;
    }
    let voxel =
        |point: &Point3<f64>| -> [usize; 3] { (point.coords - low).map(|x| x as usize).into() };
    let mut grid = Grid::new(sides.map(|side| side as usize).into());
    for point in points {
        grid.fill(voxel(point));
    }
    let inside = grid.fill_enclosed();
    if (inside as f64) < (1.0 + LEAST_ENCLOSED) * points.len() as f64 {
        return None;
    }
    let mut scan = voxel_scan(&grid, Point3::from(low), &Matrix3::identity()).ok()?;
    scan.warnings.push(format!(
        "All points are whole numbers and close round a grain of {inside} voxels: they are taken as the centres of its \
         outermost voxels, and the surface as lying half a voxel outside of them."
    ));
    Some(scan)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::measure::mesh_properties;
    use crate::mesh::Mesh;
    use approx::assert_relative_eq;
    use nalgebra::Vector3;
    use std::f64::consts::PI;

    /// The voxels of a ball at whose faces there is a voxel outside.
    fn outermost(radius: f64) -> Vec<Point3<f64>> {
        let centre = Vector3::new(0.3, 0.1, -0.2);
        let is_inside = |at: Vector3<f64>| (at - centre).norm() < radius;
        let reach = radius.ceil() as i32 + 1;
        let range = || -reach..=reach;
        let all =
            range().flat_map(move |x| range().flat_map(move |y| range().map(move |z| [x, y, z])));
        let all = all.map(|at| Vector3::from(at.map(f64::from)));
        let is_outermost = |at: &Vector3<f64>| {
            let mut sides =
                (0..3).flat_map(|axis| [-1.0, 1.0].map(|side| Vector3::ith(axis, side)));
            is_inside(*at) && sides.any(|side| !is_inside(at + side))
        };
        all.filter(is_outermost).map(Point3::from).collect()
    }

    #[test]
    fn the_voxels_of_a_ball_have_its_volume() {
        let scan = filled(&outermost(12.0)).unwrap();
        assert!(scan.topology().unwrap().closed && scan.warnings().len() == 1);
        let mesh = Mesh {
            vertices: scan.points().to_vec(),
            triangles: scan.triangles().to_vec(),
        };
        let volume = mesh_properties(&mesh).unwrap().volume;
        assert_relative_eq!(volume, 4.0 / 3.0 * PI * 12_f64.powi(3), max_relative = 0.01);
    }

    #[test]
    fn other_points_are_left_as_they_are() {
        let points = outermost(12.0);
        let moved: Vec<_> = points.iter().map(|p| p * 1.01).collect();
        assert!(filled(&moved).is_none());
        let open: Vec<_> = points.iter().filter(|p| p.z < 10.0).copied().collect();
        assert!(filled(&open).is_none());
        // Whole numbers of a finer unit.
        let scattered: Vec<_> = points.iter().map(|p| p * 100.0).collect();
        assert!(filled(&scattered).is_none());
    }
}
