//! What a surface is fitted to: places of a mesh, or points near it, each with its direction on the sphere.

mod feet;

use super::on_mesh::OnMesh;
use super::on_sphere::{middles, spherical_area};
use super::voxels::Voxels;
use crate::fit::points::neighbours::Neighbours;
use crate::mesh::Mesh;
use nalgebra::Vector3;
use std::f64::consts::PI;

/// Most parts per edge in which a triangle is cut.
const MOST_PARTS: usize = 32;

/// Share of the weight that goes with solid angle on the sphere, the rest with area: where the map has left much of
/// the sphere to little surface, functions still need points.
const SPHERE_SHARE: f64 = 0.2;

/// One vertex in so many is held out, or one point.
pub(super) const HELD_OUT: usize = 8;

/// Share of the weight of the vertices of a mesh that is only near the points: enough that functions between points are
/// told, and not so much that its errors are.
const NEAR_SHARE: f64 = 0.0005;

/// Samples: the vertices of a mesh first, then places inside its large triangles, or the points that it is near.
pub(super) struct Cloud<'a> {
    mesh: &'a Mesh,
    /// Places of the vertices on the sphere from which fits start.
    map: Vec<Vector3<f64>>,
    pub(super) points: Vec<Vector3<f64>>,
    /// Unit normals of the scan, outward.
    pub(super) normals: Vec<Vector3<f64>>,
    pub(super) directions: Vec<Vector3<f64>>,
    /// They add up to 1.
    pub(super) weights: Vec<f64>,
    /// The others, by their places in triangles.
    inside: Vec<OnMesh>,
    /// Whether they are the points of the scan, and the vertices are none.
    pub(super) is_of_points: bool,
    /// Those between which the points are the middles.
    pub(super) voxels: Option<Voxels>,
    /// Of the ellipsoid of equal moments.
    pub(super) semi_axes: Vector3<f64>,
    /// Every so many of the vertices, in order of height, and the places in triangles that touch them; or of the points.
    pub(super) is_left_out: Vec<bool>,
}

/// How far a surface is from the samples.
#[derive(Debug, Clone, Copy)]
pub(super) struct Distances {
    /// Weighted by area and solid angle as the fit is.
    pub(super) rms: f64,
    pub(super) max: f64,
}

impl<'a> Cloud<'a> {
    /// The vertices of a closed mesh, with their places on the sphere.
    pub(super) fn new(mesh: &'a Mesh, map: Vec<Vector3<f64>>) -> Self {
        let points: Vec<_> = mesh.vertices.iter().map(|vertex| vertex.coords).collect();
        let mut cloud = Self {
            is_left_out: left_out(&points),
            points,
            normals: mesh.normals(),
            weights: Vec::new(),
            inside: Vec::new(),
            is_of_points: false,
            voxels: None,
            semi_axes: Vector3::repeat(1.0),
            mesh,
            directions: map.clone(),
            map,
        };
        cloud.weigh();
        cloud
    }

    /// Points that a closed mesh is near, the vertices of which have places on the sphere.
    pub(super) fn of_points(
        mesh: &'a Mesh,
        map: Vec<Vector3<f64>>,
        points: Vec<Vector3<f64>>,
    ) -> Self {
        let mut cloud = Self::new(mesh, map);
        cloud.is_of_points = true;
        cloud.inside = OnMesh::nearest(mesh, &points);
        let normals = cloud.inside.iter().map(|place| {
            let [a, b, c] =
                mesh.triangles[place.triangle].map(|corner| cloud.normals[corner as usize]);
            place
                .between([a, b, c])
                .try_normalize(0.0)
                .unwrap_or_default()
        });
        let normals: Vec<_> = normals.collect();
        cloud.normals.extend(normals);
        cloud.points.extend(points);
        cloud.restart_from_map();
        let vertices = cloud.vertices();
        let of_points = left_out(&cloud.points[vertices..]);
        cloud.is_left_out = vec![false; vertices];
        cloud.is_left_out.extend(of_points);
        cloud.weigh();
        cloud
    }

