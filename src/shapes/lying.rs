//! A grain that lies on the plane of a synthetic tray.

use super::{Body, Sampling, SamplingError, Solid};
use nalgebra::{Point3, Rotation3, Vector3};
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, StandardUniform, UnitSphere};
use std::f64::consts::{PI, TAU};
use std::ops::RangeInclusive;

/// The shapes that take turns, with the semi-axes of those that need some, in millimetres.
pub(super) const KINDS: [(Body, Option<[f64; 3]>); 7] = [
    (Body::Bean, None),
    (Body::Ellipsoid, Some([5.5, 4.0, 3.0])),
    (Body::Chickpea, None),
    (Body::Maize, None),
    (Body::Sphere, Some([4.0, 4.0, 4.0])),
    (Body::Cylinder, Some([4.0, 4.0, 3.0])),
    (Body::Cuboid, Some([5.0, 4.0, 3.0])),
];

/// Those without flat faces come first: these take turns in pairs that touch.
pub(super) const ROUND: usize = 5;

/// Sizes of grains, as multiples of those of the closed forms.
const SIZES: RangeInclusive<f64> = 0.8..=1.1;

/// Directions of a grain by which it is laid down and pushed against another.
const FEELERS: usize = 2000;

/// Heights at which it is looked for what hides a point of the plane.
const HEIGHTS: usize = 32;

/// A grain that lies somewhere.
pub(super) struct Lying {
    solid: Box<dyn Solid>,
    size: f64,
    turn: Rotation3<f64>,
    /// The origin of the solid's own frame.
    pub(super) at: Point3<f64>,
    /// Largest distance of the surface from there, ...
    reach: f64,
    /// ... and that upwards.
    height: f64,
    pub(super) area: f64,
    /// Points of the surface in the solid's own frame, turned.
    feelers: Vec<Vector3<f64>>,
}

impl Lying {
    /// A grain of some kind, on the plane z = 0 above the origin.
    pub(super) fn new(kind: usize, generator: &mut ChaCha8Rng) -> Result<Self, SamplingError> {
        let (body, axes) = KINDS[kind];
        let solid = axes
            .and_then(|axes| body.with_axes(axes.into()).ok())
            .unwrap_or_else(|| body.surface());
        let [size, heading]: [f64; 2] = StandardUniform.sample(generator);
        let size = SIZES.start() + size * (SIZES.end() - SIZES.start());
        let turn = Rotation3::from_axis_angle(&Vector3::z_axis(), heading * TAU);
        let directions = Sampling::Fibonacci.directions(FEELERS, 0)?;
        let feelers: Vec<Vector3<f64>> = directions
            .iter()
            .map(|n| turn * (n * (solid.radius(n) * size)))
            .collect();
        let lowest = feelers.iter().fold(f64::INFINITY, |low, p| low.min(p.z));
        let reach = feelers.iter().fold(0.0, |most: f64, p| most.max(p.norm()));
        let height = feelers.iter().fold(0.0, |most: f64, p| most.max(p.z));
        let area = directions
            .iter()
            .map(|n| stretch(solid.as_ref(), n))
            .sum::<f64>()
            * (4.0 * PI * size * size / FEELERS as f64);
        Ok(Self {
            at: Point3::new(0.0, 0.0, -lowest),
            solid,
            size,
            turn,
            reach,
            height,
            area,
            feelers,
        })
    }

    /// Whether a point is inside, or nearer to the surface than a margin, as seen from the middle.
    pub(super) fn holds(&self, point: &Point3<f64>, margin: f64) -> bool {
        let ray = point - self.at;
        let distance = ray.norm();
        if distance > self.reach + margin {
            return false;
        }
        let n = self.turn.inverse_transform_vector(&ray);
        n.try_normalize(0.0)
            .is_none_or(|n| distance < self.solid.radius(&n) * self.size + margin)
    }

    /// Whether the surfaces of two grains cross, as far as their feelers tell.
    fn crosses(&self, other: &Self) -> bool {
        let reaches = |one: &Self, other: &Self| {
            one.feelers
                .iter()
                .any(|feeler| other.holds(&(one.at + feeler), 0.0))
        };
        reaches(self, other) || reaches(other, self)
    }

    /// Pushes the grain along x against another until they touch.
    pub(super) fn push_against(&mut self, other: &Self) {
        let (mut near, mut far) = (other.at.x, other.at.x + self.reach + other.reach);
        for _ in 0..40 {
            self.at.x = 0.5 * (near + far);
            match self.crosses(other) {
                true => near = self.at.x,
                false => far = self.at.x,
            }
        }
        self.at.x = far;
    }

    /// Whether the grain hides a point of the plane from above.
    pub(super) fn hides(&self, point: &Point3<f64>) -> bool {
        let top = self.at.z + self.height;
        let is_near = (point.xy() - self.at.xy()).norm() < self.reach;
        is_near
            && (0..HEIGHTS).any(|step| {
                let z = top * (step as f64 + 0.5) / HEIGHTS as f64;
                self.holds(&Point3::new(point.x, point.y, z), 0.0)
            })
    }

    /// Points all over the surface, as many per area everywhere.
    pub(super) fn sample(&self, count: usize, generator: &mut ChaCha8Rng) -> Vec<Point3<f64>> {
        let largest = 1.2 * self.largest_stretch();
        let mut points = Vec::with_capacity(count);
        while points.len() < count {
            let n = Vector3::from(UnitSphere.sample(generator));
            let lot: f64 = StandardUniform.sample(generator);
            if lot * largest < stretch(self.solid.as_ref(), &n) {
                let ray = n * (self.solid.radius(&n) * self.size);
                points.push(self.at + self.turn * ray);
            }
        }
        points
    }

    fn largest_stretch(&self) -> f64 {
        let rays = self.feelers.iter();
        let stretches = rays.map(|ray| {
            let n = self.turn.inverse_transform_vector(ray).normalize();
            stretch(self.solid.as_ref(), &n)
        });
        stretches.fold(0.0, f64::max)
    }
}

/// Area of the surface per solid angle.
fn stretch(solid: &dyn Solid, n: &Vector3<f64>) -> f64 {
    let (radius, gradient) = solid.radius_and_gradient(n);
    radius * radius.hypot(gradient.norm())
}
