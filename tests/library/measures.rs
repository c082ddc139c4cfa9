//! Measures of whole bodies: against closed forms, and as they must behave when a body is turned, moved
//! or scaled.

use approx::assert_relative_eq;
use grainform::measure::{EXPANSION_DEGREE, Scheme, Survey, SurveyError, convex_hull, extents};
use grainform::mesh::MeshDefect;
use grainform::scan::Scan;
use grainform::shapes::{Body, Ellipsoid, SynthOptions, synthesize};
use grainform::{FitOptions, Mesh, StarSurface, Tolerance, fit};
use nalgebra::{Matrix3, Point3, Rotation3, Vector3};
use proptest::prelude::*;

fn mesh(surface: &(impl StarSurface + ?Sized), resolution: usize) -> Mesh {
    Mesh::radial(resolution, |n| surface.radius(n))
}

fn moved(mesh: &Mesh, turn: &Rotation3<f64>, shift: &Vector3<f64>, size: f64) -> Mesh {
    Mesh {
        vertices: mesh
            .vertices
            .iter()
            .map(|p| turn * p * size + shift)
            .collect(),
        triangles: mesh.triangles.clone(),
    }
}

/// Everything that can be measured of a mesh, in powers of length: (power, value).
fn figures(mesh: &Mesh) -> Result<Vec<(i32, f64)>, SurveyError> {
    let survey = Survey::of_mesh(mesh)?;
    let properties = survey.properties()?;
    let mut all = vec![(2, properties.area), (3, properties.volume)];
    all.extend(survey.principal()?.moments.iter().map(|m| (5, *m)));
    all.extend(survey.dimensions()?.iter().map(|d| (1, *d)));
    all.extend(survey.minimum_box()?.extents.iter().map(|d| (1, *d)));
    let form = survey.form()?;
    all.extend([form.aspect_ratio, form.elongation, form.flatness].map(|x| (0, x)));
    let ratios = survey.side_ratios()?;
    all.extend([ratios.short_to_long, ratios.intermediate_to_long].map(|x| (0, x)));
    all.push((0, ratios.short_to_intermediate));
    all.push((1, survey.inscribed()?.radius));
    all.push((1, survey.enclosing()?.radius));
    let sphericity = survey.sphericity()?;
    all.extend([sphericity.wadell, sphericity.operational].map(|x| (0, x)));
    all.extend([sphericity.inscribed_enclosing, sphericity.krumbein].map(|x| (0, x)));
    all.push((0, sphericity.maximum_projection));
    let convexity = survey.convexity()?;
    all.extend([convexity.volume, convexity.area].map(|x| (0, x)));
    all.extend(survey.ellipsoid()?.semi_axes.iter().map(|d| (1, *d)));
    all.push((0, survey.angularity()?));
    let spectrum = survey.spectrum()?;
    all.extend(spectrum.relative_amplitude.iter().map(|x| (0, *x)));
    Ok(all)
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(12))]
    #[test]
    fn measures_do_not_depend_on_where_a_body_lies_and_scale_with_its_size(
        which in 0..2_usize,
        angles in prop::array::uniform3(-3.0..3.0_f64),
        shift in prop::array::uniform3(-50.0..50.0_f64),
        size in 0.01..100.0_f64,
    ) {
        // Of a chickpea, which is as wide as thick, axes and boxes are not unique.
        let body = [Body::Bean, Body::Maize][which];
        let still = mesh(body.surface().as_ref(), 12);
        let turn = Rotation3::from_euler_angles(angles[0], angles[1], angles[2]);
        let other = moved(&still, &turn, &(Vector3::from(shift) * size), size);
        let (one, other) = (figures(&still).unwrap(), figures(&other).unwrap());
        for (i, ((power, one), (_, other))) in one.into_iter().zip(other).enumerate() {
            let expected = one * size.powi(power);
            prop_assert!((other - expected).abs() <= 1e-6 * expected.abs() + 1e-9, "figure {i}: {other} {expected}");
        }
    }
}

