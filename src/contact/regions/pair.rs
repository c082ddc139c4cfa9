//! Two bodies that move, and the places where they touch, from one pose to the next.
//!
//! All regions are looked for once, and with them all places where the bodies come nearer to each other than a margin.
//! From pose to pose these are followed by Newton's method, from their last directions, until some point of the bodies
//! has moved by more than the margin: until then what was farther apart cannot touch, nor is a place looked at that is
//! still too far. Regions that part or join meanwhile are told by their deepest points: as one, or as two. Places nearer to
//! each other than the triangles of [`ContactBody`] are large may be taken for one.

use super::cluster::Found;
use super::deepest::DeepestPair;
use super::lens::lens;
use super::near::near_places;
use super::{
    Common, ContactBody, ContactRegion, RegionError, apart_error, check, contact_regions,
    found_regions,
};
use crate::measure::Curvature;
use crate::model::LocalError;
use nalgebra::{Isometry3, Point3, Vector3};

/// The margin, as a share of the smaller body's radius.
const MARGIN: f64 = 0.02;

/// Share of a distance by which rounding may make motions over it too short.
const ROUNDING: f64 = 1e-12;

/// How far a place may move on either sphere of directions from one pose to the next.
const JUMP: f64 = 0.2;

/// Two bodies, the second of which moves.
///
/// ```
/// use grainform::contact::{ContactBody, ContactPair};
/// use grainform::nalgebra::{Isometry3, Vector3};
/// use grainform::{model::Radial, shapes::Ellipsoid};
///
/// let ball = Ellipsoid { semi_axes: Vector3::repeat(1.0) };
/// let ball = Radial(&ball);
/// let body = ContactBody::new(&ball);
/// let mut pair = ContactPair::new(&body, &body);
/// for step in 0..9 {
///     let depth = 0.001 * f64::from(step) - 0.0045;
///     pair.update(&Isometry3::translation(0.0, 0.0, 2.0 - depth))?;
///     assert_eq!(pair.places().len(), usize::from(depth > 0.0));
/// }
/// assert!((pair.places()[0].depth - 0.0035).abs() < 1e-9);
/// assert_eq!(pair.searches(), 1);
/// # Ok::<(), grainform::contact::RegionError>(())
/// ```
#[derive(Debug, Clone)]
pub struct ContactPair<'a> {
    bodies: [&'a ContactBody<'a>; 2],
    margin: f64,
    pose: Isometry3<f64>,
    /// The pose in which the regions were last looked for, if they can be followed from there, and how far.
    searched: Option<(Isometry3<f64>, f64)>,
    followed: Vec<Followed>,
    places: Vec<ContactPlace>,
    searches: usize,
}

/// Two points that face each other.
#[derive(Debug, Clone)]
struct Followed {
    directions: [Vector3<f64>; 2],
    /// How far apart they were when the regions were looked for; below zero where they touched.
    gap: f64,
}

/// Where two bodies touch: the points of both that lie deepest in each other.
#[derive(Debug, Clone)]
#[non_exhaustive]
pub struct ContactPlace {
    /// The middle between them.
    pub point: Point3<f64>,
    /// The unit normal there, from the first body to the second.
    pub normal: Vector3<f64>,
    /// How far the bodies overlap along it.
    pub depth: f64,
    /// Nothing of a region that has no such points: the others are then those of the region.
    deepest: Option<DeepestPair>,
}

impl ContactPlace {
    pub(super) fn of_pair(pair: DeepestPair, centre: &Point3<f64>) -> Self {
        let middle = nalgebra::center(&pair.points[0], &pair.points[1]);
        Self {
            point: middle + centre.coords,
            normal: pair.normal,
            depth: pair.depth(),
            deepest: Some(pair),
        }
    }

    fn of_region(found: &Found, centre: &Point3<f64>) -> Self {
        if let Some(pair) = found.deepest {
            return Self::of_pair(pair, centre);
        }
        let region = found.told(centre);
        Self {
            point: region.point,
            normal: region.normal,
            depth: region.depth,
            deepest: None,
        }
    }

    /// Curvature of both surfaces at the deepest points; none of a region without such points.
    pub fn curvatures(&self) -> Option<&[Curvature; 2]> {
        self.deepest.as_ref().map(|pair| &pair.curvatures)
    }

