//! A union of superquadrics.

use super::connected::apart;
use super::{InvalidSuperquadric, Superquadric};
use crate::model::{Derivatives, Frame, StarSurface, SurfaceJet};
use crate::sphere::Jet;
use nalgebra::{Matrix3, Point3, Vector3};

/// A superquadric and where it lies in the union.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Part {
    /// Its shape.
    pub shape: Superquadric,
    /// Its centre and axes in the frame of the union.
    pub frame: Frame,
}

impl Part {
    /// The part of a union in this frame, in the space of the frame.
    pub(crate) fn placed(&self, frame: &Frame) -> Self {
        Self {
            shape: self.shape,
            frame: self.frame.within(frame),
        }
    }

    /// The direction of a point of the surface from the part's centre, and the jet of the surface over these directions.
    pub(crate) fn jet_at(&self, point: &Point3<f64>) -> (Vector3<f64>, SurfaceJet) {
        let axes = &self.frame.axes;
        let seen = self.frame.to_local(point).normalize();
        let n = axes * seen;
        (n, self.shape.derivatives(&seen).turned(axes).radial(&n))
    }

    /// The gauge of a point of the union's frame.
    #[inline]
    pub fn gauge(&self, x: &Vector3<f64>) -> f64 {
        self.shape.gauge(&self.frame.to_local(&(*x).into()))
    }
}

/// A union of superquadrics, each convex, which together need not be so.
///
/// As a [`StarSurface`] it is the surface that rays from the origin leave last: all of the union's surface where the
/// union is star-shaped about the origin, with creases where parts meet.
#[derive(Debug, Clone, PartialEq)]
pub struct MultiSuperquadric {
    parts: Vec<Part>,
}

impl MultiSuperquadric {
    /// The union of parts that hang together, one of which at least holds the origin.
    ///
    /// # Errors
    /// [`InvalidSuperquadric`] if there is no part, a frame is not orthonormal, the origin is outside, or a part lies apart
    /// from the others.
    pub fn new(parts: Vec<Part>) -> Result<Self, InvalidSuperquadric> {
        if parts.is_empty() {
            return Err(InvalidSuperquadric::NoParts);
        }
        for (index, part) in parts.iter().enumerate() {
            let frame = part.frame.check();
            frame.map_err(|_| InvalidSuperquadric::Frame { part: index })?;
        }
        if let Some(part) = apart(&parts) {
            return Err(InvalidSuperquadric::Apart { part });
        }
        let union = Self { parts };
        match union.gauge(&Vector3::zeros()) < 1.0 {
            true => Ok(union),
            false => Err(InvalidSuperquadric::OriginOutside),
        }
    }

    /// The parts.
    pub fn parts(&self) -> &[Part] {
        &self.parts
    }

    /// The least gauge of the parts, each about its own centre: below one inside of the union.
    pub fn gauge(&self, x: &Vector3<f64>) -> f64 {
        let gauges = self.parts.iter().map(|part| part.gauge(x));
        gauges.fold(f64::INFINITY, f64::min)
    }

    /// The union, so many times as large.
    #[must_use]
    pub fn times(&self, factor: f64) -> Self {
        let parts = self.parts.iter().map(|part| Part {
            shape: part.shape.times(factor),
            frame: Frame {
                centre: part.frame.centre * factor,
                ..part.frame
            },
        });
        Self {
            parts: parts.collect(),
        }
    }

    /// The part that a ray leaves last, and where.
    fn last(&self, n: &Vector3<f64>) -> (&Part, f64) {
        let from = Vector3::zeros();
        let exits = self.parts.iter().map(|part| (part, part.exit(&from, n)));
        let none = (&self.parts[0], 0.0);
        exits.fold(none, |last, (part, exit)| match exit {
            Some(exit) if exit > last.1 => (part, exit),
            _ => last,
        })
    }
}

impl StarSurface for MultiSuperquadric {
    fn radius(&self, n: &Vector3<f64>) -> f64 {
        self.last(n).1
    }

    fn radius_and_gradient(&self, n: &Vector3<f64>) -> (f64, Vector3<f64>) {
        let (part, r) = self.last(n);
        let local = part.frame.to_local(&(n * r).into());
        let slope = part.frame.axes * part.shape.gauge_and_slope(&local).1;
        let gradient = slope * (-r / slope.dot(n));
        (r, gradient - n * gradient.dot(n))
    }

