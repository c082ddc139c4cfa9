//! What a superquadric is.

use std::ops::RangeInclusive;

use super::norm::Slopes;

/// Exponents that are allowed: from nearly an octahedron to nearly a box.
pub const EXPONENTS: RangeInclusive<f64> = 1.1..=100.0;

/// Semi-axes that are allowed, in any unit.
const SEMI_AXES: RangeInclusive<f64> = 1e-100..=1e100;

/// How many times the least semi-axis the largest may be.
const LARGEST_ASPECT: f64 = 1e6;

/// The convex body
///
/// ```text
/// (|x/a|^n2 + |y/b|^n2)^(n1/n2) + |z/c|^n1 <= 1
/// ```
///
/// about the origin (Barr 1981). n1 = n2 = 2 is an ellipsoid, n1 > n2 = 2 nearly a cylinder, n1 = n2 > 2 nearly a
/// box. Each octant may have numbers of its own as far as neighbours meet without steps: a by the sign of x, b by
/// that of y, c and n1 by that of z, n2 by those of x and y. These are the 12 numbers of [`Self::poly12`]; normals
/// are then continuous and the body is convex, but curvature jumps at the coordinate planes.
///
/// Where an exponent is above 2 the surface is flat at the coordinate planes that part its terms (a curvature is
/// zero there), where it is below 2 a curvature is infinite there, and the one beside it is told.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Superquadric {
    semi_axes: [[f64; 2]; 3],
    n1: [f64; 2],
    n2: [[f64; 2]; 2],
}

/// Why numbers make no superquadric.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum InvalidSuperquadric {
    /// A semi-axis is out of range.
    #[error("a semi-axis is {value}; semi-axes must be above zero and within 1e6 of each other")]
    SemiAxis {
        /// The value given.
        value: f64,
    },
    /// An exponent is out of range.
    #[error("an exponent is {value}; exponents must be from {} to {}", EXPONENTS.start(), EXPONENTS.end())]
    Exponent {
        /// The value given.
        value: f64,
    },
    /// More parts than any fit makes.
    #[error("{found} superquadrics; at most {most} are read")]
    TooManyParts {
        /// Parts given.
        found: usize,
        /// The most allowed.
        most: usize,
    },
    /// A union of no parts.
    #[error("a union needs at least one part")]
    NoParts,
    /// A frame of a part is not a right-handed, orthonormal frame of finite numbers.
    #[error(
        "the axes of part {part} are not orthonormal and right-handed, or its centre is not finite"
    )]
    Frame {
        /// Index of the part.
        part: usize,
    },
    /// A part touches no other that hangs together with the first.
    #[error(
        "part {part} of the union (the first is 0) lies apart from the others: a grain is one body"
    )]
    Apart {
        /// Index of the part.
        part: usize,
    },
    /// The union does not hold its origin.
    #[error("the centre of the union lies in none of its parts")]
    OriginOutside,
}

/// One octant.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Octant {
    /// Semi-axes.
    pub(crate) axes: [f64; 3],
    /// The exponent of z.
    pub(crate) n1: f64,
    /// The exponent of x and y.
    pub(crate) n2: f64,
    /// 1 or -1 along x, y, z.
    pub(crate) signs: [f64; 3],
}

/// By how much an exponent may be below two for curvatures not to grow to twice as much within the range of a number.
const ROUND: f64 = 1e-3;

impl Superquadric {
    /// One set of numbers for all octants: semi-axes a, b, c and exponents n1, n2.
    ///
    /// # Errors
    /// [`InvalidSuperquadric`] if semi-axes or exponents are out of range.
    pub fn single(semi_axes: [f64; 3], n1: f64, n2: f64) -> Result<Self, InvalidSuperquadric> {
        Self::poly8(semi_axes.map(|axis| [axis; 2]), n1, n2)
    }

    /// Six semi-axes, a, b, c on the positive and on the negative side, and exponents of all octants: the
    /// poly-superquadric of Wang, Marmysh and Ji (2020).
    ///
    /// # Errors
    /// As [`Self::single`].
    pub fn poly8(semi_axes: [[f64; 2]; 3], n1: f64, n2: f64) -> Result<Self, InvalidSuperquadric> {
        Self::poly12(semi_axes, [n1; 2], [[n2; 2]; 2])
    }

    /// As many free numbers as octants that meet without steps can have: n1 on either side of z = 0, n2 by the side
    /// of x, then of y; the positive side first.
    ///
    /// # Errors
    /// As [`Self::single`].
    pub fn poly12(
        semi_axes: [[f64; 2]; 3],
        n1: [f64; 2],
        n2: [[f64; 2]; 2],
    ) -> Result<Self, InvalidSuperquadric> {
        let axes = semi_axes.as_flattened();
        let longest = axes.iter().copied().fold(0.0, f64::max);
        // Written so that NaN fails.
        let is_axis = |x: f64| SEMI_AXES.contains(&x) && x * LARGEST_ASPECT >= longest;
        if let Some(&value) = axes.iter().find(|&&x| !is_axis(x)) {
            return Err(InvalidSuperquadric::SemiAxis { value });
        }
        let mut exponents = n1.iter().chain(n2.as_flattened());
        if let Some(&value) = exponents.find(|n| !EXPONENTS.contains(n)) {
            return Err(InvalidSuperquadric::Exponent { value });
        }
        Ok(Self { semi_axes, n1, n2 })
    }

    /// Semi-axes a, b, c, each on the positive and on the negative side.
    pub fn semi_axes(&self) -> [[f64; 2]; 3] {
        self.semi_axes
    }