    /// Standard errors of both surfaces there, where both tell them.
    pub fn errors(&self) -> Option<&[LocalError; 2]> {
        self.deepest.as_ref()?.errors.as_ref()
    }

    /// Standard error of the depth, where both surfaces tell theirs.
    pub fn depth_error(&self) -> Option<f64> {
        self.errors().map(apart_error)
    }
}

impl<'a> ContactPair<'a> {
    /// A pair of which nothing is known yet.
    pub fn new(first: &'a ContactBody<'a>, second: &'a ContactBody<'a>) -> Self {
        Self {
            bodies: [first, second],
            margin: MARGIN * first.radius.min(second.radius),
            pose: Isometry3::identity(),
            searched: None,
            followed: Vec::new(),
            places: Vec::new(),
            searches: 0,
        }
    }

    /// Moves the second body to `pose`, and finds where the bodies touch.
    ///
    /// # Errors
    ///
    /// [`RegionError`]
    pub fn update(&mut self, pose: &Isometry3<f64>) -> Result<(), RegionError> {
        self.places.clear();
        check(self.bodies, pose)?;
        self.pose = *pose;
        match self.follow() {
            Some(()) => Ok(()),
            None => self.search(),
        }
    }

    /// Where the bodies touch in the last pose.
    pub fn places(&self) -> &[ContactPlace] {
        &self.places
    }

    /// How often all regions were looked for.
    pub fn searches(&self) -> usize {
        self.searches
    }

    /// What the bodies share at one of these places: more work than to find it.
    ///
    /// # Errors
    ///
    /// [`RegionError`]
    pub fn region(&self, place: &ContactPlace) -> Result<ContactRegion, RegionError> {
        let common = Common::new(self.bodies, &self.pose);
        if let Some(pair) = place.deepest
            && let Some((sums, volume_error)) = lens(&common.placed(self.bodies), &pair)
        {
            let found = Found {
                sums,
                volume_error,
                distance: place.depth,
                deepest: place.deepest,
            };
            return Ok(found.told(&common.centre));
        }
        let [first, second] = self.bodies;
        let all = contact_regions(first, second, &self.pose)?.regions;
        let off = |region: &ContactRegion| (region.point - place.point).norm();
        let nearest = all.into_iter().min_by(|p, q| off(p).total_cmp(&off(q)));
        nearest.ok_or(RegionError::Crossing)
    }

    /// Follows all places from the last pose; `None` if that proves nothing.
    fn follow(&mut self) -> Option<()> {
        let (from, reach) = self.searched?;
        let motion = self.bodies[1].motion(&from, &self.pose);
        if motion.is_nan() || motion >= reach {
            return None;
        }
        let common = Common::new(self.bodies, &self.pose);
        let placed = common.placed(self.bodies);
        for followed in self.followed.iter_mut().filter(|place| place.gap <= motion) {
            let pair = DeepestPair::settled(&placed, followed.directions)?;
            let jumped = |i: usize| (pair.directions[i] - followed.directions[i]).norm() > JUMP;
            if jumped(0) || jumped(1) {
                return None;
            }
            followed.directions = pair.directions;
            if pair.depth() > 0.0 {
                self.places
                    .push(ContactPlace::of_pair(pair, &common.centre));
            }
        }
        Some(())
    }

    /// Looks for all regions, and for the places within the margin.
    fn search(&mut self) -> Result<(), RegionError> {
        self.searches += 1;
        self.searched = None;
        self.places.clear();
        let common = Common::new(self.bodies, &self.pose);
        let placed = common.placed(self.bodies);
        let clearance = common.clearance(self.bodies);
        if clearance > self.margin {
            self.followed.clear();
            let reach = clearance * (1.0 - ROUNDING);
            self.searched = reach.is_finite().then_some((self.pose, reach));
            return Ok(());
        }
        let (regions, _) = found_regions(self.bodies, &common)?;
        let touching = regions.iter().filter_map(|found| found.deepest);
        let near = near_places(&placed, self.bodies.map(|body| &body.whole), self.margin);
        let followed = touching.chain(near).map(|pair| Followed {
            directions: pair.directions,
            gap: -pair.depth(),
        });
        self.followed = followed.collect();
        let is_followed = regions.iter().all(|found| found.deepest.is_some());
        self.searched = is_followed.then_some((self.pose, self.margin));
        let places = regions.iter();
        self.places
            .extend(places.map(|found| ContactPlace::of_region(found, &common.centre)));
        Ok(())
    }
}
