//! Why a fit cannot be made.

use super::context::Cancelled;
use super::position::map::MapError;
use crate::digits::{plural, significant};
use crate::measure::SelfCrossing;
use crate::model::InvalidGrain;
use crate::sphere::Symmetry;
use nalgebra::{Point3, Vector3};

/// Why a fit cannot be made.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum FitError {
    /// The number of segments is not a square: each angle is cut in the same number of parts.
    #[error(
        "{segments} segments cannot be made: both angles are cut in k equal parts, so ask for a \
         square, {below} or {above}"
    )]
    SegmentsNotSquare {
        /// The number asked for.
        segments: usize,
        /// The nearest square below.
        below: usize,
        /// The nearest square above.
        above: usize,
    },
    /// No uniform cover of the cube's faces has this number of cells.
    #[error(
        "{segments} segments cannot be blended: ask for 1, or for 6 n^2 cells on the faces of a cube \
         such as {below} or {above}, or for independent segments"
    )]
    SegmentsNotOfCube {
        /// The number asked for.
        segments: usize,
        /// The nearest possible number below, 6 at least.
        below: usize,
        /// The next one above that.
        above: usize,
    },
    /// Segments are asked for, and mirrors too.
    #[error(
        "a fit with mirror planes is one expansion: neither independent segments nor a number of \
         segments can be asked for with it"
    )]
    SymmetryOfSegments,
    /// The axes of a prepared scan follow from its mirror planes.
    #[error("the scan was prepared for other mirror planes than the fit asks for")]
    OtherSymmetry,
    /// A setting is outside of its range.
    #[error("{setting} is {value}; it must be from {least} to {most}")]
    OutOfRange {
        /// Name of the setting.
        setting: &'static str,
        /// The value asked for.
        value: usize,
        /// The smallest allowed.
        least: usize,
        /// The largest allowed.
        most: usize,
    },
    /// The estimate has no harmonics of the degree that is asked for.
    #[error(
        "an expansion of degree {asked} is asked for, but the points tell of harmonics up to degree {reached} only: \
         ask for at most that"
    )]
    DegreeOfEstimate {
        /// The degree asked for.
        asked: usize,
        /// The degree of the estimate.
        reached: usize,
    },
    /// The tolerance leaves nothing of the grain's shape.
    #[error(
        "the tolerance of {tolerance} is more than a quarter of the mean radius, {}: ask for less, such as 1 % of it (--tolerance 1%)",
        significant(*mean_radius, 3)
    )]
    WideTolerance {
        /// The tolerance asked for, in the scan's unit.
        tolerance: f64,
        /// In the scan's unit.
        mean_radius: f64,
    },
    /// The tolerance is not a positive number.
    #[error("the tolerance is {value}; it must be a positive length")]
    Tolerance {
        /// The value asked for.
        value: f64,
    },
    /// The scan has too few distinct points, or they enclose no volume.
    #[error(
        "the scan's points enclose no volume; a closed surface needs at least 4 points that do not lie in one plane, and of a \
         slender body many more"
    )]
    NoVolume,
    /// The numbers of the scan are too large or too small to compute with.
    #[error(
        "the scan is some {size:e} of its units across; area and volume of such a size cannot be written as numbers: \
         scale the scan to another unit"
    )]
    Scale {
        /// About half its length.
        size: f64,
    },
    /// The scan holds several bodies.
    #[error(
        "the scan holds at least {bodies} separate bodies, and one grain can be fitted: split it (grainform split), or \
         fit the largest (fit --largest)"
    )]
    SeveralBodies {
        /// Number of bodies.
        bodies: usize,
    },
    /// The faces are several surfaces with open rims.
    #[error(
        "the faces are at least {parts} surfaces with open rims: if they are views of one grain, merge them into one surface, or \
         save their points without faces; if they are separate grains, split them (grainform split), or fit the largest (fit \
         --largest)"
    )]
    OpenParts {
        /// Number of surfaces.
        parts: usize,
    },
    /// There are inner surfaces, which the radius of a grain cannot tell.
    #[error(
        "the scan holds {}, hollows that a fitted surface has not: keep the outer surface (--largest), and its volume is \
         that of the grain without hollows",
        plural(*cavities, "inner surface")
    )]
    Hollow {
        /// Number of inner surfaces.
        cavities: usize,
    },
    /// The scan's faces are no surface of a body: they go through themselves.
    #[error("{0}; mend the mesh, or give the points of the outside alone")]
    SelfCrossing(SelfCrossing),
    /// The fitted surface goes through the centre.
    #[error(
        "the fitted radius falls to {radius:.3e} towards ({:.2}, {:.2}, {:.2}), and so there is no body: look whether \
         the points there are of one grain, and whether there are any; else ask for a lower degree",
        direction.x, direction.y, direction.z
    )]
    NotPositive {
        /// The radius, in the scan's unit.
        radius: f64,
        /// The direction, in the scan's frame.
        direction: Vector3<f64>,
    },
    /// The radius could not be proved to be above zero.
    #[error(
        "the fitted radius could not be shown to be above zero everywhere; the least that was met is {found:.3e}: \
         look whether the points are of one grain, or ask for a lower degree"
    )]
    Unproved {
        /// The least radius that was met, in the scan's unit.
        found: f64,
    },
    /// The surface is far from the points.
    #[error(
        "the surface is off its points by {:.0} % of the mean radius (RMS): they may not be of one surface, or \
         few where it is steep, as on the rim of a plate; look for several bodies, a ring, or what the grain stands on; \
         grainform split cuts one grain out",
        100.0 * share
    )]
    FarFromPoints {
        /// Root mean square of the radial residuals, as a share of the mean radius.
        share: f64,
    },
    /// A mirrored surface is far from the points.
    #[error(
        "the surface, mirrored in {symmetry}, is off its points by {:.0} % of the mean radius (RMS): they are not alike on both sides of \
         its mirrors; leave the symmetry out, or name other mirrors",
        100.0 * share
    )]
    NotAlike {
        /// The mirrors that were asked for.
        symmetry: Symmetry,
        /// Root mean square of the radial residuals, as a share of the mean radius.
        share: f64,
    },
    /// The surface goes far beyond the points.
    #[error(
        "the surface holds {times:.1} times the volume of the polyhedron of its points: they may be too few, or not of one \
         grain; scan it more densely, or look for several bodies, or what the grain stands on; grainform split cuts one grain out"
    )]
    FarBeyondPoints {
        /// Its volume over that of the polyhedron.
        times: f64,
    },
    /// A coordinate is not finite.
    #[error("point {index} is not finite; remove it from the scan")]
    NotFinite {
        /// Index of the point.
        index: usize,
    },
    /// No centre sees (nearly) the whole surface.
    #[error(
        "{}; hooks and cups are fitted by positions (grainform fit without --surface star), rings and several bodies are not",
        not_star_shaped(*share)
    )]
    NotStarShaped {
        /// Share of the area that faces away from the best centre.
        share: f64,
    },
    /// Too many points do not belong to the surface that the others draw.
    #[error(
        "seen from the centre, {:.0} % of the points stand apart from those in neighbouring directions by more than a tenth of the \
         radius; of a grain that its centre sees whole below 1 % do: remove the background, or cut one grain out (grainform \
         split); of a body with folds, or more than some 30 times as long as it is wide or thick, only a mesh can be measured",
        100.0 * share
    )]
    Strays {
        /// Share of such points.
        share: f64,
    },
    /// Points stand apart from the surface that the others draw, and yet close to each other.
    #[error(
        "{:.1} % of the points stand apart from the surface that the centre sees by more than a tenth of the radius, and yet close \
         to each other, as outliers do not: a table under the grain, the wall of a hole, a fold, a second body, a thin stalk, or \
         the rim of a thin plate; cut the grain out with grainform split or, where that finds one grain, with a mesh editor",
        100.0 * share
    )]
    SecondSurface {
        /// Share of such points.
        share: f64,
    },
    /// Points seen in nearly the same direction lie at very different distances.
    #[error(
        "the points are not one surface round a centre: in neighbouring directions their distance \
         from it differs by {:.0} % (median), where a scanned grain shows below 5 %; it may be \
         a ring, several bodies, or a scene with its background: cut one grain out (grainform split)",
        100.0 * scatter
    )]
    Scattered {
        /// Standard deviation of the radius against the neighbours' median.
        scatter: f64,
    },
    /// The points do not determine a radius in numbers.
    #[error(
        "the points do not determine a radius in every direction; look at the scan, or fit independent segments"
    )]
    NoEstimate,
    /// The points do not determine positions in numbers, or these are not worth a fit.
    #[error(
        "the points do not determine positions over the sphere: scan more densely, or ask for fewer segments or a lower degree"
    )]
    NoPositions,
    /// Mirrors and independent segments are those of a radius.
    #[error(
        "positions over the sphere have no mirrors and no independent segments: leave --symmetry and --seams out"
    )]
    OnlyOfRadii,
    /// A surface of degree 0 is one place.
    #[error("positions of degree 0 are a point and no surface: ask for degree 1 or more")]
    PointOfDegreeZero,
    /// The fitted surface goes through itself.
    #[error(
        "the fitted surface goes through itself near ({:.4}, {:.4}, {:.4}), and so it has no volume: look whether the \
         scan does there, or is thin and has few points; scan it more densely or smooth it, or ask for other numbers \
         of cells (--segments 24, 96 or 384), of which none may do for spirals and slender arms",
        place.x, place.y, place.z
    )]
    GoesThroughItself {
        /// Where, in the scan's frame.
        place: Point3<f64>,
    },
    /// Neither a radius nor positions can be fitted to points without faces, or to voxels.
    #[error(
        "{}. Positions cannot be fitted either: {position}",
        why_no_radius(radius)
    )]
    NoKind {
        /// Why no radius can.
        radius: Box<FitError>,
        /// Why no positions can.
        position: Box<FitError>,
    },
    /// What was fitted is no surface of a body.
    #[error("no position over the sphere can be fitted: {0}")]
    NoSurface(InvalidGrain),
    /// A surface that no centre sees is fitted to faces that are closed, or to points without any.
    #[error(
        "the scan's faces are not closed, which a fit of positions over the sphere needs: close them, or fit a radius"
    )]
    NoFaces,
    /// Points without faces do not enclose anything.
    #[error(
        "the points enclose no inside: there are too few for a surface as thin as theirs, a part of it was not seen, or they \
         lie in rows far apart; scan it whole and more densely, or mesh the points"
    )]
    NoInside,
    /// The surface of points without faces has handles.
    #[error(
        "the points enclose a body with {}, as a ring has one, and no surface over the sphere has any",
        plural(*handles, "handle")
    )]
    Ring {
        /// Their number.
        handles: usize,
    },
    /// Points without faces do not tell what their surface is.
    #[error(
        "{:.1} % of the points, or of the surface found between them, lie off one another: walls are thinner than three \
         spacings of the points, or a part was not seen; scan it more densely, or mesh the points",
        100.0 * share
    )]
    OffCrust {
        /// The larger one of the two shares.
        share: f64,
    },
    /// The faces have no map to the sphere.
    #[error("no position over the sphere can be fitted: {0}")]
    NotMapped(MapError),
    /// The fit was asked to stop.
    #[error("the fit was cancelled")]
    Cancelled,
}

