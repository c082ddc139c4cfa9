//! A scan that holds many grains, as one scan for each.
//!
//! Of a mesh, a grain is what shares no point with the rest, its hollows included. Of a cloud, the plane that grains lie on is taken away,
//! and a grain is what hangs together by distances that the cloud itself tells; grains that touch are cut apart at
//! their neck. What is too small for a grain is dust. Every grain keeps the frame of the scan.

mod bodies;
mod cut;
mod dust;
mod links;
mod neck;
mod outline;
mod plane;
mod spacing;

pub use plane::Plane;
use spacing::covering;

use super::drawn::{by_coordinates, drawn};
use super::{ParseError, Scan, Volume, VolumeError};
use bodies::bodies;
use cut::{Clump, cut};
use dust::{LEAST_POINTS, without_dust};
use links::Links;
use nalgebra::Point3;
use neck::Neck;
use rayon::prelude::*;
use std::cmp::Ordering;

/// The grains of a scan, and what else there was.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct Split {
    /// The grains, by the middles of their boxes: ascending in x, of equal x in y, then in z; those of a segmented
    /// volume by their labels.
    pub grains: Vec<SplitGrain>,
    /// How far neighbours of one surface are apart at most, in the scan's unit; none of a mesh.
    pub distance: Option<f64>,
    /// The plane that the grains lay on.
    pub plane: Option<Plane>,
    /// Points on the plane, and beyond it.
    pub plane_points: usize,
    /// Clumps, bodies of a mesh, or labels that are too small for a grain.
    pub dust: usize,
    /// Points of these.
    pub dust_points: usize,
    /// Places where grains that touched were cut apart.
    pub cuts: usize,
    /// Why labels of a segmented volume are no grains.
    pub left_out: Vec<VolumeError>,
}

/// One grain of several.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct SplitGrain {
    /// The grain, in the frame of the scan it comes from.
    pub scan: Scan,
    /// Positions of its points among those of that scan, ascending; of a mesh, none.
    pub indices: Vec<u32>,
    /// Its label in a segmented volume.
    pub label: Option<i64>,
    /// Whether it may be several that touch, though no neck was found: it has a waist, or is not convex by far.
    pub may_touch: bool,
}

/// Splits a scan into its grains.
///
/// # Errors
/// [`ParseError`] where the points are none, not finite, all the same or all on one line.
pub fn split(scan: &Scan) -> Result<Split, ParseError> {
    super::check::check(&scan.points)?;
    let mut split = match scan.topology {
        Some(_) => split_faces(scan),
        None => split_points(&scan.points),
    };
    split
        .grains
        .sort_by(|one, other| by_place(&one.scan, &other.scan));
    Ok(split)
}

/// Points by which a neck is looked for in a scan of one body.
const NECK_POINTS: usize = 4000;

/// Whether a cloud without faces, taken for one body, has a neck at which [`split`] would cut it.
pub(crate) fn has_neck(points: &[Point3<f64>]) -> bool {
    let drawn = drawn(points, NECK_POINTS);
    let Some(links) = Links::new(&drawn) else {
        return false;
    };
    let distance = covering(&drawn, links.distance);
    let neck = |times: f64| Neck::find(&drawn, times * distance);
    // Between rows of points thin slabs hold few of them; a neck is a waist in thick slabs too.
    neck(1.0).is_some_and(|neck| neck.is_narrow()) && neck(2.0).is_some_and(|neck| neck.is_waist())
}

/// The grains of a segmented volume, one for each label, in the order of the labels.
///
/// # Errors
/// [`VolumeError`] where there is no label, or the values are none.
pub fn split_labels(volume: &Volume) -> Result<Split, VolumeError> {
    let (mut bodies, mut left_out) = (Vec::new(), Vec::new());
    for (label, found) in volume.scans()? {
        match found {
            Ok(scan) => bodies.push((Some(label), scan)),
            Err(reason) => left_out.push(reason),
        }
    }
    Ok(Split {
        left_out,
        ..without_small(bodies.into_iter())
    })
}

fn split_faces(scan: &Scan) -> Split {
    let bodies = bodies(&scan.welded()).into_iter();
    without_small(bodies.map(|body| (None, scan.part(body))))
}

/// The bodies but for those whose area is that of dust.
fn without_small(bodies: impl Iterator<Item = (Option<i64>, Scan)>) -> Split {
    let (grains, dust) = without_dust(bodies, 0.0, |(_, body)| area(body));
    Split {
        distance: None,
        plane: None,
        plane_points: 0,
        dust: dust.len(),
        dust_points: dust.iter().map(|(_, body)| body.points.len()).sum(),
        cuts: 0,
        left_out: Vec::new(),
        grains: grains
            .into_iter()
            .map(|(label, scan)| SplitGrain {
                scan,
                indices: Vec::new(),
                label,
                may_touch: false,
            })
            .collect(),
    }
}

