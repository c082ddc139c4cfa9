//! Area, volume, centroid and inertia, and the moments they come from.

use crate::spread::principal;
use nalgebra::{Matrix3, Point3, Vector3};
use std::ops::{Add, AddAssign, Sub};

/// Area, volume, centroid and inertia of a solid of density one.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MassProperties {
    /// Surface area S, in the surface's unit squared.
    pub area: f64,
    /// Volume V, in the unit cubed.
    pub volume: f64,
    /// Centroid c = (1/V) ∫ x dV, in the unit and frame of the surface.
    pub centroid: Point3<f64>,
    /// Inertia tensor about the centroid, ∫ (|x - c|² I - (x - c)(x - c)ᵀ) dV, in the unit to the
    /// fifth power, along the axes of the surface's frame.
    pub inertia: Matrix3<f64>,
}

impl MassProperties {
    /// Principal moments of inertia and their axes; `None` when the inertia is not finite.
    pub fn principal(&self) -> Option<PrincipalInertia> {
        let (moments, axes) = principal(&self.inertia)?;
        Some(PrincipalInertia {
            moments,
            axes: right_handed(&axes, [0, 1]),
        })
    }
}

/// Principal moments of inertia, ascending, and the axes they belong to.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PrincipalInertia {
    /// Moments, ascending, in the unit to the fifth power: the first belongs to the long axis.
    pub moments: Vector3<f64>,
    /// Unit axes in the columns, in the order of the moments: a rotation. The largest component of
    /// the first and of the second axis is positive.
    pub axes: Matrix3<f64>,
}

/// Integrals over a surface and the solid inside it, about the origin of the frame they were
/// gathered in. Those of parts add up to those of the whole.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Moments {
    /// Area.
    pub area: f64,
    /// Volume.
    pub volume: f64,
    /// First moments ∫ x dV.
    pub first: Vector3<f64>,
    /// Second moments ∫ x xᵀ dV, symmetric.
    pub second: Matrix3<f64>,
}

impl Moments {
    /// Adds a part of a surface at x with the vector area A, along the outward normal, and the cone that it spans
    /// with the origin:
    ///
    /// ```text
    /// S = |A|             ∫ x dV   = x (x.A)/4
    /// V = (x.A)/3         ∫ xxᵀ dV = xxᵀ (x.A)/5
    /// ```
    ///
    /// Of a star-shaped surface these are r sqrt(r² + |g|²), r³/3, n r⁴/4 and nnᵀ r⁵/5 per solid angle
    /// (Radvilaite 2016, equations 2.27, 2.34 and 2.39–2.41, written with the direction `n`).
    pub fn add_element(&mut self, place: &Vector3<f64>, area: &Vector3<f64>) {
        let cone = place.dot(area);
        self.area += area.norm();
        self.volume += cone / 3.0;
        self.first += place * (cone / 4.0);
        self.second += place * place.transpose() * (cone / 5.0);
    }

    /// Adds the triangle `a b c`, counter-clockwise from outside, and the tetrahedron it spans with
    /// the origin: with d = a . (b x c) and s = a + b + c,
    ///
    /// ```text
    /// S = |(b - a) x (c - a)| / 2     ∫ x dV   = d/24 s
    /// V = d/6                         ∫ xxᵀ dV = d/120 (aaᵀ + bbᵀ + ccᵀ + ssᵀ)
    /// ```
    pub fn add_triangle(&mut self, a: &Vector3<f64>, b: &Vector3<f64>, c: &Vector3<f64>) {
        let d = a.dot(&b.cross(c));
        let s = a + b + c;
        let squares = [a, b, c, &s].map(|v| v * v.transpose());
        self.area += (b - a).cross(&(c - a)).norm() / 2.0;
        self.volume += d / 6.0;
        self.first += s * (d / 24.0);
        self.second += squares.iter().sum::<Matrix3<f64>>() * (d / 120.0);
    }

    /// Centroid and inertia about it, by the parallel-axis shift; `origin` is where the moments'
    /// own origin lies in the caller's frame. A zero volume gives a centroid that is not finite.
    pub fn about_centroid(&self, origin: &Point3<f64>) -> MassProperties {
        let centroid = self.first / self.volume;
        let central = self.second - centroid * self.first.transpose();
        MassProperties {
            area: self.area,
            volume: self.volume,
            centroid: origin + centroid,
            inertia: inertia(&central),
        }
    }
}

