//! Fits against known shapes, and against the figures of grains.

use super::*;
use crate::fit::Context;
use crate::measure::superquadric_properties;
use crate::model::{StarSurface, Superquadric};
use crate::scan::VoxelLattice;
use crate::shapes::{Body, SynthOptions, synthesize};
use approx::assert_relative_eq;
use nalgebra::{Matrix3, Point3, Rotation3, Vector3};
use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, StandardNormal, Uniform, UnitSphere};

fn between(random: &mut ChaCha8Rng, least: f64, most: f64) -> f64 {
    Uniform::new(least, most).unwrap().sample(random)
}

fn normal(random: &mut ChaCha8Rng) -> Vector3<f64> {
    Vector3::from_fn(|_, _| StandardNormal.sample(random))
}

/// A random superquadric, and a thousand points of it, turned and moved.
fn random_cloud(random: &mut ChaCha8Rng) -> (Superquadric, Vec<Point3<f64>>, f64) {
    let axes = [0; 3].map(|_| between(random, 0.5_f64.ln(), 0.0).exp());
    let [n1, n2] = [0; 2].map(|_| 2.0 / between(random, 0.4, 1.4));
    let shape = Superquadric::single(axes, n1, n2).unwrap();
    let (turn, aside) = (Rotation3::new(normal(random)), normal(random));
    let points: Vec<_> = (0..1000)
        .map(|_| {
            let n = Vector3::from(UnitSphere.sample(random));
            n * shape.radius(&n)
        })
        .collect();
    let mean = points.iter().map(|p| p.norm()).sum::<f64>() / 1000.0;
    let placed = points.iter().map(|p| Point3::from(turn * p + aside));
    (shape, placed.collect(), mean)
}

fn volume(shape: &Superquadric) -> f64 {
    superquadric_properties(shape).properties.volume
}

fn fitted(points: &[Point3<f64>], form: Form) -> SuperquadricFit {
    fit_superquadric(points, None, form, &Context::default()).unwrap()
}

/// A grain's points.
pub(super) fn grain(body: Body) -> Vec<Point3<f64>> {
    let options = SynthOptions::clean(body).with_points(6146);
    synthesize(&options).unwrap().points
}

#[test]
fn random_superquadrics_are_found_in_noise_and_among_strays() {
    let mut errors = [const { Vec::new() }; 3];
    let mut within = Vec::new();
    for seed in 0..40 {
        let random = &mut ChaCha8Rng::seed_from_u64(seed);
        let (shape, clean, mean) = random_cloud(random);
        let noisy: Vec<_> = clean
            .iter()
            .map(|p| p + normal(random) * 0.01 * mean)
            .collect();
        let middle = clean.iter().map(|p| p.coords).sum::<Vector3<f64>>() / 1000.0;
        let mut astray = noisy.clone();
        astray.extend((0..428).map(|_| {
            let aside = Vector3::from_fn(|_, _| between(random, -1.5, 1.5));
            Point3::from(middle + aside)
        }));
        let found = [clean, noisy, astray].map(|points| fitted(&points, Form::Single));
        for (errors, found) in errors.iter_mut().zip(&found) {
            errors.push((volume(&found.shape) / volume(&shape) - 1.0).abs());
        }
        let [_, in_noise, _] = &found;
        if let Some(error) = in_noise.errors.n1[0] {
            // Where z is another axis the exponents are other ones.
            let off = (in_noise.shape.n1()[0] - shape.n1()[0]).abs();
            within.push(off < 1.96 * error || off > 10.0 * error);
        }
    }
    let [clean, noisy, astray] = errors.map(|mut errors| {
        errors.sort_by(f64::total_cmp);
        [errors[errors.len() / 2], errors[errors.len() - 1]]
    });
    assert!(clean[0] < 1e-10 && clean[1] < 1e-6, "{clean:?}");
    assert!(noisy[0] < 1e-3 && noisy[1] < 4e-3, "{noisy:?}");
    assert!(astray[0] < 1e-3 && astray[1] < 4e-3, "{astray:?}");
    let share = within.iter().filter(|&&is_within| is_within).count() as f64 / within.len() as f64;
    assert!(share > 0.8, "{share}");
}

