//! Where a surface and the polyhedron through the points that it was fitted to disagree.

use serde::{Deserialize, Serialize};

/// Area and volume of a surface that the polyhedron through the points it was fitted to contradicts, the closed faces where
/// there are such, and that no standard error vouches for: by how much each is off, as a share. `None` is not contradicted.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
#[non_exhaustive]
pub struct Contradicted {
    /// Of the area.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub area: Option<f64>,
    /// Of the volume.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub volume: Option<f64>,
}

impl Contradicted {
    /// From the shares by which area and volume are off, and the largest that is told; `None` if both are told.
    pub(crate) fn beyond(largest: f64, [area, volume]: [f64; 2]) -> Option<Self> {
        let off = |share: f64| Some(share).filter(|share| share.abs() > largest);
        let found = Self {
            area: off(area),
            volume: off(volume),
        };
        (found.area.is_some() || found.volume.is_some()).then_some(found)
    }

    /// Whether its numbers can be those of a surface.
    pub(super) fn is_sound(&self) -> bool {
        [self.area, self.volume]
            .into_iter()
            .flatten()
            .all(|share| share.is_finite() && share > -1.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_off_by_more_than_is_told_to_either_side_is_contradicted() {
        let of = |area, volume| Some(Contradicted { area, volume });
        assert_eq!(Contradicted::beyond(0.1, [0.05, -0.1]), None);
        assert_eq!(
            Contradicted::beyond(0.1, [-0.2, 0.05]),
            of(Some(-0.2), None)
        );
        assert_eq!(Contradicted::beyond(0.1, [0.05, 0.2]), of(None, Some(0.2)));
    }

    #[test]
    fn no_figure_is_off_by_its_whole_size_or_more() {
        let is_sound = |area| {
            let volume = None;
            Contradicted { area, volume }.is_sound()
        };
        assert!(is_sound(None) && is_sound(Some(-0.99)) && is_sound(Some(3.0)));
        assert!(!is_sound(Some(-1.0)) && !is_sound(Some(f64::NAN)));
    }
}
