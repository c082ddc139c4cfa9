//! The part of a page about one grain.

use super::packed::Packed;
use super::{BenchPart, MeasureRow, SearchPart};
use crate::annotate::{Annotated, ScanDeviation};
use crate::measure::{
    Curvature, OrientedBox, box_along, convex_hull, mesh_properties, minimum_box,
};
use crate::model::{Grain, Surface};
use crate::report::Unit;
use crate::scan::Scan;
use nalgebra::{Matrix3, Point3, Vector3};
use rayon::prelude::*;
use serde::Serialize;
use std::f64::consts::{PI, TAU};

/// Cells along an edge of the cube of directions of the surface.
const RESOLUTION: usize = 48;

/// The most points of a scan that are shown: then every second, every third, and so on.
const MOST_POINTS: usize = 15_000;

/// Rows (polar angle) and columns (azimuth) of the maps.
const ROWS: usize = 90;
const COLUMNS: usize = 180;

/// A grain that is reported on.
#[derive(Debug)]
pub(crate) struct Subject<'a> {
    /// What it is called.
    pub name: String,
    /// The surface.
    pub grain: &'a Grain,
    /// The scan that it was fitted to.
    pub scan: Option<&'a Scan>,
    /// Unit of lengths, where it is known.
    pub unit: Option<Unit>,
    /// What it rests on and how it was made: names and values.
    pub facts: Vec<(&'static str, String)>,
    /// The table of measures.
    pub measures: Vec<MeasureRow>,
    /// What cannot be told, and what is odd: whole sentences.
    pub warnings: Vec<String>,
    /// All candidates of a search, where one was asked for.
    pub search: Option<SearchPart>,
    /// Run time and error of all families of models, where they were asked for.
    pub bench: Option<BenchPart>,
}

