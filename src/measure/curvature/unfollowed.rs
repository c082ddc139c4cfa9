//! Whether a curvature is that of a rounded place, or of a ripple that is too narrow for anything to have told it.

use crate::measure::curvature::Curvature;
use crate::model::Surface;
use nalgebra::Vector3;

/// Where normals turn over a radius of curvature to both sides they do so by this share of it, at least: of a parabola by .70
/// of it, of a quarter of a circle between flat sides by .71.
const FOLLOWED: f64 = 0.65;

/// By how much a principal curvature in a direction, the larger (0) or the smaller (1), is more than the surface turns there, over
/// a radius of curvature to both sides along it, whichever way it bends. Nothing of tips and edges that are rounded; most of it of a
/// ripple, which bends sharply and turns by little.
pub(in crate::measure) fn unfollowed(surface: &dyn Surface, n: &Vector3<f64>, which: usize) -> f64 {
    let here = surface.jet(n);
    let curvature = Curvature::new(n, &here);
    let sharpest = curvature.principal[which].abs();
    if sharpest == 0.0 {
        return 0.0;
    }
    let step = curvature.turn(&(curvature.directions[which] / sharpest));
    let ways = [step, -step].map(|step| {
        let aside = (n + step).normalize();
        let there = surface.jet(&aside);
        let normal = Curvature::new(&aside, &there).normal;
        let way = (there.place - here.place).norm();
        [normal.angle(&curvature.normal), way]
    });
    let [turn, way] = [0, 1].map(|i| ways[0][i] + ways[1][i]);
    (sharpest - turn / way / FOLLOWED).max(0.0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::{Derivatives, Radial, StarSurface};
    use crate::shapes::Ellipsoid;
    use nalgebra::Matrix3;
    use std::f64::consts::PI;

    #[test]
    fn tips_and_rims_are_followed() {
        for axes in [
            [1.0, 1.0, 1.0],
            [1.0, 1.0, 10.0],
            [2.0, 2.0, 1.0],
            [5.0, 3.0, 1.0],
        ] {
            let semi_axes = Vector3::from(axes);
            let body = Ellipsoid { semi_axes };
            let n = Vector3::ith(semi_axes.imax(), 1.0);
            let left = unfollowed(&Radial(&body), &n, 0);
            assert!(left == 0.0, "{axes:?}: {left}");
        }
    }

    /// r = 1 + a cos(k z), whose crests bend by a k² and turn by a k.
    struct Rippled;

    const AMPLITUDE: f64 = 1e-3;
    const WAVE: f64 = 200.0;

    impl StarSurface for Rippled {
        fn radius(&self, n: &Vector3<f64>) -> f64 {
            1.0 + AMPLITUDE * (WAVE * n.z).cos()
        }

        fn radius_and_gradient(&self, n: &Vector3<f64>) -> (f64, Vector3<f64>) {
            let across = Vector3::z() - n * n.z;
            let slope = -AMPLITUDE * WAVE * (WAVE * n.z).sin();
            (self.radius(n), across * slope)
        }

        fn derivatives(&self, n: &Vector3<f64>) -> Derivatives {
            let (radius, gradient) = self.radius_and_gradient(n);
            let across = Vector3::z() - n * n.z;
            let bend = -AMPLITUDE * WAVE * WAVE * (WAVE * n.z).cos();
            let tangential = Matrix3::identity() - n * n.transpose();
            Derivatives {
                radius,
                gradient,
                hessian: across * across.transpose() * bend
                    - tangential * gradient.dot(&Vector3::z()) * n.z,
            }
        }
    }

    #[test]
    fn a_ripple_is_not() {
        let left = unfollowed(&Radial(&Rippled), &Vector3::x(), 0);
        assert!(left > 20.0, "{left}");
        // Half a wave aside it bends inwards by as much.
        let dent = Vector3::new(1.0, 0.0, PI / WAVE).normalize();
        let left = unfollowed(&Radial(&Rippled), &dent, 1);
        assert!(left > 20.0, "{left}");
    }
}
