//! Faults of real scans: outliers, holes, uneven density.

use grainform::measure::grain_properties;
use grainform::scan::{Scan, parse_scan};
use grainform::shapes::{Body, Sampling, SynthOptions, synthesize};
use grainform::{FitError, FitOptions, Fitted, StarSurface, Surface, fit};
use nalgebra::{Point3, Rotation3, Vector3};
use std::f64::consts::PI;

const GRAINS: [Body; 3] = [Body::Bean, Body::Chickpea, Body::Maize];

fn fitted(points: Vec<Point3<f64>>) -> Fitted {
    let scan = Scan::from_points(points);
    fit(&scan, &FitOptions::default()).expect("a grain")
}

fn cloud(body: Body, noise: f64, outliers: f64) -> Vec<Point3<f64>> {
    let options = SynthOptions::clean(body)
        .with_noise(noise)
        .with_outliers(outliers);
    synthesize(&options).expect("valid options").points
}

#[test]
fn one_percent_of_outliers_changes_the_volume_by_less_than_a_tenth_of_a_percent() {
    for body in GRAINS {
        for noise in [0.0, 0.005] {
            let volume = |outliers: f64| {
                let grain = fitted(cloud(body, noise, outliers)).grain;
                grain_properties(&grain).properties.volume
            };
            let change = volume(0.01) / volume(0.0) - 1.0;
            println!(
                "outliers: {body}, noise {noise}: V {:+.4} %",
                100.0 * change
            );
            assert!(change.abs() < 0.001, "{body} {noise}: {change}");
        }
    }
}

/// A scan that was written down twice, once rounded, or four times, is no finer than it was: its noise is not taken for texture.
#[test]
fn points_that_are_there_more_than_once_count_once() {
    for body in GRAINS {
        let once = cloud(body, 0.005, 0.0);
        let figures = |points: Vec<Point3<f64>>| {
            let fitted = fitted(points);
            let told = grain_properties(&fitted.grain).properties;
            let noise = fitted.estimate.expect("an estimate").noise;
            (told.area, told.volume, noise)
        };
        let (area, volume, noise) = figures(once.clone());
        for (copies, apart) in [(2, 1e-6), (4, 2e-4)] {
            let moved = |copy: usize| {
                let by = Vector3::new(1.0, -2.0, 1.0) * (apart * copy as f64);
                once.iter().map(move |point| point + by)
            };
            let found = figures((0..copies).flat_map(moved).collect());
            let changes = [found.0 / area, found.1 / volume, found.2 / noise];
            assert!(
                changes.iter().all(|change| (change - 1.0).abs() < 0.01),
                "{body} {copies}: {changes:?}"
            );
        }
    }
}

#[test]
fn outliers_of_few_points_are_not_followed() {
    let truth = Body::Bean.surface().integrals().properties;
    for seed in 1..=6 {
        let options = SynthOptions::clean(Body::Bean)
            .with_outliers(0.01)
            .with_seed(seed);
        let points = synthesize(&options).expect("valid options").points;
        let area = grain_properties(&fitted(points).grain).properties.area;
        let error = area / truth.area - 1.0;
        assert!(error.abs() < 1e-4, "seed {seed}: {error}");
    }
}

/// An ellipsoid that a small ball touches: from its centre the ball stands behind the place where they touch.
#[test]
fn points_of_two_bodies_that_touch_are_refused() {
    let directions = |count| {
        Sampling::Fibonacci
            .directions(count, 0)
            .expect("directions")
    };
    let large = directions(3000).into_iter();
    let large = large.map(|n| Point3::new(2.0 * n.x, 1.2 * n.y, n.z));
    let small = directions(1200).into_iter();
    let small = small.map(|n| Point3::new(2.45, 0.0, 0.0) + 0.5 * n);
    let scan = Scan::from_points(large.chain(small).collect());
    match fit(&scan, &FitOptions::default()) {
        Err(FitError::NoKind { radius, .. }) => {
            assert!(matches!(*radius, FitError::SecondSurface { share } if share > 0.1));
        }
        other => panic!("{:?}", other.map(|_| ())),
    }
}

/// Half-opening angle of the holes.
const HOLE: f64 = 20.0;

/// What a fit makes of a hole, in mean radii.
struct Bridge {
    /// Largest distance from the truth within the hole.
    miss: f64,
    /// How far the radius within the hole leaves the range of those on its rim and of the truth.
    overshoot: f64,
}

