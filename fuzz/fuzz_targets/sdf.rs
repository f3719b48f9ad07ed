//! Any text is a model or a located error: `cargo +nightly fuzz run sdf`.

#![no_main]

use eigenbody_formats::{SdfOptions, read_sdf_str};

libfuzzer_sys::fuzz_target!(|text: &str| {
    let _ = read_sdf_str(text, "fuzz", &SdfOptions::default());
});
