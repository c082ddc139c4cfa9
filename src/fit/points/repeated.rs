//! Points without those that repeat others.

use crate::fit::warning::FitWarning;
use crate::scan::distinct;
use nalgebra::Point3;
use std::borrow::Cow;

/// A place that so many times as many points stand at as at others is told.
const OVER_AND_OVER: usize = 10;

/// The points without repeats, and the place that is repeated most, where it is told.
pub(in crate::fit) fn without_repeats(
    points: Cow<'_, [Point3<f64>]>,
) -> (Cow<'_, [Point3<f64>]>, Option<FitWarning>) {
    let Some(distinct) = distinct(&points) else {
        return (points, None);
    };
    let (place, times) = distinct.most;
    let is_odd = times * distinct.points.len() >= OVER_AND_OVER * points.len();
    let warning = is_odd.then_some(FitWarning::Repeated { place, times });
    (Cow::Owned(distinct.points), warning)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fit::{FitOptions, fit};
    use crate::measure::grain_properties;
    use crate::scan::Scan;
    use crate::shapes::{Body, SynthOptions, synthesize};
    use nalgebra::Vector3;

    /// A grain beside the origin, and about a place that is none of its centre.
    #[test]
    fn rows_of_what_was_not_seen_change_nothing() {
        let seen = synthesize(&SynthOptions::clean(Body::Bean).with_points(1500)).unwrap();
        for place in [Vector3::new(2.0, 0.5, -0.3), Vector3::repeat(40.0)] {
            let fitted = |unseen: usize| {
                let mut points: Vec<_> = seen.points.iter().map(|point| point + place).collect();
                points.splice(700..700, vec![Point3::origin(); unseen]);
                fit(&Scan::from_points(points), &FitOptions::default()).unwrap()
            };
            let volume = |unseen| grain_properties(&fitted(unseen).grain).properties.volume;
            let clean = volume(0);
            for unseen in [2, 300] {
                assert!((volume(unseen) / clean - 1.0).abs() < 1e-6, "{unseen}");
            }
            let told = fitted(300).warnings;
            let times = told.iter().find_map(|warning| match warning {
                FitWarning::Repeated { place, times } => Some((*place, *times)),
                _ => None,
            });
            assert_eq!(times, Some((Point3::origin(), 300)));
        }
    }
}
