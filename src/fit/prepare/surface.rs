//! The surface that a scan draws: a closed mesh through its points, by its own faces or by the
//! triangulation of their directions.

use super::left_out::told;
use super::middle::middle;
use super::reference::ReferenceKind;
use super::rod::rounder_of_rod;
use super::scanned::ScannedSurface;
use super::subdivided::made_by_subdivision;
use super::thin::{Thinned, WHOLE_CLOUD, select, thin};
use super::triangulated::from_directions;
use crate::fit::error::FitError;
use crate::fit::holes::Gap;
use crate::fit::points::without::without;
use crate::fit::warning::FitWarning;
use crate::measure::{
    FacesDefect, Fill, Scale, SelfCrossing, even_places, scanned_body, self_crossing, without_dust,
};
use crate::mesh::Mesh;
use crate::model::Unseen;
use crate::scan::{Scan, are_two_grains, voxels_have_neck};
use nalgebra::{Matrix3, Point3};
use std::borrow::Cow;
use std::ops::RangeInclusive;

/// Sizes beyond which volumes are no numbers.
const SIZES: RangeInclusive<f64> = 1e-100..=1e100;

/// Places of faces among which a neck is looked for.
const NECK_PLACES: usize = 4000;

/// Finds the surface that a scan draws: its own faces if they enclose one body, small holes closed, else the
/// triangulation of the directions of its points, without outliers, as seen from their mean.
///
/// # Errors
/// [`FitError`] if a point is not finite, if the points enclose no volume, if there are several bodies, or if
/// too many points do not lie on one surface round a centre.
pub fn scanned_surface(scan: &Scan) -> Result<ScannedSurface<'_>, FitError> {
    usable(scan)?;
    let mut surface = match &scan.topology {
        Some(topology) if topology.closed && topology.bodies == 1 => {
            from_faces(scan, &topology.unreferenced)
        }
        Some(_) => from_parts(scan),
        None => from_directions(Cow::Borrowed(&scan.points), None),
    }?;
    if surface.kind == ReferenceKind::Faces {
        let has_neck = match scan.is_of_voxels() {
            true => {
                surface.kind = ReferenceKind::Voxels;
                voxels_have_neck(&surface.points, scan.voxel_lattice())
            }
            false => faces_have_neck(&surface.mesh),
        };
        surface
            .warnings
            .extend(has_neck.then_some(FitWarning::Neck));
    }
    Ok(surface)
}

/// The same of points without faces that are those of a rod, seen in a space in which it is as wide as long. `None` of all else.
///
/// # Errors
/// As [`scanned_surface`].
pub(super) fn rod_surface(scan: &Scan) -> Result<Option<ScannedSurface<'_>>, FitError> {
    usable(scan)?;
    let map =
        rounder_of_rod(&scan.points, &middle(&scan.points)).filter(|_| scan.topology.is_none());
    let surface = map.map(|map| from_directions(Cow::Borrowed(&scan.points), Some(map)));
    surface.transpose()
}

/// Whether faces, taken for one body, have a neck between two grains.
fn faces_have_neck(mesh: &Mesh) -> bool {
    let places = even_places(mesh, NECK_PLACES).into_iter();
    let places: Vec<Point3<f64>> = places.map(|even| even.place.into()).collect();
    are_two_grains(&places)
}

/// Refuses points that can be those of no body: not finite, too far apart for numbers, or in a plane.
pub(crate) fn usable(scan: &Scan) -> Result<(), FitError> {
    if let Some(index) = scan
        .points
        .iter()
        .position(|p| !p.iter().all(|x| x.is_finite()))
    {
        return Err(FitError::NotFinite { index });
    }
    let first = scan.points.first().copied().unwrap_or_default();
    let size = scan
        .points
        .iter()
        .fold(0.0, |most: f64, p| most.max((p - first).amax()));
    if size > 0.0 && !SIZES.contains(&size) {
        return Err(FitError::Scale { size });
    }
    if scan.is_flat() {
        return Err(FitError::NoVolume);
    }
    Ok(())
}

