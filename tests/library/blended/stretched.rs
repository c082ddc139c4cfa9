//! Grains stretched along their axes, against closed forms and differences of the radius.

use super::derivatives::check;
use super::grains::{
    RADIUS, all, anywhere, blended, critical, plain, ragged, segmented, turned, whole,
};
use super::integrals;
use grainform::measure::{Curvature, MassProperties, grain_properties, integrate};
use grainform::model::{Family, Frame, InvalidGrain, Mirrored, Radial, Stretch, Whole};
use grainform::shapes::{Ellipsoid, Solid};
use grainform::sphere::{CubeCell, Symmetry};
use grainform::{StarGrain, StarSurface, Surface};
use nalgebra::{Matrix3, Vector3};
use std::f64::consts::PI;

const SEMI_AXES: [f64; 3] = [3.0, 2.0, 1.0];

/// A stretch that is none of an axis's, with a determinant other than one.
fn stretch() -> Stretch {
    Stretch::new(Vector3::new(0.6, 1.1, 1.7)).expect("factors")
}

/// The same surface, of the grain stretched.
fn stretched(grain: &StarGrain, stretch: Stretch) -> StarGrain {
    StarGrain::stretched(grain.frame(), stretch, grain.family().clone()).expect("a frame")
}

/// An ellipsoid: a sphere of radius one, once stretched.
fn ellipsoid(frame: Frame) -> StarGrain {
    let sphere = Whole::new(vec![(4.0 * PI).sqrt()]).expect("a coefficient");
    let stretch = Stretch::new(Vector3::from(SEMI_AXES).map(|axis| 1.0 / axis)).expect("factors");
    StarGrain::stretched(frame, stretch, Family::Whole(sphere)).expect("a frame")
}

fn places() -> Vec<Vector3<f64>> {
    let mut places = critical(&ellipsoid(plain()));
    places.extend(anywhere(500));
    // Close to a pole.
    places.push(Vector3::new(1e-9, -2e-9, 1.0).normalize());
    places
}

#[test]
fn a_stretched_sphere_is_an_ellipsoid() {
    let exact = Ellipsoid {
        semi_axes: SEMI_AXES.into(),
    };
    for frame in [plain(), turned()] {
        let grain = ellipsoid(frame);
        let axes = frame.axes;
        let directions: Vec<_> = places().iter().map(|n| axes * n).collect();
        let radii = grain.radii(&directions);
        for (n, radius) in directions.iter().zip(radii) {
            let want = exact.derivatives(&axes.tr_mul(n));
            let found = grain.derivatives(n);
            let (once, gradient) = grain.radius_and_gradient(n);
            for r in [found.radius, once, radius, grain.radius(n)] {
                assert!((r - want.radius).abs() < 1e-14 * want.radius, "{n}: {r}");
            }
            for g in [found.gradient, gradient] {
                assert!((g - axes * want.gradient).norm() < 1e-13, "{n}: {g}");
            }
            let hessian = axes * want.hessian * axes.transpose();
            assert!((found.hessian - hessian).norm() < 1e-12, "{n}");
            let (found, want) = (
                Curvature::new(n, &grain.jet(n)),
                exact_curvature(&exact, &axes, n),
            );
            for (found, want) in found.principal.into_iter().zip(want.principal) {
                assert!((found / want - 1.0).abs() < 1e-12, "{n}: {found} {want}");
            }
        }
    }
}

fn exact_curvature(exact: &Ellipsoid, axes: &Matrix3<f64>, n: &Vector3<f64>) -> Curvature {
    let local = axes.tr_mul(n);
    Curvature::new(&local, &Radial(exact).jet(&local))
}

#[test]
fn a_stretched_sphere_has_the_integrals_of_an_ellipsoid() {
    let exact = Ellipsoid {
        semi_axes: SEMI_AXES.into(),
    }
    .integrals();
    for frame in [plain(), turned()] {
        let found = grain_properties(&ellipsoid(frame));
        let (have, want) = (found.properties, exact.properties);
        assert!(found.relative_error < 1e-9);
        assert!((found.mean_radius / exact.mean_radius - 1.0).abs() < 1e-9);
        assert!((have.area / want.area - 1.0).abs() < 1e-9);
        assert!((have.volume / want.volume - 1.0).abs() < 1e-13);
        assert!((have.centroid - frame.centre).norm() < 1e-13);
        let inertia = frame.axes * want.inertia * frame.axes.transpose();
        assert!((have.inertia - inertia).norm() < 1e-13 * inertia.norm());
    }
}

