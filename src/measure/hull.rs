//! The convex hull of points in space.
//!
//! Quickhull (Barber, Dobkin and Huhdanpaa 1996): every point outside the hull so far is kept with one
//! facet that it lies outside of; the farthest point of a facet replaces all facets that it sees by a
//! cone, and the points kept with those are handed to facets of the cone. Which side a point is on is
//! decided exactly (crate `robust`, Shewchuk 1997), so the surface is that of the exact hull of the
//! points taken in at every step, closed and manifold, and no point is left outside.
//!
//! Points on the hull's surface that are no corners of it (in a face of a lattice, say) may or may not
//! be vertices of the mesh. Cost: expected O(n log n).
//!
//! No crate does it: parry3d drops points without telling and leaves points outside in some degenerate
//! sets, and takes a minute for a million points that are all on the hull; chull is quadratic.

use crate::Mesh;
use crate::predicates::{orient2d, orient3d};
use nalgebra::{Point3, Vector2, Vector3};
use thiserror::Error;

#[cfg(test)]
mod tests;

/// Why points have no hull with a volume.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Error)]
#[non_exhaustive]
pub enum HullError {
    /// A coordinate is NaN or infinite.
    #[error("point {point} is not finite")]
    NotFinite {
        /// Position of the point.
        point: usize,
    },
    /// More points than indices of 32 bits can name.
    #[error("{points} points are too many for a mesh")]
    TooMany {
        /// Number of points.
        points: usize,
    },
    /// Fewer than four distinct points, or all in one plane or on one line.
    #[error("the points lie in one plane: they have no hull with a volume")]
    Flat,
    /// Coordinates differ by so many orders of magnitude that products of them underflow.
    #[error("the coordinates differ by too many orders of magnitude")]
    Underflow,
}

/// The convex hull of `points` as a closed mesh, counter-clockwise from outside, whose vertices are
/// those of the points that are used, in their order.
///
/// No point lies outside, by an exact test. Facets of more than three corners are cut in triangles in
/// no particular way.
///
/// # Errors
///
/// See [`HullError`].
pub fn convex_hull(points: &[Point3<f64>]) -> Result<Mesh, HullError> {
    if let Some(point) = points.iter().position(|p| !p.iter().all(|c| c.is_finite())) {
        return Err(HullError::NotFinite { point });
    }
    if points.len() >= NONE as usize {
        return Err(HullError::TooMany {
            points: points.len(),
        });
    }
    let scaled = scaled(points);
    let mut hull = Hull::new(&scaled, first_tetrahedron(&scaled).ok_or(HullError::Flat)?);
    while let Some(facet) = hull.pending.pop() {
        hull.take_farthest_of(facet)?;
    }
    Ok(hull.mesh(points))
}

/// The points times a power of two, which is exact, so that products of coordinates do not overflow.
fn scaled(points: &[Point3<f64>]) -> Vec<Point3<f64>> {
    let largest = points
        .iter()
        .fold(0.0, |largest, p| p.coords.amax().max(largest));
    // Half of the exponent at a time: the whole may be out of range.
    let half = (-0.5 * f64::max(largest, f64::MIN_POSITIVE).log2())
        .floor()
        .exp2();
    points.iter().map(|p| p * half * half).collect()
}

/// No point, no facet.
const NONE: u32 = u32::MAX;

/// A triangle of the hull so far.
struct Facet {
    /// Points, counter-clockwise from outside.
    corners: [u32; 3],
    /// Facets across the edges from corner i to corner i + 1.
    neighbours: [u32; 3],
    /// Outward normal, as long as twice the area.
    normal: Vector3<f64>,
    /// Rounding error of a height, at most.
    error: f64,
    /// First of the points kept here, the others follow in [`Hull::next`].
    outside: u32,
    /// The farthest of them, and its height.
    farthest: (u32, f64),
    /// The last point that saw this facet.
    seen_by: u32,
}

struct Hull<'a> {
    points: &'a [Point3<f64>],
    facets: Vec<Facet>,
    /// Places in `facets` that are not of the hull.
    free: Vec<u32>,
    /// Facets that may have points outside.
    pending: Vec<u32>,
    /// By point: the one kept next with the same facet.
    next: Vec<u32>,
    /// By point: the facet of the latest cone that starts, or ends, there on the horizon.
    starts: Vec<u32>,
    ends: Vec<u32>,
    /// Bound of the distance between two points in every coordinate.
    extent: f64,
}

