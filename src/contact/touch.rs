//! Where a body touches what comes from a direction, and how it is curved there.

use super::{EdgeError, TangentCap};
use crate::Mesh;
use crate::measure::{Curvature, Support, sound_crossings, support};
use crate::model::{LocalError, Surface};
use crate::sphere::{cube_grid, tangents, unit};
use nalgebra::Vector3;
use std::f64::consts::TAU;
use thiserror::Error;

/// Distance, in radians, at which the sides of an edge are looked at.
const ASIDE: f64 = 1e-6;

/// Directions round an edge in which its sides are looked at.
const AROUND: usize = 16;

/// Where curvature has a bound, it is at most by this share more at a place than all round it, [`ASIDE`]. Across a plane of a
/// superquadric whose exponent is 1.999 it is 1 % more.
const MORE_CURVED: f64 = 1e-3;

/// Curvature that may be rounding, as a share of that of a sphere of the place's distance from the centre.
const ROUNDED: f64 = 1e-6;

/// Largest angle between the normals of one side, in radians: on a side that is curved a thousand
/// times as much as a sphere they are as far apart.
const ONE_SIDE: f64 = 2e-3;

/// Cells per edge of the cube of directions of the mesh in which crossings are looked for.
const CROSSING: usize = 64;

/// Cells per edge of the cube of directions in which it is looked how far a body reaches.
const LOOKED_AT: usize = 16;

/// A point of a body by which it touches a plane.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Touch {
    /// The direction n of the point.
    pub direction: Vector3<f64>,
    /// The point, seen from the surface's centre: on an edge, before that is rounded.
    pub point: Vector3<f64>,
    /// Principal curvatures there, the larger first: one over length.
    pub principal: [f64; 2],
    /// Unit vectors along which they are met, tangential to the plane.
    pub directions: [Vector3<f64>; 2],
    /// The cap by which an edge was rounded.
    pub cap: Option<TangentCap>,
    /// Standard errors of the surface there, where it tells them; of an edge none.
    pub error: Option<LocalError>,
}

/// Why a body's contact has no curvature.
#[derive(Debug, Clone, Copy, PartialEq, Error)]
#[non_exhaustive]
pub enum TouchError {
    /// Give the radius of the cap that rounds it.
    #[error("the surface has an edge of {turn_deg:.1} degrees there, which has no curvature")]
    Edge {
        /// Angle between the normals of its sides, in degrees.
        turn_deg: f64,
    },
    /// The surface is an edge without an angle, as of a superquadric across the planes of exponents below two.
    #[error(
        "the surface has an edge there: its curvature has no bound, so Hertz's theory does not hold"
    )]
    Unbounded,
    /// More than two sides meet: no cap is tangent to all of them.
    #[error("the surface has a corner there, which has no curvature")]
    Corner,
    /// A direction has a length, and is finite.
    #[error("there is no direction along ({}, {}, {})", towards[0], towards[1], towards[2])]
    Direction {
        /// The vector given.
        towards: [f64; 3],
    },
    /// The surface is not that of a body.
    #[error(
        "the surface goes through itself near ({:.4}, {:.4}, {:.4})",
        at[0], at[1], at[2]
    )]
    Crossing {
        /// Where, in the scan's frame.
        at: [f64; 3],
    },
    /// The edge cannot be rounded by a cap of the radius asked for.
    #[error(transparent)]
    Cap(#[from] EdgeError),
}

/// Where a surface touches a plane whose normal, pointing away from the surface, is along
/// `towards`, of any length but zero. Of a surface that may cross itself a mesh is looked at first. An edge there, as expansions of an octant have where they meet their images, is rounded by
/// a cap of the given radius.
///
/// # Errors
///
/// See [`TouchError`].
pub fn touch(
    surface: &(impl Surface + ?Sized),
    towards: &Vector3<f64>,
    edge_radius: Option<f64>,
) -> Result<Touch, TouchError> {
    let along = unit(towards);
    if !along.iter().all(|x| x.is_finite()) {
        let towards = (*towards).into();
        return Err(TouchError::Direction { towards });
    }
    let towards = &along;
    if surface.may_cross() {
        refuse_crossings(&surface.mesh(CROSSING))?;
    }
    let found = support(surface, towards);
    if found.is_smooth {
        refuse_unbounded(surface, &found)?;
        return Ok(Touch {
            direction: found.direction,
            point: found.point,
            principal: found.curvature.principal,
            directions: found.curvature.directions,
            cap: None,
            error: surface.local_error(&found.direction),
        });
    }
    round(
        &found,
        &sides(surface, &found.direction)?,
        towards,
        edge_radius,
    )
}

