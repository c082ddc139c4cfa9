//! The surface of a grain that touches another: smooth, and known at some of its points.

use crate::sphere::{HarmonicBasis, coefficient_count};
use crate::spread::covariance;
use faer::Mat;
use faer::linalg::solvers::SolveLstsq;
use nalgebra::{Matrix3, Point3, SymmetricEigen, Vector3};

/// Degree of the radius.
const DEGREE: usize = 8;

/// Points that it is fitted to, at most.
const MOST_POINTS: usize = 1000;

/// Weight of the Laplacian of the radius beside a residual, so that it is smooth where no points are.
const STIFFNESS: f64 = 3e-4;

/// Least over largest variance along the axes of a body.
const FLAT: f64 = 1e-9;

/// RMS distance from two outlines over that from one. Of grains that touch it is below .12, with noise of 1 % too.
const TWO: f64 = 0.33;

/// RMS distance from the outline of one side over its radius, at most. Of smooth grains that touch it is below .01, between voxels
/// .03; of the arms of a hook above .054.
const FOLLOWED: f64 = 0.045;

/// A radius in harmonics about the middle of the points, in a space in which they spread alike in all directions.
pub(super) struct Outline {
    middle: Point3<f64>,
    unstretch: Matrix3<f64>,
    basis: HarmonicBasis,
    coefficients: Vec<f64>,
}

impl Outline {
    /// The outline through points, by least squares; none through too few, or through those of a plane.
    pub(super) fn through(points: &[Point3<f64>]) -> Option<Self> {
        let terms = coefficient_count(DEGREE);
        let step = points.len().div_ceil(MOST_POINTS).max(1);
        let taken: Vec<Point3<f64>> = points.iter().copied().step_by(step).collect();
        if taken.len() < terms {
            return None;
        }
        let first = taken[0];
        let (middle, spread) = covariance(taken.iter().map(|point| point - first));
        let middle = first + middle;
        let SymmetricEigen {
            eigenvalues,
            eigenvectors,
        } = SymmetricEigen::new(spread);
        if eigenvalues.min() <= FLAT * eigenvalues.max() {
            return None;
        }
        let scales = Matrix3::from_diagonal(&eigenvalues.map(|variance| variance.sqrt().recip()));
        let mut outline = Self {
            middle,
            unstretch: eigenvectors * scales * eigenvectors.transpose(),
            basis: HarmonicBasis::new(DEGREE),
            coefficients: vec![0.0; terms],
        };
        let rays: Vec<Vector3<f64>> = taken.iter().map(|point| outline.ray(point)).collect();
        let mut rows = Mat::zeros(taken.len() + terms, terms);
        let mut values = vec![0.0; terms];
        for (row, ray) in rays.iter().enumerate() {
            outline.basis.evaluate(&ray.normalize(), &mut values);
            for (term, value) in values.iter().enumerate() {
                rows[(row, term)] = *value;
            }
        }
        for degree in 0..=DEGREE {
            for term in degree * degree..(degree + 1) * (degree + 1) {
                let laplacian = (degree * (degree + 1)) as f64;
                rows[(taken.len() + term, term)] =
                    STIFFNESS * (taken.len() as f64).sqrt() * laplacian;
            }
        }
        let right = Mat::from_fn(rows.nrows(), 1, |row, _| {
            rays.get(row).map_or(0.0, |ray| ray.norm())
        });
        let solution = rows.qr().solve_lstsq(right);
        for (term, coefficient) in outline.coefficients.iter_mut().enumerate() {
            *coefficient = solution[(term, 0)];
        }
        Some(outline)
    }

    /// The radial distance of a point.
    pub(super) fn distance(&self, point: &Point3<f64>) -> f64 {
        let ray = self.ray(point);
        let mut values = vec![0.0; self.coefficients.len()];
        self.basis.evaluate(&ray.normalize(), &mut values);
        let terms = values.iter().zip(&self.coefficients);
        let radius: f64 = terms.map(|(value, coefficient)| value * coefficient).sum();
        (1.0 - radius / ray.norm()).abs() * (point - self.middle).norm()
    }

    /// RMS distance of points from the outline through them, over its radius; zero where they have none.
    pub(super) fn misses(points: &[Point3<f64>]) -> f64 {
        let step = points.len().div_ceil(MOST_POINTS).max(1);
        let Some(outline) = Self::through(points) else {
            return 0.0;
        };
        let (mut squares, mut radii) = (0.0, 0.0);
        for point in points.iter().step_by(step) {
            squares += outline.distance(point).powi(2);
            radii += (point - outline.middle).norm_squared();
        }
        (squares / radii).sqrt()
    }

    fn ray(&self, point: &Point3<f64>) -> Vector3<f64> {
        self.unstretch * (point - self.middle)
    }
}

/// The outline of those of the points.
pub(super) fn outline(points: &[Point3<f64>], is_of: impl Fn(usize) -> bool) -> Option<Outline> {
    Outline::through(&those(points, is_of))
}

fn those(points: &[Point3<f64>], is_of: impl Fn(usize) -> bool) -> Vec<Point3<f64>> {
    let own = (0..points.len()).filter(|&i| is_of(i));
    own.map(|i| points[i]).collect()
}

/// Whether the outlines of both sides are much nearer to the points than one of all.
pub(super) fn are_two(points: &[Point3<f64>], beyond: &[bool]) -> bool {
    let sides = [false, true].map(|side| outline(points, |i| beyond[i] == side));
    let ([Some(below), Some(above)], Some(whole)) = (sides, Outline::through(points)) else {
        return false;
    };
    let (mut two, mut one) = (0.0, 0.0);
    for (point, is_beyond) in points.iter().zip(beyond) {
        let own = if *is_beyond { &above } else { &below };
        two += own.distance(point).powi(2);
        one += whole.distance(point).powi(2);
    }
    two < TWO * TWO * one
}

/// Whether the outline of either side is its points' own: the arms of a bent body have none that is.
pub(super) fn are_followed(points: &[Point3<f64>], beyond: &[bool]) -> bool {
    let mut sides = [false, true]
        .map(|side| those(points, |i| beyond[i] == side))
        .into_iter();
    sides.all(|own| Outline::misses(&own) < FOLLOWED)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shapes::{Body, SynthOptions, synthesize};

    /// Where the bean, 14 mm long, is cut off.
    const END: f64 = 4.0;

    #[test]
    fn an_outline_goes_on_where_a_tenth_of_the_points_is_missing() {
        let points = synthesize(&SynthOptions::clean(Body::Bean)).unwrap().points;
        let (missing, known): (Vec<_>, Vec<_>) = points.iter().partition(|point| point.x > END);
        assert!(missing.len() * 12 > points.len());
        let outline = Outline::through(&known).unwrap();
        let farthest = |points: &[Point3<f64>]| {
            let distances = points.iter().map(|point| outline.distance(point));
            distances.fold(0.0, f64::max)
        };
        assert!(farthest(&known) < 0.15 && farthest(&missing) < 0.45);
        let flat: Vec<_> = points.iter().map(|p| Point3::new(p.x, p.y, 1.0)).collect();
        assert!(Outline::through(&flat).is_none() && Outline::through(&points[..50]).is_none());
    }
}
