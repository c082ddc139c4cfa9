//! Blended grains whose expansions differ from cell to cell, so that only the weights can join them.

use grainform::StarGrain;
use grainform::model::{Blended, Family, Frame, Segmented, Whole};
use grainform::sphere::{AngularPartition, Cover, CubeCell, coefficient_count};
use nalgebra::{Matrix3, Point3, Rotation3, Vector3};

/// The radius that expansions vary about.
pub(crate) const RADIUS: f64 = 5.0;

/// A small generator of numbers in [-1, 1).
pub(crate) fn numbers(seed: u64) -> impl FnMut() -> f64 {
    let mut state = seed;
    move || {
        state = state
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        (state >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
    }
}

/// Uniform cells, of which some are quartered, some of their quarters too, and so on.
pub(crate) fn ragged(parts: u16, splits: usize, seed: u64) -> Vec<CubeCell> {
    let mut next = numbers(seed);
    let mut cells = CubeCell::uniform(parts);
    for _ in 0..splits {
        let at = (0.5 * (next() + 1.0) * cells.len() as f64) as usize;
        if cells[at].parts < 8 {
            let cell = cells.swap_remove(at);
            cells.extend(cell.quarters());
        }
    }
    cells
}

/// Coefficients of degree 0 to 3 in turn: a sphere, with changes of some per cent.
fn coefficients(cells: usize, seed: u64) -> Vec<Vec<f64>> {
    let mut next = numbers(seed);
    (0..cells)
        .map(|cell| {
            let count = coefficient_count(3 - cell % 4);
            let mut own: Vec<f64> = (0..count).map(|_| 0.02 * RADIUS * next()).collect();
            own[0] += RADIUS;
            own
        })
        .collect()
}

/// A frame whose axes are none of the scan's.
pub(crate) fn turned() -> Frame {
    Frame {
        centre: Point3::new(3.0, -70.0, 11.0),
        axes: *Rotation3::new(Vector3::new(0.7, -1.9, 0.4)).matrix(),
    }
}

/// The frame of the scan itself.
pub(crate) fn plain() -> Frame {
    Frame {
        centre: Point3::origin(),
        axes: Matrix3::identity(),
    }
}

/// A grain of blended cells.
pub(crate) fn blended(cells: Vec<CubeCell>, frame: Frame) -> StarGrain {
    blended_within(cells, grainform::sphere::MARGIN, frame)
}

/// A grain of cells that blend within so many widths.
pub(crate) fn blended_within(cells: Vec<CubeCell>, margin: f64, frame: Frame) -> StarGrain {
    let cover = Cover::with_margin(cells, margin).expect("a cover");
    let coefficients = coefficients(cover.cells().len(), 5);
    let surface = Blended::new(cover, coefficients).expect("sound");
    StarGrain::new(frame, Family::Blended(surface)).expect("a frame")
}

/// A grain of independent segments.
pub(crate) fn segmented(per_angle: usize, frame: Frame) -> StarGrain {
    let partition = AngularPartition::new(per_angle);
    let coefficients = coefficients(partition.segments(), 8);
    let surface = Segmented::new(partition, coefficients).expect("sound");
    StarGrain::new(frame, Family::Segmented(surface)).expect("a frame")
}

/// A grain of one expansion of the whole sphere: a sphere, with changes of some per cent that fall off
/// with the degree.
pub(crate) fn whole(degree: usize, frame: Frame) -> StarGrain {
    let mut next = numbers(11);
    let size = |l: usize| 0.3 * RADIUS / (1 + l).pow(2) as f64;
    let mut own: Vec<f64> = (0..coefficient_count(degree))
        .map(|index| size(index.isqrt()) * next())
        .collect();
    own[0] = RADIUS * (4.0 * std::f64::consts::PI).sqrt();
    let surface = Whole::new(own).expect("sound");
    StarGrain::new(frame, Family::Whole(surface)).expect("a frame")
}

/// Uniform and adaptive covers, in the frame given.
pub(crate) fn all(frame: Frame) -> Vec<StarGrain> {
    let mut lists: Vec<Vec<CubeCell>> = [1, 2, 3].map(CubeCell::uniform).into();
    lists.extend((0..3).map(|seed| ragged(1, 14, seed)));
    lists.push(ragged(3, 10, 7));
    let mut grains: Vec<StarGrain> = lists
        .into_iter()
        .map(|cells| blended(cells, frame))
        .collect();
    for (seed, margin) in (3..).zip([0.5, 0.6, 1.0]) {
        grains.push(blended_within(CubeCell::uniform(2), margin, frame));
        grains.push(blended_within(ragged(1, 14, seed), margin, frame));
    }
    grains
}

/// Where a blend may go wrong, in the grain's own frame: the axes, edges and corners of the cube,
/// and corners, borders and ends of margins of all cells.
pub(crate) fn critical(grain: &StarGrain) -> Vec<Vector3<f64>> {
    let sign = |i: usize| i as f64 - 1.0;
    let mut directions: Vec<Vector3<f64>> = (0..27)
        .map(|i| Vector3::new(sign(i / 9), sign(i / 3 % 3), sign(i % 3)))
        .filter(|n| n.norm() > 0.0)
        .map(|n| n.normalize())
        .collect();
    for i in 1..8 {
        let along = i as f64 / 4.0 - 1.0;
        directions.push(Vector3::new(1.0, 1.0, along).normalize());
        directions.push(Vector3::new(-1.0, along, 1.0).normalize());
        directions.push(Vector3::new(along, -1.0, -1.0).normalize());
    }
    let Some(surface) = grain.family().blended() else {
        return directions;
    };
    for cell in surface.cover().cells() {
        let margin = surface.cover().margin();
        for s in [0.0, margin, 0.37, 0.5, 1.0 - margin, 1.0] {
            for t in [0.0, margin, 0.37, 0.5, 1.0 - margin, 1.0] {
                directions.push(cell.at(s, t));
            }
        }
    }
    directions
}

/// Directions in no particular place.
pub(crate) fn anywhere(count: usize) -> Vec<Vector3<f64>> {
    let mut next = numbers(3);
    (0..count)
        .map(|_| Vector3::new(next(), next(), next()).normalize())
        .collect()
}

/// Four tangents of a direction.
pub(crate) fn tangents(n: &Vector3<f64>) -> [Vector3<f64>; 4] {
    let first = n.cross(&Vector3::ith(n.iamin(), 1.0)).normalize();
    let second = n.cross(&first);
    [
        first,
        second,
        (first + second).normalize(),
        (first - second * 2.0).normalize(),
    ]
}

/// The direction at an angle from `n` towards a tangent.
pub(crate) fn towards(n: &Vector3<f64>, tangent: &Vector3<f64>, angle: f64) -> Vector3<f64> {
    n * angle.cos() + tangent * angle.sin()
}
