//! A place on the unit sphere for every vertex of a closed mesh, so that no triangle turns over.
//!
//! The mesh is simplified to a tetrahedron by collapses of edges, and built up again on the sphere: each vertex that
//! comes back is put into the kernel of its ring, which is never empty, for the vertex it went to sees all of the
//! ring (Praun and Hoppe 2003; Hu, Fu and Liu 2017). So the map is one to one by construction; nothing is solved for
//! all vertices at once. On the way and at the end vertices move to lessen a [distortion](rest) that leans to equal
//! areas. What comes out is checked, with exact signs.

mod error;
mod grow;
mod half_edges;
mod rest;
mod simplify;
mod star;

pub use error::MapError;

use super::on_sphere::spherical_area;
use crate::fit::context::Context;
use crate::mesh::Mesh;
use crate::predicates::orient3d;
use grow::Growing;
use half_edges::HalfEdges;
use nalgebra::{Matrix3, Point3, Vector3};
use simplify::simplify;
use std::f64::consts::PI;

/// Least area of the faces round a vertex when a map is turned, for a mesh of diameter 1: so that faces of no area have
/// a centroid.
const LEAST_SHARE: f64 = 1e-12;

/// Most the sum of solid angles over 4 pi may be off 1: rounding of triangles that are nearly great circles. Where no
/// triangle turns over it is a whole number.
const DEGREE_ERROR: f64 = 1e-6;

/// A closed mesh that is mapped to the sphere, one to one and not turned over: a few of its vertices first, if so desired.
#[derive(Clone)]
pub(crate) struct SphericalMap<'a> {
    mesh: &'a Mesh,
    growing: Growing,
}

/// A mesh of some vertices of another, which lies about it, and their places on the sphere.
pub(super) struct Coarse {
    pub(super) mesh: Mesh,
    pub(super) places: Vec<Vector3<f64>>,
}

impl<'a> SphericalMap<'a> {
    /// # Errors
    /// [`MapError`] if the mesh is not one closed surface of the topology of a sphere, or if the work is cancelled.
    pub(crate) fn new(mesh: &'a Mesh, context: &Context<'_>) -> Result<Self, MapError> {
        let mut half_edges = HalfEdges::new(mesh)?;
        let points = scaled(&mesh.vertices).ok_or(MapError::NoBody)?;
        let removed = simplify(&mut half_edges, &points, context)?;
        Ok(Self {
            mesh,
            growing: Growing::new(half_edges, points, removed),
        })
    }

    /// A unit vector for every vertex. They are turned so that the vector at a point is the point's own direction as nearly as
    /// can be.
    ///
    /// # Errors
    /// [`MapError`] if numbers do not resolve the faces, or if the work is cancelled.
    pub(crate) fn whole(&mut self, context: &Context<'_>) -> Result<Vec<Vector3<f64>>, MapError> {
        self.growing.grow(usize::MAX, context)?;
        let mut places = self.growing.places.clone();
        turn(&mut places, &self.mesh.triangles, &self.growing.points);
        certify(&self.mesh.triangles, &places)?;
        Ok(places)
    }

    /// The same of so many vertices, those without which the mesh would differ most.
    ///
    /// # Errors
    /// As [`Self::whole`].
    pub(super) fn coarse(
        &mut self,
        vertices: usize,
        context: &Context<'_>,
    ) -> Result<Coarse, MapError> {
        self.growing.grow(vertices, context)?;
        let Growing {
            living,
            places,
            points,
            half_edges,
            ..
        } = &self.growing;
        let mut number = vec![0; points.len()];
        for (own, &v) in (0..).zip(living) {
            number[v as usize] = own;
        }
        let around = living.iter().flat_map(|&v| half_edges.around(v));
        let triangles = around.filter(|h| h.is_multiple_of(3)).map(|h| {
            half_edges
                .corners(h / 3)
                .map(|corner| number[corner as usize])
        });
        let of_living = |all: &[Vector3<f64>]| -> Vec<Vector3<f64>> {
            living.iter().map(|&v| all[v as usize]).collect()
        };
        let triangles: Vec<[u32; 3]> = triangles.collect();
        let mut places = of_living(places);
        turn(&mut places, &triangles, &of_living(points));
        certify(&triangles, &places)?;
        let vertices = living.iter().map(|&v| self.mesh.vertices[v as usize]);
        Ok(Coarse {
            mesh: Mesh {
                vertices: vertices.collect(),
                triangles,
            },
            places,
        })
    }

