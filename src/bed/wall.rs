//! What holds a bed: planes, the inside of a cylinder, triangles.

use super::link::Touch;
use crate::model::{Frame, Superquadric};
use nalgebra::{Point3, Rotation3, Unit, Vector3};
use std::f64::consts::FRAC_PI_3;

/// Steps to the point of a body that is farthest from the axis of a cylinder; each is farther out than the last.
const OUTWARD_STEPS: usize = 20;

/// Halvings of an edge of a triangle in search of its deepest point.
const EDGE_HALVINGS: usize = 40;

/// A gauge that is surely above one, whatever is lost to rounding.
const OUTSIDE: f64 = 1.0 + 1e-9;

/// Steps of Newton's iteration to the surface of a body.
const SURFACE_STEPS: usize = 20;

/// A fixed, rigid surface.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Wall {
    /// All that lies before the plane through a point; the unit normal points into the bed.
    Plane {
        /// A point of it.
        point: Point3<f64>,
        /// Into the bed.
        normal: Unit<Vector3<f64>>,
    },
    /// The inside of an upright cylinder about the z axis.
    Cylinder {
        /// Its radius, in metres.
        radius: f64,
    },
    /// A triangle, both sides of which hold.
    Triangle {
        /// Its corners.
        corners: [Point3<f64>; 3],
    },
}

impl Wall {
    /// In how many places a contact is looked for: a body lies in a cylinder like a chord, with both ends, or hangs
    /// between.
    pub(super) fn places(&self) -> u16 {
        match self {
            Self::Cylinder { .. } => 3,
            Self::Plane { .. } | Self::Triangle { .. } => 1,
        }
    }

    /// Whether a ball may touch the wall.
    pub(super) fn is_near(&self, centre: &Point3<f64>, radius: f64) -> bool {
        match self {
            Self::Plane { point, normal } => normal.dot(&(centre - point)) < radius,
            Self::Cylinder { radius: wall } => centre.coords.xy().norm() > wall - radius,
            Self::Triangle { corners } => (0..3).all(|axis| {
                let along = corners.map(|corner| corner[axis]);
                let least = along.into_iter().fold(f64::INFINITY, f64::min);
                let most = along.into_iter().fold(f64::NEG_INFINITY, f64::max);
                (least - radius..most + radius).contains(&centre[axis])
            }),
        }
    }

    /// Where a convex body touches the wall; the normal is from the body to the wall.
    pub(super) fn touch(&self, place: u16, shape: &Superquadric, frame: &Frame) -> Option<Touch> {
        match self {
            Self::Plane { point, normal } => on_plane(shape, frame, point, &-normal.into_inner()),
            Self::Cylinder { radius } => in_cylinder(*radius, place, shape, frame),
            Self::Triangle { corners } => on_triangle(corners, shape, frame),
        }
    }
}

/// The support function along a direction of the bed, and its point.
fn support(shape: &Superquadric, frame: &Frame, along: &Vector3<f64>) -> (f64, Point3<f64>) {
    let (height, point) = shape.support(&frame.axes.tr_mul(along));
    (height, frame.to_scan(&point))
}

fn on_plane(
    shape: &Superquadric,
    frame: &Frame,
    point: &Point3<f64>,
    outward: &Vector3<f64>,
) -> Option<Touch> {
    let (height, deepest) = support(shape, frame, outward);
    let overlap = height - outward.dot(&(point - frame.centre));
    (overlap > 0.0).then(|| Touch::new(deepest - outward * (0.5 * overlap), *outward, overlap))
}

/// The point that is farthest from the axis, by steps each of which goes to the farthest point along the last one's
/// direction from the axis.
fn in_cylinder(radius: f64, place: u16, shape: &Superquadric, frame: &Frame) -> Option<Touch> {
    let level = |point: &Point3<f64>| Vector3::new(point.x, point.y, 0.0);
    let from_axis = level(&frame.centre).try_normalize(0.0)?;
    let aside =
        Rotation3::from_axis_angle(&Vector3::z_axis(), FRAC_PI_3 * (f64::from(place) - 1.0));
    let mut outward = aside * from_axis;
    let mut farthest = frame.centre;
    for _ in 0..OUTWARD_STEPS {
        farthest = support(shape, frame, &outward).1;
        outward = level(&farthest).try_normalize(0.0)?;
    }
    let overlap = level(&farthest).norm() - radius;
    (overlap > 0.0).then(|| Touch::new(farthest - outward * (0.5 * overlap), outward, overlap))
}

