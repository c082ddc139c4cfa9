//! The two points, one of each surface, that lie farthest in the other body along their common normal.

use crate::measure::Curvature;
use crate::model::{Surface, SurfaceJet};
use crate::sphere::tangents;
use nalgebra::{Isometry3, Matrix4, Point3, Vector3, Vector4};

/// Steps of Newton's method, at most.
const STEPS: usize = 20;

/// The last step, in radians.
const LAST: f64 = 1e-12;

/// The largest step, in radians.
const LARGEST: f64 = 0.2;

/// A point of a surface that was moved.
#[derive(Clone, Copy)]
pub(super) struct PlacedPoint<'a> {
    pub(super) surface: &'a dyn Surface,
    pub(super) pose: &'a Isometry3<f64>,
    pub(super) direction: Vector3<f64>,
}

/// What is known of the surface there, in the common frame.
struct Local {
    point: Point3<f64>,
    /// Two orthogonal tangents of the sphere of directions.
    steps: [Vector3<f64>; 2],
    slopes: [Vector3<f64>; 2],
    bends: [[Vector3<f64>; 2]; 2],
}

impl PlacedPoint<'_> {
    fn jet(&self) -> SurfaceJet {
        self.surface.jet(&self.direction)
    }

    fn local(&self) -> Local {
        let jet = self.jet();
        let steps = tangents(&self.direction);
        let turned = |v: Vector3<f64>| self.pose.rotation * v;
        let bend = |s: &Vector3<f64>, t: &Vector3<f64>| {
            turned(Vector3::from_fn(|i, _| s.dot(&(jet.bends[i] * t))))
        };
        Local {
            point: self.pose * (self.surface.frame().centre + jet.place),
            steps,
            slopes: steps.map(|step| turned(jet.slopes * step)),
            bends: [0, 1].map(|i| [0, 1].map(|j| bend(&steps[i], &steps[j]))),
        }
    }

    fn moved(&mut self, local: &Local, step: [f64; 2]) {
        let [s, t] = local.steps;
        self.direction = (self.direction + s * step[0] + t * step[1]).normalize();
    }

    /// The point, and the curvature of the surface there, both in the common frame.
    pub(super) fn curved(&self) -> (Point3<f64>, Curvature) {
        let jet = self.jet();
        let mut curvature = Curvature::new(&self.direction, &jet);
        curvature.normal = self.pose.rotation * curvature.normal;
        curvature.tangents = curvature.tangents.map(|t| self.pose.rotation * t);
        curvature.directions = curvature.directions.map(|t| self.pose.rotation * t);
        (
            self.pose * (self.surface.frame().centre + jet.place),
            curvature,
        )
    }
}

/// Moves two points until the line between them is normal to both surfaces; `false` where that does not end.
pub(super) fn settle(pair: &mut [PlacedPoint<'_>; 2]) -> bool {
    for _ in 0..STEPS {
        let [one, two] = [pair[0].local(), pair[1].local()];
        let apart = one.point - two.point;
        let mut gradient = Vector4::zeros();
        let mut matrix = Matrix4::zeros();
        for i in 0..2 {
            gradient[i] = apart.dot(&one.slopes[i]);
            gradient[2 + i] = apart.dot(&two.slopes[i]);
            for j in 0..2 {
                matrix[(i, j)] = one.slopes[i].dot(&one.slopes[j]) + apart.dot(&one.bends[i][j]);
                matrix[(i, 2 + j)] = -one.slopes[i].dot(&two.slopes[j]);
                matrix[(2 + i, j)] = two.slopes[i].dot(&one.slopes[j]);
                matrix[(2 + i, 2 + j)] =
                    apart.dot(&two.bends[i][j]) - two.slopes[i].dot(&two.slopes[j]);
            }
        }
        let Some(step) = matrix.lu().solve(&-gradient) else {
            return false;
        };
        let most = step.amax();
        if !most.is_finite() {
            return false;
        }
        let step = step * (LARGEST / most).min(1.0);
        pair[0].moved(&one, [step[0], step[1]]);
        pair[1].moved(&two, [step[2], step[3]]);
        if most < LAST {
            return true;
        }
    }
    false
}
