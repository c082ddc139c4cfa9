//! Real scans from the folder beside the project. Ignored where it is absent.

use grainform::fit::{Context, Kind, KindChoice, MapError, fit_position};
use grainform::measure::{grain_properties, mesh_properties};
use grainform::scan::{Scan, read_scan};
use grainform::{FitError, FitOptions, Fitted, StarSurface, Surface, fit};
use std::path::{Path, PathBuf};

fn scans() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../shared/scans")
}

fn try_fit(path: &Path) -> Result<Fitted, FitError> {
    fit(
        &read_scan(path).expect("a readable scan"),
        &FitOptions::default(),
    )
}

/// Whether a warning has these words.
fn told(fitted: &Fitted, words: &str) -> bool {
    let mut warnings = fitted.warnings().iter().map(ToString::to_string);
    warnings.any(|warning| warning.contains(words))
}

/// Fits a scan and returns the deviations of area and volume from its reference surface.
fn deviations(path: &Path) -> (f64, f64) {
    let fitted = try_fit(path).unwrap_or_else(|error| panic!("{}: {error}", path.display()));
    let found = grain_properties(&fitted.grain).properties;
    fitted.grain.mesh(16).check_closed().expect("closed");
    (
        found.area / fitted.reference.area - 1.0,
        found.volume / fitted.reference.volume - 1.0,
    )
}

#[test]
#[cfg_attr(not(shared), ignore = "needs ../shared")]
fn real_grains_and_stones_are_fitted() {
    let scans = scans();
    for (name, area_bound, volume_bound) in [
        ("barley/barley_S017_l1_38.stl", 0.02, 0.005),
        ("barley/barley_S017_l2_07_ascii.ply", 0.02, 0.005),
        ("barley/barley_S017_l1_10.stl", 0.03, 0.005),
        ("barley/barley_seed8_mc.ply", 0.02, 0.005),
        ("nist/cement116-anm-00377_n22_ico5.ply", 0.02, 0.005),
        ("nist/cement140-anm-00003_n30_ico5.ply", 0.02, 0.005),
        ("nist/ma165-anm-00001_n18_ico5.ply", 0.02, 0.005),
        ("nist/sacci425-anm-030882_n22_ico5.ply", 0.02, 0.005),
        ("potato/danshaku_08_L25_ico5.ply", 0.005, 0.002),
        ("stone/073ac15d_Mesh.ply", 0.02, 0.005),
        ("stone/low_res_AAA.ply", 0.02, 0.01),
        ("stone/low_res_E22.ply", 0.02, 0.005),
        ("standins/bean_stoneE22_1538.xyz", 0.03, 0.02),
        ("standins/chickpea_danshaku_6146.xyz", 0.005, 0.003),
        ("standins/maize_levallois_6146.xyz", 0.03, 0.01),
        ("standins/barley_l1_01_6146.xyz", 0.03, 0.01),
    ] {
        let (area, volume) = deviations(&scans.join(name));
        assert!(area.abs() < area_bound, "{name}: area {area}");
        assert!(volume.abs() < volume_bound, "{name}: volume {volume}");
    }
}

#[test]
#[cfg_attr(not(shared), ignore = "needs ../shared")]
fn every_third_kernel_of_the_batch_is_fitted() {
    let scans = scans();
    let entries = std::fs::read_dir(scans.join("barley_batch")).expect("a folder");
    let mut paths: Vec<PathBuf> = entries
        .map(|entry| entry.expect("an entry").path())
        .collect();
    paths.retain(|path| path.extension().is_some_and(|extension| extension == "ply"));
    paths.sort();
    assert_eq!(paths.len(), 87);
    for path in paths.iter().step_by(3) {
        let (_, volume) = deviations(path);
        assert!(volume.abs() < 0.06, "{}: volume {volume}", path.display());
    }
}

/// Of these kernels the points seem to tell of texture that the exact likelihood denies, by 9 to 50 in its logarithm: with
/// it the first was held out with 2.39 % of its mean radius, the second with 2.19.
#[test]
#[cfg_attr(not(shared), ignore = "needs ../shared")]
fn texture_that_makes_points_less_likely_is_given_up() {
    for (name, largest) in [("l1_25", 0.022), ("l1_26", 0.021)] {
        let path = scans().join(format!("barley_batch/{name}.ply"));
        let fitted = try_fit(&path).expect("a grain");
        let held_out = fitted.search.choice().heldout_rms.expect("an estimate");
        assert!(
            held_out < largest * fitted.mean_radius,
            "{name}: {held_out}"
        );
    }
}

/// A potato, of which the likelihood of so many points, as far as it is known, denies one cloud in two its detail.
#[test]
#[cfg_attr(not(shared), ignore = "needs ../shared")]
fn the_degree_is_the_one_by_which_hidden_points_are_met() {
    let path = scans().join("standins/chickpea_danshaku_6146.xyz");
    let scan = read_scan(&path).expect("a readable scan");
    for first in [1, 2] {
        let is_hidden = |at: usize| at % 10 == first;
        let points = || scan.points().iter().copied().enumerate();
        let seen = points().filter(|&(at, _)| !is_hidden(at));
        let seen = Scan::from_points(seen.map(|(_, point)| point).collect());
        let fitted = fit(&seen, &FitOptions::default().with_segments(1)).expect("a grain");
        let grain = fitted.grain.star().expect("a radius");
        let misses = points().filter(|&(at, _)| is_hidden(at)).map(|(_, point)| {
            let ray = point - fitted.grain.frame().centre;
            ray.norm() - grain.radius(&ray.normalize())
        });
        let misses: Vec<f64> = misses.collect();
        let squares: f64 = misses.iter().map(|miss| miss * miss).sum();
        let rms = (squares / misses.len() as f64).sqrt() / fitted.mean_radius;
        assert!(rms < 3e-4, "{first}: {rms}");
    }
}

