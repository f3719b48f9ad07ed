//! One file a command.

pub mod matrix;
pub mod reproduce;
pub mod spectrum;
pub mod welcome;
