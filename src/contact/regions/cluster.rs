//! Parts of two surfaces that are near each other, cut finer until what they share is known.

use super::clip::{Crossing, Side, is_inside};
use super::deepest::{DeepestPair, Placed};
use super::farthest::Farthest;
use super::kept::Kept;
use super::lens::lens;
use super::patch::Patch;
use super::sums::Sums;
use super::{ContactRegion, RegionError, RegionWork};
use crate::disjoint_sets::DisjointSets;
use crate::mesh::{Bounds, BoundsTree};
use nalgebra::{Isometry3, Point3, UnitQuaternion, Vector3};
use std::collections::BTreeMap;

/// Triangles of each surface round what is shared, from which on it is known well enough to be compared with a lens, and
/// from which on they are small enough by themselves.
const FEW: usize = 60;
const ENOUGH: usize = 1500;

/// Triangles of a part, at most.
const MOST: usize = 100_000;

/// Pairs of triangles that may cross, at most: of surfaces that lie on each other all over it is more.
const MOST_NEAR: usize = 300_000;

/// Area vector of what is shared, as a share of the first body's, that closes all round.
const CLOSED: f64 = 1e-3;

/// Surfaces that do not cross although they may be off their triangles by so much of their size only are apart.
const APART: f64 = 1e-8;

/// Parts of both surfaces.
pub(super) struct Cluster {
    patches: [Patch; 2],
    /// What they were found to share before the last cut, and before the one before that.
    coarse: [Vec<Sums>; 2],
    size: f64,
    is_whole: bool,
}

/// What comes of parts that are cut.
pub(super) struct Cut {
    /// Parts of which it is not known yet what they share.
    pub(super) finer: Vec<Cluster>,
    pub(super) found: Vec<Found>,
    /// Of whole surfaces: whether most corners of one lie inside the other.
    pub(super) is_mostly_inside: bool,
}

/// What is shared in one place.
pub(super) struct Found {
    pub(super) sums: Sums,
    pub(super) volume_error: f64,
    /// The largest distance of a point of one surface in the other from that, by its triangles.
    pub(super) distance: f64,
    pub(super) deepest: Option<DeepestPair>,
}

impl Found {
    /// The region in a frame in which the origin of the common one is `centre`.
    pub(super) fn told(&self, centre: &Point3<f64>) -> ContactRegion {
        let sums = &self.sums;
        let middle = sums.first / sums.volume;
        ContactRegion {
            depth: self
                .deepest
                .as_ref()
                .map_or(self.distance, DeepestPair::depth),
            curvatures: self.deepest.map(|pair| pair.curvatures),
            errors: self.deepest.and_then(|pair| pair.errors),
            deepest: self
                .deepest
                .map(|pair| pair.points.map(|point| centre + point.coords)),
            point: centre + middle,
            normal: sums.area.normalize(),
            volume: sums.volume,
            volume_error: self.volume_error,
            area: sums.area,
            moment: sums.moment - middle.cross(&sums.area),
        }
    }
}

impl Cluster {
    /// Of two whole surfaces.
    pub(super) fn whole(wholes: [&Patch; 2], poses: &[Isometry3<f64>; 2]) -> Self {
        let mut patches = wholes.map(Patch::clone);
        let placed = [0, 1].map(|side| patches[side].placed(&poses[side]));
        let size = placed
            .iter()
            .flatten()
            .fold(0.0_f64, |size, p| size.max(p.coords.norm()));
        for side in 0..2 {
            let other = 1 - side;
            let round = Bounds::new(placed[other].iter().copied(), 0.0);
            let farthest = outermost(&placed[side], &placed[other]);
            let point = placed[side][farthest];
            patches[side].known[farthest] = Some(
                round.holds(&point) && is_inside(&point, &placed[other], &wholes[other].triangles),
            );
        }
        Self {
            patches,
            coarse: Default::default(),
            size,
            is_whole: true,
        }
    }

