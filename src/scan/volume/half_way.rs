//! Meshes that marching cubes made of voxels which are in a body or not: vertices lie half-way between two voxels.
//!
//! Along each axis of the voxels places are then whole numbers of half steps. Of the three numbers of a vertex, counted from the middle of
//! a voxel, one is odd: that of the axis along which it lies between two voxels.

use super::VoxelLattice;
use super::frames::{in_a_frame, sides};
use super::steps::Steps;
use nalgebra::{Matrix3, Point3};

/// Fewer vertices do not tell.
const LEAST_POINTS: usize = 100;

/// Vertices are this near to a whole number of half steps, as a share of one.
const ON_STEP: f64 = 0.02;

/// Half steps are the usual ones, or along straight walls, where vertices are whole steps apart but for the ends, their halves.
const PARTS: [f64; 2] = [1.0, 2.0];

/// Share of the vertices that lie half-way between two voxels: where faces may go either way between eight voxels some programs add others.
const SHARE: f64 = 0.99;

/// The voxels between which the vertices of a mesh lie half-way, if they do.
pub(super) fn half_way(points: &[Point3<f64>], triangles: &[[u32; 3]]) -> Option<VoxelLattice> {
    if points.len() < LEAST_POINTS {
        return None;
    }
    in_a_frame(|| sides(points, triangles), |frame| along(frame, points))
}

/// The same of voxels along the axes of a frame.
fn along(frame: &Matrix3<f64>, points: &[Point3<f64>]) -> Option<VoxelLattice> {
    let axis = |axis: usize| Steps::new(points, frame.column(axis).into(), ON_STEP, &PARTS);
    let axes = [axis(0)?, axis(1)?, axis(2)?];
    let mut vertices = [0; 8];
    for point in points {
        let odd = axes.iter().map(|axis| axis.number(point) % 2 != 0);
        vertices[odd.fold(0, |bits, is_odd| 2 * bits + usize::from(is_odd))] += 1;
    }
    // The bits of the middles of voxels: those of vertices differ from them in one.
    let beside = |middle: usize| [4, 2, 1].map(|bit| vertices[middle ^ bit]);
    let middle = (0..8).find(|&middle| {
        let along = beside(middle);
        along.iter().all(|&count| count > 0)
            && along.iter().sum::<usize>() as f64 >= SHARE * points.len() as f64
    })?;
    let is_odd = [4, 2, 1].map(|bit| middle & bit > 0);
    let mut of_layers = axes.iter().zip(is_odd);
    if !of_layers.any(|(axis, is_odd)| holds_neighbours(axis, is_odd)) {
        return None;
    }
    let first = is_odd.map(|is_odd| f64::from(u8::from(is_odd)));
    let place = |at: usize| axes[at].first + first[at] * axes[at].step;
    Some(VoxelLattice {
        first: frame * Point3::new(place(0), place(1), place(2)),
        steps: Matrix3::from_columns(&axes.map(|axis| axis.along * (2.0 * axis.step))),
    })
}

