//! Whether points can be those of a body at all, in two passes over them.

use nalgebra::{Point3, Vector3};

use super::error::{ParseError, Place};

/// Largest coordinate: beyond it a product of three lengths overflows.
const LARGEST: f64 = 1e100;

/// Smallest extent: below it a product of three lengths underflows.
const SMALLEST: f64 = 1e-100;

/// Distance from a line or plane, relative to the extent, that counts as on it.
///
/// Coordinates in 32 bits scatter about a tilted plane by 6e-8 of their size; the thinnest grain
/// anyone scans is some 1e-2 of its length.
const FLAT: f64 = 1e-6;

/// Points of which some is taken to be near most others.
const LOOKED_AT: usize = 16;

/// Of so many points one may be far from all others.
const FEW: usize = 10;

/// What points that passed the check span.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Span {
    /// All points lie in one plane: no body, though a piece of a surface.
    Plane,
    Space,
}

/// Refuses points that no calculation can start from: none, not finite, out of range, all the
/// same or all on one line.
pub(crate) fn check(points: &[Point3<f64>]) -> Result<Span, ParseError> {
    let first = *points.first().ok_or(ParseError::NoPoints)?;
    let (mut low, mut high) = (first.coords, first.coords);
    for (number, point) in points.iter().enumerate() {
        if !point.iter().all(|c| c.abs() <= LARGEST) {
            return Err(out_of_range(number, point));
        }
        low = low.inf(&point.coords);
        high = high.sup(&point.coords);
    }
    let extent = (high - low).max();
    if extent < SMALLEST {
        let points = points.len();
        return Err(ParseError::NoExtent { points });
    }
    let offsets = || points.iter().map(|point| (point - first) / extent);
    // Half the extent at least lies between the first point and some other.
    let far = offsets().find(|offset| offset.amax() >= 0.4);
    let direction = far.unwrap_or_default().normalize();
    let across = longest(offsets().map(|offset| direction.cross(&offset)));
    if across.norm() <= FLAT {
        return Err(far_away(points, extent).unwrap_or(ParseError::Collinear {
            points: points.len(),
        }));
    }
    let normal = across.normalize();
    let flat = offsets().all(|offset| normal.dot(&offset).abs() <= FLAT);
    Ok(if flat { Span::Plane } else { Span::Space })
}

/// The few points that are far from all others, if these are one place beside their distances.
fn far_away(points: &[Point3<f64>], extent: f64) -> Option<ParseError> {
    // Some of these is not among the few.
    let step = points.len().div_ceil(LOOKED_AT);
    points.iter().step_by(step).find_map(|near| {
        let all = points.iter().enumerate();
        let distances = all.map(|(point, place)| (point, (place - near).norm()));
        let mut far = distances.filter(|(_, distance)| *distance > FLAT * extent);
        let (point, distance) = far.next()?;
        let count = 1 + far.count();
        let are_few = points.len() > 2 && count <= points.len().div_ceil(FEW);
        are_few.then_some(ParseError::FarAway {
            point,
            count,
            distance,
        })
    })
}

fn longest(vectors: impl Iterator<Item = Vector3<f64>>) -> Vector3<f64> {
    vectors.fold(Vector3::zeros(), |longest, vector| {
        if vector.norm_squared() > longest.norm_squared() {
            vector
        } else {
            longest
        }
    })
}

fn out_of_range(point: usize, coordinates: &Point3<f64>) -> ParseError {
    match coordinates
        .iter()
        .find(|c| c.is_finite() && c.abs() > LARGEST)
    {
        Some(&value) => ParseError::TooFar { point, value },
        None => {
            let place = Place::Point(point);
            ParseError::NotFinite { place }
        }
    }
}

#[cfg(test)]
mod tests {
    use nalgebra::point;

    use super::*;

    /// Corners of a tetrahedron.
    fn body() -> [Point3<f64>; 4] {
        [
            point![0.0, 0.0, 0.0],
            point![1.0, 0.0, 0.0],
            point![0.0, 3.0, 0.0],
            point![0.0, 0.0, 2.0],
        ]
    }

    #[test]
    fn points_of_a_body_and_of_a_plane_pass() {
        let points = body();
        assert_eq!(check(&points), Ok(Span::Space));
        assert_eq!(check(&points[..3]), Ok(Span::Plane));
    }

    #[test]
    fn points_on_a_line_are_refused() {
        let points: Vec<_> = (0..9)
            .map(|i| point![1.0, 2.0, -3.0] * f64::from(i))
            .collect();
        assert_eq!(check(&points), Err(ParseError::Collinear { points: 9 }));
    }

    #[test]
    fn a_few_points_far_from_a_body_are_named() {
        let body = body();
        for at in [0, 1, 4] {
            let mut points = body.to_vec();
            points.insert(at, point![-1e30, 0.0, 0.0]);
            let found = check(&points).unwrap_err();
            let (count, distance) = (1, 1e30);
            let expected = ParseError::FarAway {
                point: at,
                count,
                distance,
            };
            assert_eq!(found, expected);
        }
        let many =
            |i: u32| Point3::from(Vector3::new(1.0, 2.0, 3.0).map(|x| f64::from(i) * x % 1.7));
        let mut points: Vec<Point3<f64>> = (0..40).map(many).collect();
        for at in [0, 7, 20] {
            points[at] = point![1.7e38, 1.7e38, 1.7e38];
        }
        let told = check(&points).unwrap_err().to_string();
        assert!(told.starts_with("point 0, one of 3 such, is "), "{told}");
    }

    #[test]
    fn one_place_or_none_is_refused() {
        assert_eq!(check(&[]), Err(ParseError::NoPoints));
        let same = [point![1.0, 1.0, 1.0]; 5];
        assert_eq!(check(&same), Err(ParseError::NoExtent { points: 5 }));
    }

    #[test]
    fn coordinates_that_overflow_are_refused_with_their_point() {
        let points = [point![0.0, 0.0, 0.0], point![0.0, 1e200, 0.0]];
        assert_eq!(
            check(&points),
            Err(ParseError::TooFar {
                point: 1,
                value: 1e200
            })
        );
        let points = [point![0.0, 0.0, 0.0], point![0.0, f64::NAN, 0.0]];
        let place = Place::Point(1);
        assert_eq!(check(&points), Err(ParseError::NotFinite { place }));
    }
}
