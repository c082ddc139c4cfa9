//! The surface that a scan draws: a closed mesh through its points, by its own faces or by the
//! triangulation of their directions.

use super::averaged::averaged;
use super::by_direction::{middle, one_surface};
use super::gap::Gap;
use super::layers::layers;
use super::pieces::Pieces;
use super::reference::ReferenceKind;
use super::strays::LEAST_STRAY;
use super::thin::{Thinned, WHOLE_CLOUD, thin};
use super::together::{neighbouring, together};
use super::twins::merged;
use crate::fit::error::FitError;
use crate::fit::repeated::without_repeats;
use crate::fit::warning::FitWarning;
use crate::fit::without::without;
use crate::measure::{
    Dust, FacesDefect, Fill, SelfCrossing, Unit, scanned_body, self_crossing, without_dust,
};
use crate::mesh::Mesh;
use crate::model::Unseen;
use crate::scan::{Scan, has_neck, voxels_have_neck};
use nalgebra::Point3;
use std::borrow::Cow;
use std::ops::RangeInclusive;

/// Share of strays beyond which the scan holds more than one grain.
const LARGEST_SHARE_OF_STRAYS: f64 = 0.2;

/// Share of points that stand apart, and yet close to each other, beyond which they are no outliers: awns and rims have less.
const LARGEST_SHARE_TOGETHER: f64 = 0.01;

/// Points of the scan, or a part of them.
type Points<'a> = Cow<'a, [Point3<f64>]>;

/// Sizes beyond which volumes are no numbers.
const SIZES: RangeInclusive<f64> = 1e-100..=1e100;

/// Clouds up to this size are looked at for points that they hold twice.
const MOST_WITH_TWINS: usize = 4 * WHOLE_CLOUD;

/// Rounds of leaving out strays.
const STRAY_ROUNDS: usize = 5;

/// The surface that a scan draws, and the points that lie on it.
#[derive(Debug, Clone)]
pub struct ScannedSurface<'a> {
    /// A closed mesh through the points or, of large clouds, through representatives of them.
    pub mesh: Mesh,
    /// What the mesh is made of.
    pub kind: ReferenceKind,
    /// The faces that were seen, where they are not those of the mesh.
    pub(crate) faces: Option<Mesh>,
    /// The points to fit: without strays and without vertices that no face uses.
    pub(crate) points: Cow<'a, [Point3<f64>]>,
    /// One point per small patch of directions, where the cloud is large.
    pub(crate) representatives: Option<Vec<Point3<f64>>>,
    /// What was not seen, if it is large.
    pub(crate) unseen: Option<Unseen>,
    /// Whether that is only because the points are few for a body as thin.
    pub(crate) is_sparse: bool,
    /// Whether that are holes none of which is large.
    pub(crate) is_many: bool,
    /// What a user should know.
    pub warnings: Vec<FitWarning>,
}

