use super::super::by_degrees;
use super::super::trial::{fibonacci, samples};
use super::*;
use crate::fit::context::Context;
use crate::fit::points::without::without;
use crate::shapes::Sampling;
use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, StandardNormal};

/// Directions, and residuals of noise with this deviation.
fn noisy(deviation: impl Fn(&Vector3<f64>) -> f64) -> (Vec<Vector3<f64>>, Vec<f64>) {
    let directions = Sampling::Fibonacci.directions(3000, 0).unwrap();
    let mut random = ChaCha8Rng::seed_from_u64(1);
    let residuals = directions.iter().map(|n| {
        let normal: f64 = StandardNormal.sample(&mut random);
        deviation(n) * normal
    });
    let residuals = residuals.collect();
    (directions, residuals)
}

/// The outliers of noise where some points have these residuals instead.
fn found(deviation: f64, instead: &[(usize, f64)]) -> Vec<usize> {
    let (directions, mut residuals) = noisy(|_| deviation);
    for &(at, residual) in instead {
        residuals[at] = residual;
    }
    outliers(&directions, &residuals)
}

/// Three points that are neighbours of each other.
fn triangle(directions: &[Vector3<f64>]) -> Vec<usize> {
    let neighbours = Neighbours::new(directions);
    let pair = neighbours.nearest(&directions[1500], 2);
    let middle = directions[pair[0]] + directions[pair[1]];
    neighbours.nearest(&middle.normalize(), 3)
}

#[test]
fn a_point_is_alone_beyond_eight_deviations_and_a_hundredth_of_the_mean_radius() {
    // Contrasts have 1.1 times the deviation of the noise, and their neighbours' median moves by half of it.
    for (noise, kept, left_out) in [
        (0.005, 0.034, 0.06),
        (0.01, 0.068, 0.12),
        (1e-5, 0.0098, 0.0102),
    ] {
        for sign in [1.0, -1.0] {
            assert_eq!(found(noise, &[(1500, sign * kept)]), [0; 0], "{noise}");
            assert_eq!(found(noise, &[(1500, sign * left_out)]), [1500], "{noise}");
        }
    }
}

#[test]
fn three_side_by_side_are_an_edge_unless_they_stand_off_to_both_sides() {
    let (directions, _) = noisy(|_| 0.0);
    let near = triangle(&directions);
    let off = |sizes: &[f64]| -> Vec<(usize, f64)> {
        near.iter().copied().zip(sizes.iter().copied()).collect()
    };
    let mut two = near[..2].to_vec();
    two.sort_unstable();
    assert_eq!(found(1e-3, &off(&[0.05, 0.05])), two);
    assert_eq!(found(1e-3, &off(&[0.05, 0.05, 0.05])), [0; 0]);
    assert_eq!(found(1e-3, &off(&[0.05, 0.05, -0.05])).len(), 3);
}

#[test]
fn a_rough_part_of_the_surface_has_no_outliers() {
    let rough = |n: &Vector3<f64>| if n.z > 0.8 { 0.03 } else { 1e-4 };
    let (directions, residuals) = noisy(rough);
    let found = outliers(&directions, &residuals);
    // On the border half of the vicinity is smooth.
    let inside = found.iter().filter(|&&at| directions[at].z > 0.85);
    assert_eq!(inside.count(), 0, "{found:?}");
}

#[test]
fn what_the_rest_of_the_surface_scatters_by_is_no_outlier_in_a_quiet_part() {
    let quiet = |n: &Vector3<f64>| if n.z > 0.8 { 1e-4 } else { 0.02 };
    let (directions, mut residuals) = noisy(quiet);
    let top = Neighbours::new(&directions).nearest(&Vector3::z(), 1)[0];
    for (residual, expected) in [(0.12, &[][..]), (0.25, &[top])] {
        residuals[top] = residual;
        let mut found = outliers(&directions, &residuals);
        found.retain(|&at| directions[at].z > 0.9);
        assert_eq!(found, expected);
    }
}

#[test]
fn points_left_out_beside_each_other_are_no_strays() {
    let directions = fibonacci(3000);
    let mut all = samples(&directions, |_| 3.0, 0.003);
    let tip = triangle(&directions);
    let alone = 100;
    for &at in tip.iter().chain([&alone]) {
        all[at][3] = 3.6;
    }
    let mut left_out = [&tip[..], &[alone]].concat();
    left_out.sort_unstable();
    let of_rest = |all: &[Sample], left_out: &[usize]| {
        let rest = without(all, left_out.iter().copied());
        by_degrees(&rest, Vector3::repeat(3.0), false, &Context::default()).unwrap()
    };
    assert_eq!(strays(&all, &of_rest(&all, &left_out)), Some(vec![alone]));
    assert_eq!(strays(&all, &of_rest(&all, &[alone])), None);
    // One of them inside is none of the others.
    all[tip[0]][3] = 2.4;
    assert_eq!(strays(&all, &of_rest(&all, &left_out)), None);
}

/// Directions of so many, but for most of those below a height.
fn thinned(points: usize, height: f64, one_in: usize) -> Vec<Vector3<f64>> {
    let all = fibonacci(points).into_iter().enumerate();
    let kept = all.filter(|(i, n)| n.z > height || i % one_in == 0);
    kept.map(|(_, n)| n).collect()
}

#[test]
fn what_is_not_followed_is_no_outlier_where_points_are_thin() {
    let directions = thinned(6000, 0.2, 80);
    let wave = |n: &Vector3<f64>| 0.02 * (6.0 * n.x).sin() * (6.0 * n.y).cos();
    let mut residuals: Vec<f64> = directions.iter().map(wave).collect();
    assert_eq!(outliers(&directions, &residuals), [0; 0]);
    for at in [1200, residuals.len() - 20] {
        residuals[at] += 0.4;
        assert_eq!(outliers(&directions, &residuals), [at]);
        residuals[at] -= 0.4;
    }
}

/// One side is seen two hundred times more densely than the other, where a bump between the points is no stray; the same bump on the
/// dense side is one.
#[test]
fn a_point_where_the_others_tell_little_is_no_stray() {
    let directions = thinned(8000, 0.0, 200);
    let mut all = samples(&directions, |n| 3.0 + 0.2 * (6.0 * n.x + n.y).sin(), 0.003);
    let at = |z: f64| {
        let near = Neighbours::new(&directions).nearest(&Vector3::new(0.6, 0.0, z), 1);
        near[0]
    };
    let [thin, dense] = [at(-0.8), at(0.8)];
    for at in [thin, dense] {
        all[at][3] += 0.15;
    }
    let mut left_out = [thin, dense];
    left_out.sort_unstable();
    let rest = without(&all, left_out);
    let estimate = by_degrees(&rest, Vector3::repeat(3.0), false, &Context::default()).unwrap();
    assert_eq!(strays(&all, &estimate), Some(vec![dense]));
}
