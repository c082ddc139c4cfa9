//! Whether what is taken for one body has a neck, as two grains that touch have.

use super::links::Links;
use super::neck::{Neck, THIN};
use super::spacing::covering;
use crate::scan::VoxelLattice;
use crate::scan::drawn::{drawn, evenly_drawn};
use nalgebra::Point3;

/// The same of slabs in which necks between voxels show.
const THIN_OF_VOXELS: f64 = 0.7;

/// Points by which a neck is looked for in a scan of one body.
const NECK_POINTS: usize = 4000;

/// Whether a cloud without faces, taken for one body, has a neck at which [`split`](super::split()) would cut it.
pub(crate) fn has_neck(points: &[Point3<f64>]) -> bool {
    let drawn = evenly_drawn(points, NECK_POINTS);
    let waist = |times: f64| neck_of(&drawn, times).filter(Neck::is_waist);
    // Between rows of points thin slabs hold few of them; a neck is a waist in thick slabs too.
    let is_thick = || waist(1.0).is_some_and(|neck| neck.is_narrow()) && waist(2.0).is_some();
    waist(THIN).is_some() && (between_two(&drawn) || is_thick())
}

/// Whether a cloud has a neck between two grains, each of which its outline follows: of a bent body the arms may have a neck that is
/// as narrow.
pub(crate) fn are_two_grains(points: &[Point3<f64>]) -> bool {
    between_two(&drawn(points, NECK_POINTS))
}

/// The same of the middles between voxels inside and outside, whose rows are as near as their points, so that thin slabs tell: the
/// neck of two equal grains may lie between two thick ones. Of 130 bodies of voxels without a neck none has one, however broad.
///
/// Of long voxels a slab may lie between two layers; a neck is a waist also in a space in which they are cubes.
pub(crate) fn voxels_have_neck(points: &[Point3<f64>], lattice: Option<&VoxelLattice>) -> bool {
    let narrows = |points: &[Point3<f64>]| {
        let drawn = drawn(points, NECK_POINTS);
        let neck = |times: f64| neck_of(&drawn, times).filter(Neck::may_part_two);
        neck(THIN_OF_VOXELS).is_some()
            || neck(THIN).is_some_and(|neck| neck.is_narrow())
            || between_two(&drawn)
    };
    let has_waist = |cubes: Vec<Point3<f64>>| {
        let drawn = drawn(&cubes, NECK_POINTS);
        let waist = |times: f64| neck_of(&drawn, times).filter(Neck::is_waist);
        waist(THIN_OF_VOXELS).or_else(|| waist(THIN)).is_some()
    };
    let of_cubes = || lattice.and_then(|lattice| lattice.places(points));
    narrows(points) && of_cubes().is_none_or(has_waist)
}

fn between_two(points: &[Point3<f64>]) -> bool {
    let links = Links::new(points);
    links.is_some_and(|links| Neck::between_two(points, links.distance).is_some())
}

