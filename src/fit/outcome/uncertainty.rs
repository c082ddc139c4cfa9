//! How far the figures of a fitted grain may be off: what the points leave open, and what they cannot tell.

use super::figures::Figures;
use super::local_cells;
use super::samples::Samples;
use crate::fit::estimate::RadiusError;
use crate::fit::outcome::Fitted;
use crate::fit::prepare::ReferenceKind;
use crate::fit::warning::FitWarning;
use crate::measure::{MassProperties, Survey};
use crate::model::{Grain, NoStandardErrors, StandardErrors, Surface};
use crate::sphere::unit;
use nalgebra::Vector3;

/// Mean radius below which, or above the inverse of which, variances of moments, tenth powers of lengths, are no numbers.
const SMALLEST: f64 = 1e-25;

impl Fitted {
    /// Standard errors of the grain's mass properties and of its length, width and thickness, as a survey of it tells these,
    /// all in the scan's frame. Where much of the surface was not seen, they allow for what holes are known
    /// to hide, and of a scan with faces for what lies between these and a surface through their corners. Computed when
    /// asked for, unless the grain tells them.
    ///
    /// # Errors
    /// [`NoStandardErrors`] where none could be trusted.
    pub fn standard_errors(&self, survey: &Survey<'_>) -> Result<StandardErrors, NoStandardErrors> {
        let known = self.grain.standard_errors();
        if known != Err(NoStandardErrors::NotTold) {
            return known;
        }
        let figures = (survey.properties(), survey.dimensions(), survey.principal());
        let (Ok(told), Ok(dimensions), Ok(_)) = figures else {
            return Err(NoStandardErrors::OutOfRange);
        };
        let errors = self.errors_of_points(&told, &dimensions)?;
        let figures = self.figures(&told, &dimensions)?;
        let off = self.off_all_over(&told);
        let errors = errors
            .with_scale(off, &figures)
            .with_shift(off, &figures)
            .with_lack(self.smoothed_over(&told), &figures);
        match errors.is_sound() {
            true => Ok(errors),
            false => Err(NoStandardErrors::NotFinite),
        }
    }

    /// Shares of area and volume by which they differ from those of the scan's own closed faces, where part of these faces
    /// away and is smoothed over: of the area at most twice that part, for what faces away hides as much. A crack is
    /// bridged so: of a bean with one the area was 6 % too small.
    fn smoothed_over(&self, told: &MassProperties) -> [f64; 2] {
        let hidden = self.warnings.iter().find_map(|warning| match warning {
            FitWarning::NotStarShaped { share } => Some(2.0 * share),
            _ => None,
        });
        match hidden {
            Some(most) if self.reference.kind == ReferenceKind::Faces => {
                let off = |told: f64, own: f64| ((told - own) / told).abs().min(most);
                [
                    off(told.area, self.reference.area),
                    off(told.volume, self.reference.volume),
                ]
            }
            _ => [0.0; 2],
        }
    }

    /// Standard error of the size: of one factor on all lengths.
    fn off_all_over(&self, told: &MassProperties) -> f64 {
        let of_points = self.warnings.iter().map(|warning| match warning {
            FitWarning::Averaged { share, .. } => *share,
            // Either layer may be the grain.
            FitWarning::Layers { share, .. } => share / 2.0,
            _ => 0.0,
        });
        // Half a step outwards, all over.
        let outwards = self.step.unwrap_or(0.0) / 2.0 * told.area / (3.0 * told.volume);
        of_points.fold(self.beside_faces(told).hypot(outwards), f64::hypot)
    }

    /// The same for what lies between flat faces and a surface through their corners. Scanners put these on the surface, and the
    /// faces are too small a body; what thins meshes out keeps the faces about it, and puts the corners outside. The true volume is
    /// as likely to be anywhere in between, and the fit at one end: of quadric edge collapses it is about half-way, of meshes that
    /// keep their volume at the other end. Where faces are large, the fit is drawn to them, and a body that is smooth is larger by
    /// their bulge. Of faces that are not closed the polyhedron through their corners stands for them.
    fn beside_faces(&self, told: &MassProperties) -> f64 {
        let is_not_closed = |warning: &FitWarning| matches!(warning, FitWarning::FacesNotClosed(_));
        if self.reference.kind != ReferenceKind::Faces && !self.warnings.iter().any(is_not_closed) {
            return 0.0;
        }
        let larger = (told.volume - self.reference.volume).max(0.0) / 3.0_f64.sqrt();
        let smaller = self.reference.bulge / 3.0_f64.sqrt();
        larger.hypot(smaller) / told.volume / 3.0
    }

