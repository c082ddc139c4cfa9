use super::bound::{Bound, CapBound};
use super::*;
use crate::model::{
    Blended, Frame, Mirrored, Segmented, Stretch, Whole, grain_from_json, grain_to_json,
};
use crate::shapes::Sampling;
use crate::sphere::{AngularPartition, CapBasis, Cover, CubeCell, MARGIN};
use nalgebra::{Matrix3, Point3, Rotation3};
use std::f64::consts::PI;
use std::time::Instant;

fn frame() -> Frame {
    Frame {
        centre: Point3::new(1.0, 2.0, 3.0),
        axes: Rotation3::from_euler_angles(0.3, -0.8, 2.0).into_inner(),
    }
}

/// Numbers from -1 to 1, the same for the same seed.
fn numbers(seed: u64) -> impl Iterator<Item = f64> {
    let mut state = seed.wrapping_mul(0x9e37_79b9_7f4a_7c15) | 1;
    std::iter::repeat_with(move || {
        state ^= state << 13;
        state ^= state >> 7;
        state ^= state << 17;
        (state >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
    })
}

/// Coefficients with this first one and others that fall with the degree.
fn coefficients(degree: usize, first: f64, relief: f64, seed: u64) -> Vec<f64> {
    let count = (degree + 1) * (degree + 1);
    let rest = numbers(seed).zip(1..count);
    std::iter::once(first)
        .chain(rest.map(|(x, i)| relief * x / (1.0 + (i as f64).sqrt()).powi(2)))
        .collect()
}

fn grain(family: Family) -> StarGrain {
    StarGrain::new(frame(), family).expect("a grain")
}

/// Grains of each kind whose relief decides whether the radius is above zero.
fn grains(relief: f64, seed: u64) -> Vec<StarGrain> {
    let cover = Cover::with_margin(CubeCell::uniform(2), MARGIN).expect("a cover");
    let per_cell = (0..24).map(|cell| coefficients(4, 3.0, relief, seed + cell));
    let blended = Blended::new(cover, per_cell.collect()).expect("cells");
    let per_segment = (0..9).map(|segment| coefficients(3, 3.0, relief, seed + segment));
    let segmented = Segmented::new(AngularPartition::new(3), per_segment.collect());
    let mirrored = Mirrored::new(
        "xz".parse().expect("mirrors"),
        coefficients(6, 3.0, relief, seed),
    );
    let alone = Mirrored::new(Symmetry::NONE, coefficients(5, 3.0, relief, seed));
    let whole = Whole::new(coefficients(
        12,
        3.0 * (4.0 * PI).sqrt(),
        2.0 * relief,
        seed,
    ));
    let stretched = Whole::new(coefficients(5, 3.0 * (4.0 * PI).sqrt(), relief, seed + 1));
    let stretch = Stretch::new(Vector3::new(0.5, 1.0, 2.0)).expect("a stretch");
    vec![
        grain(Family::Blended(blended)),
        grain(Family::Segmented(segmented.expect("segments"))),
        grain(Family::Mirrored(mirrored.expect("an expansion"))),
        grain(Family::Mirrored(alone.expect("an expansion"))),
        grain(Family::Whole(whole.expect("an expansion"))),
        StarGrain::stretched(
            frame(),
            stretch,
            Family::Whole(stretched.expect("an expansion")),
        )
        .expect("a grain"),
    ]
}

#[test]
fn the_bound_is_below_a_dense_sample_and_near_it() {
    let directions = Sampling::Fibonacci.directions(20_000, 0).expect("enough");
    let (mut sound, mut unsound, mut unproved) = (0, 0, 0);
    for (relief, seeds) in [(0.3, 4), (1.5, 12), (4.0, 12), (9.0, 6)] {
        for seed in 0..seeds {
            for (kind, grain) in grains(relief, 100 * seed + 1).into_iter().enumerate() {
                let least = grain
                    .radii(&directions)
                    .into_iter()
                    .fold(f64::MAX, f64::min);
                match grain.least_radius() {
                    Ok(found) => {
                        sound += 1;
                        assert!(
                            found.proved > 0.0 && found.proved <= least,
                            "{kind}: {found:?}"
                        );
                        // Of a stretched grain both are divided by a factor, of four to one here.
                        let share = if grain.stretch().is_none() { 1.0 } else { 0.25 };
                        assert!(found.proved >= 0.99 * SHARE * share * found.found, "{kind}");
                    }
                    Err(InvalidGrain::NotPositive { radius, direction }) => {
                        unsound += 1;
                        assert!(radius <= 0.0, "{kind}");
                        // Segments are not continuous: on a border another one may be asked.
                        let is_there = grain.radius(&direction.into()) <= 0.0;
                        assert!(is_there || kind == 1, "{kind}");
                        assert!(least < 0.2, "{kind}: {least}");
                    }
                    // Cells that have nothing to do with each other, blended to a radius of next to nothing.
                    Err(InvalidGrain::Unproved { .. }) => {
                        unproved += 1;
                        assert!(least < 0.1, "{kind}: {least}");
                    }
                    Err(error) => panic!("{kind}: {error}, {least}"),
                }
            }
        }
    }
    assert!(unproved <= 2, "{unproved}");
    assert!(sound > 60 && unsound > 25, "{sound} {unsound}");
}

#[test]
fn of_an_ellipsoid_the_shortest_semi_axis_is_met() {
    let stretch = Stretch::new(Vector3::new(1.0, 0.5, 1.0 / 3.0)).expect("a stretch");
    let ball = Whole::new(vec![(4.0 * PI).sqrt()]).expect("an expansion");
    let ellipsoid = StarGrain::stretched(frame(), stretch, Family::Whole(ball)).expect("a grain");
    let least = ellipsoid.least_radius().expect("a sound grain");
    for radius in [least.proved, least.found] {
        assert!((radius - 1.0).abs() < 1e-12, "{least:?}");
    }
}

#[test]
fn a_narrow_dent_between_samples_is_met() {
    // A dent of 4 degrees that goes just below zero, far from all directions tried first.
    let place = Vector3::new(0.31, 0.57, 0.76).normalize();
    let degree = 60;
    for (depth, is_sound) in [(0.95, true), (1.02, false)] {
        // The reproducing kernel of degree 60, whose value at its place is the largest.
        let peak = (degree + 1) as f64 * (degree + 1) as f64 / (4.0 * PI);
        let mut a: Vec<f64> = crate::sphere::harmonics(degree, &place)
            .iter()
            .map(|y| -depth * y / peak)
            .collect();
        a[0] += (4.0 * PI).sqrt();
        let grain = StarGrain::new(
            Frame {
                centre: Point3::origin(),
                axes: Matrix3::identity(),
            },
            Family::Whole(Whole::new(a).expect("an expansion")),
        )
        .expect("a grain");
        let found = grain.least_radius();
        assert_eq!(found.is_ok(), is_sound, "{found:?}");
    }
}

#[test]
fn bounds_hold_on_the_cap() {
    for (seed, degree) in [(1, 1), (2, 3), (3, 6), (4, 10)] {
        for height in [0.05, 0.4, 1.0, 1.7, 2.0] {
            let cap = crate::sphere::Cap::new(0.7, 2.0, height);
            let own = coefficients(degree, 1.0, 1.0, seed);
            let (bound, basis) = (CapBound::new(&cap, &own), CapBasis::new(degree));
            let value = |n: &Vector3<f64>| basis.value(&cap, &own, n);
            let inside: Vec<Vector3<f64>> = Sampling::Fibonacci
                .directions(4000, 0)
                .expect("enough")
                .into_iter()
                .filter(|n| bound.holds(n))
                .collect();
            for middle in inside.iter().step_by(17) {
                let here = value(middle);
                for radius in [0.02, 0.1, 0.5] {
                    let least = bound.within(middle, radius, here);
                    for n in &inside {
                        if (n - middle).norm() <= 2.0 * (0.5 * radius).sin() {
                            assert!(value(n) >= least, "{degree} {height} {radius}");
                        }
                    }
                }
                assert!(here >= bound.everywhere() && here.abs() <= bound.largest());
            }
        }
    }
}

#[test]
fn models_that_are_not_sound_do_not_load() {
    let text = grain_to_json(&grains(0.3, 1)[4].clone().into());
    let spoilt = |coefficients: serde_json::Value| {
        let mut file: serde_json::Value = serde_json::from_str(&text).expect("JSON");
        file["harmonics"] = coefficients;
        grain_from_json(&file.to_string())
            .err()
            .map(|error| error.to_string())
    };
    assert_eq!(spoilt(serde_json::json!([3.0])), None);
    for (numbers, says) in [
        (vec![-1.0], "above zero"),
        (vec![0.0], "above zero"),
        (vec![1e200], "beyond 1e100"),
        (vec![1e-200], "beyond 1e100"),
        (vec![1.0, 0.0, 5.0, 0.0], "above zero"),
        (vec![0.0; 130 * 130], "degree 129"),
        (vec![1.0; 301 * 301], "degree 300"),
    ] {
        let error = spoilt(numbers.into()).expect("refused");
        assert!(error.contains(says), "{error}");
    }
}

#[test]
fn a_cell_that_is_wild_where_no_point_held_it_is_no_reason_to_refuse() {
    // One cell is 40 times as rough in its cap as it is in its middle: x^4 along a tangent.
    let cover = Cover::with_margin(CubeCell::uniform(3), MARGIN).expect("a cover");
    let mut per_cell: Vec<Vec<f64>> = (0..54)
        .map(|cell| coefficients(4, 3.0, 0.3, cell))
        .collect();
    per_cell[20][23] = 6.0;
    per_cell[20][24] = -6.0;
    let wild = grain(Family::Blended(
        Blended::new(cover, per_cell).expect("cells"),
    ));
    let directions = Sampling::Fibonacci.directions(50_000, 0).expect("enough");
    let least = wild.radii(&directions).into_iter().fold(f64::MAX, f64::min);
    let start = Instant::now();
    let found = wild.least_radius();
    println!("{:?}: {found:?} {least}", start.elapsed());
    assert_eq!(found.is_ok(), least > 0.0, "{found:?} {least}");
}

#[test]
fn a_thousand_coefficients_take_milliseconds() {
    for grain in grains(1.0, 7) {
        let start = Instant::now();
        let _ = grain.least_radius();
        println!("{:?} for {}", start.elapsed(), grain.coefficient_count());
    }
    let rough = Whole::new(coefficients(31, 3.0 * (4.0 * PI).sqrt(), 2.0, 3)).expect("a whole");
    let grain = grain(Family::Whole(rough));
    let start = Instant::now();
    let found = grain.least_radius();
    println!("{:?} for degree 31: {found:?}", start.elapsed());
}
