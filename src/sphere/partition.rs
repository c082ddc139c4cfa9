//! The partition of the angle domain (dissertation, 4.1 and 4.2): [0, pi] and [0, 2 pi) are each cut
//! in k equal parts, which makes n_s = k^2 segments.

use super::{Cap, GaussLegendre};
use nalgebra::Vector3;
use std::f64::consts::{PI, TAU};

/// Most parts per angle: the number of segments is one of 32 bits.
const MOST_PARTS: usize = 65_535;

/// k x k segments, numbered row by row from the north pole: segment = i_theta k + i_phi.
///
/// A segment is half open: it holds its lower polar angle and azimuth, not its upper ones (the last
/// row holds the south pole).
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct AngularPartition {
    per_angle: usize,
}

/// A rectangle of the angle domain, in radians.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct AngleRectangle {
    /// Lower and upper polar angle.
    pub theta: [f64; 2],
    /// Lower and upper azimuth.
    pub phi: [f64; 2],
}

impl AngularPartition {
    /// The partition with `per_angle` parts per angle, from 1 to 65 535: 0 is taken as 1, and more as the most.
    pub fn new(per_angle: usize) -> Self {
        Self {
            per_angle: per_angle.clamp(1, MOST_PARTS),
        }
    }

    /// Parts per angle, k.
    pub fn per_angle(&self) -> usize {
        self.per_angle
    }

    /// Number of segments, n_s = k^2.
    pub fn segments(&self) -> usize {
        self.per_angle * self.per_angle
    }

    /// The segment that holds the unit vector `n`.
    pub fn segment_of(&self, n: &Vector3<f64>) -> usize {
        let k = self.per_angle;
        part(polar_fraction(n), k) * k + part(azimuth_fraction(n), k)
    }

    /// The bounds of a segment, whose number is below [`Self::segments`]: beyond, they are no part of the sphere.
    pub fn rectangle(&self, segment: usize) -> AngleRectangle {
        let k = self.per_angle;
        let (row, column) = ((segment / k) as f64, (segment % k) as f64);
        let cut = |i: f64, whole: f64| whole * i / k as f64;
        AngleRectangle {
            theta: [cut(row, PI), cut(row + 1.0, PI)],
            phi: [cut(column, TAU), cut(column + 1.0, TAU)],
        }
    }

    /// The cap of a segment: round the middle of its rectangle, as high as its farthest corner.
    pub(crate) fn cap(&self, segment: usize) -> Cap {
        self.rectangle(segment).cap()
    }
}

impl AngleRectangle {
    /// Unit vector at the fractions `s` of the polar angles and `t` of the azimuths.
    pub fn direction(&self, s: f64, t: f64) -> Vector3<f64> {
        let theta = self.theta[0] + s * (self.theta[1] - self.theta[0]);
        let phi = self.phi[0] + t * (self.phi[1] - self.phi[0]);
        let (st, ct) = theta.sin_cos();
        let (sp, cp) = phi.sin_cos();
        Vector3::new(st * cp, st * sp, ct)
    }

    /// The nodes of a product of two Gauss rules: unit vectors, and their weights in solid angle.
    pub(crate) fn nodes(
        &self,
        polar: &GaussLegendre,
        azimuthal: &GaussLegendre,
    ) -> Vec<(Vector3<f64>, f64)> {
        let turns: Vec<_> = azimuthal
            .on(self.phi[0], self.phi[1])
            .map(|(phi, weight)| (phi.sin_cos(), weight))
            .collect();
        let mut nodes = Vec::with_capacity(polar.len() * turns.len());
        for (theta, polar_weight) in polar.on(self.theta[0], self.theta[1]) {
            let (st, ct) = theta.sin_cos();
            for &((sp, cp), weight) in &turns {
                nodes.push((
                    Vector3::new(st * cp, st * sp, ct),
                    polar_weight * weight * st,
                ));
            }
        }
        nodes
    }

    /// Corners, middles of the borders and the middle: 3 x 3 directions, row by row.
    pub(crate) fn lattice(&self) -> [[f64; 4]; 9] {
        std::array::from_fn(|i| {
            let n = self.direction((i / 3) as f64 / 2.0, (i % 3) as f64 / 2.0);
            [n.x, n.y, n.z, 0.0]
        })
    }

    /// Solid angle of the rectangle.
    pub fn solid_angle(&self) -> f64 {
        (self.theta[0].cos() - self.theta[1].cos()) * (self.phi[1] - self.phi[0])
    }

