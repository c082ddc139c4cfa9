//! Surfaces whose points are given over the sphere: an ellipsoid, whose figures are closed, and a banana, which is
//! seen whole from nowhere.

use super::grains::{plain, turned};
use gauss_quad::GaussLegendre;
use grainform::contact::{TouchError, touch};
use grainform::measure::{
    Curvature, Deviation, Scheme, Survey, crossings, feet, grain_properties, mesh_properties,
};
use grainform::model::{
    Frame, InvalidGrain, LocalError, LocalErrors, ModelError, Position, PositionGrain, Radial,
    SurfaceJet, grain_from_json, grain_to_json,
};
use grainform::shapes::{Ellipsoid, Solid};
use grainform::sphere::{Cover, CubeCell, HarmonicBasis, coefficient_count, cube_grid};
use grainform::{Grain, Surface};
use nalgebra::{Matrix3, Matrix4, Point3, Vector3, Vector4};
use serde_json::{Value, json};
use std::f64::consts::{PI, TAU};

const SEMI_AXES: Vector3<f64> = Vector3::new(3.0, 2.0, 1.0);

/// Where the ellipsoid lies in its own frame.
const OFFSET: Vector3<f64> = Vector3::new(4.0, -2.0, 7.0);

/// X(n) = A n + b on the whole sphere, and on cells of three sizes.
fn ellipsoids(frame: Frame) -> [Grain; 2] {
    let at = |n: &Vector3<f64>| SEMI_AXES.component_mul(n) + OFFSET;
    let mut cells = CubeCell::uniform(2);
    let quarters = cells.swap_remove(5).quarters();
    cells.extend(quarters);
    let cover = Cover::with_margin(cells, 0.2).expect("a cover");
    // Of each function its values are those of a position that has it as x in every cell.
    let functions = [0, 1, 2, 3].map(|j| {
        let mut unit = vec![0.0; 12];
        unit[3 * j] = 1.0;
        let all = vec![unit; cover.cells().len()];
        Position::blended(cover.clone(), all).expect("finite coefficients")
    });
    let of_cell = |cell: &CubeCell| -> Vec<f64> {
        // So near the middle no other cell has a weight.
        let places =
            [[0.5, 0.5], [0.55, 0.5], [0.5, 0.56], [0.46, 0.48]].map(|[s, t]| cell.at(s, t));
        let design = Matrix4::from_fn(|i, j| functions[j].point(&places[i]).x);
        let design = design.lu();
        let axes = [0, 1, 2].map(|axis| {
            let values = Vector4::from_fn(|i, _| at(&places[i])[axis]);
            design.solve(&values).expect("independent functions")
        });
        (0..4).flat_map(|j| axes.map(|own| own[j])).collect()
    };
    let coefficients = cover.cells().iter().map(of_cell).collect();
    let blended = Position::blended(cover.clone(), coefficients).expect("a position");
    [harmonics(1, at), blended].map(|position| {
        let grain = PositionGrain::new(frame, position).expect("a frame");
        grain.check().expect("no folds");
        grain.into()
    })
}

/// The expansion of places over the whole sphere.
fn harmonics(degree: usize, at: impl Fn(&Vector3<f64>) -> Vector3<f64>) -> Position {
    let basis = HarmonicBasis::new(degree);
    let mut values = vec![0.0; coefficient_count(degree)];
    let mut coefficients = vec![0.0; 3 * values.len()];
    let turns = 4 * degree + 8;
    for &(z, weight) in GaussLegendre::new((turns / 2).try_into().expect("a count")).iter() {
        for turn in 0..turns {
            let (sin, cos) = (TAU * turn as f64 / turns as f64).sin_cos();
            let s = (1.0 - z * z).sqrt();
            let n = Vector3::new(s * cos, s * sin, z);
            basis.evaluate(&n, &mut values);
            let place = at(&n) * (weight * TAU / turns as f64);
            for (own, value) in coefficients.chunks_mut(3).zip(&values) {
                for axis in 0..3 {
                    own[axis] += place[axis] * value;
                }
            }
        }
    }
    Position::whole(coefficients).expect("a position")
}

