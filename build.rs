//! Tells the tests whether the folder `../shared` is there: those that read it are ignored without it.

use std::path::Path;

fn main() {
    println!("cargo::rustc-check-cfg=cfg(shared)");
    println!("cargo::rerun-if-changed=build.rs");
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../shared");
    if folder.is_dir() {
        println!("cargo::rustc-cfg=shared");
        println!("cargo::rerun-if-changed=../shared");
    }
}
