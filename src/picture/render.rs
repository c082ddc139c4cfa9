//! From a scene to pixels.

use super::raster::{Band, Light};
use super::{Camera, Colour, Corner, GROUND, Image, Scene};
use nalgebra::Vector3;
use rayon::prelude::*;

/// Each pixel is the mean of so many times so many.
const FINENESS: usize = 3;

/// Rows of a band, before the mean is taken. Bands are drawn at the same time.
const BAND: usize = 48;

/// Points and lines lie on surfaces: they are drawn so many pixels nearer, by which a surface that bends does not hide
/// them.
const NEARER: f64 = 3.0;

/// Directions that light comes from, seen from the eye (right, up, near), and how much of it.
const LAMPS: [([f64; 3], f64); 2] = [([-0.45, 0.65, 0.61], 0.62), ([0.75, 0.1, 0.65], 0.16)];

/// Light from everywhere.
const AMBIENT: f64 = 0.30;

/// The largest width and height of a picture.
const MOST_PIXELS: usize = 10_000;

/// Draws a scene in so many pixels, width and height; at most 10 000 of each.
pub(crate) fn render(scene: &Scene, camera: &Camera, [width, height]: [usize; 2]) -> Image {
    let [width, height] = [width, height].map(|pixels| pixels.clamp(1, MOST_PIXELS));
    let fine = [width, height].map(|pixels| pixels * FINENESS);
    let seen = Seen::new(scene, camera, fine);
    let mut light = vec![linear(GROUND); fine[0] * fine[1]];
    let mut depth = vec![f32::NEG_INFINITY; light.len()];
    let bands = light.par_chunks_mut(BAND * fine[0]);
    let bands = bands.zip(depth.par_chunks_mut(BAND * fine[0])).enumerate();
    bands.for_each(|(number, (light, depth))| {
        let mut band = Band {
            width: fine[0],
            first: number * BAND,
            light,
            depth,
        };
        seen.draw(number, &mut band);
    });
    Image::from_fn([width, height], |x, y| {
        let mut sum = [0.0; 3];
        for row in FINENESS * y..FINENESS * (y + 1) {
            for at in FINENESS * x..FINENESS * (x + 1) {
                let part = light[row * fine[0] + at];
                sum = [0, 1, 2].map(|i| sum[i] + part[i]);
            }
        }
        coded(sum.map(|part| part / (FINENESS * FINENESS) as f32))
    })
}

/// A scene in fine pixels.
struct Seen<'a> {
    scene: &'a Scene,
    /// Right, down, towards the eye.
    places: Vec<Vector3<f64>>,
    lit: Vec<Light>,
    /// The triangles that reach into each band.
    triangles: Vec<Vec<[u32; 3]>>,
    dots: Vec<Vector3<f64>>,
    lines: Vec<Vec<Vector3<f64>>>,
}

impl<'a> Seen<'a> {
    fn new(scene: &'a Scene, camera: &Camera, [width, height]: [usize; 2]) -> Self {
        let fineness = FINENESS as f64;
        let place = |place, nearer: f64| {
            let seen = camera.seen(place) * fineness;
            Vector3::new(
                0.5 * width as f64 + seen.x,
                0.5 * height as f64 - seen.y,
                seen.z + nearer * fineness,
            )
        };
        let corners = scene.corners.par_iter();
        let places: Vec<_> = corners.map(|corner| place(&corner.place, 0.0)).collect();
        Self {
            scene,
            triangles: in_bands(&scene.triangles, &places, height.div_ceil(BAND)),
            places,
            lit: scene
                .corners
                .par_iter()
                .map(|corner| lit(corner, camera))
                .collect(),
            dots: scene
                .dots
                .iter()
                .map(|dot| place(&dot.place, NEARER))
                .collect(),
            lines: scene
                .lines
                .iter()
                .map(|line| line.places.iter().map(|end| place(end, NEARER)).collect())
                .collect(),
        }
    }

    fn draw(&self, number: usize, band: &mut Band) {
        for corners in &self.triangles[number] {
            let [a, b, c] = corners.map(|corner| self.lit[corner as usize]);
            let places = corners.map(|corner| self.places[corner as usize]);
            band.triangle(places, |s, t| {
                let (s, t) = (s as f32, t as f32);
                [0, 1, 2].map(|i| a[i] + s * (b[i] - a[i]) + t * (c[i] - a[i]))
            });
        }
        for (line, ends) in self.scene.lines.iter().zip(&self.lines) {
            for pair in ends.windows(2) {
                band.stroke(
                    [pair[0], pair[1]],
                    FINENESS as f64 * line.width,
                    linear(line.colour),
                );
            }
        }
        for (dot, place) in self.scene.dots.iter().zip(&self.dots) {
            band.stroke([*place; 2], FINENESS as f64 * dot.width, linear(dot.colour));
        }
    }
}

