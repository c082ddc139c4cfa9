//! Warnings as sentences.

use super::labels::Labels;
use super::number::{percent, short};
use crate::digits::{plural, significant};
use crate::fit::{FitWarning, Rejection};
use crate::measure::{FacesDefect, Fill, share_of_area};
use crate::unit::Unit;
use nalgebra::Vector3;
use std::fmt;

impl fmt::Display for Rejection {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Skipped => write!(
                f,
                "skipped: one with fewer coefficients is within the limit"
            ),
            Self::Unsupported { degree } => {
                write!(f, "too few points for degree {degree}")
            }
            Self::Misses { worst } => {
                write!(f, "misses a point by {:.0} % of its radius", 100.0 * worst)
            }
            Self::Tears { by } => write!(f, "tears at a seam by {:.0} % of the radius", 100.0 * by),
        }
    }
}

impl fmt::Display for FitWarning {
    /// Lengths and areas are in the scan's unit, which is not named.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.write(f, Labels(None))
    }
}

/// A warning whose lengths and areas are told with their unit.
struct Labelled<'a>(&'a FitWarning, Labels);

impl fmt::Display for Labelled<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.0.write(f, self.1)
    }
}

impl FitWarning {
    fn write(&self, f: &mut fmt::Formatter<'_>, labels: Labels) -> fmt::Result {
        match *self {
            Self::FacesNotClosed(FacesDefect::Open { holes, share, .. }) => write!(
                f,
                "Closing the holes between the faces ({holes}) would take {}, and is left: the \
                 surface is fitted to the faces, and compared with the triangulation of their points' directions.",
                share_of_area(share)
            ),
            Self::FacesNotClosed(defect) => write!(
                f,
                "What the faces enclose cannot be told, for {defect}: the surface is fitted to the faces, and compared \
                 with the triangulation of their points' directions."
            ),
            Self::Subdivided { made, points } => write!(
                f,
                "{made} of {points} vertices lie on the edges and faces of a coarser mesh, where subdivision puts them: they \
                 tell nothing of the grain, and the others are fitted."
            ),
            Self::Filled(Fill {
                holes, edges, area, ..
            }) => write!(
                f,
                "{} in the surface that the fit is compared with: {edges} edges, and {}{} of its area.",
                match holes {
                    1 => "A small hole was closed".into(),
                    _ => format!("{holes} small holes were closed"),
                },
                short(area),
                labels.area()
            ),
            Self::Closing { share } => write!(
                f,
                "Few large faces among small ones, {} % of the area, close what may have been a hole: there the figures and \
                 their errors are those of these faces, whatever the grain is like.",
                significant(100.0 * share, 2)
            ),
            Self::SelfCrossing(crossing) => write!(
                f,
                "Of the scan, {crossing}: so may be what the fit is compared with."
            ),
            Self::Dust { parts } => write!(
                f,
                "{} left out: each has below 1 % of the area of the faces.",
                match parts {
                    1 => "A detached part was".into(),
                    _ => format!("{parts} detached parts were"),
                }
            ),
            Self::Pores { pores, share } => write!(
                f,
                "The scan has {} in it, which the fitted surface has not: area and volume are those of the grain \
                 without hollows, and these make {} % of its volume.",
                plural(pores, "hollow"),
                significant(100.0 * share, 2)
            ),
            Self::OthersLeftOut { others: 1 } => {
                write!(f, "Another body was left out; the largest was kept.")
            }
            Self::OthersLeftOut { others } => {
                write!(
                    f,
                    "{others} other bodies were left out; the largest was kept."
                )
            }
            Self::Neck => write!(
                f,
                "The scan has a neck, as of two grains that touch: if these are two, cut them apart (grainform split does, of points \
                 without faces)."
            ),
            Self::Repeated { place, times } => write!(
                f,
                "{times} points stand at one place, ({}, {}, {}), and count as one: scanners write one place for all that they \
                 do not see. If it is no place of the grain, take them out.",
                place.x, place.y, place.z
            ),
            Self::Twins { twins, points } => write!(
                f,
                "The scan seems to hold its points more than once, a little apart: {twins} of {points} points lie next \
                 to others, and their means are fitted."
            ),
            Self::Averaged { cell, share } => write!(
                f,
                "The points seem to be means over the cells of a grid, {}{} wide, as voxel filters make them: they lie within a \
                 round surface, and sizes are too small, by some {:.1} % of the volume. Thin clouds by taking some of the points.",
                significant(cell, 3),
                labels.length(),
                300.0 * share
            ),
            Self::Layers { apart, .. } => write!(
                f,
                "The points seem to lie in two layers, some {}{} apart, as of scans from several sides that are not laid onto \
                 each other, or of voxels: the surface goes between them, and its size is known to half of that.",
                significant(apart, 2),
                labels.length()
            ),
            Self::Strays { strays: 1, points } => write!(
                f,
                "1 of {points} points is nearer to the centre or farther from it than its neighbours by more than 10 % of the \
                 radius, and was left out."
            ),
            Self::Strays { strays, points } => write!(
                f,
                "{strays} of {points} points are nearer to the centre or farther from it than their neighbours by more than 10 % of \
                 the radius, and were left out."
            ),
            Self::Outliers { outliers: 1 } => {
                write!(
                    f,
                    "1 point lies far off the surface, where few others do, and was left out."
                )
            }
            Self::Outliers { outliers } => write!(
                f,
                "{outliers} points lie far off the surface, where few others do, and were left out."
            ),
            Self::OneSided { points } => write!(
                f,
                "{points} points lie farther off the surface than noise puts them, most of them on one side, \
                 and were left out as dust or glare; figures do not hold them if they are hairs, spines or edges of the grain, or \
                 a view that was registered off."
            ),
            Self::Gap {
                half_angle,
                direction,
            } => write!(
                f,
                "No point lies within {:.0} degrees of the direction ({:.2}, {:.2}, {:.2}): the surface \
                 there is a guess, and errors hold no furrow or tip that it may hide.",
                half_angle.to_degrees(),
                direction.x,
                direction.y,
                direction.z
            ),
            Self::BeyondFaces { area, volume } => write!(
                f,
                "The surface has {} area and {} volume beside the scan's own closed faces, and it is not known which are right: \
                 between coarse faces it may ripple. Where the faces are the body, take the figures of the scan (grainform measure).",
                percent(area),
                percent(volume)
            ),
            Self::BeyondPoints {
                dimensions,
                of_points,
            } => write!(
                f,
                "The surface reaches beyond its points: {}{unit} beside {}{unit}. Next to sharp edges and tips it ripples, and sizes are \
                 known no better than these differ.",
                sides(&dimensions),
                sides(&of_points),
                unit = labels.length()
            ),
            Self::NotFollowed {
                largest,
                share,
                is_along_ray,
            } => {
                let (off, reason) = match is_along_ray {
                    true => (
                        "Along its ray a point is",
                        "Few points lie there where the grain is steep, or something",
                    ),
                    false => (
                        "A point is",
                        "The surface does not reach so far, and something",
                    ),
                };
                write!(
                    f,
                    "{off} {}{} from the surface, {:.0} % of the mean radius. {reason} sticks out of the grain, such as a stalk or \
                     what held it: take that out of the scan if it is not the grain's.",
                    short(largest),
                    labels.length(),
                    100.0 * share
                )
            }
            Self::StandsOut => f.write_str(
                "All but few points lie on a grain that a radius follows, and this surface goes out to those few. If they are dust, a \
                 stalk or what held the grain, take them out of the scan: sizes and their errors are those of all of it.",
            ),
            Self::NotStarShaped { share } => write!(
                f,
                "The surface is not quite star-shaped: {:.2} % of its area faces away from the best \
                 centre and is smoothed over.",
                100.0 * share
            ),
            Self::TurnedOver { samples } => write!(
                f,
                "The surface is turned over at {}, as beside a sharp rim: nothing tells by how much its area, volume and \
                 curvature are off.",
                plural(samples, "sample")
            ),
            Self::Unproved { found } => write!(
                f,
                "The radius could not be shown to be above zero everywhere; the least that was met is {}{}. A file of the \
                 model may be refused: ask for a lower degree, or for more segments.",
                short(found),
                labels.length()
            ),
            Self::Asymmetric { share } => write!(
                f,
                "The scan is not symmetric about these planes: its mirror images differ by {:.1} % of \
                 the mean radius (RMS), and the surface is their mean. Turn the scan so that its axes \
                 are normal to its planes of symmetry, or fit it without mirrors.",
                100.0 * share
            ),
            Self::Rejected {
                reason,
                segments,
                is_only,
            } => rejected(f, reason, segments, is_only),
            Self::FarFromNeighbours { rms, scatter } => write!(
                f,
                "Points that were held out are {}{unit} (RMS) off the surface, {:.1} times as far as points are off the \
                 surfaces through their neighbours: it does not follow the scan everywhere. Scan more densely where the \
                 grain is narrow, or fit a mesh of the points.",
                short(rms),
                rms / scatter,
                unit = labels.length()
            ),
            Self::NoiseBeyondScatter { noise, scatter } => write!(
                f,
                "The estimate takes {}{unit} for noise, {:.1} times what points scatter about the surfaces through their neighbours: \
                 part of it is shape that the surface does not follow. Scan more densely where the grain is narrow, or fit a mesh of \
                 the points.",
                short(noise),
                noise / scatter,
                unit = labels.length()
            ),
            Self::LimitNotMet { rms, limit } => write!(
                f,
                "The segments differ from the estimate by {}{unit} (RMS), more than the limit of {}{unit}: allow more \
                 of them (--max-segments) or a larger error (--tolerance), or ask for one expansion (--segments 1).",
                short(rms),
                short(limit),
                unit = labels.length()
            ),
        }
    }
}

