//! Points that are the centres of voxels, of all of a grain or of its outermost ones: they lie on a lattice, and close all round.

use super::VoxelLattice;
use super::frames::in_a_frame;
use super::recurring::recurring;
use super::steps::Steps;
use super::voxel_scan;
use crate::mesh::Grid;
use crate::scan::Scan;
use nalgebra::{Matrix3, Point3};

/// Fewest places of a surface of voxels.
const LEAST_PLACES: usize = 200;

/// Points are this near to places of the lattice, in steps: coordinates may be rounded.
const ON_STEP: f64 = 0.1;

/// Voxels of the box around the points, over the power 3/2 of their number, at most: of a ball this is .1, of a plate
/// of a hundred times its thickness, askew, some 3.
const LARGEST_BOX: f64 = 4.0;

/// What the points enclose, over their own number, at least: a surface one voxel thick has something in it.
const LEAST_ENCLOSED: f64 = 0.25;

/// Share of repeated points from which on places are not those of voxels, but rounded.
const MOST_REPEATED: f64 = 0.01;

/// What points on a lattice are.
#[derive(Debug)]
pub(in crate::scan) enum Centres {
    /// Those of the voxels of this grain, with a warning that says so.
    Of(Box<Scan>),
    /// Perhaps those of voxels of this lattice, but these do not close.
    Open(VoxelLattice),
}

/// What points are that lie on a lattice about as coarse as they are dense; `None` of all others.
pub(in crate::scan) fn centres(points: &[Point3<f64>]) -> Option<Centres> {
    if points.len() < LEAST_PLACES {
        return None;
    }
    let places = in_a_frame(|| recurring(points), |frame| Places::along(frame, points))?;
    match places.filled() {
        Some(scan) => Some(Centres::Of(Box::new(scan))),
        None => places.are_dense().then_some(Centres::Open(places.lattice)),
    }
}

/// Points that lie on a lattice.
struct Places {
    lattice: VoxelLattice,
    /// Their number.
    points: usize,
    /// Where they are, in steps from the first corner of the box around them, each once.
    voxels: Vec<[usize; 3]>,
    /// Voxels along the sides of that box.
    sides: [usize; 3],
}

impl Places {
    fn along(frame: &Matrix3<f64>, points: &[Point3<f64>]) -> Option<Self> {
        let axis = |axis: usize| Steps::new(points, frame.column(axis).into(), ON_STEP, &[1.0]);
        let axes = [axis(0)?, axis(1)?, axis(2)?];
        let place = |point: &Point3<f64>| axes.each_ref().map(|axis| axis.number(point) as usize);
        let mut voxels: Vec<[usize; 3]> = points.iter().map(place).collect();
        voxels.sort_unstable();
        voxels.dedup();
        // Beside a place far off, all others are one.
        if voxels.len() < LEAST_PLACES {
            return None;
        }
        let side = |axis: &Steps| axis.numbers.last().map_or(0, |&last| last as usize) + 1;
        let first = Point3::from(axes.each_ref().map(|axis| axis.first));
        Some(Self {
            lattice: VoxelLattice {
                first: frame * first,
                steps: Matrix3::from_columns(&axes.each_ref().map(|axis| axis.along * axis.step)),
            },
            points: points.len(),
            voxels,
            sides: axes.each_ref().map(side),
        })
    }

    /// The grain whose voxels have their centres at the points: they are all of them, or enclose the others.
    fn filled(&self) -> Option<Scan> {
        let voxels: f64 = self.sides.iter().map(|&side| side as f64).product();
        if voxels > LARGEST_BOX * (self.voxels.len() as f64).powf(1.5) || self.are_rounded() {
            return None;
        }
        let mut grid = Grid::new(self.sides);
        for &voxel in &self.voxels {
            grid.fill(voxel);
        }
        let given = self.voxels.len() as f64;
        let inside = grid.fill_enclosed();
        let is_enclosing = inside as f64 >= (1.0 + LEAST_ENCLOSED) * given;
        let is_solid = given >= (1.0 + LEAST_ENCLOSED) * grid.outermost() as f64;
        if !is_enclosing && !is_solid {
            return None;
        }
        let mut scan = voxel_scan(&grid, self.lattice.first, &self.lattice.steps).ok()?;
        let sides = self.lattice.sides();
        scan.warnings.push(match is_enclosing {
            true => format!(
                "All points lie on a lattice with steps of {sides} and close round a grain of {inside} voxels: they are taken as the \
                 centres of its outermost voxels, and the surface as lying half a voxel outside of them."
            ),
            false => format!(
                "All points lie on a lattice with steps of {sides} and fill a grain: they are taken as the centres of its {inside} voxels."
            ),
        });
        Some(scan)
    }

    /// Whether some places are repeated: those of voxels are not, but where all are alike.
    fn are_rounded(&self) -> bool {
        let voxels = self.voxels.len();
        self.points as f64 > (1.0 + MOST_REPEATED) * voxels as f64
            && !self.points.is_multiple_of(voxels)
    }

