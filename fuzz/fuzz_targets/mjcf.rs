//! Any text is a model or a located error: `cargo +nightly fuzz run mjcf`.

#![no_main]

use eigenbody_formats::{MjcfOptions, read_mjcf_str};

libfuzzer_sys::fuzz_target!(|text: &str| {
    let _ = read_mjcf_str(text, "fuzz", &MjcfOptions::default());
});
