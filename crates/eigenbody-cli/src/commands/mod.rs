//! One file a command.

mod advise;
pub mod check;
pub mod convert;
mod drive;
pub mod info;
pub mod matrix;
pub mod reproduce;
pub mod spectrum;
pub mod welcome;

/// A number that an option must have above zero.
fn positive(option: &str, x: f64) -> Result<f64, crate::failure::Failure> {
    match x > 0.0 && x.is_finite() {
        true => Ok(x),
        false => Err(crate::failure::Failure::Usage(format!("{option} {x}: expected a positive number"))),
    }
}
