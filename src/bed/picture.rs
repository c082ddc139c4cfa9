//! A picture of a bed.

use super::paint::painted;
use super::settings::Container;
use super::settle::Bed;
use crate::picture::{Camera, Image, Line, Scene, render};
use nalgebra::{Point3, Vector3};
use std::f64::consts::TAU;

/// Width and height, in pixels.
const SIZE: [usize; 2] = [1200, 900];

/// Share of the picture that is left free.
const MARGIN: f64 = 0.04;

/// Cells along each edge of a cube of directions, of each part of a grain: the fewest and the most, ...
const CELLS: [f64; 2] = [4.0, 10.0];

/// ... and so many that all parts have about this number of triangles.
const TRIANGLES: f64 = 2e6;

/// Where the eye is, seen from the bed.
const EYE: [f64; 3] = [0.55, -1.0, 0.6];

/// Segments of the rim of a cylinder.
const RIM: usize = 96;

/// The outline of the container.
const OUTLINE: [u8; 3] = [120, 120, 120];

/// The grains of a bed in their container, seen aslant from above, without perspective.
pub(crate) fn picture(bed: &Bed) -> Image {
    let mut scene = Scene::default();
    for grain in painted(bed, cells(bed)) {
        let colours = vec![grain.colour; grain.mesh.vertices.len()];
        scene.add_mesh(&grain.mesh, &grain.mesh.normals(), &colours);
    }
    let top = scene
        .corners
        .iter()
        .fold(0.0, |top: f64, corner| top.max(corner.place.z));
    let outline = outline(bed.settings().container, top);
    scene.lines.extend(outline.into_iter().map(|places| Line {
        places,
        colour: OUTLINE,
        width: 1.5,
    }));
    render(&scene, &camera(&scene), SIZE)
}

fn cells(bed: &Bed) -> usize {
    let bodies = bed.bodies().iter();
    let parts: usize = bodies.map(|body| bed.kinds()[body.kind].parts.len()).sum();
    let [fewest, most] = CELLS;
    (TRIANGLES / (12.0 * parts as f64))
        .sqrt()
        .clamp(fewest, most) as usize
}

/// The edges of the container from the floor to a height: its floor, its walls, and how high grains lie.
fn outline(container: Container, top: f64) -> Vec<Vec<Point3<f64>>> {
    let rim: Vec<[f64; 2]> = match container {
        Container::Box([x, y]) => vec![[0.0, 0.0], [x, 0.0], [x, y], [0.0, y], [0.0, 0.0]],
        Container::Cylinder(radius) => (0..=RIM)
            .map(|i| (TAU * i as f64 / RIM as f64).sin_cos())
            .map(|(sin, cos)| [radius * cos, radius * sin])
            .collect(),
    };
    let at = |height: f64| {
        rim.iter()
            .map(|[x, y]| Point3::new(*x, *y, height))
            .collect()
    };
    let mut lines: Vec<Vec<Point3<f64>>> = vec![at(0.0), at(top)];
    if let Container::Box(_) = container {
        let wall = |[x, y]: [f64; 2]| vec![Point3::new(x, y, 0.0), Point3::new(x, y, top)];
        lines.extend(rim[1..].iter().map(|corner| wall(*corner)));
    }
    lines
}

/// A camera that shows all of a scene.
fn camera(scene: &Scene) -> Camera {
    let unscaled = Camera::new(Point3::origin(), EYE.into(), Vector3::z(), 1.0);
    let corners = scene.corners.iter().map(|corner| &corner.place);
    let lines = scene.lines.iter().flat_map(|line| &line.places);
    let ends = [Vector3::repeat(f64::MAX), Vector3::repeat(f64::MIN)];
    let [low, high] = corners.chain(lines).fold(ends, |[low, high], place| {
        let seen = unscaled.seen(place);
        [low.inf(&seen), high.sup(&seen)]
    });
    let extent = high - low;
    let fits = |axis: usize| (1.0 - 2.0 * MARGIN) * SIZE[axis] as f64 / extent[axis];
    Camera {
        target: unscaled.axes.tr_mul(&((low + high) / 2.0)).into(),
        scale: fits(0).min(fits(1)),
        ..unscaled
    }
}
