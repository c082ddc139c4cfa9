//! What is told where the limit cannot be met, and of the largest difference.

use super::*;

#[test]
fn bounds_are_kept_where_the_limit_cannot_be_met() {
    let target = texture(3);
    for (max_degree, max_segments, degree) in [
        (2, 30, None),
        (1, 100, None),
        (4, 6, None),
        (4, 1, None),
        (9, 24, Some(2)),
        (0, 60, None),
    ] {
        let settings = Settings {
            degree,
            max_degree,
            max_segments,
            ..Settings::within(0.0)
        };
        let outcome = found(&target, &settings);
        assert!(!outcome.met && outcome.rms.is_finite());
        assert!(outcome.surface.cover().cells().len() <= max_segments.max(6));
        assert!(outcome.surface.degree() <= degree.unwrap_or(max_degree));
        let exact = rms(&target, &outcome.surface);
        assert!((outcome.rms / exact - 1.0).abs() < 0.1, "{exact}");
        let [chosen, nearest] = [outcome.rounds[outcome.chosen].rms, nearest(&outcome)];
        assert_eq!(chosen, outcome.rms);
        assert_eq!(chosen, nearest);
    }
}

fn nearest(outcome: &Outcome) -> f64 {
    let all = outcome.rounds.iter().map(|round| round.rms);
    all.fold(f64::INFINITY, f64::min)
}

/// The bean in planes, which no cover of 600 cells follows.
#[test]
fn the_nearest_of_covers_of_one_size_is_told_with_its_own_error() {
    let bean = body(Body::Bean);
    let settings = Settings {
        max_degree: 1,
        max_segments: 600,
        ..Settings::within(3e-4 * mean(&bean))
    };
    let outcome = found(&bean, &settings);
    let chosen = &outcome.rounds[outcome.chosen];
    assert!(outcome.rounds.iter().all(|round| round.cells <= 600));
    assert_eq!([chosen.rms, nearest(&outcome)], [outcome.rms; 2]);
    let exact = rms(&bean, &outcome.surface);
    assert!(
        (outcome.rms / exact - 1.0).abs() < 0.1,
        "{} {exact}",
        outcome.rms
    );
}

/// Twice as long along z as it is told: the largest difference is that in plain space.
#[test]
fn the_largest_difference_is_that_of_the_plain_radius() {
    struct Stretched(Known<Radius>);
    impl Target for Stretched {
        fn radii(&self, directions: &[Vector3<f64>]) -> Vec<f64> {
            self.0.radii(directions)
        }
        fn weight(&self, _: &Vector3<f64>) -> f64 {
            1.0
        }
        fn length(&self, _: &Vector3<f64>) -> f64 {
            2.0
        }
    }
    let settings = Settings::within(1e-3);
    let plain = found(&texture(5), &settings);
    let stretched = found(&Stretched(texture(5)), &settings);
    assert_eq!(stretched.max, 2.0 * plain.max);
    let target = texture(5);
    let anywhere = anywhere();
    let exact = target.radii(&anywhere).into_iter();
    let found = plain.surface.radii_and_gradients(&anywhere).into_iter();
    let largest = exact
        .zip(found)
        .map(|(exact, (radius, _))| (radius - exact).abs());
    let largest = largest.fold(0.0, f64::max);
    assert!(largest < 1.02 * plain.max, "{largest} {}", plain.max);
}
