//! From the points of a scan to samples of the radius: reference surface, centre, axes.

mod averaged;
mod axes;
mod bin;
mod bulge;
mod by_direction;
mod centre;
mod facets;
mod islands;
mod largest;
mod layers;
mod left_out;
mod middle;
mod middles;
mod origin;
mod pieces;
mod reference;
mod representatives;
mod rod;
mod rows;
mod samples;
mod scanned;
mod strays;
mod subdivided;
mod surface;
mod thin;
mod together;
mod triangulated;
mod twins;

pub(crate) use axes::principal_axes;
pub(super) use facets::{closed_by_faces, seen};
pub use largest::largest_body;
#[cfg(feature = "cli")]
pub(crate) use largest::whole_or_largest;
pub(super) use layers::layers_beside;
pub(super) use middles::Middle;
pub(crate) use origin::Origin;
pub use reference::{Reference, ReferenceKind};
pub(crate) use samples::{CellGrid, Sample, Samples};
pub use scanned::ScannedSurface;
use surface::rod_surface;
pub use surface::scanned_surface;
pub(crate) use surface::usable;

use super::error::FitError;
use super::warning::FitWarning;
use crate::measure::{MassProperties, Scale, mesh_properties};
use crate::mesh::{Mesh, relaxed, solid_angle};
use crate::model::{Frame, Unseen};
use crate::scan::Scan;
use crate::sphere::Symmetry;
use bulge::bulge;
use centre::{deepest_centre, facing_away_share};
use facets::on_large_faces;
use middles::middles;
use nalgebra::{Matrix3, Point3, Vector3};
use std::borrow::Cow;
use std::f64::consts::PI;

/// Share of the area that may face away from the centre. The folds of real kernels (the crease of
/// barley, knapped stone) stay below 2 %; the inner side of a ring is 20 % or more.
const LARGEST_SHARE_AWAY: f64 = 0.05;

/// Share of the area that may face away from the centroid before another centre is looked for: a few
/// slivers of a noisy mesh.
const NEGLIGIBLE_SHARE: f64 = 1e-4;

/// Rounds in which the surface between voxels loses its steps before a centre looks at it.
const ROUNDS_OVER_STEPS: usize = 10;

/// A scan made ready to be fitted.
#[derive(Debug, Clone)]
pub struct PreparedScan<'a> {
    frame: Frame,
    /// The surface that fits are compared with.
    pub(crate) reference: Reference,
    /// Mean of the radius over all directions, as the triangles between the points tell it.
    pub(crate) mean_radius: f64,
    /// Semi-axes of the ellipsoid of equal second moments, along the grain's own axes.
    pub(crate) semi_axes: Vector3<f64>,
    /// The mirror planes that the axes were chosen for.
    pub(crate) symmetry: Symmetry,
    pub(crate) warnings: Vec<FitWarning>,
    /// What was not seen, if it is large.
    pub(crate) unseen: Option<Unseen>,
    /// Whether a fit whose errors are small tells of it all the same.
    pub(crate) may_be_known: bool,
    /// Whether faces are large, and not only beside those about them.
    pub(crate) has_large_faces: bool,
    /// The middles of its own large faces.
    pub(super) middles: Vec<Middle>,
    /// Whether it is fitted as a thin rod.
    pub(super) is_rod: bool,
    /// Of points that may be the centres of voxels, the mean distance from one to the next.
    pub(super) step: Option<f64>,
    points: Cow<'a, [Point3<f64>]>,
    representatives: Option<Vec<Point3<f64>>>,
}

impl<'a> PreparedScan<'a> {
    /// Finds the reference surface, the centre and the axes. With mirrors, the axes are the scan's own.
    ///
    /// # Errors
    /// [`FitError`] if the scan is not one closed surface round a centre.
    pub fn new(scan: &'a Scan, symmetry: Symmetry) -> Result<Self, FitError> {
        Self::of_surface(scan, scanned_surface(scan)?, symmetry)
    }

