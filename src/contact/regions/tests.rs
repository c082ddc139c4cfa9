mod volume_law;

use super::*;
use crate::contact::VolumeLaw;
use crate::measure::feet;
use crate::model::{
    Derivatives, Family, Frame, Grain, LocalErrors, Radial, StarGrain, StarSurface, Whole,
};
use crate::shapes::{Ellipsoid, Solid};
use approx::assert_relative_eq;
use nalgebra::{Matrix3, UnitQuaternion};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use std::f64::consts::PI;

fn ball(radius: f64) -> Ellipsoid {
    Ellipsoid {
        semi_axes: Vector3::repeat(radius),
    }
}

/// Volume shared by balls of radii `r` and `s` whose centres are `d` apart.
fn lens(r: f64, s: f64, d: f64) -> f64 {
    let u = r + s - d;
    PI * u * u * (d * d + 2.0 * d * (r + s) - 3.0 * (r - s).powi(2)) / (12.0 * d)
}

#[test]
fn balls_share_a_lens() {
    let (one, two) = (ball(1.0), ball(0.5));
    let (one, two) = (Radial(&one), Radial(&two));
    let (one, two) = (ContactBody::new(&one), ContactBody::new(&two));
    let towards = Vector3::new(0.3, -0.5, 0.8).normalize();
    // The last has the centre of the small ball in the large one, and is no lens.
    for (depth, epsilon) in [(1e-5, 1e-6), (1e-2, 1e-6), (0.7, 1e-3)] {
        let distance = 1.5 - depth;
        let pose = Isometry3::new(towards * distance, Vector3::new(0.4, 0.2, 0.1));
        let found = contact_regions(&one, &two, &pose).unwrap();
        let [region] = &found.regions[..] else {
            panic!("{found:?}")
        };
        let volume = lens(1.0, 0.5, distance);
        assert!(
            (region.volume - volume).abs() <= region.volume_error,
            "{depth}"
        );
        assert!(region.volume_error < 1e-4 * volume, "{depth}");
        assert_relative_eq!(region.volume, volume, max_relative = epsilon);
        assert_relative_eq!(region.depth, depth, max_relative = 1e-9);
        assert_relative_eq!(region.normal, towards, epsilon = epsilon);
        // Its rim's radius squared, times pi: the vector area of a cap is that of its rim.
        let to_rim = (distance * distance + 1.0 - 0.25) / (2.0 * distance);
        assert_relative_eq!(
            region.area.norm(),
            PI * (1.0 - to_rim * to_rim),
            max_relative = epsilon
        );
        assert!(found.work.skipped > found.work.triangles / 2);
    }
    for distance in [1.5 + 1e-6, 4.0] {
        let pose = Isometry3::new(towards * distance, Vector3::zeros());
        let found = contact_regions(&one, &two, &pose).unwrap();
        assert_eq!(found.regions, []);
    }
    // In the middle, and near the surface from within.
    for distance in [0.2, 0.4, 0.49] {
        let within = Isometry3::new(towards * distance, Vector3::zeros());
        let found = contact_regions(&one, &two, &within);
        assert_eq!(found, Err(RegionError::Inside), "{distance}");
        let found = contact_regions(&two, &one, &within.inverse());
        assert_eq!(found, Err(RegionError::Inside), "{distance}");
    }
}

/// r = 1 - 0.4 z³: its rim is 0.641 high, and its middle 0.6.
struct Dented;

impl StarSurface for Dented {
    fn radius(&self, n: &Vector3<f64>) -> f64 {
        1.0 - 0.4 * n.z.powi(3)
    }

    fn radius_and_gradient(&self, n: &Vector3<f64>) -> (f64, Vector3<f64>) {
        let across = Vector3::z() - n * n.z;
        (self.radius(n), across * (-1.2 * n.z * n.z))
    }

    fn derivatives(&self, n: &Vector3<f64>) -> Derivatives {
        let (radius, gradient) = self.radius_and_gradient(n);
        let across = Vector3::z() - n * n.z;
        let tangential = Matrix3::identity() - n * n.transpose();
        Derivatives {
            radius,
            gradient,
            hessian: tangential * (1.2 * n.z.powi(3)) - across * across.transpose() * (2.4 * n.z),
        }
    }
}

const ROD: Ellipsoid = Ellipsoid {
    semi_axes: Vector3::new(3.0, 0.3, 0.3),
};

