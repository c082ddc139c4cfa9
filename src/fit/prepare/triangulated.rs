//! The surface that points without faces draw: the triangulation of their directions, without those that stand apart.

use super::averaged::averaged;
use super::by_direction::one_surface;
use super::layers::layers;
use super::middle::middle;
use super::pieces::Pieces;
use super::reference::ReferenceKind;
use super::representatives::Representatives;
use super::scanned::ScannedSurface;
use super::thin::{WHOLE_CLOUD, select};
use super::together::{in_one_direction, neighbouring, together};
use super::twins::merged;
use crate::fit::error::FitError;
use crate::fit::holes::Gap;
use crate::fit::points::repeated::without_repeats;
use crate::fit::points::without::without;
use crate::fit::warning::FitWarning;
use crate::measure::Scale;
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

/// The same where a bin of directions with several strays shows one after the other.
const REPRESENTATIVE_ROUNDS: usize = 20;

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
            let map = map.unwrap_or(Matrix3::identity());
            let (mesh, points, representatives) = by_representatives(points, &map)?;
            (mesh, points, Some(representatives))
        }
    };
    let strays = all - points.len();
    refuse_background(strays, all)?;
    refuse_second_surface(&cloud, &points)?;
    let scale = Scale::of(&mesh);
    let scaled = scale.mesh(&mesh);
    let (gap, averaged) = (Gap::new(&scaled), averaged(&scaled, scale.length));
    let layers = layers(&scaled.vertices, scale.length);
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

/// The same of a large cloud, by representatives of its points; and these.
fn by_representatives<'a>(
    points: Points<'a>,
    map: &Matrix3<f64>,
) -> Result<(Mesh, Points<'a>, Vec<Point3<f64>>), FitError> {
    let given = points.clone();
    let mut kept = points;
    let mut found = Representatives::new(&kept, map)?;
    for _ in 0..REPRESENTATIVE_ROUNDS {
        if found.apart.is_empty() {
            break;
        }
        kept = Cow::Owned(without(&kept, found.apart));
        found = Representatives::new(&kept, map)?;
    }
    let is_peeled = kept.len() < given.len();
    kept = lacking(kept, found.strays);
    let sure = kept.len();
    if is_peeled {
        let tips = neighbouring(&given, &kept);
        kept.to_mut().extend(tips);
        let awn = in_one_direction(&given, &kept, &middle(&kept));
        kept.to_mut().extend(awn);
    }
    if kept.len() > sure {
        found = Representatives::new(&kept, map)?;
        kept = lacking(kept, found.strays);
    }
    Ok((found.mesh, kept, found.points))
}

fn lacking(points: Points<'_>, strays: Vec<usize>) -> Points<'_> {
    match strays.is_empty() {
        true => points,
        false => Cow::Owned(without(&points, strays)),
    }
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shapes::Sampling;
    use nalgebra::Vector3;
    use rand::{RngExt, SeedableRng};
    use rand_chacha::ChaCha8Rng;

    const AXES: [f64; 3] = [3.0, 2.0, 1.5];

    fn ellipsoid(points: usize) -> Vec<Point3<f64>> {
        let directions = Sampling::Fibonacci.directions(points, 0).unwrap();
        let places = directions
            .iter()
            .map(|n| n.component_mul(&Vector3::from(AXES)));
        places.map(Point3::from).collect()
    }

    fn is_off(point: &&Point3<f64>) -> bool {
        let far = point.coords.component_div(&Vector3::from(AXES)).norm();
        (far - 1.0).abs() > 1e-9
    }

    /// With 1.5 points in a bin of directions, a stray is often the only one, or one of two.
    #[test]
    fn strays_strewn_about_a_large_cloud_are_left_out() {
        let mut cloud = ellipsoid(20_000);
        let mut random = ChaCha8Rng::seed_from_u64(1);
        let strewn =
            (0..600).map(|_| Point3::from([(); 3].map(|()| random.random_range(-15.0..15.0))));
        cloud.extend(strewn);
        let surface = from_directions(Cow::Borrowed(&cloud), None).unwrap();
        assert!(surface.points.len() > 19_950);
        assert_eq!(surface.points.iter().filter(is_off).count(), 0);
        let representatives = surface.representatives.unwrap();
        assert_eq!(representatives.iter().filter(is_off).count(), 0);
    }

    #[test]
    fn strays_in_groups_are_left_out_of_clouds_of_any_size() {
        for (count, groups) in [(6000, 2), (6000, 10), (20_000, 2), (20_000, 60)] {
            for members in [2, 4, 8] {
                let clean = ellipsoid(count);
                let mut cloud = clean.clone();
                let mut random = ChaCha8Rng::seed_from_u64(members);
                for group in 0..groups {
                    let place = clean[(group * 997 + 311) % count] * random.random_range(1.4..1.8);
                    let aside = |_| Vector3::from_fn(|_, _| random.random_range(-0.03..0.03));
                    cloud.extend((0..members).map(aside).map(|aside| place + aside));
                }
                let surface = from_directions(Cow::Borrowed(&cloud), None).unwrap();
                let off = surface.points.iter().filter(is_off).count();
                let lost = count + off - surface.points.len();
                assert!(
                    off == 0 && lost < 10,
                    "{count} {groups} {members}: {off} {lost}"
                );
            }
        }
    }
}
