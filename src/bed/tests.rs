//! Beds beside closed forms, and beside themselves.

mod packing;

use super::*;
use crate::model::{Frame, MultiSuperquadric, Part, Superquadric};
use approx::assert_relative_eq;
use nalgebra::{Matrix3, Point3, Unit, UnitQuaternion, Vector3};

/// Runs on so many threads.
fn on<T: Send>(threads: usize, work: impl FnOnce() -> T + Send) -> T {
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads);
    pool.build().unwrap().install(work)
}

/// A grain of parts, semi-axes in millimetres.
fn kind(parts: &[([f64; 3], f64, [f64; 3])]) -> GrainKind {
    let parts = parts.iter().map(|(axes, n, centre)| Part {
        shape: Superquadric::single(*axes, *n, *n).unwrap(),
        frame: Frame {
            centre: Point3::from(*centre),
            axes: Matrix3::identity(),
        },
    });
    let body = MultiSuperquadric::new(parts.collect()).unwrap();
    GrainKind::new(&body, 1e-3, 2500.0).unwrap()
}

fn ball() -> GrainKind {
    kind(&[([2.5; 3], 2.0, [0.0; 3])])
}

/// A body at a height above the floor, in metres.
fn above(height: f64) -> Body {
    Body {
        kind: 0,
        position: Point3::new(0.0, 0.0, height),
        velocity: Vector3::zeros(),
        orientation: UnitQuaternion::identity(),
        momentum: Vector3::zeros(),
    }
}

/// A floor on which gravity pulls down at an angle to its normal.
fn slope(degrees: f64) -> Wall {
    let (sin, cos) = degrees.to_radians().sin_cos();
    Wall::Plane {
        point: Point3::origin(),
        normal: Unit::new_unchecked(Vector3::new(-sin, 0.0, cos)),
    }
}

fn bed(settings: BedSettings, kind: GrainKind, walls: Vec<Wall>, bodies: Vec<Body>) -> Bed {
    let bed = Bed::of(settings, vec![kind], walls, bodies);
    bed.unwrap().begun()
}

#[test]
fn a_free_top_keeps_its_energy_and_its_momentum() {
    // Moments 1 : 2 : 3 of an ellipsoid, nearly about the middle axis, 200 steps a turn, 50 turns.
    let kind = kind(&[([2.0_f64.sqrt(), 1.0, 1e-3], 2.0, [0.0; 3])]);
    let kind = GrainKind {
        inertia: Vector3::new(1.0, 2.0, 3.0),
        ..kind
    };
    let mut body = above(0.0);
    body.momentum = Vector3::new(0.1, 2.0, 0.1);
    let (start, momentum) = (body.kinetic_energy(&kind), body.momentum);
    let step = std::f64::consts::TAU / 200.0;
    let errors = (0..10_000).map(|_| {
        body.drift(&kind, step);
        (body.kinetic_energy(&kind) / start - 1.0).abs()
    });
    let largest = errors.fold(0.0, f64::max);
    assert!(largest < 1e-5 && largest > 1e-7, "{largest:e}");
    assert_eq!(body.momentum, momentum);
}

#[test]
fn energy_never_grows_without_friction_and_damping() {
    let settings = BedSettings {
        youngs_modulus_pa: 1e8,
        friction: 0.0,
        damping: [0.0; 2],
        ..BedSettings::default()
    };
    let kind = kind(&[([3.0, 2.5, 2.0], 2.0, [0.0; 3])]);
    let walls = vec![slope(0.0), Wall::Cylinder { radius: 0.012 }];
    let bodies = (0..4).map(|number| {
        let mut body = above(4e-3 + 7e-3 * f64::from(number));
        body.position.x = 4e-3 * (f64::from(number) - 1.5);
        body.orientation = UnitQuaternion::from_euler_angles(f64::from(number), 0.7, 0.2);
        body
    });
    let mut bed = bed(settings, kind, walls, bodies.collect());
    let largest = on(1, || {
        let start = bed.energy();
        let growth = (0..100_000).map(|_| {
            bed.advance();
            bed.energy() / start - 1.0
        });
        growth.fold(f64::NEG_INFINITY, f64::max)
    });
    assert!(largest < 2e-3, "{largest:e}");
}

#[test]
fn a_ball_bounces_as_high_as_the_restitution_says() {
    let settings = BedSettings::default();
    let restitution = settings.law().unwrap().restitution();
    let mut bed = bed(settings, ball(), vec![slope(0.0)], vec![above(0.0525)]);
    bed.step *= 0.1;
    let bounce = on(1, || {
        let mut is_rising = false;
        loop {
            bed.advance();
            let body = &bed.bodies()[0];
            if is_rising && body.velocity.z <= 0.0 {
                break body.position.z - 2.5e-3;
            }
            is_rising = body.velocity.z > 0.0;
        }
    });
    assert_relative_eq!(bounce, restitution.powi(2) * 0.05, max_relative = 1e-2);
}

