use super::*;
use crate::fit::estimate::cloud::Cloud;
use crate::fit::estimate::spectrum::Spectrum;
use crate::fit::outcome::figures::{derivatives, mass};
use crate::measure::grain_properties;
use crate::model::{Family, Frame, StarGrain, Stretch, Whole};
use crate::sphere::coefficient_count;
use crate::vectorize::dot;
use nalgebra::{Matrix3, Point3};
use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, StandardNormal};

fn normals(count: usize, seed: u64) -> Vec<f64> {
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    (0..count)
        .map(|_| StandardNormal.sample(&mut random))
        .collect()
}

/// A rough surface, and what is left to know of it: a tenth of the variance of its coefficients.
fn rough(degree: usize, stretch: [f64; 3]) -> Estimate {
    let mut coefficients = normals(coefficient_count(degree), 1);
    let spectrum = Spectrum::with_amplitude([-6.0, 0.7, 1.0, -5.0]);
    for (l, v) in spectrum.variances(degree).into_iter().enumerate() {
        for coefficient in &mut coefficients[l * l..(l + 1) * (l + 1)] {
            *coefficient *= v.min(1e-3).sqrt();
        }
    }
    coefficients[0] = 3.5;
    Estimate {
        cloud: Cloud {
            stretch: stretch.into(),
            directions: Vec::new(),
            radii: Vec::new(),
            weights: Vec::new(),
            semi_axes: nalgebra::Vector3::repeat(1.0),
            mean: 2.3,
            compression: 0.0,
        },
        degree,
        coefficients,
        spectrum,
        unlearnt: (0..=degree)
            .map(|l| if l < 3 { 0.0 } else { 0.1 })
            .collect(),
        outliers: 0,
        one_sided: 0,
        sums: std::sync::Arc::new(crate::fit::estimate::sums::Sums::new(degree)),
        factor: None,
        dense: None,
        derived: Default::default(),
    }
}

const STRETCH: [f64; 3] = [1.4, 0.9, 0.7];

#[test]
fn they_are_those_that_are_measured_of_the_grain() {
    for (degree, stretch) in [(8, STRETCH), (30, [1.0; 3]), (30, STRETCH)] {
        let estimate = rough(degree, stretch);
        let radii: Vec<f64> = estimate.coefficients.iter().map(|c| c * 2.3).collect();
        let frame = Frame {
            centre: Point3::origin(),
            axes: Matrix3::identity(),
        };
        let surface = Family::Whole(Whole::new(radii).unwrap());
        let stretch = Stretch::new(Vector3::from(stretch)).unwrap();
        let grain = StarGrain::stretched(frame, stretch, surface).unwrap();
        let want = grain_properties(&grain).properties;
        let have = mass(&RingSurface::new(&estimate).moments()).0;
        assert!((have.area / want.area - 1.0).abs() < 1e-6);
        assert!((have.volume / want.volume - 1.0).abs() < 1e-9);
        assert!((have.centroid - want.centroid).norm() < 1e-9);
        assert!((have.inertia - want.inertia).norm() < 1e-8 * want.inertia.norm());
    }
}

#[test]
fn gradients_are_those_of_differences() {
    let estimate = rough(8, STRETCH);
    let surface = RingSurface::new(&estimate);
    let gradients = surface.gradients();
    let moved = |by: f64, along: &[f64]| {
        let mut moved = estimate.clone();
        for (coefficient, along) in moved.coefficients.iter_mut().zip(along) {
            *coefficient += by * along;
        }
        RingSurface::new(&moved).moments()
    };
    let jacobian = derivatives(&surface.moments());
    let own = |moments: &Moments| {
        let mass = mass(moments).0;
        list(&Moments {
            area: mass.area,
            volume: mass.volume,
            first: mass.centroid.coords,
            second: mass.inertia,
        })
    };
    for seed in 2..6 {
        let along = normals(estimate.coefficients.len(), seed);
        let step = 1e-5;
        let (high, low) = (moved(step, &along), moved(-step, &along));
        let expected = (list(&high) - list(&low)) / (2.0 * step);
        let found: SVector<f64, INTEGRALS> = SVector::from_fn(|i, _| dot(&gradients[i], &along));
        assert!(
            (found - expected).amax() < 1e-6 * expected.amax(),
            "{found} {expected}"
        );
        // And those of centroid and inertia about it.
        let expected = (own(&high) - own(&low)) / (2.0 * step);
        let found = jacobian * found;
        assert!(
            (found - expected).amax() < 1e-6 * expected.amax(),
            "{found} {expected}"
        );
    }
}

/// Surfaces drawn from an isotropic posterior, each with its mirror image, against the second order.
#[test]
fn draws_exceed_their_mean_by_the_second_order() {
    for stretch in [[1.0; 3], STRETCH] {
        let mut estimate = rough(10, stretch);
        // Small enough for the second order to be all.
        estimate.spectrum = Spectrum::with_amplitude([-9.0, 0.7, 1.0, -5.0]);
        let at = list(&RingSurface::new(&estimate).moments());
        let variances = estimate.spectrum.variances(10);
        let mut sum = SVector::<f64, INTEGRALS>::zeros();
        let draws = 400;
        for seed in 0..draws {
            let along = normals(estimate.coefficients.len(), 100 + seed);
            for sign in [1.0, -1.0] {
                let mut drawn = estimate.clone();
                for (l, v) in variances.iter().enumerate() {
                    let sd = sign * (v * estimate.unlearnt[l]).sqrt();
                    let own = l * l..(l + 1) * (l + 1);
                    let normals = &along[own.clone()];
                    for (x, normal) in drawn.coefficients[own].iter_mut().zip(normals) {
                        *x += sd * normal;
                    }
                }
                sum += list(&RingSurface::new(&drawn).moments()) - at;
            }
        }
        let found = sum / (2.0 * draws as f64);
        let expected = list(&RingSurface::new(&estimate).excess(&estimate));
        for i in [0, 1, 5, 6, 7] {
            let ratio = found[i] / expected[i];
            assert!((ratio - 1.0).abs() < 0.05, "{i}: {ratio}");
        }
    }
}
