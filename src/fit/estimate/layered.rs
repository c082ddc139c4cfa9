//! Layers of points nearer than their neighbours sag by, which the estimate goes between.

use super::outcome::Estimate;
use crate::fit::prepare::layers_beside;

impl Estimate {
    /// By how much the points lie in two layers, as a share of the mean radius, if they do; means of patches do not tell.
    pub(in crate::fit) fn layers(&self) -> Option<f64> {
        if self.dense.is_some() {
            return None;
        }
        let residuals = self.residuals().into_iter().zip(&self.cloud.directions);
        let along = residuals.map(|(e, n)| e * self.cloud.along_normal(n));
        layers_beside(&self.cloud.directions, &along.collect::<Vec<_>>())
    }
}

#[cfg(test)]
mod tests {
    use crate::fit::{FitOptions, FitWarning, fit};
    use crate::scan::Scan;
    use crate::shapes::{Body, Sampling, SynthOptions, synthesize};

    /// Of two scans of which one is .3 % larger; on one alone a quadric and the sag of neighbours tell of none.
    #[test]
    fn layers_that_hardly_differ_are_told() {
        let told = |apart: f64| {
            let options = SynthOptions {
                sampling: Sampling::Random,
                ..SynthOptions::clean(Body::Bean).with_points(4000)
            };
            let points = synthesize(&options.with_noise(2e-4)).unwrap().points;
            let points = points.into_iter().enumerate();
            let scaled = points.map(|(at, point)| {
                if at % 2 == 0 {
                    point
                } else {
                    point * (1.0 + apart)
                }
            });
            let fitted = fit(&Scan::from_points(scaled.collect()), &FitOptions::default()).unwrap();
            let shares = fitted.warnings.iter().filter_map(|warning| match warning {
                FitWarning::Layers { share, .. } => Some(*share),
                _ => None,
            });
            shares.collect::<Vec<_>>()
        };
        let shares = told(0.003);
        assert!(
            shares.len() == 1 && (shares[0] / 0.003 - 1.0).abs() < 0.3,
            "{shares:?}"
        );
        assert!(told(0.0).is_empty());
    }
}
