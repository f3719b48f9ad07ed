//! One file a command.

pub mod check;
pub mod convert;
pub mod info;
pub mod matrix;
pub mod reproduce;
pub mod spectrum;
pub mod welcome;