    /// The same of the points of a thin rod, whose sides rays graze: along them noise is many times as large as across, and
    /// neighbours in direction may be far from each other. `None` of all else.
    ///
    /// # Errors
    /// As [`Self::new`].
    pub(super) fn of_rod(scan: &'a Scan, symmetry: Symmetry) -> Result<Option<Self>, FitError> {
        let Some(surface) = rod_surface(scan)? else {
            return Ok(None);
        };
        let prepared = Self::of_surface(scan, surface, symmetry)?;
        Ok(Some(Self {
            is_rod: true,
            ..prepared
        }))
    }

    fn of_surface(
        scan: &Scan,
        mut surface: ScannedSurface<'a>,
        symmetry: Symmetry,
    ) -> Result<Self, FitError> {
        // Moments go with the fifth power of the size, and would be the first to leave the range of numbers.
        let scale = Scale::of(&surface.mesh);
        let mesh = scale.mesh(&surface.mesh);
        let properties = mesh_properties(&mesh)
            .ok()
            .filter(|properties| properties.volume > Scale::LEAST_VOLUME)
            .ok_or(FitError::NoVolume)?;
        // Steps of voxels face anywhere.
        let without_steps = scan
            .is_of_voxels()
            .then(|| relaxed(&mesh, ROUNDS_OVER_STEPS));
        let without_steps = without_steps.as_ref().unwrap_or(&mesh);
        let centre = star_centre(
            without_steps,
            properties.centroid,
            symmetry,
            &mut surface.warnings,
        )?;
        let frame = Frame {
            centre: scale.point(&centre),
            axes: match symmetry {
                Symmetry::NONE => principal_axes(&mesh, &properties),
                _ => Matrix3::identity(),
            },
        };
        let semi_axes = semi_axes(&properties, &frame) * scale.length;
        let of_faces = surface.seen_faces().map(|faces| {
            let seen = seen(faces, &frame, &semi_axes);
            let middles = match surface.kind {
                ReferenceKind::Faces => middles(faces, &seen, &frame.axes),
                _ => Vec::new(),
            };
            (on_large_faces(faces, &seen, &frame, &semi_axes), middles)
        });
        let (on_faces, middles) = of_faces.unwrap_or_default();
        surface.warnings.extend(on_faces.closing);
        let has_large_faces = on_faces.are_coarse;
        let bulge = if has_large_faces { bulge(&mesh) } else { 0.0 };
        let reference = Reference {
            kind: surface.kind,
            area: scale.area(properties.area),
            volume: scale.volume(properties.volume),
            bulge: scale.volume(bulge),
        };
        if !(reference.volume.is_normal() && reference.area.is_normal()) {
            return Err(FitError::Scale { size: scale.length });
        }
        if !on_faces.points.is_empty() {
            surface.points.to_mut().extend(&on_faces.points);
            if let Some(representatives) = &mut surface.representatives {
                representatives.extend(&on_faces.points);
            }
        }
        Ok(Self {
            mean_radius: mean_radius(&mesh, &centre, surface.kind) * scale.length,
            semi_axes,
            frame,
            reference,
            symmetry,
            warnings: surface.warnings,
            unseen: surface.unseen,
            may_be_known: surface.is_sparse || surface.is_many,
            has_large_faces,
            middles,
            is_rod: false,
            step: scan.step,
            points: surface.points,
            representatives: surface.representatives,
        })
    }

    /// Centre and axes.
    pub(crate) fn frame(&self) -> &Frame {
        &self.frame
    }

    /// The points to fit.
    pub(crate) fn points(&self) -> &[Point3<f64>] {
        &self.points
    }

    /// What an estimate of it is made from.
    pub(crate) fn origin(&self) -> Origin {
        match self.reference.kind {
            _ if self.has_large_faces => Origin::LargeFaces,
            ReferenceKind::Faces => Origin::Faces,
            _ => Origin::Points,
        }
    }

    /// Points of the scan that stand apart from their neighbours and are not fitted.
    pub(crate) fn strays(&self) -> usize {
        let of = |warning: &FitWarning| match warning {
            FitWarning::Strays { strays, .. } => *strays,
            _ => 0,
        };
        self.warnings.iter().map(of).sum()
    }

