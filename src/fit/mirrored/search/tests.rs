use crate::fit::{FitError, FitOptions, FitWarning, Fitted, Rejection, Seams, Tolerance, fit};
use crate::measure::grain_properties;
use crate::model::{Mirrored, StarSurface, Surface};
use crate::scan::Scan;
use crate::shapes::{Body, Sampling};
use nalgebra::{Point3, Vector3};

fn mirrored(symmetry: &str) -> FitOptions {
    FitOptions {
        symmetry: symmetry.parse().expect("mirrors"),
        ..FitOptions::default()
    }
}

/// Points in these directions.
fn scan(directions: &[Vector3<f64>], radius: impl Fn(&Vector3<f64>) -> f64) -> Scan {
    Scan {
        points: directions
            .iter()
            .map(|n| Point3::from(n * radius(n)))
            .collect(),
        ..Scan::default()
    }
}

fn fibonacci(points: usize) -> Vec<Vector3<f64>> {
    Sampling::Fibonacci.directions(points, 0).expect("points")
}

fn surface(fitted: &Fitted) -> &Mirrored {
    fitted
        .grain
        .star()
        .and_then(|star| star.family().mirrored())
        .expect("a mirrored grain")
}

fn ellipsoid(n: &Vector3<f64>) -> f64 {
    1.0 / (n.x * n.x / 9.0 + n.y * n.y / 4.0 + n.z * n.z).sqrt()
}

#[test]
fn the_lowest_degree_within_the_limit_is_taken() {
    let scan = scan(&fibonacci(4000), ellipsoid);
    let options = FitOptions {
        max_degree: Some(12),
        tolerance: Tolerance::OfMeanRadius(0.002),
        ..mirrored("xyz")
    };
    let fitted = fit(&scan, &options).expect("a fit");
    let search = &fitted.search;
    let choice = search.choice();
    assert!(choice.heldout_rms <= Some(search.limit));
    assert!((1..12).contains(&choice.degree));
    for (degree, candidate) in search.candidates.iter().enumerate() {
        assert_eq!(candidate.degree, degree);
        let is_within = candidate.heldout_rms.is_some_and(|rms| rms <= search.limit);
        assert_eq!(is_within, degree == choice.degree);
        let is_skipped = candidate.rejected == Some(Rejection::Skipped);
        assert_eq!(is_skipped, degree > choice.degree);
    }
    assert_eq!(surface(&fitted).degree(), choice.degree);
    assert_eq!(fitted.grain.coefficient_count(), choice.coefficients);

    let exhaustive = FitOptions {
        exhaustive: true,
        ..options
    };
    let all = fit(&scan, &exhaustive).expect("a fit");
    assert_eq!(all.search.chosen, search.chosen);
    assert_eq!(all.search.work.candidates_skipped, 0);
    // With the factors of a higher degree, so the same but for rounding.
    for n in fibonacci(50) {
        let radii = [&all, &fitted].map(|fitted| fitted.grain.star().unwrap().radius(&n));
        assert!((radii[0] - radii[1]).abs() < 1e-12, "{radii:?}");
    }
}

#[test]
fn a_held_out_error_is_that_of_a_fit_without_the_point() {
    let directions = fibonacci(200);
    let options = FitOptions {
        degree: Some(2),
        ..mirrored("xyz")
    };
    let fitted = fit(&scan(&directions, ellipsoid), &options).expect("a fit");
    let centre = fitted.grain.frame().centre;
    let samples: Vec<super::super::DirectedSample> = directions
        .iter()
        .map(|n| {
            let local = n * ellipsoid(n) - centre.coords;
            super::super::DirectedSample {
                direction: local,
                radius: local.norm(),
                weight: 1.0,
            }
        })
        .collect();
    let squared: f64 = (0..samples.len())
        .map(|left_out| {
            let mut others = samples.clone();
            let alone = others.remove(left_out);
            let fit = super::super::fit_mirrored(&others, options.symmetry, 2).expect("a fit");
            (alone.radius - fit.radius(&alone.direction.normalize())).powi(2)
        })
        .sum();
    let rms = (squared / samples.len() as f64).sqrt();
    let found = fitted.search.choice().heldout_rms.expect("known");
    assert!((found / rms - 1.0).abs() < 1e-9, "{found} {rms}");
}

