//! The picture of a grain: its scan and its surface, and in three views how far the scan is off.

mod range;
mod views;

use crate::annotate::{Annotated, ScanDeviation};
use crate::model::{Grain, Surface};
use crate::picture::{
    Anchor, Camera, Colour, Dot, GROUND, INK, Image, Line, Scene, Size, diverging, render,
    sequential,
};
use crate::scan::Scan;
use nalgebra::{Point3, Vector3};
use range::Range;
use views::Views;

/// Cells along an edge of the cube of directions of the surface that is drawn.
const RESOLUTION: usize = 96;

/// Width and height of a view, and what is left above and below for labels.
const VIEW: [usize; 2] = [380, 400];
const ABOVE: usize = 64;
const BELOW: usize = 64;

/// Width of what is right of the views: the bar of colours and its numbers.
const BAR: usize = 190;

/// The most points of a scan that are drawn: then every second, every third, and so on.
const MOST_DOTS: usize = 8000;

/// What a surface has where no number colours it.
const PLAIN: Colour = [232, 205, 150];

/// What stands above and beside a picture.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Caption {
    /// What is shown, on one line.
    pub title: String,
    /// The unit of lengths, or empty where it is not known.
    pub unit: String,
}

/// Draws a grain: plain with the points of the scan, and three views of the surface in colours with the borders of its
/// segments, from above (along the least extent), from the side, and from aside. All to one scale.
///
/// Colours tell the signed distance of the scan from the surface, or without a scan the mean curvature. The range of
/// the colours holds all but one in a hundred.
pub(crate) fn portrait(grain: &Grain, scan: Option<&Scan>, caption: &Caption) -> Image {
    let surface = Annotated::new(grain, RESOLUTION);
    let surface = match scan {
        Some(scan) => surface.with_deviation(&ScanDeviation::new(grain, scan)),
        None => surface,
    };
    let colouring = Colouring::new(&surface);
    let views = Views::new(&surface.mesh, VIEW);
    let width = VIEW[0] * 4 + BAR;
    let mut image = Image::new([width, ABOVE + VIEW[1] + BELOW], GROUND);
    image.label(&caption.title, [24, 26], Anchor::Left, Size::Large, INK);

    let plain = vec![PLAIN; surface.mesh.vertices.len()];
    let mut scene = Scene::default();
    scene.add_mesh(&surface.mesh, &surface.normals, &plain);
    scene.dots = scan.map_or_else(Vec::new, dots);
    let mut lay = |scene: &Scene, camera: &Camera, at: usize, label: &str| {
        let view = render(scene, camera, VIEW);
        image.lay(&view, [at * VIEW[0], ABOVE]);
        let below = [at * VIEW[0] + VIEW[0] / 2, ABOVE + VIEW[1] + 14];
        image.label(label, below, Anchor::Middle, Size::Small, INK);
    };
    let points = match scan {
        Some(_) => "scan and surface",
        None => "surface",
    };
    lay(&scene, &views.aside, 0, points);

    let mut scene = Scene::default();
    scene.add_mesh(&surface.mesh, &surface.normals, &colouring.colours);
    scene.lines = outlines(grain);
    lay(&scene, &views.aside, 1, "from aside");
    lay(&scene, &views.above, 2, "from above");
    lay(&scene, &views.side, 3, "from the side");

    let left = 4 * VIEW[0] + 16;
    colouring.draw_bar(&mut image, left, &caption.unit);
    draw_scale(&mut image, &views, &caption.unit);
    image
}

/// The colours of the vertices of a surface, as in its portrait: by how far the scan is off where that is known, else by
/// mean curvature.
pub(crate) fn colours(surface: &Annotated) -> Vec<Colour> {
    Colouring::new(surface).colours
}

fn dots(scan: &Scan) -> Vec<Dot> {
    let stride = scan.points().len().div_ceil(MOST_DOTS).max(1);
    let points = scan.points().iter().step_by(stride);
    let dot = |place: &Point3<f64>| Dot {
        place: *place,
        colour: [40, 60, 110],
        width: 1.7,
    };
    points.map(dot).collect()
}

fn outlines(grain: &Grain) -> Vec<Line> {
    let line = |border: &Vec<Vector3<f64>>| Line {
        places: border.iter().map(|n| grain.point(n)).collect(),
        colour: [60; 3],
        width: 1.0,
    };
    grain.segment_borders().iter().map(line).collect()
}

/// A length of one, two or five times a power of ten, drawn below the first view.
fn draw_scale(image: &mut Image, views: &Views, unit: &str) {
    let length = range::round_down(0.4 * VIEW[0] as f64 / views.scale);
    let pixels = (length * views.scale).round() as usize;
    let [left, top] = [24, ABOVE + VIEW[1] + 40];
    image.fill([left, top], [pixels, 3], INK);
    for end in [left, left + pixels - 1] {
        image.fill([end, top - 4], [1, 11], INK);
    }
    let unit = if unit.is_empty() {
        "units of the scan"
    } else {
        unit
    };
    let label = format!("{} {unit}", range::label(length));
    image.label(
        &label,
        [left + pixels + 12, top + 1],
        Anchor::Left,
        Size::Small,
        INK,
    );
}

/// The colours of a surface and what they mean.
struct Colouring {
    range: Range,
    colours: Vec<Colour>,
    title: &'static str,
    /// Whether it is one over a length.
    is_curvature: bool,
}

impl Colouring {
    fn new(surface: &Annotated) -> Self {
        let (values, title, is_curvature) = match surface.field("deviation") {
            Some(values) => (values, "scan - surface", false),
            None => (
                surface.field("mean_curvature").unwrap_or_default(),
                "mean curvature",
                true,
            ),
        };
        let range = match is_curvature {
            true => Range::of(values),
            false => Range::signed(values),
        };
        let mut colouring = Self {
            range,
            colours: Vec::new(),
            title,
            is_curvature,
        };
        colouring.colours = values
            .iter()
            .map(|value| colouring.colour(*value))
            .collect();
        colouring
    }

    fn colour(&self, value: f64) -> Colour {
        let share = self.range.share(value);
        match self.is_curvature {
            true => sequential(share),
            false => diverging(2.0 * share - 1.0),
        }
    }

    fn draw_bar(&self, image: &mut Image, left: usize, unit: &str) {
        let [top, height, width] = [ABOVE + 40, VIEW[1] - 80, 22];
        for row in 0..height {
            let share = 1.0 - (row as f64 + 0.5) / height as f64;
            let value = self.range.low + share * (self.range.high - self.range.low);
            image.fill([left, top + row], [width, 1], self.colour(value));
        }
        for mark in self.range.marks() {
            let row = ((1.0 - self.range.share(mark)) * height as f64).round() as usize;
            image.fill([left + width, top + row.min(height - 1)], [5, 1], INK);
            let label = match self.is_curvature || mark == 0.0 {
                true => range::label(mark),
                false => format!(
                    "{}{}",
                    if mark > 0.0 { "+" } else { "" },
                    range::label(mark)
                ),
            };
            image.label(
                &label,
                [left + width + 10, top + row],
                Anchor::Left,
                Size::Small,
                INK,
            );
        }
        let unit = match (unit, self.is_curvature) {
            ("", false) => "units of the scan".into(),
            ("", true) => "1/unit".into(),
            (unit, false) => unit.to_owned(),
            (unit, true) => format!("1/{unit}"),
        };
        image.label(self.title, [left, top - 24], Anchor::Left, Size::Small, INK);
        image.label(
            &unit,
            [left, top + height + 22],
            Anchor::Left,
            Size::Small,
            INK,
        );
    }
}
