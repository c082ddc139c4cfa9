//! Whether the polyhedron through the points contradicts what was fitted to them.

use crate::fit::outcome::Fitted;
use crate::fit::prepare::ReferenceKind;
use crate::fit::warning::FitWarning;
use crate::measure::{MassProperties, extents_of_points};
use crate::model::{Contradicted, NoStandardErrors, Surface, Unseen};

/// By how much area or volume may differ from those of the polyhedron through the points that a surface was fitted to. With
/// standard errors, of 28 scans of grains and stones it is 1.8 % and 2.6 % at most; without, of cones, boxes and the like
/// 3.5 %, and 6 to 80 % where the surface ripples between slivers or sparse points and on thin plates.
const LARGEST_DIFFERENCE: f64 = 0.05;

/// By how much a polyhedron through points without faces may be smaller than the body: this share over the number of
/// points. Of a ball in even points it is 3.6 of the area and 7 of the volume, of barley kernels in random ones up to 50.
const SAG: f64 = 50.0;

/// Standard errors of a figure that vouch for a larger difference from closed faces.
const VOUCHING: f64 = 4.0;

/// By how much the area may be larger than that of the polyhedron through points without faces, and the surface may reach beyond
/// these, as a share, whatever vouches for it.
const WILD: f64 = 0.3;

/// Share by which area or volume may be larger than those of closed faces, without a known error, before it is told.
const TOLD: f64 = 0.01;

/// Cells along the edge of a cube of the mesh by which a surface's reach is told.
const RESOLUTION: usize = 32;

impl Fitted {
    /// The same, of whose grain it is known what the polyhedron contradicts.
    pub(in crate::fit) fn beside_polyhedron(mut self) -> Self {
        let is_closed = self.grain.unseen().is_none();
        let may_contradict = match self.reference.kind {
            ReferenceKind::Faces | ReferenceKind::Voxels => true,
            ReferenceKind::Directions => self.posterior.is_some(),
            ReferenceKind::Crust => false,
        };
        if is_closed && may_contradict {
            if let Some(hole) = self.guessed_hole() {
                self.grain = self.grain.with_unseen(Some(hole));
                return self;
            }
            let contradicted = self.contradicted();
            self.grain = self.grain.with_contradicted(contradicted);
            let beyond = self.beyond_faces().or_else(|| self.beyond_points());
            self.warnings.extend(beyond);
        }
        self
    }

    /// Tells of a surface that is larger than closed faces by an amount that no error explains: between corners of coarse faces it
    /// may ripple.
    fn beyond_faces(&self) -> Option<FitWarning> {
        let is_of_faces = self.reference.kind == ReferenceKind::Faces;
        (is_of_faces && self.grain.contradicted().is_none()).then_some(())?;
        let survey = self.survey();
        let told = survey.properties().ok()?;
        let [area, volume] = [
            told.area / self.reference.area - 1.0,
            told.volume / self.reference.volume - 1.0,
        ];
        (area.max(volume) > TOLD).then_some(())?;
        let errors = self.errors_of_points(&told, &survey.dimensions().ok()?);
        matches!(errors, Err(NoStandardErrors::Unresolved { .. }))
            .then_some(FitWarning::BeyondFaces { area, volume })
    }

    /// Tells of a surface that hides edges and reaches beyond the points: beside edges it ripples.
    fn beyond_points(&self) -> Option<FitWarning> {
        let points = self.edged.as_deref()?;
        let survey = self.survey();
        let dimensions = survey.dimensions().ok()?;
        let of_points = extents_of_points(points, &survey.dimension_axes().ok()?);
        let is_beyond = (0..3).any(|i| dimensions[i] > (1.0 + TOLD) * of_points[i]);
        is_beyond.then_some(FitWarning::BeyondPoints {
            dimensions,
            of_points,
        })
    }

    /// A hole over which the surface is a guess, though few points in it made it seem several that chance leaves: area or volume
    /// differ from those of the polyhedron that closes it, as those of a lentil do whose underside shows in specks.
    fn guessed_hole(&self) -> Option<Unseen> {
        let survey = self.survey();
        let told = survey.properties().ok()?;
        self.beyond(&told)?;
        match self.errors_of_points(&told, &survey.dimensions().ok()?) {
            Err(NoStandardErrors::Hole { half_angle }) => Unseen::hole(half_angle, self.points),
            _ => None,
        }
    }

    /// By how much area above, and by how much volume differ from those of the polyhedron.
    fn differences(&self, told: &MassProperties) -> [f64; 2] {
        let area = told.area - self.reference.area;
        let shown = match self.reference.kind {
            ReferenceKind::Faces => area,
            // Steps make what is drawn between voxels larger than the body, and so does noise between points.
            _ => area.max(0.0),
        };
        [shown, told.volume - self.reference.volume]
    }

    /// By how much they may differ, as a share.
    fn largest_difference(&self) -> f64 {
        let sag = match self.reference.kind.has_faces() {
            true => 0.0,
            false => SAG / self.points as f64,
        };
        LARGEST_DIFFERENCE + sag
    }

