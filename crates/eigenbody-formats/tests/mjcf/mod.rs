//! MJCF files: the numbers they give, against MuJoCo's, and the errors.

mod cases;
pub use cases::CASES;
mod faults;
mod files;
mod looks;
mod loops;
mod matrices;
mod names;
mod springs;

use eigenbody_formats::{Loaded, MjcfOptions, read_mjcf_str};

/// The model of a text.
fn loaded(text: &str) -> Loaded {
    read_mjcf_str(text, "test.xml", &MjcfOptions::default()).unwrap()
}

/// The model of what stands in the world body.
fn world(bodies: &str) -> Loaded {
    loaded(&format!("<mujoco><worldbody>{bodies}</worldbody></mujoco>"))
}
