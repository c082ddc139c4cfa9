//! What fits of the same accuracy cost: prints, for grains, edged bodies and scanned stones, tables
//! of the cheapest fit of every family at a few levels of the held-out RMS, and how cells compare with
//! the whole sphere and with k x k segments.
//!
//! `cargo run --release --example comparison` takes some ten minutes, on one thread.

mod curves;
mod dense;
mod equal;
mod subjects;
mod table;

use std::error::Error;

fn main() -> Result<(), Box<dyn Error>> {
    rayon::ThreadPoolBuilder::new()
        .num_threads(1)
        .build_global()?;
    let mut verdicts = Vec::new();
    println!("{}", table::COSTS);
    for subject in subjects::all()? {
        let curves = curves::Curves::new(&subject)?;
        for level in table::LEVELS
            .into_iter()
            .filter(|&level| curves.reach(level))
        {
            println!("{}", table::costs(&curves, level));
            verdicts.push(table::verdicts(&curves, level));
        }
    }
    println!("\n{}\n{}", table::VERDICTS, verdicts.join("\n"));
    println!("\n{}", equal::HEADING);
    for subject in grainform::bench::synthetic()? {
        for row in equal::rows(&subject)? {
            println!("{row}");
        }
    }
    Ok(())
}