/// Whether vertices lie in a layer of voxels and in the next. Where the surface was drawn at a quarter of the way they do so in
/// every other one of these half steps, at a sixth in every third.
fn holds_neighbours(steps: &Steps, is_odd: bool) -> bool {
    let layers = steps.numbers.iter().filter(|&n| (n % 2 != 0) == is_odd);
    let next = layers.clone().skip(1);
    layers.zip(next).any(|(layer, next)| next - layer == 2)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::{Grid, Mesh, contour};
    use approx::assert_relative_eq;
    use nalgebra::{Rotation3, Vector3};

    /// What marching cubes make of an ellipsoid in voxels of these sides.
    fn between(steps: &Vector3<f64>) -> Mesh {
        let semi_axes = Vector3::new(10.0, 7.0, 5.0);
        made(steps, |at| at.component_div(&semi_axes).norm() < 1.0)
    }

    /// The same of a body whose middle is the origin.
    fn made(steps: &Vector3<f64>, is_inside: impl Fn(&Vector3<f64>) -> bool) -> Mesh {
        drawn(0.5, steps, is_inside)
    }

    /// The same of a surface drawn at this share of the way from a voxel outside to one inside.
    fn drawn(share: f64, steps: &Vector3<f64>, is_inside: impl Fn(&Vector3<f64>) -> bool) -> Mesh {
        let mut grid = Grid::new([24, 24, 24]);
        let line = || 0..24;
        let voxels = line().flat_map(|x| line().flat_map(move |y| line().map(move |z| [x, y, z])));
        let holds = |voxel: [usize; 3]| {
            is_inside(&Vector3::from(voxel.map(|i| i as f64)).add_scalar(-11.3))
        };
        for voxel in voxels.filter(|&voxel| holds(voxel)) {
            grid.fill(voxel);
        }
        let mut mesh = contour(&grid, |voxel, _| match holds(voxel.map(|i| i - 1)) {
            true => 1.0 - share,
            false => share,
        });
        for vertex in &mut mesh.vertices {
            *vertex = vertex.coords.component_mul(steps).into();
        }
        mesh
    }

    #[test]
    fn the_voxels_of_marching_cubes_are_found_whatever_their_sides_and_rounding() {
        let steps = Vector3::new(0.05, 0.05, 0.13);
        let aside = Vector3::new(17.3, -4.0, 0.7);
        let mesh = between(&steps);
        let moved = mesh.vertices.iter().map(|vertex| vertex + aside);
        let moved: Vec<Point3<f64>> = moved
            .map(|place| place.map(|x| f64::from(x as f32)))
            .collect();
        let found = half_way(&moved, &mesh.triangles).unwrap();
        let sides = found.steps.diagonal();
        assert_relative_eq!(sides, steps, max_relative = 1e-5);
        let from_voxel = (found.first - aside).coords.component_div(&steps);
        let off = from_voxel.map(|x| (x - x.round()).abs());
        assert!(off.max() < 1e-3, "{off}");
        assert!(found.axes(&moved).iter().all(Option::is_some));
        // Places that are off by a thousandth of a voxel.
        let off = (0..).map(|at| 1e-3 * f64::from(at).sin());
        let rounded = mesh.vertices.iter().zip(off);
        let rounded: Vec<Point3<f64>> = rounded.map(|(vertex, off)| vertex + steps * off).collect();
        assert!(half_way(&rounded, &mesh.triangles).is_some());
        // Voxels along other axes than the file's.
        let turn = Rotation3::from_euler_angles(0.4, 0.7, 1.3);
        let turned: Vec<Point3<f64>> = mesh.vertices.iter().map(|vertex| turn * vertex).collect();
        let found = half_way(&turned, &mesh.triangles).unwrap();
        let volume = found.steps.determinant();
        assert_relative_eq!(volume.abs(), steps.product(), max_relative = 1e-9);
        assert!(found.axes(&turned).iter().all(Option::is_some));
    }

    #[test]
    fn the_voxels_of_bodies_with_straight_walls_are_found() {
        let steps = Vector3::new(1.0, 1.0, 1.0);
        let cylinder = made(&steps, |at| at.xy().norm() < 6.0 && at.z.abs() < 10.0);
        let block = made(&steps, |at| at.amax() < 8.0);
        for mesh in [cylinder, block] {
            let found = half_way(&mesh.vertices, &mesh.triangles).unwrap();
            assert_relative_eq!(found.steps, Matrix3::identity(), max_relative = 1e-12);
        }
    }

    /// Vertices then lie between voxels of half and of a third the sides, but for layers that hold none.
    #[test]
    fn the_surface_of_a_mask_at_a_quarter_or_a_sixth_is_not_half_way() {
        let steps = Vector3::new(1.0, 1.0, 1.0);
        let semi_axes = Vector3::new(10.0, 7.0, 5.0);
        let turn = Rotation3::from_euler_angles(0.6, 0.5, 0.7);
        for share in [0.25, 1.0 / 6.0] {
            let mesh = drawn(share, &steps, |at| {
                (turn * at).component_div(&semi_axes).norm() < 1.0
            });
            let axes =
                |axis: usize| Steps::new(&mesh.vertices, Vector3::ith(axis, 1.0), ON_STEP, &PARTS);
            assert!((0..3).all(|axis| axes(axis).is_some()));
            assert_eq!(half_way(&mesh.vertices, &mesh.triangles), None);
        }
    }

    #[test]
    fn other_meshes_are_not_between_voxels() {
        let steps = Vector3::new(1.0, 1.0, 1.0);
        let mut mesh = between(&steps);
        for vertex in mesh.vertices.iter_mut().step_by(50) {
            vertex.x += 0.5;
        }
        let found = |mesh: &Mesh| half_way(&mesh.vertices, &mesh.triangles);
        assert_eq!(found(&mesh), None);
        assert_eq!(found(&Mesh::radial(16, |n| 1.0 + 0.2 * n.z)), None);
        // A block whose sides are cut in squares.
        let line = || 0..9;
        let all = line().flat_map(|x| line().flat_map(move |y| line().map(move |z| [x, y, z])));
        let on_side = all.filter(|place| place.iter().any(|x| [0, 8].contains(x)));
        let block = on_side.map(|place| place.map(f64::from).into());
        let block: Vec<_> = block.collect();
        assert_eq!(along(&Matrix3::identity(), &block), None);
    }
}