impl<'a> Hull<'a> {
    fn new(points: &'a [Point3<f64>], [a, b, c, d]: [u32; 4]) -> Self {
        let mut hull = Self {
            points,
            facets: Vec::new(),
            free: Vec::new(),
            pending: Vec::new(),
            next: vec![NONE; points.len()],
            starts: vec![NONE; points.len()],
            ends: vec![NONE; points.len()],
            extent: 2.0 * points.iter().fold(0.0, |most, p| p.coords.amax().max(most)),
        };
        // Facet i is across from the first, ... corner of the others.
        let facets = [
            hull.add([a, b, c], [1, 2, 3]),
            hull.add([b, a, d], [0, 3, 2]),
            hull.add([c, b, d], [0, 1, 3]),
            hull.add([a, c, d], [0, 2, 1]),
        ];
        let corners = [a, b, c, d];
        for point in (0..points.len() as u32).filter(|point| !corners.contains(point)) {
            hull.keep(point, &facets);
        }
        hull.pending.extend(facets);
        hull
    }

    /// Adds the facet with these corners and neighbours.
    fn add(&mut self, corners: [u32; 3], neighbours: [u32; 3]) -> u32 {
        let [a, b, c] = corners.map(|corner| self.points[corner as usize]);
        let (u, v) = (b - a, c - a);
        let facet = Facet {
            corners,
            neighbours,
            normal: u.cross(&v),
            // A height has six terms of three factors, each with fewer than ten roundings.
            error: 64.0 * f64::EPSILON * u.amax() * v.amax() * self.extent,
            outside: NONE,
            farthest: (NONE, 0.0),
            seen_by: NONE,
        };
        if let Some(place) = self.free.pop() {
            self.facets[place as usize] = facet;
            return place;
        }
        self.facets.push(facet);
        self.facets.len() as u32 - 1
    }

    /// Height of a point over a facet, times twice its area, if the point is strictly outside.
    #[inline]
    fn height(&self, facet: &Facet, point: u32) -> Option<f64> {
        let position = &self.points[point as usize];
        let [a, b, c] = facet.corners;
        let height = facet.normal.dot(&(position - self.points[a as usize]));
        if height > facet.error {
            return Some(height);
        }
        if height < -facet.error {
            return None;
        }
        let corners = [a, b, c].map(|corner| self.points[corner as usize]);
        (orient3d(corners, *position) < 0.0).then(|| height.max(0.0))
    }

    /// Keeps a point with the first of the facets that it is outside of, if any.
    fn keep(&mut self, point: u32, facets: &[u32]) {
        for &index in facets {
            if let Some(height) = self.height(&self.facets[index as usize], point) {
                let facet = &mut self.facets[index as usize];
                self.next[point as usize] = facet.outside;
                facet.outside = point;
                if facet.farthest.0 == NONE || height > facet.farthest.1 {
                    facet.farthest = (point, height);
                }
                return;
            }
        }
    }

    /// Makes the farthest point outside a facet a vertex of the hull.
    fn take_farthest_of(&mut self, facet: u32) -> Result<(), HullError> {
        let (apex, _) = self.facets[facet as usize].farthest;
        if apex == NONE {
            return Ok(());
        }
        let (visible, horizon) = self.seen_from(apex, facet);
        let mut kept = Vec::new();
        for &index in &visible {
            let facet = &mut self.facets[index as usize];
            let mut point = std::mem::replace(&mut facet.outside, NONE);
            facet.farthest.0 = NONE;
            while point != NONE {
                kept.push(point);
                point = self.next[point as usize];
            }
        }
        self.free.extend(&visible);
        let cone = self.add_cone(apex, &horizon)?;
        for point in kept {
            if point != apex {
                self.keep(point, &cone);
            }
        }
        self.pending.extend(cone);
        Ok(())
    }

    /// The facets that `apex` is strictly outside of, from one of them on, and the edges round them,
    /// each as (from, to, facet beyond).
    ///
    /// Facets in one plane with the apex count as not seen. As seen from a point a little nearer to
    /// the hull, which is in no facet's plane, the facets make a disc, and its border one cycle.
    fn seen_from(&mut self, apex: u32, first: u32) -> (Vec<u32>, Vec<[u32; 3]>) {
        let (mut visible, mut horizon) = (vec![first], Vec::new());
        self.facets[first as usize].seen_by = apex;
        let mut done = 0;
        while let Some(&index) = visible.get(done) {
            done += 1;
            let Facet {
                corners,
                neighbours,
                ..
            } = self.facets[index as usize];
            for edge in 0..3 {
                let beyond = &self.facets[neighbours[edge] as usize];
                if beyond.seen_by == apex {
                    continue;
                }
                if self.height(beyond, apex).is_some() {
                    visible.push(neighbours[edge]);
                    self.facets[neighbours[edge] as usize].seen_by = apex;
                } else {
                    horizon.push([corners[edge], corners[(edge + 1) % 3], neighbours[edge]]);
                }
            }
        }
        (visible, horizon)
    }

