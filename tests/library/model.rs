//! The grain of independent segments: evaluation, mesh, file, published coefficients.

use gauss_quad::GaussLegendre;
use grainform::measure::{Moments, grain_properties, integrate, mesh_properties};
use grainform::model::{
    Frame, Grain, ModelError, Position, PositionGrain, Region, Segmented, StarGrain, StarSurface,
    Superquadric, SuperquadricGrain, Surface, grain_from_json, grain_to_json,
};
use grainform::scan::Scan;
use grainform::shapes::{Body, SynthOptions, synthesize};
use grainform::sphere::{cube_grid, harmonics};
use grainform::{FitOptions, Seams, fit};
use nalgebra::Vector3;

fn grain(degree: usize, parts: usize) -> StarGrain {
    let made =
        synthesize(&SynthOptions::clean(Body::Chickpea).with_offset(Vector3::new(40.0, -3.0, 7.0)))
            .expect("valid options");
    let scan = Scan::from_points(made.points);
    let options = FitOptions::default()
        .with_seams(Seams::None)
        .with_degree(degree)
        .with_segments(parts * parts);
    let fitted = fit(&scan, &options).expect("a grain");
    fitted.grain.star().cloned().expect("a star-shaped grain")
}

fn to_json(grain: &StarGrain) -> String {
    grain_to_json(&grain.clone().into())
}

fn from_json(text: &str) -> Result<StarGrain, ModelError> {
    let grain = grain_from_json(text)?;
    Ok(grain.star().cloned().expect("a star-shaped grain"))
}

fn segmented(grain: &StarGrain) -> &Segmented {
    grain.family().segmented().expect("independent segments")
}

#[test]
fn the_mesh_is_closed_at_every_resolution_and_partition() {
    for (degree, parts) in [(0, 5), (1, 1), (3, 4), (6, 2)] {
        let grain = grain(degree, parts);
        for resolution in [1, 2, 7, 40] {
            let mesh = grain.mesh(resolution);
            mesh.check_closed().expect("closed and oriented");
            assert_eq!(mesh.vertices.len(), 6 * resolution * resolution + 2);
        }
    }
}

#[test]
fn the_mesh_has_the_volume_centroid_and_inertia_of_the_grain() {
    let grain = grain(3, 4);
    let exact = grain_properties(&grain).properties;
    let mesh = mesh_properties(&grain.mesh(120)).expect("closed");
    assert!((mesh.volume / exact.volume - 1.0).abs() < 3e-4);
    assert!((mesh.centroid - exact.centroid).norm() < 3e-3);
    assert!((mesh.inertia - exact.inertia).norm() < 1e-3 * exact.inertia.norm());
}

#[test]
fn piecewise_integrals_agree_with_those_that_know_nothing_of_segments() {
    // One segment: the surface is smooth, both routes must agree to their tolerance.
    let grain = grain(5, 1);
    let pieces = grain_properties(&grain);
    let whole = integrate(&grain, 1e-10);
    let centre = grain.frame().centre;
    assert!((pieces.properties.area / whole.properties.area - 1.0).abs() < 1e-9);
    assert!((pieces.properties.volume / whole.properties.volume - 1.0).abs() < 1e-12);
    assert!(
        (pieces.properties.centroid - centre - whole.properties.centroid.coords).norm() < 1e-10
    );
    let inertia = (pieces.properties.inertia - whole.properties.inertia).norm();
    assert!(inertia < 1e-10 * pieces.properties.inertia.norm());
}

#[test]
fn volume_and_inertia_are_exact_and_the_area_meets_its_tolerance() {
    for (degree, parts) in [(3, 1), (3, 4), (2, 7)] {
        let grain = grain(degree, parts);
        let found = grain_properties(&grain).properties;
        // Forty nodes per side of each segment: far beyond what polynomials of degree 17 need.
        let rule = GaussLegendre::new(40.try_into().expect("a count"));
        let on = |[from, to]: [f64; 2]| {
            let (middle, half) = (0.5 * (from + to), 0.5 * (to - from));
            rule.iter().map(move |(x, w)| (middle + half * x, half * w))
        };
        let mut moments = Moments::default();
        for segment in 0..parts * parts {
            let rectangle = segmented(&grain).partition().rectangle(segment);
            for (theta, polar) in on(rectangle.theta) {
                for (phi, azimuthal) in on(rectangle.phi) {
                    let (st, ct) = theta.sin_cos();
                    let local = Vector3::new(st * phi.cos(), st * phi.sin(), ct);
                    let n = grain.frame().axes * local;
                    let (r, g) = grain.radius_and_gradient(&n);
                    let area = (n * r - g) * (r * polar * azimuthal * st);
                    moments.add_element(&(n * r), &area);
                }
            }
        }
        let exact = moments.about_centroid(&grain.frame().centre);
        assert!((found.volume / exact.volume - 1.0).abs() < 1e-13);
        assert!((found.inertia - exact.inertia).norm() < 1e-12 * exact.inertia.norm());
        assert!((found.area / exact.area - 1.0).abs() < 1e-9);
    }
}

#[test]
fn the_gradient_is_the_derivative_of_the_radius_also_at_the_poles() {
    let grain = grain(6, 1);
    let poles = [1.0, -1.0].map(|s| grain.frame().axes.column(2) * s);
    let (directions, _) = cube_grid(4);
    for n in poles.into_iter().chain(directions) {
        let (radius, gradient) = grain.radius_and_gradient(&n);
        assert_eq!(radius, grain.radius(&n));
        assert!(gradient.dot(&n).abs() < 1e-12 * radius);
        let normal = grain.normal(&n);
        assert!((normal.norm() - 1.0).abs() < 1e-14 && normal.dot(&n) > 0.0);
        let tangent = n.cross(&Vector3::new(0.31, 0.77, -0.52)).normalize();
        let at = |h: f64| grain.radius(&(n * h.cos() + tangent * h.sin()));
        let h = 1e-5;
        let difference = (at(h) - at(-h)) / (2.0 * h);
        assert!((gradient.dot(&tangent) - difference).abs() < 1e-6 * radius);
    }
}

