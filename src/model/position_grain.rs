//! The grain whose points are given over the sphere, star-shaped or not.

use super::position::area_normal;
use super::{Frame, InvalidGrain, Node, Position, Surface, SurfaceElement, SurfaceJet, Tiling};
use crate::sphere::{cube_grid, unit};
use nalgebra::{Matrix3, Point3, Vector3};

/// A closed surface X(n) = (x, y, z)(n) over the sphere, and where it lies in the scan. Directions may have any length but
/// zero.
#[derive(Debug, Clone)]
pub struct PositionGrain {
    frame: Frame,
    position: Position,
}

/// Cells along a cube's edge of the directions in which a surface is checked.
const CHECKED: usize = 48;

/// Sizes beyond which, or beyond the inverse of which, volumes are not numbers.
const LARGEST_SIZE: f64 = 1e100;

impl PositionGrain {
    /// A grain whose points, seen from the centre of the frame along its axes, are those of `position`.
    ///
    /// # Errors
    /// [`InvalidGrain`] if the frame is not orthonormal or not finite.
    pub fn new(frame: Frame, position: Position) -> Result<Self, InvalidGrain> {
        frame.check()?;
        Ok(Self { frame, position })
    }

    /// The points in the grain's own frame.
    pub fn position(&self) -> &Position {
        &self.position
    }

    /// Refuses a surface that runs round the sphere the wrong way, or turns over within a degree or two: then its
    /// normals do not point outside. Looked for on a grid of 13 826 directions. That parts which lie
    /// apart on the sphere do not cross tells [`crossings`](crate::measure::crossings).
    ///
    /// # Errors
    /// [`InvalidGrain::Folded`] with a direction, [`InvalidGrain::InsideOut`], and [`InvalidGrain::OutOfRange`] if
    /// lengths are beyond 1e100, or below its inverse.
    pub fn check(&self) -> Result<(), InvalidGrain> {
        let (directions, triangles) = cube_grid(CHECKED);
        let found = self.position.points_and_tangents(&directions);
        let size = found.iter().map(|(point, _)| point.norm());
        let size = size.fold(
            0.0,
            |most: f64, size| if size <= most { most } else { size },
        );
        if !(1.0 / LARGEST_SIZE..=LARGEST_SIZE).contains(&size) {
            return Err(InvalidGrain::OutOfRange);
        }
        let place = |i: u32| found[i as usize].0 / size;
        let normal = |i: u32| {
            let tangents = found[i as usize].1 / size;
            area_normal(&directions[i as usize], &tangents).normalize()
        };
        let mut volume = 0.0;
        for &[i, j, k] in &triangles {
            let [a, b, c] = [i, j, k].map(place);
            let area = (b - a).cross(&(c - a));
            volume += a.dot(&b.cross(&c)) / 6.0;
            let outwards = area.dot(&(normal(i) + normal(j) + normal(k)));
            if outwards.is_nan() || outwards <= 0.0 {
                let direction = self.frame.axes * directions[i as usize];
                return Err(InvalidGrain::Folded {
                    direction: direction.into(),
                });
            }
        }
        match volume > 0.0 {
            true => Ok(()),
            false => Err(InvalidGrain::InsideOut),
        }
    }

    /// The grain about the origin, so many times as large.
    pub(super) fn about_origin(&self, factor: f64) -> Self {
        Self {
            frame: Frame {
                centre: Point3::origin(),
                ..self.frame
            },
            position: self.position.times(factor),
        }
    }

    /// The unit vector in a direction of the scan, along the grain's own axes.
    fn local(&self, n: &Vector3<f64>) -> Vector3<f64> {
        self.frame.axes.tr_mul(&unit(n))
    }

    fn turned(
        &self,
        (place, slopes): (Vector3<f64>, Matrix3<f64>),
    ) -> (Vector3<f64>, Matrix3<f64>) {
        let axes = self.frame.axes;
        (axes * place, axes * slopes * axes.transpose())
    }
}

impl Surface for PositionGrain {
    fn frame(&self) -> Frame {
        self.frame
    }

    fn place_and_slopes(&self, n: &Vector3<f64>) -> (Vector3<f64>, Matrix3<f64>) {
        let local = self.local(n);
        self.turned(self.position.point_and_tangents(&local))
    }

    fn jet(&self, n: &Vector3<f64>) -> SurfaceJet {
        let axes = self.frame.axes;
        let jet = self.position.derivatives(&self.local(n));
        let (place, slopes) = self.turned((jet.point, jet.tangents));
        let [x, y, z] = jet.hessians.map(|bend| axes * bend * axes.transpose());
        let along = |i: usize| x * axes[(i, 0)] + y * axes[(i, 1)] + z * axes[(i, 2)];
        SurfaceJet {
            place,
            slopes,
            bends: [0, 1, 2].map(along),
        }
    }

    fn places(&self, directions: &[Vector3<f64>]) -> Vec<Vector3<f64>> {
        let axes = self.frame.axes;
        let local: Vec<_> = directions.iter().map(|n| self.local(n)).collect();
        let found = self.position.points_and_tangents(&local).into_iter();
        found.map(|(place, _)| axes * place).collect()
    }

    fn tiling(&self) -> Tiling {
        match self.position.cover() {
            Some(cover) => Tiling::blended(cover),
            None => Tiling::sphere(self.position.degree()),
        }
    }

    fn elements(&self, nodes: &[Node]) -> Vec<SurfaceElement> {
        let directions: Vec<_> = nodes.iter().map(|(n, _)| *n).collect();
        let found = self.position.points_and_tangents(&directions);
        let element =
            |(&(n, solid_angle), (place, slopes)): (&Node, (Vector3<f64>, Matrix3<f64>))| {
                SurfaceElement {
                    place,
                    area: area_normal(&n, &slopes) * solid_angle,
                    solid_angle,
                }
            };
        nodes.iter().zip(found).map(element).collect()
    }
}
