//! Portal refinement on the support functions (Snethen 2008, "Xenocollide"), with both bounds of the ratio.
//!
//! The sum of the first body and the mirrored second is convex and holds the origin; the ray to the other centre c
//! leaves it at c / mu. A portal, a triangle of points of the sum that the ray goes through, is moved outwards until
//! the support along its normal is no farther than itself.

use super::pair::{ConvexPair, Found, Goal};
use nalgebra::Vector3;

/// Portals allowed; a gap of 1e-6 takes 25, at most 48 were seen.
const MAX_PORTALS: usize = 4000;

/// Turns allowed to a first portal.
const MAX_TURNS: usize = 60;

/// Below this squared sine a ray goes through a point.
const ALONG_RAY: f64 = 1e-24;

/// A point of the sum of one body and the other mirrored, and where it is on the first body.
#[derive(Debug, Clone, Copy)]
struct Corner {
    sum: Vector3<f64>,
    on_first: Vector3<f64>,
    height: f64,
}

/// The farthest point along a direction.
fn farthest(pair: &ConvexPair<'_>, d: &Vector3<f64>) -> Corner {
    let [(first, on_first), (second, on_second)] = pair.supports(d);
    Corner {
        sum: on_first - pair.turn * on_second,
        on_first,
        height: first + second,
    }
}

pub(super) fn solve(pair: &ConvexPair<'_>, goal: &Goal) -> Found {
    let c = pair.offset;
    let along = farthest(pair, &c);
    let lower = c.norm_squared() / along.height;
    let mut found = Found {
        lower,
        iterations: 1,
        ..Found::start(pair, c)
    };
    let aside = along.sum.cross(&c);
    if aside.norm_squared() <= ALONG_RAY * along.sum.norm_squared() * c.norm_squared() {
        // The ray goes through a support point, as of stacked faces: that is the contact.
        (found.upper, found.is_settled) = (lower, true);
        found.point = along.on_first * lower;
        return found;
    }
    let mut portal = first_portal(pair, along, aside, &mut found.iterations);
    while found.iterations < MAX_PORTALS {
        found.iterations += 1;
        let [v1, v2, v3] = portal.map(|corner| corner.sum);
        let Some(normal) = (v2 - v1).cross(&(v3 - v1)).try_normalize(0.0) else {
            break;
        };
        let normal = normal * normal.dot(&v1).signum();
        let (reach, plane) = (normal.dot(&c), normal.dot(&v1));
        if reach <= 0.0 {
            break;
        }
        let next = farthest(pair, &normal);
        // The ray leaves the sum behind the portal.
        let upper = reach / plane;
        if upper < found.upper {
            (found.upper, found.point) = (upper, on_ray(&portal, &c) * upper);
        }
        if reach / next.height > found.lower {
            (found.lower, found.normal) = (reach / next.height, normal);
        }
        found.is_settled = goal.is_met(&found);
        if found.is_settled {
            break;
        }
        // The new point makes three portals with the edges of the old one.
        let side = c.cross(&next.sum);
        let replaced = match v1.dot(&side) > 0.0 {
            true if v2.dot(&side) > 0.0 => 0,
            true => 2,
            false if v3.dot(&side) > 0.0 => 1,
            false => 0,
        };
        portal[replaced] = next;
    }
    found
}

/// A portal through which the ray goes.
fn first_portal(
    pair: &ConvexPair<'_>,
    along: Corner,
    aside: Vector3<f64>,
    iterations: &mut usize,
) -> [Corner; 3] {
    let c = pair.offset;
    let mut portal = [along, farthest(pair, &aside), along];
    let mut up = along.sum.cross(&portal[1].sum);
    if up.dot(&c) < 0.0 {
        portal.swap(0, 1);
        up = -up;
    }
    portal[2] = farthest(pair, &up);
    *iterations += 2;
    for _ in 0..MAX_TURNS {
        let [v1, v2, v3] = portal.map(|corner| corner.sum);
        if v1.cross(&v3).dot(&c) > 0.0 {
            portal[1] = portal[2];
        } else if v3.cross(&v2).dot(&c) > 0.0 {
            portal[0] = portal[2];
        } else {
            break;
        }
        portal[2] = farthest(pair, &portal[0].sum.cross(&portal[1].sum));
        *iterations += 1;
    }
    portal
}

/// Where the ray meets the portal, as a point of the first body.
fn on_ray(portal: &[Corner; 3], c: &Vector3<f64>) -> Vector3<f64> {
    let [v1, v2, v3] = portal.map(|corner| corner.sum);
    let shares = [
        c.dot(&v2.cross(&v3)),
        c.dot(&v3.cross(&v1)),
        c.dot(&v1.cross(&v2)),
    ];
    let sum: f64 = shares.iter().sum();
    let points = portal.iter().zip(shares);
    points
        .map(|(corner, share)| corner.on_first * (share / sum))
        .sum()
}
