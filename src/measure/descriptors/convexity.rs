//! How much of its convex hull a body fills.

use super::bounds::{OutOfBounds, between, ratio};
use crate::Mesh;
use crate::measure::{MeshIntegralError, mesh_properties};
use serde::Serialize;

/// A body against its convex hull: pure numbers, 1 of a convex body.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Convexity {
    /// Volume over that of the hull, also called solidity: above 0 to 1.
    pub volume: f64,
    /// Area of the hull over that of the body: above 0; below 1 where the body is rough or grooved,
    /// while a hollow that is wide and shallow, or a crown of tips, can bring it above 1.
    pub area: f64,
}

impl Convexity {
    /// That of a closed mesh and its hull.
    ///
    /// # Errors
    ///
    /// When either has no volume, or is wound inwards, so that it has one below zero.
    pub fn new(mesh: &Mesh, hull: &Mesh) -> Result<Self, MeshIntegralError> {
        let (body, hull) = (mesh_properties(mesh)?, mesh_properties(hull)?);
        for volume in [body.volume, hull.volume] {
            if volume < 0.0 {
                return Err(MeshIntegralError::NoVolume { volume });
            }
        }
        Ok(Self {
            volume: body.volume / hull.volume,
            area: hull.area / body.area,
        })
    }

    /// The same, if each is within its range.
    pub(in crate::measure) fn checked(self) -> Result<Self, OutOfBounds> {
        Ok(Self {
            volume: ratio("share of the volume of its hull", self.volume)?,
            area: between(
                "area of its hull over its own",
                self.area,
                [0.0, f64::INFINITY],
            )?,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_wound_inwards_has_no_convexity() {
        let body = Mesh::radial(4, |_| 1.0);
        let mut inwards = body.clone();
        inwards
            .triangles
            .iter_mut()
            .for_each(|corners| corners.swap(0, 1));
        let found = Convexity::new(&body, &body).unwrap();
        assert_eq!([found.volume, found.area], [1.0; 2]);
        for (one, other) in [(&inwards, &body), (&body, &inwards), (&inwards, &inwards)] {
            let found = Convexity::new(one, other);
            assert!(matches!(
                found,
                Err(MeshIntegralError::NoVolume { volume }) if volume < 0.0
            ));
        }
    }
}