    /// What differs by more.
    fn beyond(&self, told: &MassProperties) -> Option<Contradicted> {
        let [area, volume] = self.differences(told);
        let shares = [area / self.reference.area, volume / self.reference.volume];
        Contradicted::beyond(self.largest_difference(), shares)
    }

    fn contradicted(&self) -> Option<Contradicted> {
        let survey = self.survey();
        let told = survey.properties().ok()?;
        let has_faces = self.reference.kind.has_faces();
        let found = self.beyond(&told)?;
        let [area, volume] = self.differences(&told);
        let is_vouched = match self.errors_of_points(&told, &survey.dimensions().ok()?) {
            Ok(errors) if has_faces => {
                let is_area = found.area.is_none() || area <= VOUCHING * errors.area;
                let is_volume = found.volume.is_none() || volume.abs() <= VOUCHING * errors.volume;
                is_area && is_volume
            }
            // Between points in few rows a surface may go anywhere, and beside the few on the rim of a plate; no error tells it.
            _ if !has_faces && area > WILD * self.reference.area => false,
            _ if !has_faces && self.reaches_beyond(self.largest_difference()) => false,
            Ok(_) => true,
            // Where there is another reason, a polyhedron between points may be as wrong.
            Err(reason) => !has_faces && !matches!(reason, NoStandardErrors::Unresolved { .. }),
        };
        (!is_vouched).then_some(found)
    }

    /// Whether the surface reaches farther from its centre than all points do, by more than this share, and not in a gap, or anywhere
    /// by more than any gap explains.
    fn reaches_beyond(&self, share: f64) -> bool {
        let frame = self.grain.frame();
        let vertices = self.grain.mesh(RESOLUTION).vertices.into_iter();
        let rays = vertices.map(|vertex| frame.to_local(&vertex));
        let farthest = rays.max_by(|one, other| one.norm().total_cmp(&other.norm()));
        self.posterior
            .as_ref()
            .zip(farthest)
            .is_some_and(|(estimate, farthest)| {
                let times = farthest.norm() / estimate.farthest_point();
                times > 1.0 + WILD || times > 1.0 + share && estimate.is_among_points(&farthest)
            })
    }
}

#[cfg(test)]
mod tests {
    use crate::fit::prepare::ReferenceKind;
    use crate::fit::{FitOptions, FitWarning, Fitted, fit};
    use crate::mesh::Mesh;
    use crate::model::{
        Family, NoStandardErrors, StandardErrors, StarGrain, StarSurface, Superquadric, Surface,
        Unseen, Whole,
    };
    use crate::scan::Scan;
    use crate::shapes::{Body, Sampling, SynthOptions, synthesize};
    use approx::assert_relative_eq;
    use nalgebra::{Point3, Vector3};
    use std::f64::consts::PI;

    /// The fit of a closed mesh, had its faces so many times the area and the volume.
    #[test]
    fn faces_contradict_what_no_error_explains_unless_noise_made_them_larger() {
        let mesh = Mesh::radial(12, |n| 1.0 + 0.2 * n.z);
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
        let fitted = fitted.beside_polyhedron();
        assert!(fitted.grain_with_errors().contradicted().is_some());
    }

    /// A ball without a cap of 55 degrees, as if points had lain there.
    #[test]
    fn a_hole_is_not_seen_where_the_polyhedron_that_closes_it_is_much_smaller() {
        let mut points = Sampling::Fibonacci.directions(2600, 0).unwrap();
        points.retain(|n| n.z > -f64::cos(55.0 * PI / 180.0));
        let scan = Scan::from_points(points.into_iter().map(Point3::from).collect());
        let mut fitted = fit(&scan, &FitOptions::default()).unwrap();
        let unseen = |fitted: &Fitted| match fitted.grain.unseen() {
            Some(Unseen::Hole { half_angle }) => half_angle.to_degrees(),
            _ => 0.0,
        };
        // From the centre of what is left.
        let about = 45.0..60.0;
        assert!(about.contains(&unseen(&fitted)), "{}", unseen(&fitted));
        fitted.grain = fitted.grain.with_unseen(None);
        let again = fitted.clone().beside_polyhedron();
        assert!(about.contains(&unseen(&again)), "{}", unseen(&again));
        let told = fitted.survey().properties().unwrap();
        (fitted.reference.area, fitted.reference.volume) = (told.area, told.volume);
        assert_eq!(unseen(&fitted.beside_polyhedron()), 0.0);
    }

    /// The faces cut off the edges of a brick.
    #[test]
    fn what_is_larger_than_closed_faces_and_has_no_error_is_told() {
        let brick = Superquadric::single([3.0, 2.0, 1.0], 20.0, 20.0).unwrap();
        let mesh = Mesh::radial(12, |n| brick.radius(n));
        let mut fitted = fit(&Scan::from_mesh(mesh).unwrap(), &FitOptions::default()).unwrap();
        let told = |warning: &FitWarning| match warning {
            FitWarning::BeyondFaces { area, volume } => *area > 0.02 && *volume > 0.02,
            _ => false,
        };
        assert!(fitted.warnings.iter().any(told), "{:?}", fitted.warnings);
        fitted.reference.area *= 1.02;
        fitted.reference.volume *= 1.02;
        assert_eq!(fitted.beyond_faces(), None);
        fitted.reference.area /= 1.02;
        fitted.errors = Some(Ok(StandardErrors::ZERO));
        assert_eq!(fitted.beyond_faces(), None);
        fitted.errors = None;
        fitted.reference.kind = ReferenceKind::Directions;
        assert_eq!(fitted.beyond_faces(), None);
    }

