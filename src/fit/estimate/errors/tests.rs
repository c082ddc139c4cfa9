mod flat;
mod grooved;
mod pointed;
mod textured;

use super::*;
use crate::fit::estimate::trial::{estimated, fibonacci, lens, samples};
use crate::fit::outcome::figures::{INERTIA, unlist};
use crate::fit::outcome::turn::by_inertia;
use crate::measure::{Moments, Survey};
use crate::model::{Family, Frame, StarGrain};
use crate::shapes::{Body, Sampling, SynthOptions, synthesize};
use nalgebra::Vector3;
use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, StandardNormal};

/// An ellipsoid with these semi-axes.
fn ellipsoid(axes: Vector3<f64>) -> impl Fn(&Vector3<f64>) -> f64 {
    move |n| 1.0 / n.component_div(&axes).norm()
}

fn best(estimate: &Estimate) -> KnownErrors {
    let posterior = estimate.posterior();
    best_with(estimate, &posterior.residuals(&estimate.coefficients))
}

fn best_with(estimate: &Estimate, residuals: &[f64]) -> KnownErrors {
    known(
        estimate,
        &estimate.posterior(),
        residuals,
        (None, &Holes::default()),
        hidden_slopes(estimate),
    )
    .unwrap()
}

fn numbers(errors: &StandardErrors) -> Vec<f64> {
    let mut all = vec![errors.area, errors.volume];
    all.extend(&errors.centroid);
    all.extend(&errors.inertia);
    all.extend(&errors.moments);
    all.extend(&errors.dimensions);
    all.extend(&errors.dimensions_excess);
    all
}

/// Noise in all directions may have swollen a ball all over, by its square as a share of the radius.
#[test]
fn what_all_lengths_may_be_off_by_is_in_the_errors() {
    let noise = 0.1;
    let points = samples(&fibonacci(3000), |_| 1.0, noise);
    let estimate = estimated(&points, Vector3::repeat(1.0));
    let known = best(&estimate);
    let told = &known.figures;
    let swelling = estimate.noise_of_points().powi(2);
    assert!((swelling / (noise * noise) - 1.0).abs() < 0.1);
    let expected = known.errors(told).with_scale(swelling, told);
    let found = estimate.errors(told).unwrap();
    assert!((found.volume / expected.volume - 1.0).abs() < 0.02);
    assert!(found.volume > 2.0 * known.errors(told).volume);
}

/// A sphere of n points with noise s: the mean radius is known to s / sqrt(n), and the volume changes by 4 pi with it.
/// The length is known by at least the nine coefficients of degrees 0 to 2.
#[test]
fn a_noisy_sphere_has_its_closed_form() {
    let (points, noise) = (3000, 0.01);
    let estimate = estimated(
        &samples(&fibonacci(points), |_| 1.0, noise),
        Vector3::repeat(1.0),
    );
    let found = best(&estimate);
    let errors = found.errors(&found.figures);
    let expected = 4.0 * PI * noise / (points as f64).sqrt();
    assert!((errors.volume / expected - 1.0).abs() < 0.1, "{errors:?}");
    assert!((found.figures.volume - 4.0 / 3.0 * PI).abs() < 3.0 * errors.volume);
    assert!((found.figures.area - 4.0 * PI).abs() < 3.0 * errors.area);
    // Equal moments repel each other: the error says so.
    for i in 0..3 {
        assert!((found.figures.moments[i] - 8.0 / 15.0 * PI).abs() < 2.0 * errors.moments[i]);
        assert!((found.figures.dimensions[i] - 2.0).abs() < 2.0 * errors.dimensions[i]);
        let least = noise * (9.0 / points as f64).sqrt();
        assert!(errors.dimensions[i] > least, "{errors:?}");
    }
}

/// What is told instead of the best value is off by as much.
#[test]
fn figures_that_differ_from_the_best_have_larger_errors() {
    let axes = Vector3::new(1.5, 1.2, 0.9);
    let estimate = estimated(&samples(&fibonacci(2600), ellipsoid(axes), 0.005), axes);
    let found = best(&estimate);
    let errors = found.errors(&found.figures);
    let mut told = found.figures;
    told.volume += 10.0 * errors.volume;
    told.dimensions[1] += 5.0 * errors.dimensions[1];
    let larger = found.errors(&told);
    assert!((larger.volume / errors.volume - 10.0).abs() < 0.3);
    assert!(larger.dimensions[1] > 5.0 * errors.dimensions[1]);
    assert_eq!(larger.area, errors.area);
}

