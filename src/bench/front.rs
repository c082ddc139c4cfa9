//! The settings worth choosing: no other costs less and errs less.

use super::{BenchRow, BenchScan, Family};

/// What an error is bought with.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Cost {
    /// Coefficients of the model.
    Coefficients,
    /// Seconds of preparing the scan and of the fit.
    Seconds,
    /// Nanoseconds of one evaluation in a random direction.
    Nanoseconds,
}

impl Cost {
    /// All costs.
    pub const ALL: [Self; 3] = [Self::Coefficients, Self::Seconds, Self::Nanoseconds];

    /// The name, in lower case.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Coefficients => "coefficients",
            Self::Seconds => "seconds",
            Self::Nanoseconds => "nanoseconds",
        }
    }

    /// What a row costs.
    pub fn of(self, row: &BenchRow) -> f64 {
        match self {
            Self::Coefficients => row.coefficients as f64,
            Self::Seconds => row.seconds_prepare + row.seconds,
            Self::Nanoseconds => row.nanoseconds,
        }
    }
}

impl BenchScan {
    /// The fit with the default options, if the scan bears it.
    pub fn automatic(&self) -> Option<&BenchRow> {
        let is_automatic =
            |row: &&BenchRow| row.family == Family::Adaptive && row.tolerance.is_none();
        self.rows.iter().find(is_automatic)
    }

    /// The rival of least degree whose error is no larger than that of a row.
    pub fn rival_as_good_as(&self, row: &BenchRow) -> Option<&BenchRow> {
        let rivals = self.rows.iter().filter(|row| row.family == Family::Ducc0);
        let as_good = rivals.filter(|rival| rival.error() <= row.error());
        as_good.min_by_key(|rival| rival.degree)
    }

    /// Indices of the rows on the Pareto front of a cost and the [error](BenchRow::error), the cheapest first.
    /// Rejected rows are not on it: they are no models of the grain, whatever their mean error.
    pub fn front(&self, cost: Cost) -> Vec<usize> {
        let error = |row: &BenchRow| match row.rejected {
            None => row.error(),
            Some(_) => f64::NAN,
        };
        let points: Vec<_> = self.rows.iter().map(|r| (cost.of(r), error(r))).collect();
        front(&points)
    }
}

/// Indices of the points that no other is below in one coordinate without being above in the other;
/// by ascending first coordinate. Of equal points the first is taken; points with a coordinate that
/// is not finite count for nothing.
pub fn front(points: &[(f64, f64)]) -> Vec<usize> {
    let mut order: Vec<usize> = (0..points.len())
        .filter(|&i| points[i].0.is_finite() && points[i].1.is_finite())
        .collect();
    order.sort_by(|&i, &j| {
        let ((a, b), (c, d)) = (points[i], points[j]);
        a.total_cmp(&c).then(b.total_cmp(&d))
    });
    let mut least = f64::INFINITY;
    order.retain(|&i| {
        let is_better = points[i].1 < least;
        least = least.min(points[i].1);
        is_better
    });
    order
}

#[cfg(test)]
mod tests {
    use super::front;
    use proptest::prelude::*;

    #[test]
    fn of_equal_points_the_first_is_taken_and_nothing_unknown() {
        let points = [
            (2.0, 1.0),
            (1.0, f64::NAN),
            (2.0, 1.0),
            (1.0, 3.0),
            (f64::INFINITY, 0.0),
        ];
        assert_eq!(front(&points), [3, 0]);
        assert!(front(&[]).is_empty());
    }

    proptest! {
        // Whole numbers of a small range, so that coordinates coincide.
        #[test]
        fn the_front_is_not_dominated_and_dominates_the_rest(
            points in prop::collection::vec((0..12_i32, 0..12_i32), 0..60)
        ) {
            let points: Vec<(f64, f64)> =
                points.into_iter().map(|(x, y)| (x.into(), y.into())).collect();
            let front = front(&points);
            let is_as_good = |a: usize, b: usize| {
                points[a].0 <= points[b].0 && points[a].1 <= points[b].1
            };
            for &on in &front {
                let dominates = |&i: &usize| is_as_good(i, on) && points[i] != points[on];
                prop_assert!(!(0..points.len()).any(|i| dominates(&i)));
            }
            for other in (0..points.len()).filter(|i| !front.contains(i)) {
                prop_assert!(front.iter().any(|&on| is_as_good(on, other)));
            }
            prop_assert!(front.is_sorted_by(|&a, &b| points[a].0 < points[b].0));
        }
    }
}
