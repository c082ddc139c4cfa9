//! Clouds of two layers, as of scans from several sides that are not laid onto each other: a surface goes between them.
//!
//! Of neighbours by direction the heights over the smooth surface through them then fall apart in two: the variance that is left
//! when they are parted where that leaves least (Otsu 1979) is below a fifth of the whole. Of noise and detail it is so
//! in 3 % of the neighbourhoods at most. Rows, steps and edges part in two as well, but not mixed.
//!
//! Measured, of six scans, with 3000 and 10 000 points and .2 % noise, and of 500 clouds without layers:
//!
//! ```text
//! layers 3 % of the radius apart, over all of the body   told of 12 of 12, as 2.4 to 3.5 %
//! over half of the body                                  of 11 of 12
//! 1 % apart                                              of 7 of 12, as 1.0 to 1.2 %
//! none                                                   of none
//! ```
//!
//! Layers nearer than what neighbours sag by are told by what a surface that goes between them leaves of the points, as far as they are
//! some five times the noise apart: of two scans of exact points laid onto each other .4 % off, of all of five.
//!
//! Layers nearer than what neighbours scatter by are not told from noise, and those over a part of the body may be taken for dust. The
//! outermost voxels of a body seem to lie in two layers as well, in one of six: they do not lie on a smooth surface either.

use crate::fit::points::neighbours::Neighbours;
use crate::fit::points::quadric::off_quadric;
use crate::fit::points::rounder::rounder;
use crate::fit::warning::FitWarning;
use crate::scan::drawn;
use crate::sphere::across;
use crate::spread::{covariance, upper_median};
use nalgebra::{Point3, Vector2, Vector3};
use std::f64::consts::PI;

/// Fewer points are too far apart to tell.
const LEAST_POINTS: usize = 1000;

/// Neighbourhoods that are looked at, ...
const LOOKED_AT: usize = 250;

/// ... and points of each.
const NEIGHBOURS: usize = 40;

/// Points of a layer, at least.
const LEAST_OF_LAYER: usize = 8;

/// Share of the variance that is left within two layers, at most, ...
const WITHIN: f64 = 0.2;

/// ... and beside a surface that goes between them, where rounded coordinates leave .25 in the mean.
const WITHIN_BESIDE: f64 = 0.14;

/// Neighbours by which it is told whether layers lie among each other, ...
const BESIDE: usize = 4;

/// ... in so many directions, fewer pairs in one of which do not tell, and the least share of pairs of different layers: it is about
/// half at random.
const DIRECTIONS: usize = 4;
const FEW_PAIRS: f64 = 12.0;
const LEAST_MIXED: f64 = 0.2;

/// Share of the neighbourhoods that fall apart from which on a cloud does.
const LEAST_SHARE: f64 = 0.06;

/// The same beside a surface that goes between them: of rounded coordinates it is .004 at most, of layers five times the noise apart .04
/// and more.
const LEAST_SHARE_BESIDE: f64 = 0.03;

/// Share of the radius by which layers are apart, at least: what is nearer is rounding, and does no harm ...
const LEAST_APART: f64 = 1e-3;

/// ... or beside a surface that goes between them ...
const LEAST_BESIDE: f64 = 2e-4;

/// ... and over that by which a ball sags over their neighbours, of which a polynomial of second degree leaves some.
const OVER_SAG: f64 = 0.3;

/// What to know of points of a body of about unit size, if they lie in two layers; `unit` is its unit of length.
pub(super) fn layers(points: &[Point3<f64>], unit: f64) -> Option<FitWarning> {
    if points.len() < LEAST_POINTS {
        return None;
    }
    let (middle, moments) = covariance(points.iter().map(|point| point.coords));
    let (map, _) = rounder(moments)?;
    let seen = |point: &Point3<f64>| {
        let ray = map * (point.coords - middle);
        Some((ray.try_normalize(0.0)?, ray.norm()))
    };
    let (directions, radii): (Vec<_>, Vec<f64>) = points.iter().filter_map(seen).unzip();
    let neighbours = Neighbours::new(&directions);
    let some = drawn(points, LOOKED_AT);
    let apart = some.iter().filter_map(seen).map(|(n, _)| {
        let near = neighbours.nearest(&n, NEIGHBOURS);
        let near: Vec<_> = near.iter().map(|&at| (directions[at], radii[at])).collect();
        apart(&n, &near)
    });
    let share = told_by(apart, LEAST_SHARE)?;
    let lengths = points.iter().map(|point| (point.coords - middle).norm());
    let mean = lengths.sum::<f64>() / points.len() as f64;
    Some(FitWarning::Layers {
        apart: share * mean * unit,
        share,
    })
}

