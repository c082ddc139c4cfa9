//! How the orders of a degree differ: the tilt under which the coefficients of a fit are most likely.
//!
//! As of an even cloud, where a coefficient is normal before it is shrunk, with the variance v (g + q / (1 - q)): v that
//! of its degree, g the share of its order, q the share that the points leave of a variance v.

use super::spectrum::Spectrum;

/// Tilts that are compared: few and far between, so that rounding does not move the choice.
const STEP: f64 = 0.25;
const STEPS: i32 = 8;

/// A tilt is kept if it lowers the negative log likelihood by this.
const WORTH: f64 = 6.0;

/// The most likely tilt behind the coefficients of a fit without one; 0 where none is much more likely. `unlearnt`: q per
/// degree.
pub(super) fn most_likely(coefficients: &[f64], unlearnt: &[f64], spectrum: &Spectrum) -> f64 {
    let cost = |tilt: f64| cost(coefficients, unlearnt, &spectrum.tilted(tilt));
    let tilts = (-STEPS..=STEPS).map(|i| f64::from(i) * STEP);
    let costs = tilts.map(|tilt| (tilt, cost(tilt)));
    match costs.min_by(|a, b| a.1.total_cmp(&b.1)) {
        Some((tilt, least)) if least < cost(0.0) - WORTH => tilt,
        _ => 0.0,
    }
}

/// Negative logarithm of the likelihood of coefficients that were shrunk without a tilt.
fn cost(coefficients: &[f64], unlearnt: &[f64], spectrum: &Spectrum) -> f64 {
    let variances = spectrum.variances(unlearnt.len() - 1);
    let degrees = variances.iter().zip(unlearnt).enumerate();
    let costs = degrees.map(|(l, (v, q))| {
        let learnt = 1.0 - q;
        let own = coefficients[l * l..].iter().zip(spectrum.orders(l));
        let costs = own.map(|(x, share)| {
            let expected = v * (share + q / learnt);
            expected.ln() + (x / learnt).powi(2) / expected
        });
        0.5 * costs.sum::<f64>()
    });
    costs.sum()
}

#[cfg(test)]
mod tests {
    use super::*;
    use rand::SeedableRng;
    use rand_chacha::ChaCha8Rng;
    use rand_distr::{Distribution, StandardNormal};

    /// Coefficients that a spectrum makes, seen through noise and shrunk without its tilt.
    #[test]
    fn the_tilt_behind_coefficients_is_found() {
        let even = Spectrum::with_amplitude([-2.0, 0.9, 1.2, -5.0]);
        let noise = 1e-6;
        let variances = even.variances(20);
        let unlearnt: Vec<f64> = variances.iter().map(|v| noise / (v + noise)).collect();
        for tilt in [-1.0, 0.0, 1.5] {
            let mut random = ChaCha8Rng::seed_from_u64(7);
            let mut normal = || -> f64 { StandardNormal.sample(&mut random) };
            let spectrum = even.tilted(tilt);
            let mut coefficients = Vec::new();
            for (l, (v, q)) in variances.iter().zip(&unlearnt).enumerate() {
                let orders = spectrum.orders(l);
                let seen =
                    orders.map(|share| (v * share).sqrt() * normal() + noise.sqrt() * normal());
                coefficients.extend(seen.map(|x| x * (1.0 - q)));
            }
            let found = most_likely(&coefficients, &unlearnt, &even);
            assert!((found - tilt).abs() < 0.4, "{found} {tilt}");
        }
    }

    #[test]
    fn no_tilt_is_found_behind_coefficients_without_one() {
        let even = Spectrum::with_amplitude([-2.0, 0.9, 1.2, -5.0]);
        let unlearnt = [1e-6; 21];
        for seed in 0..8 {
            let mut random = ChaCha8Rng::seed_from_u64(seed);
            let variances = even.variances(20).into_iter().enumerate();
            let orders = variances.flat_map(|(l, v)| vec![v; 2 * l + 1]);
            let coefficients = orders.map(|v| {
                let normal: f64 = StandardNormal.sample(&mut random);
                v.sqrt() * normal
            });
            let coefficients: Vec<f64> = coefficients.collect();
            assert_eq!(most_likely(&coefficients, &unlearnt, &even), 0.0);
        }
    }

    /// Before it was shrunk, a coefficient had been measured with the noise that its shrinkage tells.
    #[test]
    fn the_cost_is_that_of_what_was_measured() {
        let spectrum = Spectrum::with_amplitude([-2.0, 0.9, 1.2, -5.0]).tilted(0.7);
        let (noise, degree) = (3e-4, 12);
        let (mut coefficients, mut unlearnt, mut expected) = (Vec::new(), Vec::new(), 0.0);
        for (l, v) in spectrum.variances(degree).into_iter().enumerate() {
            unlearnt.push(noise / (v + noise));
            for share in spectrum.orders(l) {
                let measured = 0.02 * (coefficients.len() as f64).sin();
                let variance = v * share + noise;
                expected += 0.5 * (variance.ln() + measured * measured / variance);
                coefficients.push(measured * v / (v + noise));
            }
        }
        let found = cost(&coefficients, &unlearnt, &spectrum);
        assert!((found / expected - 1.0).abs() < 1e-12, "{found} {expected}");
    }

    #[test]
    fn orders_share_the_variance_of_their_degree() {
        let spectrum = Spectrum::start().tilted(1.0);
        let shares: Vec<f64> = spectrum.orders(5).collect();
        assert!((shares.iter().sum::<f64>() - 11.0).abs() < 1e-12);
        assert!((shares[0] / shares[5] - 1.0_f64.exp()).abs() < 1e-12);
        assert!((shares[10] / shares[5] - 1.0_f64.exp()).abs() < 1e-12);
        assert!(spectrum.orders(2).all(|share| share == 1.0));
        for mean in [1e-9, 0.3, 0.999] {
            let left = spectrum.left(5, mean);
            assert!((left.iter().sum::<f64>() / 11.0 / mean - 1.0).abs() < 1e-9);
            // The orders of most variance are told best.
            assert!(left[0] < left[5]);
        }
    }
}
