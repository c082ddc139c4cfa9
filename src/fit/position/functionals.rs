//! The figures of a surface that have standard errors, and how they change with its coefficients.
//!
//! Where the surface moves by h along its normal, with H its mean curvature, area, volume and moments about the origin
//! change by
//!
//! ```text
//! ∫ 2 H h dA      ∫ h dA      ∫ X h dA      ∫ X X' h dA
//! ```
//!
//! and the extent along an axis a by a.(dX+ - dX-) at its ends.

use super::functions::Functions;
use super::least_squares::{add_adjoint, no_sums};
use crate::fit::outcome::figures::{INTEGRALS, list};
use crate::fit::outcome::turn::TURNS;
use crate::measure::{Curvature, Moments, PrincipalInertia, grain_properties, support};
use crate::model::{Frame, Position, PositionDerivatives, PositionGrain, SurfaceJet, area_normal};
use crate::sphere::GaussLegendre;
use faer::Mat;
use nalgebra::{SVector, Vector3};
use std::f64::consts::PI;

/// Area, volume and moments, and then how far the surface reaches along both sides of the principal axes.
pub(super) const FIGURES: usize = INTEGRALS + 6;

/// A number for each figure.
pub(super) type FigureVector = SVector<f64, FIGURES>;

/// A surface, and the places that its figures are made of.
pub(super) struct Functionals {
    pub(super) moments: Moments,
    pub(super) principal: PrincipalInertia,
    /// The points farthest along each principal axis, and those farthest against it.
    pub(super) ends: Vec<[End; 2]>,
    places: Vec<Place>,
    /// Points all over the surface, and their solid angles.
    points: Vec<(Vector3<f64>, f64)>,
}

/// Where a surface reaches farthest.
pub(super) struct End {
    pub(super) figure: usize,
    pub(super) point: Vector3<f64>,
    pub(super) along: Vector3<f64>,
}

/// A direction, and the changes of the figures for a move of the surface there along a vector.
struct Place {
    direction: Vector3<f64>,
    along: Vector3<f64>,
    changes: FigureVector,
}

/// Nodes of the quadrature per side of a cell, which is right to five figures, or of bodies with arms to three.
const NODES: usize = 8;

/// The curvature of a surface in the direction n.
pub(super) fn curvature(n: &Vector3<f64>, at: &PositionDerivatives) -> Curvature {
    let jet = SurfaceJet {
        place: at.point,
        slopes: at.tangents,
        bends: at.hessians,
    };
    Curvature::new(n, &jet)
}

/// The changes of area, volume and moments for a move along the normal, per area.
pub(super) fn by_move(n: &Vector3<f64>, at: &PositionDerivatives) -> SVector<f64, INTEGRALS> {
    by_move_of(&curvature(n, at), at)
}

/// The same where the curvature is known.
pub(super) fn by_move_of(
    curvature: &Curvature,
    at: &PositionDerivatives,
) -> SVector<f64, INTEGRALS> {
    list(&Moments {
        area: 2.0 * curvature.mean(),
        volume: 1.0,
        first: at.point,
        second: at.point * at.point.transpose(),
    })
}

impl Functionals {
    /// `None` if the surface is not finite.
    pub(super) fn new(functions: &Functions, surface: &Position) -> Option<Self> {
        let rule = GaussLegendre::new(NODES);
        let cells = functions.cells();
        let mut moments = Moments::default();
        let mut places = Vec::new();
        let mut points = Vec::new();
        for (n, solid_angle) in cells.iter().flat_map(|cell| cell.rectangle().nodes(&rule)) {
            let at = surface.derivatives(&n);
            let area = area_normal(&n, &at.tangents) * solid_angle;
            moments.add_element(&at.point, &area);
            points.push((at.point, solid_angle));
            let mut changes = FigureVector::zeros();
            changes
                .fixed_rows_mut::<INTEGRALS>(0)
                .copy_from(&by_move(&n, &at));
            places.push(Place {
                direction: n,
                along: area,
                changes,
            });
        }
        let grain = PositionGrain::new(Frame::SCAN, surface.clone()).ok()?;
        // Axes of nearly equal moments are turned by less than the quadrature above is right to.
        let principal = grain_properties(&grain).properties.principal()?;
        let mut end = |axis: usize, side: usize| {
            let along = principal.axes.column(axis) * [1.0, -1.0][side];
            let found = support(&grain, &along);
            let figure = INTEGRALS + 2 * axis + side;
            places.push(Place {
                direction: found.direction,
                along,
                changes: FigureVector::ith(figure, 1.0),
            });
            End {
                figure,
                point: found.point,
                along,
            }
        };
        let ends = (0..3).map(|axis| [end(axis, 0), end(axis, 1)]).collect();
        Some(Self {
            moments,
            principal,
            ends,
            places,
            points,
        })
    }

    /// The changes of the figures if the surface moved outward by so much in each direction.
    pub(super) fn moved(&self, by: impl Fn(&Vector3<f64>) -> f64) -> FigureVector {
        let each = self.places.iter();
        each.map(|place| place.changes * (place.along.norm() * by(&place.direction)))
            .sum()
    }

    /// The share of the sphere whose places are lower than an end by less than this.
    pub(super) fn share_within(&self, depth: f64, end: &End) -> f64 {
        let least = end.point.dot(&end.along) - depth;
        let points = self.points.iter();
        let near = points.filter(|(point, _)| point.dot(&end.along) > least);
        near.map(|(_, solid_angle)| solid_angle).sum::<f64>() / (4.0 * PI)
    }

    /// About the range of extents along axes between two principal ones.
    pub(super) fn range(&self, axis: usize, other: usize) -> f64 {
        let axes = &self.principal.axes;
        let length = |turn: usize| {
            let (sin, cos) = (turn as f64 * PI / TURNS as f64).sin_cos();
            let along = axes.column(axis) * cos + axes.column(other) * sin;
            let heights = self.points.iter().map(|(point, _)| point.dot(&along));
            let none = (f64::INFINITY, f64::NEG_INFINITY);
            let (low, high) = heights.fold(none, |(low, high), h| (h.min(low), h.max(high)));
            high - low
        };
        let lengths: Vec<f64> = (0..TURNS).map(length).collect();
        let most = lengths.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        most - lengths.into_iter().fold(f64::INFINITY, f64::min)
    }

    /// From one end of a principal axis to the other.
    pub(super) fn span(&self, axis: usize) -> Vector3<f64> {
        let [high, low] = &self.ends[axis];
        high.point - low.point
    }

    /// The extent along a principal axis.
    pub(super) fn length(&self, axis: usize) -> f64 {
        self.principal.axes.column(axis).dot(&self.span(axis))
    }

    /// The derivatives of the figures by the coefficients, in a column each.
    pub(super) fn gradients(&self, functions: &Functions) -> Vec<Mat<f64>> {
        let mut sums = no_sums(functions, FIGURES);
        let directions: Vec<_> = self.places.iter().map(|place| place.direction).collect();
        for rows in functions.rows(&directions) {
            for figure in 0..FIGURES {
                let change = |member: &u32| {
                    let place = &self.places[*member as usize];
                    place.along * place.changes[figure]
                };
                let changes: Vec<_> = rows.members.iter().map(change).collect();
                add_adjoint(&mut sums, figure, &rows, &changes);
            }
        }
        sums
    }
}
