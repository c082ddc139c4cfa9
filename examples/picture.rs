//! Draws the picture of the README: a scan, and beside it the surface fitted to it.
//!
//! `cargo run --release --example picture > docs/maize.svg`

use grainform::scan::read_scan;
use grainform::{FitOptions, Surface, fit};
use nalgebra::{Point3, Rotation3, Vector3};
use std::fmt::Write;

/// Cells per edge of the drawn mesh.
const RESOLUTION: usize = 18;

/// Pixels per millimetre.
const SCALE: f64 = 28.0;

/// Shades from dark to light.
const SHADES: usize = 24;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let scan = read_scan("grains/maize.ply".as_ref())?;
    let fitted = fit(&scan, &FitOptions::default())?;
    let grain = fitted.grain.star().ok_or("a model without a radius")?;
    let centre = grain.frame().centre;
    let normal = |point: &Point3<f64>| grain.normal(&(point - centre).normalize());

    let mut svg = head()?;
    let left = View::new(centre, [205.0, 145.0]);
    let mut dots = vec![String::new(); SHADES];
    for point in scan.points() {
        if let Some(shade) = left.shade(&normal(point)) {
            write!(dots[shade], "M{}h0", left.place(point))?;
        }
    }
    for (shade, places) in dots.iter().enumerate() {
        writeln!(svg, "<path class=\"d s{shade}\" d=\"{places}\"/>")?;
    }

    let right = View::new(centre, [595.0, 145.0]);
    let mesh = grain.mesh(RESOLUTION);
    let corners = |triangle: &[u32; 3]| triangle.map(|corner| mesh.vertices[corner as usize]);
    let mut facets: Vec<_> = mesh.triangles.iter().map(corners).collect();
    let depth = |facet: &[Point3<f64>; 3]| -> f64 { facet.iter().map(|p| right.depth(p)).sum() };
    facets.sort_by(|a, b| depth(a).total_cmp(&depth(b)));
    for facet in &facets {
        let [a, b, c] = facet;
        let middle = Point3::from((a.coords + b.coords + c.coords) / 3.0);
        if let Some(shade) = right.shade(&normal(&middle)) {
            let [a, b, c] = facet.map(|point| right.place(&point));
            writeln!(svg, "<path class=\"s{shade}\" d=\"M{a}L{b} {c}z\"/>")?;
        }
    }
    let choice = fitted.search.choice();
    writeln!(
        svg,
        "<text x=\"205\" y=\"310\">{} points</text>\n\
         <text x=\"595\" y=\"310\">degree {}, {} segments, {} coefficients</text>\n</svg>",
        fitted.points, choice.degree, choice.segments, choice.coefficients
    )?;
    print!("{svg}");
    Ok(())
}

/// The frame of the picture and its colours.
fn head() -> Result<String, std::fmt::Error> {
    let mut svg = String::from(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 800 330\" \
         font-family=\"sans-serif\" font-size=\"15\" text-anchor=\"middle\">\n<style>\n\
         text{fill:#555}path{stroke-width:.6;stroke-linejoin:round}\
         .d{stroke-width:2.4;stroke-linecap:round}\n",
    );
    for shade in 0..SHADES {
        let bright = 0.4 + 0.6 * shade as f64 / (SHADES - 1) as f64;
        let [r, g, b] = [240.0, 192.0, 88.0].map(|colour: f64| (colour * bright) as u8);
        let colour = format!("#{r:02x}{g:02x}{b:02x}");
        writeln!(svg, ".s{shade}{{fill:{colour};stroke:{colour}}}")?;
    }
    svg.push_str("</style>\n<rect width=\"800\" height=\"330\" fill=\"#fff\"/>\n");
    Ok(svg)
}

/// A look at the grain from above and aside.
struct View {
    turn: Rotation3<f64>,
    centre: Point3<f64>,
    place: [f64; 2],
}

impl View {
    fn new(centre: Point3<f64>, place: [f64; 2]) -> Self {
        Self {
            turn: Rotation3::from_euler_angles(-0.75, 0.35, 0.15),
            centre,
            place,
        }
    }

    /// Where a point is drawn.
    fn place(&self, point: &Point3<f64>) -> String {
        let seen = self.turn * (point - self.centre);
        let (x, y) = (
            self.place[0] + SCALE * seen.x,
            self.place[1] - SCALE * seen.y,
        );
        format!("{x:.1} {y:.1}")
    }

    /// Towards the eye.
    fn depth(&self, point: &Point3<f64>) -> f64 {
        (self.turn * (point - self.centre)).z
    }

    /// The shade of a surface with this normal, if it can be seen.
    fn shade(&self, normal: &Vector3<f64>) -> Option<usize> {
        let seen = self.turn * normal;
        let light = Vector3::new(-0.45, 0.6, 0.66).normalize();
        let bright = 0.5 + 0.5 * seen.dot(&light);
        (seen.z > 0.0).then_some((bright * (SHADES - 1) as f64).round() as usize)
    }
}