    /// Adds the facets from the horizon to the apex.
    ///
    /// The horizon is not one simple cycle only where underflow has made the predicate inexact.
    fn add_cone(&mut self, apex: u32, horizon: &[[u32; 3]]) -> Result<Vec<u32>, HullError> {
        for &[from, to, _] in horizon {
            self.starts[from as usize] = NONE;
            self.ends[to as usize] = NONE;
        }
        let mut cone = Vec::with_capacity(horizon.len());
        for &[from, to, beyond] in horizon {
            let facet = self.add([from, to, apex], [beyond, NONE, NONE]);
            let of_beyond = &mut self.facets[beyond as usize];
            let edge = of_beyond.corners.iter().position(|&corner| corner == to);
            of_beyond.neighbours[edge.ok_or(HullError::Underflow)?] = facet;
            let is_first = self.starts[from as usize] == NONE && self.ends[to as usize] == NONE;
            if !is_first {
                return Err(HullError::Underflow);
            }
            self.starts[from as usize] = facet;
            self.ends[to as usize] = facet;
            cone.push(facet);
        }
        for (&facet, &[from, to, _]) in cone.iter().zip(horizon) {
            let (after, before) = (self.starts[to as usize], self.ends[from as usize]);
            if after == NONE || before == NONE {
                return Err(HullError::Underflow);
            }
            let neighbours = &mut self.facets[facet as usize].neighbours;
            (neighbours[1], neighbours[2]) = (after, before);
        }
        Ok(cone)
    }

    /// The mesh, with the vertices taken from `points`.
    fn mesh(self, points: &[Point3<f64>]) -> Mesh {
        let mut is_free = vec![false; self.facets.len()];
        for place in self.free {
            is_free[place as usize] = true;
        }
        let facets = self.facets.iter().zip(is_free);
        let mut triangles: Vec<[u32; 3]> = facets
            .filter(|(_, is_free)| !is_free)
            .map(|(facet, _)| facet.corners)
            .collect();
        let mut number = vec![NONE; points.len()];
        for corner in triangles.iter().flatten() {
            number[*corner as usize] = 0;
        }
        let mut vertices = Vec::new();
        for (point, number) in points.iter().zip(&mut number) {
            if *number != NONE {
                *number = vertices.len() as u32;
                vertices.push(*point);
            }
        }
        for corner in triangles.iter_mut().flatten() {
            *corner = number[*corner as usize];
        }
        Mesh {
            vertices,
            triangles,
        }
    }
}

/// Four points that are not in one plane, in the order that makes `[a, b, c]` a facet seen from
/// outside; far from each other, if rounding lets them be found. `None` if there are no such points.
fn first_tetrahedron(points: &[Point3<f64>]) -> Option<[u32; 4]> {
    let largest = |measure: &dyn Fn(&Point3<f64>) -> f64,
                   is_valid: &dyn Fn(&Point3<f64>) -> bool| {
        let farthest = points
            .iter()
            .max_by(|p, q| measure(p).total_cmp(&measure(q)))?;
        let chosen = if is_valid(farthest) {
            Some(farthest)
        } else {
            points.iter().find(|p| is_valid(p))
        };
        chosen.copied()
    };
    let a = *points.iter().min_by(|p, q| {
        let order = p.x.total_cmp(&q.x).then(p.y.total_cmp(&q.y));
        order.then(p.z.total_cmp(&q.z))
    })?;
    let b = largest(&|p| (p - a).norm_squared(), &|p| *p != a)?;
    let c = largest(&|p| (b - a).cross(&(p - a)).norm_squared(), &|p| {
        !is_collinear(&a, &b, p)
    })?;
    let normal = (b - a).cross(&(c - a));
    let side = |p: &Point3<f64>| orient3d([a, b, c], *p);
    let d = largest(&|p| normal.dot(&(p - a)).abs(), &|p| side(p) != 0.0)?;
    let index = |q: Point3<f64>| Some(points.iter().position(|p| *p == q)? as u32);
    let [i, j, k, l] = [index(a)?, index(b)?, index(c)?, index(d)?];
    // The predicate is positive for a point below the plane of a counter-clockwise triangle.
    Some(if side(&d) > 0.0 {
        [i, j, k, l]
    } else {
        [i, k, j, l]
    })
}

/// Whether three points are on one line: they are in all three projections along the axes.
fn is_collinear(a: &Point3<f64>, b: &Point3<f64>, c: &Point3<f64>) -> bool {
    (0..3).all(|axis| {
        let seen = |p: &Point3<f64>| Vector2::new(p[axis], p[(axis + 1) % 3]);
        orient2d([a, b, c].map(seen)) == 0.0
    })
}