#[test]
fn the_bean_is_met_by_one_half() {
    let bean = Body::Bean.surface();
    let options = FitOptions {
        max_degree: Some(20),
        ..mirrored("z")
    };
    let directions = fibonacci(4000);
    let fitted = fit(&scan(&directions, |n| bean.radius(n)), &options).expect("a fit");
    let found = grain_properties(&fitted.grain).properties;
    let truth = crate::measure::integrate(bean.as_ref(), 1e-9).properties;
    assert!((found.area / truth.area - 1.0).abs() < 5e-4);
    assert!((found.volume / truth.volume - 1.0).abs() < 5e-4);
    assert!(fitted.warnings.is_empty(), "{:?}", fitted.warnings);
    let axes = fitted.grain.frame().axes;
    assert_eq!(axes, nalgebra::Matrix3::identity());
}

#[test]
fn the_asymmetry_is_the_difference_of_mirror_images() {
    let directions = fibonacci(6000);
    for share in [0.002, 0.01, 0.1] {
        // Odd in z, with mean square 1/15.
        let lopsided = |n: &Vector3<f64>| 5.0 * (1.0 + share * n.x * n.z);
        let fitted = fit(&scan(&directions, lopsided), &mirrored("yz")).expect("a fit");
        let found = fitted.asymmetry.expect("known") / 5.0;
        // Two of the three pairs of a direction's four images differ: those across z.
        let want = 2.0 * share / 15.0_f64.sqrt() * (2.0_f64 / 3.0).sqrt();
        assert!((found / want - 1.0).abs() < 0.03, "{found} {want}");
        let is_asymmetric = |w: &FitWarning| matches!(w, FitWarning::Asymmetric { .. });
        let is_told = fitted.warnings.iter().any(is_asymmetric);
        assert_eq!(is_told, share > 0.05, "{:?}", fitted.warnings);
    }
}

#[test]
fn noise_is_no_asymmetry() {
    let noise = |n: &Vector3<f64>| (12.9898 * n.x + 78.233 * n.y + 37.719 * n.z).sin() * 43_758.545;
    let noisy = |n: &Vector3<f64>| ellipsoid(n) * (1.0 + 0.06 * (noise(n).fract() - 0.5));
    let fitted = fit(&scan(&fibonacci(6000), noisy), &mirrored("xyz")).expect("a fit");
    // Mean squares of uniform noise: 0.06^2 / 12, so 1.7 % of the radius.
    assert!(fitted.search.noise > Some(0.01 * fitted.mean_radius));
    assert!(fitted.asymmetry.expect("known") < 0.004 * fitted.mean_radius);
}

#[test]
fn neither_order_nor_place_of_the_points_matters() {
    let here = scan(&fibonacci(1500), ellipsoid);
    let mut there = here.clone();
    there.points.reverse();
    there.points.rotate_left(700);
    for point in &mut there.points {
        point.coords += Vector3::new(20.0, -30.0, 10.0);
    }
    let [a, b] = [here, there].map(|scan| fit(&scan, &mirrored("xyz")).expect("a fit"));
    assert_eq!(a.search.chosen, b.search.chosen);
    let pairs = surface(&a)
        .coefficients()
        .iter()
        .zip(surface(&b).coefficients());
    for (a, b) in pairs {
        assert!((a - b).abs() < 1e-11, "{a} {b}");
    }
}

#[test]
fn a_degree_that_the_points_do_not_support_is_lowered_and_told() {
    let options = FitOptions {
        degree: Some(10),
        ..mirrored("xyz")
    };
    let fitted = fit(&scan(&fibonacci(300), ellipsoid), &options).expect("a fit");
    // 37 points in each octant, two per coefficient.
    assert_eq!(surface(&fitted).degree(), 3);
    let told = FitWarning::Rejected {
        reason: Rejection::Unsupported { degree: 10 },
        segments: 1,
        is_only: true,
    };
    assert_eq!(fitted.warnings, [told]);
}

#[test]
fn the_fewest_points_are_fitted() {
    let corners: Vec<Vector3<f64>> = (0..4)
        .map(|i| {
            let sign = |bit: i32| if i >> bit & 1 == 0 { 1.0 } else { -1.0 };
            Vector3::new(sign(0), sign(1), sign(0) * sign(1)).normalize()
        })
        .collect();
    let fitted = fit(&scan(&corners, |_| 2.0), &mirrored("xyz")).expect("a fit");
    assert!((fitted.grain.star().unwrap().radius(&Vector3::x()) - 2.0).abs() < 1e-12);
}

#[test]
fn segments_cannot_be_mirrored() {
    let scan = scan(&fibonacci(300), ellipsoid);
    let refused = |options: FitOptions| {
        assert_eq!(
            fit(&scan, &options).err(),
            Some(FitError::SymmetryOfSegments)
        );
    };
    refused(FitOptions {
        seams: Seams::None,
        ..mirrored("x")
    });
    refused(FitOptions {
        segments: Some(6),
        ..mirrored("x")
    });
    refused(FitOptions {
        max_segments: Some(6),
        ..mirrored("x")
    });
}