/// The neck of points in slabs that are so many times as thick as rows of them are apart.
fn neck_of(points: &[Point3<f64>], times: f64) -> Option<Neck> {
    let distance = covering(points, Links::new(points)?.distance);
    Neck::find(points, times * distance)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::Superquadric;
    use crate::shapes::{
        Body, Curled, CurledOptions, Sampling, SynthOptions, synthesize, synthesize_curled,
    };
    use nalgebra::{Matrix3, Rotation3, Vector3};
    use std::f64::consts::{PI, TAU};

    #[test]
    fn a_cloud_of_two_grains_that_touch_has_a_neck_and_one_grain_has_none() {
        let grain = |body: Body| {
            let options = SynthOptions {
                points: 3000,
                ..SynthOptions::clean(body)
            };
            synthesize(&options).unwrap().points
        };
        for body in [Body::Bean, Body::Chickpea, Body::Maize] {
            assert!(!has_neck(&grain(body)), "{body:?}");
        }
        // A bean is 14.05 long and 7.95 wide: the second lies behind the first, or beside it.
        for aside in [Vector3::new(14.0, 0.0, 0.0), Vector3::new(0.0, 8.0, 0.0)] {
            let mut points = grain(Body::Bean);
            points.extend(grain(Body::Bean).iter().map(|point| point + aside));
            assert!(has_neck(&points), "{aside}");
        }
    }

    #[test]
    fn a_plate_whose_points_are_dense_in_the_middle_has_no_neck() {
        for axes in [[10.0, 10.0, 0.5], [1.0, 1.0, 15.0]] {
            let plate = Superquadric::single(axes, 8.0, 2.0).unwrap();
            let options = SynthOptions::clean(plate).with_points(6146);
            assert!(!has_neck(&synthesize(&options).unwrap().points), "{axes:?}");
        }
    }

    #[test]
    fn a_grain_scanned_in_rings_has_no_neck() {
        let rings = (0..12).flat_map(|ring| {
            let (sin, cos) = (PI * (f64::from(ring) + 0.5) / 12.0).sin_cos();
            (0..300).map(move |at| {
                let azimuth = TAU * f64::from(at) / 300.0;
                let n = Vector3::new(cos, sin * azimuth.cos(), sin * azimuth.sin());
                Point3::from(n.component_mul(&Vector3::new(4.0, 3.0, 2.5)))
            })
        });
        assert!(!has_neck(&rings.collect::<Vec<_>>()));
    }

    /// What is bare of two ellipsoids along the axes.
    fn pair(ellipsoids: [(Vector3<f64>, Vector3<f64>); 2]) -> Vec<Point3<f64>> {
        let directions = Sampling::Fibonacci.directions(3000, 0).unwrap();
        let [one, other] = ellipsoids;
        let bare = |(middle, semi_axes): (Vector3<f64>, Vector3<f64>),
                    other: (Vector3<f64>, Vector3<f64>)| {
            let places = directions
                .iter()
                .map(|n| Point3::from(middle + n.component_mul(&semi_axes)));
            let is_outside =
                |place: &Point3<f64>| (place.coords - other.0).component_div(&other.1).norm() > 1.0;
            places.filter(is_outside).collect::<Vec<_>>()
        };
        [bare(one, other), bare(other, one)].concat()
    }

    #[test]
    fn a_broad_neck_shows_in_thin_slabs_and_between_grains_of_two_sizes() {
        let long = Vector3::new(20.0, 10.0, 9.0);
        for (aside, other) in [
            (Vector3::new(0.0, 18.0, 0.0), Vector3::new(18.0, 10.0, 9.0)),
            (Vector3::new(24.5, 0.0, 0.0), Vector3::new(6.0, 5.0, 5.0)),
        ] {
            let points = pair([(Vector3::zeros(), long), (aside, other)]);
            assert!(has_neck(&points) && are_two_grains(&points), "{aside}");
        }
        let one = pair([(Vector3::zeros(), long), (Vector3::zeros(), long * 0.5)]);
        assert!(!has_neck(&one));
    }

    /// Sections told by how far points scatter are too small where a dense half begins.
    #[test]
    fn a_peanut_of_which_one_half_is_denser_has_no_neck() {
        let peanut = |n: &Vector3<f64>| {
            let waist = 1.0 - 0.2 * (-(n.z / 0.35).powi(2)).exp();
            Point3::new(waist * n.x, waist * n.y, 2.0 * n.z)
        };
        let directions = Sampling::Fibonacci.directions(8000, 0).unwrap();
        let points = directions.iter().enumerate();
        let kept = points.filter(|(at, n)| n.z > 0.0 || at % 8 == 0);
        let points: Vec<_> = kept.map(|(_, n)| peanut(n)).collect();
        assert!(!has_neck(&points) && !are_two_grains(&points));
    }

    #[test]
    fn the_arms_of_a_hook_are_no_grains() {
        let hook = CurledOptions::clean(Curled::Hook).with_points(3000);
        let points = synthesize_curled(&hook).unwrap().mesh.vertices;
        assert!(!are_two_grains(&points));
    }

    /// The middles between voxels inside an ellipsoid and outside; voxels are three times as long as wide.
    fn of_long_voxels(
        semi_axes: Vector3<f64>,
        turn: &Rotation3<f64>,
        shift: f64,
    ) -> (Vec<Point3<f64>>, VoxelLattice) {
        let lattice = VoxelLattice {
            first: Point3::new(shift, 0.3 * shift, 0.7 * shift),
            steps: Matrix3::from_diagonal(&Vector3::new(1.0, 1.0, 3.0)),
        };
        let place = |at: Vector3<f64>| lattice.first + lattice.steps * at;
        let holds =
            |at: Vector3<f64>| (turn * place(at).coords).component_div(&semi_axes).norm() < 1.0;
        let line = |most: i32| (-most..most).map(f64::from);
        let all = line(12)
            .flat_map(|x| line(12).flat_map(move |y| line(5).map(move |z| Vector3::new(x, y, z))));
        let middles = all.flat_map(|at| (0..3).map(move |axis| (at, at + Vector3::ith(axis, 1.0))));
        let middles = middles.filter(|&(one, next)| holds(one) != holds(next));
        (
            middles
                .map(|(one, next)| place(0.5 * (one + next)))
                .collect(),
            lattice,
        )
    }

    /// Between two layers of such voxels a thin slab holds few of them.
    #[test]
    fn a_grain_of_long_voxels_has_no_neck() {
        for seed in [2.0, 142.0, 281.0] {
            let turn = Rotation3::from_euler_angles(0.7 * seed, 0.31 * seed, 1.3 * seed);
            let semi_axes = Vector3::new(9.2, 9.8, 6.5);
            let (points, lattice) = of_long_voxels(semi_axes, &turn, 0.37 * seed % 1.0);
            assert!(voxels_have_neck(&points, None), "{seed}");
            assert!(!voxels_have_neck(&points, Some(&lattice)), "{seed}");
        }
    }
}