/// Of a gap that was curved four times as much the radius is a quarter, and the force half.
#[test]
fn a_lens_tells_how_far_the_force_of_its_middle_is_off() {
    let ball = ball(1.0);
    let ball = Radial(&ball);
    let body = ContactBody::new(&ball);
    let pose = Isometry3::translation(0.0, 0.0, 1.999);
    let found = contact_regions(&body, &body, &pose).unwrap();
    for (bent, expected) in [(1.0, 1.0), (4.0, 2.0)] {
        let relative = RelativeCurvature::new([bent; 2], [bent; 2], 0.0).unwrap();
        assert_relative_eq!(
            found.regions[0].times(&relative),
            expected,
            max_relative = 1e-3
        );
    }
}

#[test]
fn a_dented_body_is_touched_on_both_sides_of_its_dent() {
    let (dented, rod) = (Radial(&Dented), Radial(&ROD));
    let pose = Isometry3::translation(0.0, 0.0, 0.92);
    let found =
        contact_regions(&ContactBody::new(&dented), &ContactBody::new(&rod), &pose).unwrap();
    let [one, two] = &found.regions[..] else {
        panic!("{:?}", found.regions)
    };
    assert_relative_eq!(one.volume, two.volume, max_relative = 1e-3);
    assert_relative_eq!(one.point.x, -two.point.x, epsilon = 1e-3);
    assert!(one.normal.z > 0.5 && two.normal.z > 0.5);
}

#[test]
fn a_pair_is_followed_to_what_a_search_finds() {
    let (dented, rod) = (Radial(&Dented), Radial(&ROD));
    let (dented, rod) = (ContactBody::new(&dented), ContactBody::new(&rod));
    let mut pair = ContactPair::new(&dented, &rod);
    let mut seen = [0; 3];
    for step in 0..60 {
        // The rod rocks on the rim, and lifts off.
        let time = f64::from(step) / 60.0;
        let rock = 0.03 * (2.0 * PI * time).sin();
        let aside = Vector3::new(0.02 * time, 0.0, 0.925 + 0.03 * time);
        let pose = Isometry3::new(aside, Vector3::new(0.0, rock, 0.3 * time));
        pair.update(&pose).unwrap();
        let mut places = pair.places().to_vec();
        places.sort_by(|p, q| q.depth.total_cmp(&p.depth));
        let mut regions = contact_regions(&dented, &rod, &pose).unwrap().regions;
        regions.sort_by(|p, q| q.depth.total_cmp(&p.depth));
        assert_eq!(places.len(), regions.len(), "{step}");
        seen[places.len()] += 1;
        for (place, region) in places.iter().zip(&regions) {
            assert_relative_eq!(place.depth, region.depth, epsilon = 1e-12);
            assert!(place.normal.dot(&region.normal) > 0.99);
            let told = pair.region(place).unwrap();
            assert_relative_eq!(told.volume, region.volume, max_relative = 2e-4);
            let curved = place.curvatures().unwrap()[1].principal[0];
            assert_relative_eq!(
                curved,
                region.curvatures.unwrap()[1].principal[0],
                max_relative = 1e-6
            );
        }
    }
    assert!(seen.iter().all(|&times| times > 3), "{seen:?}");
    assert!(pair.searches() < 40, "{}", pair.searches());
}

#[test]
fn bodies_that_were_far_apart_are_found_where_they_touch() {
    let ball = ball(1.0);
    let ball = Radial(&ball);
    let body = ContactBody::new(&ball);
    let touching = Isometry3::translation(0.6, 0.7, 1.6);
    for far in [1e3, 3e15, 1e17, 1e170, f64::MAX] {
        for towards in [Vector3::z(), Vector3::new(0.3, -0.7, 0.2)] {
            let mut pair = ContactPair::new(&body, &body);
            let away = Isometry3::from_parts((towards * far).into(), UnitQuaternion::identity());
            pair.update(&away).unwrap();
            assert!(pair.places().is_empty());
            pair.update(&touching).unwrap();
            assert_eq!(pair.places().len(), 1, "{far}");
        }
    }
}

#[test]
fn a_pose_or_a_surface_that_is_not_finite_is_refused_and_the_next_pose_is_not() {
    let ball = ball(1.0);
    let ball = Radial(&ball);
    let body = ContactBody::new(&ball);
    let mut pair = ContactPair::new(&body, &body);
    let touching = Isometry3::translation(0.0, 0.0, 1.9);
    pair.update(&touching).unwrap();
    for bad in [f64::NAN, f64::INFINITY] {
        let mut turned = touching;
        turned.rotation.as_mut_unchecked().coords.x = bad;
        for pose in [Isometry3::translation(bad, 0.0, 1.9), turned] {
            let refused = contact_regions(&body, &body, &pose);
            assert_eq!(refused, Err(RegionError::NotFinite));
            assert_eq!(pair.update(&pose), Err(RegionError::NotFinite));
            assert!(pair.places().is_empty());
        }
    }
    pair.update(&touching).unwrap();
    assert_eq!((pair.places().len(), pair.searches()), (1, 1));
    let nowhere = Ellipsoid {
        semi_axes: Vector3::new(1.0, f64::NAN, 1.0),
    };
    let nowhere = Radial(&nowhere);
    let nowhere = ContactBody::new(&nowhere);
    let refused = contact_regions(&nowhere, &body, &touching);
    assert_eq!(refused, Err(RegionError::NotFinite));
}

