//! Contacts of random superquadrics by every method: how many stay unresolved, iterations, and time as a ratio to the
//! floor, evaluating both gauges with their derivatives once and both support functions once, on one thread; then
//! contacts of grains of any shape: `cargo bench --bench contact`. A number after `--` is that of the pairs (100 000).

mod pairs;
mod regions;
mod timing;

use grainform::contact::{ConvexContact, ConvexStatus, Method, Warm};
use grainform::model::StarSurface;
use nalgebra::Vector3;
use pairs::{Pair, sets};
use timing::median;

const RUNS: usize = 5;

/// How far the point of a warm start is off, in sizes of the bodies.
const WARM: f64 = 1e-3;

/// Gap at which a contact is found.
const GAP: f64 = 1e-6;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mut count = std::env::args().filter_map(|argument| argument.parse().ok());
    let count = count.next_back().unwrap_or(100_000);
    println!(
        "| pairs | method | unresolved | iterations: mean, 99 %, most | largest error of the ratio | us |"
    );
    println!("|---|---|---|---|---|---|");
    let mut timed = Vec::new();
    for set in sets() {
        let pairs = set.pairs(count);
        for (name, method) in [
            ("default", Method::Minimax),
            ("portal", Method::Portal),
            ("midway", Method::Midway),
        ] {
            println!("| {} | {name} | {} |", set.name, row(&pairs, method));
        }
        timed.push(times(set.name, &pairs));
    }
    println!(
        "\n| pairs | cold, us | / floor | warm, us | / floor | overlap, us | proved apart, us | floor, us |"
    );
    println!("|---|---|---|---|---|---|---|---|");
    timed.iter().for_each(|row| println!("{row}"));
    regions::print()
}

/// What a method makes of pairs.
fn row(pairs: &[Pair], method: Method) -> String {
    let found: Vec<ConvexContact> = pairs
        .iter()
        .map(|p| p.get().resolved(method, GAP))
        .collect();
    let is_resolved = |contact: &ConvexContact| contact.status != ConvexStatus::Unresolved;
    let unresolved = found.iter().filter(|contact| !is_resolved(contact)).count();
    let mut iterations: Vec<usize> = found.iter().map(|contact| contact.iterations).collect();
    iterations.sort_unstable();
    let mean = iterations.iter().sum::<usize>() as f64 / pairs.len() as f64;
    let resolved = found
        .iter()
        .zip(pairs)
        .filter(|(found, _)| is_resolved(found));
    let errors = resolved.map(|(found, pair)| (found.ratio / pair.ratio - 1.0).abs());
    // The midway point of bodies of unlike exponents is another point.
    let error = match method {
        Method::Midway => "-".into(),
        _ => format!("{:.0e}", errors.fold(0.0, f64::max)),
    };
    let seconds = median(RUNS, || {
        let ratios = pairs.iter().map(|p| p.get().resolved(method, GAP).ratio);
        ratios.sum::<f64>()
    });
    format!(
        "{:.3} % | {mean:.1}, {}, {} | {error} | {:.2}",
        100.0 * unresolved as f64 / pairs.len() as f64,
        iterations[(pairs.len() * 99) / 100],
        iterations[pairs.len() - 1],
        1e6 * seconds / pairs.len() as f64
    )
}

/// Times of contacts as a simulation asks for them.
fn times(name: &str, pairs: &[Pair]) -> String {
    let micro = |seconds: f64| 1e6 * seconds / pairs.len() as f64;
    let contacts: Vec<_> = pairs.iter().map(|p| p.get().contact(None)).collect();
    let aside = Vector3::new(0.6, -0.48, 0.64) * WARM;
    let warm: Vec<_> = contacts
        .iter()
        .map(|contact| Warm {
            point: contact.point + aside,
            normal: contact.normal,
        })
        .collect();
    let apart: Vec<Pair> = pairs
        .iter()
        .map(|pair| {
            let mut pair = *pair;
            pair.frames[1].centre *= 1.2 / pair.ratio;
            pair
        })
        .collect();
    let floor = micro(median(RUNS, || {
        let evaluated = pairs.iter().zip(&contacts).map(|(pair, contact)| {
            let seen = [0, 1].map(|i| pair.frames[i].to_local(&contact.point));
            let normals = [0, 1].map(|i| pair.frames[i].axes.tr_mul(&contact.normal));
            let gauges = [0, 1].map(|i| pair.bodies[i].derivatives(&seen[i]).radius);
            let heights = [0, 1].map(|i| pair.bodies[i].support(&normals[i]).0);
            gauges[0] + gauges[1] + heights[0] + heights[1]
        });
        evaluated.sum::<f64>()
    }));
    let cold = micro(median(RUNS, || {
        pairs
            .iter()
            .map(|p| p.get().contact(None).ratio)
            .sum::<f64>()
    }));
    let warmed = micro(median(RUNS, || {
        let contacts = pairs
            .iter()
            .zip(&warm)
            .map(|(p, warm)| p.get().contact(Some(warm)));
        contacts.map(|contact| contact.ratio).sum::<f64>()
    }));
    let overlap = micro(median(RUNS, || {
        let overlaps = pairs
            .iter()
            .zip(&contacts)
            .map(|(p, contact)| p.get().overlap(contact));
        overlaps.sum::<f64>()
    }));
    let proved = micro(median(RUNS, || {
        let contacts = apart
            .iter()
            .zip(&warm)
            .map(|(p, warm)| p.get().contact(Some(warm)));
        contacts.map(|contact| contact.iterations).sum::<usize>()
    }));
    format!(
        "| {name} | {cold:.2} | {:.1} | {warmed:.2} | {:.1} | {overlap:.2} | {proved:.2} | {floor:.2} |",
        cold / floor,
        warmed / floor
    )
}