/// An ellipsoid of semi-axes 3, .5, .4 bent round the z axis at a distance of R from it: its volume is kept, for
/// the length of its fibres grows as R + y, and y is 0 as a mean.
struct Banana {
    radius: f64,
}

const STRAIGHT: Vector3<f64> = Vector3::new(3.0, 0.5, 0.4);

impl Surface for Banana {
    fn place_and_slopes(&self, n: &Vector3<f64>) -> (Vector3<f64>, Matrix3<f64>) {
        let jet = self.jet(n);
        (jet.place, jet.slopes)
    }

    fn jet(&self, n: &Vector3<f64>) -> SurfaceJet {
        let [x, y, z]: [f64; 3] = STRAIGHT.component_mul(n).into();
        let out = self.radius + y;
        let (sin, cos) = (x / self.radius).sin_cos();
        let (da, db) = (STRAIGHT.x / self.radius, STRAIGHT.y);
        // By the components of n: the angle x / R, and the distance R + y.
        let first = Matrix3::new(
            out * cos * da,
            sin * db,
            0.0,
            -out * sin * da,
            cos * db,
            0.0,
            0.0,
            0.0,
            STRAIGHT.z,
        );
        let second = |along: f64, mixed: f64| {
            let mut bend = Matrix3::zeros();
            (bend[(0, 0)], bend[(0, 1)], bend[(1, 0)]) = (along, mixed, mixed);
            bend
        };
        let bends = [
            second(-out * sin * da * da, cos * da * db),
            second(-out * cos * da * da, -sin * da * db),
            Matrix3::zeros(),
        ];
        let across = Matrix3::identity() - n * n.transpose();
        let on_sphere = |i: usize| {
            let slope: f64 = first.row(i).transpose().dot(n);
            across * bends[i] * across - across * slope
        };
        SurfaceJet {
            place: Vector3::new(out * sin, out * cos, z),
            slopes: first * across,
            bends: [0, 1, 2].map(on_sphere),
        }
    }
}

#[test]
fn the_ellipsoid_has_its_closed_forms_wherever_it_lies() {
    let solid = Ellipsoid {
        semi_axes: SEMI_AXES,
    };
    let exact = solid.integrals().properties;
    for frame in [plain(), turned()] {
        for grain in ellipsoids(frame) {
            let found = grain_properties(&grain).properties;
            assert!((found.area / exact.area - 1.0).abs() < 1e-7);
            assert!((found.volume / exact.volume - 1.0).abs() < 1e-9);
            assert!((found.centroid - frame.to_scan(&OFFSET)).norm() < 1e-8);
            let inertia = frame.axes * exact.inertia * frame.axes.transpose();
            assert!((found.inertia - inertia).norm() < 1e-7 * inertia.norm());
            for n in cube_grid(5).0 {
                // The place over n is where the normal is that of A^-1 n: along its own radius.
                let seen = SEMI_AXES.component_mul(&n).normalize();
                let want = Curvature::new(&seen, &Radial(&solid).jet(&seen));
                let towards = frame.axes * n;
                let have = Curvature::new(&towards, &grain.jet(&towards));
                assert!((have.normal - frame.axes * want.normal).norm() < 1e-12);
                for (have, want) in have.principal.into_iter().zip(want.principal) {
                    assert!((have - want).abs() < 1e-10 * want, "{have} for {want}");
                }
            }
        }
    }
}