#[test]
fn a_margin_that_is_no_number_is_refused() {
    let ball = ball(1.0);
    let ball = Radial(&ball);
    let body = ContactBody::new(&ball);
    let apart = Isometry3::translation(0.0, 0.0, 2.1);
    let gaps = |margin: f64| contact_gaps(&body, &body, &apart, margin);
    assert_eq!(gaps(0.2).unwrap().len(), 1);
    assert_eq!(gaps(f64::NAN).err(), Some(RegionError::NotFinite));
}

#[test]
fn pairs_are_followed_by_as_many_threads_as_there_are() {
    fn is_shared<T: Send + Sync + Clone + std::fmt::Debug>() {}
    is_shared::<ContactBody<'_>>();
    is_shared::<ContactPair<'_>>();
    is_shared::<ContactPlace>();
}

/// A ball whose surface is known to a share of its radius, and its curvature to another.
fn known_ball(radius: f64, share: f64, bent: f64) -> Grain {
    let family = Whole::new(vec![radius * (4.0 * PI).sqrt()]).unwrap();
    let error = LocalError {
        place: share * radius,
        curvature: bent / radius,
    };
    let grain = StarGrain::new(Frame::SCAN, Family::Whole(family)).unwrap();
    Grain::from(grain).with_local_errors(LocalErrors::new(vec![error; 864]))
}

#[test]
fn a_pair_that_moves_has_the_errors_of_its_regions() {
    let (one, two) = (known_ball(1.0, 1e-3, 1e-3), known_ball(0.5, 4e-3, 4e-3));
    let bodies = [ContactBody::new(&one), ContactBody::new(&two)];
    let pose = Isometry3::new(Vector3::z() * 1.45, Vector3::x());
    let mut pair = ContactPair::new(&bodies[0], &bodies[1]);
    pair.update(&pose).unwrap();
    let [place] = pair.places() else {
        panic!("{pair:?}")
    };
    let depth_error = place.depth_error().unwrap();
    assert_relative_eq!(depth_error, 1e-3_f64.hypot(2e-3), max_relative = 1e-12);
    let found = contact_regions(&bodies[0], &bodies[1], &pose).unwrap();
    let [region] = &found.regions[..] else {
        panic!("{found:?}")
    };
    assert_eq!(region.depth_error(), Some(depth_error));
    assert_eq!(region.errors.as_ref(), place.errors());
    // Lenses share V = pi R u², and a ball's radius is off by its share over the root of two.
    let of_depth = ((1.0 + 2.0 * depth_error / region.depth).powi(2) - 1.0) / 2.0;
    let of_radius = 1e-3_f64.hypot(2.0 * 4e-3) / 3.0 / 2.0_f64.sqrt();
    let error = region.volume_standard_error().unwrap() / region.volume;
    assert_relative_eq!(error, of_depth.hypot(of_radius), max_relative = 0.02);
    let of_force = (1.5 * depth_error / region.depth).hypot(1.25 * of_radius);
    let share = VolumeLaw::force_share(region).unwrap();
    assert_relative_eq!(share, of_force, max_relative = 0.02);

    // A curvature of which little is known, or that may be none: the rim of the lens is as uncertain as two places are.
    for bent in [0.3, 3.0] {
        let bent = known_ball(0.5, 4e-3, bent);
        let found = contact_regions(&bodies[0], &ContactBody::new(&bent), &pose).unwrap();
        let region = &found.regions[0];
        let error = region.volume_standard_error().unwrap() / region.volume;
        let of_place = depth_error / region.depth;
        let of_rim = 2.0_f64.sqrt() * of_place;
        assert_relative_eq!(error, of_rim.hypot(of_depth), max_relative = 0.02);
        let share = VolumeLaw::force_share(region).unwrap();
        assert_relative_eq!(
            share,
            1.5_f64.hypot(1.25 * 2.0_f64.sqrt()) * of_place,
            max_relative = 1e-9
        );
    }

    // One that tells none leaves it open.
    let exact = ball(0.5);
    let exact = Radial(&exact);
    let found = contact_regions(&bodies[0], &ContactBody::new(&exact), &pose).unwrap();
    assert_eq!(found.regions[0].depth_error(), None);
    assert_eq!(VolumeLaw::force_share(&found.regions[0]), None);
}

