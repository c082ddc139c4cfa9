//! Any bytes, offered as a file named `.ply`.
#![no_main]

mod sound;

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| sound::parse(bytes, "ply"));
