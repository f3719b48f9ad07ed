//! METRIC: what counts as a unit of motion.

use crate::error::FormatError;
use crate::expression::{ExpressionError, Reader};
use eigenbody::Metric;

/// The metric that a text names: `euclidean`, `unit-diagonal`, `length=0.3`, `diagonal=[1, 2.5, 1]`.
///
/// ```
/// use eigenbody::Metric;
/// assert_eq!(eigenbody_formats::metric("length=1/4")?, Metric::Length(0.25));
/// # Ok::<(), eigenbody_formats::FormatError>(())
/// ```
/// Errors: [`FormatError::Expression`]. Whether a diagonal fits a robot is for [`Metric::weights`] to say.
pub fn metric(text: &str) -> Result<Metric<f64>, FormatError> {
    let mut reader = Reader::new(text);
    match text.trim() {
        "euclidean" => return Ok(Metric::Euclidean),
        "unit-diagonal" => return Ok(Metric::UnitDiagonal),
        _ => {}
    }
    let (start, word) = (reader.offset(), reader.word());
    reader.skip(word.len());
    let metric = match word {
        "length" if reader.eat('=') => {
            let offset = reader.offset();
            let length = reader.number()?;
            if length <= 0.0 {
                return Err(reader
                    .error(offset, format!("length {length} m, expected a positive number"))
                    .into());
            }
            Metric::Length(length)
        }
        "diagonal" if reader.eat('=') => {
            let weights = reader.list()?;
            if let Some(bad) = weights.iter().find(|weight| weight.value <= 0.0) {
                let message = format!("weight {}, expected a positive number", bad.value);
                return Err(reader.error(bad.offset, message).into());
            }
            Metric::Diagonal(weights.iter().map(|weight| weight.value).collect())
        }
        _ => {
            let expected = "no metric; expected euclidean, unit-diagonal, length=L or diagonal=[..]";
            return Err(ExpressionError::new(text, start, expected).into());
        }
    };
    reader.end()?;
    Ok(metric)
}