#[test]
fn gaps_within_a_margin_are_found() {
    let (one, two) = (ball(1.0), ball(0.5));
    let (one, two) = (Radial(&one), Radial(&two));
    let (one, two) = (ContactBody::new(&one), ContactBody::new(&two));
    let pose = Isometry3::translation(0.0, 1.503, 0.0);
    let gaps = |margin: f64| contact_gaps(&one, &two, &pose, margin).unwrap();
    assert!(gaps(0.002).is_empty());
    let [gap] = &gaps(0.004)[..] else {
        panic!("one gap")
    };
    assert_relative_eq!(gap.depth, -0.003, max_relative = 1e-9);
    assert_relative_eq!(gap.point.y, 1.0015, max_relative = 1e-9);
}

/// A ball with bumps of a tenth of its radius.
fn bumpy() -> Grain {
    let mut random = ChaCha8Rng::seed_from_u64(4);
    let coefficients = (0..121).map(|at| match at {
        0 => (4.0 * PI).sqrt(),
        1..25 => 0.0,
        _ => random.random_range(-0.04..0.04),
    });
    let family = Whole::new(coefficients.collect()).unwrap();
    StarGrain::new(Frame::SCAN, Family::Whole(family))
        .unwrap()
        .into()
}

#[test]
fn of_many_pairs_of_points_the_deepest_is_told_whichever_body_is_the_first() {
    let grain = bumpy();
    let body = ContactBody::new(&grain);
    let vertices = grain.mesh(48).vertices;
    let mut told = 0;
    for seed in 0..10 {
        let turn = Vector3::new(0.7, 0.3, 0.5) * f64::from(seed);
        let towards = UnitQuaternion::new(turn) * Vector3::x();
        let pose = Isometry3::new(towards * 1.8, turn);
        let alone = |pose: &Isometry3<f64>| {
            let mut regions = contact_regions(&body, &body, pose).unwrap().regions;
            (regions.len() == 1).then(|| regions.remove(0))
        };
        let Some((one, two)) = alone(&pose).zip(alone(&pose.inverse())) else {
            continue;
        };
        assert_relative_eq!(one.depth, two.depth, max_relative = 1e-6);
        // What of each lies in the other, in the frame of the first.
        let within = |pose: &Isometry3<f64>| -> Vec<Point3<f64>> {
            let points: Vec<Point3<f64>> = vertices.iter().map(|vertex| pose * vertex).collect();
            let all = points.iter().zip(feet(&grain, &points));
            let inside = all.filter(|(_, foot)| foot.distance < 0.0);
            inside.map(|(point, _)| *point).collect()
        };
        let others = within(&pose);
        let own = within(&pose.inverse()).into_iter();
        let own: Vec<Point3<f64>> = own.map(|point| pose * point).collect();
        let nearest = |point: &Point3<f64>, to: &[Point3<f64>]| {
            let distances = to.iter().map(|other| (other - point).norm());
            distances.fold(f64::INFINITY, f64::min)
        };
        let farthest = own
            .iter()
            .map(|point| nearest(point, &others))
            .fold(0.0, f64::max);
        assert!(
            (-0.02..0.07).contains(&(one.depth / farthest - 1.0)),
            "{seed}: {} {farthest}",
            one.depth
        );
        told += usize::from(one.curvatures.is_some());
    }
    assert!(told >= 5, "{told}");
}

/// Where balls lie deep in each other a point of one is nearer to the side of the other than to the end that it faces.
#[test]
fn balls_deep_in_each_other_are_as_deep_as_their_ends_are_apart() {
    let ball = ball(1.0);
    let ball = Radial(&ball);
    let body = ContactBody::new(&ball);
    let oblique = Vector3::new(0.3, -0.5, 0.8).normalize();
    let all = [1.0, 0.7, 0.5, 0.2]
        .map(|distance| [Vector3::z(), Vector3::x(), oblique].map(|along| (distance, along)));
    for &(distance, along) in all.as_flattened() {
        let pose = Isometry3::from_parts((along * distance).into(), UnitQuaternion::identity());
        let found = contact_regions(&body, &body, &pose).unwrap();
        let [region] = &found.regions[..] else {
            panic!("{found:?}")
        };
        assert_relative_eq!(region.depth, 2.0 - distance, max_relative = 1e-9);
        let [first, second] = region.deepest.unwrap();
        assert_relative_eq!(first.coords, along, epsilon = 1e-9);
        assert_relative_eq!(second.coords, along * (distance - 1.0), epsilon = 1e-9);
    }
}
