use super::*;
use crate::measure::mesh_properties;
use crate::shapes::{Curled, CurledOptions, synthesize_curled};
use crate::spread::upper_median;
use approx::assert_relative_eq;

fn points(body: Curled, count: usize, noise: f64) -> (Vec<Point3<f64>>, f64) {
    let options = CurledOptions::clean(body)
        .with_points(count)
        .with_noise(noise);
    let scan = synthesize_curled(&options).unwrap();
    (scan.mesh.vertices, scan.truth.properties.volume)
}

#[test]
fn points_of_bodies_that_no_centre_sees_have_a_surface_of_nearly_their_volume() {
    for (body, count, noise) in [
        (Curled::Banana, 3000, 0.0),
        (Curled::Hook, 4000, 0.01),
        (Curled::Mushroom, 6000, 0.0),
        // Walls of two and a half spacings.
        (Curled::Cup, 3000, 0.005),
    ] {
        let (points, volume) = points(body, count, noise);
        let mesh = surface_of_points(&points).unwrap();
        mesh.check_closed().unwrap();
        let found = mesh_properties(&mesh).unwrap().volume;
        assert_relative_eq!(found, volume, max_relative = 0.1);
    }
}

#[test]
fn rings_and_open_bowls_are_refused() {
    let turn = |i: usize, step: f64| (i as f64 * step).sin_cos();
    let ring = (0..6000).map(|i| {
        let ([a, b], [c, d]) = (turn(i, 2.399_963).into(), turn(i, 0.017).into());
        let radius = 2.0 + 0.6 * a;
        Point3::new(radius * c, radius * d, 0.6 * b)
    });
    let found = surface_of_points(&ring.collect::<Vec<_>>());
    assert!(matches!(
        found,
        Err(FitError::Ring { handles: 1 } | FitError::OffCrust { .. })
    ));
    let (ball, _) = points(Curled::Random, 4000, 0.0);
    let bowl: Vec<_> = ball.into_iter().filter(|p| p.z < 0.3).collect();
    assert!(surface_of_points(&bowl).is_err());
}

/// One half has eight times the points of the other: a crust of even width leaks.
#[test]
fn points_that_are_much_sparser_in_one_half_have_a_surface_of_nearly_their_volume() {
    for body in [Curled::Banana, Curled::Mushroom] {
        let (all, volume) = points(body, 12_000, 0.002);
        let mut along: Vec<f64> = all.iter().map(|point| point.x).collect();
        let middle = upper_median(&mut along).unwrap();
        let is_kept = |at: usize, point: &Point3<f64>| point.x < middle || at.is_multiple_of(8);
        let kept = all.into_iter().enumerate();
        let kept: Vec<Point3<f64>> = kept
            .filter(|(at, point)| is_kept(*at, point))
            .map(|(_, point)| point)
            .collect();
        let even = Cloud::new(drawn(&kept, MOST_POINTS));
        assert!(surface_of(&even).is_err());
        let found = mesh_properties(&surface_of_points(&kept).unwrap())
            .unwrap()
            .volume;
        assert_relative_eq!(found, volume, max_relative = 0.1);
    }
}