/// Of faces that are closed and of one piece.
fn from_faces<'a>(scan: &'a Scan, unreferenced: &[u32]) -> Result<ScannedSurface<'a>, FitError> {
    let welded = scan.welded();
    let crossing = fitted_over(self_crossing(&welded))?;
    let used = scan.points.len() - unreferenced.len();
    let (mesh, points) = match welded.vertices.len() < used {
        // Every triangle has corners of its own.
        true => {
            let points = Cow::Owned(welded.vertices.clone());
            (welded, points)
        }
        false => {
            let mesh = Mesh {
                vertices: scan.points.clone(),
                triangles: scan.triangles.clone(),
            };
            let points = match unreferenced.is_empty() {
                true => Cow::Borrowed(scan.points.as_slice()),
                false => Cow::Owned(without(
                    &scan.points,
                    unreferenced.iter().map(|&index| index as usize),
                )),
            };
            (mesh, points)
        }
    };
    // Others number the vertices of the mesh differently.
    let (points, subdivided) = match points.len() == mesh.vertices.len() && !scan.is_of_voxels() {
        true => without_made(&mesh, points),
        false => (points, None),
    };
    Ok(ScannedSurface {
        warnings: crossing.into_iter().chain(subdivided).collect(),
        ..closed(mesh, points)
    })
}

/// The first vertices of a mesh without those that subdivision made.
fn without_made<'a>(
    mesh: &Mesh,
    points: Cow<'a, [Point3<f64>]>,
) -> (Cow<'a, [Point3<f64>]>, Option<FitWarning>) {
    let mut made = made_by_subdivision(mesh);
    made.retain(|at| *at < points.len());
    if made.is_empty() {
        return (points, None);
    }
    let warning = FitWarning::Subdivided {
        made: made.len(),
        points: points.len(),
    };
    (Cow::Owned(without(&points, made)), Some(warning))
}

/// A surface that goes through itself is told of, where it is by folds that hold next to nothing: those of noise are many, and a
/// fit goes between them.
fn fitted_over(crossing: Option<SelfCrossing>) -> Result<Option<FitWarning>, FitError> {
    match crossing.filter(SelfCrossing::hides_volume) {
        Some(crossing) => Err(FitError::SelfCrossing(crossing)),
        None => Ok(crossing.map(FitWarning::SelfCrossing)),
    }
}

/// A closed mesh, and those of its vertices that were seen.
fn closed(mesh: Mesh, points: Cow<'_, [Point3<f64>]>) -> ScannedSurface<'_> {
    let representatives = (points.len() > WHOLE_CLOUD).then(|| {
        let Thinned {
            representatives, ..
        } = thin(
            &points,
            &middle(&points),
            &Matrix3::identity(),
            f64::INFINITY,
        );
        select(&points, &representatives)
    });
    ScannedSurface {
        mesh,
        kind: ReferenceKind::Faces,
        faces: None,
        points,
        representatives,
        unseen: None,
        is_sparse: false,
        is_many: false,
        warnings: Vec::new(),
    }
}

/// Of faces with holes, or in several parts.
fn from_parts(scan: &Scan) -> Result<ScannedSurface<'static>, FitError> {
    let cleaned = without_dust(scan);
    let body = scanned_body(cleaned.as_ref().map_or(scan, |(cleaned, _)| cleaned));
    let Some(body) = body else {
        return from_directions(Cow::Owned(scan.points.clone()), None);
    };
    match (body.defect, body.bodies, body.cavities) {
        (Some(FacesDefect::Open { .. }), parts @ 2.., _) => {
            return Err(FitError::OpenParts { parts });
        }
        (Some(FacesDefect::Overlapping { parts: bodies }), _, _) | (_, bodies @ 2.., _) => {
            return Err(FitError::SeveralBodies { bodies });
        }
        (_, _, cavities @ 1..) => return Err(FitError::Hollow { cavities }),
        _ => {}
    }
    let crossing = fitted_over(body.crossing)?;
    let mut surface = match body.defect {
        None => filled(body.mesh, body.fill, scan.is_of_voxels()),
        Some(defect) => {
            let cloud = from_directions(Cow::Owned(body.mesh.vertices.clone()), None)?;
            let unseen = match defect {
                FacesDefect::Open { holes, share, .. } => Some(Unseen::Open { holes, share }),
                _ => cloud.unseen,
            };
            let mut warnings = cloud.warnings;
            warnings.push(FitWarning::FacesNotClosed(defect));
            ScannedSurface {
                faces: Some(body.mesh),
                is_sparse: cloud.is_sparse && unseen == cloud.unseen,
                is_many: cloud.is_many && unseen == cloud.unseen,
                unseen,
                warnings,
                ..cloud
            }
        }
    };
    let dust = cleaned
        .into_iter()
        .flat_map(|(_, dust)| told(dust, |parts| FitWarning::Dust { parts }));
    surface.warnings.extend(dust.chain(crossing));
    Ok(surface)
}