    /// A unit vector for every vertex, of which those of the [coarse mesh](Self::coarse) are given.
    ///
    /// # Errors
    /// As [`Self::whole`].
    pub(super) fn between(
        &self,
        places: &[Vector3<f64>],
        context: &Context<'_>,
    ) -> Result<Vec<Vector3<f64>>, MapError> {
        let mut growing = self.growing.clone();
        for (&v, place) in self.growing.living.iter().zip(places) {
            growing.places[v as usize] = *place;
        }
        growing.fill(context)?;
        certify(&self.mesh.triangles, &growing.places)?;
        Ok(growing.places)
    }
}

/// The vertices of a mesh, moved and scaled to a box whose diagonal is 1.
fn scaled(vertices: &[Point3<f64>]) -> Option<Vec<Vector3<f64>>> {
    let (mut low, mut high) = (
        Vector3::repeat(f64::INFINITY),
        Vector3::repeat(f64::NEG_INFINITY),
    );
    for vertex in vertices {
        (low, high) = (low.inf(&vertex.coords), high.sup(&vertex.coords));
    }
    let diagonal = (high - low).norm();
    let middle = (low + high) * 0.5;
    let points: Vec<_> = vertices
        .iter()
        .map(|v| (v.coords - middle) / diagonal)
        .collect();
    let are_finite = points.iter().flatten().all(|x| x.is_finite());
    (are_finite && diagonal > 0.0).then_some(points)
}

/// Turns places to the points they belong to: the mean over the surface of their scalar products, with points taken
/// from their centroid, becomes largest (Procrustes).
fn turn(places: &mut [Vector3<f64>], triangles: &[[u32; 3]], points: &[Vector3<f64>]) {
    let mut shares = vec![LEAST_SHARE; points.len()];
    for corners in triangles {
        let [a, b, c] = corners.map(|corner| points[corner as usize]);
        let area = (b - a).cross(&(c - a)).norm();
        for &corner in corners {
            shares[corner as usize] += area;
        }
    }
    let weighted = points.iter().zip(&shares);
    let centroid =
        weighted.map(|(x, share)| x * *share).sum::<Vector3<f64>>() / shares.iter().sum::<f64>();
    let mut together = Matrix3::<f64>::zeros();
    for ((place, x), share) in places.iter().zip(points).zip(&shares) {
        together += (x - centroid) * place.transpose() * *share;
    }
    let svd = together.svd(true, true);
    if let (Some(u), Some(v)) = (svd.u, svd.v_t) {
        let side: f64 = (u * v).determinant();
        let turn = u * Matrix3::from_diagonal(&Vector3::new(1.0, 1.0, side.signum())) * v;
        for place in places {
            *place = (turn * *place).normalize();
        }
    }
}

/// Checks that no triangle turns over, and that together they cover the sphere once.
fn certify(triangles: &[[u32; 3]], places: &[Vector3<f64>]) -> Result<(), MapError> {
    let (mut flips, mut solid_angle) = (0, 0.0);
    for corners in triangles {
        let [a, b, c] = corners.map(|corner| places[corner as usize]);
        if !is_upright([a, b, c]) {
            flips += 1;
        }
        solid_angle += spherical_area([a, b, c]);
    }
    let degree = solid_angle / (4.0 * PI);
    match flips == 0 && (degree - 1.0).abs() < DEGREE_ERROR {
        true => Ok(()),
        false => Err(MapError::NotOneToOne { flips, degree }),
    }
}

/// Whether a triangle on the sphere is seen counter-clockwise from outside; exact.
pub(super) fn is_upright([a, b, c]: [Vector3<f64>; 3]) -> bool {
    let [a, b, c] = [a, b, c].map(Point3::from);
    orient3d([a, b, c], Point3::origin()) > 0.0
}

#[cfg(test)]
mod tests;
