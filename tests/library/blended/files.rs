//! Blended grains as JSON.

use super::grains::{all, blended, blended_within, plain, ragged, segmented, turned, whole};
use grainform::model::{
    ModelError, NoStandardErrors, StandardErrors, Stretch, grain_from_json, grain_to_json,
};
use grainform::sphere::CubeCell;
use grainform::{StarGrain, StarSurface, Surface};
use nalgebra::{Matrix3, Vector3};
use serde_json::{Value, json};

fn to_json(grain: &StarGrain) -> String {
    grain_to_json(&grain.clone().into())
}

fn from_json(text: &str) -> Result<StarGrain, ModelError> {
    let grain = grain_from_json(text)?;
    Ok(grain.star().cloned().expect("a star-shaped grain"))
}

fn cells(grain: &StarGrain) -> Option<&[CubeCell]> {
    grain
        .family()
        .blended()
        .map(|surface| surface.cover().cells())
}

#[test]
fn grains_of_all_kinds_are_the_same_to_the_last_bit_once_saved() {
    let mut grains = all(turned());
    grains.push(segmented(1, turned()));
    grains.push(segmented(4, turned()));
    grains.push(whole(17, turned()));
    let factors = Stretch::new(Vector3::new(0.1 + 0.2, 1.0, 1.0 / 3.0)).expect("factors");
    for grain in grains.clone() {
        let stretched = StarGrain::stretched(grain.frame(), factors, grain.family().clone());
        grains.push(stretched.expect("a frame"));
    }
    for grain in grains {
        let text = to_json(&grain);
        assert!(text.contains("\"version\": 9"));
        let loaded = from_json(&text).expect("a model");
        assert_eq!(loaded.frame(), grain.frame());
        assert_eq!(loaded.stretch(), grain.stretch());
        assert_eq!(loaded.coefficients(), grain.coefficients());
        assert_eq!(cells(&loaded), cells(&grain));
        assert_eq!(to_json(&loaded), text);
        let n = Vector3::new(0.36, -0.48, 0.8);
        assert_eq!(loaded.radius(&n).to_bits(), grain.radius(&n).to_bits());
    }
}

#[test]
fn a_file_of_the_first_version_is_still_read() {
    let text = r#"{
        "format": "grainform model",
        "version": 1,
        "centre": [1.0, 2.0, 3.0],
        "axes": [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]],
        "parts_per_angle": 2,
        "segments": [[5.0], [6.0], [7.0], [8.0, 0.1, 0.2, 0.3]]
    }"#;
    let grain = from_json(text).expect("a model");
    assert_eq!(grain.segments(), 4);
    assert!(grain.family().segmented().is_some());
    assert_eq!(grain.coefficients()[3], [8.0, 0.1, 0.2, 0.3]);
    let n = Vector3::new(0.0, 0.6, 0.8);
    assert!((grain.radius(&n) - 5.0).abs() < 1e-15);
    let again = to_json(&grain);
    assert!(again.contains("\"version\": 9"));
    assert_eq!(
        from_json(&again).expect("a model").coefficients(),
        grain.coefficients()
    );
}

#[test]
fn a_file_of_the_second_version_is_still_read() {
    let text = r#"{
        "format": "grainform model",
        "version": 2,
        "centre": [1.0, 2.0, 3.0],
        "axes": [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]],
        "symmetry": "xyz",
        "coefficients": [5.0]
    }"#;
    let grain = from_json(text).expect("a model");
    assert!(grain.family().mirrored().is_some());
    assert!(grain.stretch().is_none());
}

#[test]
fn stretches_and_harmonics_that_are_not_sound_are_refused() {
    let grain = whole(2, plain());
    let numbers = [
        json!([0.0, 1.0, 1.0]),
        json!([1.0, -1.0, 1.0]),
        json!([1.0, 1e7, 1.0]),
    ];
    for factors in numbers {
        let found = spoilt(&grain, |value| value["stretch"] = factors.clone());
        assert!(matches!(found, Err(ModelError::Invalid(_))), "{found:?}");
    }
    for factors in [json!([1.0, 1.0]), json!([1.0, 1.0, null]), json!("none")] {
        let found = spoilt(&grain, |value| value["stretch"] = factors.clone());
        assert!(matches!(found, Err(ModelError::Form(_))), "{found:?}");
    }
    for own in [json!([]), json!([1.0, 2.0]), json!(vec![1.0; 130 * 130])] {
        let found = spoilt(&grain, |value| value["harmonics"] = own.clone());
        assert!(matches!(found, Err(ModelError::Invalid(_))), "{found:?}");
    }
    for own in [json!([null]), json!(["1"]), json!(1.0)] {
        let found = spoilt(&grain, |value| value["harmonics"] = own.clone());
        assert!(matches!(found, Err(ModelError::Form(_))), "{found:?}");
    }
    let text = to_json(&grain).replacen("\"harmonics\": [", "\"harmonics\": [1e999,", 1);
    assert!(from_json(&text).is_err());
    let cells = spoilt(&blended(CubeCell::uniform(1), plain()), |value| {
        value["harmonics"] = json!([1.0]);
    });
    assert!(matches!(cells, Err(ModelError::Surface)), "{cells:?}");
}

