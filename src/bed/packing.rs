//! How much of a bed is filled: points in strata, two in each, of which it is told whether they lie in a grain.

use super::body::Body;
use super::grain::GrainKind;
use super::settings::Container;
use super::settle::Bed;
use nalgebra::{Matrix3, Point3, Vector3};
use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, StandardUniform};
use rayon::prelude::*;
use serde::Serialize;
use std::collections::HashMap;

/// Height of a layer, in mean diameters.
const LAYER: f64 = 0.5;

/// Strata along a mean diameter.
const STRATA: f64 = 10.0;

/// Most strata of a layer and along one of its sides: those of wide beds are larger.
const MOST_STRATA: f64 = 4e6;
const MOST_ALONG: f64 = 1e4;

/// Most layers: a bed that is higher has run away.
const MOST_LAYERS: f64 = 1e5;

/// How far the core keeps from side walls, in mean diameters, and from the floor, in layers.
const FROM_SIDES: f64 = 2.0;
const LAYERS_FROM_FLOOR: usize = 3;

/// Width of the core at least, in mean diameters.
const LEAST_WIDTH: f64 = 1.0;

/// Share of the centres that lie below the surface of the bed; what is told of a bed keeps a diameter below it.
const BELOW_SURFACE: f64 = 0.85;

/// A share and its standard error, that of where the points are.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[non_exhaustive]
pub struct Fraction {
    /// The share that is filled.
    pub value: f64,
    /// Its standard error.
    pub error: f64,
}

/// How densely a bed is packed.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[non_exhaustive]
pub struct Packing {
    /// Two diameters off the side walls, 1.5 off the floor, one below the surface; `None` if not half a diameter of height
    /// or one of width is left.
    pub core: Option<Fraction>,
    /// From wall to wall, from the floor to one diameter below the surface; `None` if that is not half a diameter.
    pub whole: Option<Fraction>,
    /// The height below which 85 % of the centres lie, in metres.
    pub surface: f64,
    /// Layers of half a diameter, from the floor to the surface.
    pub layers: Vec<Layer>,
}

/// A layer of a bed.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[non_exhaustive]
pub struct Layer {
    /// From this height, in metres.
    pub from: f64,
    /// To this height, in metres.
    pub to: f64,
    /// Two diameters off the side walls, where a diameter is left between.
    pub core: Option<Fraction>,
    /// From wall to wall.
    pub whole: Option<Fraction>,
}

/// Sums over strata of what was hit there (h) and what was asked (m), two points each; the error of h/m is that of the
/// differences within strata.
#[derive(Debug, Clone, Copy, Default)]
struct Tally {
    hits: f64,
    points: f64,
    /// Sums of the differences' squares and product.
    hits_squared: f64,
    points_squared: f64,
    product: f64,
}

impl Tally {
    fn add(&mut self, pair: [Option<bool>; 2]) {
        let hit = |point: Option<bool>| f64::from(u8::from(point == Some(true)));
        let asked = |point: Option<bool>| f64::from(u8::from(point.is_some()));
        let [h, other_h] = pair.map(hit);
        let [m, other_m] = pair.map(asked);
        self.hits += h + other_h;
        self.points += m + other_m;
        self.hits_squared += (h - other_h).powi(2);
        self.points_squared += (m - other_m).powi(2);
        self.product += (h - other_h) * (m - other_m);
    }

    fn with(self, other: Self) -> Self {
        Self {
            hits: self.hits + other.hits,
            points: self.points + other.points,
            hits_squared: self.hits_squared + other.hits_squared,
            points_squared: self.points_squared + other.points_squared,
            product: self.product + other.product,
        }
    }

    fn fraction(&self) -> Option<Fraction> {
        let value = self.hits / self.points;
        let squared =
            self.hits_squared - 2.0 * value * self.product + value * value * self.points_squared;
        (self.points > 0.0).then(|| Fraction {
            value,
            error: squared.max(0.0).sqrt() / self.points,
        })
    }
}

impl Packing {
    /// That of a bed whose fractions mean nothing: without layers too.
    pub fn without_fractions(bed: &Bed) -> Self {
        Self {
            core: None,
            whole: None,
            surface: surface(bed.bodies()),
            layers: Vec::new(),
        }
    }
}

/// How densely a bed is packed; [without fractions](Packing::without_fractions) if its surface is higher than 50 000 mean
/// diameters, or not finite, for its grains have run away.
pub fn packing(bed: &Bed) -> Packing {
    let surface = surface(bed.bodies());
    let diameter = 2.0 * mean_radius(bed);
    let thickness = LAYER * diameter;
    let count = (surface / thickness).floor().max(0.0);
    // Written so that NaN fails.
    if !(surface.is_finite() && count <= MOST_LAYERS) {
        return Packing::without_fractions(bed);
    }
    let grid = Grid::new(bed);
    let tallies = |layer: usize, below: f64| {
        grid.layer(bed.settings().container, layer, thickness, diameter, below)
    };
    let layers: Vec<[Tally; 2]> = (0..count as usize)
        .into_par_iter()
        .map(|layer| tallies(layer, f64::INFINITY))
        .collect();
    let below = surface - diameter;
    let whole_layers = (below / thickness).floor().max(0.0) as usize;
    let cut = tallies(whole_layers, below);
    // What is thinner than a layer holds too few points for an error.
    let over = |at: usize, first: usize| {
        let layers = layers.get(first..whole_layers)?.iter().chain([&cut]);
        let sum = layers.fold(Tally::default(), |sum, tally| sum.with(tally[at]));
        sum.fraction().filter(|_| first < whole_layers)
    };
    let told = layers.iter().enumerate().map(|(layer, tally)| Layer {
        from: layer as f64 * thickness,
        to: (layer + 1) as f64 * thickness,
        core: tally[0].fraction(),
        whole: tally[1].fraction(),
    });
    Packing {
        core: over(0, LAYERS_FROM_FLOOR),
        whole: over(1, 0),
        surface,
        layers: told.collect(),
    }
}