/// Noise of 2 % hides how much nearer half of the points come to a body that leaves a tenth of all out.
#[test]
fn points_astray_are_left_out_in_noise_too() {
    for seed in 0..12 {
        let random = &mut ChaCha8Rng::seed_from_u64(seed);
        let (shape, clean, mean) = random_cloud(random);
        let middle = clean.iter().map(|p| p.coords).sum::<Vector3<f64>>() / 1000.0;
        let noisy: Vec<_> = clean
            .iter()
            .map(|p| {
                let out = (p.coords - middle).normalize();
                let off: f64 = StandardNormal.sample(random);
                p + out * 0.02 * mean * off
            })
            .collect();
        let alone = fitted(&noisy, Form::Single);
        assert_eq!(alone.strays, 0);
        let mut all = noisy;
        all.extend((0..100).map(|_| {
            let aside = Vector3::from_fn(|_, _| between(random, -1.2, 1.2));
            Point3::from(middle + aside)
        }));
        let found = fitted(&all, Form::Single);
        assert!((60..=100).contains(&found.strays), "{}", found.strays);
        let off = volume(&found.shape) / volume(&shape) - 1.0;
        assert!(off.abs() < 0.01, "{seed}: {off}");
        let told = found.solid_errors.unwrap().volume / volume(&found.shape);
        assert!(off.abs() < 4.0 * told, "{seed}: {off} {told}");
    }
}

#[test]
fn the_tip_of_a_grain_is_not_astray() {
    for body in [Body::Maize, Body::Bean] {
        for form in [Form::Single, Form::Poly12] {
            assert_eq!(fitted(&grain(body), form).strays, 0, "{body:?} {form:?}");
        }
    }
}

#[test]
fn a_fit_moves_turns_and_grows_with_the_scan_and_forgets_the_order_of_points() {
    let random = &mut ChaCha8Rng::seed_from_u64(7);
    let (_, points, _) = random_cloud(random);
    let points: Vec<_> = points.iter().map(|p| p + normal(random) * 0.01).collect();
    let turn = Rotation3::new(normal(random));
    let moved = points.iter().rev();
    let moved = moved.map(|p| turn * p * 100.0 + Vector3::new(1e3, -2e3, 500.0));
    let moved: Vec<_> = moved.collect();
    for form in [Form::Single, Form::Poly8, Form::Poly12] {
        let (here, there) = (fitted(&points, form), fitted(&moved, form));
        let grown = volume(&there.shape) / 1e6;
        assert_relative_eq!(volume(&here.shape), grown, max_relative = 1e-8);
        assert_relative_eq!(
            100.0 * here.residuals.rms,
            there.residuals.rms,
            max_relative = 1e-8
        );
    }
}

/// The scan turned by a quarter about z: what was along x is along y. The body's own axes are neither.
#[test]
fn errors_of_the_centre_are_along_the_axes_of_the_scan() {
    let random = &mut ChaCha8Rng::seed_from_u64(7);
    let (_, points, _) = random_cloud(random);
    let noisy = points
        .iter()
        .map(|p| p + normal(random).component_mul(&Vector3::new(0.05, 0.01, 0.01)));
    let noisy: Vec<_> = noisy.collect();
    let turned: Vec<_> = noisy.iter().map(|p| Point3::new(-p.y, p.x, p.z)).collect();
    let [here, there] = [noisy, turned].map(|points| {
        fitted(&points, Form::Single)
            .errors
            .centre
            .map(Option::unwrap)
    });
    for (one, other) in [
        (here[0], there[1]),
        (here[1], there[0]),
        (here[2], there[2]),
    ] {
        assert_relative_eq!(one, other, max_relative = 1e-4);
    }
    assert!(here[0] > 1.5 * here[1].max(here[2]), "{here:?}");
}

#[test]
fn of_a_grain_with_several_minima_the_same_is_found_wherever_it_lies() {
    let points = grain(Body::Maize);
    let here = fitted(&points, Form::Poly12);
    let percent = 100.0 * here.residuals.rms / here.mean_radius;
    assert!(percent < 3.62, "{percent}");
    let bounds = here.errors.at_bound.n2;
    assert!(bounds.as_flattened().contains(&true), "{bounds:?}");
    for (turn, factor, aside) in [
        (Vector3::zeros(), 1.0, Vector3::new(13.7, -5.1, 101.3)),
        (Vector3::zeros(), 100.0, Vector3::zeros()),
        (Vector3::new(0.4, 0.7, -0.2), 1.0, Vector3::zeros()),
    ] {
        let turn = Rotation3::new(turn);
        let moved: Vec<_> = points.iter().map(|p| turn * p * factor + aside).collect();
        let there = fitted(&moved, Form::Poly12);
        let grown = volume(&there.shape) / f64::powi(factor, 3);
        assert_relative_eq!(volume(&here.shape), grown, max_relative = 1e-3);
        assert_relative_eq!(
            factor * here.residuals.rms,
            there.residuals.rms,
            max_relative = 1e-3
        );
    }
}

