//! The triangles round a vertex on the sphere: where the vertex may be, and where it had best be.

use super::half_edges::{HalfEdges, next, previous};
use super::rest::{Rest, density};
use crate::sphere::tangents;
use nalgebra::{Matrix2, Matrix3, Vector2, Vector3};

/// Longest step of a vertex, in distances to its nearest neighbour.
const LONGEST_STEP: f64 = 2.0;

/// Halvings of a step that does not lessen the energy.
const HALVINGS: usize = 10;

/// Share of its area at which a triangle is all but flat.
const FLATTENED: f64 = 1e-6;

/// Determinants of the Hessian below this share of its squared trace are no minimum.
const FLAT: f64 = 1e-12;

/// The star of a vertex, filled again for each.
#[derive(Clone, Default)]
pub(super) struct Star {
    sides: Vec<Side>,
}

/// The edge across from the vertex in one of its triangles: from `from` to `to`, seen from outside counter-clockwise.
#[derive(Clone)]
struct Side {
    from: Vector3<f64>,
    to: Vector3<f64>,
    /// from x to, over twice the triangle's area on the sphere: (p - from) . `slope` is det J with the vertex at p.
    slope: Vector3<f64>,
    /// Of |J|²: weights of the squared distances to `from` and `to`, and what the edge itself adds.
    weights: [f64; 2],
    constant: f64,
    area: f64,
}

/// A step and by how much it moved the vertex, in distances to its nearest neighbour.
pub(super) struct Step {
    pub(super) place: Vector3<f64>,
    pub(super) moved: f64,
}

impl Star {
    /// Takes the star of a vertex; areas of the rest triangles times `scale` are those on the sphere.
    pub(super) fn take(
        &mut self,
        v: u32,
        half_edges: &HalfEdges,
        places: &[Vector3<f64>],
        rests: &[Rest],
        scale: f64,
    ) {
        self.sides.clear();
        self.sides.extend(half_edges.around(v).map(|h| {
            let [from, to] = [next(h), previous(h)].map(|h| places[half_edges.origin(h) as usize]);
            let (triangle, corner) = ((h / 3) as usize, (h % 3) as usize);
            let Rest { weights, area } = rests[triangle];
            let weight = |edge: usize| weights[(corner + edge) % 3];
            let edge = to - from;
            Side {
                from,
                to,
                slope: from.cross(&edge) / (2.0 * area * scale),
                weights: [weight(0), weight(2)],
                constant: weight(1) * edge.norm_squared(),
                area,
            }
        }));
    }

    /// The energy with the vertex at a place; infinite where a triangle turns over.
    pub(super) fn energy(&self, place: &Vector3<f64>) -> f64 {
        let mut sum = 0.0;
        for side in &self.sides {
            let (p, q) = (place - side.from, place - side.to);
            let d = p.dot(&side.slope);
            if d.is_nan() || d <= 0.0 {
                return f64::INFINITY;
            }
            let squared = side.weights[0] * p.norm_squared()
                + side.weights[1] * q.norm_squared()
                + side.constant;
            sum += side.area * squared * density(d)[0];
        }
        sum
    }

    /// To the middle of the kernel, from a place where a triangle is all but flat, or by rounding turned over: from there Newton's
    /// method takes a hundred steps, or none. `None` of other places, and where the energy is no less there.
    pub(super) fn leap(&self, place: &Vector3<f64>) -> Option<Step> {
        let is_flat = |side: &Side| (place - side.from).dot(&side.slope) < FLATTENED;
        let is_stuck = self.sides.iter().any(is_flat);
        let centre = is_stuck.then(|| self.kernel_centre(place)).flatten()?;
        (self.energy(&centre) < self.energy(place)).then_some(Step {
            place: centre,
            moved: 1.0,
        })
    }

