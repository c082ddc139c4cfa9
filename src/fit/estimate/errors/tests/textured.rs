//! The area of a textured body.

use super::*;

/// A ball with waves in all directions, from a fifth of the girth down to a 120th, the finer the lower.
struct Textured(Vec<(Vector3<f64>, f64)>);

impl Textured {
    fn new(height: f64) -> Self {
        let waves = fibonacci(160).into_iter().enumerate().map(|(i, n)| {
            let degree = 5.0 * 24.0_f64.powf((i * 61 % 160) as f64 / 159.0);
            (n * degree, height / degree.powf(0.8))
        });
        Self(waves.collect())
    }

    fn radius(&self, n: &Vector3<f64>) -> f64 {
        let waves = self.0.iter();
        let waves = waves.map(|(wave, height)| height * wave.dot(n).sin());
        1.0 + waves.sum::<f64>()
    }

    fn area(&self) -> f64 {
        let directions = fibonacci(60_000);
        let elements = directions.iter().map(|n| {
            let r = self.radius(n);
            let slopes = self.0.iter();
            let slope: Vector3<f64> = slopes
                .map(|(wave, height)| wave * (height * wave.dot(n).cos()))
                .sum();
            r * r.hypot((slope - n * n.dot(&slope)).norm())
        });
        elements.sum::<f64>() * 4.0 * PI / directions.len() as f64
    }
}

/// The area of a textured ball is larger than that of any estimate, by more than the posterior knows of.
#[test]
fn texture_between_the_points_is_part_of_the_error_of_the_area() {
    for (height, noise) in [(0.01, 0.0), (0.03, 0.0), (0.03, 0.005)] {
        let body = Textured::new(height);
        let points = samples(&fibonacci(2600), |n| body.radius(n), noise);
        let mut found = best(&estimated(&points, Vector3::repeat(1.0)));
        let error = found.errors(&found.figures).area;
        let missing = body.area() - found.figures.area;
        assert!(missing > 0.0 && missing < 2.0 * error, "{missing} {error}");
        found.texture = 0.0;
        let without = found.errors(&found.figures).area;
        assert!(missing > 3.0 * without, "{missing} {without}");
    }
    // Noise on a smooth body is not taken for texture.
    let axes = Vector3::new(1.3, 1.0, 0.9);
    let found = best(&estimated(
        &samples(&fibonacci(2600), ellipsoid(axes), 0.01),
        axes,
    ));
    let error = found.errors(&found.figures).area;
    assert!(found.texture < 0.2 * error, "{} {error}", found.texture);
}
