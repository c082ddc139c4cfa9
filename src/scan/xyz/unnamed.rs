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

/// Columns of normals and places.
const WITH_NORMALS: usize = 6;

/// What should stand there instead, as an error says it; nothing where all is well. `others` are the next three columns, of
/// a ball its normals.
pub(super) fn expected(
    points: &[Point3<f64>],
    columns: usize,
    others: impl FnOnce() -> Vec<Point3<f64>>,
) -> Option<&'static str> {
    if columns > 3 && counts_rows(points) {
        return Some(
            "coordinates in the first three columns, but the first one counts the rows: take it out, or name the columns in \
             a first line such as `id x y z`",
        );
    }
    if columns >= WITH_NORMALS && are_normals(points) && !are_normals(&others()) {
        return Some(
            "coordinates in the first three columns, but these are of one length, as normals are: put x, y and z first, or name the columns in a first line such as `nx ny nz x y z`",
        );
    }
    None
}

/// Whether the first coordinate is the number of its row, from 0 or 1 on.
fn counts_rows(points: &[Point3<f64>]) -> bool {
    let first = points.first().map_or(f64::NAN, |point| point.x);
    let mut rows = points.iter().enumerate();
    points.len() >= LEAST_ROWS
        && (first == 0.0 || first == 1.0)
        && rows.all(|(row, point)| point.x == first + row as f64)
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