    /// Starts anew from the map, with the same samples.
    fn restart_from_map(&mut self) {
        self.directions.clone_from(&self.map);
        for place in &self.inside {
            let between = place.between(self.images(place.triangle));
            self.directions.push(between.normalize());
        }
    }

    /// The scan's faces, or those near its points.
    pub(super) fn mesh(&self) -> &Mesh {
        self.mesh
    }

    /// Whether a sample is one of the scan: not if the mesh is only near it.
    pub(super) fn is_scanned(&self, sample: usize) -> bool {
        !self.is_of_points || sample >= self.vertices()
    }

    /// The number of samples of the scan, places inside large triangles included.
    pub(super) fn scanned(&self) -> usize {
        let all = self.points.len();
        if self.is_of_points {
            all - self.vertices()
        } else {
            all
        }
    }

    /// The number of points of the scan.
    pub(super) fn scan_points(&self) -> usize {
        if self.is_of_points {
            self.scanned()
        } else {
            self.vertices()
        }
    }

    /// Whether a sample judges fits that do without it: a point of the scan, which places in triangles are not.
    pub(super) fn is_held_out(&self, sample: usize) -> bool {
        self.is_left_out[sample] && self.is_point(sample)
    }

    /// Whether a sample is a point of the scan, which places in triangles are not.
    pub(super) fn is_point(&self, sample: usize) -> bool {
        self.is_of_points == (sample >= self.vertices())
    }

    /// The points of the scan that a sample is made of, and their shares in it.
    pub(super) fn points_of(&self, sample: usize) -> [(usize, f64); 3] {
        match sample.checked_sub(self.vertices()) {
            Some(inside) if !self.is_of_points => {
                let OnMesh {
                    triangle,
                    barycentric,
                } = self.inside[inside];
                let corners = self.mesh.triangles[triangle];
                std::array::from_fn(|i| (corners[i] as usize, barycentric[i]))
            }
            _ => [(sample, 1.0), (sample, 0.0), (sample, 0.0)],
        }
    }

    /// Area of the mesh.
    pub(super) fn area(&self) -> f64 {
        self.doubled_areas().iter().sum::<f64>() / 2.0
    }

    /// Of points that the mesh is near, the area of the triangles that are nearest to each.
    pub(super) fn areas_of_points(&self) -> Option<Vec<f64>> {
        let (vertices, points) = self.points.split_at(self.vertices());
        let near = self.is_of_points.then(|| Neighbours::new(points))?;
        let mut areas = vec![0.0; self.points.len()];
        for (corners, doubled) in self.mesh.triangles.iter().zip(self.doubled_areas()) {
            let corners = corners.map(|corner| vertices[corner as usize]);
            let middle = corners.iter().sum::<Vector3<f64>>() / 3.0;
            for point in near.nearest(&middle, 1) {
                areas[vertices.len() + point] += doubled / 2.0;
            }
        }
        Some(areas)
    }

    fn doubled_areas(&self) -> Vec<f64> {
        let triangles = self.mesh.triangles.iter();
        triangles
            .map(|corners| {
                let [a, b, c] = corners.map(|corner| self.mesh.vertices[corner as usize]);
                (b - a).cross(&(c - a)).norm()
            })
            .collect()
    }

    /// The number of vertices, the first of the samples.
    pub(super) fn vertices(&self) -> usize {
        self.mesh.vertices.len()
    }

    /// Where the vertices are on the sphere.
    pub(super) fn vertex_directions(&self) -> &[Vector3<f64>] {
        &self.directions[..self.vertices()]
    }

    fn images(&self, triangle: usize) -> [Vector3<f64>; 3] {
        self.mesh.triangles[triangle].map(|corner| self.directions[corner as usize])
    }

