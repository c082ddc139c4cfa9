//! A surface as many small vector areas, for integrals over it and over the directions from a point
//! within.

use crate::Mesh;
use crate::model::{Node, Surface};
use nalgebra::{Point3, Vector3};

/// Triangles of a mesh from which on each has one node.
const NODES: usize = 40_000;

/// Longest side of a part of a triangle, over its distance: of a ball they have some 25 000 nodes.
const LARGEST: f64 = 0.08;

/// A triangle of which one side looks smaller than this is a strip: cut into triangles it would have a thousand parts.
const STRIP: f64 = 0.01;

/// A triangle is cut in two so often at most: one that the origin lies on looks large however small it is.
const MOST_CUTS: usize = 24;

/// A node of a quadrature over a surface.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Element {
    /// Where it lies, from the point that was asked for.
    pub(crate) place: Vector3<f64>,
    /// Its area along its outward normal.
    pub(crate) area: Vector3<f64>,
}

impl Element {
    /// The direction in which it is seen, its distance, and the solid angle it fills: negative where
    /// the surface faces the observer.
    pub(crate) fn seen(&self) -> (Vector3<f64>, f64, f64) {
        let distance = self.place.norm();
        let direction = self.place / distance;
        let solid_angle = direction.dot(&self.area) / (distance * distance);
        (direction, distance, solid_angle)
    }
}

/// The elements of a surface, seen from a point `shift` before its centre, at the nodes of a quadrature over its
/// tiling.
pub(crate) fn surface_elements(
    surface: &(impl Surface + ?Sized),
    nodes: &[Node],
    shift: &Vector3<f64>,
) -> Vec<Element> {
    let axes = surface.frame().axes;
    let elements = surface.elements(nodes).into_iter();
    elements
        .map(|element| Element {
            place: axes * element.place + shift,
            area: axes * element.area,
        })
        .collect()
}

/// The elements of a mesh, seen from a point: three Gauss nodes, exact to degree two, on each of its triangles or of the
/// parts that it is cut into until none looks larger than [`LARGEST`]; of a mesh of very many triangles, one node.
pub(crate) fn mesh_elements(mesh: &Mesh, from: &Point3<f64>) -> Vec<Element> {
    let of_node = match mesh.triangles.len() > NODES {
        true => &[[1.0, 1.0, 1.0]][..],
        false => &[[4.0, 1.0, 1.0], [1.0, 4.0, 1.0], [1.0, 1.0, 4.0]],
    };
    let mut elements = Vec::new();
    for corners in &mesh.triangles {
        let corners = corners.map(|i| mesh.vertices[i as usize] - from);
        if let Some(strip) = Strip::new(&corners) {
            strip.cut([0.0, 1.0], MOST_CUTS, &mut elements);
            continue;
        }
        cut(corners, MOST_CUTS, &mut |[a, b, c]| {
            let area = (b - a).cross(&(c - a)) / (2.0 * of_node.len() as f64);
            elements.extend(of_node.iter().map(|[s, t, u]| Element {
                place: (a * *s + b * *t + c * *u) / (s + t + u),
                area,
            }));
        });
    }
    elements
}

/// How near the nearest of these places is to the origin.
fn nearest(places: impl IntoIterator<Item = Vector3<f64>>) -> f64 {
    let distances = places.into_iter().map(|place| place.norm());
    distances.fold(f64::INFINITY, f64::min)
}

/// A long triangle as its middle line, from the tip between its long sides to the middle of the short one.
struct Strip {
    tip: Vector3<f64>,
    along: Vector3<f64>,
    area: Vector3<f64>,
}

impl Strip {
    /// `None` of a triangle that is none, or is short.
    fn new(&[a, b, c]: &[Vector3<f64>; 3]) -> Option<Self> {
        let shortest = |one: [Vector3<f64>; 3], other: [Vector3<f64>; 3]| {
            let length = |[_, q, r]: &[Vector3<f64>; 3]| (r - q).norm();
            if length(&other) < length(&one) {
                other
            } else {
                one
            }
        };
        let [tip, q, r] = shortest(shortest([a, b, c], [b, c, a]), [c, a, b]);
        let along = (q + r) / 2.0 - tip;
        let nearest = nearest([tip, q, r, tip + along / 2.0]);
        let is_strip = (r - q).norm() < STRIP * nearest && along.norm() > LARGEST * nearest;
        is_strip.then(|| Self {
            tip,
            along,
            area: (q - tip).cross(&(r - tip)) / 2.0,
        })
    }

    fn at(&self, place: f64) -> Vector3<f64> {
        self.tip + self.along * place
    }

    /// Elements of the part between two places, 0 at the tip and 1 at the short side, at two Gauss nodes of each part that looks
    /// small from the origin, or that was cut so many times.
    fn cut(&self, [from, to]: [f64; 2], cuts: usize, elements: &mut Vec<Element>) {
        let [middle, half] = [(from + to) / 2.0, (to - from) / 2.0];
        let length = 2.0 * half * self.along.norm();
        let nearest = nearest([from, middle, to].map(|place| self.at(place)));
        if cuts > 0 && length > 2.0 * LARGEST * nearest {
            self.cut([from, middle], cuts - 1, elements);
            self.cut([middle, to], cuts - 1, elements);
            return;
        }
        elements.extend([-1.0, 1.0].map(|side| {
            let place = middle + side * half / f64::sqrt(3.0);
            Element {
                place: self.at(place),
                area: self.area * (2.0 * place * half),
            }
        }));
    }
}