    /// The same as the points tell them.
    pub(super) fn errors_of_points(
        &self,
        told: &MassProperties,
        dimensions: &Vector3<f64>,
    ) -> Result<StandardErrors, NoStandardErrors> {
        if !(SMALLEST..1.0 / SMALLEST).contains(&self.mean_radius) {
            return Err(NoStandardErrors::OutOfRange);
        }
        if self.grain.contradicted().is_some() {
            return Err(NoStandardErrors::Contradicted);
        }
        if self.warnings.contains(&FitWarning::Neck) {
            return Err(NoStandardErrors::Neck);
        }
        if let Some(errors) = self.errors {
            return errors;
        }
        let figures = self.figures(told, dimensions)?;
        let posterior = self
            .posterior
            .as_ref()
            .ok_or(NoStandardErrors::NotEstimated)?;
        match self.grain.unseen() {
            Some(unseen) => {
                let beside = posterior.errors_beside_holes(&figures);
                Ok(unseen.errors(&figures, self.mean_radius, beside.ok()))
            }
            None => posterior.errors(&figures),
        }
    }

    /// The same figures along the grain's own axes.
    fn figures(
        &self,
        told: &MassProperties,
        dimensions: &Vector3<f64>,
    ) -> Result<Figures, NoStandardErrors> {
        let frame = self.grain.frame();
        let principal = told.principal().ok_or(NoStandardErrors::NotFinite)?;
        Ok(Figures {
            area: told.area,
            volume: told.volume,
            centroid: frame.to_local(&told.centroid),
            inertia: frame.axes.transpose() * told.inertia * frame.axes,
            moments: principal.moments,
            dimensions: *dimensions,
        })
    }

    /// The grain with its [standard errors](Self::standard_errors) and [those of its surface from place to
    /// place](crate::model::LocalErrors), which a file of it keeps, or why there are none. Nor are there any from place to place
    /// where the scan has a hole, over which they are those of a guess.
    pub fn grain_with_errors(&self) -> Grain {
        let survey = self.survey();
        let off = survey
            .properties()
            .map_or(0.0, |told| self.off_all_over(&told));
        let of_estimate = || {
            let posterior = self.posterior.as_ref()?;
            posterior.local_errors(self.grain.star()?)
        };
        let of_samples = || Some(self.samples.as_ref()?.local_errors(&self.grain));
        let of_points = || {
            let samples = Samples::on_surface(self.edged.as_ref()?, &self.grain);
            Some(samples.local_errors(&self.grain))
        };
        let told = self.standard_errors(&survey);
        let is_guessed = matches!(told, Err(NoStandardErrors::Hole { .. }));
        let squares = || of_estimate().or_else(of_samples).or_else(of_points);
        let squares = (!is_guessed).then(squares).flatten();
        let errors = squares.and_then(|squares| local_cells::errors(&squares, off, &self.grain));
        let grain = self.grain.clone().with_local_errors(errors);
        grain.with_standard_errors(told)
    }

    /// Standard deviations of the radius in directions of the scan's frame (vectors of any length but zero), in the scan's
    /// unit: of the surface, and of a new point of the same scan. `None` of fits to the points themselves.
    ///
    /// A call takes some 30 ms, of one direction as of a hundred, and 60 ms of ten thousand: ask for all at once.
    pub fn radius_errors(&self, directions: &[Vector3<f64>]) -> Option<Vec<RadiusError>> {
        let axes = self.grain.frame().axes;
        let local: Vec<Vector3<f64>> = directions.iter().map(|n| axes.tr_mul(&unit(n))).collect();
        let (posterior, grain) = (self.posterior.as_ref()?, self.grain.star()?);
        Some(posterior.radius_errors(grain, &local))
    }
}

#[cfg(test)]
mod tests {
    use super::{FitWarning, ReferenceKind};
    use crate::fit::{FitOptions, fit};
    use crate::measure::mesh_properties;
    use crate::mesh::Mesh;
    use crate::scan::Scan;
    use approx::assert_relative_eq;
    use std::f64::consts::PI;