#[test]
#[cfg_attr(not(shared), ignore = "needs ../shared")]
fn what_is_no_ball_is_refused_with_the_reason() {
    let scans = scans();
    match try_fit(&scans.join("not_star/torus.STL")) {
        Err(FitError::NotMapped(MapError::Handles { genus: 1 })) => (),
        other => panic!("a torus: {:?}", other.map(|_| ())),
    }
    match try_fit(&scans.join("not_star/A46_point_cloud.ply")) {
        Err(FitError::NoKind { radius, .. }) => {
            assert!(matches!(*radius, FitError::Strays { share } if share > 0.2));
        }
        other => panic!("a scene: {:?}", other.map(|_| ())),
    }
    assert!(try_fit(&scans.join("stone/remeshed_high_res_A13.ply")).is_err());
}

#[test]
#[cfg_attr(not(shared), ignore = "needs ../shared")]
fn folds_are_followed_by_positions() {
    let scans = scans();
    let fitted = try_fit(&scans.join("stone/low_res_E34.ply")).expect("nearly star-shaped");
    assert!(fitted.grain.position().is_some() && fitted.warnings().is_empty());
    // A radius leaves 1 % of the size.
    assert!(fitted.residuals.rms < 0.004 * fitted.mean_radius);
    let found = grain_properties(&fitted.grain).properties;
    assert!((found.volume / fitted.reference.volume - 1.0).abs() < 0.003);
}

#[test]
#[cfg_attr(not(shared), ignore = "needs ../shared")]
fn odd_clouds_of_the_hostile_folder_end_as_they_should() {
    let scans = scans();
    let made = scans.join("../hostile/made");
    let error = try_fit(&made.join("ply_082_torus.ply")).expect_err("a torus");
    let reason = error.to_string();
    assert!(
        reason.contains("faces away") || reason.contains("genus"),
        "{reason}"
    );
    let outliers = try_fit(&made.join("ply_084_outliers_1pct.ply")).expect("a grain");
    assert!(told(&outliers, "farther from it than their neighbours"));
    let half = try_fit(&made.join("ply_085_half_scan.ply")).expect("half a grain");
    assert!(told(&half, "is a guess"), "{:?}", half.warnings());
    assert!(try_fit(&made.join("ply_078_two_bodies.ply")).is_err());
}

/// A clean steep particle: its radius meets the limit, to which positions of the most coefficients do not come near.
#[test]
#[cfg_attr(not(shared), ignore = "needs ../shared")]
fn positions_that_cannot_be_better_are_given_up() {
    let scan = read_scan(&scans().join("nist/cement116-anm-00377_n22_ico5.ply")).expect("a scan");
    let fitted = fit(&scan, &FitOptions::default()).expect("a grain");
    let KindChoice::Outdoes { kept, forecast } = fitted.kind else {
        panic!("{:?}", fitted.kind);
    };
    assert!(fitted.grain.star().is_some());
    assert_eq!(kept.coefficients, fitted.grain.coefficient_count());
    assert!(kept.rms < fitted.search.limit && forecast.rms > fitted.search.limit);
    let options = FitOptions::default().with_kind(Kind::Position);
    let position = fit(&scan, &options).expect("a position");
    assert!(forecast.rms < position.search.choice().heldout_rms.expect("distances"));
}

#[test]
#[cfg_attr(not(shared), ignore = "needs ../shared")]
fn what_no_centre_sees_is_fitted_by_its_position() {
    let scans = scans();
    // Root mean square and largest distance, in % of the radius of the ball of equal volume.
    for (name, rms, max) in [
        ("barley/barley_S017_l3_18.stl", 0.22, 1.2),
        ("stone/low_res_E34.ply", 0.30, 2.5),
    ] {
        let scan = read_scan(&scans.join(name)).expect("a readable scan");
        let options = FitOptions::default().with_segments(54).with_degree(3);
        let fit = fit_position(&scan, &options, &Context::default()).expect("one closed surface");
        let percent = 100.0 / fit.radius;
        assert_eq!(fit.surface.coefficient_count(), 3 * 864);
        assert!(
            fit.distance.rms * percent < rms,
            "{name}: {:?}",
            fit.distance
        );
        assert!(
            fit.distance.max * percent < max,
            "{name}: {:?}",
            fit.distance
        );
        assert!(
            fit.held_out.rms * percent < 1.5 * rms,
            "{name}: {:?}",
            fit.held_out
        );
        assert_eq!((fit.turned_over, fit.crossings), (0, 0), "{name}");
        let (directions, triangles) = grainform::sphere::cube_grid(64);
        let points = fit.surface.points_and_tangents(&directions);
        let mesh = grainform::Mesh {
            vertices: points.iter().map(|(x, _)| fit.frame.to_scan(x)).collect(),
            triangles,
        };
        let volume = mesh_properties(&mesh).expect("a closed mesh").volume;
        assert!(
            (volume / fit.reference.volume - 1.0).abs() < 0.003,
            "{name}: {volume}"
        );
    }
}