/// Of faces whose small holes are closed by triangles, which were not seen.
fn filled(mesh: Mesh, fill: Option<Fill>, is_of_voxels: bool) -> ScannedSurface<'static> {
    let seen = mesh.triangles.len() - fill.map_or(0, |fill| fill.triangles);
    let seen = mesh.triangles[..seen].to_vec();
    // Vertices are numbered as triangles come: those of the fill alone are last.
    let vertices = seen
        .as_flattened()
        .iter()
        .max()
        .map_or(0, |last| *last as usize + 1);
    let points = mesh.vertices[..vertices].to_vec();
    let faces = Mesh {
        vertices: points.clone(),
        triangles: seen,
    };
    let gap = Gap::new(&Scale::of(&faces).mesh(&faces)).warning();
    let (points, subdivided) = match is_of_voxels {
        true => (Cow::Owned(points), None),
        false => without_made(&mesh, Cow::Owned(points)),
    };
    ScannedSurface {
        faces: Some(faces),
        warnings: fill
            .map(FitWarning::Filled)
            .into_iter()
            .chain(gap)
            .chain(subdivided)
            .collect(),
        ..closed(mesh, points)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::Vector3;

    #[test]
    fn faces_round_two_grains_have_a_neck_and_those_of_one_grain_none() {
        let has_neck = |radius: &dyn Fn(&Vector3<f64>) -> f64| {
            let scan = Scan::from_mesh(Mesh::radial(32, radius)).unwrap();
            let surface = scanned_surface(&scan).unwrap();
            surface.warnings.contains(&FitWarning::Neck)
        };
        // Balls of radius 1 about places this far from the centre.
        let balls = |apart: f64| {
            move |n: &Vector3<f64>| {
                let across = apart * apart * (1.0 - n.z * n.z);
                apart * n.z.abs() + (1.0 - across).sqrt()
            }
        };
        assert!(has_neck(&balls(0.85)));
        assert!(!has_neck(&balls(0.4)));
        assert!(!has_neck(
            &|n| 1.0 / n.component_div(&Vector3::new(1.0, 1.5, 3.0)).norm()
        ));
    }

    #[test]
    fn a_hole_that_is_wide_is_told_though_it_is_closed() {
        let told = |degrees: f64| {
            let mut mesh = Mesh::radial(32, |n| 2.0 + 0.3 * n.x);
            let rim = degrees.to_radians().cos();
            let is_seen = |at: &u32| mesh.vertices[*at as usize].coords.normalize().z < rim;
            mesh.triangles.retain(|corners| corners.iter().all(is_seen));
            let scan = Scan::from_mesh(mesh).unwrap();
            let warnings = scanned_surface(&scan).unwrap().warnings;
            let is_filled = |warning: &FitWarning| matches!(warning, FitWarning::Filled(_));
            assert!(warnings.iter().any(is_filled), "{warnings:?}");
            warnings.iter().find_map(|warning| match warning {
                FitWarning::Gap { half_angle, .. } => Some(half_angle.to_degrees()),
                _ => None,
            })
        };
        let gap = told(20.0).unwrap();
        assert!((18.0..24.0).contains(&gap), "{gap}");
        assert_eq!(told(6.0), None);
    }
}
