//! The `grainform` command line.

fn main() {}