#[test]
fn a_block_sticks_below_the_angle_of_friction_and_slides_above() {
    let mu: f64 = 0.3;
    let block = || kind(&[([4.0, 4.0, 1.0], 8.0, [0.0; 3])]);
    for degrees in [14.0_f64, 19.0] {
        let wall = slope(degrees);
        let Wall::Plane { normal, .. } = wall else {
            unreachable!()
        };
        let mut body = above(0.0);
        body.orientation = UnitQuaternion::from_euler_angles(0.0, -degrees.to_radians(), 0.0);
        body.position += normal.into_inner() * 1e-3;
        let mut bed = bed(BedSettings::default(), block(), vec![wall], vec![body]);
        // It comes to stand on its face first, then is looked at for a while.
        let speeds = on(1, || {
            [0.3, 0.2].map(|seconds| {
                let end = bed.seconds() + seconds;
                while bed.seconds() < end {
                    bed.advance();
                }
                bed.bodies()[0].velocity
            })
        });
        let gained = (speeds[1] - speeds[0]).norm();
        let angle = degrees.to_radians();
        let pull = 9.81 * (angle.sin() - mu * angle.cos());
        match pull > 0.0 {
            true => assert_relative_eq!(gained, 0.2 * pull, max_relative = 2e-2),
            false => assert!(speeds[1].norm() < 1e-3, "{speeds:?}"),
        }
    }
}

#[test]
fn a_rolling_ball_comes_to_rest_where_it_should() {
    let (mu_r, radius, pace) = (0.05, 2.5e-3, 0.05);
    let settings = BedSettings {
        rolling_friction: mu_r,
        friction: 0.5,
        ..BedSettings::default()
    };
    let rolling = ball();
    let mut body = above(radius - 3e-6);
    body.velocity.x = pace;
    body.momentum.y = rolling.inertia[1] * pace / radius;
    let mut bed = bed(settings, rolling, vec![slope(0.0)], vec![body]);
    on(1, || {
        for _ in 0..4000 {
            bed.advance();
        }
    });
    let body = &bed.bodies()[0];
    // The moment mu_r R m g turns m R² + I about the contact: the ball slows down by 5/7 mu_r g.
    let way = pace * pace / (2.0 * 5.0 / 7.0 * mu_r * 9.81);
    assert_relative_eq!(body.position.x, way, max_relative = 2e-2);
    assert!(body.velocity.norm() < 1e-4);
}

pub(super) fn few(settings: BedSettings) -> (BedSettings, Vec<GrainKind>) {
    let dimer = kind(&[
        ([2.0; 3], 2.0, [1.2, 0.0, 0.0]),
        ([1.8; 3], 3.0, [-1.2, 0.0, 0.0]),
    ]);
    let settings = BedSettings {
        grains: 20,
        container: Container::Box([0.02; 2]),
        ..settings
    };
    (
        settings,
        vec![kind(&[([3.0, 2.5, 2.0], 2.0, [0.0; 3])]), dimer],
    )
}

pub(super) fn few_at(steps: usize, threads: usize) -> Bed {
    let (settings, kinds) = few(BedSettings::default());
    let mut bed = Bed::new(settings, kinds, &[0.5, 0.5], None).unwrap();
    on(threads, || {
        for _ in 0..steps {
            bed.advance();
        }
    });
    bed
}

#[test]
fn a_part_that_is_there_twice_touches_once() {
    let single = kind(&[([3.0, 2.5, 2.0], 2.0, [0.0; 3])]);
    let twice = GrainKind {
        parts: [single.parts.clone(), single.parts.clone()].concat(),
        ..single.clone()
    };
    let beds = [single, twice].map(|kind| {
        let (settings, _) = few(BedSettings::default());
        let mut bed = Bed::new(settings, vec![kind], &[1.0], None).unwrap();
        on(1, || {
            for _ in 0..2000 {
                bed.advance();
            }
        });
        bed
    });
    let [figures, other] = [0, 1].map(|at| fabric(&beds[at]));
    assert!(figures.neighbours > 1.0);
    assert_eq!(figures.contacts, other.contacts);
    for (body, other) in beds[0].bodies().iter().zip(beds[1].bodies()) {
        assert_relative_eq!(body.position, other.position, epsilon = 1e-6);
    }
}

#[test]
fn the_bytes_are_the_same_for_any_number_of_threads() {
    let beds = [1, 2, 4].map(|threads| few_at(3000, threads).state);
    let links = beds[0]
        .encounters
        .iter()
        .flat_map(|encounter| &encounter.links);
    assert!(links.into_iter().any(|link| link.touch.is_some()));
    assert!(beds[0] == beds[1] && beds[0] == beds[2]);
}

