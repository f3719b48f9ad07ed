//! One file a command.

pub mod matrix;
pub mod spectrum;
pub mod welcome;
