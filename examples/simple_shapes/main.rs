//! The simple shapes of Radvilaite 2016, Chapter 3: printed figures, reproduced ones, and better ones.
//!
//! `cargo run --release --example simple_shapes`
//!
//! Per table 3.1 to 3.4, first every printed row beside the same sampling here, by the source's protocol:
//! fit in one octant, mirror, area and volume by four triangles on a 128 x 128 grid. LS is the sum of
//! squared *relative* radial deviations over some 16258 directions, as table 3.1 shows. Then our best
//! models of the same degree from no more samples than the best printed rows take: column by column,
//! where "better than the best printed" means than the best row of the table in that figure, and row by
//! row, one of ours that is better in LS, area and volume at once.

#[path = "../chapter_3/mod.rs"]
mod chapter_3;

mod best;
mod bound;
mod refine;
mod tables;

use std::error::Error;

/// Polar and azimuthal samples of our models, table by table.
const SAMPLES: [[usize; 2]; 4] = [[8, 8], [16, 8], [16, 8], [12, 6]];

fn main() -> Result<(), Box<dyn Error>> {
    for (table, samples) in tables::TABLES.iter().zip(SAMPLES) {
        println!("## {}\n", table.title);
        let (study, printed) = (table.study()?, table.printed());
        table.compare(&study, printed.as_ref())?;
        let rivals = printed.map_or_else(Vec::new, |printed| best::rivals(&printed, &study));
        let goal = best::goal(&rivals);
        let unbeaten = best::print(&study, rivals, samples)?;
        if let (1, Some(goal)) = (study.degree, &goal) {
            bound::print(&study, goal, &unbeaten);
        }
        println!("\n{}\n", table.remark);
    }
    Ok(())
}