    /// Distinct samples of the radius in the grain's own frame, sorted by place.
    pub(crate) fn sorted_samples(&self) -> Samples {
        Samples::by_place(&self.points, &self.frame)
    }

    /// The same with more points.
    pub(crate) fn samples_and(&self, points: &[Point3<f64>]) -> Samples {
        Samples::by_place(&[&self.points[..], points].concat(), &self.frame)
    }

    /// Those of its points, in the cells of a grid.
    pub(crate) fn samples(&self, grid: &CellGrid) -> Samples {
        Samples::new(&self.points, &self.frame, grid)
    }

    /// Of a large cloud, one sample per patch of directions.
    pub(crate) fn probes(&self, grid: &CellGrid) -> Option<Samples> {
        let points = self.representatives.as_ref()?;
        Some(Samples::new(points, &self.frame, grid))
    }
}

/// The centroid if it sees the whole surface, else the centre on the mirror planes through it that sees most.
fn star_centre(
    mesh: &Mesh,
    centroid: Point3<f64>,
    symmetry: Symmetry,
    warnings: &mut Vec<FitWarning>,
) -> Result<Point3<f64>, FitError> {
    let mut centre = centroid;
    let mut share = facing_away_share(mesh, &centroid);
    if share > NEGLIGIBLE_SHARE {
        let mut deepest = deepest_centre(mesh, &centroid);
        for axis in symmetry.normals() {
            deepest[axis] = centroid[axis];
        }
        let deepest_share = facing_away_share(mesh, &deepest);
        if deepest_share < share {
            (centre, share) = (deepest, deepest_share);
        }
    }
    if share > LARGEST_SHARE_AWAY {
        return Err(FitError::NotStarShaped { share });
    }
    if share > NEGLIGIBLE_SHARE {
        warnings.push(FitWarning::NotStarShaped { share });
    }
    Ok(centre)
}

/// Semi-axes of the ellipsoid that has a body's second moments along the axes of a frame.
pub(crate) fn semi_axes(properties: &MassProperties, frame: &Frame) -> Vector3<f64> {
    let inertia = frame.axes.transpose() * properties.inertia * frame.axes;
    // Of an ellipsoid with semi-axes a_i, the integral of x_i^2 is V a_i^2 / 5.
    Vector3::from_fn(|i, _| {
        let second = 0.5 * inertia.trace() - inertia[(i, i)];
        (5.0 * second / properties.volume).sqrt()
    })
}

/// Mean of the radius over all directions: of each facet, weighted by the solid angle that it fills, that at its corners where
/// it lies between points, and over itself where it was seen.
fn mean_radius(mesh: &Mesh, centre: &Point3<f64>, kind: ReferenceKind) -> f64 {
    let of_facet = |corners: &[u32; 3]| {
        let corners = corners.map(|i| mesh.vertices[i as usize] - centre);
        match kind.has_faces() {
            true => integral(corners, MOST_CUTS),
            false => mean_norm(&corners) * solid_angle(corners),
        }
    };
    mesh.triangles.iter().map(of_facet).sum::<f64>() / (4.0 * PI)
}

/// How often a facet is cut in four, at most, until it is small beside its distance.
const MOST_CUTS: usize = 5;

/// The integral of the radius over the solid angle of a facet.
fn integral([a, b, c]: [Vector3<f64>; 3], cuts: usize) -> f64 {
    let middles = [(a + b) / 2.0, (b + c) / 2.0, (c + a) / 2.0];
    let size = (b - a).norm().max((c - b).norm()).max((a - c).norm());
    if cuts == 0 || 2.0 * size < mean_norm(&middles) {
        return mean_norm(&middles) * solid_angle([a, b, c]);
    }
    let [ab, bc, ca] = middles;
    let parts = [[a, ab, ca], [ab, b, bc], [ca, bc, c], [ab, bc, ca]];
    parts.map(|part| integral(part, cuts - 1)).iter().sum()
}

fn mean_norm(places: &[Vector3<f64>; 3]) -> f64 {
    places.iter().map(Vector3::norm).sum::<f64>() / 3.0
}

#[cfg(test)]
mod tests;
