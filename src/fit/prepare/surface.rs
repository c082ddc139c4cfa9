//! The surface that a scan draws: a closed mesh through its points, by its own faces or by the
//! triangulation of their directions.

use super::reference::ReferenceKind;
use super::strays::{LEAST_STRAY, find_strays};
use super::thin::{Thinned, WHOLE_CLOUD, thin};
use crate::fit::error::FitError;
use crate::fit::warning::FitWarning;
use crate::mesh::Mesh;
use crate::scan::Scan;
use crate::sphere::triangulate_directions;
use nalgebra::{Point3, Vector3};
use std::borrow::Cow;

/// Median scatter of neighbouring radii beyond which points do not form one surface.
const LARGEST_SCATTER: f64 = 0.1;

/// Share of strays beyond which the scan holds more than one grain.
const LARGEST_SHARE_OF_STRAYS: f64 = 0.2;

/// A gap in the scan is told of when no point lies within this angle (radians) and three times the
/// mean spacing of the points.
const WIDE_GAP: f64 = 0.2;

/// The surface that a scan draws, and the points that lie on it.
#[derive(Debug, Clone)]
pub struct ScannedSurface<'a> {
    /// A closed mesh through the points or, of large clouds, through representatives of them.
    pub mesh: Mesh,
    /// What the mesh is made of.
    pub kind: ReferenceKind,
    /// The points to fit: without strays and without vertices that no face uses.
    pub(crate) points: Cow<'a, [Point3<f64>]>,
    /// One point per small patch of directions, where the cloud is large.
    pub(crate) representatives: Option<Vec<Point3<f64>>>,
    /// What a user should know.
    pub warnings: Vec<FitWarning>,
}

/// Finds the surface that a scan draws: its own faces if they enclose one body, else the
/// triangulation of the directions of its points, without outliers, as seen from their mean.
///
/// # Errors
/// [`FitError`] if a point is not finite, if the points enclose no volume, or if too many of them
/// do not lie on one surface round a centre.
pub fn scanned_surface(scan: &Scan) -> Result<ScannedSurface<'_>, FitError> {
    if let Some(index) = scan
        .points
        .iter()
        .position(|p| !p.iter().all(|x| x.is_finite()))
    {
        return Err(FitError::NotFinite { index });
    }
    match &scan.topology {
        Some(topology) if topology.closed && topology.bodies == 1 => {
            Ok(from_faces(scan, &topology.unreferenced))
        }
        Some(_) => {
            let mut surface = from_directions(scan)?;
            surface.warnings.push(FitWarning::FacesNotClosed);
            Ok(surface)
        }
        None => from_directions(scan),
    }
}

fn from_faces<'a>(scan: &'a Scan, unreferenced: &[u32]) -> ScannedSurface<'a> {
    let points = without(&scan.points, unreferenced);
    let representatives = (points.len() > WHOLE_CLOUD).then(|| {
        let Thinned {
            representatives, ..
        } = thin(&points, &middle(&points), f64::INFINITY);
        select(&points, &representatives)
    });
    ScannedSurface {
        mesh: Mesh {
            vertices: scan.points.clone(),
            triangles: scan.triangles.clone(),
        },
        kind: ReferenceKind::Faces,
        points,
        representatives,
        warnings: Vec::new(),
    }
}

fn from_directions(scan: &Scan) -> Result<ScannedSurface<'_>, FitError> {
    let centre = middle(&scan.points);
    if scan.points.len() <= WHOLE_CLOUD {
        let mesh = mesh_of_directions(scan.points.clone(), &centre)?;
        let strays = find_strays(&mesh, &centre);
        if strays.scatter > LARGEST_SCATTER {
            return Err(FitError::Scattered {
                scatter: strays.scatter,
            });
        }
        refuse_background(strays.indices.len(), scan.points.len())?;
        let (mesh, points) = if strays.indices.is_empty() {
            (mesh, Cow::Borrowed(scan.points.as_slice()))
        } else {
            // By value: a stray that the file holds twice goes twice.
            let strays = select(&scan.points, &strays.indices);
            let kept: Vec<_> = scan
                .points
                .iter()
                .filter(|point| !strays.contains(point))
                .copied()
                .collect();
            (mesh_of_directions(kept.clone(), &centre)?, Cow::Owned(kept))
        };
        let warnings = warnings(&mesh, &centre, strays.indices.len(), scan.points.len());
        return Ok(ScannedSurface {
            mesh,
            kind: ReferenceKind::Directions,
            points,
            representatives: None,
            warnings,
        });
    }
    let Thinned {
        representatives,
        strays,
    } = thin(&scan.points, &centre, LEAST_STRAY);
    refuse_background(strays.len(), scan.points.len())?;
    let representatives = select(&scan.points, &representatives);
    let mesh = mesh_of_directions(representatives.clone(), &centre)?;
    let scatter = find_strays(&mesh, &centre).scatter;
    if scatter > LARGEST_SCATTER {
        return Err(FitError::Scattered { scatter });
    }
    Ok(ScannedSurface {
        warnings: warnings(&mesh, &centre, strays.len(), scan.points.len()),
        mesh,
        kind: ReferenceKind::Directions,
        points: without(&scan.points, &strays),
        representatives: Some(representatives),
    })
}