/// How far a surface reaches from its centre.
pub fn reach(surface: &(impl Surface + ?Sized)) -> f64 {
    let (directions, _) = cube_grid(LOOKED_AT);
    let places = surface.places(&directions).into_iter();
    places.map(|place| place.norm()).fold(0.0, f64::max)
}

/// Refuses a mesh that goes through itself.
fn refuse_crossings(mesh: &Mesh) -> Result<(), TouchError> {
    match sound_crossings(mesh).first() {
        None => Ok(()),
        Some([one, _]) => {
            let [corner, ..] = mesh.triangles[*one];
            Err(TouchError::Crossing {
                at: mesh.vertices[corner as usize].into(),
            })
        }
    }
}

/// Refuses a place that is curved more than all places round it, however near these are.
fn refuse_unbounded(surface: &(impl Surface + ?Sized), found: &Support) -> Result<(), TouchError> {
    let own = found.curvature.mean();
    let beside = around(surface, &found.direction);
    let most = beside.iter().map(Curvature::mean);
    let most = most.fold(f64::NEG_INFINITY, f64::max);
    let is_told = own * found.point.norm() > ROUNDED;
    match is_told && own > (1.0 + MORE_CURVED) * most {
        true => Err(TouchError::Unbounded),
        false => Ok(()),
    }
}

/// The surface a little aside of `n`, all round it.
fn around(surface: &(impl Surface + ?Sized), n: &Vector3<f64>) -> Vec<Curvature> {
    let [first, second] = tangents(n);
    // Half a step off the axes, along which edges tend to run.
    let turns = (0..AROUND).map(|i| (TAU * (i as f64 + 0.5) / AROUND as f64).sin_cos());
    turns
        .map(|(sin, cos)| {
            let aside = (n + (first * cos + second * sin) * ASIDE).normalize();
            Curvature::new(&aside, &surface.jet(&aside))
        })
        .collect()
}

/// The two sides of an edge: those that are farthest apart of all round `n`.
fn sides(
    surface: &(impl Surface + ?Sized),
    n: &Vector3<f64>,
) -> Result<[Curvature; 2], TouchError> {
    let around = around(surface, n);
    let apart = |one: &Curvature, other: &Curvature| (one.normal - other.normal).norm();
    let one = around[0];
    let farthest = |from: &Curvature| {
        let farther = |a: &&Curvature, b: &&Curvature| apart(from, a).total_cmp(&apart(from, b));
        around.iter().max_by(farther).copied().unwrap_or(one)
    };
    let one = farthest(&one);
    let other = farthest(&one);
    let is_on_a_side = |side: &Curvature| apart(side, &one).min(apart(side, &other)) < ONE_SIDE;
    match around.iter().all(is_on_a_side) {
        true => Ok([one, other]),
        false => Err(TouchError::Corner),
    }
}

