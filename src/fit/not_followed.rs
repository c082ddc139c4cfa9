//! Points that a radius does not follow, as those of a pin that held the grain.

use super::outcome::Fitted;
use super::warning::FitWarning;
use crate::measure::feet;
use crate::model::Surface;
use nalgebra::Point3;

/// How far a point must be from the surface along its ray, as a share of the mean radius. Of kernels it is .2 at most, of grains
/// with the pin that held them .3 to .9. ...
const FAR: f64 = 0.25;

/// ... Rays that graze steep places pass the surface as far from points that are beside it: its distance must be above this share too ...
const BESIDE: f64 = 0.05;

/// ... and beyond noise. Distances of points whose rays graze are up to 8 times the RMS residual, those of pins 10.7 or more.
const BEYOND_NOISE: f64 = 10.0;

/// The largest distance of such points from the surface, if there are any.
pub(super) fn not_followed(fitted: &Fitted, points: &[Point3<f64>]) -> Option<FitWarning> {
    let noise = BEYOND_NOISE * fitted.residuals.rms;
    let along_rays = noise.max(FAR * fitted.mean_radius);
    // Mostly there is nothing to look for.
    if fitted.residuals.max <= along_rays {
        return None;
    }
    let far = far_along_rays(fitted, points, along_rays);
    let feet = feet(&fitted.grain, &far).into_iter();
    let largest = feet.map(|foot| foot.distance.abs()).fold(0.0, f64::max);
    let share = largest / fitted.mean_radius;
    (largest > noise && share > BESIDE).then_some(FitWarning::NotFollowed { largest, share })
}

/// The points that are farther than so much from a radius along their rays.
fn far_along_rays(fitted: &Fitted, points: &[Point3<f64>], least: f64) -> Vec<Point3<f64>> {
    let Some(star) = fitted.grain.star() else {
        return Vec::new();
    };
    let frame = fitted.grain.frame();
    let locals = points.iter().map(|point| frame.to_local(point));
    let (lengths, directions): (Vec<_>, Vec<_>) = locals
        .map(|local| (local.norm(), local.normalize()))
        .unzip();
    let radii = star.local_radii(&directions);
    let residuals = lengths.iter().zip(radii).map(|(own, radius)| own - radius);
    let far = points.iter().zip(residuals);
    far.filter(|(_, residual)| residual.abs() > least)
        .map(|(point, _)| *point)
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fit::outcome::Residuals;
    use crate::fit::{FitOptions, fit};
    use crate::scan::Scan;
    use crate::shapes::Sampling;
    use nalgebra::Vector3;

    #[test]
    fn a_point_is_told_that_is_far_from_the_surface_and_not_only_along_its_ray() {
        let semi_axes = Vector3::new(1.0, 1.0, 12.0);
        let directions = Sampling::Fibonacci.directions(1000, 0).unwrap();
        let mut points: Vec<Point3<f64>> = directions
            .iter()
            .map(|n| semi_axes.component_mul(n).into())
            .collect();
        let mut fitted = fit(&Scan::from_points(points.clone()), &FitOptions::default()).unwrap();
        let (steep, normal) = (points[100], directions[100].component_div(&semi_axes));
        let mut told = |off: f64, rms: f64| {
            points.push(steep + normal.normalize() * off);
            let max = residual(&fitted, &points[1000]);
            assert!(max > FAR * fitted.mean_radius, "{max}");
            fitted.residuals = Residuals { rms, max };
            let told = not_followed(&fitted, &points);
            points.truncate(1000);
            told
        };
        assert_eq!(told(0.15, 0.02), None);
        assert_eq!(told(0.07, 1e-3), None);
        let Some(FitWarning::NotFollowed { largest, share }) = told(0.5, 0.02) else {
            panic!("not told");
        };
        assert!(
            (largest - 0.5).abs() < 1e-3 && (0.2..0.5).contains(&share),
            "{largest} {share}"
        );
        // So far does noise take points that rays graze.
        assert_eq!(told(0.5, 0.07), None);
    }

    fn residual(fitted: &Fitted, point: &Point3<f64>) -> f64 {
        let star = fitted.grain.star().unwrap();
        let local = fitted.grain.frame().to_local(point);
        (local.norm() - star.local_radii(&[local.normalize()])[0]).abs()
    }
}
