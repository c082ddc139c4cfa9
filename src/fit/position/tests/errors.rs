use super::*;
use crate::shapes::Sampling;
use std::f64::consts::TAU;

/// A mean over the surface is known as well as the mean of so many points: the volume to the noise times the area over
/// the root of their number, and two to three times worse by what points that were held out tell.
#[test]
fn errors_are_those_of_noise_and_hold_the_truth() {
    let (count, noise) = (3000, 0.005);
    let mut squares = 0.0;
    for seed in 0..4 {
        let noisy = CurledOptions::clean(Curled::Banana).with_noise(noise);
        let seen = synthesize_curled(&noisy.with_points(count).with_seed(seed)).unwrap();
        let scan = Scan::from_points(seen.mesh.vertices);
        let fit = fit_position(&scan, &FitOptions::default(), &Context::default()).unwrap();
        let errors = fit.errors.unwrap();
        let grain = PositionGrain::new(fit.frame, fit.surface).unwrap();
        let [found, truth] = [grain_properties(&grain).properties, seen.truth.properties];
        let of_mean = noise * fit.radius * truth.area / (count as f64).sqrt();
        squares += (errors.volume / of_mean).powi(2) / 4.0;
        assert!((found.volume - truth.volume).abs() < 3.0 * errors.volume);
        assert!((found.area - truth.area).abs() < 3.0 * errors.area);
        let [one, other] = [found, truth].map(|solid| solid.principal().unwrap().moments);
        assert!((one - other).component_div(&errors.moments).amax() < 3.0);
    }
    let ratio = squares.sqrt();
    assert!((1.0..3.5).contains(&ratio), "{ratio}");
}

/// Of a banana without one of its ends the area would be five errors too small.
#[test]
fn errors_hold_what_holes_hide() {
    let noisy = CurledOptions::clean(Curled::Banana).with_noise(0.002);
    let seen = synthesize_curled(&noisy.with_points(5000)).unwrap();
    let truth = seen.truth.properties;
    let fitted = |points: Vec<Point3<f64>>| {
        let scan = Scan::from_points(points);
        let fit = fit_position(&scan, &FitOptions::default(), &Context::default()).unwrap();
        let errors = fit.errors.unwrap();
        let grain = PositionGrain::new(fit.frame, fit.surface).unwrap();
        (grain_properties(&grain).properties, errors)
    };
    let whole = seen.mesh.vertices;
    let middle = truth.centroid;
    let away = |point: &Point3<f64>| (point - middle).norm();
    let end = whole
        .iter()
        .copied()
        .reduce(|a, b| if away(&b) > away(&a) { b } else { a });
    let mut cut = whole.clone();
    cut.retain(|point| (point - end.unwrap()).norm() > 0.17);
    let (_, of_whole) = fitted(whole);
    let (found, of_cut) = fitted(cut);
    assert!(of_cut.area > 2.0 * of_whole.area && of_cut.volume > 2.0 * of_whole.volume);
    assert!((found.area - truth.area).abs() < 2.0 * of_cut.area);
    assert!((found.volume - truth.volume).abs() < 2.0 * of_cut.volume);
    let [cut, whole] = [of_cut, of_whole].map(|errors| errors.dimensions.max());
    assert!(cut > 1.5 * whole, "{cut} {whole}");
}

/// Directions along and against the principal axes, and how far the surface reaches in each.
fn ends(grain: &PositionGrain) -> [[(Vector3<f64>, f64); 2]; 3] {
    let axes = grain_properties(grain).properties.principal().unwrap().axes;
    [0, 1, 2].map(|axis| {
        [1.0, -1.0].map(|sign| {
            let along = axes.column(axis) * sign;
            (along, support(grain, &along).point.dot(&along))
        })
    })
}

/// Of few clean points of a hook: what lies above the highest of them is not known.
#[test]
fn no_length_is_known_better_than_its_ends_are_seen() {
    let seen = CurledOptions::clean(Curled::Hook).with_points(3000);
    let points = synthesize_curled(&seen).unwrap().mesh.vertices;
    let scan = Scan::from_points(points.clone());
    let fit = fit_position(&scan, &FitOptions::default(), &Context::default()).unwrap();
    let errors = fit.errors.unwrap().dimensions;
    let centre = fit.frame.centre;
    let grain = PositionGrain::new(fit.frame, fit.surface).unwrap();
    let mut lengths = ends(&grain).map(|ends| {
        let length: f64 = ends.iter().map(|(_, height)| height).sum();
        let [one, other] = ends.map(|(along, height)| {
            let heights = points.iter().map(|point| (point - centre).dot(&along));
            (height - heights.fold(f64::NEG_INFINITY, f64::max)).max(0.0)
        });
        (length, one.hypot(other))
    });
    lengths.sort_by(|(one, _), (other, _)| other.total_cmp(one));
    for ((length, unseen), error) in lengths.iter().zip(&errors) {
        assert!(*unseen > 3e-4 * length, "{unseen}");
        assert!((0.9..3.5).contains(&(error / unseen)), "{error} {unseen}");
    }
}