/// The text of a grain with something changed.
fn spoilt(grain: &StarGrain, spoil: impl Fn(&mut Value)) -> Result<StarGrain, ModelError> {
    let mut value: Value = serde_json::from_str(&to_json(grain)).expect("JSON");
    spoil(&mut value);
    from_json(&value.to_string())
}

#[test]
fn cells_that_do_not_tile_are_refused() {
    for grain in [
        blended(CubeCell::uniform(1), plain()),
        blended(ragged(1, 9, 2), plain()),
    ] {
        let list = |value: &mut Value| value["cells"].as_array().cloned().expect("cells");
        let refused = |spoil: &dyn Fn(&mut Vec<Value>)| {
            let found = spoilt(&grain, |value| {
                let mut cells = list(value);
                spoil(&mut cells);
                value["cells"] = json!(cells);
            });
            assert!(matches!(found, Err(ModelError::Cover(_))), "{found:?}");
        };
        refused(&|cells| drop(cells.pop()));
        refused(&|cells| cells.clear());
        refused(&|cells| cells.push(cells[0].clone()));
        refused(&|cells| cells[1] = cells[0].clone());
        refused(&|cells| cells[0]["face"] = json!(6));
        refused(&|cells| cells[0]["parts"] = json!(0));
        refused(&|cells| cells[0]["parts"] = json!(65));
        refused(&|cells| cells[0]["row"] = json!(60_000));
        refused(&|cells| *cells = vec![cells[0].clone(); 70_000]);
        let faulty = [
            json!(-1),
            json!(1.5),
            json!(70_000),
            json!("0"),
            Value::Null,
        ];
        for number in faulty {
            for name in ["face", "parts", "row", "column"] {
                let found = spoilt(&grain, |value| value["cells"][0][name] = number.clone());
                assert!(matches!(found, Err(ModelError::Form(_))), "{found:?}");
            }
        }
    }
}

#[test]
fn coefficients_that_make_no_expansion_are_refused() {
    let grain = blended(CubeCell::uniform(1), plain());
    for own in [
        json!([]),
        json!([1.0, 2.0]),
        json!([1.0, 2.0, 3.0, 4.0, 5.0]),
    ] {
        let found = spoilt(&grain, |value| {
            value["cells"][3]["coefficients"] = own.clone()
        });
        assert!(matches!(found, Err(ModelError::Invalid(_))), "{found:?}");
    }
    let text = to_json(&grain);
    for broken in ["1e999", "null", "\"NaN\"", "NaN"] {
        let start = text.find("\"coefficients\": [").expect("coefficients") + 17;
        let end = start + text[start..].find(',').expect("numbers");
        let mutilated = format!("{}{broken}{}", &text[..start], &text[end..]);
        assert!(from_json(&mutilated).is_err(), "{broken}");
    }
    assert!(from_json(&text[..text.len() / 2]).is_err());
}

#[test]
fn a_file_with_both_kinds_of_surface_or_none_is_refused() {
    let (joined, parted) = (
        blended(CubeCell::uniform(1), plain()),
        segmented(2, plain()),
    );
    let parts: Value = serde_json::from_str(&to_json(&parted)).expect("JSON");
    for names in [
        &["segments"][..],
        &["parts_per_angle"],
        &["segments", "parts_per_angle"],
    ] {
        let both = spoilt(&joined, |value| {
            for name in names {
                value[*name] = parts[*name].clone();
            }
        });
        assert!(matches!(both, Err(ModelError::Surface)), "{both:?}");
        let neither = spoilt(&parted, |value| {
            for name in names {
                value.as_object_mut().expect("an object").remove(*name);
            }
        });
        assert!(matches!(neither, Err(ModelError::Surface)), "{neither:?}");
    }
    let nothing = spoilt(&joined, |value| {
        value.as_object_mut().expect("an object").remove("cells");
    });
    assert!(matches!(nothing, Err(ModelError::Surface)), "{nothing:?}");
}

#[test]
fn errors_of_the_curvature_in_older_files_are_passed_over() {
    let grain = blended(CubeCell::uniform(1), plain());
    let mut value: Value = serde_json::from_str(&to_json(&grain)).expect("JSON");
    value["version"] = json!(6);
    value["curvature_errors"] = json!(vec![0.1; 864]);
    let older = grain_from_json(&value.to_string()).expect("a model");
    assert!(older.local_errors().is_none());
}

#[test]
fn other_versions_and_unknown_fields_are_refused() {
    let grain = blended(CubeCell::uniform(1), plain());
    for version in [0, 10, 99] {
        let found = spoilt(&grain, |value| value["version"] = json!(version));
        assert!(
            matches!(found, Err(ModelError::Version { .. })),
            "{found:?}"
        );
    }
    assert!(spoilt(&grain, |value| value["colour"] = json!("brown")).is_err());
    assert!(spoilt(&grain, |value| value["cells"][0]["colour"] = json!("brown")).is_err());
    let skewed = spoilt(&grain, |value| value["axes"][0] = json!([0.6, 0.0, 0.8]));
    assert!(matches!(skewed, Err(ModelError::Invalid(_))), "{skewed:?}");
}