    /// Of a mesh whose corners lie as far outside a body as its faces lie within it, errors are 3^-1/2 of twice what it is too
    /// large by: how far from the fit a volume is that may be anywhere between faces and fit.
    #[test]
    fn errors_hold_that_corners_may_lie_outside() {
        let mut mesh = Mesh::radial(12, |n| 1.0 + 0.2 * n.z);
        let truth = 4.0 / 3.0 * PI * 1.04;
        let faces = mesh_properties(&mesh).unwrap().volume;
        let scale = (2.0 * truth / (truth + faces)).cbrt();
        mesh.vertices.iter_mut().for_each(|vertex| *vertex *= scale);
        let errors = |scan: &Scan| {
            let fitted = fit(scan, &FitOptions::default()).unwrap();
            let survey = fitted.survey();
            let (told, dimensions) = (survey.properties().unwrap(), survey.dimensions().unwrap());
            let errors = fitted.standard_errors(&survey).unwrap();
            (told, dimensions, errors)
        };
        let cloud = Scan::from_points(mesh.vertices.clone());
        // One face twice, wound in opposite senses: what is enclosed cannot be told.
        let [a, b, c] = mesh.triangles[0];
        let mut tangled = mesh.clone();
        tangled.triangles.push([a, c, b]);
        let (told, dimensions, found) = errors(&Scan::from_mesh(mesh).unwrap());
        let (_, _, of_tangled) = errors(&Scan::from_mesh(tangled).unwrap());
        assert_relative_eq!(of_tangled.volume, found.volume, max_relative = 0.1);
        let too_large = told.volume / truth - 1.0;
        assert_relative_eq!(too_large, 3.0 * (scale - 1.0), max_relative = 0.02);
        let own = 2.0 * too_large / 3.0 / 3.0_f64.sqrt();
        // What the points leave open comes to it: next to nothing of the volume, more of lengths.
        let same = |error: f64, expected: f64| {
            let share = error / expected;
            assert!((0.98..1.5).contains(&share), "{share}");
        };
        assert_relative_eq!(found.volume, 3.0 * own * told.volume, max_relative = 0.02);
        same(found.area, 2.0 * own * told.area);
        let moments = told.principal().unwrap().moments;
        for i in 0..3 {
            same(found.moments[i], 5.0 * own * moments[i]);
            same(found.dimensions[i], own * dimensions[i]);
        }
        assert!(errors(&cloud).2.volume < 0.1 * found.volume);
    }

    #[test]
    fn errors_hold_what_faces_away_and_is_smoothed_over() {
        let mesh = Mesh::radial(12, |n| 1.0 + 0.2 * n.z);
        let mut fitted = fit(&Scan::from_mesh(mesh).unwrap(), &FitOptions::default()).unwrap();
        let survey = fitted.survey();
        let told = survey.properties().unwrap();
        assert_eq!(fitted.smoothed_over(&told), [0.0; 2]);
        let share = 0.03;
        fitted.warnings.push(FitWarning::NotStarShaped { share });
        fitted.reference.area = 1.02 * told.area;
        fitted.reference.volume = 0.9 * told.volume;
        let [area, volume] = fitted.smoothed_over(&told);
        assert_relative_eq!(area, 0.02, epsilon = 1e-12);
        assert_eq!(volume, 2.0 * share);
        fitted.reference.kind = ReferenceKind::Directions;
        assert_eq!(fitted.smoothed_over(&told), [0.0; 2]);
    }

    #[test]
    fn errors_hold_what_a_smooth_body_bulges_beyond_large_faces() {
        let mesh = Mesh::radial(12, |n| 1.0 + 0.2 * n.z);
        let mut fitted = fit(&Scan::from_mesh(mesh).unwrap(), &FitOptions::default()).unwrap();
        let told = fitted.survey().properties().unwrap();
        fitted.reference.volume = told.volume;
        assert_eq!(fitted.beside_faces(&told), 0.0);
        fitted.reference.bulge = 0.06 * told.volume;
        // The true volume is anywhere between, and lengths go with its third root.
        let expected = 0.02 / 3.0_f64.sqrt();
        assert_relative_eq!(fitted.beside_faces(&told), expected, max_relative = 1e-12);
    }
}
