//! How the sphere is cut for quadratures over a surface.

use super::surface::Node;
use crate::sphere::{
    AngleRectangle, AngularPartition, Cover, FaceRectangle, GaussLegendre, Symmetry,
};
use std::f64::consts::FRAC_PI_2;

/// Gauss nodes per side of a piece on which a surface is analytic: of the rule, and of the one that it is
/// checked with.
const SMOOTH_ORDERS: [usize; 2] = [12, 10];

/// Relative tolerance there.
const SMOOTH_TOLERANCE: f64 = 1e-9;

/// Gauss nodes per side of a zone of blended cells: a zone is a tenth of a cell.
const BLENDED_ORDERS: [usize; 2] = [6, 5];

/// Relative tolerance of blended surfaces, whose third derivatives jump where the margins of cells end. The
/// estimate of errors is pessimistic: at 1e-5 the error is 5e-8 on the maize kernel.
const BLENDED_TOLERANCE: f64 = 3e-6;

/// How often octants are cut in four where there are creases.
const CREASED_CUTS: usize = 4;

/// The parts of the sphere on which a surface is smooth, and how well it is integrated there.
#[derive(Debug, Clone)]
pub struct Tiling {
    pub(crate) parts: Parts,
    /// Relative tolerance of integrals.
    pub(crate) tolerance: f64,
    /// Mirror planes of the surface, normal to its own axes: what is odd in these vanishes.
    pub(crate) mirrors: Symmetry,
}

#[derive(Debug, Clone)]
pub(crate) enum Parts {
    /// The whole sphere: harmonics of this degree make the surface.
    Sphere { degree: usize },
    /// Pieces that tile the sphere.
    Pieces {
        pieces: Vec<Piece>,
        /// Gauss nodes per side of a piece: of the rule, and of the one that it is checked with.
        orders: [usize; 2],
        /// How often the pieces are cut in four for a quadrature that is not adaptive.
        cuts: usize,
    },
}

/// A part of the sphere that can be integrated over and cut in four.
#[derive(Debug, Clone, Copy)]
pub(crate) enum Piece {
    Angles(AngleRectangle),
    Face(FaceRectangle),
}

impl Tiling {
    /// Of a surface that is analytic on the whole sphere, as if harmonics of this degree made it: quadratures of
    /// volume and moments are exact for these.
    pub fn sphere(degree: usize) -> Self {
        Self {
            parts: Parts::Sphere { degree },
            tolerance: SMOOTH_TOLERANCE,
            mirrors: Symmetry::NONE,
        }
    }

    /// Of a surface that is analytic within the octants.
    pub fn octants() -> Self {
        Self::smooth(Piece::octants())
    }

    /// Of a surface with creases anywhere, as unions have: pieces so small that two rules differ little even across a
    /// crease. Their differences are told, and nothing is cut further.
    pub(crate) fn creased() -> Self {
        let whole = Self::octants();
        let Parts::Pieces { mut pieces, .. } = whole.parts else {
            return whole;
        };
        for _ in 0..CREASED_CUTS {
            pieces = pieces.iter().flat_map(Piece::quarters).collect();
        }
        Self {
            parts: Parts::Pieces {
                pieces,
                orders: BLENDED_ORDERS,
                cuts: 0,
            },
            tolerance: f64::INFINITY,
            mirrors: Symmetry::NONE,
        }
    }

    /// Of a surface that is mirrored in planes normal to its axes, and analytic between them.
    pub(crate) fn mirrored(mirrors: Symmetry) -> Self {
        Self {
            mirrors,
            ..Self::octants()
        }
    }

    /// Of a surface that is analytic within the segments.
    pub(crate) fn segments(partition: AngularPartition) -> Self {
        match partition.per_angle() {
            1 => Self::smooth(Piece::Angles(partition.rectangle(0)).quarters()),
            _ => Self::smooth(
                (0..partition.segments()).map(|i| Piece::Angles(partition.rectangle(i))),
            ),
        }
    }

    /// Of a surface that is blended over the cells of a cover.
    pub(crate) fn blended(cover: &Cover) -> Self {
        Self {
            parts: Parts::Pieces {
                pieces: cover.zones().into_iter().map(Piece::Face).collect(),
                orders: BLENDED_ORDERS,
                cuts: 0,
            },
            tolerance: BLENDED_TOLERANCE,
            mirrors: Symmetry::NONE,
        }
    }

    fn smooth(pieces: impl IntoIterator<Item = Piece>) -> Self {
        Self {
            parts: Parts::Pieces {
                pieces: pieces.into_iter().collect(),
                orders: SMOOTH_ORDERS,
                cuts: 1,
            },
            tolerance: SMOOTH_TOLERANCE,
            mirrors: Symmetry::NONE,
        }
    }
}

impl Piece {
    /// The octants between the planes of coordinates.
    pub(crate) fn octants() -> [Self; 8] {
        std::array::from_fn(|i| {
            let (polar, azimuth) = ((i / 4) as f64 * FRAC_PI_2, (i % 4) as f64 * FRAC_PI_2);
            Self::Angles(AngleRectangle {
                theta: [polar, polar + FRAC_PI_2],
                phi: [azimuth, azimuth + FRAC_PI_2],
            })
        })
    }

    /// The nodes of a product of two Gauss rules.
    pub(crate) fn nodes(&self, rule: &GaussLegendre) -> Vec<Node> {
        match self {
            Self::Angles(rectangle) => rectangle.nodes(rule, rule),
            Self::Face(rectangle) => rectangle.nodes(rule),
        }
    }

    /// Solid angle.
    pub(crate) fn solid_angle(&self) -> f64 {
        match self {
            Self::Angles(rectangle) => rectangle.solid_angle(),
            Self::Face(rectangle) => rectangle.solid_angle(),
        }
    }

    /// Four pieces that make it.
    pub(crate) fn quarters(&self) -> [Self; 4] {
        match self {
            Self::Angles(rectangle) => rectangle.quarters().map(Self::Angles),
            Self::Face(rectangle) => rectangle.quarters().map(Self::Face),
        }
    }
}
