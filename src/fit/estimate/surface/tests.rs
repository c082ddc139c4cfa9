use super::super::posterior::Posterior;
use super::super::trial::{estimated, fibonacci, samples};
use super::*;

/// Of which one half has an eighth of the points.
#[test]
fn the_deviation_of_an_uneven_cloud_is_that_of_its_posterior() {
    let noise = 0.005;
    let mut directions = fibonacci(6600);
    let mut count = 0;
    directions.retain(|n| {
        count += 1;
        n.x > 0.0 || count % 8 == 0
    });
    let samples = samples(
        &directions,
        |n| 1.0 + 0.1 * n.x * n.y + 0.05 * (5.0 * n.z).sin(),
        noise,
    );
    let estimate = estimated(&samples, Vector3::repeat(1.0));
    assert!(estimate.factor.is_none());
    let posterior = Posterior::new(&estimate.cloud, estimate.degree, true);
    let given = posterior.given(&estimate.spectrum);
    let variances = given.exact_variances(&fibonacci(300)).unwrap();
    let exact = (variances.iter().sum::<f64>() / 300.0).sqrt();
    let told = estimate.deviation() / estimate.cloud.mean;
    assert!((told / exact - 1.0).abs() < 0.1, "{told} {exact}");
}

/// Though the estimate sees means of patches of two points, or of twelve, and a bend of 1e-4 in each patch.
#[test]
fn the_noise_of_a_dense_cloud_is_that_of_its_points() {
    for (points, noise) in [(50_000, 0.02), (300_000, 0.02), (300_000, 4e-6)] {
        let samples = samples(&fibonacci(points), |n| 1.0 + 0.1 * n.x * n.y, noise);
        let estimate = estimated(&samples, Vector3::repeat(1.0));
        assert_eq!(estimate.outliers, 0);
        let told = estimate.noise() / noise;
        assert!((told - 1.0).abs() < 0.02, "{points} {noise}: {told}");
        let held_out = estimate.held_out() / noise;
        assert!(
            (held_out - 1.0).abs() < 0.02,
            "{points} {noise}: {held_out}"
        );
    }
}

/// One in a hundred, 40 standard deviations off, in patches of two points.
#[test]
fn strays_of_a_dense_cloud_are_left_out() {
    let noise = 0.004;
    let mut samples = samples(&fibonacci(50_000), |n| 1.0 + 0.1 * n.x * n.y, noise);
    samples
        .iter_mut()
        .step_by(100)
        .for_each(|sample| sample[3] += 40.0 * noise);
    let estimate = estimated(&samples, Vector3::repeat(1.0));
    assert!(
        (490..=510).contains(&estimate.outliers),
        "{}",
        estimate.outliers
    );
    let told = estimate.noise() / noise;
    assert!((told - 1.0).abs() < 0.05, "{told}");
}

/// An ellipsoid is a ball in the stretched space, in which noise that is alike along its normals is not.
#[test]
fn a_slender_body_is_made_round_however_noisy_it_is() {
    let axes = Vector3::new(6.0, 2.0, 2.0);
    let noise = 0.05;
    let radius = |n: &Vector3<f64>| 1.0 / n.component_div(&axes).norm();
    let errors = samples(&fibonacci(3000), |_| 0.0, noise);
    let moved = errors.iter().map(|[x, y, z, error]| {
        let n = Vector3::new(*x, *y, *z);
        let normal = n.component_div(&axes.component_mul(&axes)).normalize();
        let place: Vector3<f64> = n * radius(&n) + normal * *error;
        let n = place.normalize();
        [n.x, n.y, n.z, place.norm()]
    });
    let estimate = estimated(&moved.collect::<Vec<_>>(), axes);
    let mean = axes.product().cbrt();
    let stretch = axes.map(|axis| mean / axis);
    assert!((estimate.cloud.stretch - stretch).norm() < 1e-9);
    let told = estimate.noise() / noise;
    assert!((told - 1.0).abs() < 0.03, "{told}");
    let off = estimate.stretched_radii(&[Vector3::x()])[0] / mean - 1.0;
    assert!(off.abs() < 2e-3, "{off}");
    // Along a ray n they are off by the noise over N.n.
    let slant = |n: &Vector3<f64>| {
        let normal = n.component_div(&axes.component_mul(&axes)).normalize();
        n.dot(&normal).powi(-2)
    };
    let slants: Vec<f64> = fibonacci(3000).iter().map(slant).collect();
    let along_rays = noise * (slants.iter().sum::<f64>() / 3000.0).sqrt();
    let held_out = estimate.held_out() / along_rays;
    assert!((held_out - 1.0).abs() < 0.03, "{held_out}");
}
