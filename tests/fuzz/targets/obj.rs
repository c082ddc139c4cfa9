//! Any bytes, offered as a file named `.obj`.
#![no_main]

mod sound;

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| sound::parse(bytes, "obj"));