    /// Starts anew from the map: of faces the vertices, and places inside triangles that are large on the sphere, until there is
    /// one per `solid_angle`.
    pub(super) fn restart(&mut self, solid_angle: impl Fn(&Vector3<f64>) -> f64) {
        if self.is_of_points {
            self.restart_from_map();
            return;
        }
        let vertices = self.vertices();
        self.inside.clear();
        self.points.truncate(vertices);
        self.normals.truncate(vertices);
        self.directions.clone_from(&self.map);
        for triangle in 0..self.mesh.triangles.len() {
            let [a, b, c] = self.images(triangle);
            let middle = (a + b + c).normalize();
            let parts = (spherical_area([a, b, c]) / solid_angle(&middle))
                .sqrt()
                .ceil();
            let parts = (parts as usize).min(MOST_PARTS);
            if parts < 2 {
                continue;
            }
            let corners = self.mesh.triangles[triangle];
            let [p, q, r] = corners.map(|corner| self.mesh.vertices[corner as usize].coords);
            let Some(normal) = (q - p).cross(&(r - p)).try_normalize(0.0) else {
                continue;
            };
            for barycentric in middles(parts) {
                let [s, t, u] = barycentric;
                self.points.push(p * s + q * t + r * u);
                self.normals.push(normal);
                self.directions.push((a * s + b * t + c * u).normalize());
                self.inside.push(OnMesh {
                    triangle,
                    barycentric,
                });
            }
        }
        self.is_left_out.truncate(vertices);
        for place in &self.inside {
            let corners = self.mesh.triangles[place.triangle];
            let touches = corners
                .iter()
                .any(|corner| self.is_left_out[*corner as usize]);
            self.is_left_out.push(touches);
        }
        self.weigh();
    }

    /// Takes the directions to be those in which the samples would lie on the ellipsoid of equal moments.
    pub(super) fn start_on_ellipsoid(&mut self) {
        for (n, point) in self.directions.iter_mut().zip(&self.points) {
            let on_sphere = point.component_div(&self.semi_axes);
            *n = on_sphere.try_normalize(0.0).unwrap_or(*n);
        }
    }

    /// Weights by area and by solid angle: of a triangle with places inside half a place goes to its corners.
    fn weigh(&mut self) {
        let mut inside = vec![0_usize; self.mesh.triangles.len()];
        for place in self.inside.iter().filter(|_| !self.is_of_points) {
            inside[place.triangle] += 1;
        }
        let areas = self.doubled_areas();
        let area: f64 = areas.iter().sum();
        let share = |triangle: usize| {
            let solid_angle = spherical_area(self.images(triangle)) / (4.0 * PI);
            (1.0 - SPHERE_SHARE) * areas[triangle] / area + SPHERE_SHARE * solid_angle
        };
        let mut weights = vec![0.0; self.points.len()];
        for (triangle, corners) in self.mesh.triangles.iter().enumerate() {
            let at_corners = match inside[triangle] {
                0 => 1.0,
                count => 0.5 / (count as f64 + 0.5),
            };
            for &corner in corners {
                weights[corner as usize] += share(triangle) * at_corners / 3.0;
            }
        }
        let (at_vertices, others) = weights.split_at_mut(self.mesh.vertices.len());
        if self.is_of_points {
            let each = (1.0 - NEAR_SHARE) / others.len() as f64;
            others.fill(each);
            at_vertices
                .iter_mut()
                .for_each(|weight| *weight *= NEAR_SHARE);
        } else {
            for (place, weight) in self.inside.iter().zip(others) {
                *weight = share(place.triangle) / (inside[place.triangle] as f64 + 0.5);
            }
        }
        self.weights = weights;
    }
}

/// Along it no two points of a lattice are alike high, and of a body that looks alike from two sides the same points come in turn.
const UPWARDS: Vector3<f64> = Vector3::new(0.414_213_562_373_095, 0.732_050_807_568_877, 1.0);

/// Every so many of points, in order of height in the frame of the body: the map to the sphere may be turned by a rounding.
fn left_out(points: &[Vector3<f64>]) -> Vec<bool> {
    let heights: Vec<f64> = points.iter().map(|point| UPWARDS.dot(point)).collect();
    let mut order: Vec<usize> = (0..points.len()).collect();
    order.sort_by(|&one, &other| heights[one].total_cmp(&heights[other]));
    let mut is_left_out = vec![false; points.len()];
    for &place in order.iter().skip(HELD_OUT / 2).step_by(HELD_OUT) {
        is_left_out[place] = true;
    }
    is_left_out
}
