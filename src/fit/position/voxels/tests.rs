use super::*;
use crate::sphere::coefficient_count;
use approx::assert_relative_eq;
use nalgebra::Vector2;

/// A position of degree 1: the ellipsoid of such semi-axes.
fn ellipsoid(axes: [f64; 3]) -> (Functions, Position) {
    let functions = Functions::whole(1);
    let mut coefficients = vec![0.0; 3 * coefficient_count(1)];
    let of_one = (4.0 * PI / 3.0).sqrt();
    // x, y and z are the harmonics 3, 1 and 2.
    for (axis, harmonic) in [3, 1, 2].into_iter().enumerate() {
        coefficients[3 * harmonic + axis] = of_one * axes[axis];
    }
    (functions, Position::whole(coefficients).unwrap())
}

/// The standard deviations of the volume of a body's voxels and of their moment along x, and the share of the square of the first
/// that is of flat sides.
fn hidden_volume(spacing: &Vector3<f64>, axes: [f64; 3]) -> ([f64; 2], f64) {
    let voxels = Voxels::new(&Matrix3::from_diagonal(spacing)).unwrap();
    let (functions, surface) = ellipsoid(axes);
    let hidden = voxels.hidden(&functions, &surface, 4.0, &Mesh::default());
    let all = hidden.covariance();
    let flat = all - hidden.scatter;
    let told = [1, 2].map(|at| all[(at, at)].sqrt());
    (told, flat[(1, 1)] / all[(1, 1)])
}

/// Roots of the mean square differences of the volume of a body from that of its voxels, and of the moment along x, in many places
/// and of sizes that differ by a tenth: what both ends of a body do adds up or cancels by its length.
fn miscounted(spacing: &Vector3<f64>, mean_axes: &Vector3<f64>) -> [f64; 2] {
    let voxels = |middle: Vector3<f64>, axes: Vector3<f64>| {
        let at = |i: i32, axis: usize| (f64::from(i) * spacing[axis] - middle[axis]) / axes[axis];
        let reach = |axis: usize| {
            let most = (axes[axis] / spacing[axis]) as i32 + 2;
            -most..=most
        };
        let (mut count, mut moment) = (0, 0.0);
        for i in reach(0) {
            for j in reach(1) {
                let across = at(i, 0).powi(2) + at(j, 1).powi(2);
                let inside = reach(2)
                    .filter(|k| across + at(*k, 2).powi(2) < 1.0)
                    .count();
                count += inside;
                moment += inside as f64 * at(i, 0) * axes.x;
            }
        }
        [count as f64, moment].map(|sum| sum * spacing.product())
    };
    let rounds = 400;
    let share = |round: i32, step: f64| (f64::from(round) * step).fract();
    let squares = (0..rounds).map(|round| {
        let place = Vector3::new(
            share(round, 0.754_877_666),
            share(round, 0.569_840_291),
            share(round, 0.245_122_334),
        );
        let axes = mean_axes * (0.95 + 0.1 * share(round, 0.381_966_011));
        let volume = 4.0 / 3.0 * PI * axes.product();
        let [found, moment] = voxels(place.component_mul(spacing), axes);
        Vector2::new(found - volume, moment).map(|off| off * off)
    });
    let mean = squares.sum::<Vector2<f64>>() / f64::from(rounds);
    mean.map(f64::sqrt).into()
}

#[test]
fn the_voxels_of_smooth_bodies_scatter_as_told() {
    let spacing = Vector3::new(1.0, 0.8, 0.5);
    for axes in [[7.3, 7.3, 7.3], [9.0, 7.0, 5.0]] {
        let (told, flat) = hidden_volume(&spacing, axes);
        let found = miscounted(&spacing, &axes.into());
        for (told, found) in told.into_iter().zip(found) {
            assert_relative_eq!(told, found, max_relative = 0.3);
        }
        assert!(flat < 0.4, "{flat}");
    }
}

/// A lens lies in the layers, with flat sides of half its area, and a needle along them.
#[test]
fn the_voxels_of_flat_bodies_scatter_at_most_as_told() {
    let spacing = Vector3::new(1.0, 1.0, 1.0);
    for axes in [[60.0, 60.0, 2.1], [60.0, 2.3, 2.3]] {
        let (told, flat) = hidden_volume(&spacing, axes);
        let found = miscounted(&spacing, &axes.into());
        assert!(
            (0.8 * found[0]..3.0 * found[0]).contains(&told[0]) && told[1] > 0.8 * found[1],
            "{told:?} {found:?}"
        );
        assert!(flat > 0.3, "{flat}");
    }
}