/// Fits a body of which a scan did not see a cap round the direction `towards`.
fn bridge(body: Body, towards: &Vector3<f64>, noise: f64) -> Bridge {
    let surface = body.surface();
    let angle = |p: &Vector3<f64>| p.angle(towards).to_degrees();
    let kept = cloud(body, noise, 0.0)
        .into_iter()
        .filter(|p| angle(&p.coords) > HOLE);
    let fitted = fitted(kept.collect());
    let centre = fitted.grain.frame().centre.coords;
    let directions = Sampling::Fibonacci.directions(20_000, 0).expect("enough");
    let radii = |from: f64, to: f64| {
        let within = directions
            .iter()
            .filter(move |n| (from..to).contains(&angle(n)));
        let pair = |n: &Vector3<f64>| {
            let point = n * surface.radius(n) - centre;
            (
                point.norm(),
                fitted.grain.star().unwrap().radius(&point.normalize()),
            )
        };
        within.map(pair).collect::<Vec<(f64, f64)>>()
    };
    let (hole, rim) = (radii(0.0, HOLE), radii(HOLE, HOLE + 5.0));
    let (mut least, mut most) = (f64::INFINITY, 0.0_f64);
    for (truth, _) in rim.iter().chain(&hole) {
        least = least.min(*truth);
        most = most.max(*truth);
    }
    let mut bridge = Bridge {
        miss: 0.0,
        overshoot: 0.0,
    };
    for (truth, found) in hole {
        let beyond = (found - most).max(least - found) / fitted.mean_radius;
        bridge.miss = bridge.miss.max((found - truth).abs() / fitted.mean_radius);
        bridge.overshoot = bridge.overshoot.max(beyond);
    }
    bridge
}

/// Bridges the holes in all grains; tells of those that are off, or leave the range of radii, by
/// more than 3 % of the mean radius.
fn failures(directions: &[Vector3<f64>], noises: &[f64]) -> Vec<String> {
    let mut failures = Vec::new();
    for body in GRAINS {
        for &noise in noises {
            for towards in directions {
                let Bridge { miss, overshoot } = bridge(body, &towards.normalize(), noise);
                let what = format!(
                    "hole: {body}, noise {noise}, towards ({} {} {}): {:.2} % off, {:.2} % beyond",
                    towards.x,
                    towards.y,
                    towards.z,
                    100.0 * miss,
                    100.0 * overshoot
                );
                println!("{what}");
                if miss > 0.03 || overshoot > 0.03 {
                    failures.push(what);
                }
            }
        }
    }
    failures
}

#[test]
fn holes_at_the_poles_of_clean_scans_are_bridged_without_overshoot() {
    let failures = failures(&[-Vector3::z(), Vector3::z()], &[0.0]);
    assert!(failures.is_empty(), "{failures:#?}");
}

#[test]
#[ignore = "not met yet: holes over a beak or a tip hide it, and one in the maize overshoots"]
fn holes_are_bridged_without_overshoot() {
    let mut directions = [Vector3::x(), Vector3::y(), Vector3::z()]
        .map(|axis| [axis, -axis])
        .concat();
    directions.push(Vector3::new(1.0, 1.0, 1.0));
    directions.push(Vector3::new(-1.0, 0.3, 0.6));
    directions.push(Vector3::new(0.2, -1.0, 0.9));
    let failures = failures(&directions, &[0.0, 0.005]);
    assert!(failures.is_empty(), "{failures:#?}");
}

#[test]
fn a_half_twenty_times_denser_does_not_bias_area_or_volume() {
    for body in GRAINS {
        let surface = body.surface();
        let truth = surface.integrals().properties;
        let sparse = body.native_points();
        for towards in [Vector3::z(), -Vector3::x(), Vector3::new(0.5, 0.7, -0.4)] {
            let half = |count: usize, side: f64| {
                let directions = Sampling::Fibonacci.directions(count, 0).expect("enough");
                directions
                    .into_iter()
                    .filter(|n| n.dot(&towards) * side > 0.0)
                    .map(|n| Point3::from(n * surface.radius(&n)))
                    .collect::<Vec<_>>()
            };
            let points = [half(sparse, 1.0), half(20 * sparse, -1.0)].concat();
            let found = grain_properties(&fitted(points).grain).properties;
            let area = found.area / truth.area - 1.0;
            let volume = found.volume / truth.volume - 1.0;
            println!(
                "density: {body}, towards ({} {} {}): S {:+.4} %, V {:+.4} %",
                towards.x,
                towards.y,
                towards.z,
                100.0 * area,
                100.0 * volume
            );
            assert!(area.abs() < 0.002, "{body}: area {area}");
            assert!(volume.abs() < 0.0005, "{body}: volume {volume}");
        }
    }
}

