//! Whether the closed faces of a scan contradict what was fitted to them.

use super::outcome::Fitted;
use super::prepare::ReferenceKind;
use crate::model::Contradicted;

/// By how much area or volume may differ from those of the closed faces that a surface was fitted to. With standard
/// errors, of 28 scans of grains and stones it is 1.8 % and 2.6 % at most; without, of cones, boxes and the like 3.5 %,
/// and 9 to 80 % where the surface ripples between slivers and on thin plates.
const LARGEST_DIFFERENCE: f64 = 0.05;

/// Standard errors of a figure that vouch for a larger difference.
const VOUCHING: f64 = 4.0;

impl Fitted {
    /// The same, of whose grain it is known what the faces contradict.
    pub(super) fn beside_faces(mut self) -> Self {
        let is_closed = self.grain.unseen().is_none();
        if is_closed && self.reference.kind == ReferenceKind::Faces {
            self.properties = self.survey().unit_properties().ok().copied();
            let contradicted = self.contradicted();
            self.grain = self.grain.with_contradicted(contradicted);
        }
        self
    }

    fn contradicted(&self) -> Option<Contradicted> {
        let survey = self.survey();
        let told = survey.properties().ok()?;
        let area = told.area - self.reference.area;
        let volume = told.volume - self.reference.volume;
        let shares = [area / self.reference.area, volume / self.reference.volume];
        let found = Contradicted::beyond(LARGEST_DIFFERENCE, shares)?;
        let errors = self.standard_errors(&told, &survey.dimensions().ok()?);
        let is_vouched = errors.is_ok_and(|errors| {
            // Noise makes faces larger than what they are the faces of.
            let is_area = found.area.is_none() || area <= VOUCHING * errors.area;
            let is_volume = found.volume.is_none() || volume.abs() <= VOUCHING * errors.volume;
            is_area && is_volume
        });
        (!is_vouched).then_some(found)
    }
}

#[cfg(test)]
mod tests {
    use crate::fit::{FitOptions, fit};
    use crate::mesh::Mesh;
    use crate::scan::Scan;
    use approx::assert_relative_eq;

    /// The fit of a closed mesh, had its faces so many times the area and the volume.
    #[test]
    fn faces_contradict_what_no_error_explains_unless_noise_made_them_larger() {
        let mesh = Mesh::radial(8, |n| 1.0 + 0.2 * n.z);
        let mut fitted = fit(&Scan::from_mesh(mesh).unwrap(), &FitOptions::default()).unwrap();
        assert_eq!(fitted.grain.contradicted(), None);
        let own = fitted.reference;
        let mut beside = |area: f64, volume: f64| {
            fitted.reference.area = own.area * area;
            fitted.reference.volume = own.volume * volume;
            fitted.contradicted()
        };
        assert_eq!(beside(1.2, 0.97), None);
        let found = beside(0.8, 1.0).unwrap();
        assert_relative_eq!(found.area.unwrap(), 0.25, epsilon = 0.01);
        assert_eq!(found.volume, None);
        for volume in [0.9, 1.1] {
            let found = beside(1.0, volume).unwrap();
            let share = found.volume.unwrap();
            assert_relative_eq!(share, 1.0 / volume - 1.0, epsilon = 0.01);
            assert_eq!(found.area, None);
        }
        fitted.reference.area = 0.8 * own.area;
        fitted.reference.volume = own.volume;
        let fitted = fitted.beside_faces();
        assert!(fitted.grain_with_errors().contradicted().is_some());
    }
}
