use super::*;
use rand_distr::{Distribution, StandardNormal, Uniform};

/// Points of a table of this width and depth, with noise of this much.
fn table(sides: [f64; 2], count: usize, noise: f64) -> Vec<Point3<f64>> {
    let mut generator = ChaCha8Rng::seed_from_u64(1);
    let [across, along] = sides.map(|side| Uniform::new(0.0, side).unwrap());
    let points = (0..count).map(|_| {
        let [x, y] = [&across, &along].map(|range| range.sample(&mut generator));
        let off: f64 = StandardNormal.sample(&mut generator);
        Point3::new(x, y, noise * off)
    });
    points.collect()
}

/// Points of an ellipsoid that stands on the table here.
fn grain(semi_axes: Vector3<f64>, x: f64, y: f64, count: usize) -> Vec<Point3<f64>> {
    let directions = crate::shapes::Sampling::Fibonacci.directions(count, 0);
    let middle = Point3::new(x, y, semi_axes.z);
    let points = directions.unwrap().into_iter();
    points
        .map(|n| middle + n.component_mul(&semi_axes))
        .collect()
}

#[test]
fn a_table_is_found_whatever_its_points_were_rounded_to() {
    let step = 0.01;
    for noise in [0.0, 0.2, 0.3, 0.5, 0.7, 1.0, 1.5, 3.0] {
        let mut points = table([40.0, 30.0], 10_000, noise * step);
        let on_table = points.len();
        points.extend(grain(Vector3::new(6.0, 3.0, 2.5), 20.0, 15.0, 3000));
        for coordinate in points.iter_mut().flat_map(|point| point.coords.iter_mut()) {
            *coordinate = (*coordinate / step).round() * step;
        }
        let plane = Plane::carrying(&points).unwrap();
        assert!(plane.normal.z > 1.0 - 1e-6);
        let on = points[..on_table]
            .iter()
            .filter(|point| plane.carries(point));
        let above = points[on_table..]
            .iter()
            .filter(|point| plane.carries(point));
        let (on, above) = (on.count(), above.count());
        assert!(
            on * 100 > 98 * on_table && above < 100,
            "{noise}: {on}, {above}"
        );
    }
}

/// Most points are of grains, which hide much of the table, and lie within a few thousandths of the width of the tray.
#[test]
fn a_sparse_table_is_found_between_many_low_grains() {
    let mut points = table([160.0, 70.0], 22_000, 0.01);
    let semi_axes = Vector3::new(3.4, 1.05, 0.9);
    for at in 0..300 {
        let [x, y] = [at % 20, at / 20].map(f64::from);
        points.extend(grain(semi_axes, 4.0 + 8.0 * x, 4.0 + 4.4 * y, 300));
    }
    let plane = Plane::carrying(&points).unwrap();
    assert!(
        plane.normal.z > 1.0 - 1e-6 && plane.reach < 0.1,
        "{plane:?}"
    );
}

/// Grains without a table, and a ball among them that is much higher.
#[test]
fn low_grains_beside_a_high_one_are_no_table() {
    for (thickness, radius) in [(1.2, 5.0), (1.0, 3.0), (1.2, 9.0)] {
        let mut points = grain(Vector3::repeat(radius), 20.0, 20.0, 6000);
        for at in 0..30 {
            let [x, y] = [at % 6, at / 6].map(|i| 8.0 * f64::from(i) + 0.3 * f64::from(at % 4));
            let semi_axes = Vector3::new(3.4, 2.9, thickness);
            points.extend(grain(semi_axes, x, y + 60.0, 1200));
        }
        assert_eq!(Plane::carrying(&points), None, "{thickness} {radius}");
    }
}

#[test]
fn the_least_step_between_coordinates_tells_what_they_were_rounded_to() {
    let points = [[0.5, 1.0, 0.0], [2.0, 1.0, 0.25], [1.0, 1.0, 1.0]].map(Point3::from);
    assert_eq!(rounding(&points), Vector3::new(0.5, 0.0, 0.25));
}

/// Nothing covers the sides of a grain of which the lower half was not seen.
#[test]
fn the_side_of_half_a_grain_is_no_table() {
    for seed in 0..12 {
        let mut generator = ChaCha8Rng::seed_from_u64(seed);
        let mut half = grain(Vector3::new(8.0, 3.5, 3.0), 0.0, 0.0, 4000);
        half.retain(|point| point.z > 3.0);
        for point in &mut half {
            let off: f64 = StandardNormal.sample(&mut generator);
            *point += (point.coords - Vector3::new(0.0, 0.0, 3.0)).normalize() * (0.02 * off);
        }
        assert_eq!(Plane::carrying(&half), None, "{seed}");
    }
}

/// Points at random over what is seen of a grain from above: few lie under its steep rim.
#[test]
fn half_a_grain_seen_from_above_has_no_table() {
    let mut generator = ChaCha8Rng::seed_from_u64(7);
    for case in 0..24 {
        let semi_axes = [
            Vector3::new(17.2, 11.8, 1.8),
            Vector3::new(18.3, 12.9, 5.4),
            Vector3::new(1.0, 0.54, 0.42),
            Vector3::new(3.9, 2.4, 0.42),
        ][case % 4];
        let mut place = || {
            let ray = Vector3::from_fn(|_, _| StandardNormal.sample(&mut generator));
            Point3::from(Vector3::normalize(&ray).component_mul(&semi_axes))
        };
        let seen = Vector3::new(0.2, 0.1, 1.0);
        let is_seen = |place: &Point3<f64>| {
            let normal = place
                .coords
                .component_div(&semi_axes)
                .component_div(&semi_axes);
            normal.dot(&seen) > 0.0
        };
        let points: Vec<_> = (0..2000).map(|_| place()).filter(is_seen).collect();
        assert_eq!(Plane::carrying(&points), None, "{case}");
    }
}