/// Its moments are equal, and its principal axes may be any.
#[test]
fn a_turned_cube_is_as_long_as_wide_and_thick() {
    let corner = |i: usize| Point3::from([i & 1, i >> 1 & 1, i >> 2].map(|c| c as f64));
    let cube = convex_hull(&(0..8).map(corner).collect::<Vec<_>>()).unwrap();
    let column = |height: f64| {
        let mut mesh = cube.clone();
        mesh.vertices.iter_mut().for_each(|p| p.z *= height);
        let turn = Rotation3::from_euler_angles(0.4, 0.7, -1.1);
        moved(&mesh, &turn, &Vector3::new(1.0, 2.0, 3.0), 2.0)
    };
    for (height, expected) in [
        (1.0, [2.0, 2.0, 2.0]),
        (3.0, [6.0, 2.0, 2.0]),
        (0.5, [2.0, 2.0, 1.0]),
    ] {
        let mesh = column(height);
        let dimensions = Survey::of_mesh(&mesh).unwrap().dimensions().unwrap();
        assert_relative_eq!(dimensions, Vector3::from(expected), max_relative = 1e-8);
    }
}

#[test]
fn meshes_that_are_no_closed_surface_of_one_body_are_refused() {
    let ball = mesh(
        &Ellipsoid {
            semi_axes: Vector3::repeat(1.0),
        },
        8,
    );
    let refused = |change: &dyn Fn(&mut Mesh)| {
        let mut changed = ball.clone();
        change(&mut changed);
        Survey::of_mesh(&changed).err()
    };
    assert_eq!(refused(&|_| ()), None);
    let is_twice = |found: Option<SurveyError>| {
        matches!(
            found,
            Some(SurveyError::NotClosed(MeshDefect::EdgeUsedTwice { .. }))
        )
    };
    assert!(is_twice(refused(&|mesh| mesh
        .triangles
        .extend_from_within(..))));
    assert!(is_twice(refused(&|mesh| mesh
        .triangles
        .extend_from_within(..1))));
    assert!(is_twice(refused(&|mesh| mesh.triangles[5].swap(0, 1))));
    let open = refused(&|mesh| mesh.triangles.truncate(mesh.triangles.len() - 1));
    assert!(matches!(
        open,
        Some(SurveyError::NotClosed(MeshDefect::OpenEdge { .. }))
    ));
    let two = refused(&|mesh| {
        let count = mesh.vertices.len() as u32;
        mesh.vertices.extend_from_within(..);
        let again = mesh
            .triangles
            .iter()
            .map(|corners| corners.map(|at| at + count));
        let again: Vec<_> = again.collect();
        mesh.triangles.extend(again);
    });
    assert_eq!(two, Some(SurveyError::Several { bodies: 2 }));
}

#[test]
fn an_ellipsoid_has_its_closed_forms() {
    let semi_axes = Vector3::new(3.0, 2.0, 1.0);
    let surface = Ellipsoid { semi_axes };
    let mesh = mesh(&surface, 64);
    let survey = Survey::of_mesh(&mesh).unwrap();
    let dimensions = survey.dimensions().unwrap();
    assert_relative_eq!(dimensions, semi_axes * 2.0, epsilon = 1e-8);
    let smallest = survey.minimum_box().unwrap();
    assert_relative_eq!(smallest.volume(), 48.0, max_relative = 2e-3);
    assert_relative_eq!(survey.inscribed().unwrap().radius, 1.0, max_relative = 1e-3);
    let enclosing = survey.enclosing().unwrap();
    assert_relative_eq!(enclosing.radius, 3.0, max_relative = 1e-9);
    assert_relative_eq!(survey.convexity().unwrap().volume, 1.0, epsilon = 1e-4);
    let ellipsoid = survey.ellipsoid().unwrap();
    assert_relative_eq!(ellipsoid.semi_axes, semi_axes, max_relative = 1e-3);
    assert!(survey.angularity().unwrap() < 1e-3);
    let form = survey.form().unwrap();
    assert_relative_eq!(form.aspect_ratio, 3.0, max_relative = 1e-9);
    assert_relative_eq!(form.elongation, 2.0 / 3.0, max_relative = 1e-9);
    assert_relative_eq!(form.flatness, 0.5, max_relative = 1e-9);
}