/// What a page shows of a grain. Places are seen from the middle of the grain.
#[derive(Debug, Clone, Serialize)]
pub(crate) struct GrainPart {
    name: String,
    unit: String,
    facts: Vec<(&'static str, String)>,
    measures: Vec<MeasureRow>,
    warnings: Vec<String>,
    search: Option<SearchPart>,
    bench: Option<BenchPart>,
    triangles: Packed,
    vertices: Packed,
    normals: Packed,
    fields: Vec<FieldPart>,
    points: Packed,
    borders: Vec<Packed>,
    /// Ends of the principal axes, two for each.
    axes: Packed,
    /// Corners of the box of least volume; the bits of their numbers are low or high along its axes.
    corners: Packed,
    rows: usize,
    columns: usize,
    maps: Vec<FieldPart>,
}

/// Numbers at vertices, or on a map.
#[derive(Debug, Clone, Serialize)]
struct FieldPart {
    name: &'static str,
    values: Packed,
}

impl GrainPart {
    /// The part about a grain.
    pub(crate) fn new(subject: Subject) -> Self {
        let grain = subject.grain;
        let deviation = subject.scan.map(|scan| ScanDeviation::new(grain, scan));
        let surface = Annotated::new(grain, RESOLUTION);
        let surface = match &deviation {
            Some(deviation) => surface.with_deviation(deviation),
            None => surface,
        };
        let solid = mesh_properties(&surface.mesh).ok();
        let middle = solid.map_or(grain.frame().centre, |solid| solid.centroid);
        let principal = solid.and_then(|solid| solid.principal());
        let axes = principal.map_or_else(Matrix3::identity, |principal| principal.axes);
        let along = box_along(&surface.mesh.vertices, &axes);
        let hull = convex_hull(&surface.mesh.vertices).ok();
        let least = hull
            .and_then(|hull| minimum_box(&hull).ok())
            .unwrap_or(along);
        let seen = |place: &Point3<f64>| place - middle;
        let triangles = surface.mesh.triangles.iter().flatten();
        let field = |name, values: &[f64]| FieldPart {
            name,
            values: Packed::floats(values.iter().copied()),
        };
        Self {
            unit: subject.unit.map_or(String::new(), |unit| unit.to_string()),
            name: subject.name,
            facts: subject.facts,
            measures: subject.measures,
            warnings: subject.warnings,
            search: subject.search,
            bench: subject.bench,
            triangles: Packed::counts(triangles.copied()),
            vertices: Packed::vectors(surface.mesh.vertices.iter().map(seen)),
            normals: Packed::units(surface.normals.iter().copied()),
            fields: surface
                .fields
                .iter()
                .map(|found| field(found.name, &found.values))
                .collect(),
            points: Packed::vectors(subject.scan.into_iter().flat_map(shown).map(seen)),
            borders: borders(grain, &middle),
            axes: Packed::vectors(ends(&axes, &along, &middle)),
            corners: Packed::vectors(corners(&least, &middle)),
            rows: ROWS,
            columns: COLUMNS,
            maps: maps(grain, deviation.as_ref()),
        }
    }
}

fn shown(scan: &Scan) -> impl Iterator<Item = &Point3<f64>> {
    let points = scan.points();
    points
        .iter()
        .step_by(points.len().div_ceil(MOST_POINTS).max(1))
}

fn borders(grain: &Grain, middle: &Point3<f64>) -> Vec<Packed> {
    let borders = grain.segment_borders();
    let place = |n: &Vector3<f64>| grain.point(n) - middle;
    let line = |border: &Vec<Vector3<f64>>| Packed::vectors(border.iter().map(place));
    borders.iter().map(line).collect()
}

/// Both ends of each axis, a little outside of the grain.
fn ends(axes: &Matrix3<f64>, along: &OrientedBox, middle: &Point3<f64>) -> Vec<Vector3<f64>> {
    let centre = axes.tr_mul(&(along.centre - middle));
    let end = |axis: usize, side: f64| {
        let direction = axes.column(axis).into_owned();
        let parallel = (0..3).max_by(|i, j| {
            let on = |i: usize| along.axes.column(i).dot(&direction).abs();
            on(*i).total_cmp(&on(*j))
        });
        let half = 0.58 * along.extents[parallel.unwrap_or(axis)];
        direction * (centre[axis] + side * half)
    };
    (0..3)
        .flat_map(|axis| [end(axis, -1.0), end(axis, 1.0)])
        .collect()
}

fn corners(found: &OrientedBox, middle: &Point3<f64>) -> Vec<Vector3<f64>> {
    let corner = |number: usize| {
        let side = |axis: usize| match number >> axis & 1 {
            0 => -0.5 * found.extents[axis],
            _ => 0.5 * found.extents[axis],
        };
        found.centre - middle + found.axes * Vector3::new(side(0), side(1), side(2))
    };
    (0..8).map(corner).collect()
}

/// Radius, deviation and mean curvature over the angles of the grain's own axes, row by row from the north pole.
fn maps(grain: &Grain, deviation: Option<&ScanDeviation>) -> Vec<FieldPart> {
    let axes = grain.frame().axes;
    let direction = |at: usize| {
        let theta = (at / COLUMNS) as f64 * PI / (ROWS - 1) as f64;
        let phi = (at % COLUMNS) as f64 * TAU / COLUMNS as f64;
        let (sin, cos) = theta.sin_cos();
        axes * Vector3::new(sin * phi.cos(), sin * phi.sin(), cos)
    };
    let directions: Vec<Vector3<f64>> = (0..ROWS * COLUMNS).map(direction).collect();
    let places = grain.places(&directions);
    let centre = grain.frame().centre;
    let curvatures: Vec<f64> = directions
        .par_iter()
        .map(|n| Curvature::new(n, &grain.jet(n)).mean())
        .collect();
    let map = |name, values: Vec<f64>| FieldPart {
        name,
        values: Packed::floats(values),
    };
    let mut maps = vec![map(
        "radius",
        places.iter().map(|place| place.norm()).collect(),
    )];
    if let Some(deviation) = deviation {
        let found = places
            .par_iter()
            .map(|place| deviation.at(&(centre + place)));
        maps.push(map("deviation", found.collect()));
    }
    maps.push(map("mean_curvature", curvatures));
    maps
}
