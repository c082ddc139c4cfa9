//! The two points, one of each surface, that lie farthest in the other body along their common normal; or, of bodies
//! that are apart, nearest to the other.

use crate::measure::Curvature;
use crate::model::{LocalError, Surface, SurfaceJet};
use crate::sphere::tangents;
use nalgebra::{Isometry3, Matrix2, Matrix4, Point3, Vector2, Vector3, Vector4};

/// Steps of Newton's method, at most.
const STEPS: usize = 20;

/// The last step, in radians: what it leaves is of the order of its square.
const LAST: f64 = 1e-7;

/// The largest step, in radians.
const LARGEST: f64 = 0.2;

/// Rounding of second derivatives, as a share of the largest.
const ROUNDED: f64 = 1e-6;

/// A surface that was moved.
#[derive(Clone, Copy)]
pub(super) struct Placed<'a> {
    pub(super) surface: &'a dyn Surface,
    pub(super) pose: &'a Isometry3<f64>,
}

/// Two points whose line is normal to both surfaces, which face each other there; in the common frame.
#[derive(Debug, Clone, Copy)]
pub(super) struct DeepestPair {
    /// Of each point on its own surface.
    pub(super) directions: [Vector3<f64>; 2],
    pub(super) points: [Point3<f64>; 2],
    /// The unit normal of the first surface, outwards.
    pub(super) normal: Vector3<f64>,
    pub(super) curvatures: [Curvature; 2],
    /// Of both surfaces there, where they are known.
    pub(super) errors: Option<[LocalError; 2]>,
}

/// What is known of a surface in one direction, in the common frame.
struct Local {
    direction: Vector3<f64>,
    jet: SurfaceJet,
    point: Point3<f64>,
    /// Two orthogonal tangents of the sphere of directions.
    steps: [Vector3<f64>; 2],
    slopes: [Vector3<f64>; 2],
    bends: [[Vector3<f64>; 2]; 2],
}

impl Placed<'_> {
    fn local(&self, direction: Vector3<f64>) -> Local {
        let jet = self.surface.jet(&direction);
        let steps = tangents(&direction);
        let turned = |v: Vector3<f64>| self.pose.rotation * v;
        let bend = |s: &Vector3<f64>, t: &Vector3<f64>| {
            turned(Vector3::from_fn(|i, _| s.dot(&(jet.bends[i] * t))))
        };
        Local {
            direction,
            point: self.pose * (self.surface.frame().centre + jet.place),
            steps,
            slopes: steps.map(|step| turned(jet.slopes * step)),
            bends: [0, 1].map(|i| [0, 1].map(|j| bend(&steps[i], &steps[j]))),
            jet,
        }
    }

    /// The curvature of the surface, in the common frame.
    fn curvature(&self, local: &Local) -> Curvature {
        let mut curvature = Curvature::new(&local.direction, &local.jet);
        curvature.normal = self.pose.rotation * curvature.normal;
        curvature.tangents = curvature.tangents.map(|t| self.pose.rotation * t);
        curvature.directions = curvature.directions.map(|t| self.pose.rotation * t);
        curvature
    }
}

impl Local {
    fn moved(&self, [u, v]: [f64; 2]) -> Vector3<f64> {
        (self.direction + self.steps[0] * u + self.steps[1] * v).normalize()
    }

    /// The point after so short a step that the surface is its tangent plane.
    fn shifted(&self, [u, v]: [f64; 2]) -> Point3<f64> {
        self.point + self.slopes[0] * u + self.slopes[1] * v
    }
}

impl DeepestPair {
    /// Moves two points, from directions on their surfaces, until the line between them is normal to both; `None` where
    /// that does not end, or ends where the surfaces do not face each other.
    pub(super) fn settled(bodies: &[Placed<'_>; 2], starts: [Vector3<f64>; 2]) -> Option<Self> {
        let mut directions = starts;
        for _ in 0..STEPS {
            let locals = [0, 1].map(|i| bodies[i].local(directions[i]));
            let step = newton_step(&locals)?;
            let most = step.amax();
            if !most.is_finite() {
                return None;
            }
            let step = step * (LARGEST / most).min(1.0);
            let steps = [[step[0], step[1]], [step[2], step[3]]];
            directions = [0, 1].map(|i| locals[i].moved(steps[i]));
            if most < LAST {
                let curvatures = [0, 1].map(|i| bodies[i].curvature(&locals[i]));
                let normal = curvatures[0].normal;
                let found = Self {
                    directions,
                    points: [0, 1].map(|i| locals[i].shifted(steps[i])),
                    normal,
                    curvatures,
                    errors: errors_at(bodies, &directions),
                };
                return (curvatures[1].normal.dot(&normal) < 0.0).then_some(found);
            }
        }
        None
    }

    /// Whether the surfaces part in all directions from there, or run beside each other: else they are deeper in each other
    /// near by.
    pub(super) fn parts(&self) -> bool {
        let bent = self.parting().symmetric_eigenvalues();
        bent.min() >= -ROUNDED * bent.amax()
    }

    /// How fast the surfaces part, as second derivatives of their distance along the normal in the plane of its
    /// [tangents].
    pub(super) fn parting(&self) -> Matrix2<f64> {
        let [s, t] = tangents(&self.normal);
        let mut bend = Matrix2::zeros();
        for curvature in &self.curvatures {
            for (along, bent) in curvature.directions.iter().zip(curvature.principal) {
                let along = Vector2::new(along.dot(&s), along.dot(&t));
                bend += along * along.transpose() * bent;
            }
        }
        bend
    }

    /// How far the bodies overlap there; below zero, how far they are apart.
    pub(super) fn depth(&self) -> f64 {
        (self.points[0] - self.points[1]).dot(&self.normal)
    }
}

fn errors_at(bodies: &[Placed<'_>; 2], directions: &[Vector3<f64>; 2]) -> Option<[LocalError; 2]> {
    let [one, two] = [0, 1].map(|i| bodies[i].surface.local_error(&directions[i]));
    Some([one?, two?])
}

/// The step to where the line between the points is normal to the first surface, and the normal of the first surface to
/// the second. Unlike two conditions on the line, these hold their own where the points are one.
fn newton_step([one, two]: &[Local; 2]) -> Option<Vector4<f64>> {
    let apart = one.point - two.point;
    let normal = one.slopes[0].cross(&one.slopes[1]).normalize();
    let first = Matrix2::from_fn(|i, j| one.slopes[i].dot(&one.slopes[j]));
    let turns = first.try_inverse()? * Matrix2::from_fn(|i, j| -normal.dot(&one.bends[i][j]));
    let mut side = Vector4::zeros();
    let mut matrix = Matrix4::zeros();
    for i in 0..2 {
        side[i] = -apart.dot(&one.slopes[i]);
        side[2 + i] = -normal.dot(&two.slopes[i]);
        let seen = Vector2::from_fn(|k, _| one.slopes[k].dot(&two.slopes[i]));
        for j in 0..2 {
            matrix[(i, j)] = first[(i, j)] + apart.dot(&one.bends[i][j]);
            matrix[(i, 2 + j)] = -one.slopes[i].dot(&two.slopes[j]);
            matrix[(2 + i, j)] = seen.dot(&turns.column(j));
            matrix[(2 + i, 2 + j)] = normal.dot(&two.bends[i][j]);
        }
    }
    matrix.lu().solve(&side)
}