/// The inertia tensor of second moments. Of a needle a trace less one of its parts would cancel.
pub(crate) fn inertia(second: &Matrix3<f64>) -> Matrix3<f64> {
    let [x, y, z] = second.diagonal().into();
    let mut inertia = -second;
    inertia.set_diagonal(&Vector3::new(y + z, z + x, x + y));
    inertia
}

impl AddAssign for Moments {
    fn add_assign(&mut self, other: Self) {
        *self = *self + other;
    }
}

impl Add for Moments {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        Self {
            area: self.area + other.area,
            volume: self.volume + other.volume,
            first: self.first + other.first,
            second: self.second + other.second,
        }
    }
}

impl Sub for Moments {
    type Output = Self;

    fn sub(self, other: Self) -> Self {
        Self {
            area: self.area - other.area,
            volume: self.volume - other.volume,
            first: self.first - other.first,
            second: self.second - other.second,
        }
    }
}

/// Two columns of an orthonormal matrix, each with its largest component positive, and the third axis that makes a rotation
/// of them.
pub(in crate::measure) fn right_handed(axes: &Matrix3<f64>, columns: [usize; 2]) -> Matrix3<f64> {
    let [first, second] = columns.map(|i| {
        let axis = axes.column(i).into_owned();
        axis * axis[axis.iamax()].signum()
    });
    Matrix3::from_columns(&[first, second, first.cross(&second)])
}

/// Axes whose turn has a larger standard deviation, in radians, have no direction of their own: their moments differ
/// by less than 5 standard deviations of that difference, which is twice that of the entry between them.
const LARGEST_TURN: f64 = 0.1;

/// Whether two axes are told apart, by the standard deviation of the entry of the inertia tensor between them and the gap
/// between their moments.
pub(crate) fn are_apart(sd: f64, gap: f64) -> bool {
    sd < LARGEST_TURN * gap.abs()
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;
    use nalgebra::Rotation3;
    use proptest::prelude::*;

    fn with_inertia(inertia: Matrix3<f64>) -> MassProperties {
        MassProperties {
            area: 1.0,
            volume: 1.0,
            centroid: Point3::origin(),
            inertia,
        }
    }

    #[test]
    fn the_largest_component_of_the_first_two_axes_is_positive() {
        for turn in 0..12 {
            let turn = Rotation3::from_euler_angles(0.5 * f64::from(turn), 0.4, 0.7);
            let diagonal = Matrix3::from_diagonal(&Vector3::new(1.0, 2.0, 3.0));
            let inertia = turn.matrix() * diagonal * turn.matrix().transpose();
            let axes = with_inertia(inertia).principal().unwrap().axes;
            for axis in [axes.column(0), axes.column(1)] {
                assert_eq!(axis.amax(), axis.max(), "{axes}");
            }
        }
    }

    proptest! {
        #[test]
        fn principal_axes_are_a_sorted_rotation(
            angles in prop::array::uniform3(-3.0..3.0_f64),
            moments in prop::array::uniform3(0.1..10.0_f64),
        ) {
            let turn = Rotation3::from_euler_angles(angles[0], angles[1], angles[2]).into_inner();
            let inertia = turn * Matrix3::from_diagonal(&Vector3::from(moments)) * turn.transpose();
            let principal = with_inertia((inertia + inertia.transpose()) / 2.0).principal().unwrap();

            let mut sorted = moments;
            sorted.sort_by(f64::total_cmp);
            assert_relative_eq!(principal.moments, Vector3::from(sorted), epsilon = 1e-12);
            assert_relative_eq!(principal.axes.determinant(), 1.0, epsilon = 1e-12);
            let back = principal.axes * Matrix3::from_diagonal(&principal.moments)
                * principal.axes.transpose();
            assert_relative_eq!(back, inertia, epsilon = 1e-11);
        }
    }

    #[test]
    fn an_inertia_that_is_not_finite_has_no_axes() {
        assert!(
            with_inertia(Matrix3::from_element(f64::NAN))
                .principal()
                .is_none()
        );
    }
}
