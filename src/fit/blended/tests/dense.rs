//! The joint fit against an orthogonal factorization of the whole design.

use super::{Target, anywhere, found, texture};
use crate::fit::blended::joint::counted;
use crate::fit::blended::nodes::{Sampler, nodes_per_side};
use crate::fit::blended::{GIVEN, Settings};
use crate::model::Blended;
use crate::sphere::{CapBasis, Places, coefficient_count};
use faer::linalg::solvers::SolveLstsqCore;

#[test]
fn the_solution_is_the_least_squares_solution() {
    let target = texture(6);
    for (segments, degree) in [(6, 4), (24, 3), (54, 1)] {
        let settings = Settings {
            degree: Some(degree),
            segments: Some(segments),
            ..Settings::within(1e-3)
        };
        let outcome = found(&target, &settings);
        let exact = dense(&target, &outcome.surface, degree);
        let directions = anywhere();
        let ours = outcome.surface.radii_and_gradients(&directions);
        let theirs = exact.radii_and_gradients(&directions);
        for (a, b) in ours.iter().zip(theirs) {
            assert!((a.0 - b.0).abs() < 1e-10, "{} {}", a.0, b.0);
        }
    }
}

/// The same problem by an orthogonal factorization of the whole design.
fn dense(target: &dyn Target, surface: &Blended, degree: usize) -> Blended {
    let cover = surface.cover();
    let mut sampler = Sampler::default();
    let count = coefficient_count(degree);
    let basis = CapBasis::new(degree);
    let (mut rows, mut right) = (Vec::new(), Vec::new());
    for cell in cover.cells() {
        let side = nodes_per_side(cell, degree);
        sampler.sample(target, &[(*cell, side)]);
        let samples = sampler.of(cell, side);
        let mut shares = Vec::new();
        for (i, n) in samples.directions.iter().enumerate() {
            cover.shares(n, &mut shares);
            let mut blend = vec![0.0; count * cover.cells().len()];
            for &(cell, share) in &shares {
                let at = usize::from(cell);
                let (mut places, mut values) = (Places::default(), vec![0.0; count]);
                cover.cap(at).locate(&[[n.x, n.y, n.z, 0.0]], &mut places);
                basis.evaluate(&places, &mut values, 1);
                let mut own = vec![0.0; blend.len()];
                let weight = (GIVEN.own * samples.weights[i] * counted(share)).sqrt();
                let root = samples.weights[i].sqrt();
                for (j, value) in values.iter().enumerate() {
                    blend[at * count + j] = root * share * value;
                    own[at * count + j] = weight * value;
                }
                rows.push(own);
                right.push(weight * samples.radii[i]);
            }
            rows.push(blend);
            right.push(samples.weights[i].sqrt() * samples.radii[i]);
        }
    }
    let a = faer::Mat::from_fn(rows.len(), rows[0].len(), |i, j| rows[i][j]);
    let mut b = faer::Mat::from_fn(right.len(), 1, |i, _| right[i]);
    a.qr()
        .solve_lstsq_in_place_with_conj(faer::Conj::No, b.as_mut());
    let flat = &b.col_as_slice(0)[..rows[0].len()];
    let own = flat.chunks(count).map(<[f64]>::to_vec).collect();
    Blended::new(cover.clone(), own).expect("sound")
}