/// Systems by conjugate gradients, with a hole, against the factored matrix.
#[test]
fn errors_do_not_depend_on_how_systems_are_solved() {
    let axes = Vector3::new(1.4, 1.0, 0.8);
    let mut directions = fibonacci(2000);
    directions.retain(|n| n.x < 0.95);
    let mut estimate = estimated(&samples(&directions, ellipsoid(axes), 0.004), axes);
    let dense = best(&estimate);
    assert!(estimate.factor.take().is_some());
    let iterative = best(&estimate);
    let pairs = numbers(&dense.errors(&dense.figures));
    let pairs = pairs
        .into_iter()
        .zip(numbers(&iterative.errors(&dense.figures)));
    for (dense, iterative) in pairs {
        assert!(
            (iterative / dense - 1.0).abs() < 0.03,
            "{iterative} {dense}"
        );
    }
}

#[test]
fn holes_and_edges_are_told() {
    let told = best(&estimated(
        &samples(&fibonacci(2600), |_| 1.0, 0.005),
        Vector3::repeat(1.0),
    ))
    .figures;
    for (degrees, is_hole) in [(15.0_f64, false), (35.0, true)] {
        let mut directions = fibonacci(4000);
        directions.retain(|n| n.y < degrees.to_radians().cos());
        let points = samples(&directions, |_| 1.0, 0.005);
        let found = estimated(&points, Vector3::repeat(1.0)).errors(&told);
        match found {
            Err(NoStandardErrors::Hole { half_angle }) => {
                assert!(is_hole && (half_angle.to_degrees() - degrees).abs() < 2.0);
            }
            other => assert!(!is_hole && other.is_ok(), "{degrees}: {other:?}"),
        }
    }
    for body in [Body::Cube, Body::Cylinder, Body::Bicone] {
        let surface = body.surface();
        for noise in [0.0, 0.005] {
            let points = samples(&fibonacci(1538), |n| surface.radius(n), noise);
            let found = estimated(&points, Vector3::repeat(1.0)).errors(&told);
            assert!(
                matches!(found, Err(NoStandardErrors::Unresolved { .. })),
                "{body} {noise}: {found:?}"
            );
        }
    }
}

/// A ball cut by a larger one of radius 3: no estimate resolves the edge, and the errors tell what it takes from the figures.
#[test]
fn errors_beside_an_edge_are_those_of_the_points_left_out() {
    let (top, large) = (0.7, 3.0_f64);
    let down = large - top;
    // Along n, the surface of the larger ball is this far from the middle of the smaller one.
    let reach = |n: &Vector3<f64>| {
        let along = down * n.z;
        (along * along - down * down + large * large).sqrt() - along
    };
    let radius = |n: &Vector3<f64>| reach(n).min(1.0);
    let estimate = estimated(
        &samples(&fibonacci(1538), radius, 0.0),
        Vector3::repeat(1.0),
    );
    let mut surely = best_with(&estimate, &[0.0; 1538]);
    surely.texture = 0.0;
    let told = surely.figures;
    let surely = surely.errors(&told);
    let errors = estimate.errors(&told).unwrap();
    let edge = (large * large - 1.0 - down * down) / (2.0 * down);
    let cap = |radius: f64, height: f64| PI * height * height * (radius - height / 3.0);
    let volume = 4.0 / 3.0 * PI - cap(1.0, 1.0 - edge) + cap(large, top - edge);
    let area = 2.0 * PI * (1.0 + edge + large * (top - edge));
    for (told, truth, error) in [
        (told.volume, volume, errors.volume),
        (told.area, area, errors.area),
        (told.dimensions[2], 1.0 + top, errors.dimensions[2]),
    ] {
        let off = (told - truth) / error;
        assert!(off.abs() < 2.5, "{told} {truth}: {off}");
        assert!(error < 0.02 * truth, "{told} {truth}: {error}");
    }
    assert!(errors.area > 1.5 * surely.area, "{surely:?}");
}

/// Noise hides that the rim is sharp.
#[test]
fn the_error_of_the_area_of_a_lens_holds_what_its_rim_lacks() {
    for half in [1.0, 2.0] {
        let estimate = estimated(&lens(half), Vector3::new(5.0, 5.0, half));
        let told = best(&estimate).figures;
        let error = estimate.errors(&told).unwrap().area;
        let missing = 2.0 * PI * (25.0 + half * half) - told.area;
        assert!((0.3..1.0).contains(&(missing / error)), "{missing} {error}");
    }
}

