//! Tells the tests whether the folder `../shared` is there: those that read it are ignored without it.

use std::path::Path;

fn main() {
    println!("cargo::rustc-check-cfg=cfg(shared)");
    println!("cargo::rerun-if-changed=build.rs");
    // Seen from the package, in which cargo runs this.
    if Path::new("../shared").is_dir() {
        println!("cargo::rustc-cfg=shared");
        println!("cargo::rerun-if-changed=../shared");
    }
}
