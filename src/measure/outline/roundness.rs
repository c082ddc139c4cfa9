//! Roundness of a closed curve's corners.

use nalgebra::Vector2;
use std::f64::consts::TAU;

/// Order of the Fourier series that an outline is smoothed to: waves of a 24th of its length remain.
/// Bowman, Soga and Drummond 2001 put the border between shape and texture about there.
pub const ROUNDNESS_ORDER: usize = 24;

/// Points at which the smoothed outline is curved: 40 per wave.
const SAMPLES: usize = 960;

/// Roundness (Wadell 1935) of a closed polygon, counter-clockwise, given the radius of its largest
/// inscribed circle: the mean radius of the corners over that radius.
///
/// A corner is a stretch on which the radius of curvature is less than the inscribed radius. Its radius
/// is its length over the angle it turns through, and corners are weighted by that angle, so that the
/// roundness is a continuous function of the outline: the length of all corners over the angle of all
/// corners and over the inscribed radius. One if there are no corners, and never more.
///
/// The curve is smoothed first: as a complex function of arc length its Fourier series (Granlund 1972),
/// found exactly from the polygon's edges, is cut off at [`ROUNDNESS_ORDER`]. Corners that are sharper
/// than that resolves are rounded by it: of a square whose corners have 0.3 of the inscribed radius it
/// makes 0.35, of 0.5 0.52, of 0.8 0.80, of a sharp one about 0.2.
pub(super) fn roundness(points: &[Vector2<f64>], inscribed_radius: f64) -> f64 {
    let samples = smoothed(points)
        .into_iter()
        .map(|[speed, turn]| (Vector2::new(speed, turn), turn * inscribed_radius - speed));
    let samples: Vec<(Vector2<f64>, f64)> = samples.collect();
    let next = samples.iter().cycle().skip(1);
    let within = samples
        .iter()
        .zip(next)
        .map(|(from, to)| in_corner(from, to));
    let sums: Vector2<f64> = within.sum();
    let (length, angle) = (sums.x, sums.y);
    if angle > 0.0 {
        length / angle / inscribed_radius
    } else {
        1.0
    }
}

/// Length and angle that the smoothed curve goes through per step of its parameter, all along it.
pub(in crate::measure) fn smoothed(points: &[Vector2<f64>]) -> Vec<[f64; 2]> {
    let slopes = slope_series(points);
    let places = (0..SAMPLES).map(|sample| TAU * sample as f64 / SAMPLES as f64);
    places.map(|place| speed_and_turn(&slopes, place)).collect()
}

/// The same at one place.
fn speed_and_turn(slopes: &[[Vector2<f64>; 2]; ROUNDNESS_ORDER], place: f64) -> [f64; 2] {
    // The first derivative and the second.
    let (mut first, mut second) = (Vector2::zeros(), Vector2::zeros());
    let step = phase(place);
    let mut turn = Vector2::x();
    for (order, [forth, back]) in (1..).map(f64::from).zip(slopes) {
        turn = product(turn, step);
        let (forth, back) = (product(*forth, turn), product(*back, conjugate(turn)));
        first += forth + back;
        let difference = forth - back;
        second += Vector2::new(-difference.y, difference.x) * order;
    }
    [first.norm(), first.perp(&second) / first.norm_squared()]
}

/// The integral between two samples over where the excess, the other number of each, is above zero, by straight lines.
fn in_corner(from: &(Vector2<f64>, f64), to: &(Vector2<f64>, f64)) -> Vector2<f64> {
    match (from.1 > 0.0, to.1 > 0.0) {
        (true, true) => (from.0 + to.0) / 2.0,
        (false, false) => Vector2::zeros(),
        (is_first, _) => {
            let (inside, outside) = if is_first { (from, to) } else { (to, from) };
            let share = inside.1 / (inside.1 - outside.1);
            let end = inside.0.lerp(&outside.0, share);
            (inside.0 + end) * (share / 2.0)
        }
    }
}

/// Coefficients of orders k and -k, k = 1, 2, ..., of the derivative of a closed polygon by t in
/// [0, 2 pi), which is arc length in units of the polygon's length over 2 pi; x + iy as vectors.
fn slope_series(points: &[Vector2<f64>]) -> [[Vector2<f64>; 2]; ROUNDNESS_ORDER] {
    let next = points.iter().cycle().skip(1);
    let edges: Vec<Vector2<f64>> = points.iter().zip(next).map(|(p, q)| q - p).collect();
    let length: f64 = edges.iter().map(|edge| edge.norm()).sum();
    let mut slopes = [[Vector2::zeros(); 2]; ROUNDNESS_ORDER];
    let mut walked = 0.0;
    for edge in edges {
        let half = TAU * edge.norm() / length / 2.0;
        if half > 0.0 {
            let (middle, end) = (phase(walked + half), phase(half));
            let (mut at_middle, mut at_end) = (Vector2::x(), Vector2::x());
            for (order, [forth, back]) in (1..).map(f64::from).zip(&mut slopes) {
                (at_middle, at_end) = (product(at_middle, middle), product(at_end, end));
                // The mean of exp(-i k t) over the edge is sin(k h) / (k h) exp(-i k m).
                let weighted = edge * (at_end.y / (order * half * TAU));
                *forth += product(weighted, conjugate(at_middle));
                *back += product(weighted, at_middle);
            }
        }
        walked += 2.0 * half;
    }
    slopes
}

/// exp(i angle).
fn phase(angle: f64) -> Vector2<f64> {
    let (sin, cos) = angle.sin_cos();
    Vector2::new(cos, sin)
}

/// Product of two complex numbers.
fn product(a: Vector2<f64>, b: Vector2<f64>) -> Vector2<f64> {
    Vector2::new(a.x * b.x - a.y * b.y, a.x * b.y + a.y * b.x)
}

fn conjugate(a: Vector2<f64>) -> Vector2<f64> {
    Vector2::new(a.x, -a.y)
}