/// A ball cut by a plane may have its edge on points of a lattice.
#[test]
fn bodies_with_flat_sides_have_no_errors_beside_their_edges() {
    let cut: f64 = 0.6;
    let radius = |n: &Vector3<f64>| if n.z > cut { cut / n.z } else { 1.0 };
    let points = samples(&fibonacci(1538), radius, 0.0);
    let estimate = estimated(&points, Vector3::repeat(1.0));
    let found = estimate.errors(&best(&estimate).figures);
    assert!(
        matches!(found, Err(NoStandardErrors::Unresolved { .. })),
        "{found:?}"
    );
}

/// Few points, a direction given twice, a perfect sphere: numbers or a reason.
#[test]
fn degenerate_clouds_have_finite_errors_or_a_reason() {
    let axes = Vector3::new(1.2, 1.0, 0.9);
    let sphere = Vector3::repeat(1.0);
    let mut clouds = vec![(samples(&fibonacci(2600), |_| 1.0, 0.0), sphere)];
    for points in [4, 5, 8, 20] {
        clouds.push((samples(&fibonacci(points), ellipsoid(axes), 0.0), axes));
        clouds.push((samples(&fibonacci(points), |_| 1.0, 0.0), sphere));
    }
    let mut twice = fibonacci(200);
    twice.extend_from_within(..100);
    twice.extend(vec![Vector3::x(); 30]);
    clouds.push((samples(&twice, ellipsoid(axes), 0.01), axes));
    for (points, axes) in clouds {
        let estimate = estimated(&points, axes);
        let figures = best(&estimate).figures;
        if let Ok(errors) = estimate.errors(&figures) {
            for number in numbers(&errors) {
                assert!(
                    number.is_finite() && number >= 0.0,
                    "{}: {errors:?}",
                    points.len()
                );
            }
        }
        let expansion = Family::Whole(estimate.expansion(estimate.degree));
        let grain = StarGrain::stretched(Frame::SCAN, estimate.stretch(), expansion).unwrap();
        let directions = [Vector3::x(), Vector3::new(0.6, 0.0, 0.8)];
        for error in estimate.radius_errors(&grain, &directions) {
            assert!(error.surface.is_finite() && error.point >= error.surface);
        }
    }
}

/// Extents along the principal axes, which turn: derivatives against differences.
#[test]
fn extents_change_by_their_ends_and_their_axes() {
    let axes = Vector3::new(1.5, 1.2, 0.9);
    let body = Body::Bean.surface();
    let estimate = estimated(&samples(&fibonacci(2600), |n| body.radius(n), 0.05), axes);
    let of = |estimate: &Estimate| {
        let surface = RingSurface::new(estimate);
        let nodes = surface.nodes.iter().zip(&surface.radii);
        let starts: Vec<_> = nodes.map(|((n, _), (r, _))| (*n, *r)).collect();
        let principal = mass(&surface.moments()).1.unwrap();
        (Reach::new(estimate, &starts).unwrap(), principal, surface)
    };
    let (reach, principal, surface) = of(&estimate);
    let jacobian = derivatives(&surface.moments());
    let integrals = surface.gradients();
    let mut random = ChaCha8Rng::seed_from_u64(8);
    let along: Vec<f64> = (0..estimate.coefficients.len())
        .map(|j| {
            let normal: f64 = StandardNormal.sample(&mut random);
            normal / (1.0 + j as f64)
        })
        .collect();
    let moved = |by: f64, i: usize| {
        let mut moved = estimate.clone();
        for (coefficient, along) in moved.coefficients.iter_mut().zip(&along) {
            *coefficient += by * along;
        }
        let (reach, principal, _) = of(&moved);
        reach.along(&principal.axes.column(i).into()).length
    };
    let harmonics = crate::sphere::HarmonicBasis::new(estimate.degree);
    for i in 0..3 {
        let extent = reach.along(&principal.axes.column(i).into());
        let turn = by_inertia(&principal, i, &extent.span, |_, _| 0.0);
        let inertia = |at: usize| {
            dot(
                &combined(integrals.iter(), jacobian.row(INERTIA + at).iter()),
                &along,
            )
        };
        let mut found: f64 = (0..6).map(|at| turn[at] * inertia(at)).sum();
        for end in &extent.ends {
            let mut values = vec![0.0; along.len()];
            harmonics.evaluate(&end.direction, &mut values);
            found += end.by_radius * dot(&values, &along);
        }
        let step = 1e-5;
        let expected = (moved(step, i) - moved(-step, i)) / (2.0 * step);
        assert!(
            (found - expected).abs() < 1e-4 * expected.abs().max(1.0),
            "{found} {expected}"
        );
    }
}

