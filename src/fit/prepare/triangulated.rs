//! The surface that points without faces draw: the triangulation of their directions, without those that stand apart.

use super::averaged::averaged;
use super::by_direction::one_surface;
use super::gap::Gap;
use super::layers::layers;
use super::middle::middle;
use super::pieces::Pieces;
use super::reference::ReferenceKind;
use super::scanned::ScannedSurface;
use super::strays::LEAST_STRAY;
use super::thin::{Thinned, WHOLE_CLOUD, select, thin};
use super::together::{neighbouring, together};
use super::twins::merged;
use crate::fit::error::FitError;
use crate::fit::repeated::without_repeats;
use crate::fit::warning::FitWarning;
use crate::fit::without::without;
use crate::measure::Unit;
use crate::mesh::Mesh;
use crate::scan::has_neck;
use nalgebra::{Matrix3, Point3};
use std::borrow::Cow;

/// Share of strays beyond which the scan holds more than one grain.
const LARGEST_SHARE_OF_STRAYS: f64 = 0.2;

/// Share of points that stand apart, and yet close to each other, beyond which they are no outliers: awns and rims have less.
const LARGEST_SHARE_TOGETHER: f64 = 0.01;

/// Points of the scan, or a part of them.
type Points<'a> = Cow<'a, [Point3<f64>]>;

/// Clouds up to this size are looked at for points that they hold twice.
const MOST_WITH_TWINS: usize = 4 * WHOLE_CLOUD;

/// Rounds of leaving out strays.
const STRAY_ROUNDS: usize = 5;

/// The surface of points alone; a rod after a `map` that makes it as wide as long, for along it directions differ by little.
///
/// # Errors
/// [`FitError`] if they are of several bodies, or too many of them lie on no surface round a centre.
pub(super) fn from_directions(
    points: Cow<'_, [Point3<f64>]>,
    map: Option<Matrix3<f64>>,
) -> Result<ScannedSurface<'_>, FitError> {
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
            } = thin(
                &points,
                &centre,
                &map.unwrap_or(Matrix3::identity()),
                LEAST_STRAY,
            );
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
