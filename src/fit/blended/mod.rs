//! The blended surface with few coefficients that is within a limit of a smooth radius.
//!
//! The radius is known: it can be evaluated anywhere and has no noise, so nothing is held out, and the
//! error is measured at directions of which the fit knows nothing.
//!
//! **Rule.** Every cell of a quadtree is fitted by itself at every degree ([`local_fit`]); the cheapest
//! cover for a price per coefficient follows from these errors ([`forest`]), and the price from the
//! error that is forecast for it. All cells are then fitted together ([`joint`]), which tells by how
//! much less than the sum of its parts a cover errs, and so corrects the forecast: two to four rounds
//! meet the limit without overshooting it. Quadtrees of 6, 54, 150 ... cells compete, for each cut
//! quadruples the cells: on even texture, and where symmetry makes many cells alike, the one between
//! needs a fifth fewer coefficients.

mod between_nodes;
mod forest;
mod joint;
mod local_fit;
mod nodes;
mod patch;
mod search;
#[cfg(test)]
mod tests;

use crate::model::Blended;
use nalgebra::Vector3;

/// A smooth radius that can be evaluated anywhere.
pub(crate) trait Target: Sync {
    /// The radii in many directions, unit vectors, in their order.
    fn radii(&self, directions: &[Vector3<f64>]) -> Vec<f64>;

    /// Weight of a squared error per solid angle, above zero: 1 where space is not stretched.
    fn weight(&self, direction: &Vector3<f64>) -> f64;

    /// How long one of the radius is in plain space: 1 where space is not stretched.
    fn length(&self, _direction: &Vector3<f64>) -> f64 {
        1.0
    }
}

/// What is asked of a surface.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Settings {
    /// Degree of all cells; `None` chooses one from 1 to `max_degree` per cell.
    pub(crate) degree: Option<usize>,
    /// Largest degree chosen.
    pub(crate) max_degree: usize,
    /// 6 n^2 cells of the same size; `None` chooses cells.
    pub(crate) segments: Option<usize>,
    /// Most cells chosen, though never fewer than 6.
    pub(crate) max_segments: usize,
    /// Root of the mean squared difference from the target that is good enough, a length.
    pub(crate) limit: f64,
    /// Whether the target has detail as small as the cells.
    pub(crate) is_textured: bool,
}

#[cfg(test)]
impl Settings {
    /// Degrees up to 4 and as many cells as it takes.
    pub(crate) fn within(limit: f64) -> Self {
        Self {
            degree: None,
            max_degree: 4,
            segments: None,
            max_segments: usize::MAX,
            limit,
            is_textured: false,
        }
    }
}

/// A surface and how it was found.
#[derive(Debug, Clone)]
pub(crate) struct Outcome {
    pub(crate) surface: Blended,
    pub(crate) rounds: Vec<Round>,
    /// Which of these gave the surface.
    pub(crate) chosen: usize,
    /// Root of the mean over the sphere of weight times squared difference from the target, at
    /// directions that the fit has not used.
    pub(crate) rms: f64,
    /// Largest difference of the plain radius, found on a lattice in the cells that err most.
    pub(crate) max: f64,
    /// Whether `rms` is within the limit.
    pub(crate) met: bool,
}

/// A joint fit.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Round {
    pub(crate) cells: usize,
    /// The largest degree.
    pub(crate) degree: usize,
    pub(crate) coefficients: usize,
    /// As that of the outcome; at the directions of the fit where it is beyond the limit at them.
    pub(crate) rms: f64,
}

/// How neighbours are joined.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Blend {
    /// Margin of the cover, in widths of a cell.
    margin: f64,
    /// Weight of every expansion's own error beside that of the blend ([`joint`]).
    own: f64,
}

/// Where degrees are chosen. Without the own errors, the largest curvature of texture (harmonics up to
/// degree 20 and 30) is 4 to 44 % off at an RMS of .05 to .3 % of the mean radius; with them 0 to 14 %, at
/// up to 3 % more coefficients. Margins of .6 and .7 need as many coefficients, and touch 15 and 30 % more.
const CHOSEN: Blend = Blend {
    margin: 0.5,
    own: 7e-5,
};

/// Where the degree is given. Of degree 3 against margin .4 without own errors: on the closed-form grains
/// to .01 % of the mean radius, 16 % fewer coefficients (to .05 %, as many); at .1 % and below the mean
/// curvature errs a third to a half less.
const GIVEN: Blend = Blend {
    margin: 0.6,
    own: 7e-5,
};

/// The surface that is asked for, or the nearest found where the limit is not met within
/// `max_segments` cells and 20 000 coefficients. `None` if the target's radii or weights are not
/// finite, or the weights not above zero.
pub(crate) fn approximate(target: &dyn Target, settings: &Settings) -> Option<Outcome> {
    let blend = match settings.degree {
        Some(_) => GIVEN,
        None => CHOSEN,
    };
    search::Search::new(target, settings, blend).run()
}