    /// Whether most of them lie beside another, as outermost voxels do: of those that are left when one in ten is drawn, six in ten.
    fn are_dense(&self) -> bool {
        let steps = || {
            (0..27)
                .map(|at| [at % 3, at / 3 % 3, at / 9])
                .filter(|step| *step != [1; 3])
        };
        let is_beside = |voxel: &&[usize; 3]| {
            steps().any(|step| {
                let other = [0, 1, 2].map(|axis| (voxel[axis] + step[axis]).wrapping_sub(1));
                self.voxels.binary_search(&other).is_ok()
            })
        };
        let beside = self.voxels.iter().filter(is_beside).count();
        2 * beside > self.voxels.len()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::measure::mesh_properties;
    use crate::mesh::Mesh;
    use crate::shapes::Sampling;
    use approx::assert_relative_eq;
    use nalgebra::{Rotation3, Vector3};
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

    /// Seen from a row that means "no data", all points of a grain are at one place.
    #[test]
    fn a_point_far_off_makes_no_lattice_of_the_others() {
        let mut points: Vec<Point3<f64>> = Sampling::Random
            .directions(2000, 1)
            .unwrap()
            .into_iter()
            .map(Point3::from)
            .collect();
        points.push(Point3::new(-9999.0, -9999.0, -9999.0));
        assert!(centres(&points).is_none());
    }

    /// The volume of the grain that is made of points.
    fn volume(points: &[Point3<f64>]) -> Option<f64> {
        let Some(Centres::Of(scan)) = centres(points) else {
            return None;
        };
        assert!(scan.topology().unwrap().closed && scan.warnings().len() == 1);
        assert!(scan.scatter().unwrap() > 0.0);
        let mesh = Mesh {
            vertices: scan.points().to_vec(),
            triangles: scan.triangles().to_vec(),
        };
        Some(mesh_properties(&mesh).unwrap().volume)
    }

    fn is_open(points: &[Point3<f64>]) -> bool {
        matches!(centres(points), Some(Centres::Open(_)))
    }

    #[test]
    fn the_voxels_of_a_ball_have_its_volume_whatever_their_sides_and_axes() {
        let points = outermost(12.0);
        let all = 4.0 / 3.0 * PI * 12_f64.powi(3);
        let turn = Rotation3::from_euler_angles(0.4, 0.7, 1.3);
        let is_as_large = |times: f64, map: &dyn Fn(&Point3<f64>) -> Point3<f64>| {
            let mut mapped: Vec<Point3<f64>> = points.iter().map(map).collect();
            let told = volume(&mapped).unwrap();
            assert_relative_eq!(told, times * all, max_relative = 0.01);
            mapped.extend_from_within(..);
            assert_relative_eq!(volume(&mapped).unwrap(), told, max_relative = 1e-4);
        };
        is_as_large(1.0, &|p| *p);
        // Rounded to three digits.
        is_as_large(0.0366_f64.powi(3), &|p| (p * 36.6).map(f64::round) / 1000.0);
        is_as_large(0.5, &|p| Point3::new(p.x + 0.5, 0.25 * p.y, 2.0 * p.z));
        is_as_large(0.05_f64.powi(3), &|p| turn * (p * 0.05) + Vector3::x());
    }

    #[test]
    fn all_voxels_of_a_grain_are_taken_for_it_too() {
        let surface = outermost(12.0);
        let all = (1..=12).flat_map(|radius| outermost(f64::from(radius)));
        let mut all: Vec<Point3<f64>> = all.collect();
        let key = |p: &Point3<f64>| p.coords.map(|x| x as i32).as_slice().to_vec();
        all.sort_by_key(key);
        all.dedup();
        assert_relative_eq!(
            volume(&all).unwrap(),
            volume(&surface).unwrap(),
            max_relative = 1e-12
        );
    }

    #[test]
    fn points_on_a_lattice_that_do_not_close_may_be_those_of_voxels() {
        let points = outermost(12.0);
        let open: Vec<_> = points.iter().filter(|p| p.z < 10.0).copied().collect();
        assert!(is_open(&open));
        let third: Vec<_> = points.iter().step_by(3).copied().collect();
        assert!(is_open(&third));
        // Rounded so coarsely that many are one.
        let directions = Sampling::Random.directions(20_000, 1).unwrap().into_iter();
        let rounded: Vec<Point3<f64>> = directions
            .map(|n| (n * 12.0).map(f64::round).into())
            .collect();
        assert!(is_open(&rounded));
    }

    #[test]
    fn other_points_are_left_as_they_are() {
        let directions = Sampling::Random.directions(3000, 1).unwrap();
        let points: Vec<Point3<f64>> = directions.iter().map(|n| (n * 12.0).into()).collect();
        assert!(centres(&points).is_none());
        // Rounded to a hundredth of what is between two of them.
        let fine: Vec<Point3<f64>> = points.iter().map(|p| (p * 100.0).map(f64::round)).collect();
        assert!(centres(&fine).is_none());
    }
}
