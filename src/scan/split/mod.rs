//! A scan that holds many grains, as one scan for each.
//!
//! Of a mesh, a grain is what shares no point with the rest, its hollows included; of a segmented volume, voxels of one
//! label that share faces. Of a cloud, the plane that grains lie on is taken away,
//! and a grain is what hangs together by distances that the cloud itself tells; grains that touch are cut apart at
//! their neck. What is too small for a grain is dust. Every grain keeps the frame of the scan.

mod bodies;
mod cut;
mod dust;
mod labels;
mod links;
mod neck;
mod one_body;
mod outline;
mod plane;
mod spacing;

pub use labels::split_labels;
pub(crate) use one_body::{are_two_grains, has_neck, voxels_have_neck};
pub use plane::Plane;

use super::apart::apart;
use super::drawn::by_coordinates;
use super::{ParseError, Scan, VolumeError, VoxelBody};
use bodies::bodies;
use cut::{Necks, Part, Parts, cut};
use dust::{LEAST_POINTS, by_size};
use links::Links;
use nalgebra::Point3;
use rayon::prelude::*;
use std::cmp::Ordering;
use std::collections::BTreeSet;

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
    /// Heaps, bodies of a mesh, or bodies of a segmented volume that are too small for a grain.
    pub dust: usize,
    /// Points of these; of a segmented volume their voxels.
    pub dust_points: usize,
    /// Pieces of the dust that are too small for a grain only beside the others.
    pub small: usize,
    /// Why labels of a segmented volume, or bodies of them, are no grains.
    pub left_out: Vec<VolumeError>,
}

impl Split {
    /// Places where grains that touched were cut apart.
    pub fn cuts(&self) -> usize {
        let heaps = |grain: &SplitGrain| grain.cut.map(|cut| cut.heap);
        let cut: Vec<usize> = self.grains.iter().filter_map(heaps).collect();
        let distinct: BTreeSet<usize> = cut.iter().copied().collect();
        cut.len() - distinct.len()
    }
}

/// What a grain was cut from.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct Cut {
    /// The heap, a number that it shares with the other grains that were cut from it, and with none else.
    pub heap: usize,
    /// How many grains were cut from it.
    pub grains: usize,
    /// Width of the widest neck at which the heap was cut, over that of the narrower of its sides.
    pub neck: f64,
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
    /// Its voxels in a segmented volume, see [`Volume::alone`](super::Volume::alone).
    pub voxels: Option<VoxelBody>,
    /// What it was cut from at a neck; a single grain with a waist may have been cut so, too.
    pub cut: Option<Cut>,
    /// Whether it may be several that touch, though it was not cut: it has a waist, or is not convex by far.
    pub may_touch: bool,
}

/// Splits a scan into its grains; grains that touch are cut apart at their necks.
///
/// # Errors
/// [`ParseError`] where the points are none, not finite, all the same or all on one line.
pub fn split(scan: &Scan) -> Result<Split, ParseError> {
    split_at(scan, Necks::Cut)
}

/// Splits a scan into what hangs together, grains with a waist as well as grains that touch.
///
/// # Errors
/// Those of [`split`].
pub fn split_uncut(scan: &Scan) -> Result<Split, ParseError> {
    split_at(scan, Necks::Keep)
}

fn split_at(scan: &Scan, necks: Necks) -> Result<Split, ParseError> {
    super::check::check(&scan.points)?;
    let mut split = match scan.topology {
        Some(_) => split_faces(scan),
        None => split_points(&scan.points, necks),
    };
    split
        .grains
        .sort_by(|one, other| by_place(&one.scan, &other.scan));
    Ok(split)
}

fn split_faces(scan: &Scan) -> Split {
    let bodies = bodies(&apart(scan.welded())).into_iter();
    let bodies = bodies.map(|body| scan.part(body));
    let sorted = by_size(bodies, 0.0, area);
    Split {
        distance: None,
        plane: None,
        plane_points: 0,
        dust: sorted.dust().count(),
        dust_points: sorted.dust().map(|body| body.points.len()).sum(),
        small: sorted.small.len(),
        left_out: Vec::new(),
        grains: sorted
            .grains
            .into_iter()
            .map(|scan| SplitGrain {
                scan,
                indices: Vec::new(),
                label: None,
                voxels: None,
                cut: None,
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

fn split_points(all: &[Point3<f64>], necks: Necks) -> Split {
    let order = sorted(all);
    let points: Vec<Point3<f64>> = order.iter().map(|&i| all[i as usize]).collect();
    let distinct = |i: &usize| *i == 0 || points[*i] != points[*i - 1];
    // What stands at one place over and over would carry every plane through it.
    let once = (0..points.len()).filter(distinct).map(|i| points[i]);
    let plane = Plane::carrying(&once.collect::<Vec<_>>());
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
    let heaps = links.map_or_else(Vec::new, |links| links.heaps());
    let sorted = by_size(heaps.into_iter(), LEAST_POINTS as f64, |heap| {
        heap.len() as f64
    });
    let (dust, small) = (sorted.dust().count(), sorted.small.len());
    let cut: Vec<Parts> = sorted
        .grains
        .into_par_iter()
        .map(|heap| cut(&places, heap, distance.unwrap_or(0.0), necks))
        .collect();
    let cuts = cut.into_iter().enumerate().flat_map(|(heap, parts)| {
        let Parts { parts, neck } = parts;
        let grains = parts.len();
        let cut = (grains > 1).then_some(Cut { heap, grains, neck });
        parts.into_iter().map(move |part| (part, cut))
    });
    let (grains, cuts): (Vec<Part>, Vec<Option<Cut>>) = cuts.unzip();

    // The grain of every point: of those above the plane, of those below a grain, and of their equals.
    let mut owners = vec![None; points.len()];
    for (grain, part) in (0..).zip(&grains) {
        for &place in &part.points {
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
            .map(|part| part.points.iter().map(|&i| places[i as usize]).collect())
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
    let left = points.iter().zip(&owners);
    let left = left.filter(|(_, owner)| owner.is_none());
    let dust_points = left.clone().filter(|(point, _)| is_above(point)).count();
    Split {
        plane_points: left.count() - dust_points,
        plane,
        distance,
        dust,
        dust_points,
        small,
        left_out: Vec::new(),
        grains: members
            .into_iter()
            .zip(grains.into_iter().zip(cuts))
            .map(|(mut indices, (part, cut))| {
                indices.sort_unstable();
                let points = indices.iter().map(|&i| all[i as usize]).collect();
                SplitGrain {
                    scan: Scan::from_points(points),
                    indices,
                    label: None,
                    voxels: None,
                    cut,
                    may_touch: part.may_touch,
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