    /// With f the gauge of the part, f(r(m) m) = 1 for all vectors m, r of degree -1. Differentiated once and twice
    /// along dm, with s = grad f . m and dy = m dr + r dm:
    /// dr = -(r/s) grad f . dm, d²r = -(dy.H dy + 2 dr grad f . dm) / s.
    fn derivatives(&self, n: &Vector3<f64>) -> Derivatives {
        let (part, r) = self.last(n);
        let axes = &part.frame.axes;
        let jet = part.shape.gauge_jet(&part.frame.to_local(&(n * r).into()));
        let slope = axes * jet.gradient;
        let bend = axes * jet.hessian * axes.transpose();
        let s = slope.dot(n);
        let gradient = slope * (-r / s);
        let moved = Matrix3::identity() * r + n * gradient.transpose();
        let mixed = gradient * slope.transpose();
        let hessian = (moved.transpose() * bend * moved + mixed + mixed.transpose()) / -s;
        let jet = Jet {
            value: r,
            gradient,
            hessian,
        };
        Derivatives::on_sphere(n, &jet)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;
    use nalgebra::{Point3, Rotation3};

    fn part(centre: [f64; 3], angles: [f64; 3]) -> Part {
        let [roll, pitch, yaw] = angles;
        Part {
            shape: Superquadric::single([1.5, 1.0, 0.8], 3.0, 2.5).unwrap(),
            frame: Frame {
                centre: Point3::from(centre),
                axes: Rotation3::from_euler_angles(roll, pitch, yaw).into_inner(),
            },
        }
    }

    #[test]
    fn the_radius_is_where_the_ray_leaves_last_and_its_derivatives_are_those_of_differences() {
        let union = MultiSuperquadric::new(vec![
            part([0.3, 0.1, -0.2], [0.3, 0.8, -0.5]),
            part([-0.6, 0.3, 0.2], [1.1, -0.4, 0.2]),
        ])
        .unwrap();
        let step = 1e-5;
        for i in 0..50 {
            let t = 2.4 * f64::from(i);
            let z = (f64::from(i) + 0.5) / 25.0 - 1.0;
            let n = Vector3::new(t.cos(), t.sin(), 0.0) * (1.0 - z * z).sqrt() + Vector3::z() * z;
            let found = union.derivatives(&n);
            assert_relative_eq!(union.gauge(&(n * found.radius)), 1.0, max_relative = 1e-12);
            assert!(union.gauge(&(n * found.radius * 1.01)) > 1.0);
            let (r, gradient) = union.radius_and_gradient(&n);
            assert_relative_eq!(r, found.radius, max_relative = 1e-14);
            assert_relative_eq!(gradient, found.gradient, epsilon = 1e-12);
            for tangent in [n.cross(&Vector3::x()), n.cross(&Vector3::y())] {
                let tangent = tangent.normalize();
                let at = |angle: f64| union.radius(&(n * angle.cos() + tangent * angle.sin()));
                let (more, less) = (at(step), at(-step));
                let slope = (more - less) / (2.0 * step);
                assert_relative_eq!(slope, gradient.dot(&tangent), epsilon = 1e-6);
                let bend = (at(1e-3) - 2.0 * r + at(-1e-3)) / 1e-6;
                let expected = tangent.dot(&(found.hessian * tangent));
                assert_relative_eq!(bend, expected, epsilon = 1e-3, max_relative = 1e-3);
            }
        }
    }

    #[test]
    fn a_union_without_its_origin_or_that_falls_apart_is_refused() {
        let aside = part([5.0, 0.0, 0.0], [0.0; 3]);
        let refused = MultiSuperquadric::new(vec![aside]);
        assert_eq!(refused, Err(InvalidSuperquadric::OriginOutside));
        let far = [0.0, 20.0].map(|x| part([x, 0.0, 0.0], [0.0; 3]));
        assert_eq!(
            MultiSuperquadric::new(far.into()),
            Err(InvalidSuperquadric::Apart { part: 1 })
        );
        assert_eq!(
            MultiSuperquadric::new(Vec::new()),
            Err(InvalidSuperquadric::NoParts)
        );
    }
}
