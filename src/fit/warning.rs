//! What a user should know of a scan and its fit, as data; sentences are made where they are shown.

use super::candidate::Rejection;
use crate::measure::{FacesDefect, Fill, SelfCrossing};
use nalgebra::{Point3, Vector3};

/// Something odd about a scan or its fit that did not stop it.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub enum FitWarning {
    /// The scan's faces do not say what is inside: the surface is fitted to their points, and the reference is the
    /// triangulation of these points' directions.
    FacesNotClosed(FacesDefect),
    /// Vertices that subdivision put on the flat faces of a coarser mesh were left out.
    Subdivided {
        /// Their number.
        made: usize,
        /// Vertices of the scan.
        points: usize,
    },
    /// Small holes between the scan's faces were closed in the reference.
    Filled(Fill),
    /// Few large faces among small ones close what may have been a hole or a cut.
    Closing {
        /// Their share of the area.
        share: f64,
    },
    /// The scan's faces go through themselves, by little.
    SelfCrossing(SelfCrossing),
    /// Parts of the faces that are too small for bodies were left out.
    Dust {
        /// Their number.
        parts: usize,
    },
    /// Hollows in the scan, too small to be refused or in the largest of several bodies, were left out: the fitted surface has none.
    Pores {
        /// Their number.
        pores: usize,
        /// What they enclose, as a share of what the scan's outer surface does.
        share: f64,
    },
    /// All bodies but the largest were left out, as asked for.
    OthersLeftOut {
        /// Their number.
        others: usize,
    },
    /// The scan has a neck, at which [`split`](crate::scan::split) would cut its points apart.
    Neck,
    /// A place stands in many rows, and counts once.
    Repeated {
        /// The place, in the scan's frame.
        place: Point3<f64>,
        /// How often it stands there.
        times: usize,
    },
    /// Points that the scan holds twice, a little apart, were replaced by their means.
    Twins {
        /// Points that it is fewer.
        twins: usize,
        /// Points of the scan.
        points: usize,
    },
    /// The points seem to be means over the cells of a grid, and lie within a round surface.
    Averaged {
        /// Side of the cells.
        cell: f64,
        /// Share by which lengths are too small, about.
        share: f64,
    },
    /// The points seem to lie in two layers, and the surface goes between them.
    Layers {
        /// How far they are apart, in the scan's unit, about.
        apart: f64,
        /// The same as a share of the radius.
        share: f64,
    },
    /// Points that stand apart from their neighbours were left out.
    Strays {
        /// Their number.
        strays: usize,
        /// Points of the scan.
        points: usize,
    },
    /// Points that stand alone, far from the estimate, were left out.
    Outliers {
        /// Their number.
        outliers: usize,
    },
    /// Many points lay off the surface to one side, farther than noise puts them; all that are so far off were left out.
    OneSided {
        /// Their number.
        points: usize,
    },
    /// No point lies within an angle of some direction: the surface there is a guess.
    Gap {
        /// The angle, in radians.
        half_angle: f64,
        /// The direction, in the scan's frame.
        direction: Vector3<f64>,
    },
    /// Area or volume are larger than those of the scan's closed faces, and no error is known.
    BeyondFaces {
        /// Share of the area.
        area: f64,
        /// Share of the volume.
        volume: f64,
    },
    /// The surface is longer, wider or thicker than its points, and no error is known.
    BeyondPoints {
        /// Length, width and thickness of the surface.
        dimensions: Vector3<f64>,
        /// Extents of the points along the same axes.
        of_points: Vector3<f64>,
    },
    /// Some point is far from the surface.
    NotFollowed {
        /// Largest distance, in the scan's unit.
        largest: f64,
        /// The same as a share of the mean radius.
        share: f64,
        /// Whether it is taken along the ray from the grain's centre, or else along a normal of the surface.
        is_along_ray: bool,
    },
    /// Positions go out to few points, of ones without faces, that a radius, which follows all others, does not reach.
    StandsOut,
    /// Part of the surface faces away from the best centre and is smoothed over.
    NotStarShaped {
        /// Its share of the area.
        share: f64,
    },
    /// The surface is turned over in places.
    TurnedOver {
        /// Samples at which it is.
        samples: usize,
    },
    /// That the radius is above zero everywhere could not be proved.
    Unproved {
        /// The least one that was met, in the scan's unit.
        found: f64,
    },
    /// The mirror images of the scan differ.
    Asymmetric {
        /// Root mean square difference, as a share of the mean radius.
        share: f64,
    },
    /// The candidate that was chosen had been rejected, for want of a better one.
    Rejected {
        /// Why.
        reason: Rejection,
        /// Its number of segments.
        segments: usize,
        /// Whether it was the only candidate.
        is_only: bool,
    },
    /// Points that were held out are much farther from the surface than points are from the surfaces through their neighbours.
    FarFromNeighbours {
        /// Root mean square distance of points that were held out, in the scan's unit.
        rms: f64,
        /// That of points from the surfaces through their neighbours, or what is good enough.
        scatter: f64,
    },
    /// The noise that the estimate tells is much more than points scatter about the surfaces through their neighbours.
    NoiseBeyondScatter {
        /// The noise, as standard deviation in the scan's unit.
        noise: f64,
        /// That scatter, or what is good enough.
        scatter: f64,
    },
    /// The segments do not come within the limit of the estimate.
    LimitNotMet {
        /// Root mean square difference from the estimate, in the scan's unit.
        rms: f64,
        /// The limit.
        limit: f64,
    },
}