#[test]
fn a_bed_goes_on_from_its_file_as_if_it_had_not_been_stopped() {
    let (settings, kinds) = few(BedSettings {
        most_seconds: 0.1,
        ..BedSettings::default()
    });
    let new = |settings: &BedSettings| {
        Bed::new(settings.clone(), kinds.clone(), &[1.0, 1.0], None).unwrap()
    };
    let settled = |path: &std::path::Path| {
        let folder = Folder { path, unit: 1e-3 };
        let mut bed = folder.open(new(&settings)).unwrap();
        let rest = folder.settle(&mut bed, |_| {}).unwrap();
        assert_eq!(rest, Rest::TimeIsUp);
        bed
    };
    let [whole, halves] = [(); 2].map(|()| tempfile::tempdir().unwrap());
    let expected = settled(whole.path());
    // What kill -9 leaves: the state of some step, and files of later ones.
    let folder = Folder {
        path: halves.path(),
        unit: 1e-3,
    };
    let mut bed = folder.open(new(&settings)).unwrap();
    on(2, || {
        for _ in 0..1250 {
            bed.advance();
        }
    });
    folder.keep(&bed).unwrap();
    assert!(settled(halves.path()).state == expected.state);
    for name in ["state.json", "bed.vtk", "frames/bed.00002.dump"] {
        let [one, other] = [&whole, &halves].map(|folder| std::fs::read(folder.path().join(name)));
        assert!(one.unwrap() == other.unwrap(), "{name}");
    }
    // With more time it goes on to the same end as in one go.
    let new_end = |seconds| {
        let settings = BedSettings {
            most_seconds: seconds,
            ..settings.clone()
        };
        let path = halves.path();
        let folder = Folder { path, unit: 1e-3 };
        let mut bed = folder.open(new(&settings)).unwrap();
        folder.settle(&mut bed, |_| {}).unwrap();
        bed
    };
    let longer = new_end(0.12);
    assert!((0.12..0.12 + longer.step).contains(&longer.seconds()));
    assert!(new_end(0.1).seconds() == longer.seconds());
    let at_once = tempfile::tempdir().unwrap();
    let mut bed = new(&BedSettings {
        most_seconds: 0.12,
        ..settings.clone()
    });
    let folder_at_once = Folder {
        path: at_once.path(),
        unit: 1e-3,
    };
    folder_at_once.settle(&mut bed, |_| {}).unwrap();
    assert!(longer.state == bed.state);
    let other = BedSettings {
        seed: 1,
        ..settings.clone()
    };
    let refused = folder.open(new(&other));
    assert!(matches!(refused, Err(FolderError::Other { .. })));
}

#[test]
fn a_settled_bed_carries_its_weight_and_its_figures_hold() {
    let bed = few_at(9000, 2);
    let weights = bed
        .bodies()
        .iter()
        .map(|body| bed.kinds()[body.kind].mass * 9.81);
    let weight: f64 = weights.sum();
    let on_walls = bed.state.encounters.iter();
    let on_walls = on_walls.filter(|encounter| encounter.other.is_none());
    let links = on_walls.flat_map(|encounter| &encounter.links);
    let floor = links.filter(|link| link.key.other == 0);
    let carried: f64 = floor.filter_map(|link| Some(link.touch?.force.z)).sum();
    assert!(carried > 0.5 * weight && carried < 1.01 * weight);
    let found = fabric(&bed);
    assert!(found.loose == 0 && found.largest_overlap < 0.05);
    assert!(found.neighbours > 2.0 && found.contacts >= found.neighbours);
    let order = found.order.unwrap();
    assert_relative_eq!(order.eigenvalues.iter().sum::<f64>(), 0.0, epsilon = 1e-12);
    assert!(order.eigenvalues[0] < 1.0 && order.grains == 20);
}

#[test]
fn shares_and_moved_grains_that_are_not_those_of_the_bed_are_refused() {
    let bed = few_at(0, 1);
    let found = Bed::new(bed.settings().clone(), vec![ball()], &[1.0, 1.0], None);
    let expected = BedError::Shares {
        kinds: 1,
        shares: 2,
    };
    assert_eq!(found.unwrap_err(), expected);
    let mut bodies = bed.bodies().to_vec();
    bodies[0].position.z += 1.0;
    let moved = bed.clone().moved(bodies.clone()).unwrap();
    assert_eq!(moved.bodies(), bodies);
    bodies[0].kind = 99;
    let refused = bed.clone().moved(bodies.clone()).unwrap_err();
    assert_eq!(refused, BedError::OtherGrains);
    bodies.remove(0);
    assert_eq!(bed.moved(bodies).unwrap_err(), BedError::OtherGrains);
}