/// A side that is flat moves by a twelfth of a layer's square, and the area with it by the outline of the side.
#[test]
fn a_flat_side_moves_as_a_whole() {
    let layer = Vector3::new(0.0, 0.0, 2.0);
    let place = |x: f64, z: f64, area: Vector3<f64>, bend: f64| Place {
        point: Vector3::new(x, 0.0, z),
        area,
        lacking: 0.0,
        changes: list_of(bend, x),
    };
    let mut places: Vec<Place> = (0..100)
        .map(|i| place(f64::from(i), 3.0 + 1e-3 * f64::from(i), Vector3::z(), 0.0))
        .collect();
    // Its edge, as a rounding of which 20 of area face upwards, and the side below.
    places.push(place(0.0, 2.0, Vector3::new(0.0, 0.0, 20.0), 2.0));
    places.push(place(0.0, -3.0, -Vector3::z() * 100.0, 0.0));
    let flat = Flat::of(&layer, None, &places).unwrap();
    assert_relative_eq!(flat.area, 100.0);
    assert_relative_eq!(flat.changes[1], 100.0 / 2.0, max_relative = 1e-12);
    assert_relative_eq!(
        flat.changes[0],
        2.0 * 20.0 * (100.0 / 120.0) / 2.0,
        max_relative = 1e-12
    );
    // It may lean: the moment along x tells, and the volume does not.
    let mean = 4950.0 / 120.0;
    let deviation = f64::sqrt(328_350.0 / 120.0 - mean * mean);
    let leaning = flat.leaning[0];
    assert_relative_eq!(
        leaning[2].abs(),
        50.0 * deviation / f64::sqrt(3.0),
        max_relative = 1e-12
    );
    assert!(leaning[1].abs() < 1e-10);
    let variance = flat.covariance()[(2, 2)];
    let moved = flat.changes[2].powi(2) / 12.0;
    assert_relative_eq!(
        variance - moved,
        leaning[2].powi(2) / 40.0,
        max_relative = 1e-10
    );
    let outline = flat.changes[0];
    let hidden = Hidden {
        flats: vec![flat],
        scatter: SMatrix::zeros(),
        miscount: 0.0,
        area: 1000.0,
        told: 10.0,
        steps: Matrix3::zeros(),
        rounded: 0.0,
        width: 1.0,
    };
    assert_relative_eq!(
        hidden.covariance()[(1, 1)],
        50.0 * 50.0 / 12.0,
        max_relative = 1e-12
    );
    assert_relative_eq!(hidden.edges(), 0.5 * ROUNDED * outline);
    // Half a unit from layer to layer, and a function has the flat's area.
    let square = |height: f64, normal| hidden.square(&Vector3::new(0.0, 0.0, height), &normal);
    assert_relative_eq!(square(3.1, Vector3::z()), 0.25 / 12.0);
    assert_eq!(square(4.1, Vector3::z()), 0.0);
    assert_eq!(square(3.1, Vector3::x()), 0.0);
}

/// A place moves by up to half a step along its normal where functions reach no farther than terraces, and by a share where they even
/// many of them out.
#[test]
fn a_place_is_somewhere_on_its_terrace() {
    let steps = Matrix3::from_diagonal(&Vector3::new(1.0, 1.0, 3.0));
    let hidden = |told: f64| Hidden {
        flats: Vec::new(),
        scatter: SMatrix::zeros(),
        miscount: 0.0,
        area: 400.0 * PI,
        told,
        steps,
        rounded: 0.0,
        width: 1.0,
    };
    let square = |told: f64, normal| hidden(told).square(&Vector3::zeros(), &normal);
    assert_relative_eq!(square(200.0, Vector3::z()), 9.0 / 12.0);
    assert_relative_eq!(square(200.0, Vector3::x()), 1.0 / 12.0);
    // A terrace of 20 pi, and functions that reach ten times as far.
    assert_relative_eq!(square(2.0, Vector3::x()), 0.01 / 12.0, max_relative = 1e-12);
}

/// A terrace of the voxels themselves counts where the surface laid through them is not flat, and is no larger than the side.
#[test]
fn the_terrace_of_voxels_is_flat_where_their_surface_bends() {
    let layer = Vector3::z();
    let place = |i: i32| Place {
        point: Vector3::new(f64::from(i), 0.0, -0.01 * f64::from(i * i)),
        area: Vector3::z(),
        lacking: 0.0,
        changes: list_of(0.0, f64::from(i)),
    };
    let places: Vec<Place> = (-50..=50).map(place).collect();
    let terrace = |area: f64| Terrace { area, height: 0.2 };
    let moved = |terrace: Option<&Terrace>| Flat::of(&layer, terrace, &places).unwrap().changes[1];
    assert!(moved(None) < 15.0);
    assert_relative_eq!(moved(Some(&terrace(80.0))), 80.0, max_relative = 1e-12);
    assert_relative_eq!(moved(Some(&terrace(180.0))), 101.0, max_relative = 1e-12);
}

fn list_of(bend: f64, moment: f64) -> SVector<f64, INTEGRALS> {
    let mut changes = SVector::zeros();
    changes[0] = bend;
    changes[1] = 1.0;
    changes[2] = moment;
    changes
}
