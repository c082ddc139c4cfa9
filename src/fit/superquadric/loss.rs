//! What distances cost, and how much a point weighs.
//!
//! Cauchy's loss s²/2 log(1 + (d/s)²) of a distance d grows without end, so that fits find their way from afar; Welsch's,
//! s²/2 (1 - exp(-(d/s)²)), leaves points far away out (Holland and Welsch 1977).

/// How far astray points are taken to be.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Reach {
    /// All points but gross strays are of the body: nearly least squares, with Cauchy's loss.
    Wide,
    /// A good part of the points is not of the body: Cauchy's loss.
    Narrow,
    /// The same, and these points are left out: Welsch's loss.
    Near,
}

/// The loss of a distance, and its scale.
#[derive(Debug, Clone, Copy)]
pub(super) struct Loss {
    pub(super) reach: Reach,
    /// Distances beyond this, in mean radii, count less.
    pub(super) scale: f64,
}

/// Products of factors are made logarithms of when they are beyond this.
const LARGE: f64 = 1e100;

/// A sum of losses.
pub(super) struct LossSum {
    loss: Loss,
    per_scale: f64,
    /// Over s²/2.
    sum: f64,
    /// The product of the factors 1 + (d/s)² that are not in the sum yet, less one: nothing of small ones is lost.
    beyond_one: f64,
}

impl LossSum {
    pub(super) fn new(loss: Loss) -> Self {
        Self {
            loss,
            per_scale: 1.0 / loss.scale,
            sum: 0.0,
            beyond_one: 0.0,
        }
    }

    /// Adds the loss of a distance; gives the weight of the point.
    #[inline(always)]
    pub(super) fn add(&mut self, distance: f64) -> f64 {
        let square = (distance * self.per_scale).powi(2);
        match self.loss.reach {
            Reach::Wide | Reach::Narrow => {
                self.beyond_one += square * (1.0 + self.beyond_one);
                if self.beyond_one > LARGE {
                    self.sum += self.beyond_one.ln_1p();
                    self.beyond_one = 0.0;
                }
                1.0 / (1.0 + square)
            }
            Reach::Near => {
                let beyond = (-square).exp_m1();
                self.sum -= beyond;
                1.0 + beyond
            }
        }
    }

    pub(super) fn total(&self) -> f64 {
        0.5 * self.loss.scale * self.loss.scale * (self.sum + self.beyond_one.ln_1p())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;

    #[test]
    fn weights_are_the_slopes_of_losses() {
        let scale = 0.3;
        for reach in [Reach::Wide, Reach::Near] {
            let loss = Loss { reach, scale };
            let total = |distances: &[f64]| {
                let mut sum = LossSum::new(loss);
                distances.iter().for_each(|distance| {
                    sum.add(*distance);
                });
                sum.total()
            };
            for distance in [1e-6, 0.1, 0.3, 0.7] {
                let step = 1e-5 * distance;
                let slope = (total(&[distance + step]) - total(&[distance - step])) / (2.0 * step);
                let weight = LossSum::new(loss).add(distance);
                assert_relative_eq!(slope, weight * distance, max_relative = 1e-6);
            }
            let many = [1e3; 1000];
            assert_relative_eq!(
                total(&many),
                1000.0 * total(&many[..1]),
                max_relative = 1e-12
            );
        }
    }
}
