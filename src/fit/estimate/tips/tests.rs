use super::*;
use crate::fit::estimate::trial::{estimated, samples};
use crate::shapes::{Body, Sampling, SynthOptions, synthesize};
use approx::assert_relative_eq;
use std::f64::consts::TAU;

/// A bump of which the estimate makes nothing is missing as it is; of one that it follows in part, so much of it.
#[test]
fn a_bump_is_missing_as_far_as_its_degrees_are_unlearnt() {
    let nothing = Bump::new(64.0, &falls(64.0), &[1.0; 10]);
    assert!((nothing.left - 1.0).abs() < 1e-12 && (nothing.left_of_squares - 1.0).abs() < 1e-12);
    let all_but_a_tenth = Bump::new(64.0, &falls(64.0), &[0.1; 48]);
    assert!((all_but_a_tenth.left - 0.1).abs() < 1e-12);
    let told = all_but_a_tenth.told([0.2, 3.0], 0.01);
    let information = 3.0 * all_but_a_tenth.left_of_squares / 0.01 + 1.0 / (EXPECTED * EXPECTED);
    assert_relative_eq!(told.height, 0.1 * 20.0 / information);
    assert_relative_eq!(told.variance, 0.01 / information);
    // Most of a wide bump lies in the low degrees, and they are learnt.
    let learnt: Vec<f64> = (0..48).map(|l| if l < 8 { 0.0 } else { 1.0 }).collect();
    assert!(Bump::new(8.0, &falls(8.0), &learnt).left < 0.05);
    assert!(Bump::new(256.0, &falls(256.0), &learnt).left > 0.8);
}

/// The beak of a chickpea in noise: the estimate flattens it, and the points tell by how much to a factor of two.
#[test]
fn what_is_missing_of_a_beak_is_told() {
    let chickpea = SynthOptions::clean(Body::Chickpea).with_points(1538);
    let (mut told, mut missing) = (0.0, 0.0);
    for seed in 0..4 {
        let scan = synthesize(&chickpea.clone().with_noise(0.005).with_seed(seed)).unwrap();
        let samples: Vec<_> = scan
            .points
            .iter()
            .map(|p| {
                let n = p.coords.normalize();
                [n.x, n.y, n.z, p.coords.norm()]
            })
            .collect();
        let found = estimated(&samples, Vector3::repeat(4.0));
        let beak = Vector3::new(1.0, 0.0, 0.1).normalize();
        let short = Body::Chickpea.surface().radius(&beak) - found.stretched_radii(&[beak])[0];
        let posterior = found.posterior();
        let [likeliest, _] = Tips::new(&found, &posterior).likeliest_and_widest(&beak);
        told += likeliest.height * found.cloud.mean;
        missing += short;
    }
    assert!(
        missing > 0.0 && (0.5..2.0).contains(&(told / missing)),
        "{told} of {missing}"
    );
}

/// Nothing is missing of a ball but what chance makes of its noise.
#[test]
fn little_is_missing_of_a_ball() {
    let directions = Sampling::Fibonacci.directions(1000, 0).unwrap();
    let ripple = |i: usize| if i.is_multiple_of(2) { 1.01 } else { 0.99 };
    let samples = directions.iter().enumerate();
    let samples: Vec<_> = samples.map(|(i, n)| [n.x, n.y, n.z, ripple(i)]).collect();
    let found = estimated(&samples, Vector3::repeat(1.0));
    let posterior = found.posterior();
    let tips = Tips::new(&found, &posterior);
    for n in [Vector3::x(), Vector3::y(), Vector3::z()] {
        let [missing, _] = tips.likeliest_and_widest(&n);
        assert!(
            missing.height.abs() < 4.0 * missing.variance.sqrt(),
            "{missing:?}"
        );
    }
}

/// Of a ball in dense rings, none of which is within 18 degrees of an end: what may be missing there is bounded.
#[test]
fn far_from_all_points_a_tip_is_no_higher_than_beaks_are() {
    let on_ring = |ring: i32| {
        let height = 0.1 * f64::from(ring);
        let across = (1.0 - height * height).sqrt();
        (0..200).map(move |at| {
            let (sin, cos) = (TAU * f64::from(at) / 200.0).sin_cos();
            Vector3::new(across * cos, across * sin, height)
        })
    };
    let directions: Vec<Vector3<f64>> = (-9..=9).flat_map(on_ring).collect();
    let samples = samples(&directions, |_| 1.0, 0.003);
    let found = estimated(&samples, Vector3::repeat(1.0));
    let posterior = found.posterior();
    let tips = Tips::new(&found, &posterior);
    for end in [Vector3::z(), -Vector3::z()] {
        for missing in tips.likely(&end) {
            assert!(missing.height.abs() < 0.1, "{missing:?}");
            assert!(missing.variance <= EXPECTED * EXPECTED, "{missing:?}");
        }
    }
}
