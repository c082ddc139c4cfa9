//! What no model of degree 1 can do, by exhaustive search.
//!
//! Fitted to samples that are alike in x and y, a model of degree 1 is
//! r = alpha + beta (|x| + |y|) + delta |z|. Its LS error is a quadratic form of the three, and its area
//! and volume grow with alpha. For every beta and delta of a fine grid the alphas that meet the demands
//! on area and volume are an interval; the one of least LS error is there in closed form.

use crate::best::Rival;
use crate::chapter_3::search::Goal;
use crate::chapter_3::study::Study;
use gauss_quad::GaussLegendre;
use nalgebra::{Matrix3, Vector3};
use rayon::prelude::*;
use std::f64::consts::FRAC_PI_4;
use std::num::NonZeroUsize;

/// Gauss points per angle.
const NODES: NonZeroUsize = NonZeroUsize::new(12).unwrap();

/// Steps of the grid to either side of the least LS error.
const STEPS: i32 = 40;

/// The grid holds all models whose LS error is at most so many times the least.
const REACH: f64 = 2.5;

/// Halvings of the interval in which an alpha is sought.
const HALVINGS: usize = 40;

/// Prints the least LS errors that the best printed area, and area and volume, leave possible, and those
/// that the rows which none of ours beats do.
pub(crate) fn print(study: &Study, goal: &Goal, unbeaten: &[Rival]) {
    let space = Space::new(study);
    let least = space.minimum / study.threshold;
    let none = f64::INFINITY;
    let limits = [
        ("V", [none, goal.volume]),
        ("S", [goal.area, none]),
        ("S and V", [goal.area, goal.volume]),
    ];
    println!(
        "\nOf all models of degree 1 that are alike in x and y, by exhaustive search, the least LS error is \
         {least:.4} of the threshold's; the best printed one is {:.4}. The least with figures as good as the \
         best printed:",
        goal.ls_ratio
    );
    for (name, limit) in limits {
        let bound = space.least_with(limit) / study.threshold;
        let verdict = match bound < goal.ls_ratio {
            true => "can be had together with a better LS error",
            false => "cannot be had together with a better LS error",
        };
        println!("- {name}: {bound:.4}: {verdict}");
    }
    for Rival { name, goal, .. } in unbeaten {
        let bound = space.least_with([goal.area, goal.volume]) / study.threshold;
        println!(
            "- S and V of {name}: {bound:.4}, where {:.4} is printed: {}",
            goal.ls_ratio,
            match bound < goal.ls_ratio {
                true => "possible, but not found by the search",
                false => "no model of degree 1 is better in all three",
            }
        );
    }
    println!();
}

/// All models, and the shape they are to meet.
struct Space {
    /// The quadratic form of the LS error about its least.
    form: Matrix3<f64>,
    best: Vector3<f64>,
    minimum: f64,
    area: f64,
    volume: f64,
    /// Directions of the octant and eight times their solid angles.
    nodes: Vec<(Vector3<f64>, f64)>,
}

impl Space {
    fn new(study: &Study) -> Self {
        let (mut form, mut side, mut weight) = (Matrix3::zeros(), Vector3::zeros(), 0.0);
        for (n, count) in &study.directions {
            let row = Vector3::new(1.0, n.x + n.y, n.z) / study.shape.radius(n);
            form += row * row.transpose() * *count;
            side += row * *count;
            weight += count;
        }
        // Three functions that are far from dependent: the normal equations lose three digits.
        let best = form.try_inverse().unwrap_or_default() * side;
        let rule = GaussLegendre::new(NODES);
        // From [-1, 1] to an angle of the octant, and its step.
        let on_octant = |&(x, w): &(f64, f64)| (FRAC_PI_4 * (x + 1.0), FRAC_PI_4 * w);
        let mut nodes = Vec::new();
        for (theta, height) in rule.iter().map(on_octant) {
            for (phi, width) in rule.iter().map(on_octant) {
                let (sin, cos) = theta.sin_cos();
                let n = Vector3::new(sin * phi.cos(), sin * phi.sin(), cos);
                nodes.push((n, 8.0 * sin * height * width));
            }
        }
        Self {
            form,
            best,
            minimum: weight - side.dot(&best),
            area: study.exact.area,
            volume: study.exact.volume,
            nodes,
        }
    }

    /// The least LS error of all models whose area and volume are within relative limits.
    fn least_with(&self, limits: [f64; 2]) -> f64 {
        let spread = self.form.try_inverse().unwrap_or_default().diagonal();
        let half = spread.map(|s| (s * (REACH - 1.0) * self.minimum).sqrt());
        let beta = |i: i32| self.best.y + half.y * f64::from(i) / f64::from(STEPS);
        let delta = |j: i32| self.best.z + half.z * f64::from(j) / f64::from(STEPS);
        (-STEPS..=STEPS)
            .into_par_iter()
            .flat_map_iter(|i| (-STEPS..=STEPS).map(move |j| (i, j)))
            .map(|(i, j)| self.least_at(beta(i), delta(j), limits))
            .reduce(|| f64::INFINITY, f64::min)
    }

    /// The least LS error over alpha.
    fn least_at(&self, beta: f64, delta: f64, [area, volume]: [f64; 2]) -> f64 {
        let off = |alpha: f64| Vector3::new(alpha, beta, delta) - self.best;
        let rest = off(self.best.x);
        let free = self.best.x - self.form.row(0).transpose().dot(&rest) / self.form[(0, 0)];
        let (mut low, mut high) = (f64::NEG_INFINITY, f64::INFINITY);
        if area.is_finite() {
            let alpha = |share: f64| self.alpha(beta, delta, &|[s, _]| s - share * self.area);
            (low, high) = (low.max(alpha(1.0 - area)), high.min(alpha(1.0 + area)));
        }
        if volume.is_finite() {
            let alpha = |share: f64| self.alpha(beta, delta, &|[_, v]| v - share * self.volume);
            (low, high) = (low.max(alpha(1.0 - volume)), high.min(alpha(1.0 + volume)));
        }
        if low > high {
            return f64::INFINITY;
        }
        let off = off(free.clamp(low, high));
        self.minimum + off.dot(&(self.form * off))
    }

    /// The alpha at which a growing function of area and volume is zero.
    fn alpha(&self, beta: f64, delta: f64, zero: &dyn Fn([f64; 2]) -> f64) -> f64 {
        let (mut low, mut high) = (0.0, 2.0 * self.best.x);
        for _ in 0..HALVINGS {
            let middle = (low + high) / 2.0;
            match zero(self.area_and_volume(middle, beta, delta)) < 0.0 {
                true => low = middle,
                false => high = middle,
            }
        }
        (low + high) / 2.0
    }

    fn area_and_volume(&self, alpha: f64, beta: f64, delta: f64) -> [f64; 2] {
        let slope = Vector3::new(beta, beta, delta);
        let mut sums = [0.0; 2];
        for (n, solid_angle) in &self.nodes {
            let along = slope.dot(n);
            let r = alpha + along;
            let across = slope.norm_squared() - along * along;
            sums[0] += r * (r * r + across).sqrt() * solid_angle;
            sums[1] += r * r * r / 3.0 * solid_angle;
        }
        sums
    }
}
