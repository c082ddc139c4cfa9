//! The faces of a scan where they are fitted: about their centroid, along their principal axes, and so large that the ball of
//! equal volume has the radius 1.

use super::cloud::Cloud;
use super::map::Coarse;
use super::voxels::Voxels;
use crate::fit::crust::{surface_of_points, without_alone};
use crate::fit::error::FitError;
use crate::fit::points::repeated::without_repeats;
use crate::fit::prepare::{
    Reference, ReferenceKind, closed_by_faces, principal_axes, scanned_surface, seen, semi_axes,
    usable,
};
use crate::fit::warning::FitWarning;
use crate::measure::{Scale, equivalent_radius, mesh_properties};
use crate::mesh::{Mesh, keep_vertices};
use crate::model::Frame;
use crate::scan::{Scan, are_two_grains};
use nalgebra::{Matrix3, Point3, Vector3};
use std::borrow::Cow;

/// Closed faces in their own place and size, and the way back to the scan.
pub(super) struct LocalFaces {
    pub(super) mesh: Mesh,
    /// The scan's points, if the faces are only near them.
    points: Option<Vec<Vector3<f64>>>,
    /// Of the ellipsoid of equal moments.
    semi_axes: Vector3<f64>,
    /// From one voxel to the next, if the points are the middles between some.
    steps: Option<Matrix3<f64>>,
    /// Centroid and principal axes, in the scan's unit.
    pub(super) frame: Frame,
    /// Of the ball of equal volume, in the scan's unit.
    pub(super) radius: f64,
    /// Area and volume of the faces, in the scan's unit.
    pub(super) reference: Reference,
    pub(super) warnings: Vec<FitWarning>,
}

impl LocalFaces {
    /// # Errors
    /// [`FitError`] if the faces are not closed, or if they or the points enclose nothing.
    pub(super) fn new(scan: &Scan) -> Result<Self, FitError> {
        let Faces {
            mesh,
            points,
            kind,
            mut warnings,
        } = faces(scan)?;
        let scale = Scale::of(&mesh);
        let at_unit = scale.mesh(&mesh);
        let Ok(properties) = mesh_properties(&at_unit) else {
            return Err(FitError::NoVolume);
        };
        if properties.volume.is_nan() || properties.volume <= 0.0 {
            return Err(FitError::NoVolume);
        }
        let size = equivalent_radius(properties.volume);
        let at_unit_frame = Frame {
            centre: properties.centroid,
            axes: principal_axes(&at_unit, &properties),
        };
        let semi_axes = semi_axes(&properties, &at_unit_frame);
        let is_filled = |warning: &FitWarning| matches!(warning, FitWarning::Filled(_));
        if kind == ReferenceKind::Faces && !warnings.iter().any(is_filled) {
            let seen = seen(&at_unit, &at_unit_frame, &semi_axes);
            warnings.extend(closed_by_faces(&at_unit, &seen));
        }
        let place = |point: &Point3<f64>| at_unit_frame.to_local(point) / size;
        let points = points.map(|vertices| {
            let points = Mesh {
                vertices,
                triangles: Vec::new(),
            };
            scale.mesh(&points).vertices.iter().map(place).collect()
        });
        let vertices = at_unit.vertices.iter().map(place);
        let radius = size * scale.length;
        Ok(Self {
            points,
            semi_axes: semi_axes / size,
            steps: scan
                .voxel_lattice()
                .map(|lattice| at_unit_frame.axes.tr_mul(&lattice.steps) / radius),
            frame: Frame {
                centre: scale.point(&at_unit_frame.centre),
                ..at_unit_frame
            },
            radius,
            reference: Reference {
                kind,
                area: scale.area(properties.area),
                volume: scale.volume(properties.volume),
                bulge: 0.0,
            },
            warnings,
            mesh: Mesh {
                vertices: vertices.map(Point3::from).collect(),
                triangles: at_unit.triangles,
            },
        })
    }

    /// What is fitted, from the places of the vertices on the sphere.
    pub(super) fn cloud(&self, directions: Vec<Vector3<f64>>) -> Cloud<'_> {
        let mut cloud = match &self.points {
            Some(points) => Cloud::of_points(&self.mesh, directions, points.clone()),
            None => Cloud::new(&self.mesh, directions),
        };
        cloud.semi_axes = self.semi_axes;
        cloud.voxels = self.steps.as_ref().and_then(Voxels::new);
        cloud
    }

    /// The same of some of the vertices.
    pub(super) fn coarse_cloud<'a>(&self, coarse: &'a Coarse) -> Cloud<'a> {
        let mut cloud = Cloud::new(&coarse.mesh, coarse.places.clone());
        cloud.semi_axes = self.semi_axes;
        cloud
    }

    /// Whether the faces are only near the points that are fitted.
    pub(super) fn are_of_points(&self) -> bool {
        self.points.is_some()
    }

    /// A place in the scan's frame and unit.
    pub(super) fn to_scan(&self, place: &Vector3<f64>) -> Point3<f64> {
        self.frame.to_scan(&(place * self.radius))
    }
}

/// The faces that are mapped to the sphere.
struct Faces {
    mesh: Mesh,
    /// The scan's points, if the faces are only near them.
    points: Option<Vec<Point3<f64>>>,
    kind: ReferenceKind,
    warnings: Vec<FitWarning>,
}

/// The scan's own faces, or of points without any those of their crust: where there is none, of all but the points that stand alone.
fn faces(scan: &Scan) -> Result<Faces, FitError> {
    if scan.topology.is_none() {
        usable(scan)?;
        let (points, repeated) = without_repeats(Cow::Borrowed(&scan.points));
        let neck = are_two_grains(&points).then_some(FitWarning::Neck);
        let mut warnings: Vec<FitWarning> = repeated.into_iter().chain(neck).collect();
        let (mesh, points) = match surface_of_points(&points) {
            Ok(mesh) => (mesh, points.into_owned()),
            Err(error) => {
                let Some(kept) = without_alone(&points) else {
                    return Err(error);
                };
                let mesh = surface_of_points(&kept).map_err(|_| error)?;
                let outliers = points.len() - kept.len();
                warnings.push(FitWarning::Outliers { outliers });
                (mesh, kept)
            }
        };
        return Ok(Faces {
            mesh,
            points: Some(points),
            kind: ReferenceKind::Crust,
            warnings,
        });
    }
    let surface = scanned_surface(scan)?;
    match surface.kind {
        ReferenceKind::Faces | ReferenceKind::Voxels => Ok(Faces {
            mesh: compact(&surface.mesh),
            points: None,
            kind: surface.kind,
            warnings: surface.warnings,
        }),
        _ => Err(FitError::NoFaces),
    }
}

/// The mesh without the vertices that no triangle names.
fn compact(mesh: &Mesh) -> Mesh {
    let mut is_used = vec![false; mesh.vertices.len()];
    for &corner in mesh.triangles.as_flattened() {
        is_used[corner as usize] = true;
    }
    let mut compact = mesh.clone();
    keep_vertices(&mut compact.vertices, &mut compact.triangles, &is_used);
    compact
}
