//! x
use super::outcome::{Derived, Estimate};
use super::posterior::Posterior;
use super::spectrum::NOISE;
use super::spectrum_search::fit_at;

impl Estimate {
    fn loo(&self) -> f64 {
        let residuals = self.residuals();
        let spares = self.steady_spares();
        let points = residuals.iter().zip(spares).zip(&self.cloud.weights);
        let sum: f64 = points.map(|((e, s), w)| w * (e / s).powi(2)).sum();
        (sum / self.cloud.len() as f64).sqrt()
    }
    fn loo_clipped(&self) -> f64 {
        let residuals = self.residuals();
        let spares = self.steady_spares();
        let points = residuals.iter().zip(spares).zip(&self.cloud.weights);
        let mut all: Vec<f64> = points.map(|((e, s), w)| w * (e / s).powi(2)).collect();
        all.sort_by(f64::total_cmp);
        let n = all.len() * 99 / 100;
        (all[..n].iter().sum::<f64>() / n as f64).sqrt()
    }

    pub(super) fn followed_closely(self) -> Self {
        let env = |name: &str, usual: f64| std::env::var(name).ok().and_then(|t| t.parse().ok()).unwrap_or(usual);
        let factor = env("GF_NOISE", 1.0);
        if factor == 1.0 || self.dense.is_some() || !self.is_rough() {
            return self;
        }
        let t = std::time::Instant::now();
        let told = |e: &Self, f: f64| eprintln!("noise x {f:.3} ray {:.4} normal {:.4} clipped {:.4} dev {:.4} rough {} {:?}", e.held_out() / e.cloud.mean, e.loo(), e.loo_clipped(), e.deviation() / e.cloud.mean, e.is_rough(), t.elapsed());
        told(&self, 1.0);
        let mut f = 1.0;
        let mut best = self;
        for _ in 0..env("GF_TIMES", 1.0) as usize {
            f *= factor;
            let mut spectrum = best.spectrum;
            spectrum.logarithms[NOISE] += factor.ln();
            let posterior = Posterior::with(&best.cloud, std::sync::Arc::clone(&best.sums));
            let fit = fit_at(&posterior, spectrum, best.factor.is_some(), &best.coefficients);
            let found = Self { spectrum: fit.spectrum, coefficients: fit.coefficients, unlearnt: fit.unlearnt, sums: fit.sums, factor: fit.factor,
                derived: Derived::default(), cloud: best.cloud.clone(), ..best };
            told(&found, f);
            best = found;
        }
        best
    }
}
