//! What the first three columns may hold in place of coordinates, where nobody has named them.

use nalgebra::Point3;

/// Fewer rows may be numbered, or of length 1, by chance.
const LEAST_ROWS: usize = 4;

/// Lengths that normals are written with; beyond 1, whole numbers of 8 and of 16 bits.
const LENGTHS: [f64; 3] = [1.0, 127.0, 32_767.0];

/// How far their lengths may be from that, as a share of it: they are often written with two digits.
const NORMAL: f64 = 0.01;

/// Share of rows that have such lengths; where a normal is not known, zeros are written.
const MOST: f64 = 0.95;

/// Of a column of times, the share of steps that are the same, and by how much these differ.
const MOST_STEPS: f64 = 0.9;
const STEP: f64 = 0.01;

/// So few rows of more columns than this are no points.
const FEW_ROWS: usize = 4;
const MANY_COLUMNS: usize = 40;

/// Columns of normals and places.
const WITH_NORMALS: usize = 6;

/// What should stand there instead, as an error says it; nothing where all is well. `others` are the next three columns, of
/// a ball its normals.
pub(super) fn expected(
    points: &[Point3<f64>],
    columns: usize,
    others: impl FnOnce() -> Vec<Point3<f64>>,
) -> Option<&'static str> {
    if points.len() <= FEW_ROWS && columns > MANY_COLUMNS {
        return Some(
            "a row for each point, but these are a few rows of many numbers: transpose the table",
        );
    }
    if columns > 3 && (counts(points) || goes_on_evenly(points)) {
        return Some(
            "coordinates in the first three columns, but the first one counts the rows, or goes on from row to row as numbers or \
             times do: take it out, or name the columns in a first line such as `id x y z`, or `x y z value` if it is x",
        );
    }
    if columns >= WITH_NORMALS && are_normals(points) && !are_normals(&others()) {
        return Some(
            "coordinates in the first three columns, but these are of one length, as normals are: put x, y and z first, or name the columns in a first line such as `nx ny nz x y z`",
        );
    }
    None
}

/// Whether the first coordinates are whole numbers that never turn back, beside others that are not.
fn counts(points: &[Point3<f64>]) -> bool {
    let is_whole = |axis: usize| points.iter().all(|point| point[axis].fract() == 0.0);
    let steps = || points.windows(2).map(|pair| pair[1].x - pair[0].x);
    let never_turns = steps().all(|step| step >= 0.0) || steps().all(|step| step <= 0.0);
    points.len() >= LEAST_ROWS
        && steps().any(|step| step != 0.0)
        && never_turns
        && is_whole(0)
        && !is_whole(1)
        && !is_whole(2)
}

/// Whether the first coordinates go on by the same step from row to row, but for a few.
fn goes_on_evenly(points: &[Point3<f64>]) -> bool {
    let mut steps: Vec<f64> = points
        .windows(2)
        .map(|pair| pair[1].x - pair[0].x)
        .collect();
    if points.len() < LEAST_ROWS || steps.contains(&0.0) {
        return false;
    }
    steps.sort_by(f64::total_cmp);
    let middle = steps[steps.len() / 2];
    let is_same = |step: &&f64| (**step - middle).abs() <= STEP * middle.abs();
    let never_turns = steps[0] * steps[steps.len() - 1] > 0.0;
    never_turns && steps.iter().filter(is_same).count() as f64 >= MOST_STEPS * steps.len() as f64
}

fn are_normals(points: &[Point3<f64>]) -> bool {
    let are_whole = points.iter().all(|p| p.iter().all(|c| c.fract() == 0.0));
    let lengths = if are_whole {
        &LENGTHS[..]
    } else {
        &LENGTHS[..1]
    };
    let are_so_long = |length: &f64| {
        let is_so_long = |p: &&Point3<f64>| (p.coords.norm() - length).abs() < NORMAL * length;
        points.iter().filter(is_so_long).count() as f64 >= MOST * points.len() as f64
    };
    points.len() >= LEAST_ROWS && lengths.iter().any(are_so_long)
}