/// Figures that are told as the estimate has them in the mean are off by its covariance only, the area by half of its
/// excess too; what they are told off by is added as a square.
#[test]
fn errors_are_the_roots_of_variances_and_of_what_is_told_off() {
    let axes = Vector3::new(1.5, 1.2, 0.9);
    let estimate = estimated(&samples(&fibonacci(900), ellipsoid(axes), 0.02), axes);
    let found = best(&estimate);
    let variance = |at: usize| found.covariance[(at, at)];
    let excess: Moments = unlist(&found.excess);
    let half = 0.5 * excess.area;
    assert!(half > 0.0);
    let mean = Figures {
        area: found.figures.area + half,
        volume: found.figures.volume + excess.volume,
        centroid: found.figures.centroid + excess.first,
        inertia: found.figures.inertia + excess.second,
        ..found.figures
    };
    let close = |found: f64, square: f64| {
        assert!(
            (found / square.sqrt() - 1.0).abs() < 1e-9,
            "{found} {square}"
        );
    };
    for off in [0.0, 0.07] {
        let mut told = mean;
        told.area += off;
        told.volume -= off;
        told.centroid.add_scalar_mut(off);
        told.inertia.add_scalar_mut(-off);
        told.dimensions.add_scalar_mut(off);
        let errors = found.errors(&told);
        let square = off * off;
        close(
            errors.area,
            half * half + found.texture.powi(2) + variance(0) + square,
        );
        close(errors.volume, variance(1) + square);
        for i in 0..3 {
            close(errors.centroid[i], variance(2 + i) + square);
            close(errors.inertia[(i, i)], variance(INERTIA + i) + square);
            close(errors.dimensions[i], found.dimension_variances[i] + square);
        }
        close(errors.inertia[(1, 2)], variance(INERTIA + 3) + square);
    }
    for i in 0..3 {
        let axis = found.principal.axes.column(i);
        let shift = axis.dot(&(excess.second * axis));
        let square = found.entry_variance(i, i);
        let moments = found.errors(&mean).moments[i];
        close(moments, square + shift.powi(2) + found.repulsion(i).powi(2));
    }
}

/// Noise hides the last of a beak: the length lacks it, and its error says so.
#[test]
fn the_error_of_a_length_covers_what_is_missing_of_a_beak() {
    let truth = synthesize(&SynthOptions::clean(Body::Chickpea))
        .unwrap()
        .truth;
    let surface = Body::Chickpea.surface();
    let survey = Survey::of_surface(surface.as_ref(), truth.properties);
    let length = survey.dimensions().unwrap()[0];
    let noise = 0.005 * truth.mean_radius;
    let points = samples(&fibonacci(1538), |n| surface.radius(n), noise);
    let found = best(&estimated(&points, Vector3::repeat(truth.mean_radius)));
    let error = found.errors(&found.figures).dimensions[0];
    let missing = length - found.figures.dimensions[0];
    assert!(missing > 3.0 * noise, "{missing}");
    assert!(
        (0.5..3.0).contains(&(error / missing)),
        "{error} for {missing}"
    );
}

/// Patches hold one point to a dozen: their means have errors of all sizes, which are no edges.
#[test]
fn noise_of_a_dense_cloud_of_random_points_is_no_edge() {
    let axes = Vector3::new(1.4, 1.2, 1.0);
    let directions = Sampling::Random.directions(40_000, 1).unwrap();
    let estimate = estimated(&samples(&directions, ellipsoid(axes), 0.005), axes);
    assert!(!estimate.is_rough());
    let told = best(&estimate).figures;
    let errors = estimate.errors(&told).unwrap();
    let volume = 4.0 / 3.0 * PI * axes.product();
    assert!((told.volume - volume).abs() < 3.0 * errors.volume);
    assert!(errors.volume < 5e-4 * volume);
}