/// By how much two layers of neighbours in directions near one are apart, as a share of their radii, if they fall apart in two.
fn apart(n: &Vector3<f64>, near: &[(Vector3<f64>, f64)]) -> Option<f64> {
    let [u, v] = across(n);
    let radius = near.iter().map(|(_, radius)| radius).sum::<f64>() / near.len() as f64;
    let wide = near.iter().map(|(other, _)| (other - n).norm());
    let wide = wide.fold(f64::MIN_POSITIVE, f64::max);
    let places: Vec<[f64; 3]> = near
        .iter()
        .map(|(other, own)| [u.dot(other) / wide, v.dot(other) / wide, own / radius])
        .collect();
    let least = LEAST_APART.max(OVER_SAG * wide * wide / 2.0);
    parted(&places, off_quadric(&places).as_slice(), WITHIN, least)
}

/// By how much heights at places fall apart in two, if these lie among each other, are farther apart than `least`, and leave less than
/// a share of the variance within.
fn parted(places: &[[f64; 3]], heights: &[f64], within: f64, least: f64) -> Option<f64> {
    let count = heights.len();
    let mut sorted = heights.to_vec();
    sorted.sort_unstable_by(f64::total_cmp);
    let mean = heights.iter().sum::<f64>() / count as f64;
    let whole: f64 = heights.iter().map(|height| (height - mean).powi(2)).sum();
    let mut below: f64 = sorted
        .iter()
        .take(LEAST_OF_LAYER - 1)
        .map(|height| height - mean)
        .sum();
    let parted = (LEAST_OF_LAYER..=count.saturating_sub(LEAST_OF_LAYER)).map(|at| {
        below += sorted[at - 1] - mean;
        let (one, other) = (at as f64, (count - at) as f64);
        let apart = -below / one - below / other;
        let left = whole - apart * apart * one * other / count as f64;
        (left, apart, sorted[at])
    });
    let (left, apart, from) = parted.min_by(|one, other| one.0.total_cmp(&other.0))?;
    let is_parted = left < within * whole && apart > least;
    let is_above: Vec<bool> = heights.iter().map(|height| *height >= from).collect();
    (is_parted && are_mixed(places, &is_above)).then_some(apart)
}

/// By how much layers are apart that a surface goes between, as a share of the radius: of neighbours in directions what it leaves of
/// them falls apart in two. Told nearer than what neighbours sag by.
pub(in crate::fit) fn layers_beside(directions: &[Vector3<f64>], residuals: &[f64]) -> Option<f64> {
    if directions.len() < LEAST_POINTS {
        return None;
    }
    let neighbours = Neighbours::new(directions);
    let every = directions.len().div_ceil(LOOKED_AT);
    let some = directions.iter().step_by(every);
    let apart = some.map(|n| {
        let [u, v] = across(n);
        let near = neighbours.nearest(n, NEIGHBOURS);
        let places = near.iter().map(|&at| &directions[at]);
        let places: Vec<_> = places.map(|n| [u.dot(n), v.dot(n), 0.0]).collect();
        let heights: Vec<f64> = near.iter().map(|&at| residuals[at]).collect();
        parted(&places, &heights, WITHIN_BESIDE, LEAST_BESIDE)
    });
    told_by(apart, LEAST_SHARE_BESIDE)
}

/// By how much layers are apart, if more than a share of the neighbourhoods fall apart.
fn told_by(apart: impl Iterator<Item = Option<f64>>, least_share: f64) -> Option<f64> {
    let apart: Vec<Option<f64>> = apart.collect();
    let looked_at = apart.len() as f64;
    let mut told: Vec<f64> = apart.into_iter().flatten().collect();
    (told.len() as f64 > least_share * looked_at).then(|| upper_median(&mut told))?
}