    /// The four rectangles that the middle angles cut it in.
    pub fn quarters(&self) -> [Self; 4] {
        let halves = |[low, high]: [f64; 2]| {
            let middle = 0.5 * (low + high);
            [[low, middle], [middle, high]]
        };
        let ([north, south], [west, east]) = (halves(self.theta), halves(self.phi));
        [(north, west), (north, east), (south, west), (south, east)]
            .map(|(theta, phi)| Self { theta, phi })
    }

    /// The cap round the middle of the rectangle that just holds it.
    pub(crate) fn cap(&self) -> Cap {
        let theta = 0.5 * (self.theta[0] + self.theta[1]);
        let phi = 0.5 * (self.phi[0] + self.phi[1]);
        let half_turn = (0.5 * (self.phi[1] - self.phi[0])).min(PI);
        // The farthest point has the extreme azimuth; along it, 1 - n.c is 1 - a cos(t - t0).
        let (a, b) = (theta.sin() * half_turn.cos(), theta.cos());
        let opposite = a.atan2(b) + PI;
        let height = [self.theta[0], self.theta[1], opposite, opposite - TAU]
            .into_iter()
            .filter(|t| (self.theta[0]..=self.theta[1]).contains(t))
            .map(|t| 1.0 - (a * t.sin() + b * t.cos()))
            .fold(0.0, f64::max);
        Cap::new(theta, phi, height)
    }
}

/// How far below i/k a boundary really lies, as a fraction of the whole angle.
///
/// Samples of a symmetric body lie on a boundary up to rounding. With the boundary a hair lower they
/// all fall on its upper side, whatever the rounding, and a fit does not change when the scan is
/// shifted. Far above rounding (1e-15), far below any angle that matters.
const BOUNDARY_OFFSET: f64 = 1e-9;

/// Polar angle over pi, in [0, 1], up to the boundary offset.
pub(crate) fn polar_fraction(n: &Vector3<f64>) -> f64 {
    (n.x * n.x + n.y * n.y).sqrt().atan2(n.z) / PI + BOUNDARY_OFFSET
}

/// Azimuth over 2 pi, in [0, 1), up to the boundary offset; 0 at the poles, where it has no meaning.
pub(crate) fn azimuth_fraction(n: &Vector3<f64>) -> f64 {
    if n.x.abs() + n.y.abs() < BOUNDARY_OFFSET {
        return 0.0;
    }
    let turn = n.y.atan2(n.x) / TAU + BOUNDARY_OFFSET;
    let turn = if turn < 0.0 { turn + 1.0 } else { turn };
    if turn < 1.0 { turn } else { 0.0 }
}

/// The part i of [0, 1] with i/k <= t < (i+1)/k, decided on the quotients themselves, so that every
/// use of a boundary i/k agrees to the bit.
pub(crate) fn part(t: f64, k: usize) -> usize {
    let guess = ((t * k as f64) as usize).min(k - 1);
    if t < guess as f64 / k as f64 {
        guess - 1
    } else if guess + 1 < k && t >= (guess + 1) as f64 / k as f64 {
        guess + 1
    } else {
        guess
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_direction_lies_in_the_rectangle_and_the_cap_of_its_segment() {
        for k in [1, 2, 3, 7, 10, 64] {
            let partition = AngularPartition::new(k);
            for i in 0..=40 {
                for j in 0..40 {
                    let whole = AngleRectangle {
                        theta: [0.0, PI],
                        phi: [0.0, TAU],
                    };
                    let n = whole.direction(i as f64 / 40.0, j as f64 / 40.0);
                    let segment = partition.segment_of(&n);
                    let (theta, phi) = (polar_fraction(&n) * PI, azimuth_fraction(&n) * TAU);
                    let r = partition.rectangle(segment);
                    assert!(r.theta[0] <= theta && theta <= r.theta[1] + 1e-8);
                    assert!(r.phi[0] <= phi && phi <= r.phi[1] + 1e-8);
                    let cap = partition.cap(segment);
                    assert!((n - cap.centre).norm_squared() / 2.0 <= cap.height * (1.0 + 1e-7));
                }
            }
        }
    }

    #[test]
    fn any_number_of_parts_and_any_segment_has_a_value() {
        for per_angle in [0, 1, 3, usize::MAX] {
            let partition = AngularPartition::new(per_angle);
            let south = partition.segment_of(&-Vector3::z());
            assert!(south < partition.segments());
            for segment in [partition.segments(), usize::MAX] {
                let [low, high] = partition.rectangle(segment).theta;
                assert!(low >= PI && high >= low);
            }
        }
    }

    #[test]
    fn a_boundary_belongs_to_the_upper_part() {
        for k in 1..=64 {
            for i in 0..k {
                assert_eq!(part(i as f64 / k as f64, k), i);
            }
            assert_eq!(part(1.0, k), k - 1);
        }
    }
}