fn refuse_background(strays: usize, points: usize) -> Result<(), FitError> {
    let share = strays as f64 / points as f64;
    if share > LARGEST_SHARE_OF_STRAYS {
        return Err(FitError::Strays { share });
    }
    Ok(())
}

/// The mean of the points, from sums that do not lose digits to a far-off origin.
fn middle(points: &[Point3<f64>]) -> Point3<f64> {
    let origin = points.first().copied().unwrap_or_else(Point3::origin);
    let sum: Vector3<f64> = points
        .chunks(1024)
        .map(|chunk| chunk.iter().map(|p| p - origin).sum::<Vector3<f64>>())
        .sum();
    origin + sum / points.len().max(1) as f64
}

fn mesh_of_directions(points: Vec<Point3<f64>>, centre: &Point3<f64>) -> Result<Mesh, FitError> {
    let directions: Vec<Vector3<f64>> = points
        .iter()
        .map(|p| {
            let d = p - centre;
            let length = d.norm();
            if length > 0.0 {
                d / length
            } else {
                Vector3::z()
            }
        })
        .collect();
    let triangles = triangulate_directions(&directions).map_err(|_| FitError::NoVolume {
        points: points.len(),
    })?;
    Ok(Mesh {
        vertices: points,
        triangles,
    })
}

fn warnings(mesh: &Mesh, centre: &Point3<f64>, strays: usize, points: usize) -> Vec<FitWarning> {
    let mut warnings = Vec::new();
    if strays > 0 {
        warnings.push(FitWarning::Strays { strays, points });
    }
    let (half_angle, direction) = widest_gap(mesh, centre);
    let spacing = (4.0 * std::f64::consts::PI / mesh.vertices.len() as f64).sqrt();
    if half_angle > WIDE_GAP.max(3.0 * spacing) {
        warnings.push(FitWarning::Gap {
            half_angle,
            direction,
        });
    }
    warnings
}

/// Angular radius and direction of the largest empty cap: the largest circumscribed circle of the
/// triangulation.
fn widest_gap(mesh: &Mesh, centre: &Point3<f64>) -> (f64, Vector3<f64>) {
    let mut widest = (-1.0, Vector3::z());
    let mut least = f64::INFINITY;
    for corners in &mesh.triangles {
        let [a, b, c] = corners.map(|i| (mesh.vertices[i as usize] - centre).normalize());
        let pole = (b - a).cross(&(c - a)).normalize();
        let cosine = pole.dot(&a);
        if cosine < least {
            least = cosine;
            widest = (cosine.clamp(-1.0, 1.0).acos(), pole);
        }
    }
    widest
}

fn select(points: &[Point3<f64>], indices: &[u32]) -> Vec<Point3<f64>> {
    indices.iter().map(|&i| points[i as usize]).collect()
}

/// All points but those at the given sorted indices.
fn without<'a>(points: &'a [Point3<f64>], indices: &[u32]) -> Cow<'a, [Point3<f64>]> {
    if indices.is_empty() {
        return Cow::Borrowed(points);
    }
    let mut left_out = indices.iter().peekable();
    let is_kept =
        |&(i, _): &(usize, &Point3<f64>)| left_out.next_if(|&&index| index as usize == i).is_none();
    Cow::Owned(
        points
            .iter()
            .enumerate()
            .filter(is_kept)
            .map(|(_, point)| *point)
            .collect(),
    )
}
