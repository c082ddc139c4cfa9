//! Coordinates that are rounded to 32 bits, far from the origin.

use crate::digits::significant;
use nalgebra::{Point3, Vector3};

/// Steps of the coordinates over the size of a scan from which on they are told of: of 1e-4, area and volume are 4e-5 off.
const COARSE: f64 = 1e-4;

/// What is said of points whose coordinates are rounded to steps that are not small beside their extent.
pub(super) fn coarse(points: &[Point3<f64>]) -> Option<String> {
    let first = points.first()?.coords;
    let (low, high) = points.iter().fold((first, first), |(low, high), point| {
        (low.inf(&point.coords), high.sup(&point.coords))
    });
    let size = (high - low).max();
    let farthest = Vector3::sup(&low.abs(), &high.abs()).max() as f32;
    let step = f64::from(farthest.next_up()) - f64::from(farthest);
    let are_rounded = || {
        let mut coordinates = points.iter().flat_map(|point| point.iter());
        coordinates.all(|coordinate| f64::from(*coordinate as f32) == *coordinate)
    };
    (size > 0.0 && step > COARSE * size && are_rounded()).then(|| {
        let [step, size] = [step, size].map(|length| significant(length, 2));
        format!(
            "The coordinates have 32 bits, which so far from the origin are steps of {step}, and the scan is {size} wide: \
             figures may be off by more than is told. Save it near the origin, or with 64 bits."
        )
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn told(offset: f64, round: impl Fn(f64) -> f64) -> Option<String> {
        let point = |i: u32| {
            let (sin, cos) = f64::from(i).sin_cos();
            Point3::new(cos, sin, 0.1 * f64::from(i)).map(|c| round(c + offset))
        };
        coarse(&(0..20).map(point).collect::<Vec<_>>())
    }

    #[test]
    fn coordinates_far_from_the_origin_are_coarse_if_they_are_rounded() {
        let to_32 = |c: f64| f64::from(c as f32);
        let warning = told(4e6, to_32).unwrap();
        assert!(
            warning.contains("steps of 0.25") && warning.contains("is 2.0 wide"),
            "{warning}"
        );
        assert!(told(5e4, to_32).is_some() && told(500.0, to_32).is_none());
        assert_eq!(told(4e6, |c| c), None);
        assert_eq!(told(0.0, to_32), None);
        assert_eq!(coarse(&[]), None);
    }
}
