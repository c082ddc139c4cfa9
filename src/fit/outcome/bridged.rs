//! Whether the figures of a body can be told though there are holes between its points that chance or a fit may account for.

use crate::fit::outcome::Fitted;

/// Largest standard errors of area and volume, as shares of them, that vouch for what lies between the points. Of ellipsoids
/// and plates without edges they are 0.002 to 0.9 %; of discs with edges, whose area is 7 to 21 % off, 1.2 to 3 %.
const LARGEST_ERROR: f64 = 0.01;

impl Fitted {
    /// The same, as if all of the grain had been seen, if its standard errors vouch for that.
    pub(in crate::fit) fn between_points(mut self) -> Self {
        let unseen = self.grain.unseen();
        self.grain = self.grain.with_unseen(None);
        if !self.is_sure() {
            self.grain = self.grain.with_unseen(unseen);
        }
        self
    }

    fn is_sure(&self) -> bool {
        let survey = self.survey();
        let (Ok(told), Ok(errors)) = (survey.properties(), self.standard_errors(&survey)) else {
            return false;
        };
        errors.area <= LARGEST_ERROR * told.area && errors.volume <= LARGEST_ERROR * told.volume
    }
}

#[cfg(test)]
mod tests {
    use crate::fit::{FitOptions, Fitted, fit};
    use crate::model::Unseen;
    use crate::scan::Scan;
    use crate::shapes::{Ellipsoid, Sampling, Solid};
    use approx::assert_relative_eq;
    use nalgebra::{Point3, Vector3};

    fn with_hole(fitted: &Fitted, half_angle: f64) -> Fitted {
        let mut fitted = fitted.clone();
        let unseen = Some(Unseen::Hole { half_angle });
        fitted.grain = fitted.grain.with_unseen(unseen);
        fitted.between_points()
    }

    #[test]
    fn sure_figures_are_told_and_others_are_not() {
        let directions = Sampling::Fibonacci.directions(800, 0).unwrap();
        let points = |roughness: f64| -> Vec<Point3<f64>> {
            let signs = (0..).map(|i: i32| f64::from(i * i % 7 - 3));
            let all = directions.iter().zip(signs);
            let place = |(n, sign): (&Vector3<f64>, f64)| {
                let place = Vector3::new(3.0 * n.x, 2.0 * n.y, n.z);
                Point3::from(place * (1.0 + roughness * sign))
            };
            all.map(place).collect()
        };
        let fitted = |roughness| {
            let scan = Scan::from_points(points(roughness));
            fit(&scan, &FitOptions::default()).unwrap()
        };
        let sure = with_hole(&fitted(0.0), 0.6);
        assert_eq!(sure.grain.unseen(), None);
        let truth = Ellipsoid {
            semi_axes: Vector3::new(3.0, 2.0, 1.0),
        };
        let told = sure.survey().properties().unwrap();
        assert_relative_eq!(
            told.area,
            truth.integrals().properties.area,
            max_relative = 1e-3
        );
        assert!(with_hole(&fitted(0.03), 0.6).grain.unseen().is_some());
    }
}