#[test]
fn every_measure_of_the_ellipsoid_is_that_of_its_radius() {
    let solid = Ellipsoid {
        semi_axes: SEMI_AXES,
    };
    let want = Survey::of_surface(&solid, solid.integrals().properties);
    for grain in ellipsoids(turned()) {
        let have = Survey::of_grain(&grain, Scheme::Exact);
        let near = |have: f64, want: f64, share: f64| {
            assert!((have / want - 1.0).abs() < share, "{have} for {want}");
        };
        let dimensions = have.dimensions().unwrap();
        assert!((dimensions - SEMI_AXES * 2.0).norm() < 1e-9);
        let [one, other] = [&have, &want].map(|survey| survey.minimum_box().unwrap().volume());
        near(one, other, 1e-3);
        near(have.inscribed().unwrap().radius, 1.0, 1e-3);
        near(have.enclosing().unwrap().radius, 3.0, 1e-4);
        let [one, other] = [&have, &want].map(|survey| survey.sphericity().unwrap().wadell);
        near(one, other, 1e-7);
        near(have.convexity().unwrap().volume, 1.0, 1e-3);
        assert!(have.angularity().unwrap() < 1e-6);
        let [one, other] = [&have, &want].map(|survey| survey.curvature().unwrap());
        assert!(one.gauss_bonnet_error().abs() < 1e-4);
        near(one.mean().mean, other.mean().mean, 1e-4);
        near(have.roundness().unwrap(), want.roundness().unwrap(), 3e-2);
        let [one, other] = [&have, &want].map(|survey| survey.spectrum().unwrap());
        near(one.power[2], other.power[2], 1e-6);
        let [one, other] = [&have, &want].map(|survey| survey.projections().unwrap());
        near(one[2].area, other[2].area, 1e-3);
        // Its figures by the source's own scheme are made from radii.
        let source = Survey::of_grain(&grain, Scheme::FourTriangles);
        assert!(source.volume().is_err());
    }
}

#[test]
fn a_banana_has_its_volume_and_that_of_its_mesh_and_of_its_expansion() {
    let banana = Banana { radius: 1.5 };
    let exact = 4.0 / 3.0 * PI * STRAIGHT.product();
    let found = grain_properties(&banana);
    assert!((found.properties.volume / exact - 1.0).abs() < 1e-9);
    // 230 degrees round: its centroid is outside of it.
    assert!(found.relative_error < 1e-8);
    let meshed = |n: usize| mesh_properties(&banana.mesh(n)).expect("closed");
    let (coarse, fine) = (meshed(64), meshed(128));
    // Errors of second order, taken away.
    let area = fine.area + (fine.area - coarse.area) / 3.0;
    assert!((area / found.properties.area - 1.0).abs() < 1e-6);
    let centroid = fine.centroid + (fine.centroid - coarse.centroid) / 3.0;
    assert!((centroid - found.properties.centroid).norm() < 1e-5);
    let inertia = fine.inertia + (fine.inertia - coarse.inertia) / 3.0;
    assert!((inertia - found.properties.inertia).norm() < 1e-5 * inertia.norm());

    let expansion = harmonics(20, |n| banana.place(n));
    let grain = PositionGrain::new(plain(), expansion).expect("a frame");
    grain.check().expect("no folds");
    let expanded = grain_properties(&grain).properties;
    assert!((expanded.volume / exact - 1.0).abs() < 1e-9);
    assert!((expanded.area / found.properties.area - 1.0).abs() < 1e-8);
    let grain = Grain::from(grain);
    let survey = Survey::of_grain(&grain, Scheme::Exact);
    assert!(survey.curvature().unwrap().gauss_bonnet_error().abs() < 1e-6);
    assert!(survey.angularity().is_err() && survey.spectrum().is_err());
    assert!(survey.convexity().unwrap().volume < 0.6);
}

#[test]
fn a_banana_is_touched_where_it_reaches_farthest() {
    let banana = Banana { radius: 1.5 };
    let vertices = banana.mesh(128).vertices;
    for towards in [
        Vector3::y(),
        Vector3::new(1.0, -0.2, 0.1),
        Vector3::new(-0.3, -1.0, 0.4),
    ] {
        let towards = towards.normalize();
        let found = touch(&banana, &towards, None).expect("a smooth place");
        let height = |place: &Vector3<f64>| place.dot(&towards);
        let highest = vertices.iter().map(|vertex| height(&vertex.coords));
        let highest = highest.fold(f64::NEG_INFINITY, f64::max);
        let over = height(&found.point) - highest;
        assert!((0.0..1e-3).contains(&over), "{over}");
    }
    // On its back: its own curvature along, 1 / (R + .5) less what its slimming adds, and that across.
    let back = touch(&banana, &Vector3::y(), None).expect("a smooth place");
    let (along, across) = (
        STRAIGHT.y / STRAIGHT.x.powi(2),
        STRAIGHT.y / STRAIGHT.z.powi(2),
    );
    let growth: f64 = 2.0 / 1.5;
    assert!((back.principal[0] - across).abs() < 1e-12);
    assert!((back.principal[1] - (0.5 + along / growth.powi(2))).abs() < 1e-12);

    let closed = Banana { radius: 0.8 };
    let refused = touch(&closed, &Vector3::y(), None);
    assert!(
        matches!(refused, Err(TouchError::Crossing { at }) if at[1] < 0.0),
        "{refused:?}"
    );
    assert_eq!(crossings(&banana.mesh(64)), Ok(vec![]));
}