#[test]
fn directions_of_any_length_lead_to_the_same_places() {
    let star = grain(3, 4);
    let body = Superquadric::single([2.0, 1.5, 1.0], 4.0, 2.0).expect("a superquadric");
    let box_like = SuperquadricGrain::single(Frame::SCAN, body).expect("a grain");
    // Harmonics of degree 1 are proportional to y, z, x.
    let coefficients = [[0.1; 3], [0.0, 2.0, 0.0], [0.0, 0.0, 1.5], [3.0, 0.0, 0.0]];
    let position = Position::whole(coefficients.concat()).expect("three expansions");
    let position = PositionGrain::new(Frame::SCAN, position).expect("a grain");
    let n = Vector3::new(0.48, -0.6, 0.64);
    for length in [1e-200, 0.1, 3.0, 1e200] {
        let long = n * length;
        assert!((star.radius(&long) - star.radius(&n)).abs() < 1e-12);
        assert!((star.normal(&long) - star.normal(&n)).norm() < 1e-12);
        let grains = [&star as &dyn Surface, &position, &box_like];
        let wrapped: [Grain; 3] = [
            star.clone().into(),
            position.clone().into(),
            box_like.clone().into(),
        ];
        let wrapped = wrapped.each_ref().map(|grain| grain as &dyn Surface);
        for grain in grains.into_iter().chain(wrapped) {
            let (place, slopes) = grain.place_and_slopes(&n);
            let (long_place, long_slopes) = grain.place_and_slopes(&long);
            assert!((long_place - place).norm() < 1e-12 && (long_slopes - slopes).norm() < 1e-12);
            assert!((grain.place(&long) - place).norm() < 1e-12);
            assert!((grain.point(&long) - grain.point(&n)).norm() < 1e-12);
            assert!((grain.places(&[long])[0] - place).norm() < 1e-12);
            for jet in [grain.jet(&long), grain.jets(&[long])[0]] {
                assert!((jet.place - place).norm() < 1e-12);
                assert!((jet.bends[0] - grain.jet(&n).bends[0]).norm() < 1e-12);
            }
        }
    }
}

#[test]
fn one_segment_has_no_seam_and_several_have() {
    assert!(grain(4, 1).seam_jump() < 1e-12);
    assert!(grain(1, 4).seam_jump() > 1e-3);
}

#[test]
fn a_saved_grain_is_the_same_to_the_last_bit() {
    let grain = grain(3, 5);
    let loaded = from_json(&to_json(&grain)).expect("a model");
    assert_eq!(loaded.frame(), grain.frame());
    assert_eq!(loaded.segments(), 25);
    assert_eq!(loaded.coefficients(), grain.coefficients());
    assert_eq!(to_json(&loaded), to_json(&grain));
}

#[test]
fn unsound_models_are_refused() {
    let text = to_json(&grain(1, 2));
    assert!(from_json("{}").is_err());
    assert!(from_json("solid grain").is_err());
    assert!(from_json(&text.replace("\"version\": 9", "\"version\": 10")).is_err());
    assert!(from_json(&text.replace("grainform model", "other model")).is_err());
    assert!(from_json(&text.replace("\"parts_per_angle\": 2", "\"parts_per_angle\": 3")).is_err());
    let one = to_json(&grain(1, 1));
    let none = one.replace("\"parts_per_angle\": 1", "\"parts_per_angle\": 0");
    assert!(matches!(
        from_json(&none),
        Err(ModelError::Partition { found: 0 })
    ));
    assert!(
        from_json(&text.replace("\"parts_per_angle\": 2", "\"parts_per_angle\": 4000000000"))
            .is_err()
    );
    assert!(from_json(&text.replace("\"centre\"", "\"center\"")).is_err());
    let first = text.find("\"segments\"").expect("segments are named");
    let digit = first
        + text[first..]
            .find(|c: char| c.is_ascii_digit())
            .expect("numbers");
    for broken in ["1e999", "null", "\"NaN\""] {
        let end = digit + text[digit..].find([',', '\n']).expect("a separator");
        let start = text[..digit].rfind([' ', '\n']).expect("a separator") + 1;
        let mutilated = format!("{}{broken}{}", &text[..start], &text[end..]);
        assert!(from_json(&mutilated).is_err(), "{broken}");
    }
    let halved = &text[..text.len() / 2];
    assert!(from_json(halved).is_err());
}

#[test]
fn published_coefficients_give_back_the_radius_to_the_stated_loss() {
    for (degree, parts, bound) in [(5, 1, 1e-12), (3, 4, 1e-9), (3, 10, 1e-5)] {
        let grain = grain(degree, parts);
        for segment in grain.published() {
            let Region::Rectangle(rectangle) = segment.region else {
                panic!("a segment of the angle domain");
            };
            assert!(segment.loss < bound, "k = {parts}: {}", segment.loss);
            for i in 0..16 {
                let local =
                    rectangle.direction((i / 4) as f64 / 4.0 + 0.1, (i % 4) as f64 / 4.0 + 0.1);
                let sum: f64 = harmonics(degree, &local)
                    .iter()
                    .zip(&segment.coefficients)
                    .map(|(y, a)| y * a)
                    .sum();
                let radius = grain.radius(&(grain.frame().axes * local));
                assert!((sum - radius).abs() <= 2.0 * segment.loss + 1e-13);
            }
        }
    }
}