/// A cup is as long as it is wide and thick, so that the longest of the three that are found is too long; and it ends in a rim,
/// which a smooth surface swings over.
#[test]
fn errors_of_lengths_hold_rims_and_the_longest_of_three() {
    let mut squares = 0.0;
    for seed in 0..4 {
        let noisy = CurledOptions::clean(Curled::Cup).with_noise(0.005);
        let seen = noisy.with_points(6146).with_seed(seed);
        let scan = Scan::from_points(synthesize_curled(&seen).unwrap().mesh.vertices);
        let fit = fit_position(&scan, &FitOptions::default(), &Context::default()).unwrap();
        let errors = fit.errors.unwrap().dimensions;
        let grain = PositionGrain::new(fit.frame, fit.surface).unwrap();
        let lengths = ends(&grain).map(|[(_, one), (_, other)]| one + other);
        let longest = lengths.into_iter().fold(0.0, f64::max);
        assert!((0.003..0.045).contains(&errors.x), "{errors}");
        squares += ((longest - 2.0) / errors.x).powi(2) / 4.0;
    }
    assert!(squares.sqrt() < 1.4, "{}", squares.sqrt());
}

/// Of three arms at 120 degrees two moments are equal, so that length and width may be any of the extents between.
#[test]
fn lengths_along_axes_of_equal_moments_are_known_to_their_range() {
    let arm = |n: &Vector3<f64>, turn: f64| {
        let (sin, cos) = turn.sin_cos();
        1.3 * (8.0 * (n.x * cos + n.y * sin - 1.0)).exp()
    };
    let radius = |n: &Vector3<f64>| {
        let arms = [0.3, 0.3 + 2.0 * PI / 3.0, 0.3 + 4.0 * PI / 3.0];
        0.4 + arms.map(|turn| arm(n, turn)).iter().sum::<f64>()
    };
    let tripod = mesh(24, |n| n * radius(n));
    let extent = |turn: f64| {
        let along = Vector3::new(turn.cos(), turn.sin(), 0.0);
        let heights = || tripod.vertices.iter().map(|place| place.coords.dot(&along));
        heights().fold(0.0, f64::max) - heights().fold(0.0, f64::min)
    };
    let extents = [0.3, 0.3 + PI / 6.0].map(extent);
    let range = (extents[0] - extents[1]).abs();
    let errors = fitted(&tripod, &FitOptions::default())
        .errors
        .unwrap()
        .dimensions;
    assert!(
        range > 0.2 && errors.x > 0.3 * range && errors.y > 0.3 * range,
        "{errors} {range}"
    );
    assert!(errors.z < 0.02, "{errors}");
}

/// Of even points no two lie close together, and texture that is finer than their spacing passes for noise.
#[test]
fn areas_hold_texture_between_even_points() {
    let waves = Sampling::Fibonacci.directions(120, 0).unwrap();
    let mut squares = 0.0;
    for seed in 0..3 {
        let mut waves: Vec<_> = waves
            .iter()
            .enumerate()
            .map(|(at, along)| {
                let number = 4.0 * 15.0_f64.powf(((at * 7919 + seed) % 120) as f64 / 119.0);
                (
                    along * number,
                    TAU * (at as f64 * 0.754_877_666).fract(),
                    number.powf(-1.25),
                )
            })
            .collect();
        let power: f64 = waves.iter().map(|(.., size)| 0.5 * size * size).sum();
        waves
            .iter_mut()
            .for_each(|(.., size)| *size *= 0.01 / power.sqrt());
        let phase =
            |n: &Vector3<f64>, (number, phase, _): &(Vector3<f64>, f64, f64)| number.dot(n) + phase;
        let radius = |n: &Vector3<f64>| {
            1.0 + waves
                .iter()
                .map(|wave| wave.2 * phase(n, wave).cos())
                .sum::<f64>()
        };
        let area = |n: &Vector3<f64>| {
            let slope: Vector3<f64> = waves
                .iter()
                .map(|wave| wave.0 * (-wave.2 * phase(n, wave).sin()))
                .sum();
            radius(n) * radius(n).hypot((slope - n * n.dot(&slope)).norm())
        };
        let all = Sampling::Fibonacci.directions(40_000, 0).unwrap();
        let area = 4.0 * PI * all.iter().map(area).sum::<f64>() / all.len() as f64;
        let points = Sampling::Fibonacci.directions(1500, 0).unwrap().into_iter();
        let scan = Scan::from_points(points.map(|n| Point3::from(n * radius(&n))).collect());
        let fit = fit_position(&scan, &FitOptions::default(), &Context::default()).unwrap();
        let error = fit.errors.unwrap().area;
        let grain = PositionGrain::new(fit.frame, fit.surface).unwrap();
        let off = grain_properties(&grain).properties.area - area;
        squares += (off / error).powi(2) / 3.0;
    }
    assert!(squares.sqrt() < 1.5, "{}", squares.sqrt());
}