    /// What is shared, as far as the triangles are small enough for that; and, cut finer, what is not.
    pub(super) fn cut(
        &self,
        bodies: &[Placed<'_>; 2],
        work: &mut RegionWork,
    ) -> Result<Cut, RegionError> {
        // With the surface along two axes, boxes are no thicker than it is bent.
        let turn = UnitQuaternion::rotation_between(
            &(bodies[0].pose * self.patches[0].area()),
            &Vector3::z(),
        )
        .unwrap_or_default();
        let placed = [0, 1].map(|side| self.patches[side].placed(&(turn * bodies[side].pose)));
        let trees =
            [0, 1].map(|side| BoundsTree::new(self.patches[side].bounds(&placed[side], 0.0)));
        let (near, compared) = trees[0].pairs(&trees[1]);
        work.compared += compared;
        if near.len() > MOST_NEAR {
            return Err(RegionError::Unresolved);
        }
        let sides = [0, 1].map(|side| Side {
            vertices: &placed[side],
            triangles: &self.patches[side].triangles,
            known: &self.patches[side].known,
        });
        let crossing = Crossing::new([&sides[0], &sides[1]], &near);
        let kept = Kept::new(&self.patches, &near, &crossing);
        if self.is_whole {
            work.skipped = work.triangles - kept.count();
        }
        let known = [0, 1].map(|side| kept.known(side, &self.patches[side], &crossing));
        let sags = self.patches.iter().map(Patch::largest_sag);
        let sag = sags.fold(0.0, f64::max);
        let (mut finer, mut found) = (Vec::new(), Vec::new());
        for part in kept.parts(&self.patches, &near) {
            let regions = self.regions(&part, &crossing);
            let sums: Vec<Sums> = regions
                .iter()
                .map(|region| region.sums.turned(&turn.inverse()))
                .collect();
            let is_last = part.iter().any(|triangles| triangles.len() > MOST);
            let is_known = self.coarse.iter().all(|coarse| coarse.len() == sums.len());
            let is_seen = !regions.is_empty() && regions.iter().all(|region| region.has(FEW));
            if is_last || (is_known && is_seen) {
                let is_fine = is_last || regions.iter().all(|region| region.has(ENOUGH));
                if is_fine && !crossing.is_sound {
                    return Err(RegionError::Crossing);
                }
                let is_closed = regions.iter().all(Region::is_closed);
                if is_fine && !is_closed {
                    return Err(RegionError::Unresolved);
                }
                // As sums and bodies are, not turned.
                let placed = [0, 1].map(|side| self.patches[side].placed(bodies[side].pose));
                let all = regions.iter().zip(&sums).map(|(region, sums)| {
                    let triangles = &region.triangles;
                    let farthest = Farthest::new(&self.patches, triangles, &crossing, &placed);
                    self.found(bodies, sums, &farthest, is_fine)
                });
                if let Some(all) = all.collect::<Option<Vec<_>>>().filter(|_| is_closed) {
                    found.extend(all);
                    continue;
                }
            }
            if regions.is_empty() && sag < APART * self.size {
                continue;
            }
            let patches = [0, 1].map(|side| {
                let finer = self.patches[side].part(&part[side], &known[side]);
                let finer = finer.finer(bodies[side].surface);
                work.evaluated += finer.vertices.len();
                finer
            });
            finer.push(Self {
                patches,
                coarse: [sums, self.coarse[0].clone()],
                size: self.size,
                is_whole: false,
            });
        }
        let is_mostly_inside = |corners: &Vec<bool>| {
            let inside = corners.iter().filter(|is_inside| **is_inside).count();
            2 * inside > corners.len()
        };
        Ok(Cut {
            finer,
            found,
            is_mostly_inside: self.is_whole && crossing.inside.iter().any(is_mostly_inside),
        })
    }

    /// What is shared by some triangles of both surfaces, by the places where that hangs together.
    fn regions(&self, part: &[Vec<u32>; 2], crossing: &Crossing) -> Vec<Region> {
        let offset = self.patches[0].triangles.len() as u32;
        let number = |side: usize, triangle: u32| triangle + offset * side as u32;
        let mut sets = DisjointSets::new(self.patches.iter().map(|p| p.triangles.len()).sum());
        for &[one, two] in &crossing.crossed {
            sets.join(number(0, one), number(1, two));
        }
        for (side, triangles) in part.iter().enumerate() {
            let mut first = BTreeMap::new();
            for &triangle in triangles {
                let own = number(side, triangle);
                for corner in self.patches[side].triangles[triangle as usize] {
                    if crossing.inside[side][corner as usize] {
                        sets.join(*first.entry(corner).or_insert(own), own);
                    }
                }
            }
        }
        let mut regions: BTreeMap<u32, Region> = BTreeMap::new();
        for (side, triangles) in part.iter().enumerate() {
            for &triangle in triangles {
                let rim = crossing.rim(side, triangle);
                if rim.is_empty() {
                    continue;
                }
                let region = regions.entry(sets.of(number(side, triangle))).or_default();
                region.triangles[side].push(triangle);
                region.sums += Sums::of(rim, rim[0][0], side == 0);
                let along = rim.iter().map(|[p, q]| p.coords.cross(&q.coords));
                region.open += along.sum::<Vector3<f64>>() * 0.5;
            }
        }
        regions.into_values().filter(Region::is_solid).collect()
    }

    /// What is shared in a region: by its lens if that agrees with its triangles, and by these if they are fine.
    fn found(
        &self,
        bodies: &[Placed<'_>; 2],
        sums: &Sums,
        farthest: &Farthest,
        is_fine: bool,
    ) -> Option<Found> {
        let (sums, volume_error) = self.extrapolated(sums);
        let deepest = farthest.deepest(bodies, &sums.area);
        let lens = deepest
            .as_ref()
            .and_then(|pair| lens(bodies, pair))
            .filter(|(lens, _)| (lens.volume - sums.volume).abs() <= volume_error);
        let (sums, volume_error) = match (lens, is_fine) {
            (Some(lens), _) => lens,
            (None, true) => (sums, volume_error),
            (None, false) => return None,
        };
        Some(Found {
            sums,
            volume_error,
            distance: farthest.distance,
            deepest,
        })
    }

    /// What sums say of surfaces, by those of triangles twice and four times as large, and the error of the volume.
    fn extrapolated(&self, fine: &Sums) -> (Sums, f64) {
        let [coarse, coarser] = &self.coarse;
        let Some(coarse) = fine.nearest(coarse) else {
            return (*fine, fine.volume);
        };
        let best = fine.extrapolated(coarse);
        let error = match fine.nearest(coarser) {
            Some(coarser) => best.volume - coarse.extrapolated(coarser).volume,
            None => best.volume - fine.volume,
        };
        (best, error.abs())
    }
}

/// A place where something is shared.
#[derive(Default)]
struct Region {
    triangles: [Vec<u32>; 2],
    sums: Sums,
    /// The area vector of both surfaces' parts: zero where these enclose it.
    open: Vector3<f64>,
}

impl Region {
    fn is_closed(&self) -> bool {
        self.open.norm() <= CLOSED * self.sums.area.norm()
    }

    /// Whether it has a volume and a normal.
    fn is_solid(&self) -> bool {
        self.sums.volume > 0.0 && self.sums.area.norm() > 0.0
    }

    /// Whether so many triangles of each surface are round it.
    fn has(&self, count: usize) -> bool {
        self.triangles
            .iter()
            .all(|triangles| triangles.len() >= count)
    }
}

/// The point farthest from the middle of others.
fn outermost(points: &[Point3<f64>], others: &[Point3<f64>]) -> usize {
    let sum: Vector3<f64> = others.iter().map(|point| point.coords).sum();
    let middle = Point3::from(sum / others.len().max(1) as f64);
    let apart = |i: &usize| (points[*i] - middle).norm_squared();
    (0..points.len())
        .max_by(|a, b| apart(a).total_cmp(&apart(b)).then(b.cmp(a)))
        .unwrap_or(0)
}