#[test]
fn margins_are_kept_checked_and_left_out_where_they_are_the_usual() {
    let wide = blended_within(ragged(1, 9, 2), 0.6, turned());
    let margin = |grain: &StarGrain| grain.family().blended().map(|s| s.cover().margin());
    let loaded = from_json(&to_json(&wide)).expect("a model");
    assert_eq!(margin(&loaded), Some(0.6));
    let usual = blended(ragged(1, 9, 2), turned());
    assert!(!to_json(&usual).contains("margin"));
    assert_eq!(margin(&usual), Some(grainform::sphere::MARGIN));
    for number in [json!(0.0), json!(-0.4), json!(1.5), json!(1e300)] {
        let found = spoilt(&wide, |value| value["margin"] = number.clone());
        assert!(matches!(found, Err(ModelError::Cover(_))), "{found:?}");
    }
    let found = spoilt(&wide, |value| value["margin"] = json!("wide"));
    assert!(matches!(found, Err(ModelError::Form(_))), "{found:?}");
    let found = spoilt(&segmented(2, plain()), |value| value["margin"] = json!(0.4));
    assert!(matches!(found, Err(ModelError::Surface)), "{found:?}");
}

#[test]
fn standard_errors_are_kept_to_the_last_bit_or_why_there_are_none() {
    let known = StandardErrors {
        area: 0.1 + 0.2,
        volume: 1.0 / 3.0,
        centroid: Vector3::new(0.1, 0.2, 0.3),
        inertia: Matrix3::from_fn(|i, j| 0.1 * (i + 4 * j) as f64),
        moments: Vector3::new(4.0, 5.0, 6.0),
        dimensions: Vector3::new(7.0, 8.0, 9.0),
        dimensions_excess: Vector3::new(0.7, 0.8, 0.0),
    };
    let grain = || grain_from_json(&to_json(&whole(2, turned()))).expect("a model");
    let half_angle = 0.1 + 0.2;
    for found in [
        Ok(known),
        Err(NoStandardErrors::Neck),
        Err(NoStandardErrors::NotEstimated),
        Err(NoStandardErrors::Hole { half_angle }),
        Err(NoStandardErrors::NotTold),
    ] {
        let text = grain_to_json(&grain().with_standard_errors(found));
        let loaded = grain_from_json(&text).expect("a model");
        assert_eq!(loaded.standard_errors(), found);
        assert_eq!(grain_to_json(&loaded), text);
    }
    assert_eq!(grain().standard_errors(), Err(NoStandardErrors::NotTold));
    for area in [f64::NAN, f64::INFINITY, -1.0] {
        let spoilt = grain().with_standard_errors(Ok(StandardErrors { area, ..known }));
        assert_eq!(spoilt.standard_errors(), Err(NoStandardErrors::NotFinite));
    }
}

#[test]
fn standard_errors_that_are_none_are_refused() {
    let errors = json!({
        "area": 1.0, "volume": 1.0, "centroid": [1.0, 1.0, 1.0],
        "inertia": [[1.0, 1.0, 1.0], [1.0, 1.0, 1.0], [1.0, 1.0, 1.0]],
        "moments": [1.0, 1.0, 1.0], "dimensions": [1.0, 1.0, 1.0],
        "dimensions_excess": [0.0, 0.0, 0.0],
    });
    let told = |errors: Value, why: Value| {
        spoilt(&whole(2, plain()), |file| {
            file["standard_errors"] = errors.clone();
            file["no_standard_errors"] = why.clone();
        })
    };
    assert!(told(errors.clone(), Value::Null).is_ok());
    assert!(told(Value::Null, json!("neck")).is_ok());
    let spoil = |at: &str, number: Value| {
        let mut errors = errors.clone();
        *errors.pointer_mut(at).expect("a number") = number;
        told(errors, Value::Null)
    };
    for found in [
        told(errors.clone(), json!("neck")),
        told(Value::Null, json!({"hole": {"half_angle": 4.0}})),
        told(Value::Null, json!({"unresolved": {"kurtosis": -1.0}})),
        spoil("/area", json!(-1.0)),
        spoil("/volume", json!(-1.0)),
        spoil("/centroid/2", json!(-1.0)),
        spoil("/inertia/1/2", json!(-1.0)),
        spoil("/moments/0", json!(-1.0)),
        spoil("/dimensions/1", json!(-1e-300)),
        spoil("/dimensions_excess/1", json!(-1.0)),
    ] {
        assert!(
            matches!(found, Err(ModelError::StandardErrors)),
            "{found:?}"
        );
    }
    for found in [
        told(json!({}), Value::Null),
        told(json!(1.0), Value::Null),
        told(Value::Null, json!("not_told")),
        told(Value::Null, json!("bad weather")),
        spoil("/area", Value::Null),
        spoil("/moments", json!([1.0, 1.0])),
        spoil("/inertia", json!([1.0])),
    ] {
        assert!(matches!(found, Err(ModelError::Form(_))), "{found:?}");
    }
}