impl ScannedSurface<'_> {
    /// The faces that were seen; none of a cloud.
    pub(crate) fn seen_faces(&self) -> Option<&Mesh> {
        match self.kind {
            ReferenceKind::Faces | ReferenceKind::Voxels => {
                self.faces.as_ref().or(Some(&self.mesh))
            }
            ReferenceKind::Directions | ReferenceKind::Crust => self.faces.as_ref(),
        }
    }
}

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
        None => from_directions(Cow::Borrowed(&scan.points)),
    }?;
    if surface.kind == ReferenceKind::Faces && scan.scatter > 0.0 {
        surface.kind = ReferenceKind::Voxels;
        let neck = voxels_have_neck(&surface.points).then_some(FitWarning::Neck);
        surface.warnings.extend(neck);
    }
    Ok(surface)
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
        let points = scan.points.len();
        return Err(FitError::NoVolume { points });
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
    Ok(ScannedSurface {
        warnings: crossing.into_iter().collect(),
        ..closed(mesh, points)
    })
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
        } = thin(&points, &middle(&points), f64::INFINITY);
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
        return from_directions(Cow::Owned(scan.points.clone()));
    };
    match (body.defect, body.bodies, body.cavities) {
        (Some(FacesDefect::Overlapping { parts: bodies }), _, _) | (_, bodies @ 2.., _) => {
            return Err(FitError::SeveralBodies { bodies });
        }
        (_, _, cavities @ 1..) => return Err(FitError::Hollow { cavities }),
        _ => {}
    }
    let crossing = fitted_over(body.crossing)?;
    let mut surface = match body.defect {
        None => filled(body.mesh, body.fill),
        Some(defect) => {
            let cloud = from_directions(Cow::Owned(body.mesh.vertices.clone()))?;
            let unseen = match defect {
                FacesDefect::Open { holes, share } => Some(Unseen::Open { holes, share }),
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
    let dust = cleaned.into_iter().flat_map(|(_, dust)| told(dust));
    surface.warnings.extend(dust.chain(crossing));
    Ok(surface)
}

/// What to say of parts that were left out.
fn told(dust: Dust) -> impl Iterator<Item = FitWarning> {
    let Dust {
        specks: parts,
        pores,
        share,
    } = dust;
    let specks = (parts > 0).then_some(FitWarning::Dust { parts });
    let pores = (pores > 0).then_some(FitWarning::Pores { pores, share });
    specks.into_iter().chain(pores)
}

/// Of faces whose small holes are closed by triangles, which were not seen.
fn filled(mesh: Mesh, fill: Option<Fill>) -> ScannedSurface<'static> {
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
    ScannedSurface {
        faces: Some(faces),
        warnings: fill.map(FitWarning::Filled).into_iter().collect(),
        ..closed(mesh, Cow::Owned(points))
    }
}

/// Of points alone.
fn from_directions(points: Cow<'_, [Point3<f64>]>) -> Result<ScannedSurface<'_>, FitError> {
    let (points, repeated) = without_repeats(points);
    let given = points.len();
    let merged = (given <= MOST_WITH_TWINS)
        .then(|| merged(&points))
        .flatten();
    let points = merged.map_or(points, Cow::Owned);
    let all = points.len();
    let twins = (all < given).then_some(FitWarning::Twins {
        twins: given - all,
        points: given,
    });
    let pieces = Pieces::new(&points);
    if pieces.bodies > 1 {
        return Err(FitError::SeveralBodies {
            bodies: pieces.bodies,
        });
    }
    let points = match pieces.is_dusty {
        true => Cow::Owned(pieces.largest(&points)),
        false => points,
    };
    let cloud = points.clone();
    let (mesh, points, representatives) = match points.len() <= WHOLE_CLOUD {
        true => {
            let (mesh, points) = whole(points)?;
            (mesh, points, None)
        }
        false => {
            let centre = middle(&points);
            let Thinned {
                representatives,
                strays,
            } = thin(&points, &centre, LEAST_STRAY);
            refuse_background(strays.len(), points.len())?;
            let representatives = select(&points, &representatives);
            let (mesh, _) = one_surface(&representatives, &centre)?;
            let kept = match strays.is_empty() {
                true => points,
                false => Cow::Owned(without(&points, strays.iter().map(|&index| index as usize))),
            };
            (mesh, kept, Some(representatives))
        }
    };
    let strays = all - points.len();
    refuse_background(strays, all)?;
    refuse_second_surface(&cloud, &points)?;
    let unit = Unit::of(&mesh);
    let scaled = unit.mesh(&mesh);
    let (gap, averaged) = (Gap::new(&scaled), averaged(&scaled, unit.length));
    let layers = layers(&scaled.vertices, unit.length);
    let strays = (strays > 0).then_some(FitWarning::Strays {
        strays,
        points: all,
    });
    let neck = has_neck(&points).then_some(FitWarning::Neck);
    Ok(ScannedSurface {
        unseen: gap.unseen,
        is_sparse: gap.is_sparse,
        is_many: gap.is_many,
        warnings: [
            repeated,
            twins,
            neck,
            strays,
            gap.warning(),
            averaged,
            layers,
        ]
        .into_iter()
        .flatten()
        .collect(),
        mesh,
        kind: ReferenceKind::Directions,
        faces: None,
        points,
        representatives,
    })
}

/// The triangulation of all points of a small cloud but its strays, and these points. With the first strays gone, those
/// that hid behind them stand apart; what was taken off so point by point is a tip, and put back.
fn whole(points: Points<'_>) -> Result<(Mesh, Points<'_>), FitError> {
    let given = points.clone();
    let (mesh, kept) = without_strays(points)?;
    let tips = match kept.len() < given.len() {
        true => neighbouring(&given, &kept),
        false => Vec::new(),
    };
    if tips.is_empty() {
        return Ok((mesh, kept));
    }
    let kept = [kept.into_owned(), tips].concat();
    let (mesh, _) = one_surface(&kept, &middle(&kept))?;
    Ok((mesh, Cow::Owned(kept)))
}

fn without_strays(mut points: Points<'_>) -> Result<(Mesh, Points<'_>), FitError> {
    let all = points.len();
    for _ in 0..STRAY_ROUNDS {
        let centre = middle(&points);
        let (mesh, strays) = one_surface(&points, &centre)?;
        refuse_background(all - points.len() + strays.len(), all)?;
        if strays.is_empty() {
            return Ok((mesh, points));
        }
        // By value: a stray that the file holds twice goes twice.
        let strays = select(&points, &strays);
        points.to_mut().retain(|point| !strays.contains(point));
    }
    let (mesh, _) = one_surface(&points, &middle(&points))?;
    Ok((mesh, points))
}

fn refuse_background(strays: usize, points: usize) -> Result<(), FitError> {
    let share = strays as f64 / points as f64;
    if share > LARGEST_SHARE_OF_STRAYS {
        return Err(FitError::Strays { share });
    }
    Ok(())
}

/// Points that stand apart are outliers, unless they lie close to each other.
fn refuse_second_surface(points: &[Point3<f64>], kept: &[Point3<f64>]) -> Result<(), FitError> {
    let most = LARGEST_SHARE_TOGETHER * points.len() as f64;
    if (points.len() - kept.len()) as f64 <= most {
        return Ok(());
    }
    match together(points, kept) as f64 {
        count if count > most => Err(FitError::SecondSurface {
            share: count / points.len() as f64,
        }),
        _ => Ok(()),
    }
}

fn select(points: &[Point3<f64>], indices: &[u32]) -> Vec<Point3<f64>> {
    indices.iter().map(|&i| points[i as usize]).collect()
}