#[test]
fn distances_from_a_banana_are_along_its_normals() {
    let banana = Banana { radius: 1.5 };
    let (directions, _) = cube_grid(6);
    // Within the least radius of curvature, c² / a.
    for off in [-0.04, 0.2] {
        let points = directions.iter().map(|n| {
            let normal = Curvature::new(n, &banana.jet(n)).normal;
            banana.point(n) + normal * off
        });
        let points: Vec<Point3<f64>> = points.collect();
        for foot in feet(&banana, &points) {
            assert!((foot.distance - off).abs() < 1e-9, "{}", foot.distance);
        }
        let grain = PositionGrain::new(plain(), harmonics(20, |n| banana.place(n)));
        let deviation = Deviation::from_places(&grain.expect("a frame").into(), &points);
        assert!((deviation.rms() - off.abs()).abs() < 1e-6);
        assert!((deviation.largest + off).abs() < 1e-6);
    }
}

#[test]
fn a_saved_position_is_the_same_to_the_last_bit_and_a_broken_one_is_refused() {
    let n = Vector3::new(0.6, -0.64, 0.48);
    let error = |cell: u32| LocalError {
        place: f64::from(cell) * 1e-3,
        curvature: 2.0 - f64::from(cell) * 1e-3,
    };
    let errors: Vec<LocalError> = (0..864).map(error).collect();
    for grain in ellipsoids(turned()) {
        let grain = grain.with_local_errors(LocalErrors::new(errors.clone()));
        let text = grain_to_json(&grain);
        let loaded = grain_from_json(&text).expect("a model");
        assert_eq!(grain_to_json(&loaded), text);
        assert_eq!(loaded.local_error(&n), grain.local_error(&n));
        assert!(loaded.local_error(&n).is_some());
        assert_eq!(loaded.place(&n), grain.place(&n));
        assert!(loaded.star().is_none() && loaded.position().is_some());
    }
    let text = grain_to_json(&ellipsoids(turned())[0]);
    let spoilt = |spoil: &dyn Fn(&mut Value)| {
        let mut value: Value = serde_json::from_str(&text).expect("JSON");
        spoil(&mut value);
        grain_from_json(&value.to_string()).expect_err("refused")
    };
    for (name, value) in [
        ("stretch", json!([2.0, 1.0, 1.0])),
        ("harmonics", json!([1.0])),
    ] {
        let error = spoilt(&|file| file[name] = value.clone());
        assert!(matches!(error, ModelError::Surface), "{name}: {error}");
    }
    for (places, curvatures) in [(1, 1), (863, 864), (864, 865)] {
        let errors = json!({"place": vec![1.0; places], "curvature": vec![1.0; curvatures]});
        let error = spoilt(&|file| file["local_errors"] = errors.clone());
        assert!(matches!(error, ModelError::LocalErrors), "{error}");
    }
    let error = spoilt(&|file| file["position"]["cells"] = json!([]));
    assert!(matches!(error, ModelError::Surface), "{error}");
    let error = spoilt(&|file| file["position"]["harmonics"] = json!([1.0, 2.0, 3.0, 4.0]));
    assert!(matches!(
        error,
        ModelError::Invalid(InvalidGrain::CoefficientCount { .. })
    ));
    // Mirrored, and flattened to a disc.
    let x_of_x = 3 * 3;
    let turn = |factor: f64| {
        spoilt(&|file| {
            let own = &mut file["position"]["harmonics"][x_of_x];
            *own = json!(own.as_f64().unwrap() * factor);
        })
    };
    assert!(matches!(
        turn(-1.0),
        ModelError::Invalid(InvalidGrain::InsideOut)
    ));
    assert!(matches!(
        turn(0.0),
        ModelError::Invalid(InvalidGrain::Folded { .. })
    ));
    assert!(matches!(
        turn(1e200),
        ModelError::Invalid(InvalidGrain::OutOfRange)
    ));
}