#[test]
fn grains_are_fitted_as_well_as_so_few_numbers_can() {
    for (body, most) in [
        (Body::Bean, [2.995, 2.415, 1.335]),
        (Body::Chickpea, [1.015, 1.005, 0.835]),
        (Body::Maize, [9.75, 4.5, 3.75]),
    ] {
        let points = grain(body);
        for (form, most) in [Form::Single, Form::Poly8, Form::Poly12]
            .into_iter()
            .zip(most)
        {
            let found = fitted(&points, form);
            let percent = 100.0 * found.residuals.rms / found.mean_radius;
            assert!(percent < most, "{body} {form:?}: {percent}");
        }
    }
}

/// Directions that are spread evenly over an ellipsoid of semi-axes, and where its radius has them.
pub(super) fn points_on(
    shape: &Superquadric,
    count: usize,
    random: &mut ChaCha8Rng,
) -> Vec<Vector3<f64>> {
    let axes = Vector3::from(shape.semi_axes().map(|sides| sides[0]));
    let points = (0..count).map(|_| {
        let n = Vector3::from(UnitSphere.sample(random));
        let n = n.component_mul(&axes).normalize();
        n * shape.radius(&n)
    });
    points.collect()
}

#[test]
fn the_axis_of_a_body_that_is_nearly_a_cube_is_found() {
    for seed in 0..8 {
        let random = &mut ChaCha8Rng::seed_from_u64(seed);
        let axes = [0; 3].map(|_| between(random, 1.0, 1.1));
        let [n1, n2] = [between(random, 5.0, 6.0), between(random, 6.5, 8.0)];
        let shape = Superquadric::single(axes, n1, n2).unwrap();
        let turn = Rotation3::new(normal(random));
        let points = points_on(&shape, 1000, random);
        let points: Vec<_> = points.iter().map(|p| Point3::from(turn * p)).collect();
        let found = fitted(&points, Form::Single);
        assert!(found.residuals.rms < 1e-8, "{seed}: {:?}", found.residuals);
        assert_relative_eq!(found.shape.n1()[0], n1, max_relative = 1e-6);
    }
}

#[test]
fn errors_of_area_and_volume_hold_these() {
    for form in [Form::Single, Form::Poly12] {
        let mut squares = [0.0; 2];
        for seed in 0..20 {
            let random = &mut ChaCha8Rng::seed_from_u64(seed);
            let axes = [0; 3].map(|_| between(random, 10.0, 20.0));
            let [n1, n2] = [0; 2].map(|_| between(random, 2.0, 5.0));
            let shape = Superquadric::single(axes, n1, n2).unwrap();
            let points = points_on(&shape, 600, random);
            let noisy = points
                .iter()
                .map(|p| Point3::from(p + normal(random) * 0.1));
            let found = fitted(&noisy.collect::<Vec<_>>(), form);
            let errors = found.solid_errors.unwrap();
            let [told, truth] =
                [&found.shape, &shape].map(|body| superquadric_properties(body).properties);
            let off = [
                (told.area - truth.area) / errors.area,
                (told.volume - truth.volume) / errors.volume,
            ];
            for (sum, off) in squares.iter_mut().zip(off) {
                *sum += off * off / 20.0;
            }
        }
        let rms = squares.map(f64::sqrt);
        assert!(
            rms.iter().all(|rms| (0.7..1.6).contains(rms)),
            "{form:?}: {rms:?}"
        );
    }
}

#[test]
fn errors_of_exact_points_are_those_of_rounding() {
    let shape = Superquadric::single([30.0, 25.0, 20.0], 5.0, 2.2).unwrap();
    let points = points_on(&shape, 2000, &mut ChaCha8Rng::seed_from_u64(0));
    let exact: Vec<Point3<f64>> = points.into_iter().map(Point3::from).collect();
    let found = fitted(&exact, Form::Single);
    let errors = found.solid_errors.unwrap();
    let [told, truth] = [&found.shape, &shape].map(volume);
    assert!((told - truth).abs() < 2.0 * errors.volume, "{errors:?}");
    assert!(errors.volume < 1e-12 * truth, "{errors:?}");
    let [axis, _] = found.errors.semi_axes[0];
    assert!(axis.unwrap() > 1e-15 * 30.0);
}

