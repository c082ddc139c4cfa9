//! Volume, area vector, middle and moment of what two bodies share, from the rims of its faces.

use super::clip::Segment;
use nalgebra::{Point3, UnitQuaternion, Vector3};
use std::ops::AddAssign;

/// Sums over the faces of what two bodies share, whose coordinates are seen from a point near it.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub(super) struct Sums {
    /// Its volume.
    pub(super) volume: f64,
    /// Integral of the place over it.
    pub(super) first: Vector3<f64>,
    /// Area of the first body's surface in the second, along its outward normal.
    pub(super) area: Vector3<f64>,
    /// Integral of place x normal over the same.
    pub(super) moment: Vector3<f64>,
}

impl Sums {
    /// Of what of one triangle lies inside, by the rim of that and a corner of the triangle.
    pub(super) fn of(rim: &[Segment], corner: Point3<f64>, is_of_first: bool) -> Self {
        let mut sums = Self::default();
        for [p, q] in rim {
            let [a, b, c] = [corner, *p, *q].map(|point| point.coords);
            let area = 0.5 * (b - a).cross(&(c - a));
            let middle = (a + b + c) / 3.0;
            // The tetrahedron from the origin.
            let volume = middle.dot(&area) / 3.0;
            sums.volume += volume;
            sums.first += 0.75 * volume * middle;
            if is_of_first {
                sums.area += area;
                sums.moment += middle.cross(&area);
            }
        }
        sums
    }

    /// Which of several is of the same region.
    pub(super) fn nearest<'a>(&self, others: &'a [Self]) -> Option<&'a Self> {
        let middle = |sums: &Self| sums.first / sums.volume;
        let apart = |other: &&Self| (middle(other) - middle(self)).norm();
        others
            .iter()
            .min_by(|one, other| apart(one).total_cmp(&apart(other)))
    }

    /// The same, turned about the origin.
    pub(super) fn turned(&self, turn: &UnitQuaternion<f64>) -> Self {
        Self {
            volume: self.volume,
            first: turn * self.first,
            area: turn * self.area,
            moment: turn * self.moment,
        }
    }

    /// What these and those of triangles twice as large say of triangles that are infinitely small.
    pub(super) fn extrapolated(&self, coarse: &Self) -> Self {
        let beyond = |fine: f64, coarse: f64| fine + (fine - coarse) / 3.0;
        Self {
            volume: beyond(self.volume, coarse.volume),
            first: self.first.zip_map(&coarse.first, beyond),
            area: self.area.zip_map(&coarse.area, beyond),
            moment: self.moment.zip_map(&coarse.moment, beyond),
        }
    }
}

impl AddAssign for Sums {
    fn add_assign(&mut self, other: Self) {
        self.volume += other.volume;
        self.first += other.first;
        self.area += other.area;
        self.moment += other.moment;
    }
}
