//! Parts of the sphere with one expansion.

use super::bound::Bound;
use super::{Judged, Part, round};
use crate::sphere::AngleRectangle;
use nalgebra::Vector3;

/// A rectangle of angles, and the expansion there.
#[derive(Clone)]
pub(super) struct Patch<B, F> {
    pub(super) rectangle: AngleRectangle,
    pub(super) bound: B,
    pub(super) value: F,
}

impl<B: Bound + Clone, F: Fn(&Vector3<f64>) -> f64 + Clone> Part for Patch<B, F> {
    fn judge(&self, enough: f64) -> Judged {
        let least = self.bound.everywhere();
        if least >= enough {
            return Judged {
                least,
                value: None,
                work: 1,
            };
        }
        let (middle, radius) = round(&self.rectangle);
        let value = (self.value)(&middle);
        Judged {
            least: self.bound.within(&middle, radius, value),
            value: Some(value),
            work: self.bound.terms(),
        }
    }

    fn quarters(&self) -> Vec<Self> {
        let quarter = |rectangle| Self {
            rectangle,
            ..self.clone()
        };
        self.rectangle.quarters().map(quarter).into()
    }

    fn middle(&self) -> Vector3<f64> {
        round(&self.rectangle).0
    }
}
