//! Any text is a model or a located error: `cargo +nightly fuzz run urdf`.

#![no_main]

use eigenbody_formats::{UrdfOptions, read_urdf_str};

libfuzzer_sys::fuzz_target!(|text: &str| {
    let _ = read_urdf_str(text, "fuzz", &UrdfOptions::default());
});