fn round(
    found: &Support,
    sides: &[Curvature; 2],
    towards: &Vector3<f64>,
    edge_radius: Option<f64>,
) -> Result<Touch, TouchError> {
    let normals = [&sides[0].normal, &sides[1].normal];
    let cap = TangentCap::new(normals, edge_radius.unwrap_or(1.0))?;
    if edge_radius.is_none() {
        return Err(TouchError::Edge {
            turn_deg: cap.turn_rad.to_degrees(),
        });
    }
    let Some(along) = normals[0].cross(normals[1]).try_normalize(0.0) else {
        return Err(TouchError::Corner);
    };
    // Meusnier: the edge, seen from the direction of the contact, bends more than the side does.
    let bend = sides[0].along(&along) / normals[0].dot(towards);
    Ok(Touch {
        direction: found.direction,
        point: found.point,
        principal: cap.principal_curvatures(1.0 / bend),
        directions: [along.cross(towards), along],
        cap: Some(cap),
        error: None,
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::{Radial, Superquadric};
    use crate::shapes::{Bicone, Body, Cuboid, Ellipsoid};
    use approx::assert_relative_eq;

    #[test]
    fn an_ellipsoid_touches_with_the_radii_of_table_3_6() {
        let ellipsoid = Ellipsoid {
            semi_axes: Vector3::new(2.0, 2.0, 1.0),
        };
        let side = touch(&Radial(&ellipsoid), &Vector3::x(), None).unwrap();
        assert_relative_eq!(side.principal[0], 2.0, max_relative = 1e-12);
        assert_relative_eq!(side.principal[1], 0.5, max_relative = 1e-12);
        let long = touch(&Radial(&ellipsoid), &(Vector3::x() * 1e200), None);
        assert_eq!(long, Ok(side));
        for none in [0.0, f64::NAN, f64::INFINITY] {
            let refused = touch(&Radial(&ellipsoid), &Vector3::new(0.0, none, 0.0), None);
            assert!(
                matches!(refused, Err(TouchError::Direction { .. })),
                "{none}"
            );
        }
        let top = touch(&Radial(&ellipsoid), &Vector3::z(), None).unwrap();
        assert_relative_eq!(top.principal[0], 0.25, max_relative = 1e-12);
        assert!(top.cap.is_none());
    }

    #[test]
    fn the_rim_of_a_bicone_is_rounded_by_a_cap() {
        let bicone = Bicone {
            radius: 4.0,
            half_height: 3.0,
        };
        let refused = touch(&Radial(&bicone), &Vector3::x(), None).unwrap_err();
        let turn: f64 = 2.0 * (4.0_f64 / 3.0).atan();
        assert!(matches!(refused, TouchError::Edge { turn_deg }
            if (turn_deg - turn.to_degrees()).abs() < 1e-4));
        let found = touch(&Radial(&bicone), &Vector3::x(), Some(0.1)).unwrap();
        assert_relative_eq!(found.principal[0], 10.0, max_relative = 1e-9);
        let recess = 0.1 * (1.0 / (0.5 * turn).cos() - 1.0);
        assert_relative_eq!(
            found.principal[1],
            1.0 / (4.0 - recess),
            max_relative = 1e-5
        );
        assert_relative_eq!(found.directions[1].y.abs(), 1.0, epsilon = 1e-5);
    }

    #[test]
    fn edges_without_an_angle_are_refused_and_flat_places_are_not() {
        let along = |n1: f64, n2: f64, towards: [f64; 3]| {
            let body = Superquadric::single([3.0, 2.0, 1.0], n1, n2).unwrap();
            touch(&Radial(&body), &towards.into(), None)
        };
        let [tip, plane, aside] = [[0.0, 0.0, 1.0], [1.0, 0.0, 1.0], [1.0, 0.5, 1.0]];
        for (n1, n2, towards) in [
            (1.7, 1.9, tip),
            (1.7, 1.9, plane),
            (2.0, 1.5, plane),
            (3.0, 1.999, plane),
            (1.1, 2.0, tip),
        ] {
            let refused = along(n1, n2, towards);
            assert_eq!(refused, Err(TouchError::Unbounded), "{n1} {n2} {towards:?}");
        }
        for (n1, n2, towards) in [
            (1.7, 1.9, aside),
            (1.7, 2.0, plane),
            (2.0, 2.0, tip),
            (2.0, 2.0, plane),
            (3.0, 2.5, tip),
            (2.01, 8.0, plane),
        ] {
            assert!(along(n1, n2, towards).is_ok(), "{n1} {n2} {towards:?}");
        }
    }

    #[test]
    fn corners_and_apexes_are_refused() {
        let cuboid = Cuboid {
            half_edges: Vector3::new(1.0, 1.0, 1.0),
        };
        let diagonal = Vector3::repeat(1.0).normalize();
        assert_eq!(
            touch(&Radial(&cuboid), &diagonal, Some(0.1)),
            Err(TouchError::Corner)
        );
        let bicone = Body::Bicone.surface();
        let apex = touch(&Radial(bicone.as_ref()), &Vector3::z(), Some(0.1));
        assert_eq!(apex, Err(TouchError::Corner));
    }
}
