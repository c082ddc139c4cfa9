//! How stable the fits are, and why they are made as they are: prints one row per cloud, partition
//! and degree.
//!
//! `cargo run --release --example stability`
//!
//! Every segment is fitted in double precision in four ways, the real harmonics or the cap basis by
//! the normal equations or by Householder reflections, and compared with the same least squares in
//! extended precision. The last columns judge the grain that the library makes of the whole cloud.
//! All errors are the largest of a fitted radius at a sample, relative to the largest radius there.
//!
//! The harmonics restricted to a segment are nearly dependent: their condition grows like k^(2L),
//! and the normal equations square it. The cap basis spans the same functions, so the answer is the
//! same, but its condition stays lower by many orders of magnitude; what growth it shows is that of
//! the long and thin segments at the poles.
//!
//! The columns:
//!
//! * determined: the segments whose own samples fix every coefficient. Conditions and errors of the
//!   four ways are the worst of these.
//! * rank of: the coefficients per segment, and the least rank of the samples of any segment.
//! * widened: the segments that the library fits to the samples of the whole cap round them, because
//!   their own leave the answer open, or open at the corners.
//! * lowered: those whose degree it lowers, because these leave it open too.

#[path = "../../tests/stability/clouds.rs"]
mod clouds;
#[path = "../../tests/stability/extended.rs"]
mod extended;
#[path = "../../tests/stability/judge.rs"]
mod judge;
mod odd_clouds;
mod segments;
#[path = "../../tests/stability/solvers.rs"]
mod solvers;

use clouds::{chickpea, even_in_angles};
use grainform::fit;
use grainform::scan::Scan;
use grainform::shapes::Sampling;
use grainform::sphere::coefficient_count;
use judge::{Verdict, judge, options, samples_by_segment, segmented};
use nalgebra::Point3;
use segments::Study;
use std::time::Instant;

/// Parts per angle and degrees of the table.
const PARTS: [usize; 9] = [1, 2, 4, 6, 8, 10, 16, 32, 64];
const DEGREES: [usize; 5] = [0, 1, 3, 6, 12];

/// What an odd cloud is fitted with.
const FEW_CELLS: [(usize, usize); 4] = [(1, 3), (4, 3), (8, 3), (4, 6)];

/// Largest product of samples and squared coefficients, so that the table takes minutes: extended
/// precision costs some ten nanoseconds for each.
const LARGEST_WORK: usize = 600_000_000;

fn main() {
    let start = Instant::now();
    println!(
        "| cloud | points | k | L | determined | rank of | cap | harmonics | condition: cap | \
         harmonics | harmonics, normal equations | harmonics, QR | cap, normal equations | cap, QR \
         | the fit | widened | lowered |"
    );
    println!("|---|{}", "---:|".repeat(16));
    for degree in DEGREES {
        for k in PARTS {
            let count = coefficient_count(degree);
            if 4 * count * k * k * count * count <= LARGEST_WORK {
                row("even in angles", even_in_angles(k, degree), k, degree);
            }
        }
    }
    let cube = chickpea(6146, Sampling::Cube);
    for degree in DEGREES {
        for k in PARTS {
            row("cube grid", cube.clone(), k, degree);
        }
    }
    for points in [4, 5, 8, 12, 20, 50] {
        let handful = chickpea(points, Sampling::Fibonacci);
        for (k, degree) in [(1, 0), (1, 1), (1, 3), (4, 1)] {
            row("a handful", handful.clone(), k, degree);
        }
    }
    for (name, points) in odd_clouds::odd_clouds() {
        for (k, degree) in FEW_CELLS {
            row(name, points.clone(), k, degree);
        }
    }
    let million = chickpea(1_000_000, Sampling::Random);
    for (k, degree) in [(8, 3), (64, 3)] {
        row("a million", million.clone(), k, degree);
    }
    println!("\n{:.0} s in all", start.elapsed().as_secs_f64());
}

/// Fits a cloud and prints what became of it.
fn row(name: &str, points: Vec<Point3<f64>>, k: usize, degree: usize) {
    let scan = Scan::from_points(points);
    let count = scan.points().len();
    let fitted = match fit(&scan, &options(k, degree)) {
        Ok(fitted) => fitted,
        Err(refusal) => {
            return println!("| {name} | {count} | {k} | {degree} | refused: {refusal} |");
        }
    };
    let samples = samples_by_segment(&fitted, scan.points());
    let study = Study::of(
        segmented(fitted.grain.star().expect("a radius")).partition(),
        degree,
        &samples,
    );
    let Verdict {
        error,
        widened,
        lowered,
    } = judge(fitted.grain.star().expect("a radius"), degree, &samples);
    println!(
        "| {name} | {count} | {k} | {degree} | {study} | {error:.0e} | {widened} | {lowered} |"
    );
}
