//! Meshes of grains with what is known at each of their vertices: curvature, segment, and how far a scan is off.

mod deviation;
mod placed;

pub use deviation::ScanDeviation;
pub use placed::{ContactFrame, placed};

use crate::measure::Curvature;
use crate::mesh::Mesh;
use crate::model::{Grain, Surface};
use nalgebra::Vector3;
use rayon::prelude::*;

/// A closed mesh of a surface in the scan's frame and unit, and what is known at its vertices.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct Annotated {
    /// The mesh.
    pub mesh: Mesh,
    /// The direction of each vertex: a unit vector of the scan's frame.
    pub directions: Vec<Vector3<f64>>,
    /// The surface's own outward unit normal at each vertex.
    pub normals: Vec<Vector3<f64>>,
    /// What is known at each vertex.
    pub fields: Vec<Field>,
}

/// Something that is known at the vertices of a mesh.
#[derive(Debug, Clone, PartialEq)]
pub struct Field {
    /// What: `mean_curvature` (one over length, positive where convex), `gaussian_curvature` (one over area), `segment`
    /// (a number from zero), `body` (likewise), or `deviation` (of the scan from the surface, a length, positive outside).
    pub name: &'static str,
    /// A number for each vertex; not a number where it is not known.
    pub values: Vec<f64>,
}

impl Annotated {
    /// The mesh of a grain with so many cells along each edge of a cube of directions, as [`Surface::mesh`] has it, with
    /// curvatures and segments. On an edge they are those of one of its sides, and of a union that no centre sees whole
    /// those of the part that a vertex is on.
    pub fn new(grain: &Grain, resolution: usize) -> Self {
        let mesh = grain.mesh(resolution);
        let union = grain.superquadric().filter(|_| grain.hidden_share() > 0.0);
        let directions: Vec<Vector3<f64>> = match union {
            Some(_) => {
                let centre = grain.frame().centre;
                let vertices = mesh.vertices.iter();
                vertices.map(|v| (v - centre).normalize()).collect()
            }
            None => grain.grid(resolution).0,
        };
        let bent = directions
            .par_iter()
            .zip(&mesh.vertices)
            .map(|(n, vertex)| {
                let (n, jet) = match union {
                    Some(union) => union.jet_of_part(vertex),
                    None => (*n, grain.jet(n)),
                };
                let curvature = Curvature::new(&n, &jet);
                (curvature.normal, (curvature.mean(), curvature.gaussian()))
            });
        let (normals, (means, gaussians)): (Vec<_>, (Vec<_>, Vec<_>)) = bent.unzip();
        let segments = directions.par_iter().map(|n| grain.segment(n) as f64);
        let field = |name, values| Field { name, values };
        Self {
            fields: vec![
                field("mean_curvature", means),
                field("gaussian_curvature", gaussians),
                field("segment", segments.collect()),
            ],
            mesh,
            normals,
            directions,
        }
    }

    /// The same with how far a scan is off at each vertex.
    #[must_use]
    pub fn with_deviation(mut self, deviation: &ScanDeviation) -> Self {
        let values = self
            .mesh
            .vertices
            .par_iter()
            .map(|vertex| deviation.at(vertex));
        self.fields.push(Field {
            name: "deviation",
            values: values.collect(),
        });
        self
    }

    /// The share of the vertices at which the distance of a scan is not known, if it was asked for.
    pub fn unseen_share(&self) -> Option<f64> {
        let distances = self.field("deviation")?;
        let unseen = distances.iter().filter(|distance| distance.is_nan());
        Some(unseen.count() as f64 / distances.len() as f64)
    }

    /// The values of a field, if it is there.
    pub fn field(&self, name: &str) -> Option<&[f64]> {
        let mut fields = self.fields.iter();
        Some(&fields.find(|field| field.name == name)?.values)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scan::Scan;
    use crate::shapes::{Body, SynthOptions, synthesize};
    use crate::{FitOptions, fit};
    use nalgebra::Point3;

    /// A ball of radius 2, and a scan of it that is larger by 0.1 on one side and has nothing below.
    #[test]
    fn a_ball_has_its_curvature_and_a_scan_its_distance() {
        let points = synthesize(&SynthOptions::clean(Body::Sphere).with_points(1538))
            .unwrap()
            .points;
        let radius = points[0].coords.norm();
        let grain = fit(&Scan::from_points(points.clone()), &FitOptions::default())
            .unwrap()
            .grain;
        let seen = points.iter().filter(|point| point.z > -0.5 * radius);
        let moved = |point: &Point3<f64>| match point.x > 0.0 {
            true => point * 1.05,
            false => *point,
        };
        let scan = Scan::from_points(seen.map(moved).collect());
        let found = Annotated::new(&grain, 12).with_deviation(&ScanDeviation::new(&grain, &scan));
        assert_eq!(found.mesh, grain.mesh(12));
        let of = |name| found.field(name).unwrap();
        for (at, vertex) in found.mesh.vertices.iter().enumerate() {
            assert!((of("mean_curvature")[at] * radius - 1.0).abs() < 1e-3);
            assert!((of("gaussian_curvature")[at] * radius * radius - 1.0).abs() < 2e-3);
            assert!((found.normals[at] - vertex.coords.normalize()).norm() < 1e-3);
            let deviation = of("deviation")[at] / radius;
            match (vertex.z / radius, vertex.x / radius) {
                (..-0.75, _) => assert!(deviation.is_nan(), "{vertex}"),
                (-0.3.., 0.2..) => assert!((deviation - 0.05).abs() < 1e-3, "{deviation}"),
                (-0.3.., ..-0.2) => assert!(deviation.abs() < 1e-3, "{deviation}"),
                _ => {}
            }
        }
    }
}
