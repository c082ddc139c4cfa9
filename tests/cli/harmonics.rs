//! The published coefficients of a grain: the CSV and the formula in its header are enough to rebuild the
//! radius, or the position of points. Nothing of the library's weights or bases is used here.

use super::{folder, grain, json, number, succeed};
use grainform::model::{Family, Stretch, Whole};
use grainform::report::write_harmonics;
use grainform::{Grain, StarGrain, StarSurface, Surface, model};
use nalgebra::{Matrix3, Vector3};
use std::collections::BTreeMap;
use std::f64::consts::PI;

/// A cell as the CSV tells of it: face, parts, row, column and, by l and m, a_l^m or those of x, y and z. Of the whole sphere:
/// angles.
#[derive(Default)]
struct Cell {
    place: [f64; 4],
    coefficients: Vec<(usize, i64, Vector3<f64>)>,
}

/// What the CSV says.
struct Published {
    centre: Vector3<f64>,
    /// Rows: the grain's axes in the scan.
    axes: Matrix3<f64>,
    /// t.
    stretch: Vector3<f64>,
    /// Share of a cell's width, and the largest angle; nothing if no cells are blended.
    margin: Option<[f64; 2]>,
    loss: f64,
    cells: Vec<Cell>,
}

fn numbers(text: &str) -> Vec<f64> {
    let words = text.split_whitespace();
    words.filter_map(|word| word.parse().ok()).collect()
}

/// What follows some words of the header.
fn after<'a>(text: &'a str, words: &str) -> &'a str {
    let (_, rest) = text.split_once(words).unwrap_or_else(|| panic!("{words}"));
    rest.lines().next().expect("a line")
}

fn read(text: &str) -> Published {
    let axis = |name: &str| {
        let line = after(text, &format!("{name} axis of the grain in the scan: "));
        Vector3::from_vec(numbers(line)).transpose()
    };
    let mut cells: BTreeMap<usize, Cell> = BTreeMap::new();
    let rows = text.lines().filter(|line| !line.starts_with('#')).skip(1);
    for row in rows {
        let columns: Vec<&str> = row.split(',').collect();
        let whole = |i: usize| columns[i].parse::<usize>().expect("a whole number");
        let cell = cells.entry(whole(0)).or_default();
        cell.place = [1, 2, 3, 4].map(|i| columns[i].parse().expect("a number"));
        let m = columns[6].parse().expect("an order");
        let own = columns[7..]
            .iter()
            .map(|a| a.parse().expect("a coefficient"));
        let own: Vec<f64> = own.chain([0.0; 2]).take(3).collect();
        cell.coefficients
            .push((whole(5), m, Vector3::from_vec(own)));
    }
    let is_blended = text.contains("S rises from 0 to 1 over ");
    let is_stretched = text.contains("by t = ");
    Published {
        centre: Vector3::from_vec(numbers(after(text, "centre of the grain in the scan: "))),
        axes: Matrix3::from_rows(&[axis("x"), axis("y"), axis("z")]),
        stretch: match is_stretched {
            true => Vector3::from_column_slice(&numbers(after(text, "by t = "))[..3]),
            false => Vector3::repeat(1.0),
        },
        margin: is_blended.then(|| {
            let numbers = numbers(after(text, "S rises from 0 to 1 over "));
            [numbers[0], numbers[1].to_radians()]
        }),
        loss: numbers(after(text, "largest loss of the conversion: "))[0],
        cells: cells.into_values().collect(),
    }
}

/// P_l^m(z) without the Condon-Shortley phase.
fn legendre(l: usize, m: usize, z: f64) -> f64 {
    let mut sectoral = 1.0;
    for i in 1..=m {
        sectoral *= (2 * i - 1) as f64 * (1.0 - z * z).max(0.0).sqrt();
    }
    let (mut before, mut now) = (0.0, sectoral);
    for i in m + 1..=l {
        let next = ((2 * i - 1) as f64 * z * now - (i + m - 1) as f64 * before) / (i - m) as f64;
        (before, now) = (now, next);
    }
    now
}

/// Y_l^m, real and orthonormal.
fn harmonic(l: usize, m: i64, n: &Vector3<f64>) -> f64 {
    let order = m.unsigned_abs() as usize;
    let ratio: f64 = (l - order + 1..=l + order).map(|i| i as f64).product();
    let scale = ((2 * l + 1) as f64 / (4.0 * PI * ratio)).sqrt();
    let azimuth = n.y.atan2(n.x);
    let turn = match m {
        0 => 1.0,
        1.. => 2.0_f64.sqrt() * (m as f64 * azimuth).cos(),
        _ => 2.0_f64.sqrt() * (order as f64 * azimuth).sin(),
    };
    scale * legendre(l, order, n.z) * turn
}

/// S: from 0 to 1 and back to 0 about the borders `low` and `high`.
fn profile(angle: f64, low: f64, high: f64, reach: f64) -> f64 {
    let half = |angle: f64| (0.5 * angle).tan();
    let step = |border: f64| {
        let (from, to) = (half(border - reach), half(border + reach));
        let s = ((half(angle) - from) / (to - from)).clamp(0.0, 1.0);
        s.powi(3) * (10.0 - 15.0 * s + 6.0 * s * s)
    };
    step(low) * (1.0 - step(high))
}

impl Cell {
    fn expansion(&self, n: &Vector3<f64>) -> Vector3<f64> {
        let terms = self.coefficients.iter();
        terms.map(|&(l, m, a)| a * harmonic(l, m, n)).sum()
    }
}

