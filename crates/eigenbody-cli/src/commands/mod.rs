//! One file a command.

mod advise;
pub mod check;
pub mod convert;
mod drive;
pub mod info;
pub mod matrix;
pub mod motion;
pub mod reproduce;
#[cfg(feature = "web")]
pub mod serve;
pub mod simulate;
pub mod spectrum;
#[cfg(feature = "parquet")]
pub mod sweep;
pub mod track;
pub mod welcome;

/// Gains of joints, as an option names them.
fn option_gains(
    option: &str,
    text: &str,
    model: &eigenbody::Model<f64>,
) -> Result<Vec<Option<f64>>, crate::failure::Failure> {
    eigenbody_formats::gains(text, model)
        .map_err(|error| crate::failure::Failure::Usage(format!("{option} {error}")))
}

/// A number that an option must have above zero.
fn positive(option: &str, x: f64) -> Result<f64, crate::failure::Failure> {
    match x > 0.0 && x.is_finite() {
        true => Ok(x),
        false => Err(crate::failure::Failure::Usage(format!("{option} {x}: expected a positive number"))),
    }
}