/// The deepest point of a triangle in a body, where the gauge is least: on the plane that is a closed form, and where
/// this lies beside the triangle it is on an edge.
fn on_triangle(corners: &[Point3<f64>; 3], shape: &Superquadric, frame: &Frame) -> Option<Touch> {
    let [a, b, c] = corners;
    let normal = (b - a).cross(&(c - a)).try_normalize(0.0)?;
    let distance = normal.dot(&(a - frame.centre));
    let outward = normal * 1.0_f64.copysign(distance);
    let (height, farthest) = support(shape, frame, &outward);
    let overlap = height - distance.abs();
    if overlap <= 0.0 {
        return None;
    }
    let deepest = frame.centre + (farthest - frame.centre) * (distance.abs() / height);
    let is_before = |from: &Point3<f64>, to: &Point3<f64>| {
        normal.dot(&(to - from).cross(&(deepest - from))) >= 0.0
    };
    if is_before(a, b) && is_before(b, c) && is_before(c, a) {
        return Some(Touch::new(
            farthest - outward * (0.5 * overlap),
            outward,
            overlap,
        ));
    }
    let edges = [(a, b), (b, c), (c, a)];
    let local = edges.map(|(from, to)| [from, to].map(|point| frame.to_local(point)));
    let on_edges = local.iter().filter_map(|edge| deepest_of_edge(shape, edge));
    let on_edges = on_edges.map(|x| (shape.gauge_and_slope(&x), x));
    let ((gauge, slope), x) =
        on_edges.min_by(|((one, _), _), ((other, _), _)| one.total_cmp(other))?;
    let along = slope.try_normalize(0.0)?;
    if gauge >= 1.0 {
        return None;
    }
    let overlap = to_surface(shape, &x, &along);
    let normal = frame.axes * along;
    let point = frame.to_scan(&x) + normal * (0.5 * overlap);
    (overlap > 0.0).then(|| Touch::new(point, normal, overlap))
}

/// Where the gauge, which is convex, is least on an edge; `None` of one that its tangents show to lie outside.
fn deepest_of_edge(shape: &Superquadric, [from, to]: &[Vector3<f64>; 2]) -> Option<Vector3<f64>> {
    let along = to - from;
    let [mut low, mut high] = [0.0, 1.0];
    for _ in 0..EDGE_HALVINGS {
        let middle = 0.5 * (low + high);
        let (gauge, slope) = shape.gauge_and_slope(&(from + along * middle));
        let rise = slope.dot(&along);
        if gauge - rise.abs() * (middle - low) > OUTSIDE {
            return None;
        }
        match rise > 0.0 {
            true => high = middle,
            false => low = middle,
        }
    }
    Some(from + along * (0.5 * (low + high)))
}

/// How far it is from a point inside to the surface, along a unit vector on which the gauge rises.
fn to_surface(shape: &Superquadric, from: &Vector3<f64>, along: &Vector3<f64>) -> f64 {
    let mut way = 0.0;
    for _ in 0..SURFACE_STEPS {
        let (gauge, slope) = shape.gauge_and_slope(&(from + along * way));
        let step = (1.0 - gauge) / slope.dot(along);
        way += step;
        if step.abs() <= 1e-12 * way.abs() || step.is_nan() {
            break;
        }
    }
    way
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;
    use nalgebra::Matrix3;

    fn at(x: f64, y: f64, z: f64) -> Frame {
        Frame {
            centre: Point3::new(x, y, z),
            axes: Matrix3::identity(),
        }
    }

    #[test]
    fn a_ball_touches_faces_edges_and_corners_of_a_triangle() {
        let ball = Superquadric::single([1.0; 3], 2.0, 2.0).unwrap();
        let corners = [[0.0; 3], [4.0, 0.0, 0.0], [0.0, 4.0, 0.0]].map(Point3::from);
        let wall = Wall::Triangle { corners };
        let slanted = Vector3::new(0.0, 0.6, -0.8);
        let cornered = Vector3::new(1.0, 1.0, -1.0).normalize();
        for (place, normal) in [
            (at(1.0, 1.0, 0.9), -Vector3::z()),
            (at(1.0, 1.0, -0.9), Vector3::z()),
            (at(1.0, -0.54, 0.72), slanted),
        ] {
            let touch = wall.touch(0, &ball, &place).unwrap();
            assert_relative_eq!(touch.overlap, 0.1, epsilon = 1e-9);
            assert_relative_eq!(touch.normal, normal, epsilon = 1e-6);
        }
        let corner = at(-0.9 * cornered.x, -0.9 * cornered.y, -0.9 * cornered.z);
        let touch = wall.touch(0, &ball, &corner).unwrap();
        assert_relative_eq!(touch.overlap, 0.1, epsilon = 1e-6);
        assert_relative_eq!(touch.normal, cornered, epsilon = 1e-6);
        assert_eq!(wall.touch(0, &ball, &at(1.0, -1.01, 0.0)), None);
    }

    #[test]
    fn a_rod_lies_in_a_cylinder_with_both_ends() {
        let rod = Superquadric::single([2.0, 0.2, 0.2], 2.0, 2.0).unwrap();
        let wall = Wall::Cylinder { radius: 2.2 };
        let touched = |place| wall.touch(place, &rod, &at(0.0, 1.0, 0.0));
        let ends = [touched(0).unwrap(), touched(2).unwrap()];
        assert!(ends[0].point.x * ends[1].point.x < 0.0);
        for end in ends {
            // The farthest point of the ellipse from the axis, by its parametric form.
            let farthest = (0..100_000).map(|i| {
                let (sin, cos) = (f64::from(i) * 1e-5 * 3.2).sin_cos();
                (2.0 * cos).hypot(1.0 + 0.2 * sin)
            });
            let expected = farthest.fold(0.0, f64::max) - 2.2;
            assert_relative_eq!(end.overlap, expected, epsilon = 1e-6);
        }
        assert_eq!(wall.touch(1, &rod, &at(0.0, 0.1, 0.0)), None);
    }
}