#[test]
fn more_numbers_are_never_farther_from_the_points() {
    for seed in 0..8 {
        let random = &mut ChaCha8Rng::seed_from_u64(seed);
        let axes = [0; 3].map(|_| [0; 2].map(|_| between(random, 1.0, 2.0)));
        let n2 = between(random, 2.0, 6.0);
        let n1 = between(random, 2.0, 6.0);
        let shape = Superquadric::poly12(axes, [n1; 2], [[n2; 2]; 2]).unwrap();
        let points = points_on(&shape, 800, random);
        let noisy = points
            .iter()
            .map(|p| Point3::from(p + normal(random) * 0.01));
        let noisy: Vec<_> = noisy.collect();
        let forms = [Form::Single, Form::Poly8, Form::Poly12];
        let rms = forms.map(|form| fitted(&noisy, form).residuals.rms);
        assert!(
            rms.is_sorted_by(|few, many| *many <= few * 1.001),
            "{seed}: {rms:?}"
        );
    }
}

#[test]
fn what_is_no_body_is_refused() {
    let context = Context::default();
    let refused = |points: &[Point3<f64>]| fit_superquadric(points, None, Form::Single, &context);
    let flat: Vec<_> = (0..100)
        .map(|i| Point3::new(f64::from(i), f64::from(i * i % 17), 0.0))
        .collect();
    assert_eq!(refused(&flat), Err(SuperquadricFitError::NoVolume));
    assert_eq!(
        refused(&[Point3::origin(); 100]),
        Err(SuperquadricFitError::NoVolume)
    );
    assert!(matches!(
        refused(&flat[..30]),
        Err(SuperquadricFitError::TooFewPoints { least: 33, .. })
    ));
    let mut odd = flat;
    odd[5].x = f64::NAN;
    assert_eq!(
        refused(&odd),
        Err(SuperquadricFitError::NotFinite { index: 5 })
    );
    let none = fit_multi_superquadric(&odd, None, 0, &context);
    assert!(matches!(none, Err(SuperquadricFitError::Parts { .. })));
}

/// The middles between voxels inside and outside of a body, of voxels of side 1.
fn between_voxels_of(shape: &Superquadric, centre: Vector3<f64>) -> Vec<Point3<f64>> {
    let is_inside = |voxel: Vector3<f64>| {
        let from_centre = voxel - centre;
        from_centre.norm() < shape.radius(&from_centre.normalize())
    };
    let side = || -16..16;
    let voxels = side().flat_map(|x| side().flat_map(move |y| side().map(move |z| [x, y, z])));
    voxels
        .map(|voxel| Vector3::from(voxel.map(f64::from)))
        .flat_map(|voxel| (0..3).map(move |axis| (voxel, Vector3::ith(axis, 1.0))))
        .filter(|(voxel, step)| is_inside(*voxel) != is_inside(voxel + step))
        .map(|(voxel, step)| Point3::from(voxel + 0.5 * step))
        .collect()
}

#[test]
fn errors_hold_flat_sides_that_lie_along_the_layers_of_voxels() {
    let lattice = VoxelLattice {
        first: Point3::origin(),
        steps: Matrix3::identity(),
    };
    let (mut misses, mut unheld) = (Vec::new(), Vec::new());
    for c in [8.05, 8.2, 8.35, 8.45] {
        let shape = Superquadric::single([11.3, 7.4, c], 12.0, 2.0).unwrap();
        let points = between_voxels_of(&shape, Vector3::new(0.1, 0.3, 0.45));
        let miss = |lattice| {
            let context = Context::default();
            let found = fit_superquadric(&points, lattice, Form::Single, &context).unwrap();
            let nearest = |i: usize| (found.shape.semi_axes()[i][0] - c).abs();
            let axis = (0..3)
                .min_by(|&i, &j| nearest(i).total_cmp(&nearest(j)))
                .unwrap();
            nearest(axis) / found.errors.semi_axes[axis][0].unwrap()
        };
        misses.push(miss(Some(&lattice)));
        unheld.push(miss(None));
    }
    let most = |misses: &[f64]| misses.iter().copied().fold(0.0, f64::max);
    assert!(most(&misses) < 3.5, "{misses:?}");
    assert!(most(&unheld) > 8.0, "{unheld:?}");
}