    /// Beside its edges the surface of a brick ripples.
    #[test]
    fn what_reaches_beyond_the_points_beside_edges_is_told_with_their_extents() {
        let sides = Vector3::new(2.0, 1.5, 1.0);
        let options = SynthOptions::clean(Body::Cuboid)
            .with_axes(sides)
            .with_points(3000)
            .with_sampling(Sampling::Random);
        let points = synthesize(&options).unwrap().points;
        let mut fitted = fit(&Scan::from_points(points), &FitOptions::default()).unwrap();
        let found = fitted.beyond_points().unwrap();
        assert!(fitted.warnings.contains(&found), "{:?}", fitted.warnings);
        let FitWarning::BeyondPoints {
            dimensions,
            of_points,
        } = found
        else {
            panic!("{found:?}");
        };
        assert_relative_eq!(dimensions, fitted.survey().dimensions().unwrap());
        assert_relative_eq!(of_points, 2.0 * sides, max_relative = 0.004);
        assert!(dimensions.x > 1.02 * of_points.x, "{dimensions}");
        let most = (0..3).map(|i| dimensions[i] / of_points[i]);
        let most = most.fold(0.0, f64::max);
        let points = fitted.edged.as_mut().unwrap();
        points.iter_mut().for_each(|point| *point *= most / 1.009);
        assert_eq!(fitted.beyond_points(), None);
        fitted.edged = None;
        assert_eq!(fitted.beyond_points(), None);
    }

    /// Few of the points that a centre sees lie on the rim of a plate.
    #[test]
    fn points_contradict_a_plate_that_reaches_far_beyond_them() {
        let disc = Superquadric::single([10.0, 10.0, 0.4], 6.0, 2.0).unwrap();
        let scan = synthesize(&SynthOptions::clean(disc).with_points(6146)).unwrap();
        let fitted = fit(&Scan::from_points(scan.points), &FitOptions::default()).unwrap();
        let found = fitted.grain.contradicted().unwrap();
        assert!(found.area.unwrap() > 0.1 && found.volume.unwrap() > 0.05);
        assert!(fitted.reaches_beyond(0.04) && !fitted.reaches_beyond(0.2));
    }

    /// No point lies within .4 radians of the axis; there a surface reaches farther than all of them, as from the end of a tube.
    #[test]
    fn a_gap_explains_a_surface_that_reaches_a_little_beyond_the_points_but_not_far() {
        let directions = Sampling::Fibonacci.directions(2000, 0).unwrap();
        let is_seen = |n: &&Vector3<f64>| n.z < 0.4_f64.cos();
        let ball = directions.iter().filter(is_seen).map(|n| (*n).into());
        let scan = Scan::from_points(ball.collect());
        let mut fitted = fit(&scan, &FitOptions::default()).unwrap();
        let frame = fitted.grain.frame();
        let axis = frame.axes.tr_mul(&Vector3::z());
        let mut reaches = |height: f64| {
            let [round, leaning] = [1.0, height / 3.0_f64.sqrt()].map(|x| x * (4.0 * PI).sqrt());
            let coefficients = vec![round, leaning * axis.y, leaning * axis.z, leaning * axis.x];
            let leaning = Family::Whole(Whole::new(coefficients).unwrap());
            fitted.grain = StarGrain::new(frame, leaning).unwrap().into();
            fitted.reaches_beyond(0.05)
        };
        assert!(!reaches(0.2) && reaches(0.5));
        // Whatever keeps it from errors.
        fitted.errors = Some(Err(NoStandardErrors::Neck));
        fitted.measured = None;
        assert!(fitted.contradicted().is_some());
    }

    #[test]
    fn points_contradict_a_larger_area_that_has_no_error_unless_they_are_few() {
        let mesh = Mesh::radial(8, |n| 1.0 + 0.2 * n.z);
        let scan = Scan::from_points(mesh.vertices);
        let mut fitted = fit(&scan, &FitOptions::default()).unwrap();
        fitted.reference.area *= 0.8;
        assert_eq!(fitted.contradicted(), None);
        fitted.errors = Some(Err(NoStandardErrors::Neck));
        assert_eq!(fitted.contradicted(), None);
        let kurtosis = 9.0;
        fitted.errors = Some(Err(NoStandardErrors::Unresolved { kurtosis }));
        assert!(fitted.contradicted().unwrap().area.is_some());
        fitted.points = 200;
        assert_eq!(fitted.contradicted(), None);
        fitted.points = 20_000;
        fitted.reference.area *= 2.0;
        assert_eq!(fitted.contradicted(), None);
    }
}
