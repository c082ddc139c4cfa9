//! The grain that is a union of superquadrics, of one or several.

use super::outside::outside;
use super::{MultiSuperquadric, Part, Superquadric};
use crate::mesh::Mesh;
use crate::model::surface::mesh_over_grid;
use crate::model::{
    Frame, InvalidGrain, Node, Radial, StarSurface, Stretch, Surface, SurfaceJet, Tiling,
};
use crate::sphere::unit;
use nalgebra::{Matrix3, Point3, Vector3};

/// A union of superquadrics and where it lies in the scan, seen as the surface that rays from its centre leave last.
/// Directions may have any length but zero.
///
/// Where these meet it again, that is not its whole surface ([`Self::hidden_share`]); its [mesh](Surface::mesh) is.
#[derive(Debug, Clone)]
pub struct SuperquadricGrain {
    frame: Frame,
    body: MultiSuperquadric,
    /// After which one along the axes of the frame is as wide along all; unions are not stretched.
    stretch: Stretch,
    hidden_share: f64,
}

impl SuperquadricGrain {
    /// A grain of one superquadric about the centre of the frame, along its axes.
    ///
    /// # Errors
    /// [`InvalidGrain`] if the frame is not orthonormal or not finite.
    pub fn single(frame: Frame, shape: Superquadric) -> Result<Self, InvalidGrain> {
        let part = Part {
            shape,
            frame: Frame::SCAN,
        };
        Self::multi(frame, MultiSuperquadric::new(vec![part])?)
    }

    /// A grain of several, in the frame.
    ///
    /// # Errors
    /// As [`Self::single`].
    pub fn multi(frame: Frame, body: MultiSuperquadric) -> Result<Self, InvalidGrain> {
        frame.check()?;
        Ok(Self {
            frame,
            hidden_share: body.hidden_share(),
            stretch: stretch(&body),
            body,
        })
    }

    /// The superquadrics, in the grain's own frame.
    pub fn body(&self) -> &MultiSuperquadric {
        &self.body
    }

    /// Share of the directions in which a ray from the centre leaves the union and meets it again: zero of a union that
    /// the centre sees whole.
    pub fn hidden_share(&self) -> f64 {
        self.hidden_share
    }

    /// The grain about the origin, so many times as large.
    pub(in crate::model) fn about_origin(&self, factor: f64) -> Self {
        Self {
            frame: Frame {
                centre: Point3::origin(),
                ..self.frame
            },
            body: self.body.times(factor),
            stretch: self.stretch,
            hidden_share: self.hidden_share,
        }
    }

    /// What is known of the surface at a point of it, from the part that it belongs to: the direction from that part's
    /// centre, and the jet of the part over these directions.
    pub(crate) fn jet_of_part(&self, point: &Point3<f64>) -> (Vector3<f64>, SurfaceJet) {
        let local = self.frame.to_local(point);
        let parts = self.body.parts().iter();
        let nearest = parts.min_by(|p, q| p.gauge(&local).total_cmp(&q.gauge(&local)));
        let part = nearest.unwrap_or(&self.body.parts()[0]);
        part.placed(&self.frame).jet_at(point)
    }

    /// Numbers of its shape: those of each part, and six for its pose beside the first.
    pub(in crate::model) fn number_count(&self) -> usize {
        let parts = self.body.parts();
        let numbers = parts.iter().map(|part| part.shape.number_count());
        numbers.sum::<usize>() + 6 * (parts.len() - 1)
    }
}

/// What makes a superquadric along the axes of its frame as wide along all.
fn stretch(body: &MultiSuperquadric) -> Stretch {
    match body.parts() {
        [part] if part.frame == Frame::SCAN => {
            let [x, y, z] = part.shape.semi_axes().map(|[one, other]| one.max(other));
            Stretch::new(Vector3::new(x, y, z).map(f64::recip)).unwrap_or(Stretch::NONE)
        }
        _ => Stretch::NONE,
    }
}

impl Surface for SuperquadricGrain {
    fn frame(&self) -> Frame {
        self.frame
    }

    fn place(&self, n: &Vector3<f64>) -> Vector3<f64> {
        let n = unit(n);
        n * self.body.radius(&self.frame.axes.tr_mul(&n))
    }

    fn place_and_slopes(&self, n: &Vector3<f64>) -> (Vector3<f64>, Matrix3<f64>) {
        let axes = self.frame.axes;
        let (place, slopes) = Radial(&self.body).place_and_slopes(&axes.tr_mul(&unit(n)));
        (axes * place, axes * slopes * axes.transpose())
    }

    fn jet(&self, n: &Vector3<f64>) -> SurfaceJet {
        let axes = self.frame.axes;
        let n = unit(n);
        // Turned there and back, a place on a plane between octants would lie beside it, where curvatures may be far from those on it.
        let local = axes.tr_mul(&n);
        let local = local.map(|c| if c.abs() < 2.0 * f64::EPSILON { 0.0 } else { c });
        let local = self.body.derivatives(&local);
        local.turned(&axes).radial(&n)
    }

    fn tiling(&self) -> Tiling {
        match self.body.parts() {
            // Octants of its own frame, if that is the grain's.
            [part] if part.frame == Frame::SCAN => Tiling::octants(),
            _ => Tiling::creased(),
        }
    }

    fn may_cross(&self) -> bool {
        false
    }

    fn unbounded_curvatures(&self) -> Option<[bool; 2]> {
        match self.body.parts() {
            [part] => Some(part.shape.unbounded_curvatures()),
            _ => None,
        }
    }

    /// From directions of the body stretched to equal widths.
    fn node(&self, node: Node) -> Node {
        let (direction, solid_angle) = self.stretch.node(node);
        (self.frame.axes * direction, solid_angle)
    }

    /// Of a union that the centre does not see whole one over a lattice, about as fine: closed and consistently oriented
    /// all the same.
    fn mesh(&self, resolution: usize) -> Mesh {
        if self.hidden_share == 0.0 {
            return mesh_over_grid(self, resolution);
        }
        let Frame { centre, axes } = self.frame;
        let local = outside(&self.body, resolution);
        let vertices = local.vertices.iter();
        Mesh {
            vertices: vertices
                .map(|vertex| centre + axes * vertex.coords)
                .collect(),
            triangles: local.triangles,
        }
    }
}