/// Points at random over an ellipsoid that is twenty times as long as wide, with noise across its surface. Rays graze its sides: along
/// them the noise is ten times as large.
#[test]
fn noisy_rods_are_fitted() {
    for count in [8000, 30_000] {
        let random = |seed| Sampling::Random.directions(count, seed).unwrap();
        let (places, others) = (random(1), random(2));
        let points = places.iter().zip(&others).filter_map(|(n, other)| {
            let across = n.xy().norm();
            let normal = Vector3::new(n.x, n.y, n.z / 20.0).normalize();
            // Of a random direction each coordinate is even between -1 and 1: a deviation of 0.015 here.
            let noise = 0.015 * 3.0_f64.sqrt() * other.z;
            let place = Point3::new(n.x, n.y, 20.0 * n.z) + normal * noise;
            (0.5 * (other.x + 1.0) < across).then_some(place)
        });
        let mut points: Vec<_> = points.collect();
        let scan = Scan::from_points(points.clone());
        let fitted = fit(&scan, &FitOptions::default()).expect("a rod");
        let survey = fitted.survey();
        let errors = fitted.standard_errors(&survey).expect("errors");
        let exact = 80.0 * std::f64::consts::PI / 3.0;
        let off = survey.volume().unwrap() - exact;
        assert!(
            off.abs() < 3.0 * errors.volume && errors.volume < 3e-3 * exact,
            "{count}: {off} of {errors:?}"
        );
        // With a stalk at its side it is none.
        let stalk = places[..count / 20].iter().enumerate().map(|(i, n)| {
            let height = 1.0 + 4.0 * i as f64 / (count / 20) as f64;
            let across = n.yz().normalize() * 0.4;
            Point3::new(height, across.x, 5.0 + across.y)
        });
        points.extend(stalk);
        let with_stalk = fit(&Scan::from_points(points), &FitOptions::default());
        assert!(with_stalk.is_err(), "{count}");
    }
}

/// The centres of the outermost voxels, a twentieth wide, of a turned ellipsoid.
fn voxels(semi_axes: &Vector3<f64>) -> Vec<Point3<f64>> {
    let turn = Rotation3::from_euler_angles(0.4, 0.7, 1.3);
    let is_inside = |at: [i32; 3]| {
        let place = turn * (Vector3::from(at.map(f64::from)).add_scalar(0.3) * 0.05);
        place.component_div(semi_axes).norm() < 1.0
    };
    let line = || -40..=40;
    let all = line().flat_map(|x| line().flat_map(move |y| line().map(move |z| [x, y, z])));
    let is_outermost = |at: &[i32; 3]| {
        let beside = |axis: usize, side: i32| {
            let mut beside = *at;
            beside[axis] += side;
            beside
        };
        let mut sides = (0..3).flat_map(|axis| [beside(axis, -1), beside(axis, 1)]);
        is_inside(*at) && sides.any(|side| !is_inside(side))
    };
    let outermost = all.filter(is_outermost);
    outermost
        .map(|at| Point3::from(Vector3::from(at.map(f64::from)) * 0.05))
        .collect()
}

#[test]
fn centres_of_voxels_have_their_volume_or_errors_that_allow_for_half_a_voxel() {
    let semi_axes = Vector3::new(1.0, 0.7, 0.5);
    let truth = 4.0 / 3.0 * PI * semi_axes.product();
    let volume = |points: &[Point3<f64>]| {
        let text: String = points
            .iter()
            .map(|p| format!("{} {} {}\n", p.x, p.y, p.z))
            .collect();
        let scan = parse_scan(text.as_bytes(), Some("xyz")).unwrap();
        let fitted = fit(&scan, &FitOptions::default()).unwrap();
        let survey = fitted.survey();
        let volume = survey.properties().unwrap().volume;
        (
            volume / truth - 1.0,
            fitted.standard_errors(&survey).unwrap().volume / truth,
        )
    };
    let all = voxels(&semi_axes);
    let (off, error) = volume(&all);
    assert!(off.abs() < 2.0 * error && error < 0.01, "{off} {error}");
    let half: Vec<_> = all.iter().step_by(2).copied().collect();
    let (off, error) = volume(&half);
    assert!(off < -0.05 && off.abs() < 2.0 * error, "{off} {error}");
}