#[test]
fn triangles_have_no_curvature_and_a_fitted_grain_has_that_of_its_body() {
    let still = mesh(Body::Bean.surface().as_ref(), 8);
    let survey = Survey::of_mesh(&still).unwrap();
    assert_eq!(survey.curvature().unwrap_err(), SurveyError::Flat);
    assert_eq!(survey.roundness(), Err(SurveyError::Flat));

    let semi_axes = Vector3::new(3.0, 2.5, 2.0);
    let scan = synthesize(
        &SynthOptions::clean(Body::Ellipsoid)
            .with_axes(semi_axes)
            .with_points(6146),
    )
    .unwrap();
    let scan = Scan::from_points(scan.points);
    let options = FitOptions::default().with_tolerance(Tolerance::OfMeanRadius(5e-5));
    let grain = fit(&scan, &options).unwrap().grain;
    let survey = Survey::of_grain(&grain, Scheme::Exact);
    let curvature = survey.curvature().unwrap();
    assert!(curvature.gauss_bonnet_error().abs() < 1e-3);
    // K is largest at the tips of the longest axis and least at those of the shortest.
    let [a, b, c]: [f64; 3] = semi_axes.into();
    let gaussian = curvature.gaussian();
    assert_relative_eq!(gaussian.largest, (a / (b * c)).powi(2), max_relative = 0.1);
    assert_relative_eq!(gaussian.least, (c / (a * b)).powi(2), max_relative = 0.1);
    // Nearly nothing is sharper than the inscribed sphere at the ends of the least axis.
    let roundness = survey.roundness().unwrap();
    assert!((0.6..1.0).contains(&roundness), "{roundness}");
    let regularity = survey.regularity().unwrap();
    assert_relative_eq!(regularity, 0.5 * (roundness + c / a), max_relative = 1e-3);
}

#[test]
fn a_radius_is_expanded_up_to_the_largest_degree_of_a_model() {
    let ball = Mesh::radial(8, |_| 2.0);
    let survey = Survey::of_mesh(&ball).unwrap();
    assert_eq!(survey.expansion(2).unwrap().coefficients.len(), 9);
    for found in [EXPANSION_DEGREE + 1, usize::MAX] {
        let refused = survey.expansion(found).unwrap_err();
        assert_eq!(refused, SurveyError::Degree { found });
    }
}

#[test]
fn a_survey_is_sent_to_other_threads_and_cloned_with_what_it_knows() {
    fn is_sent<T: Send + Clone + std::fmt::Debug>(_: &T) {}
    let ball = Mesh::radial(8, |_| 2.0);
    let survey = Survey::of_mesh(&ball).unwrap();
    is_sent(&survey);
    let clone = survey.clone();
    assert_eq!(clone.enclosing().unwrap(), survey.enclosing().unwrap());
}

#[test]
fn a_mesh_of_nothing_has_no_extents_and_one_that_is_nowhere_is_not_closed() {
    let axes = Matrix3::identity();
    assert_eq!(extents(&Mesh::default(), &axes), Vector3::zeros());
    let mut ball = Mesh::radial(8, |_| 2.0);
    assert_relative_eq!(extents(&ball, &axes), Vector3::repeat(4.0), epsilon = 1e-12);
    ball.check_closed().unwrap();
    ball.vertices[5].y = f64::NAN;
    assert_eq!(
        ball.check_closed(),
        Err(MeshDefect::NotFinite { vertex: 5 })
    );
}
