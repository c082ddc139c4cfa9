//! Mass properties of a grain that is a union of superquadrics.

use super::single::SolidProperties;
use super::union::union_properties;
use crate::measure::MassProperties;
use crate::model::{Frame, SuperquadricGrain, Surface};

/// Relative error of area, volume and moments that is asked for.
const TOLERANCE: f64 = 1e-5;

/// Mass properties of a union of superquadrics, in the scan's frame, and how well they are known: closed forms of a single
/// one, and of several by quadrature over what is bare of each, whether a centre sees it or not.
pub fn solid_properties(grain: &SuperquadricGrain) -> SolidProperties {
    union_properties(grain.body(), TOLERANCE).placed(&grain.frame())
}

impl SolidProperties {
    /// The same of the body placed in a frame.
    pub(super) fn placed(self, frame: &Frame) -> Self {
        let own = self.properties;
        Self {
            properties: MassProperties {
                centroid: frame.to_scan(&own.centroid.coords),
                inertia: frame.axes * own.inertia * frame.axes.transpose(),
                ..own
            },
            ..self
        }
    }
}
