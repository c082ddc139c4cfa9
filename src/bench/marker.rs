//! What a setting looks like in a plot: shape and colour tell the family, size and strength its rank.

use super::{BenchRow, Family};
use plotters::prelude::*;

/// How a setting does beside the others.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Rank {
    Rejected,
    Behind,
    Front,
}

impl Rank {
    pub(super) fn of(index: usize, row: &BenchRow, front: &[usize]) -> Self {
        match row.rejected {
            Some(_) => Self::Rejected,
            None if front.contains(&index) => Self::Front,
            None => Self::Behind,
        }
    }

    /// Half the width of a square of its marker's area, in pixels.
    fn size(self) -> f64 {
        match self {
            Self::Front => 5.5,
            Self::Behind | Self::Rejected => 3.5,
        }
    }

    fn opacity(self) -> f64 {
        match self {
            Self::Front => 1.0,
            Self::Behind => 0.5,
            Self::Rejected => 0.25,
        }
    }
}

/// What the legend says of a family.
pub(super) fn legend(family: Family) -> &'static str {
    match family {
        Family::Whole => "whole surface",
        Family::Uniform => "k x k segments",
        Family::Blended => "blended cells",
        Family::Adaptive => "adaptive",
        Family::Estimate => "estimate",
        Family::Superquadric => "superquadric",
        Family::Ducc0 => "ducc0, whole surface",
    }
}

fn colour(family: Family) -> RGBColor {
    match family {
        Family::Whole => RGBColor(33, 102, 172),
        Family::Uniform => RGBColor(214, 150, 46),
        Family::Blended => RGBColor(74, 154, 118),
        Family::Adaptive => RGBColor(178, 57, 62),
        Family::Estimate => RGBColor(118, 80, 150),
        Family::Superquadric => RGBColor(90, 90, 90),
        Family::Ducc0 => RGBColor(20, 20, 20),
    }
}

/// Corners of the outline of a family's marker: how many, and the turn of the first one from the
/// top, in turns.
fn corners(family: Family) -> (usize, f64) {
    match family {
        Family::Whole => (4, 0.0),
        Family::Uniform => (4, 0.125),
        Family::Blended => (3, 0.5),
        Family::Adaptive => (24, 0.0),
        Family::Estimate => (3, 0.0),
        Family::Superquadric => (6, 0.0),
        Family::Ducc0 => (5, 0.0),
    }
}

/// A filled outline about the origin, where a pixel has so many units. Markers of one rank have the
/// same area.
pub(super) fn marker(family: Family, rank: Rank, fineness: u32) -> Polygon<(i32, i32)> {
    let (count, turn) = corners(family);
    let step = std::f64::consts::TAU / count as f64;
    let area = 4.0 * rank.size().powi(2);
    let radius = f64::from(fineness) * (2.0 * area / (count as f64 * step.sin())).sqrt();
    let outline: Vec<_> = (0..count)
        .map(|corner| {
            let (x, y) = (step * corner as f64 + std::f64::consts::TAU * turn).sin_cos();
            ((radius * x).round() as i32, (-radius * y).round() as i32)
        })
        .collect();
    Polygon::new(outline, colour(family).mix(rank.opacity()).filled())
}
