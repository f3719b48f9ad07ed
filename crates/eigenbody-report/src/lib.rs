//! How results are shown: a table that a person wants to read, and exact JSON, CSV and NPY.
//!
//! Nothing is computed here: a result comes in, text or bytes go out.

#![forbid(unsafe_code)]

mod excerpt;
mod info;
mod matrix;
mod number;
mod spectrum;
mod text;

pub use excerpt::excerpt;
pub use info::{BodyRow, DofRow, InfoReport};
pub use matrix::MatrixReport;
pub use number::significant;
pub use spectrum::{CountReport, ErrorEstimate, ModeReport, SpectrumReport, Subject};
pub use text::{Mode, modes};