/// The triangles that reach into each of some bands.
fn in_bands(triangles: &[[u32; 3]], places: &[Vector3<f64>], bands: usize) -> Vec<Vec<[u32; 3]>> {
    let mut found = vec![Vec::new(); bands];
    for corners in triangles {
        let rows = corners.map(|corner| places[corner as usize].y);
        let low = rows.into_iter().fold(f64::INFINITY, f64::min).max(0.0);
        let high = rows.into_iter().fold(f64::NEG_INFINITY, f64::max);
        if high >= 0.0 {
            let last = ((high / BAND as f64) as usize).saturating_add(1).min(bands);
            let first = ((low / BAND as f64) as usize).min(last);
            for band in &mut found[first..last] {
                band.push(*corners);
            }
        }
    }
    found
}

/// A corner in the light; one that is turned away is lit as its other side.
fn lit(corner: &Corner, camera: &Camera) -> Light {
    let normal = camera.axes * corner.normal;
    let normal = normal * normal.z.signum();
    let lamps = LAMPS
        .iter()
        .map(|(from, strength)| strength * normal.dot(&Vector3::from(*from).normalize()).max(0.0));
    let strength = (AMBIENT + lamps.sum::<f64>()) as f32;
    linear(corner.colour).map(|part| part * strength)
}

/// sRGB as linear light.
fn linear(colour: Colour) -> Light {
    colour.map(|part| {
        let part = f32::from(part) / 255.0;
        match part <= 0.04045 {
            true => part / 12.92,
            false => ((part + 0.055) / 1.055).powf(2.4),
        }
    })
}

/// Linear light as sRGB.
fn coded(light: Light) -> Colour {
    light.map(|part| {
        let part = part.clamp(0.0, 1.0);
        let coded = match part <= 0.003_130_8 {
            true => 12.92 * part,
            false => 1.055 * part.powf(1.0 / 2.4) - 0.055,
        };
        (255.0 * coded).round() as u8
    })
}

#[cfg(test)]
mod tests {
    use super::super::{Dot, Line};
    use super::*;
    use crate::mesh::Mesh;
    use nalgebra::Point3;

    fn camera() -> Camera {
        Camera::new(Point3::origin(), Vector3::z(), Vector3::y(), 10.0)
    }

    /// A ball of radius 1 of one colour, which fills a circle of ten pixels in the middle of 40.
    fn ball() -> Scene {
        let mesh = Mesh::radial(16, |_| 1.0);
        let normals: Vec<_> = mesh.vertices.iter().map(|vertex| vertex.coords).collect();
        let mut scene = Scene::default();
        scene.add_mesh(&mesh, &normals, &vec![[200, 100, 50]; normals.len()]);
        scene
    }

    #[test]
    fn a_ball_is_a_disk_lit_from_above_and_left() {
        let image = render(&ball(), &camera(), [40, 40]);
        let is_ground = |x: usize, y: usize| image.pixel(x, y) == GROUND;
        let covered = (0..40 * 40).filter(|i| !is_ground(i % 40, i / 40)).count();
        let edge = 2.0 * 10.0 * std::f64::consts::PI;
        assert!(
            (covered as f64 - 100.0 * std::f64::consts::PI).abs() < edge,
            "{covered}"
        );
        let brightness = |x, y| {
            image
                .pixel(x, y)
                .iter()
                .map(|part| u32::from(*part))
                .sum::<u32>()
        };
        assert!(brightness(15, 14) > brightness(24, 26));
        assert!(brightness(15, 14) > brightness(15, 25));
    }

    #[test]
    fn what_is_near_hides_what_is_far() {
        let mut scene = ball();
        let dot = |z: f64| Dot {
            place: Point3::new(0.0, 0.0, z),
            colour: [0, 0, 255],
            width: 4.0,
        };
        scene.dots.push(dot(-2.0));
        let hidden = render(&scene, &camera(), [40, 40]);
        assert_ne!(hidden.pixel(20, 20), [0, 0, 255]);
        scene.dots.push(dot(1.0));
        let shown = render(&scene, &camera(), [40, 40]);
        assert_eq!(shown.pixel(20, 20), [0, 0, 255]);
    }

    #[test]
    fn what_leaves_the_picture_or_is_not_finite_is_left_out() {
        let line = |x: f64| Line {
            places: vec![Point3::new(-x, 0.0, 0.0), Point3::new(x, 0.0, 0.0)],
            colour: [255, 0, 0],
            width: 2.0,
        };
        let scene = Scene {
            lines: vec![line(1e3), line(f64::NAN)],
            ..Scene::default()
        };
        let image = render(&scene, &camera(), [40, 30]);
        assert_eq!(image.pixel(0, 15), [255, 0, 0]);
        assert_eq!(image.pixel(0, 2), [255; 3]);
    }
}