impl Published {
    /// The radius in a direction of the scan.
    fn radius(&self, n: &Vector3<f64>) -> f64 {
        let q = self.stretch.component_mul(&(self.axes * n));
        let local = q.normalize();
        self.value(&local).x / q.norm()
    }

    /// The point of the scan over a parameter in the grain's own frame.
    fn point(&self, n: &Vector3<f64>) -> Vector3<f64> {
        self.centre + self.axes.transpose() * self.value(n)
    }

    fn value(&self, n: &Vector3<f64>) -> Vector3<f64> {
        match self.margin {
            Some(margin) => self.blend(margin, n),
            None => self.cells[0].expansion(n),
        }
    }

    fn blend(&self, [margin, most]: [f64; 2], n: &Vector3<f64>) -> Vector3<f64> {
        let (mut sum, mut weights) = (Vector3::zeros(), 0.0);
        for cell in &self.cells {
            let [face, parts, row, column] = cell.place;
            let axis = face as usize / 2;
            let side = if face % 2.0 == 0.0 { 1.0 } else { -1.0 };
            if side * n[axis] <= 0.0 {
                continue;
            }
            let width = PI / (2.0 * parts);
            let along = |axis_across: usize, at: f64| {
                let angle = (n[axis_across] / n[axis].abs()).atan();
                let low = at * width - PI / 4.0;
                profile(angle, low, low + width, (margin * width).min(most))
            };
            let weight = along((axis + 1) % 3, row) * along((axis + 2) % 3, column);
            if weight > 0.0 {
                sum += cell.expansion(n) * weight;
                weights += weight;
            }
        }
        sum / weights
    }
}

/// Fits a grain of the repository; gives what was published and the model itself.
fn publish(name: &str, options: &[&str]) -> (Published, StarGrain, f64) {
    let (published, grain, radius) = publish_any(name, options);
    (published, grain.star().cloned().unwrap(), radius)
}

fn publish_any(name: &str, options: &[&str]) -> (Published, Grain, f64) {
    let folder = folder();
    let scan = grain(name);
    let words = ["fit", &scan, "--harmonics", "a.csv", "-o", "m.json"];
    let report = json(&folder, &[&words, options].concat());
    let text = |name: &str| std::fs::read_to_string(folder.path().join(name)).unwrap();
    let published = read(&text("a.csv"));
    // The header has fewer digits than the report.
    let loss = number(&report, "harmonics_loss");
    assert!((published.loss - loss).abs() <= 0.1 * loss);
    let grain = model::grain_from_json(&text("m.json")).unwrap();
    (published, grain, number(&report, "mean_radius"))
}

#[test]
fn the_formula_in_the_header_gives_back_the_radius_of_a_blended_grain() {
    for (name, options) in [
        ("bean.ply", &[][..]),
        ("maize.ply", &[]),
        ("chickpea.ply", &["--segments", "6", "--degree", "6"]),
        ("maize.ply", &["--segments", "54", "--degree", "2"]),
    ] {
        let (published, grain, radius) = publish(name, options);
        assert_eq!(published.cells.len(), grain.segments());
        for n in grainform::sphere::cube_grid(21).0 {
            let off = (published.radius(&n) - grain.radius(&n)).abs();
            assert!(
                off <= 2.0 * published.loss + 1e-13 * radius,
                "{name} {options:?} {n}: {off} where {} is stated",
                published.loss
            );
        }
    }
}

#[test]
fn the_formula_in_the_header_gives_back_the_points_of_positions() {
    for options in [&["--segments", "1"][..], &["--segments", "24"]] {
        let options = [options, &["--surface", "position"]].concat();
        let (published, grain, radius) = publish_any("bean.ply", &options);
        let position = grain.position().unwrap();
        for n in grainform::sphere::cube_grid(9).0 {
            let want = grain.frame().to_scan(&position.position().point(&n));
            let off = (published.point(&n) - want.coords).norm();
            let bound = 4.0 * published.loss + 1e-12 * radius;
            assert!(
                off <= bound,
                "{options:?} {n}: {off} where {bound} is stated"
            );
        }
    }
}

#[test]
fn the_formula_in_the_header_gives_back_the_radius_of_a_stretched_grain() {
    let (_, fitted, radius) = publish("bean.ply", &["--segments", "6", "--degree", "3"]);
    let own = (0..81).map(|i| radius * f64::from(i == 0) + 1e-3 * f64::from(i * 7 % 11));
    let whole = Family::Whole(Whole::new(own.collect()).unwrap());
    let stretch = Stretch::new(Vector3::new(0.7, 1.0 / 3.0, 1.9)).unwrap();
    for surface in [fitted.family().clone(), whole] {
        let grain = StarGrain::stretched(fitted.frame(), stretch, surface).unwrap();
        let mut text = Vec::new();
        write_harmonics(&grain, &grain.published(), &mut text).unwrap();
        let published = read(std::str::from_utf8(&text).unwrap());
        assert_eq!(published.stretch, *stretch.factors());
        for n in grainform::sphere::cube_grid(9).0 {
            let (found, want) = (published.radius(&n), grain.radius(&n));
            let bound = 4.0 * published.loss + 1e-13 * radius;
            assert!((found - want).abs() <= bound, "{n}: {found} {want}");
        }
    }
}

#[test]
fn the_harmonics_of_a_blended_grain_lose_next_to_nothing() {
    let folder = folder();
    let words = ["fit", &grain("maize.ply"), "--harmonics", "a.csv"];
    let text = succeed(&folder, &words);
    assert!(text.contains("converted with a loss of"), "{text}");
    let (published, _, radius) = publish("maize.ply", &[]);
    assert!(published.loss < 1e-9 * radius);
}
