//! How good the descriptors of models are: of fitted grains, and of the twenty bodies of tables 3.8 and 3.9 of
//! Radvilaite 2016 at degrees 1 and 3.
//!
//! To run: `cargo run --release --example descriptors`

#[path = "../chapter_3/reference.rs"]
mod reference;
#[path = "../chapter_3/study.rs"]
mod study;

mod bodies;
mod grains;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    println!("## Grains\n");
    grains::print()?;
    println!("## Twenty bodies\n");
    bodies::print()
}