#[test]
fn derivatives_of_stretched_grains_are_those_of_the_radius() {
    for frame in [plain(), turned()] {
        for grain in all(frame) {
            let grain = stretched(&grain, stretch());
            for n in anywhere(100) {
                check(&grain, &n, 1e-2);
            }
        }
        for (grain, bound) in [(segmented(1, frame), 1e-6), (whole(12, frame), 1e-6)] {
            let grain = stretched(&grain, stretch());
            for n in places() {
                check(&grain, &(frame.axes * n), bound);
            }
        }
    }
}

/// Whether two solids are alike.
fn compare(found: &MassProperties, other: &MassProperties, bound: f64) {
    assert!((found.area / other.area - 1.0).abs() < bound, "area");
    assert!((found.volume / other.volume - 1.0).abs() < bound, "volume");
    let size = other.volume.cbrt();
    let centroid = (found.centroid - other.centroid).norm();
    assert!(centroid < bound * size, "centroid {centroid}");
    let inertia = (found.inertia - other.inertia).norm();
    assert!(inertia < 2.0 * bound * other.inertia.norm(), "inertia");
}

#[test]
fn integrals_of_stretched_grains_are_those_of_rules_that_know_of_no_stretch() {
    for grain in [
        blended(CubeCell::uniform(2), turned()),
        blended(ragged(1, 9, 2), plain()),
    ] {
        integrals::check(&stretched(&grain, stretch()), 1e-6);
    }
    let mirrored = Mirrored::new(Symmetry::OCTANT, vec![RADIUS, 0.3, 0.2, 0.1]).expect("sound");
    for (grain, bound) in [
        (segmented(1, turned()), 1e-8),
        (whole(12, turned()), 1e-8),
        (
            StarGrain::new(plain(), Family::Mirrored(mirrored)).expect("a frame"),
            1e-8,
        ),
    ] {
        let grain = stretched(&grain, stretch());
        let found = grain_properties(&grain).properties;
        let mut other = integrate(&grain, 1e-9).properties;
        other.centroid += grain.frame().centre.coords;
        compare(&found, &other, bound);
    }
}

#[test]
fn a_seam_of_a_stretched_grain_jumps_as_the_radius_does() {
    let grain = segmented(2, plain());
    let double = Stretch::new(Vector3::repeat(2.0)).expect("factors");
    let found = stretched(&grain, double).seam_jump();
    assert!((found - 0.5 * grain.seam_jump()).abs() < 1e-14 * RADIUS);
}

#[test]
fn no_stretch_changes_no_bit() {
    for grain in [
        blended(CubeCell::uniform(2), turned()),
        segmented(3, turned()),
        whole(9, turned()),
    ] {
        let again = stretched(&grain, Stretch::new(Vector3::repeat(1.0)).expect("factors"));
        for n in anywhere(50) {
            assert_eq!(again.derivatives(&n), grain.derivatives(&n));
        }
        assert_eq!(grain_properties(&again), grain_properties(&grain));
    }
}

#[test]
fn a_stretch_turns_with_the_frame() {
    let grain = |frame: Frame| stretched(&whole(7, frame), stretch());
    let (still, moved) = (grain(plain()), grain(turned()));
    let axes = turned().axes;
    for n in anywhere(100) {
        let off = still.radius(&n) - moved.radius(&(axes * n));
        assert!(off.abs() < 1e-14 * RADIUS);
        let off = still.normal(&n) - axes.tr_mul(&moved.normal(&(axes * n)));
        assert!(off.norm() < 1e-13);
    }
    let [still, moved] = [&still, &moved].map(|grain| grain_properties(grain).properties);
    assert!((still.area / moved.area - 1.0).abs() < 1e-13);
    let inertia = axes * still.inertia * axes.transpose() - moved.inertia;
    assert!(inertia.norm() < 1e-12 * still.inertia.norm());
    let centroid = turned().centre + axes * still.centroid.coords;
    assert!((centroid - moved.centroid).norm() < 1e-12 * RADIUS);
}

#[test]
fn factors_that_are_no_stretch_are_refused() {
    let faulty = [
        [0.0, 1.0, 1.0],
        [1.0, -1.0, 1.0],
        [1.0, 1.0, f64::NAN],
        [f64::INFINITY; 3],
        [1.0, 1.1e6, 1.0],
    ];
    for factors in faulty {
        let found = Stretch::new(factors.into());
        assert!(matches!(found, Err(InvalidGrain::Stretch { .. })));
    }
    for factors in [[1.0, 1e6, 1.0], [1e-200, 1e-200, 3e-200]] {
        assert!(Stretch::new(factors.into()).is_ok());
    }
}