/// Cuts a triangle across its longest side, so many times at most, until its parts look small from the origin.
fn cut([a, b, c]: [Vector3<f64>; 3], cuts: usize, part: &mut impl FnMut([Vector3<f64>; 3])) {
    let sides = [(a, b, c), (b, c, a), (c, a, b)].map(|(p, q, r)| ((q - p).norm(), [p, q, r]));
    let [first, second, third] = sides;
    let longer = |one: (f64, [Vector3<f64>; 3]), other: (f64, [Vector3<f64>; 3])| {
        if other.0 > one.0 { other } else { one }
    };
    let (longest, [p, q, r]) = longer(longer(first, second), third);
    if cuts == 0 || longest <= LARGEST * nearest([a, b, c, (a + b + c) / 3.0]) {
        return part([a, b, c]);
    }
    let middle = (p + q) / 2.0;
    cut([p, middle, r], cuts - 1, part);
    cut([middle, q, r], cuts - 1, part);
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::measure::mesh_properties;
    use crate::model::StarSurface;
    use crate::shapes::{Body, Cylinder};
    use approx::assert_relative_eq;
    use std::f64::consts::PI;

    /// Area, volume and solid angle.
    fn sums(elements: &[Element]) -> [f64; 3] {
        let figures = elements.iter().map(|e| {
            let volume = e.area.dot(&e.place) / 3.0;
            Vector3::new(e.area.norm(), volume, e.seen().2)
        });
        figures.sum::<Vector3<f64>>().into()
    }

    #[test]
    fn the_elements_of_a_mesh_have_its_area_and_volume_and_fill_the_sphere() {
        for resolution in [1, 8, 100] {
            let surface = Body::Bean.surface();
            let mesh = Mesh::radial(resolution, |n| surface.radius(n));
            let exact = mesh_properties(&mesh).unwrap();
            let elements = mesh_elements(&mesh, &exact.centroid);
            assert!(elements.len() > NODES / 4);
            let [area, volume, sphere] = sums(&elements);
            assert_relative_eq!(area, exact.area, max_relative = 1e-11);
            assert_relative_eq!(volume, exact.volume, max_relative = 1e-11);
            assert_relative_eq!(sphere, 4.0 * PI, max_relative = 1e-4);
        }
    }

    /// Of two cones on a circle, each a fan of so many triangles.
    #[test]
    fn fans_of_thin_triangles_have_few_elements() {
        let count = 2000;
        let mut vertices = vec![Point3::new(0.0, 0.0, 1.0), Point3::new(0.0, 0.0, -1.0)];
        let angles = (0..count).map(|i| 2.0 * PI * f64::from(i) / f64::from(count));
        vertices.extend(angles.map(|angle| Point3::new(angle.cos(), angle.sin(), 0.0)));
        let corner = |i: i32| 2 + (i % count) as u32;
        let fans =
            (0..count).flat_map(|i| [[0, corner(i), corner(i + 1)], [1, corner(i + 1), corner(i)]]);
        let mesh = Mesh {
            triangles: fans.collect(),
            vertices,
        };
        let exact = mesh_properties(&mesh).unwrap();
        // The mean distance of its surface from the middle.
        let mean_distance = 0.5 + 1_f64.asinh() / 8_f64.sqrt();
        for (from, distance) in [
            (Point3::origin(), Some(mean_distance)),
            (Point3::new(0.1, 0.05, -0.1), None),
        ] {
            let elements = mesh_elements(&mesh, &from);
            let parts = elements.len() / mesh.triangles.len();
            assert!(parts < 50, "{parts}");
            let [area, volume, sphere] = sums(&elements);
            assert_relative_eq!(area, exact.area, max_relative = 1e-11);
            assert_relative_eq!(volume, exact.volume, max_relative = 1e-11);
            assert_relative_eq!(sphere, 4.0 * PI, max_relative = 1e-5);
            let distances = elements.iter().map(|e| e.seen().1 * e.area.norm());
            let found = distances.sum::<f64>() / area;
            if let Some(distance) = distance {
                assert_relative_eq!(found, distance, max_relative = 1e-5);
            }
        }
    }

    #[test]
    fn a_thin_disc_fills_the_sphere_of_its_centre_once() {
        let cylinder = Cylinder {
            radius: 100.0,
            half_height: 1.0,
        };
        let disc = Mesh::radial(16, |n| cylinder.radius(n));
        let elements = mesh_elements(&disc, &Point3::new(0.5, 0.2, 0.1));
        assert!(elements.len() < 600_000, "{}", elements.len());
        assert!(elements.iter().all(|e| e.seen().2 > 0.0));
        let [_, _, sphere] = sums(&elements);
        assert_relative_eq!(sphere, 4.0 * PI, max_relative = 1e-4);
    }
}