fn area(body: &Scan) -> f64 {
    let area = |corners: &[u32; 3]| {
        let [a, b, c] = corners.map(|corner| body.points[corner as usize]);
        (b - a).cross(&(c - a)).norm() / 2.0
    };
    body.triangles.iter().map(area).sum()
}

fn split_points(all: &[Point3<f64>]) -> Split {
    let order = sorted(all);
    let points: Vec<Point3<f64>> = order.iter().map(|&i| all[i as usize]).collect();
    let distinct = |i: &usize| *i == 0 || points[*i] != points[*i - 1];
    let plane = Plane::carrying(&points);
    let is_above = |point: &Point3<f64>| {
        plane.is_none_or(|plane| !plane.carries(point) && !plane.hides(point))
    };
    let above: Vec<u32> = (0..points.len())
        .filter(distinct)
        .filter(|&i| is_above(&points[i]))
        .map(|i| i as u32)
        .collect();
    let places: Vec<Point3<f64>> = above.iter().map(|&i| points[i as usize]).collect();
    let links = Links::new(&places);
    let distance = links.as_ref().map(|links| links.distance);
    let clumps = links.map_or_else(Vec::new, |links| links.clumps());
    let (clumps, dust) = without_dust(clumps.into_iter(), LEAST_POINTS as f64, |clump| {
        clump.len() as f64
    });
    let cut: Vec<Vec<Clump>> = clumps
        .into_par_iter()
        .map(|clump| cut(&places, clump, distance.unwrap_or(0.0)))
        .collect();
    let cuts = cut.iter().map(|parts| parts.len() - 1).sum();
    let grains: Vec<Clump> = cut.into_iter().flatten().collect();

    // The grain of every point: of those above the plane, of those below a grain, and of their equals.
    let mut owners = vec![None; points.len()];
    for (grain, clump) in (0..).zip(&grains) {
        for &place in &clump.points {
            owners[above[place as usize] as usize] = Some(grain);
        }
    }
    if let (Some(plane), Some(distance)) = (&plane, distance) {
        let on: Vec<usize> = (0..points.len())
            .filter(|&i| plane.carries(&points[i]))
            .collect();
        let places_on: Vec<Point3<f64>> = on.iter().map(|&i| points[i]).collect();
        let grains: Vec<Vec<Point3<f64>>> = grains
            .iter()
            .map(|clump| clump.points.iter().map(|&i| places[i as usize]).collect())
            .collect();
        for (own, grain) in on
            .into_iter()
            .zip(plane.covering(&places_on, &grains, distance))
        {
            owners[own] = grain;
        }
    }
    for i in (1..points.len()).filter(|i| !distinct(i)) {
        owners[i] = owners[i - 1];
    }
    let mut members = vec![Vec::new(); grains.len()];
    for (&index, owner) in order.iter().zip(&owners) {
        if let Some(owner) = owner {
            members[*owner as usize].push(index);
        }
    }
    let dust_points = dust.iter().map(Vec::len).sum();
    let kept: usize = members.iter().map(Vec::len).sum();
    Split {
        plane_points: plane.map_or(0, |_| all.len() - kept - dust_points),
        plane,
        distance,
        dust: dust.len(),
        dust_points,
        cuts,
        left_out: Vec::new(),
        grains: members
            .into_iter()
            .zip(grains)
            .map(|(mut indices, clump)| {
                indices.sort_unstable();
                let points = indices.iter().map(|&i| all[i as usize]).collect();
                SplitGrain {
                    scan: Scan::from_points(points),
                    indices,
                    label: None,
                    may_touch: clump.may_touch,
                }
            })
            .collect(),
    }
}

/// Positions of the points, by their places.
fn sorted(points: &[Point3<f64>]) -> Vec<u32> {
    let mut order: Vec<u32> = (0..points.len() as u32).collect();
    let place = |i: &u32| points[*i as usize];
    order.par_sort_unstable_by(|a, b| by_coordinates(&place(a), &place(b)).then(a.cmp(b)));
    order
}

fn by_place(one: &Scan, other: &Scan) -> Ordering {
    let middle = |scan: &Scan| {
        let mut points = scan.points.iter();
        let first = points.next().copied().unwrap_or_default();
        let (low, high) = points.fold((first.coords, first.coords), |(low, high), point| {
            (low.inf(&point.coords), high.sup(&point.coords))
        });
        Point3::from((low + high) / 2.0)
    };
    by_coordinates(&middle(one), &middle(other))
}

#[cfg(test)]
mod tests;