    /// The exponent n1 on the positive and on the negative side of z.
    pub fn n1(&self) -> [f64; 2] {
        self.n1
    }

    /// The exponent n2 by the side of x, then of y.
    pub fn n2(&self) -> [[f64; 2]; 2] {
        self.n2
    }

    /// Whether the larger and the smaller principal curvature grow without bound somewhere: across a plane of coordinates with an
    /// exponent n one goes as the distance to the power n - 2, and where n1 is below two both do so at the end of z.
    pub(crate) fn unbounded_curvatures(&self) -> [bool; 2] {
        let is_edged = |n: &f64| *n < 2.0 - ROUND;
        let at_ends = self.n1.iter().any(is_edged);
        [
            at_ends || self.n2.as_flattened().iter().any(is_edged),
            at_ends,
        ]
    }

    /// The body, so many times as large.
    #[must_use]
    pub fn times(&self, factor: f64) -> Self {
        Self {
            semi_axes: self.semi_axes.map(|sides| sides.map(|axis| axis * factor)),
            ..*self
        }
    }

    /// How many numbers make it: 5, 8 or 12.
    pub fn number_count(&self) -> usize {
        match (self.is_single(), self.has_common_exponents()) {
            (true, _) => 5,
            (false, true) => 8,
            (false, false) => 12,
        }
    }

    /// Whether all octants are alike.
    pub fn is_single(&self) -> bool {
        let alike = |sides: &[f64; 2]| sides[0] == sides[1];
        self.semi_axes.iter().all(alike) && self.has_common_exponents()
    }

    /// Whether all octants have the same exponents.
    pub fn has_common_exponents(&self) -> bool {
        let n2 = self.n2.as_flattened();
        self.n1[0] == self.n1[1] && n2.iter().all(|n| *n == n2[0])
    }

    /// The octant of a vector.
    #[inline(always)]
    pub(crate) fn octant(&self, x: [f64; 3]) -> Octant {
        let side = x.map(|x| usize::from(x < 0.0));
        let [i, j, k] = side;
        let [a, b, c] = &self.semi_axes;
        Octant {
            axes: [a[i], b[j], c[k]],
            n1: self.n1[k],
            n2: self.n2[i][j],
            signs: x.map(|x| 1_f64.copysign(x)),
        }
    }

    /// All octants.
    pub(crate) fn octants(&self) -> impl Iterator<Item = Octant> {
        let sign = |i: u8, bit: u8| if i & bit == 0 { 1.0 } else { -1.0 };
        (0..8).map(move |i| self.octant([sign(i, 1), sign(i, 2), sign(i, 4)]))
    }

    /// The semi-axes of an ellipsoid; `None` of other bodies.
    #[inline]
    pub(crate) fn ellipsoid(&self) -> Option<[f64; 3]> {
        let is_ellipsoid = self.is_single() && self.n1[0] == 2.0 && self.n2[0][0] == 2.0;
        is_ellipsoid.then(|| self.semi_axes.map(|[axis, _]| axis))
    }

    /// The largest distance of a point of the body from the origin.
    pub fn bounding_radius(&self) -> f64 {
        self.octants()
            .map(|octant| {
                let [a, b, c] = octant.axes;
                farthest(farthest(a, b, octant.n2), c, octant.n1)
            })
            .fold(0.0, f64::max)
    }
}

/// The largest distance from the origin of a point of |x/a|^n + |y/b|^n = 1.
fn farthest(a: f64, b: f64, n: f64) -> f64 {
    match n > 2.0 {
        true => Slopes::new(a, b, 2.0 * n / (n - 2.0) - 1.0).norm,
        false => a.max(b),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::StarSurface;
    use approx::assert_relative_eq;
    use nalgebra::Vector3;

    #[test]
    fn the_bounding_sphere_touches() {
        for (axes, n1, n2) in [
            ([1.0, 1.0, 1.0], 8.0, 8.0),
            ([3.0, 2.0, 1.0], 2.0, 5.0),
            ([1.0, 2.0, 3.0], 6.0, 1.5),
            ([1.0, 2.0, 1.0], 1.5, 3.0),
        ] {
            let body = Superquadric::single(axes, n1, n2).unwrap();
            let mut largest = 0.0_f64;
            for i in 0..=400 {
                for j in 0..=400 {
                    let (theta, phi) = (f64::from(i) / 800.0, f64::from(j) / 800.0);
                    let (sin, cos) = (theta * std::f64::consts::PI).sin_cos();
                    let (y, x) = (phi * std::f64::consts::PI).sin_cos();
                    let n = Vector3::new(sin * x, sin * y, cos).normalize();
                    largest = largest.max(body.radius(&n));
                }
            }
            let bound = body.bounding_radius();
            assert!(largest <= bound * (1.0 + 1e-12));
            assert_relative_eq!(largest, bound, max_relative = 1e-4);
        }
        let cube = Superquadric::single([1.0; 3], 8.0, 8.0).unwrap();
        assert_relative_eq!(cube.bounding_radius(), 1.510, epsilon = 5e-4);
    }

    #[test]
    fn numbers_out_of_range_are_refused() {
        for axis in [0.0, -1.0, f64::NAN, f64::INFINITY, 1e-7] {
            assert!(Superquadric::single([1.0, 1.0, axis], 2.0, 2.0).is_err());
        }
        for exponent in [1.0, 101.0, f64::NAN] {
            assert!(Superquadric::single([1.0; 3], exponent, 2.0).is_err());
            assert!(Superquadric::single([1.0; 3], 2.0, exponent).is_err());
        }
    }
}