    /// One step of Newton's method in the tangent plane, halved until the energy falls. `None` if no step lessens it.
    pub(super) fn step(&self, place: &Vector3<f64>) -> Option<Step> {
        let (mut energy, mut gradient, mut hessian) = (0.0, Vector3::zeros(), Matrix3::zeros());
        let mut nearest = f64::INFINITY;
        for side in &self.sides {
            let (p, q) = (place - side.from, place - side.to);
            let d = p.dot(&side.slope);
            if d.is_nan() || d <= 0.0 {
                return None;
            }
            let [w, x] = side.weights;
            let (pp, qq) = (p.norm_squared(), q.norm_squared());
            nearest = nearest.min(pp);
            let squared = w * pp + x * qq + side.constant;
            let [value, first, second] = density(d).map(|derivative| derivative * side.area);
            let along = (p * w + q * x) * 2.0;
            let slope = &side.slope;
            energy += value * squared;
            gradient += along * value + slope * (squared * first);
            // first (along slope^T + slope along^T) + second squared slope slope^T is half of this and its transpose.
            let half = along * (2.0 * first) + slope * (squared * second);
            hessian += half * slope.transpose();
            let own = 2.0 * value * (w + x);
            hessian[(0, 0)] += own;
            hessian[(1, 1)] += own;
            hessian[(2, 2)] += own;
        }
        // Along the sphere n + a s + b t - n (s² + t²) / 2.
        let [a, b] = tangents(place);
        let bend = gradient.dot(place);
        let gradient = Vector2::new(gradient.dot(&a), gradient.dot(&b));
        let mixed = 0.5 * (a.dot(&(hessian * b)) + b.dot(&(hessian * a)));
        let hessian = Matrix2::new(
            a.dot(&(hessian * a)) - bend,
            mixed,
            mixed,
            b.dot(&(hessian * b)) - bend,
        );
        let nearest = nearest.sqrt();
        let (trace, determinant) = (hessian.trace(), hessian.determinant());
        let mut step = match hessian[(0, 0)] > 0.0 && determinant > FLAT * trace * trace {
            true => {
                Vector2::new(
                    hessian[(0, 1)] * gradient.y - hessian[(1, 1)] * gradient.x,
                    hessian[(0, 1)] * gradient.x - hessian[(0, 0)] * gradient.y,
                ) / determinant
            }
            false => -gradient.try_normalize(0.0)? * (0.1 * nearest),
        };
        let longest = LONGEST_STEP * nearest;
        if step.norm() > longest {
            step *= longest / step.norm();
        }
        for _ in 0..HALVINGS {
            let place = (place + a * step.x + b * step.y).normalize();
            if self.energy(&place) < energy {
                return Some(Step {
                    place,
                    moved: step.norm() / nearest,
                });
            }
            step *= 0.5;
        }
        None
    }

    /// The middle of the kernel, the places from which all sides are seen, with the vertex coming from the neighbour
    /// at `parent`. `None` if numbers tell of no kernel.
    pub(super) fn kernel_centre(&self, parent: &Vector3<f64>) -> Option<Vector3<f64>> {
        let [a, b] = tangents(parent);
        let distances = self.sides.iter().map(|side| (side.from - parent).norm());
        let reach = distances.fold(0.0, f64::max);
        // In the tangent plane at the parent planes through the centre are lines.
        let mut polygon = [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]]
            .map(|corner| Vector2::from(corner) * (2.0 * reach).min(FARTHEST))
            .to_vec();
        for side in &self.sides {
            let normal = side.slope.try_normalize(0.0)?;
            let at_parent = match &side.from == parent || &side.to == parent {
                true => 0.0,
                false => normal.dot(&(parent - side.from)),
            };
            let line = Vector2::new(normal.dot(&a), normal.dot(&b));
            polygon = clip(&polygon, |place| at_parent + line.dot(place));
        }
        let on_sphere = |place: Vector2<f64>| (parent + a * place.x + b * place.y).normalize();
        let mean = polygon.iter().sum::<Vector2<f64>>() / polygon.len() as f64;
        let candidates = [centroid(&polygon).map(on_sphere), Some(on_sphere(mean))];
        let mut candidates = candidates.into_iter().flatten();
        candidates.find(|place| self.energy(place).is_finite())
    }
}

/// Half the side of the square in a tangent plane that holds every kernel that matters: 60 degrees.
const FARTHEST: f64 = 1.7;

/// The part of a convex polygon where a linear function is above zero.
fn clip(polygon: &[Vector2<f64>], height: impl Fn(&Vector2<f64>) -> f64) -> Vec<Vector2<f64>> {
    let mut kept = Vec::with_capacity(polygon.len() + 1);
    for (at, from) in polygon.iter().enumerate() {
        let to = &polygon[(at + 1) % polygon.len()];
        let (low, high) = (height(from), height(to));
        if low > 0.0 {
            kept.push(*from);
        }
        if (low > 0.0) != (high > 0.0) {
            kept.push(from + (to - from) * (low / (low - high)));
        }
    }
    kept
}

fn centroid(polygon: &[Vector2<f64>]) -> Option<Vector2<f64>> {
    let origin = polygon.first()?;
    let (mut area, mut sum) = (0.0, Vector2::zeros());
    for pair in polygon[1..].windows(2) {
        let (one, other) = (pair[0] - origin, pair[1] - origin);
        let twice = one.perp(&other);
        area += twice;
        sum += (one + other) * twice;
    }
    (area > 0.0).then(|| origin + sum / (3.0 * area))
}
