//! What every kind of grain is: a closed surface over the unit sphere.

use super::{Frame, LocalError, Tiling};
use crate::mesh::Mesh;
use crate::sphere::{cube_grid, tangents};
use nalgebra::{Matrix3, Point3, Vector3};

/// A node of a quadrature over directions: a unit vector, and its weight in solid angle.
pub type Node = (Vector3<f64>, f64);

/// A closed surface over the unit sphere: a place X(n) for each unit vector n, once round it, outside on
/// the side of X_s x X_t for tangents s, t of the sphere with s x t = n.
///
/// A star-shaped surface is the special case X(n) = r(n) n ([`Radial`](super::Radial)). Everything is said
/// in terms of `n`, never of angles, so nothing is singular at the poles. Directions and places are along the
/// axes of the scan, and unit vectors; those of a [`Grain`](super::Grain) and of its kinds may have any length but zero.
/// Places are seen from the [centre](Frame::centre) of the surface, so that they keep their
/// digits far from the scan's origin.
///
/// On an edge derivatives are those of one of its sides. Threads share a surface.
pub trait Surface: Sync {
    /// Where the surface lies. Grids of directions are laid along its axes.
    fn frame(&self) -> Frame {
        Frame::SCAN
    }

    /// X(n).
    fn place(&self, n: &Vector3<f64>) -> Vector3<f64> {
        self.place_and_slopes(n).0
    }

    /// X(n), and its derivatives: times a unit tangent t of the sphere at `n`, the derivative of X along the
    /// great circle of t, length per radian; times `n`, zero.
    fn place_and_slopes(&self, n: &Vector3<f64>) -> (Vector3<f64>, Matrix3<f64>);

    /// X(n) with its first and second derivatives, from the formulas of the surface.
    fn jet(&self, n: &Vector3<f64>) -> SurfaceJet;

    /// The same in many directions, in their order.
    fn jets(&self, directions: &[Vector3<f64>]) -> Vec<SurfaceJet> {
        directions.iter().map(|n| self.jet(n)).collect()
    }

    /// X in many directions, in their order.
    fn places(&self, directions: &[Vector3<f64>]) -> Vec<Vector3<f64>> {
        directions.iter().map(|n| self.place(n)).collect()
    }

    /// The parts of the sphere on which the surface is smooth, for quadratures over it. They lie in a sphere
    /// of nodes of the surface's own, which [`node`](Self::node) leads from.
    fn tiling(&self) -> Tiling {
        Tiling::octants()
    }

    /// A node of a quadrature over the [`tiling`](Self::tiling) as one over the directions of the scan.
    fn node(&self, (local, solid_angle): Node) -> Node {
        (self.frame().axes * local, solid_angle)
    }

    /// The parts of the surface that nodes of a quadrature over the [`tiling`](Self::tiling) stand for, along
    /// the surface's own axes.
    fn elements(&self, nodes: &[Node]) -> Vec<SurfaceElement> {
        let axes = self.frame().axes;
        let element = |node: &Node| {
            let (n, solid_angle) = self.node(*node);
            let (place, slopes) = self.place_and_slopes(&n);
            let [s, t] = tangents(&n);
            SurfaceElement {
                place: axes.tr_mul(&place),
                area: axes.tr_mul(&(slopes * s).cross(&(slopes * t))) * solid_angle,
                solid_angle,
            }
        };
        nodes.iter().map(element).collect()
    }

    /// Whether two parts of the surface may lie in one another: of a star-shaped one never.
    fn may_cross(&self) -> bool {
        true
    }

    /// How far the surface may be off in a direction, and its curvature, where that is known.
    fn local_error(&self, _n: &Vector3<f64>) -> Option<LocalError> {
        None
    }

    /// Whether the larger and the smaller principal curvature grow without bound somewhere, where the formulas of the surface tell.
    fn unbounded_curvatures(&self) -> Option<[bool; 2]> {
        None
    }

    /// X(n) in the scan.
    fn point(&self, n: &Vector3<f64>) -> Point3<f64> {
        self.frame().centre + self.place(n)
    }

    /// Directions all over the surface, and the triangles between them, counter-clockwise from outside: `resolution` cells
    /// along each edge of a cube, 1 to [`FINEST_GRID`](crate::sphere::FINEST_GRID) or the nearest of these, make 6 N^2 + 2
    /// directions and 12 N^2 triangles. Of a surface that is stretched they are even
    /// where it is rounder.
    fn grid(&self, resolution: usize) -> (Vec<Vector3<f64>>, Vec<[u32; 3]>) {
        let (mut directions, triangles) = cube_grid(resolution);
        for direction in &mut directions {
            (*direction, _) = self.node((*direction, 0.0));
        }
        (directions, triangles)
    }

    /// A closed, consistently oriented, manifold mesh over the [`grid`](Self::grid), in the scan's frame.
    fn mesh(&self, resolution: usize) -> Mesh {
        mesh_over_grid(self, resolution)
    }
}

/// The mesh of a surface over its grid.
pub(in crate::model) fn mesh_over_grid(
    surface: &(impl Surface + ?Sized),
    resolution: usize,
) -> Mesh {
    let (directions, triangles) = surface.grid(resolution);
    let centre = surface.frame().centre;
    let places = surface.places(&directions).into_iter();
    Mesh {
        vertices: places.map(|place| centre + place).collect(),
        triangles,
    }
}

/// A place of a surface and its derivatives on the unit sphere.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SurfaceJet {
    /// X(n), seen from the centre.
    pub place: Vector3<f64>,
    /// First derivatives: the rows are the surface gradients of the three coordinates, length per radian.
    pub slopes: Matrix3<f64>,
    /// Second covariant derivatives on the sphere of the three coordinates, length per square radian: symmetric,
    /// with the direction in their kernels.
    pub bends: [Matrix3<f64>; 3],
}

/// A part of a surface that a node of a quadrature stands for.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SurfaceElement {
    /// Where it lies, seen from the centre along the surface's own axes.
    pub place: Vector3<f64>,
    /// Its area along its outward normal.
    pub area: Vector3<f64>,
    /// The solid angle of its directions n.
    pub solid_angle: f64,
}
