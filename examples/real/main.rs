//! How good default fits are on real shapes: against exact truth, and by points that the fit has not seen.
//!
//! `cargo run --release --example real` prints five tables. The first is of particles whose radius is known as an
//! expansion (cement, aggregate, boxes), sampled clean and with noise: the model's radial distance to the truth, and
//! its area and volume. The second is of scans, of whose points a tenth is hidden from the fit; the third of a
//! batch of kernels, likewise. Their rival is the least-squares expansion of the whole sphere of the degree that suits
//! the hidden points best. The last two are of kernels and particles whose figures were published. The shapes
//! are read from `../shared/scans`; without that folder there is nothing to print.
//!
//! Arguments: `truth`, `hidden`, `batch`, `kernels` or `particles` for one table, and a number to take every so many particles only.

mod hidden;
mod particle;
mod published;
mod rival;
mod scans;
mod stats;
mod truth;

use std::error::Error;
use std::path::Path;

/// Where the shapes are.
const SCANS: &str = "../shared/scans";

fn main() -> Result<(), Box<dyn Error>> {
    if !Path::new(SCANS).exists() {
        println!("{SCANS} is not there: nothing to measure");
        return Ok(());
    }
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let every = arguments.iter().find_map(|a| a.parse().ok()).unwrap_or(1);
    let wants = |name: &str| {
        !arguments
            .iter()
            .any(|a| a != name && a.parse::<usize>().is_err())
    };
    if wants("truth") {
        truth::print(Path::new(SCANS), every)?;
    }
    if wants("hidden") {
        hidden::print(Path::new(SCANS))?;
    }
    if wants("batch") {
        hidden::print_batch(Path::new(SCANS))?;
    }
    if wants("kernels") {
        published::print_kernels(Path::new(SCANS))?;
    }
    if wants("particles") {
        published::print_particles(Path::new(SCANS))?;
    }
    Ok(())
}