impl FitError {
    /// Whether it is a fault of what was fitted, so that other settings may give a body.
    pub fn is_of_fit(&self) -> bool {
        match self {
            Self::NoKind { radius, .. } => radius.is_of_fit(),
            Self::NotPositive { .. }
            | Self::Unproved { .. }
            | Self::FarFromPoints { .. }
            | Self::NotAlike { .. }
            | Self::FarBeyondPoints { .. }
            | Self::GoesThroughItself { .. } => true,
            _ => false,
        }
    }
}

fn not_star_shaped(share: f64) -> String {
    let share = 100.0 * share;
    format!(
        "the surface is not star-shaped: seen from the best centre, {share:.1} % of its area faces away, so the radius is not a \
         function of the direction"
    )
}

/// What kept a radius from being fitted, without the way out of positions.
fn why_no_radius(radius: &FitError) -> String {
    match radius {
        FitError::NotStarShaped { share } => not_star_shaped(*share),
        other => other.to_string(),
    }
}

impl From<MapError> for FitError {
    fn from(error: MapError) -> Self {
        match error {
            MapError::Cancelled => Self::Cancelled,
            error => Self::NotMapped(error),
        }
    }
}

impl From<Cancelled> for FitError {
    fn from(_: Cancelled) -> Self {
        Self::Cancelled
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn positions_are_no_way_out_where_they_were_tried() {
        let radius = FitError::NotStarShaped { share: 0.25 };
        let way_out = "fitted by positions";
        assert!(radius.to_string().contains(way_out));
        let neither = FitError::NoKind {
            radius: radius.into(),
            position: FitError::NoVolume.into(),
        };
        let told = neither.to_string();
        assert!(told.contains("25.0 % of its area") && !told.contains(way_out));
    }
}