/// Whether points of both layers lie among each other, as those of rows, steps and edges do not: in whatever direction neighbours
/// lie from each other, many are of different layers.
fn are_mixed(places: &[[f64; 3]], is_above: &[bool]) -> bool {
    let away = |one: usize, other: usize| {
        let [[x, y, _], [u, v, _]] = [places[one], places[other]];
        Vector2::new(u - x, v - y)
    };
    let mut pairs = [[0.0; 2]; DIRECTIONS];
    for own in 0..places.len() {
        let others = (0..places.len()).filter(|&other| other != own);
        let mut near: Vec<(f64, usize)> = others
            .map(|other| (away(own, other).norm_squared(), other))
            .collect();
        near.sort_unstable_by(|one, other| one.0.total_cmp(&other.0));
        for &(_, other) in near.iter().take(BESIDE) {
            let way = away(own, other);
            let turns = way.y.atan2(way.x) / PI + 1.0;
            let [all, apart] = &mut pairs[(turns * DIRECTIONS as f64) as usize % DIRECTIONS];
            *all += 1.0;
            *apart += f64::from(u8::from(is_above[other] != is_above[own]));
        }
    }
    let is_mixed = |[all, apart]: [f64; 2]| all < FEW_PAIRS || apart > LEAST_MIXED * all;
    pairs.into_iter().all(is_mixed)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::StarSurface;
    use crate::shapes::{Body, Octahedron, Sampling, SynthOptions, synthesize};

    /// What is told of a maize in random points with noise, each of which is moved.
    fn told(
        points: usize,
        noise: f64,
        moved: impl Fn(usize, Point3<f64>) -> Point3<f64>,
    ) -> Option<[f64; 2]> {
        let options = SynthOptions {
            sampling: Sampling::Random,
            ..SynthOptions::clean(Body::Maize)
        };
        let found = synthesize(&options.with_points(points).with_noise(noise)).unwrap();
        let all = found.points.into_iter().enumerate();
        let points: Vec<_> = all.map(|(at, point)| moved(at, point)).collect();
        layers(&points, 2.0).map(|warning| match warning {
            FitWarning::Layers { apart, share } => [apart / (2.0 * found.truth.mean_radius), share],
            other => panic!("{other:?}"),
        })
    }

    #[test]
    fn layers_are_told_and_how_far_they_are_apart() {
        for (noise, apart) in [(0.0, 0.01), (0.002, 0.02), (0.002, -0.04)] {
            let scaled = |at: usize, point: Point3<f64>| match at % 2 {
                0 => point,
                _ => point + point.coords * apart,
            };
            let [length, share] = told(6146, noise, scaled).unwrap();
            assert!(
                (share / apart.abs() - 1.0).abs() < 0.15,
                "{share} for {apart}"
            );
            assert!((length / share - 1.0).abs() < 0.05, "{length}");
        }
    }

    #[test]
    fn layers_beside_a_surface_are_told_nearer_and_noise_is_none() {
        let directions = Sampling::Random.directions(4000, 2).unwrap();
        let beside = |residual: &dyn Fn(usize) -> f64| {
            let residuals: Vec<f64> = (0..directions.len()).map(residual).collect();
            layers_beside(&directions, &residuals)
        };
        let at_random = |at: usize| (at as f64 * 12.9898).sin() * 43758.5453 % 1.0;
        let noise = |at: usize| 3e-4 * at_random(at);
        let apart = beside(&|at| noise(at) + if at % 3 == 0 { 1e-3 } else { -1e-3 }).unwrap();
        assert!((apart / 2e-3 - 1.0).abs() < 0.1, "{apart}");
        assert_eq!(beside(&noise), None);
        assert_eq!(beside(&|at| 0.8e-4 * noise(at).signum()), None);
    }

    #[test]
    fn noise_lone_points_and_rounded_coordinates_are_no_layers() {
        let same = |_, point| point;
        assert_eq!(told(6146, 0.0, same), None);
        assert_eq!(told(6146, 0.02, same), None);
        assert_eq!(
            told(6146, 0.0, |_, p| p.map(|x: f64| (10.0 * x).round() / 10.0)),
            None
        );
        let lone = |at: usize, p: Point3<f64>| if at.is_multiple_of(50) { p * 1.1 } else { p };
        assert_eq!(told(6146, 0.0, lone), None);
    }

    #[test]
    fn edges_among_rows_of_points_are_no_layers() {
        let octahedron = Octahedron {
            semi_axes: Vector3::new(1.0, 1.2, 0.8),
        };
        for sampling in [Sampling::Cube, Sampling::Rings] {
            for points in [1538, 6146] {
                let directions = sampling.directions(points, 0).unwrap().into_iter();
                let points: Vec<_> = directions
                    .map(|n| Point3::from(n * octahedron.radius(&n)))
                    .collect();
                assert_eq!(layers(&points, 1.0), None, "{sampling}");
            }
        }
    }

    #[test]
    fn of_few_points_and_of_those_in_one_place_nothing_is_told() {
        assert_eq!(
            told(800, 0.0, |at, p| if at % 2 == 0 { p } else { p * 1.05 }),
            None
        );
        assert_eq!(layers(&[Point3::origin(); 1200], 1.0), None);
    }
}