fn mean_radius(bed: &Bed) -> f64 {
    let radii = bed
        .bodies()
        .iter()
        .map(|body| bed.kinds()[body.kind].radius);
    radii.sum::<f64>() / bed.bodies().len() as f64
}

fn surface(bodies: &[Body]) -> f64 {
    let mut heights: Vec<f64> = bodies.iter().map(|body| body.position.z).collect();
    heights.sort_by(f64::total_cmp);
    heights[((heights.len() as f64 * BELOW_SURFACE) as usize).min(heights.len() - 1)]
}

/// The grains by where they are.
struct Grid<'a> {
    kinds: &'a [GrainKind],
    bodies: Vec<(&'a Body, Matrix3<f64>)>,
    /// The width of a cell.
    width: f64,
    /// The grains whose reach a cell is in, wholly or not.
    cells: HashMap<[i64; 3], Vec<u32>>,
}

impl<'a> Grid<'a> {
    fn new(bed: &'a Bed) -> Self {
        let bodies = bed.bodies().iter().map(|body| (body, body.axes()));
        let reach = bed.kinds().iter().map(|kind| kind.reach);
        let mut grid = Self {
            kinds: bed.kinds(),
            bodies: bodies.collect(),
            width: reach.fold(0.0, f64::max),
            cells: HashMap::new(),
        };
        for (number, body) in bed.bodies().iter().enumerate() {
            let reach = Vector3::repeat(grid.kinds[body.kind].reach);
            let [from, to] = [-reach, reach].map(|aside| grid.cell(&(body.position + aside)));
            for x in from[0]..=to[0] {
                for y in from[1]..=to[1] {
                    for z in from[2]..=to[2] {
                        let cell = grid.cells.entry([x, y, z]).or_default();
                        cell.push(number as u32);
                    }
                }
            }
        }
        grid
    }

    fn cell(&self, point: &Point3<f64>) -> [i64; 3] {
        [0, 1, 2].map(|axis| (point[axis] / self.width).floor() as i64)
    }

    /// Whether a grain holds a point.
    fn is_filled(&self, point: &Point3<f64>) -> bool {
        let near = self.cells.get(&self.cell(point)).into_iter().flatten();
        near.into_iter().any(|&number| {
            let (body, axes) = &self.bodies[number as usize];
            let kind = &self.kinds[body.kind];
            let aside: Vector3<f64> = point - body.position;
            aside.norm_squared() < kind.reach * kind.reach && kind.holds(&axes.tr_mul(&aside))
        })
    }

    /// The core's and the whole's part of a layer, as far as that is below a height.
    fn layer(
        &self,
        container: Container,
        layer: usize,
        thickness: f64,
        diameter: f64,
        below: f64,
    ) -> [Tally; 2] {
        let (from, sides) = match container {
            Container::Box(sides) => ([0.0; 2], sides),
            Container::Cylinder(radius) => ([-radius; 2], [2.0 * radius; 2]),
        };
        // How far a place is from the side walls.
        let inwards = |x: f64, y: f64| match container {
            Container::Box([width, depth]) => x.min(width - x).min(y).min(depth - y),
            Container::Cylinder(radius) => radius - x.hypot(y),
        };
        let inmost = inwards(from[0] + sides[0] / 2.0, from[1] + sides[1] / 2.0);
        let has_core = inmost >= (FROM_SIDES + LEAST_WIDTH / 2.0) * diameter;
        let levels = (LAYER * STRATA).round();
        let finest = diameter / STRATA;
        let coarsest = (sides[0] * sides[1] * levels / MOST_STRATA).sqrt();
        let width = finest.max(coarsest);
        let counts = [0, 1].map(|axis| (sides[axis] / width).ceil().clamp(1.0, MOST_ALONG));
        let [columns, rows] = counts.map(|count| count as usize);
        let size = Vector3::new(
            sides[0] / counts[0],
            sides[1] / counts[1],
            thickness / levels,
        );
        let mut random = ChaCha8Rng::seed_from_u64(0);
        random.set_stream(layer as u64);
        let mut tallies = [Tally::default(); 2];
        for stratum in 0..columns * rows * levels as usize {
            let (x, y, z) = (
                stratum % columns,
                stratum / columns % rows,
                stratum / (columns * rows),
            );
            let corner = Vector3::new(x as f64, y as f64, z as f64);
            let found = [(); 2].map(|()| {
                let lot: [f64; 3] = StandardUniform.sample(&mut random);
                let place = (corner + Vector3::from(lot)).component_mul(&size);
                let base = Point3::new(from[0], from[1], layer as f64 * thickness);
                let point = base + place;
                let inwards = inwards(point.x, point.y);
                let is_asked = inwards >= 0.0 && point.z <= below;
                let is_filled = is_asked.then(|| self.is_filled(&point));
                [
                    is_filled.filter(|_| has_core && inwards >= FROM_SIDES * diameter),
                    is_filled,
                ]
            });
            for (at, tally) in tallies.iter_mut().enumerate() {
                tally.add(found.map(|point| point[at]));
            }
        }
        tallies
    }
}
