use super::super::trial::{estimated, fibonacci, samples};
use crate::fit::prepare::Sample;
use crate::sphere::{HarmonicBasis, coefficient_count};
use nalgebra::Vector3;
use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, StandardNormal};

/// A ball of radius 3 with a hundredth of noise, whose points say nothing of knee and slope.
fn ball(seed: u64) -> Vec<Sample> {
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    let directions = fibonacci(1500).into_iter();
    directions
        .map(|n| {
            let error: f64 = StandardNormal.sample(&mut random);
            [n.x, n.y, n.z, 3.0 + 0.03 * error]
        })
        .collect()
}

#[test]
fn the_noise_of_balls_is_noise_and_what_is_known_of_them_no_matter_of_chance() {
    let (mut least, mut most) = (f64::INFINITY, 0.0_f64);
    for seed in 0..12 {
        let samples = ball(seed);
        let squares = samples.iter().map(|sample| (sample[3] - 3.0).powi(2));
        let noise = (squares.sum::<f64>() / samples.len() as f64).sqrt();
        let found = estimated(&samples, Vector3::repeat(3.0));
        let ratio = found.noise() / noise;
        assert!((ratio - 1.0).abs() < 0.02, "{seed}: {ratio}");
        least = least.min(found.deviation());
        most = most.max(found.deviation());
    }
    assert!(most < 2.0 * least, "{least} {most}");
}

/// Waves of one degree, of a hundredth of the radius as RMS, in noise of so much.
fn wavy(degree: usize, points: usize, noise: f64) -> Vec<Sample> {
    let basis = HarmonicBasis::new(degree);
    let axial = degree * degree + degree;
    let radius = |n: &Vector3<f64>| {
        let mut values = vec![0.0; coefficient_count(degree)];
        basis.evaluate(n, &mut values);
        3.0 + 0.03 * (4.0 * std::f64::consts::PI).sqrt() * values[axial]
    };
    samples(&fibonacci(points), radius, noise)
}

#[test]
fn waves_of_one_width_are_no_noise() {
    let mut alone = 0;
    for (degree, noise) in [(18, 0.03), (25, 0.03), (18, 0.06)] {
        let found = estimated(&wavy(degree, 3000, noise), Vector3::repeat(3.0));
        let ratio = found.noise() / noise;
        assert!((ratio - 1.0).abs() < 0.1, "{degree}: {ratio}");
        alone += usize::from(found.spectrum.waves[degree] > 0.0);
    }
    // Some law tells the others.
    assert!(alone > 0);
    // Beyond the degree at which maps are compared.
    let found = estimated(&wavy(30, 3000, 0.0), Vector3::repeat(3.0));
    assert!(
        found.degree > 30 && found.noise() < 1e-4,
        "{}",
        found.noise()
    );
}