fn rejected(
    f: &mut fmt::Formatter<'_>,
    reason: Rejection,
    segments: usize,
    is_only: bool,
) -> fmt::Result {
    let advice = "Area, volume and inertia, where they are told, are as good as their deviations say; look at the mesh before \
                  relying on details of the surface.";
    match reason {
        Rejection::Unsupported { degree } if segments == 1 => write!(
            f,
            "There are too few points for degree {degree}; the surface was fitted at the largest degree \
             that they support."
        ),
        Rejection::Unsupported { degree } => write!(
            f,
            "No segment holds the points that degree {degree} needs; each was fitted at the largest \
             degree that its points support."
        ),
        _ if is_only => write!(f, "This fit {reason}. {advice}"),
        _ => write!(
            f,
            "Every candidate misses a point or tears at a seam by more than 8 % of the radius; the one \
             with the least held-out error was taken, and it {reason}. {advice}"
        ),
    }
}

fn sides(lengths: &Vector3<f64>) -> String {
    let sides = lengths.iter().map(|&side| short(side));
    sides.collect::<Vec<_>>().join(" x ")
}

/// The sentences of a reader's and a fit's warnings; lengths with their unit, if it is known.
pub(crate) fn sentences(
    of_scan: &[String],
    of_fit: &[FitWarning],
    unit: Option<Unit>,
) -> Vec<String> {
    let of_fit = of_fit
        .iter()
        .map(|warning| Labelled(warning, Labels(unit)).to_string());
    of_scan.iter().cloned().chain(of_fit).collect()
}
